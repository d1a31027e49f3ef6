//! What a closed box leaves of a segment or triangle, by clipping to one half space after another \[Sutherland74\].

use super::{lift, linear};
use rug::Integer;

/// Points, in homogeneous integer coordinates with a positive last one, whose hull is the part of the hull of `points`
/// (a point, segment or triangle, degenerate or not) inside the closed box from `min` to `max`; none if they are disjoint.
#[must_use]
pub fn clip_to_box<const D: usize>(points: &[[f64; D]], min: [f64; D], max: [f64; D]) -> Vec<Vec<Integer>> {
    let mut lifted = lift(&[points, &[min, max]].concat());
    let bounds = lifted.split_off(points.len());
    clip_to_box_of_integers(&lifted, &bounds[0], &bounds[1])
}

/// [`clip_to_box`] of lifted coordinates.
pub(super) fn clip_to_box_of_integers<const D: usize>(
    points: &[[Integer; D]],
    min: &[Integer; D],
    max: &[Integer; D],
) -> Vec<Vec<Integer>> {
    let mut polygon: Vec<Vec<Integer>> =
        points.iter().map(|p| p.iter().cloned().chain([Integer::from(1)]).collect()).collect();
    for axis in 0..D {
        polygon = clip(&polygon, |p| &p[axis] - Integer::from(&min[axis] * &p[D]));
        polygon = clip(&polygon, |p| Integer::from(&max[axis] * &p[D]) - &p[axis]);
    }
    polygon
}

/// The part of a closed polygon where a linear form is not negative.
fn clip(polygon: &[Vec<Integer>], form: impl Fn(&[Integer]) -> Integer) -> Vec<Vec<Integer>> {
    let mut kept = Vec::new();
    for (i, from) in polygon.iter().enumerate() {
        let to = &polygon[(i + 1) % polygon.len()];
        let (at_from, at_to) = (form(from), form(to));
        if !at_from.is_negative() {
            kept.push(from.clone());
        }
        if (at_from.is_positive() && at_to.is_negative()) || (at_from.is_negative() && at_to.is_positive()) {
            // The form vanishes at form(from) * to - form(to) * from.
            let crossing =
                from.iter().zip(to).map(|(f, t)| Integer::from(&at_from * t) - Integer::from(&at_to * f));
            kept.push(linear::primitive(crossing.collect()));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        exact::meeting,
        generate::{Kind, seeded},
    };

    #[test]
    fn a_triangle_that_cuts_a_corner_off() {
        let triangle = [[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]];
        let dimension = |max: f64| linear::affine_dimension(&clip_to_box(&triangle, [0.0; 3], [max; 3]));
        assert_eq!((dimension(1.0), dimension(2.0), dimension(1.0f64.next_down())), (Some(0), Some(2), None));
        assert_eq!(clip_to_box(&triangle, [0.0; 3], [2.0; 3]).len(), 6);
    }

    #[test]
    fn agrees_with_enumeration_of_weights() {
        let mut met = 0;
        for kind in [Kind::Uniform, Kind::Grid, Kind::NearFlat, Kind::SignedZero] {
            for p in seeded::<2, 5>(kind, 200) {
                let (min, max) = ([0, 1].map(|i| p[3][i].min(p[4][i])), [0, 1].map(|i| p[3][i].max(p[4][i])));
                let corners = [min, [max[0], min[1]], max, [min[0], max[1]]];
                for points in [&p[..1], &p[..2], &p[..3]] {
                    let clipped = linear::affine_dimension(&clip_to_box(points, min, max));
                    assert_eq!(clipped, meeting(points, &corners).dimension(), "{points:?} {min:?} {max:?}");
                    met += u32::from(clipped.is_some());
                }
            }
        }
        assert!((500..2300).contains(&met), "{met}");
    }
}
