//! Coordinates that are not finite, axes that do not exist, and boxes that are empty.

use super::P3;
use std::cmp::Ordering;
use welter_predicates::moved_grid::{
    axis_line_crossing, compare_crossings, crossing_precedes, moved_box_meets_segment,
    moved_box_meets_triangle, orient3d_moved, try_axis_line_crossing, try_compare_crossings,
    try_crossing_precedes, try_moved_box_meets_segment, try_moved_box_meets_triangle, try_orient3d_moved,
};
use welter_predicates::{NonFinite, Sign};

/// Corners of two triangles and a point, for which no answer is "nothing", whichever sign an infinity has.
const POINTS: [P3; 7] = [
    [-1.0, -1.0, 0.0],
    [2.0, -1.0, 0.0],
    [-1.0, 2.0, 0.0],
    [-1.0, -1.0, 1.0],
    [2.0, -1.0, 1.0],
    [-1.0, 2.0, 2.0],
    [0.0, 0.0, 0.0],
];

#[test]
fn what_is_not_finite_is_nothing_and_is_named() {
    let [a, b, c, d, e, f, p] = POINTS;
    let line = |p: P3| [p[0], p[1]];
    assert_eq!(axis_line_crossing(2, line(p), [a, b, c]), Sign::Positive);
    assert_eq!(compare_crossings(2, line(p), [a, b, c], [d, e, f]), Ordering::Less);
    assert!(crossing_precedes(2, line(p), [a, b, c], p[2]));
    assert!(moved_box_meets_triangle([-3.0, -3.0, -1.0], [0.0; 3], [a, b, c]));
    assert!(moved_box_meets_segment([-3.0, -3.0, -1.0], [0.0; 3], [a, b]));

    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..21 {
            let mut points = POINTS;
            points[place / 3][place % 3] = value;
            let [a, b, c, d, e, f, p] = points;
            let (argument, coordinate) = (place / 3, place % 3);
            let at = |argument, coordinate| NonFinite { argument, coordinate, value };
            // A plane of three corners and a node.
            if argument < 3 || argument == 6 {
                assert_eq!(orient3d_moved(a, b, c, p), Sign::Zero);
                let error = at(argument.min(3), coordinate);
                assert_eq!(try_orient3d_moved(a, b, c, p), Err(error));
            }
            // A line has two coordinates, and a node on it the third.
            let of_line = argument == 6 && coordinate < 2;
            if argument < 3 || of_line {
                let error = Err(at(argument.min(3), coordinate));
                assert_eq!(axis_line_crossing(2, line(p), [a, b, c]), Sign::Zero);
                assert_eq!(try_axis_line_crossing(2, line(p), [a, b, c]), error);
            }
            if argument < 3 || argument == 6 {
                assert!(!crossing_precedes(2, line(p), [a, b, c], p[2]));
                let error = if place == 20 { at(4, 0) } else { at(argument.min(3), coordinate) };
                assert_eq!(try_crossing_precedes(2, line(p), [a, b, c], p[2]), Err(error));
            }
            if argument < 6 || of_line {
                assert_eq!(compare_crossings(2, line(p), [a, b, c], [d, e, f]), Ordering::Equal);
                let error = Err(at(argument, coordinate));
                assert_eq!(try_compare_crossings(2, line(p), [a, b, c], [d, e, f]), error);
            }
        }
    }
}

#[test]
fn boxes_that_are_not_finite_or_empty_meet_nothing() {
    let t: [P3; 3] = [[-1.0, -1.0, 0.0], [2.0, -1.0, 0.0], [-1.0, 2.0, 0.0]];
    let (min, max) = ([-3.0, -3.0, -1.0], [3.0, 3.0, 0.0]);
    assert_eq!(try_moved_box_meets_triangle(min, max, t), Ok(true));
    assert_eq!(try_moved_box_meets_segment(min, max, [t[0], t[1]]), Ok(true));
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..15 {
            let mut points = [min, max, t[0], t[1], t[2]];
            points[place / 3][place % 3] = value;
            let [min, max, a, b, c] = points;
            let error = NonFinite { argument: place / 3, coordinate: place % 3, value };
            assert!(!moved_box_meets_triangle(min, max, [a, b, c]));
            assert_eq!(try_moved_box_meets_triangle(min, max, [a, b, c]), Err(error));
            if place < 12 {
                assert!(!moved_box_meets_segment(min, max, [a, b]));
                assert_eq!(try_moved_box_meets_segment(min, max, [a, b]), Err(error));
            }
        }
    }
    for axis in 0..3 {
        let (mut min, mut max) = (min, max);
        (min[axis], max[axis]) = (max[axis], min[axis]);
        assert!(!moved_box_meets_triangle(min, max, t));
        assert!(!moved_box_meets_segment(min, max, [t[0], t[1]]));
    }
}

#[test]
fn axes_are_counted_modulo_three() {
    let [a, b, c, d, e, f, _] = POINTS;
    for axis in [2, 5, usize::MAX - 1] {
        assert_eq!(axis % 3, 2);
        assert_eq!(axis_line_crossing(axis, [0.0; 2], [a, b, c]), Sign::Positive);
        assert_eq!(compare_crossings(axis, [0.0; 2], [d, e, f], [a, b, c]), Ordering::Greater);
        assert!(!crossing_precedes(axis, [0.0; 2], [a, b, c], -1.0));
    }
}
