//! Triangle against triangle.

use super::{Case, expected, on_every_kind, reported};
use proptest::prelude::*;
use welter_kit::exact::meeting;
use welter_predicates::intersection::{TriangleTriangle, triangle_triangle, triangles_intersect};

#[test]
fn triangle_and_triangle() {
    let wanted = [
        "disjoint",
        "degenerate",
        "point",
        "segment",
        "coplanar point",
        "coplanar segment",
        "coplanar area of 3",
        "coplanar area of 4",
        "coplanar area of 5",
        "coplanar area of 6",
    ];
    on_every_kind::<3, 6>(2500, &wanted, |[a0, a1, a2, b0, b1, b2]| {
        let (a, b) = ([a0, a1, a2], [b0, b1, b2]);
        let (answer, found) = (triangle_triangle(a, b), meeting(&a, &b));
        let contacts = answer.contacts();
        let (case, name) = match &answer {
            TriangleTriangle::Disjoint => (Case::Disjoint, "disjoint"),
            TriangleTriangle::Degenerate { a, b } => (Case::Degenerate(*a, *b), "degenerate"),
            TriangleTriangle::Point(_) => (reported(contacts, false), "point"),
            TriangleTriangle::Segment(_) => (reported(contacts, false), "segment"),
            TriangleTriangle::CoplanarPoint(_) => (reported(contacts, true), "coplanar point"),
            TriangleTriangle::CoplanarSegment(_) => (reported(contacts, true), "coplanar segment"),
            TriangleTriangle::CoplanarArea(corners) => {
                let name = wanted[6 + corners.as_slice().len() - 3];
                (reported(contacts, true), name)
            }
        };
        prop_assert_eq!(case, expected(&found, &a, &b));
        prop_assert_eq!(triangles_intersect(a, b), !found.is_empty());
        let dimension = match answer {
            TriangleTriangle::Point(_) | TriangleTriangle::CoplanarPoint(_) => Some(0),
            TriangleTriangle::Segment(_) | TriangleTriangle::CoplanarSegment(_) => Some(1),
            TriangleTriangle::CoplanarArea(_) => Some(2),
            TriangleTriangle::Disjoint | TriangleTriangle::Degenerate { .. } => return Ok(name),
        };
        prop_assert_eq!(found.dimension(), dimension);
        Ok(name)
    });
}
