//! A point against a tetrahedron.
//!
//! | case | the point lies |
//! | --- | --- |
//! | `Disjoint` | outside |
//! | `On(feature)` | in a proper tetrahedron: inside, or on that face, edge or vertex |
//! | `Degenerate` | in the hull of four coplanar points |
//!
//! Method: putting the point in the place of each vertex in turn must nowhere reverse the orientation; where it
//! makes it zero, the point lies on the opposite face. The hull of four coplanar points is the union of the four
//! triangles on them (Caratheodory).

use super::P3;
use super::hull::{Hull3, all_finite};
use crate::finite::check_finite;
use crate::{NonFinite, Point, orient3d};

/// The part of a tetrahedron on which a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TetrahedronFeature {
    /// Vertex 0, 1, 2 or 3.
    Vertex(u8),
    /// Strictly between the ends of the edge that joins these two vertices, in ascending order.
    Edge(u8, u8),
    /// Strictly inside face `i`, the one without vertex `i`.
    Face(u8),
    /// Strictly inside.
    Interior,
}

/// How a point lies to a tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PointTetrahedron {
    /// Outside.
    Disjoint,
    /// In the closed tetrahedron, on this feature.
    On(TetrahedronFeature),
    /// The tetrahedron is flat (coplanar, collinear or a single point), and the point lies in its hull.
    Degenerate,
}

/// How `p` lies to the tetrahedron `v`, of either orientation.
///
/// ```
/// use welter_predicates::intersection::{PointTetrahedron, TetrahedronFeature, point_in_tetrahedron};
/// let v = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
/// assert_eq!(point_in_tetrahedron([1.0, 1.0, 1.0], v), PointTetrahedron::On(TetrahedronFeature::Interior));
/// assert_eq!(point_in_tetrahedron([1.0, 1.0, 2.0], v), PointTetrahedron::On(TetrahedronFeature::Face(0)));
/// assert_eq!(point_in_tetrahedron([0.0, 2.0, 2.0], v), PointTetrahedron::On(TetrahedronFeature::Edge(2, 3)));
/// assert_eq!(point_in_tetrahedron([2.0, 2.0, 2.0], v), PointTetrahedron::Disjoint);
/// ```
pub fn point_in_tetrahedron(p: impl Point<3>, v: [impl Point<3>; 4]) -> PointTetrahedron {
    case(p.coords(), v.map(Point::coords))
}

/// True when `p` lies in the closed tetrahedron: [`point_in_tetrahedron`] is not `Disjoint`.
///
/// ```
/// use welter_predicates::intersection::tetrahedron_contains;
/// let v = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
/// assert!(tetrahedron_contains(v, [0.0, 0.0, 4.0]));
/// assert!(!tetrahedron_contains(v, [0.0, -5e-324, 0.0]));
/// ```
pub fn tetrahedron_contains(v: [impl Point<3>; 4], p: impl Point<3>) -> bool {
    point_in_tetrahedron(p, v) != PointTetrahedron::Disjoint
}

/// As [`point_in_tetrahedron`], checked; arguments are counted `p`, `v[0]`, ..., `v[3]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_point_in_tetrahedron;
/// let v = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, f64::NAN]];
/// assert_eq!(try_point_in_tetrahedron([1.0; 3], v).unwrap_err().argument, 4);
/// ```
pub fn try_point_in_tetrahedron(
    p: impl Point<3>,
    v: [impl Point<3>; 4],
) -> Result<PointTetrahedron, NonFinite> {
    let (p, v) = (p.coords(), v.map(Point::coords));
    check_finite(&[p, v[0], v[1], v[2], v[3]])?;
    Ok(case(p, v))
}

fn case(p: P3, v: [P3; 4]) -> PointTetrahedron {
    if !all_finite(&[p]) || !all_finite(&v) {
        return PointTetrahedron::Disjoint;
    }
    let inside = orient3d(v[0], v[1], v[2], v[3]);
    if inside.is_zero() {
        let faces = [[v[1], v[2], v[3]], [v[0], v[2], v[3]], [v[0], v[1], v[3]], [v[0], v[1], v[2]]];
        let meets = faces.iter().any(|face| {
            orient3d(face[0], face[1], face[2], p).is_zero() && Hull3::of_triangle(*face).contains(p)
        });
        return if meets { PointTetrahedron::Degenerate } else { PointTetrahedron::Disjoint };
    }
    let mut on = [false; 4];
    for i in 0..4 {
        let mut w = v;
        w[i] = p;
        let side = orient3d(w[0], w[1], w[2], w[3]);
        if side == -inside {
            return PointTetrahedron::Disjoint;
        }
        on[i] = side.is_zero();
    }
    PointTetrahedron::On(feature(on))
}

/// The feature of a point of the closed tetrahedron that lies on the planes of exactly these faces.
fn feature(on: [bool; 4]) -> TetrahedronFeature {
    let mut off = (0..4u8).filter(|&i| !on[usize::from(i)]);
    match (off.next(), off.next(), off.next(), off.next()) {
        (Some(i), None, ..) => TetrahedronFeature::Vertex(i),
        (Some(i), Some(j), None, _) => TetrahedronFeature::Edge(i, j),
        // The indices sum to 6.
        (Some(i), Some(j), Some(k), None) => TetrahedronFeature::Face(6 - i - j - k),
        _ => TetrahedronFeature::Interior,
    }
}
