//! The closest point against all triangles in turn, each by another method.

use super::{SCALES, crowded, mapped, mesh_of, scattered};
use glam::DVec3;
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::spatial::{Bvh, ClosestPoint};
use welter_meshing::surface::{TriId, TriMesh};
use welter_predicates::intersection::TriangleFeature;

/// The distance to a triangle, by bisecting its longest edge and keeping the nearer parts: no formula in common with
/// the code under test. To about 1e-13 for coordinates of size one.
fn distance(query: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let mut parts = vec![[a, b, c]];
    for _ in 0..90 {
        let mut next: Vec<[DVec3; 3]> = Vec::new();
        for t in parts {
            let k = (0..3).max_by(|&i, &j| side(t, i).total_cmp(&side(t, j))).unwrap();
            let (u, v, w) = (t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
            let middle = u.midpoint(v);
            next.extend([[u, middle, w], [middle, v, w]]);
        }
        // A part is at least as far as its centre less its radius.
        let centre = |t: &[DVec3; 3]| (t[0] + t[1] + t[2]) / 3.0;
        let radius = |t: &[DVec3; 3]| t.iter().map(|p| p.distance(centre(t))).fold(0.0, f64::max);
        let best = next.iter().map(|t| query.distance(centre(t))).fold(f64::INFINITY, f64::min);
        next.retain(|t| query.distance(centre(t)) - radius(t) <= best);
        next.sort_by(|s, t| query.distance(centre(s)).total_cmp(&query.distance(centre(t))));
        next.truncate(256);
        parts = next;
    }
    parts.iter().flatten().map(|p| query.distance(*p)).fold(f64::INFINITY, f64::min)
}

fn side(t: [DVec3; 3], k: usize) -> f64 {
    t[k].distance(t[(k + 1) % 3])
}

fn closest(mesh: &TriMesh, query: DVec3) -> ClosestPoint {
    Bvh::new(mesh).closest_point(query).expect("there are triangles")
}

#[test]
fn distances_agree_with_bisection() {
    for seed in 0..4 {
        let bytes = stream(seed, 4000);
        let entropy = &mut Entropy::new(&bytes);
        let mesh = scattered(entropy, 12, 0.6);
        for _ in 0..4 {
            let query = DVec3::from_array([(); 3].map(|()| f64::from(entropy.between(-20, 30)) / 10.0));
            let expected =
                (0..12).map(|t| distance(query, mesh.corners(TriId(t)))).fold(f64::INFINITY, f64::min);
            let found = closest(&mesh, query);
            assert!((found.distance - expected).abs() < 1e-11, "{found:?} {expected}");
            assert!((found.point.distance(query) - found.distance).abs() < 1e-13, "{found:?}");
        }
    }
}

#[test]
fn features_and_ties() {
    let square =
        mesh_of(vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y], vec![[2, 3, 0], [0, 1, 2]]);
    let at = |x, y, z| closest(&square, DVec3::new(x, y, z));
    let is = |found: ClosestPoint, triangle, feature, distance| {
        assert_eq!((found.triangle, found.feature, found.distance), (TriId(triangle), feature, distance));
    };
    is(at(0.75, 0.25, 2.0), 1, TriangleFeature::Interior, 2.0);
    is(at(0.25, 0.75, -2.0), 0, TriangleFeature::Interior, 2.0);
    // On the diagonal and at its ends both triangles are as near: the lower one is named.
    is(at(0.5, 0.5, 1.0), 0, TriangleFeature::Edge(2), 1.0);
    is(at(-3.0, -4.0, 0.0), 0, TriangleFeature::Vertex(2), 5.0);
    is(at(4.0, 5.0, 0.0), 0, TriangleFeature::Vertex(0), 5.0);
    is(at(0.5, -1.0, 0.0), 1, TriangleFeature::Edge(0), 1.0);
    is(at(0.0, 0.0, 0.0), 0, TriangleFeature::Vertex(2), 0.0);
    assert_eq!(at(1.0, 1.0, 0.5).point, DVec3::new(1.0, 1.0, 0.0));
}

#[test]
fn shared_edges_of_any_slope_tie() {
    for seed in 0..200 {
        let bytes = stream(seed, 200);
        let entropy = &mut Entropy::new(&bytes);
        let mut point = || DVec3::from_array([(); 3].map(|()| f64::from(entropy.word() as i16) / 1000.0));
        let (u, v) = (point(), point());
        // Two triangles at edge uv in opposite directions, apices on the same side, query on the other.
        let (a, b) = (u + (u - v).any_orthogonal_vector(), v + (u - v).any_orthogonal_vector());
        let query = u.midpoint(v) - 0.7 * (u - v).any_orthogonal_vector() + 0.1 * (v - u);
        let mesh = mesh_of(vec![u, v, a, b], vec![[1, 0, 3], [0, 1, 2]]);
        assert_eq!(closest(&mesh, query).triangle, TriId(0), "seed {seed}");
    }
}

#[test]
fn scale_does_not_matter() {
    for seed in 0..6 {
        let bytes = stream(seed, 900);
        let entropy = &mut Entropy::new(&bytes);
        let mesh = crowded(entropy, 12, 16, 6);
        let query = DVec3::from_array([(); 3].map(|()| f64::from(entropy.between(-4, 8))));
        let expected = closest(&mesh, query);
        for [a, b] in SCALES {
            let found = closest(&mapped(&mesh, |p| p * a * b), query * a * b);
            assert_eq!((found.triangle, found.feature), (expected.triangle, expected.feature));
            // Exact but for the last rounding to the unit of subnormal numbers.
            let distance = expected.distance * a * b;
            assert!((found.distance - distance).abs() <= 5e-324, "{found:?} {expected:?}");
        }
    }
}

#[test]
fn the_ends_of_the_range() {
    let huge = mesh_of(vec![DVec3::splat(f64::MAX), DVec3::X, DVec3::Y], vec![[0, 1, 2]]);
    let from_far = closest(&huge, DVec3::splat(-f64::MAX));
    assert_eq!((from_far.distance, from_far.point.min_element() >= 0.0), (f64::INFINITY, true));
    assert!(from_far.point.max_element() <= 1.0, "{from_far:?}");
    assert_eq!(closest(&huge, DVec3::splat(f64::MAX)).distance, 0.0);
    let far = mesh_of(vec![DVec3::X, DVec3::Y, DVec3::Z], vec![[0, 1, 2]]);
    assert_eq!(closest(&far, DVec3::X * 1e300).distance, 1e300);
    // A point very near to a mesh of size one: its squared distance would underflow.
    let near =
        closest(&mesh_of(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]]), DVec3::NEG_X * 1e-200);
    assert_eq!((near.distance, near.feature), (1e-200, TriangleFeature::Vertex(0)));
    assert_eq!(Bvh::new(&far).closest_point(DVec3::NAN), None);
    assert_eq!(Bvh::new(&mesh_of(vec![], vec![])).closest_point(DVec3::ZERO), None);
}
