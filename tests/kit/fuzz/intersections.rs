//! The yes-or-no intersection predicates against the enumeration of barycentric weights and against clipping.

use crate::entropy::Entropy;
use crate::exact::{clip_to_box, meeting, meeting_of_ray, meeting_of_ray_through};
use crate::generate::Kind;
use welter_predicates::intersection as wi;

/// Segments, triangles, rays, points and tetrahedra drawn from the bytes.
pub fn simplices(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    let entropy = &mut entropy;
    let (answer, case, expected) = match entropy.below(9) {
        0 => {
            let (_, [a, b, c, d]) = Kind::draw_any::<2, 4>(entropy);
            let case = wi::segment_segment_2d([a, b], [c, d]);
            let answer = wi::segments_intersect_2d([a, b], [c, d]);
            (answer, case != wi::SegmentSegment::Disjoint, meeting(&[a, b], &[c, d]))
        }
        1 => {
            let (_, [a, b, c, d]) = Kind::draw_any::<3, 4>(entropy);
            let case = wi::segment_segment_3d([a, b], [c, d]);
            let answer = wi::segments_intersect_3d([a, b], [c, d]);
            (answer, case != wi::SegmentSegment::Disjoint, meeting(&[a, b], &[c, d]))
        }
        2 => {
            let (_, [a, b, c, d, e]) = Kind::draw_any::<3, 5>(entropy);
            let case = wi::segment_triangle([a, b], [c, d, e]);
            let answer = wi::segment_intersects_triangle([a, b], [c, d, e]);
            (answer, case != wi::SegmentTriangle::Disjoint, meeting(&[a, b], &[c, d, e]))
        }
        3 | 4 => {
            let (_, [a, b, c, d, e, f]) = Kind::draw_any::<3, 6>(entropy);
            let case = wi::triangle_triangle([a, b, c], [d, e, f]);
            let answer = wi::triangles_intersect([a, b, c], [d, e, f]);
            (answer, case != wi::TriangleTriangle::Disjoint, meeting(&[a, b, c], &[d, e, f]))
        }
        5 => {
            let (_, [a, b, c, d]) = Kind::draw_any::<2, 4>(entropy);
            let case = wi::point_in_triangle_2d(d, [a, b, c]);
            let answer = wi::triangle_contains_2d([a, b, c], d);
            (answer, case != wi::PointTriangle::Disjoint, meeting(&[d], &[a, b, c]))
        }
        6 => {
            let (_, [a, b, c, d, e]) = Kind::draw_any::<3, 5>(entropy);
            let case = wi::point_in_tetrahedron(e, [a, b, c, d]);
            let answer = wi::tetrahedron_contains([a, b, c, d], e);
            (answer, case != wi::PointTetrahedron::Disjoint, meeting(&[e], &[a, b, c, d]))
        }
        7 => {
            let (_, [a, b, c, d, e]) = Kind::draw_any::<3, 5>(entropy);
            let case = wi::ray_triangle(a, b, [c, d, e]);
            let answer = wi::ray_intersects_triangle(a, b, [c, d, e]);
            (answer, case != wi::RayTriangle::Disjoint, meeting_of_ray_through(a, b, &[c, d, e]))
        }
        _ => {
            let (_, [a, b, c, d, e]) = Kind::draw_any::<3, 5>(entropy);
            let meets = wi::ray_triangle_direction(a, b, [c, d, e]) != wi::RayTriangle::Disjoint;
            (meets, meets, meeting_of_ray(a, b, &[c, d, e]))
        }
    };
    assert_eq!((answer, case), (!expected.is_empty(), !expected.is_empty()), "{expected:?}");
}

/// Points, segments and triangles against boxes drawn from the bytes.
pub fn boxes(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    let (kind, [a, b, c, q, r]) = Kind::draw_any::<3, 5>(&mut entropy);
    let (min, max) = ([0, 1, 2].map(|i| q[i].min(r[i])), [0, 1, 2].map(|i| q[i].max(r[i])));
    let meets = |operand: &[[f64; 3]]| !clip_to_box(operand, min, max).is_empty();
    let context = || format!("{kind:?} {a:?} {b:?} {c:?} {min:?} {max:?}");

    assert_eq!(wi::box_contains(min, max, a), meets(&[a]), "{}", context());
    let s = [a, b];
    assert_eq!(wi::segment_intersects_box(s, min, max), meets(&s), "{}", context());
    assert_eq!(wi::segment_box(s, min, max) != wi::SegmentBox::Disjoint, meets(&s), "{}", context());
    let t = [a, b, c];
    assert_eq!(wi::triangle_intersects_box(t, min, max), meets(&t), "{}", context());
    assert_eq!(wi::triangle_box(t, min, max) != wi::TriangleBox::Disjoint, meets(&t), "{}", context());
}
