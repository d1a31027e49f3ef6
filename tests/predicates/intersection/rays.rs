//! Ray against triangle: through a point, along a vector, along an axis.

use super::{Case, expected, on_every_kind, reported};
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;
use rug::Integer;
use welter_kit::exact::{determinant, lift, linear, meeting_of_ray, meeting_of_ray_through};
use welter_predicates::Sign;
use welter_predicates::intersection::{
    RayFeature, RayTriangle, ray_intersects_triangle, ray_triangle, ray_triangle_axis, ray_triangle_direction,
};

const WANTED: [&str; 6] =
    ["disjoint", "degenerate", "proper", "touching", "coplanar point", "coplanar segment"];

/// Where a ray goes: through a point, or along a vector.
enum Heading {
    Through([f64; 3]),
    Along([f64; 3]),
}

/// Compares an answer with the oracle.
fn agree(
    answer: RayTriangle,
    origin: [f64; 3],
    heading: Heading,
    t: [[f64; 3]; 3],
) -> Result<&'static str, TestCaseError> {
    let (case, name) = match answer {
        RayTriangle::Disjoint => (Case::Disjoint, "disjoint"),
        RayTriangle::Degenerate { a, b } => (Case::Degenerate(a, b), "degenerate"),
        RayTriangle::Crossing { at, .. } if answer.is_proper() => (reported(&[at], false), "proper"),
        RayTriangle::Crossing { at, .. } => (reported(&[at], false), "touching"),
        RayTriangle::CoplanarPoint(contact) => (reported(&[contact], true), "coplanar point"),
        RayTriangle::CoplanarSegment(ends) => {
            // In the direction of the ray: only the first end can be the origin.
            prop_assert!(!matches!(ends[1].a, RayFeature::Origin));
            (reported(&ends, true), "coplanar segment")
        }
    };

    let (found, head, weight) = match heading {
        Heading::Through(p) => (meeting_of_ray_through(origin, p, &t), p, 1),
        Heading::Along(d) => (meeting_of_ray(origin, d, &t), d, 0),
    };
    // Rows of homogeneous coordinates: the origin, the heading, the triangle.
    let lifted = lift(&[origin, head, t[0], t[1], t[2]]);
    let weights = [1, weight, 1, 1, 1].map(Integer::from);
    let rows: Vec<Vec<Integer>> =
        lifted.iter().zip(weights).map(|(p, w)| p.iter().cloned().chain([w]).collect()).collect();
    let no_direction = linear::rank(&rows[..2]) < 2;
    let wanted = match expected(&found, &[origin], &t) {
        Case::Meeting { .. } if no_direction => Case::Degenerate(true, false),
        Case::Meeting { corners, .. } => Case::Meeting { corners, coplanar: linear::rank(&rows) <= 3 },
        Case::Degenerate(_, flat) => Case::Degenerate(no_direction, flat),
        Case::Disjoint => Case::Disjoint,
    };
    prop_assert_eq!(case, wanted);

    if let RayTriangle::Crossing { direction, .. } = answer {
        // The sign of d . (t1 - t0) x (t2 - t0).
        let from = |row: usize, base: usize| -> Vec<Integer> {
            (0..3).map(|i| Integer::from(&rows[row][i] - &rows[base][i])).collect()
        };
        let d = if weight == 0 { rows[1][..3].to_vec() } else { from(1, 0) };
        let sign = determinant(&[d, from(3, 2), from(4, 2)]).cmp0() as i8;
        prop_assert_eq!(direction as i8, sign);
        prop_assert!(direction != Sign::Zero);
    }
    Ok(name)
}

#[test]
fn ray_through_a_point() {
    on_every_kind::<3, 5>(1200, &WANTED, |[o, p, t0, t1, t2]| {
        let t = [t0, t1, t2];
        let answer = ray_triangle(o, p, t);
        prop_assert_eq!(ray_intersects_triangle(o, p, t), answer != RayTriangle::Disjoint);
        agree(answer, o, Heading::Through(p), t)
    });
}

#[test]
fn ray_along_a_vector() {
    on_every_kind::<3, 5>(1200, &WANTED, |[o, d, t0, t1, t2]| {
        let t = [t0, t1, t2];
        agree(ray_triangle_direction(o, d, t), o, Heading::Along(d), t)
    });
}

#[test]
fn ray_along_an_axis() {
    // An axis always is a direction, so only the triangle can be degenerate.
    on_every_kind::<3, 4>(1200, &WANTED, |[o, t0, t1, t2]| {
        let t = [t0, t1, t2];
        // Any choice will do that is the same for the same input.
        let bits = o[0].to_bits() ^ t0[1].to_bits().rotate_left(7) ^ t1[2].to_bits().rotate_left(13);
        let (axis, positive) = ((bits.count_ones() % 3) as usize, bits.count_ones() % 2 == 0);
        let mut d = [0.0; 3];
        d[axis] = if positive { 1.0 } else { -1.0 };
        agree(ray_triangle_axis(o, axis, positive, t), o, Heading::Along(d), t)
    });
}
