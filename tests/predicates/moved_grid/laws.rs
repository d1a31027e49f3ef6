//! What must hold between the answers, since they speak of one grid.

use super::{P3, line_through, sorted};
use crate::intersection::on_every_kind;
use proptest::prelude::*;
use std::cmp::Ordering;
use welter_kit::exact;
use welter_kit::generate::{Kind, number, points, seeded};
use welter_predicates::Sign;
use welter_predicates::moved_grid::{
    axis_line_crossing, compare_crossings, crossing_precedes, moved_box_meets_segment,
    moved_box_meets_triangle, orient3d_moved,
};

const CYCLES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// The faces of a tetrahedron, oriented alike: a closed surface, whatever its corners.
fn faces(corners: [P3; 4]) -> [[P3; 3]; 4] {
    CYCLES.map(|face| face.map(|i| corners[i]))
}

/// A line meets the closed surface of a tetrahedron in two points or none, also where it runs through a corner or along an
/// edge, and what precedes a node on it tells on which side the node is.
#[test]
fn a_line_enters_a_closed_surface_as_often_as_it_leaves() {
    on_every_kind::<3, 6>(600, &["none", "two", "inside"], |[a, b, c, d, p, q]| {
        let faces = faces([a, b, c, d]);
        let mut seen = "none";
        for (axis, through) in [p, a, d, [a[0], b[1], c[2]]].into_iter().enumerate() {
            let (axis, line) = (axis % 3, line_through(axis % 3, through));
            let signs = faces.map(|t| axis_line_crossing(axis, line, t));
            let crossed: Vec<usize> = (0..4).filter(|&i| !signs[i].is_zero()).collect();
            let sum: i32 = signs.iter().map(|&sign| i32::from(sign as i8)).sum();
            prop_assert!(
                sum == 0 && matches!(crossed.len(), 0 | 2),
                "{signs:?} of {faces:?}, {axis} {line:?}"
            );
            let mut node = through;
            node[axis] = q[axis];
            let before =
                crossed.iter().filter(|&&i| crossing_precedes(axis, line, faces[i], node[axis])).count();
            let sides = faces.map(|[a, b, c]| orient3d_moved(a, b, c, node));
            let inside = sides == [Sign::Positive; 4] || sides == [Sign::Negative; 4];
            prop_assert_eq!(before == 1, inside, "{:?} in {:?}", node, faces);
            if let [i, j] = crossed[..] {
                let order = compare_crossings(axis, line, faces[i], faces[j]);
                let flat = exact::orient(&[a, b, c, d]) == 0;
                prop_assert_eq!(order == Ordering::Equal, flat);
                prop_assert_eq!(compare_crossings(axis, line, faces[j], faces[i]), order.reverse());
                if before == 1 {
                    let first = crossing_precedes(axis, line, faces[i], node[axis]);
                    prop_assert_eq!(first, order == Ordering::Less);
                }
                seen = if inside { "inside" } else { "two" };
            }
        }
        Ok(seen)
    });
}

/// Around an inner vertex of a patch that covers its neighbourhood once, in projection.
#[test]
fn exactly_one_triangle_around_a_vertex_or_an_edge_is_crossed() {
    let ring = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];
    for axis in 0..3 {
        let at = |[u, v]: [i32; 2], w: i32| {
            let mut p = [f64::from(w); 3];
            (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (f64::from(u), f64::from(v));
            p
        };
        // Every second or every vertex of the ring, at uneven heights.
        for step in [1, 2] {
            let fan: Vec<[P3; 3]> = (0..8)
                .step_by(step)
                .map(|i| {
                    let j = (i + step) % 8;
                    [at([0, 0], 0), at(ring[i], i as i32), at(ring[j], j as i32)]
                })
                .collect();
            for line in [[0.0, 0.0], [0.25, 0.25], [0.5, 0.0], [0.0, 0.5], [-0.25, 0.25], [-0.5, 0.0]] {
                let signs: Vec<Sign> = fan
                    .iter()
                    .map(|&t| axis_line_crossing(axis, line, t))
                    .filter(|sign| !sign.is_zero())
                    .collect();
                assert_eq!(signs, [Sign::Positive], "{axis} {step} {line:?}");
            }
        }
    }
}

