//! Two triangles in space.
//!
//! | case | the triangles |
//! | --- | --- |
//! | `Disjoint` | have no common point |
//! | `Point(c)` | lie in different planes and touch at one point |
//! | `Segment([c, d])` | lie in different planes and share a segment; its ends |
//! | `CoplanarPoint(c)` | lie in one plane and touch at one point |
//! | `CoplanarSegment([c, d])` | lie in one plane and share a segment; its ends |
//! | `CoplanarArea(cs)` | lie in one plane and share an area; its 3 to 6 corners |
//! | `Degenerate { a, b }` | meet, and the first (`a`) or the second (`b`) is collinear or a single point |
//!
//! Method: the sides of each triangle's vertices to the plane of the other. The yes-or-no form then compares the
//! two intervals on the common line by two orientations \[Guigue03\]; the case form collects the ends of the common
//! set, each of which lies on an edge of one of the triangles, by six segment-triangle questions.

use super::hull::{Hull3, all_finite, boxes_disjoint};
use super::plane;
use super::segment_triangle::with_sides;
use super::{Contact, P3, SegmentTriangle, TriangleFeature};
use crate::finite::check_finite;
use crate::{NonFinite, Point, Sign, orient3d};

/// A common point of two triangles.
pub type TriangleContact = Contact<TriangleFeature, TriangleFeature>;

/// How two triangles meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TriangleTriangle {
    /// No common point.
    Disjoint,
    /// In different planes, one common point.
    Point(TriangleContact),
    /// In different planes, a common segment with these ends.
    Segment([TriangleContact; 2]),
    /// In one plane, one common point.
    CoplanarPoint(TriangleContact),
    /// In one plane, a common segment with these ends.
    CoplanarSegment([TriangleContact; 2]),
    /// In one plane, a common area with these corners.
    CoplanarArea(Corners),
    /// They meet, and at least one is degenerate.
    Degenerate {
        /// The first triangle is collinear or a single point.
        a: bool,
        /// The second triangle is collinear or a single point.
        b: bool,
    },
}

impl TriangleTriangle {
    /// The ends or corners of the common set; empty for `Disjoint` and `Degenerate`.
    #[must_use]
    pub fn contacts(&self) -> &[TriangleContact] {
        match self {
            Self::Disjoint | Self::Degenerate { .. } => &[],
            Self::Point(contact) | Self::CoplanarPoint(contact) => core::slice::from_ref(contact),
            Self::Segment(ends) | Self::CoplanarSegment(ends) => ends,
            Self::CoplanarArea(corners) => corners.as_slice(),
        }
    }
}

/// The corners of the common area of two coplanar triangles, at least 3 and at most 6: first those on the
/// boundary of the first triangle, along its edges 0, 1 and 2, then the vertices of the second strictly inside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Corners {
    contacts: [TriangleContact; Self::MOST],
    count: u8,
}

impl Corners {
    /// Each edge of a convex polygon of the two triangles' intersection lies on an edge of one of them, and on
    /// each of those six there is at most one.
    const MOST: usize = 6;
    const NONE: Self = Self {
        contacts: [Contact { a: TriangleFeature::Interior, b: TriangleFeature::Interior }; Self::MOST],
        count: 0,
    };

    /// The corners.
    #[must_use]
    pub fn as_slice(&self) -> &[TriangleContact] {
        &self.contacts[..usize::from(self.count)]
    }

    fn insert(&mut self, contact: TriangleContact) {
        if !self.as_slice().contains(&contact) {
            self.contacts[usize::from(self.count)] = contact;
            self.count += 1;
        }
    }
}

