//! What an exact case does under a change of its operands that is itself exact.

use super::{Face, on_every_kind};
use proptest::prelude::*;
use welter_kit::generate::{Kind, number, points, seeded};
use welter_predicates::intersection::{
    Contact, SegmentTriangle, TriangleTriangle, segment_intersects_triangle, segment_triangle,
    segments_intersect_2d, triangle_box, triangle_intersects_box, triangle_triangle, triangles_intersect,
    try_segment_triangle, try_triangle_box, try_triangle_triangle,
};

fn faces<A: Face, B: Face>(contacts: &[Contact<A, B>]) -> Vec<(u32, u32)> {
    let mut faces: Vec<_> = contacts.iter().map(|c| (c.a.bits(), c.b.bits())).collect();
    faces.sort_unstable();
    faces
}

#[test]
fn swapping_triangles_swaps_the_contacts() {
    on_every_kind::<3, 6>(500, &[], |[a0, a1, a2, b0, b1, b2]| {
        let (a, b) = ([a0, a1, a2], [b0, b1, b2]);
        let (one, two) = (triangle_triangle(a, b), triangle_triangle(b, a));
        let swapped: Vec<_> = two.contacts().iter().map(|c| c.swapped()).collect();
        prop_assert_eq!(faces(one.contacts()), faces(&swapped));
        prop_assert_eq!(std::mem::discriminant(&one), std::mem::discriminant(&two));
        Ok("")
    });
}

#[test]
fn rotating_corners_rotates_the_features() {
    on_every_kind::<3, 6>(500, &[], |[a0, a1, a2, b0, b1, b2]| {
        let (a, b) = ([a0, a1, a2], [b0, b1, b2]);
        let (one, two) = (triangle_triangle(a, b), triangle_triangle([a1, a2, a0], b));
        // Corner i of the second call is corner i + 1 of the first.
        let turned: Vec<_> =
            faces(two.contacts()).iter().map(|&(f, g)| ((f << 1 | f >> 2) & 0b111, g)).collect();
        let mut turned = turned;
        turned.sort_unstable();
        prop_assert_eq!(faces(one.contacts()), turned);
        Ok("")
    });
}

#[test]
fn mirroring_and_scaling_keep_the_case() {
    for kind in [Kind::Uniform, Kind::Dyadic, Kind::Grid, Kind::FlatGrid] {
        let inputs = (points::<3, 6>(kind), -1020..=1018_i32, 0..3_usize);
        crate::family::check(kind, 800, &inputs, |(p, exponent, axis)| {
            let factor = number::power_of_two(exponent);
            let changed = p.map(|mut q| {
                q.rotate_left(axis);
                q[0] = -q[0];
                q.map(|c| c * factor)
            });
            let of = |[a0, a1, a2, b0, b1, b2]: [[f64; 3]; 6]| triangle_triangle([a0, a1, a2], [b0, b1, b2]);
            let (one, two) = (of(p), of(changed));
            prop_assert_eq!(std::mem::discriminant(&one), std::mem::discriminant(&two));
            prop_assert_eq!(faces(one.contacts()), faces(two.contacts()));
            Ok(())
        });
    }
}

#[test]
fn single_precision_lifts() {
    for p in seeded::<3, 6>(Kind::Grid, 2000) {
        let [a0, a1, a2, b0, b1, b2] = p.map(|q| q.map(|c| c as f32));
        let double = p.map(|q| q.map(|c| c as f32).map(f64::from));
        assert_eq!(
            triangle_triangle([a0, a1, a2], [b0, b1, b2]),
            triangle_triangle([double[0], double[1], double[2]], [double[3], double[4], double[5]])
        );
    }
}

#[test]
fn input_that_is_no_number_is_disjoint_and_named() {
    let s = [[0.1, 0.1, -1.0], [0.1, 0.1, 1.0]];
    let t = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert!(segment_triangle(s, t).is_proper());
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..15 {
            let (argument, coordinate) = (place / 3, place % 3);
            let mut p = [s[0], s[1], t[0], t[1], t[2]];
            p[argument][coordinate] = bad;
            let (s, t) = ([p[0], p[1]], [p[2], p[3], p[4]]);
            assert_eq!(segment_triangle(s, t), SegmentTriangle::Disjoint, "{p:?}");
            assert!(!segment_intersects_triangle(s, t));
            let error = try_segment_triangle(s, t).unwrap_err();
            assert_eq!((error.argument, error.coordinate), (argument, coordinate));
            let (t, min, max) = ([p[0], p[1], p[2]], p[3], p[4]);
            assert!(!triangle_intersects_box(t, min, max));
            assert!(!segments_intersect_2d([[bad, 0.0], [1.0, 1.0]], [[0.0, 1.0], [1.0, 0.0]]));
            assert_eq!(try_triangle_box(t, min, max).unwrap_err().argument, argument);
        }
        let mut a = t;
        a[1][2] = bad;
        assert_eq!(triangle_triangle(a, t), TriangleTriangle::Disjoint);
        assert!(!triangles_intersect(a, t) && !triangles_intersect(t, a));
        assert_eq!(try_triangle_triangle(t, a).unwrap_err().argument, 4);
    }
    assert!(
        try_triangle_box(t, [0.0; 3], [1.0; 3]).is_ok_and(|case| case == triangle_box(t, [0.0; 3], [1.0; 3]))
    );
}