/// Which corner comes first does not matter, the orientation only turns signs.
#[test]
fn order_of_corners() {
    on_every_kind::<3, 8>(300, &[], |[a, b, c, d, e, f, q, r]| {
        for (axis, node) in r.into_iter().enumerate() {
            let line = line_through(axis, q);
            let sign = axis_line_crossing(axis, line, [a, b, c]);
            let order = compare_crossings(axis, line, [a, b, c], [d, e, f]);
            let precedes = crossing_precedes(axis, line, [a, b, c], node);
            for (t, turned) in [([b, c, a], sign), ([b, a, c], -sign)] {
                prop_assert_eq!(axis_line_crossing(axis, line, t), turned);
                prop_assert_eq!(compare_crossings(axis, line, t, [d, e, f]), order);
                prop_assert_eq!(crossing_precedes(axis, line, t, node), precedes);
            }
            prop_assert_eq!(compare_crossings(axis, line, [f, e, d], [a, b, c]), order.reverse());
            prop_assert_eq!(compare_crossings(axis, line, [a, b, c], [c, b, a]), Ordering::Equal);
        }
        let (min, max) = sorted(q, r);
        let meets = moved_box_meets_triangle(min, max, [a, b, c]);
        for t in [[b, c, a], [b, a, c]] {
            prop_assert_eq!(moved_box_meets_triangle(min, max, t), meets);
        }
        let meets = moved_box_meets_segment(min, max, [a, b]);
        prop_assert_eq!(moved_box_meets_segment(min, max, [b, a]), meets);
        prop_assert_eq!(moved_box_meets_triangle(min, max, [a, b, b]), meets);
        Ok("")
    });
}

/// A box that is cut in two by a plane of the grid meets what one of the halves meets.
#[test]
fn halves_of_a_box() {
    on_every_kind::<3, 6>(1500, &["neither", "lower", "upper", "both"], |[a, b, c, q, r, s]| {
        let (min, max) = sorted(q, r);
        let axis = usize::from(a[0] > b[0]) + usize::from(b[1] > c[1]);
        // At a plane within the box, often through a corner of the triangle.
        let cut = if s[1] > q[1] { s[axis] } else { a[axis] }.clamp(min[axis], max[axis]);
        let (mut below, mut above) = (max, min);
        (below[axis], above[axis]) = (cut, cut);
        let halves = [(min, below), (above, max)];
        let parts = halves.map(|(min, max)| moved_box_meets_triangle(min, max, [a, b, c]));
        prop_assert_eq!(moved_box_meets_triangle(min, max, [a, b, c]), parts[0] || parts[1]);
        let pieces = halves.map(|(min, max)| moved_box_meets_segment(min, max, [a, b]));
        prop_assert_eq!(moved_box_meets_segment(min, max, [a, b]), pieces[0] || pieces[1]);
        Ok(match parts {
            [false, false] => "neither",
            [true, false] => "lower",
            [false, true] => "upper",
            [true, true] => "both",
        })
    });
}

