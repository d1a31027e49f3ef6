//! The intersection predicates against the enumeration of barycentric weights (`welter_kit::exact::meeting`).
//!
//! The oracle gives the corners of the common set with the faces they lie on; a case of the predicates, rewritten as a
//! set of pairs of faces, must be that set. Every test also counts the cases it saw and fails if one is missing.

mod boxes;
mod laws;
mod points;
mod rays;
mod segments;
mod triangles;

use crate::family::check;
use proptest::test_runner::TestCaseError;
use std::cell::RefCell;
use std::collections::BTreeMap;
use welter_kit::exact::{Meeting, lift, linear};
use welter_kit::generate::{Kind, points};
use welter_predicates::intersection::{Contact, RayFeature, SegmentFeature, TriangleFeature};

/// A feature as the set of generators of its face, as the oracle names it.
pub(crate) trait Face: Copy {
    fn bits(self) -> u32;
}

impl Face for SegmentFeature {
    fn bits(self) -> u32 {
        match self {
            Self::Vertex(i) => 1 << i,
            Self::Interior => 0b11,
        }
    }
}

impl Face for TriangleFeature {
    fn bits(self) -> u32 {
        match self {
            Self::Vertex(i) => 1 << i,
            Self::Edge(i) => 1 << i | 1 << ((i + 1) % 3),
            Self::Interior => 0b111,
        }
    }
}

impl Face for RayFeature {
    fn bits(self) -> u32 {
        match self {
            Self::Origin => 0b01,
            Self::Interior => 0b11,
        }
    }
}

/// A case in the words of the oracle.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Case {
    Disjoint,
    /// They meet and one is degenerate; which.
    Degenerate(bool, bool),
    /// The corners of the common set as pairs of faces, sorted, and whether both operands lie in one plane.
    Meeting {
        corners: Vec<(u32, u32)>,
        coplanar: bool,
    },
}

/// The case of contacts that a predicate reports.
pub(crate) fn reported<A: Face, B: Face>(contacts: &[Contact<A, B>], coplanar: bool) -> Case {
    let mut corners: Vec<(u32, u32)> = contacts.iter().map(|c| (c.a.bits(), c.b.bits())).collect();
    corners.sort_unstable();
    Case::Meeting { corners, coplanar }
}

/// The case that the oracle finds for operands given by `a` and `b`.
pub(crate) fn expected<const D: usize>(found: &Meeting, a: &[[f64; D]], b: &[[f64; D]]) -> Case {
    if found.is_empty() {
        return Case::Disjoint;
    }
    let degenerate = [a, b].map(|operand| dimension(operand) + 1 < operand.len());
    if degenerate != [false, false] {
        return Case::Degenerate(degenerate[0], degenerate[1]);
    }
    let mut corners: Vec<(u32, u32)> = found.corners.iter().map(|c| (c.face_a, c.face_b)).collect();
    corners.sort_unstable();
    Case::Meeting { corners, coplanar: dimension(&[a, b].concat()) <= 2 }
}

/// The dimension of the affine hull of points.
pub(crate) fn dimension<const D: usize>(points: &[[f64; D]]) -> usize {
    let homogeneous: Vec<Vec<_>> =
        lift(points).into_iter().map(|p| p.into_iter().chain([1.into()]).collect()).collect();
    linear::affine_dimension(&homogeneous).expect("at least one point")
}

/// Checks a property on every kind of input; the property names the case it saw, and all of `wanted` must turn up.
pub(crate) fn on_every_kind<const D: usize, const N: usize>(
    cases: u32,
    wanted: &[&str],
    property: impl Fn([[f64; D]; N]) -> Result<&'static str, TestCaseError>,
) {
    let seen = RefCell::new(BTreeMap::<&str, u32>::new());
    for kind in Kind::ALL {
        // The oracle's numbers are hundreds of times longer where exponents are spread.
        let wide = matches!(kind, Kind::Exponents | Kind::Mixed | Kind::SignedZero);
        check(kind, if wide { cases / 8 } else { cases }, &points::<D, N>(kind), |p| {
            *seen.borrow_mut().entry(property(p)?).or_default() += 1;
            Ok(())
        });
    }
    let seen = seen.into_inner();
    for case in wanted {
        assert!(seen.contains_key(case), "no input led to {case}: {seen:?}");
    }
}