/// How the triangles `a` and `b` meet.
///
/// ```
/// use welter_predicates::intersection::{TriangleFeature, TriangleTriangle, triangle_triangle};
/// let a = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// let b = [[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [9.0, 9.0, 0.0]];
/// let TriangleTriangle::Segment([one, two]) = triangle_triangle(a, b) else { panic!() };
/// assert_eq!((one.a, one.b), (TriangleFeature::Edge(1), TriangleFeature::Interior));
/// assert_eq!((two.a, two.b), (TriangleFeature::Interior, TriangleFeature::Edge(0)));
/// assert_eq!(triangle_triangle(a, a).contacts().len(), 3);
/// let above = a.map(|[x, y, _]| [x, y, 5e-324]);
/// assert_eq!(triangle_triangle(a, above), TriangleTriangle::Disjoint);
/// ```
pub fn triangle_triangle(a: [impl Point<3>; 3], b: [impl Point<3>; 3]) -> TriangleTriangle {
    case(a.map(Point::coords), b.map(Point::coords))
}

/// True when the closed triangles meet: [`triangle_triangle`] is not `Disjoint`. The fast form.
///
/// ```
/// use welter_predicates::intersection::triangles_intersect;
/// let a = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// assert!(triangles_intersect(a, [[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [9.0, 9.0, 0.0]]));
/// assert!(!triangles_intersect(a, [[3.0, 3.0, -1.0], [3.0, 3.0, 1.0], [9.0, 9.0, 0.0]]));
/// ```
#[inline]
pub fn triangles_intersect(a: [impl Point<3>; 3], b: [impl Point<3>; 3]) -> bool {
    fast(&a.map(Point::coords), &b.map(Point::coords))
}

/// As [`triangle_triangle`], checked; arguments are counted `a[0]`, ..., `b[2]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_triangle_triangle;
/// let a = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// let b = [[0.0; 3], [1.0; 3], [1.0, 2.0, f64::NEG_INFINITY]];
/// let error = try_triangle_triangle(a, b).unwrap_err();
/// assert_eq!((error.argument, error.coordinate), (5, 2));
/// ```
pub fn try_triangle_triangle(
    a: [impl Point<3>; 3],
    b: [impl Point<3>; 3],
) -> Result<TriangleTriangle, NonFinite> {
    let (a, b) = (a.map(Point::coords), b.map(Point::coords));
    check_finite(&[a[0], a[1], a[2], b[0], b[1], b[2]])?;
    Ok(case(a, b))
}

/// The sides of the vertices of `a` to the plane of `b`; `None` when all are strictly on one.
#[inline(always)]
fn sides(a: &[P3; 3], b: &[P3; 3]) -> Option<[Sign; 3]> {
    let sides = plane::sides(b, a);
    if sides == [Sign::Positive; 3] || sides == [Sign::Negative; 3] { None } else { Some(sides) }
}

fn fast(a: &[P3; 3], b: &[P3; 3]) -> bool {
    if boxes_disjoint(a, b) {
        return false;
    }
    let Some(of_a) = sides(a, b) else { return false };
    if of_a == [Sign::Zero; 3] {
        return case(*a, *b) != TriangleTriangle::Disjoint;
    }
    let Some(of_b) = sides(b, a) else { return false };
    if of_b == [Sign::Zero; 3] {
        return case(*a, *b) != TriangleTriangle::Disjoint;
    }
    // Both are proper, in different planes, and each meets the plane of the other. They are finite, too: to the
    // plane of a triangle that is not, every side is zero.
    let (i, side_a) = lone_vertex(of_a);
    let (j, side_b) = lone_vertex(of_b);
    let [p, mut q, mut r] = [a[i], a[(i + 1) % 3], a[(i + 2) % 3]];
    let [u, mut v, mut w] = [b[j], b[(j + 1) % 3], b[(j + 2) % 3]];
    if side_a == Sign::Negative {
        (v, w) = (w, v);
    }
    if side_b == Sign::Negative {
        (q, r) = (r, q);
    }
    // Now `p` sees `u`, `v`, `w` as positive and `u` sees `p`, `q`, `r` so. On the common line the first triangle
    // covers the interval from edge pq to edge pr, the second that from uw to uv.
    orient3d(p, q, u, v) != Sign::Positive && orient3d(p, r, u, w) != Sign::Negative
}

