//! Against determinants and clipping in integers.

use super::{P3, line_through, sorted};
use crate::intersection::on_every_kind;
use proptest::prelude::*;
use std::cmp::Ordering;
use welter_kit::exact::{self, MovedLine, moved_box_meets, moved_orient};
use welter_kit::generate::{Kind, seeded};
use welter_predicates::moved_grid::{
    axis_line_crossing, compare_crossings, crossing_precedes, moved_box_meets_segment,
    moved_box_meets_triangle, orient3d_moved,
};

#[test]
fn planes_and_moved_nodes() {
    on_every_kind::<3, 4>(1000, &["clear", "tied", "collinear"], |[a, b, c, node]| {
        let expected = moved_orient(&[a, b, c], node);
        prop_assert_eq!(i32::from(orient3d_moved(a, b, c, node) as i8), expected);
        let plain = exact::orient(&[a, b, c, node]);
        Ok(match (expected, plain) {
            (0, _) => "collinear",
            (_, 0) => "tied",
            _ => {
                prop_assert_eq!(plain, expected);
                "clear"
            }
        })
    });
}

#[test]
fn lines_and_triangles() {
    on_every_kind::<3, 7>(120, &["none", "one", "two", "one plane"], |[a, b, c, d, e, f, p]| {
        // Two that have nothing in common, and two that share an edge and a corner with the first.
        let triangles = [[a, b, c], [d, e, f], [b, a, f], [a, d, e]];
        let mut seen = Seen::None;
        for axis in 0..3 {
            let through = if c[axis] > b[axis] { a } else { p };
            let nodes = [through[axis], b[axis], d[axis], f[axis]];
            seen = seen.max(on_line(axis, line_through(axis, through), &triangles, nodes)?);
        }
        Ok(match seen {
            Seen::None => "none",
            Seen::One => "one",
            Seen::Two => "two",
            Seen::OnePlane => "one plane",
        })
    });
}

/// How many of the first two triangles a line crosses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Seen {
    None,
    One,
    Two,
    OnePlane,
}

fn on_line(
    axis: usize,
    line: [f64; 2],
    triangles: &[[P3; 3]; 4],
    nodes: [f64; 4],
) -> Result<Seen, TestCaseError> {
    let expected = MovedLine::new(axis, line, triangles, &nodes);
    for (i, &t) in triangles.iter().enumerate() {
        let sign = if expected.crossings[i].is_some() { expected.normals[i] } else { 0 };
        prop_assert_eq!(
            i32::from(axis_line_crossing(axis, line, t) as i8),
            sign,
            "{} {:?} {:?}",
            axis,
            line,
            t
        );
        for (&node, moved) in nodes.iter().zip(&expected.nodes) {
            let precedes = expected.planes[i].as_ref().is_some_and(|at| at < moved);
            prop_assert_eq!(
                crossing_precedes(axis, line, t, node),
                precedes,
                "{} {:?} {:?} {}",
                axis,
                line,
                t,
                node
            );
        }
        for (j, &other) in triangles.iter().enumerate() {
            let order = match (&expected.planes[i], &expected.planes[j]) {
                (Some(one), Some(two)) => one.cmp(two),
                _ => Ordering::Equal,
            };
            let answer = compare_crossings(axis, line, t, other);
            prop_assert_eq!(answer, order, "{} {:?} {:?} {:?}", axis, line, t, other);
        }
    }
    let crossed: Vec<_> = expected.crossings[..2].iter().flatten().collect();
    Ok(match crossed[..] {
        [] => Seen::None,
        [_] => Seen::One,
        [one, two] if one == two => Seen::OnePlane,
        _ => Seen::Two,
    })
}

/// Triangles that share the corner through which the line runs, so that nothing but the move orders the crossings.
#[test]
fn crossings_that_coincide_before_the_move() {
    let mut seen = [0; 3];
    for kind in [Kind::Grid, Kind::Dyadic, Kind::NearFlat] {
        for [a, b, c, d, o] in seeded::<3, 5>(kind, 400) {
            let (one, two) = ([o, a, b], [c, d, o]);
            for axis in 0..3 {
                let line = line_through(axis, o);
                let expected = MovedLine::new(axis, line, &[one, two], &[o[axis]]);
                if let [Some(first), Some(second)] = &expected.crossings[..] {
                    let order = first.cmp(second);
                    assert_eq!(compare_crossings(axis, line, one, two), order, "{axis} {one:?} {two:?}");
                    let precedes = *first < expected.nodes[0];
                    assert_eq!(crossing_precedes(axis, line, one, o[axis]), precedes, "{axis} {one:?}");
                    seen[(order as i8 + 1) as usize] += 1;
                }
            }
        }
    }
    assert!(seen[0] > 50 && seen[1] > 0 && seen[2] > 50, "{seen:?}");
}

#[test]
fn triangles_and_boxes() {
    on_every_kind::<3, 5>(500, &["apart", "meet"], |[a, b, c, q, r]| {
        let (min, max) = sorted(q, r);
        // Most boxes here are empty.
        prop_assert_eq!(moved_box_meets_triangle(q, r, [a, b, c]), moved_box_meets(q, r, &[a, b, c]));
        for t in [[a, b, c], [a, b, a], [c, c, c]] {
            let expected = moved_box_meets(min, max, &t);
            prop_assert_eq!(moved_box_meets_triangle(min, max, t), expected, "{:?} {:?} {:?}", t, min, max);
        }
        let expected = moved_box_meets(min, max, &[a, b]);
        prop_assert_eq!(moved_box_meets_segment(min, max, [a, b]), expected);
        prop_assert_eq!(moved_box_meets_segment(min, max, [c, c]), moved_box_meets(min, max, &[c]));
        Ok(if moved_box_meets(min, max, &[a, b, c]) { "meet" } else { "apart" })
    });
}

/// All triangles, segments and points of the 27 nodes of `{0, 1, 2}^3`, against all unit cells that touch them.
#[test]
fn every_simplex_of_a_small_grid() {
    let node = |i: usize| [i % 3, i / 3 % 3, i / 9].map(|x| x as f64);
    let mut met = 0;
    for a in 0..27 {
        for b in a..27 {
            for c in b..27 {
                // Of the order of corners, one of the six.
                let t = if (a + b + c) % 2 == 0 { [a, b, c] } else { [c, b, a] }.map(node);
                // Every fifth cell of each, another one for each.
                for cell in (0..27).filter(|cell| (a + b + c + cell) % 5 == 0) {
                    let min = node(cell).map(|x| x - 1.0);
                    let max = min.map(|x| x + 1.0);
                    let expected = moved_box_meets(min, max, &t);
                    assert_eq!(moved_box_meets_triangle(min, max, t), expected, "{t:?} {min:?}");
                    met += u32::from(expected);
                    if b == c {
                        let s = [t[0], t[2]];
                        assert_eq!(moved_box_meets_segment(min, max, s), expected, "{s:?} {min:?}");
                    }
                }
            }
        }
    }
    assert!((2000..12000).contains(&met), "{met}");
}
