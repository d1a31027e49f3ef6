//! A point against a triangle, in the plane and in space.
//!
//! | case | the point lies |
//! | --- | --- |
//! | `Disjoint` | outside |
//! | `On(Interior)`, `On(Edge(i))`, `On(Vertex(i))` | in a proper triangle, on that feature |
//! | `Degenerate` | in the hull of three collinear or coincident points |

use super::hull::{Hull2, Hull3, all_finite};
use super::planar::{locate, locate_in_plane};
use super::{P2, P3, TriangleFeature};
use crate::finite::check_finite;
use crate::{NonFinite, Point, Sign, orient2d, orient3d};

/// How a point lies to a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PointTriangle {
    /// Outside.
    Disjoint,
    /// In the closed triangle, on this feature.
    On(TriangleFeature),
    /// The triangle is collinear or a single point, and the point lies in its hull.
    Degenerate,
}

/// How `p` lies to the triangle `t` of the plane, of either orientation.
///
/// ```
/// use welter_predicates::intersection::{PointTriangle, TriangleFeature, point_in_triangle_2d};
/// let t = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]];
/// assert_eq!(point_in_triangle_2d([1.0, 1.0], t), PointTriangle::On(TriangleFeature::Interior));
/// assert_eq!(point_in_triangle_2d([2.0, 2.0], t), PointTriangle::On(TriangleFeature::Edge(1)));
/// assert_eq!(point_in_triangle_2d([3.0, 3.0], t), PointTriangle::Disjoint);
/// let flat = [[0.0, 0.0], [1.0, 1.0], [4.0, 4.0]];
/// assert_eq!(point_in_triangle_2d([2.0, 2.0], flat), PointTriangle::Degenerate);
/// ```
pub fn point_in_triangle_2d(p: impl Point<2>, t: [impl Point<2>; 3]) -> PointTriangle {
    case_2d(p.coords(), t.map(Point::coords))
}

/// True when `p` lies in the closed triangle: [`point_in_triangle_2d`] is not `Disjoint`.
///
/// ```
/// use welter_predicates::intersection::triangle_contains_2d;
/// assert!(triangle_contains_2d([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]], [0.0, 4.0]));
/// ```
pub fn triangle_contains_2d(t: [impl Point<2>; 3], p: impl Point<2>) -> bool {
    point_in_triangle_2d(p, t) != PointTriangle::Disjoint
}

/// As [`point_in_triangle_2d`], checked; arguments are counted `p`, `t[0]`, `t[1]`, `t[2]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_point_in_triangle_2d;
/// let t = [[0.0, 0.0], [4.0, 0.0], [0.0, f64::NAN]];
/// assert_eq!(try_point_in_triangle_2d([1.0, 1.0], t).unwrap_err().argument, 3);
/// ```
pub fn try_point_in_triangle_2d(p: impl Point<2>, t: [impl Point<2>; 3]) -> Result<PointTriangle, NonFinite> {
    let (p, t) = (p.coords(), t.map(Point::coords));
    check_finite(&[p, t[0], t[1], t[2]])?;
    Ok(case_2d(p, t))
}

/// How `p` lies to the triangle `t` of space.
///
/// ```
/// use welter_predicates::intersection::{PointTriangle, TriangleFeature, point_in_triangle_3d};
/// let t = [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
/// assert_eq!(point_in_triangle_3d([1.0, 1.0, 2.0], t), PointTriangle::On(TriangleFeature::Interior));
/// assert_eq!(point_in_triangle_3d([0.0, 0.0, 4.0], t), PointTriangle::On(TriangleFeature::Vertex(2)));
/// assert_eq!(point_in_triangle_3d([1.0, 1.0, 1.0], t), PointTriangle::Disjoint);
/// ```
pub fn point_in_triangle_3d(p: impl Point<3>, t: [impl Point<3>; 3]) -> PointTriangle {
    case_3d(p.coords(), t.map(Point::coords))
}

/// True when `p` lies in the closed triangle: [`point_in_triangle_3d`] is not `Disjoint`.
///
/// ```
/// use welter_predicates::intersection::triangle_contains_3d;
/// assert!(!triangle_contains_3d([[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]], [1.0, 1.0, 1e-300]));
/// ```
pub fn triangle_contains_3d(t: [impl Point<3>; 3], p: impl Point<3>) -> bool {
    point_in_triangle_3d(p, t) != PointTriangle::Disjoint
}

/// As [`point_in_triangle_3d`], checked; arguments are counted `p`, `t[0]`, `t[1]`, `t[2]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_point_in_triangle_3d;
/// let t = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// assert!(try_point_in_triangle_3d([1.0, f64::INFINITY, 0.0], t).is_err());
/// ```
pub fn try_point_in_triangle_3d(p: impl Point<3>, t: [impl Point<3>; 3]) -> Result<PointTriangle, NonFinite> {
    let (p, t) = (p.coords(), t.map(Point::coords));
    check_finite(&[p, t[0], t[1], t[2]])?;
    Ok(case_3d(p, t))
}

fn case_2d(p: P2, t: [P2; 3]) -> PointTriangle {
    if !all_finite(&[p, t[0], t[1], t[2]]) {
        return PointTriangle::Disjoint;
    }
    if orient2d(t[0], t[1], t[2]) == Sign::Zero {
        return degenerate(Hull2::of_triangle(t).contains(p));
    }
    locate(p, t).map_or(PointTriangle::Disjoint, PointTriangle::On)
}

fn case_3d(p: P3, t: [P3; 3]) -> PointTriangle {
    if !all_finite(&[p, t[0], t[1], t[2]]) || !orient3d(t[0], t[1], t[2], p).is_zero() {
        return PointTriangle::Disjoint;
    }
    let hull = Hull3::of_triangle(t);
    if !hull.is_triangle() {
        return degenerate(hull.contains(p));
    }
    locate_in_plane(p, t).map_or(PointTriangle::Disjoint, PointTriangle::On)
}

fn degenerate(meets: bool) -> PointTriangle {
    if meets { PointTriangle::Degenerate } else { PointTriangle::Disjoint }
}
