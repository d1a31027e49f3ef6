//! Cases made by hand, each with a name.

extern crate std;

use std::vec::Vec;

use super::*;

const T: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

/// Short names: `v0`, `e0`, `in`.
fn short(feature: TriangleFeature) -> std::string::String {
    match feature {
        TriangleFeature::Vertex(i) => std::format!("v{i}"),
        TriangleFeature::Edge(i) => std::format!("e{i}"),
        TriangleFeature::Interior => "in".into(),
    }
}

fn told(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> std::string::String {
    let case = triangle_triangle(a, b);
    assert_eq!(triangles_intersect(a, b), case != TriangleTriangle::Disjoint);
    let kind = match case {
        TriangleTriangle::Disjoint => "disjoint",
        TriangleTriangle::Point(_) => "point",
        TriangleTriangle::Segment(_) => "segment",
        TriangleTriangle::CoplanarPoint(_) => "coplanar point",
        TriangleTriangle::CoplanarSegment(_) => "coplanar segment",
        TriangleTriangle::CoplanarArea(_) => "coplanar area",
        TriangleTriangle::Degenerate { a: true, b: true } => "degenerate both",
        TriangleTriangle::Degenerate { a: true, .. } => "degenerate first",
        TriangleTriangle::Degenerate { .. } => "degenerate second",
    };
    let contacts: Vec<_> =
        case.contacts().iter().map(|c| std::format!(" {}-{}", short(c.a), short(c.b))).collect();
    std::format!("{kind}{}", contacts.concat())
}

#[test]
fn two_triangles() {
    let at = |x: f64, y: f64, z: f64| [x, y, z];
    let table = [
        ("parallel planes", T.map(|[x, y, _]| [x, y, 1.0]), "disjoint"),
        ("above, tilted", [at(1., 1., 1.), at(2., 1., 1.), at(1., 2., 2.)], "disjoint"),
        ("plane is met beside the triangle", [at(5., 5., -1.), at(5., 5., 1.), at(6., 5., 0.)], "disjoint"),
        ("pierced by an edge", [at(1., 1., -1.), at(1., 1., 1.), at(9., 9., 0.)], "segment e1-in in-e0"),
        (
            "needle through the interior",
            [at(1., 1., -1.), at(1., 1., 1.), at(1., 2., 1.)],
            "segment in-e0 in-e2",
        ),
        ("both pierce one edge", [at(2., -1., -1.), at(2., -1., 1.), at(2., 1., 0.)], "segment e0-in in-v2"),
        ("vertex on the interior", [at(1., 1., 0.), at(1., 1., 1.), at(2., 1., 1.)], "point in-v0"),
        ("vertex on an edge", [at(2., 0., 0.), at(2., 0., 1.), at(2., -1., 1.)], "point e0-v0"),
        ("vertex on a vertex", [at(4., 0., 0.), at(5., 0., 1.), at(5., 1., 1.)], "point v1-v0"),
        (
            "edges cross, planes differ",
            [at(2., -1., 0.), at(2., 1., 0.), at(2., 0., 9.)],
            "segment e0-e0 in-v1",
        ),
        ("edges cross only", [at(2., -1., -1.), at(2., 1., 1.), at(2., -1., 1.)], "point e0-e0"),
        ("hinge: a common edge", [at(0., 0., 0.), at(4., 0., 0.), at(0., 0., 4.)], "segment v0-v0 v1-v1"),
        ("hinge: edges overlap", [at(1., 0., 0.), at(5., 0., 0.), at(1., 0., 4.)], "segment e0-v0 v1-e0"),
        ("coplanar, apart", [at(3., 3., 0.), at(5., 3., 0.), at(3., 5., 0.)], "disjoint"),
        (
            "coplanar, vertex to vertex",
            [at(4., 0., 0.), at(6., 0., 0.), at(6., -1., 0.)],
            "coplanar point v1-v0",
        ),
        (
            "coplanar, vertex to edge",
            [at(2., 2., 0.), at(5., 2., 0.), at(5., 5., 0.)],
            "coplanar point e1-v0",
        ),
        (
            "coplanar, edge beside edge",
            [at(1., 0., 0.), at(3., 0., 0.), at(2., -1., 0.)],
            "coplanar segment e0-v0 e0-v1",
        ),
        ("coplanar, the same", T, "coplanar area v0-v0 v1-v1 v2-v2"),
        ("coplanar, reversed", [T[0], T[2], T[1]], "coplanar area v0-v0 v1-v2 v2-v1"),
        (
            "coplanar, inside",
            [at(1., 1., 0.), at(2., 1., 0.), at(1., 2., 0.)],
            "coplanar area in-v0 in-v1 in-v2",
        ),
        (
            "coplanar, around",
            [at(-1., -1., 0.), at(9., -1., 0.), at(-1., 9., 0.)],
            "coplanar area v0-in v1-in v2-in",
        ),
        ("point triangle on it", [at(1., 1., 0.); 3], "degenerate second"),
        ("point triangle off it", [at(1., 1., 1.); 3], "disjoint"),
        (
            "collinear triangle through it",
            [at(1., 1., -1.), at(1., 1., 0.), at(1., 1., 2.)],
            "degenerate second",
        ),
        ("collinear triangle above it", [at(1., 1., 3.), at(1., 1., 1.), at(1., 1., 2.)], "disjoint"),
        (
            "collinear triangle across it",
            [at(-1., 1., 0.), at(9., 1., 0.), at(2., 1., 0.)],
            "degenerate second",
        ),
        (
            "collinear triangle in its plane, beside it",
            [at(5., 1., 0.), at(9., 1., 0.), at(7., 1., 0.)],
            "disjoint",
        ),
    ];
    for (name, other, expected) in table {
        assert_eq!(told(T, other), expected, "{name}");
    }
    let star = [[0.0, 3.0, 0.0], [3.0, 0.0, 0.0], [3.0, 3.0, 0.0]];
    let first = [[1.0, 1.0, 0.0], [4.0, 1.0, 0.0], [1.0, 4.0, 0.0]];
    assert_eq!(told(first, star), "coplanar area e0-e0 e0-e1 e1-e1 e1-e2 e2-e2 e2-e0");
    let line = [[0.0; 3], [1.0; 3], [2.0; 3]];
    assert_eq!(told(line, line), "degenerate both");
    assert_eq!(told(line, T), "degenerate first");
    assert_eq!(told([[0.0; 3]; 3], [[0.0, -0.0, 0.0]; 3]), "degenerate both");
}

/// The least possible heights decide, where any tolerance or rounding would not see them.
#[test]
fn the_last_bit_decides() {
    let tiny = f64::from_bits(1);
    let above = [[1.0, 1.0, tiny], [2.0, 1.0, 1.0], [1.0, 2.0, 1.0]];
    assert_eq!(told(T, above), "disjoint");
    let on = above.map(|[x, y, z]| [x, y, z - tiny]);
    assert_eq!(told(T, on), "point in-v0");
    let big = T.map(|p| p.map(|x| x * 2f64.powi(1021)));
    assert_eq!(told(big, above), "disjoint");
    assert_eq!(told(big, on), "point in-v0");
    // 0.1 + 0.2 and 0.3 differ in the last bit.
    let sum = 0.1 + 0.2;
    let shelf = [[0.0, 0.0, 0.3], [1.0, 0.0, 0.3], [0.0, 1.0, 0.3]];
    assert!(!segment_intersects_triangle([[0.2, 0.2, sum], [0.2, 0.2, 1.0]], shelf));
    assert!(segment_intersects_triangle([[0.2, 0.2, 0.3], [0.2, 0.2, 1.0]], shelf));
}

#[test]
fn grid_edges_against_triangles() {
    let edge = |x: f64, y: f64, z: [f64; 2]| [[x, y, z[0]], [x, y, z[1]]];
    let cut = |s| segment_triangle(s, T);
    assert!(cut(edge(1.0, 1.0, [-1.0, 1.0])).is_proper());
    let crossing = |a, b| SegmentTriangle::Crossing(Contact { a, b });
    use SegmentFeature::{Interior, Vertex};
    assert_eq!(cut(edge(0.0, 0.0, [-1.0, 1.0])), crossing(Interior, TriangleFeature::Vertex(0)));
    assert_eq!(cut(edge(2.0, 2.0, [-1.0, 1.0])), crossing(Interior, TriangleFeature::Edge(1)));
    assert_eq!(cut(edge(1.0, 1.0, [0.0, 1.0])), crossing(Vertex(0), TriangleFeature::Interior));
    assert_eq!(cut(edge(2.0, 2.5, [-1.0, 1.0])), SegmentTriangle::Disjoint);
    assert_eq!(cut([[1.0, 1.0, 0.0]; 2]), SegmentTriangle::Degenerate { a: true, b: false });
    let through = cut([[-1.0, 0.0, 0.0], [9.0, 0.0, 0.0]]);
    let along = |a, b| Contact { a, b };
    assert_eq!(
        through,
        SegmentTriangle::CoplanarSegment([
            along(Interior, TriangleFeature::Vertex(0)),
            along(Interior, TriangleFeature::Vertex(1)),
        ])
    );
}

#[test]
fn grid_cells_against_triangles() {
    let cell = |x: f64, y: f64, z: f64| triangle_box(T, [x, y, z], [x + 1.0, y + 1.0, z + 1.0]);
    assert_eq!(cell(0.0, 0.0, -0.5), TriangleBox::Crossing);
    let TriangleBox::Touching(touch) = cell(0.0, 0.0, 0.0) else { panic!("on the lower face") };
    assert_eq!(touch.b, BoxFeature([Side::Between, Side::Between, Side::Min]));
    let TriangleBox::Touching(touch) = cell(2.0, 2.0, -0.5) else { panic!("at a cell edge") };
    assert_eq!(
        (touch.a, touch.b),
        (TriangleFeature::Edge(1), BoxFeature([Side::Min, Side::Min, Side::Between]))
    );
    assert_eq!(cell(3.0, 3.0, -0.5), TriangleBox::Disjoint);
    assert_eq!(triangle_box(T, [-9.0; 3], [9.0; 3]), TriangleBox::Inside);
    assert_eq!(
        triangle_box(T, [1.0, 1.0, 0.0], [2.0, 2.0, 0.0]),
        TriangleBox::Degenerate { a: false, b: true }
    );
    assert_eq!(triangle_box(T, [1.0; 3], [-1.0; 3]), TriangleBox::Disjoint);
}

#[test]
fn rays_against_a_triangle() {
    let up = |x: f64, y: f64| ray_triangle_axis([x, y, -1.0], 2, true, T);
    let crossing = |b| RayTriangle::Crossing {
        at: Contact { a: RayFeature::Interior, b },
        direction: crate::Sign::Positive,
    };
    assert_eq!(up(1.0, 1.0), crossing(TriangleFeature::Interior));
    assert_eq!(up(2.0, 0.0), crossing(TriangleFeature::Edge(0)));
    assert_eq!(up(0.0, 4.0), crossing(TriangleFeature::Vertex(2)));
    assert_eq!(up(3.0, 3.0), RayTriangle::Disjoint);
    assert_eq!(ray_triangle_axis([1.0, 1.0, 1.0], 2, true, T), RayTriangle::Disjoint);
    let at_origin = ray_triangle_axis([1.0, 1.0, 0.0], 2, false, T);
    assert_eq!(
        at_origin,
        RayTriangle::Crossing {
            at: Contact { a: RayFeature::Origin, b: TriangleFeature::Interior },
            direction: crate::Sign::Negative,
        }
    );
    let flat = ray_triangle_axis([-1.0, 1.0, 0.0], 0, true, T);
    let RayTriangle::CoplanarSegment([one, two]) = flat else { panic!("{flat:?}") };
    assert_eq!((one.b, two.b), (TriangleFeature::Edge(2), TriangleFeature::Edge(1)));
    assert_eq!(
        ray_triangle([1.0, 1.0, 0.0], [1.0, 1.0, 0.0], T),
        RayTriangle::Degenerate { a: true, b: false }
    );
}