/// A triangle that an edge of the moved box crosses meets the box, and so does the box that a side of a triangle meets.
#[test]
fn parts_meet_only_if_the_wholes_do() {
    on_every_kind::<3, 5>(1500, &["apart", "crossed", "side"], |[a, b, c, q, r]| {
        let ((min, max), t) = (sorted(q, r), [a, b, c]);
        let meets = moved_box_meets_triangle(min, max, t);
        let crossed = (0..12).any(|edge| {
            let axis = edge / 4;
            let end = |high: bool, k: usize| if high { max[k] } else { min[k] };
            let line = [end(edge & 1 == 1, (axis + 1) % 3), end(edge & 2 == 2, (axis + 2) % 3)];
            !axis_line_crossing(axis, line, t).is_zero()
                && !crossing_precedes(axis, line, t, min[axis])
                && crossing_precedes(axis, line, t, max[axis])
        });
        let side = (0..3).any(|i| moved_box_meets_segment(min, max, [t[i], t[(i + 1) % 3]]));
        // They meet where an edge of one crosses the other.
        prop_assert_eq!(meets, crossed || side, "{} {}", crossed, side);
        Ok(match (crossed, side) {
            (true, _) => "crossed",
            (_, true) => "side",
            _ => "apart",
        })
    });
}

/// Cells between these planes fill the part of space where the grids of numbers have their points.
const PLANES: [f64; 9] = [-8.0, -4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0, 8.0];

fn cells() -> impl Iterator<Item = (P3, P3)> {
    (0..512).map(|i| {
        let index = [i % 8, i / 8 % 8, i / 64];
        (index.map(|k| PLANES[k]), index.map(|k| PLANES[k + 1]))
    })
}

#[test]
fn a_point_is_in_exactly_one_cell() {
    for kind in [Kind::Grid, Kind::Uniform, Kind::SignedZero] {
        for [p] in seeded::<3, 1>(kind, 60) {
            let found: Vec<(P3, P3)> =
                cells().filter(|&(min, max)| moved_box_meets_triangle(min, max, [p; 3])).collect();
            assert_eq!(found.len(), 1, "{p:?} in {found:?}");
            let (min, max) = found[0];
            assert!((0..3).all(|k| min[k] < p[k] && p[k] <= max[k]), "{p:?} in {found:?}");
            assert!(cells().all(|(a, b)| moved_box_meets_segment(a, b, [p, p]) == ((a, b) == (min, max))));
        }
    }
}

#[test]
fn a_triangle_in_a_plane_of_the_grid_meets_the_cells_below_alone() {
    for axis in 0..3 {
        for [mut a, mut b, mut c] in seeded::<3, 3>(Kind::Uniform, 40) {
            for height in PLANES {
                (a[axis], b[axis], c[axis]) = (height, height, height);
                let found: Vec<_> =
                    cells().filter(|&(min, max)| moved_box_meets_triangle(min, max, [a, b, c])).collect();
                assert_eq!(found.is_empty(), height == PLANES[0]);
                assert!(found.iter().all(|(_, max)| max[axis] == height), "{height} {found:?}");
            }
        }
    }
}

/// Scaling by a power of two and steps of the grid are exact, and change no answer.
#[test]
fn scaling_and_translating_keep_the_answers() {
    for kind in [Kind::Grid, Kind::Dyadic, Kind::FlatGrid] {
        let inputs = (points::<3, 8>(kind), -200..=200_i32, -40..40_i32);
        crate::family::check(kind, 500, &inputs, |(p, exponent, steps)| {
            let factor = number::power_of_two(exponent);
            let along = |x: f64| (x + f64::from(steps) / 8.0) * factor;
            let answers = |p: [P3; 8]| {
                let [a, b, c, d, e, f, q, r] = p;
                let (min, max) = sorted(q, r);
                let lines = [0, 1, 2].map(|axis| {
                    let line = line_through(axis, q);
                    (
                        axis_line_crossing(axis, line, [a, b, c]),
                        compare_crossings(axis, line, [a, b, c], [d, e, f]),
                        crossing_precedes(axis, line, [a, b, c], r[axis]),
                    )
                });
                let boxes = moved_box_meets_triangle(min, max, [a, b, c]);
                (lines, boxes, moved_box_meets_segment(min, max, [a, b]), orient3d_moved(a, b, c, q))
            };
            prop_assert_eq!(answers(p), answers(p.map(|point| point.map(along))));
            Ok(())
        });
    }
}