/// The vertex that is alone on its side of a plane that the triangle meets but does not lie in, and that side.
/// A vertex on the plane counts to whichever side leaves one vertex alone.
#[inline]
fn lone_vertex(s: [Sign; 3]) -> (usize, Sign) {
    for i in 0..3 {
        if !s[i].is_zero() && s[(i + 1) % 3] != s[i] && s[(i + 2) % 3] != s[i] {
            return (i, s[i]);
        }
    }
    // Two vertices strictly on one side, the third on the plane.
    let i = if s[0].is_zero() {
        0
    } else if s[1].is_zero() {
        1
    } else {
        2
    };
    (i, -s[(i + 1) % 3])
}

fn case(a: [P3; 3], b: [P3; 3]) -> TriangleTriangle {
    if boxes_disjoint(&a, &b) || !all_finite(&a) || !all_finite(&b) {
        return TriangleTriangle::Disjoint;
    }
    let (Some(of_a), Some(of_b)) = (sides(&a, &b), sides(&b, &a)) else {
        return TriangleTriangle::Disjoint;
    };
    if of_a == [Sign::Zero; 3] || of_b == [Sign::Zero; 3] {
        // Coplanar, or one of them has no plane.
        let hulls = [Hull3::of_triangle(a), Hull3::of_triangle(b)];
        let proper = hulls.map(|hull| hull.is_triangle());
        if proper != [true, true] {
            return if hulls[0].meets(&hulls[1]) {
                TriangleTriangle::Degenerate { a: !proper[0], b: !proper[1] }
            } else {
                TriangleTriangle::Disjoint
            };
        }
    }
    contacts(a, b, of_a, of_b)
}

/// The case of two proper triangles.
pub(super) fn proper_triangles(a: [P3; 3], b: [P3; 3]) -> TriangleTriangle {
    match (sides(&a, &b), sides(&b, &a)) {
        (Some(of_a), Some(of_b)) => contacts(a, b, of_a, of_b),
        _ => TriangleTriangle::Disjoint,
    }
}

fn contacts(a: [P3; 3], b: [P3; 3], of_a: [Sign; 3], of_b: [Sign; 3]) -> TriangleTriangle {
    let mut found = Corners::NONE;
    for i in 0..3 {
        let j = (i + 1) % 3;
        each_end(with_sides([a[i], a[j]], b, [of_a[i], of_a[j]]), |at, on_b| {
            found.insert(Contact::new(TriangleFeature::of_edge_point(i, at), on_b));
        });
    }
    for i in 0..3 {
        let j = (i + 1) % 3;
        each_end(with_sides([b[i], b[j]], a, [of_b[i], of_b[j]]), |at, on_a| {
            found.insert(Contact::new(on_a, TriangleFeature::of_edge_point(i, at)));
        });
    }
    let coplanar = of_a == [Sign::Zero; 3];
    match (found.as_slice(), coplanar) {
        ([], _) => TriangleTriangle::Disjoint,
        (&[one], false) => TriangleTriangle::Point(one),
        (&[one], true) => TriangleTriangle::CoplanarPoint(one),
        (&[one, two], false) => TriangleTriangle::Segment([one, two]),
        (&[one, two], true) => TriangleTriangle::CoplanarSegment([one, two]),
        _ => TriangleTriangle::CoplanarArea(found),
    }
}

fn each_end(case: SegmentTriangle, mut take: impl FnMut(super::SegmentFeature, TriangleFeature)) {
    match case {
        SegmentTriangle::Disjoint | SegmentTriangle::Degenerate { .. } => {}
        SegmentTriangle::Crossing(c) | SegmentTriangle::CoplanarPoint(c) => take(c.a, c.b),
        SegmentTriangle::CoplanarSegment([c, d]) => {
            take(c.a, c.b);
            take(d.a, d.b);
        }
    }
}
