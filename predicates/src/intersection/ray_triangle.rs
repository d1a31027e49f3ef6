//! A ray against a triangle in space; the ray goes through a point, along a vector, or along a coordinate axis.
//!
//! | case | the ray |
//! | --- | --- |
//! | `Disjoint` | misses |
//! | `Crossing { at, direction }` | meets the plane in one point, on `at.a` of the ray and `at.b` of the triangle |
//! | `CoplanarPoint(c)` | lies in the plane and touches the triangle at one point |
//! | `CoplanarSegment([c, d])` | lies in the plane and shares with the triangle the segment from `c` to `d`, in its own direction |
//! | `Degenerate { a, b }` | meets the triangle, and the ray is a single point (`a`) or the triangle degenerate (`b`) |
//!
//! `direction` is the sign of the ray's direction times the normal `(t1 - t0) x (t2 - t0)`: positive when the ray
//! leaves a solid whose boundary is oriented outward. Parity or winding by rays is exact where every crossing has
//! `at.b == Interior`; any other case calls for another ray.
//!
//! Method: three orientations of the line to the edges decide whether it stabs the triangle, and in which
//! direction; one of the origin to the plane decides whether that lies ahead. Along a coordinate axis the former
//! are `orient2d` of the projections, the cheapest form. Along a vector `d` they are the signs of
//! `d . ((s - o) x (t - o))`, evaluated in floating point with an error bound and otherwise in integers.

use super::direction::triple_sign;
use super::hull::{Hull3, all_finite};
use super::planar::{Carrier, Heading, project, proper_axis};
use super::segment_triangle::stab;
use super::{Contact, P3, SegmentFeature, TriangleFeature};
use crate::finite::check_finite;
use crate::{NonFinite, Point, Sign, orient2d, orient3d};

/// The part of a ray on which a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RayFeature {
    /// The point where the ray starts.
    Origin,
    /// Strictly after it.
    Interior,
}

/// How a ray and a triangle meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RayTriangle {
    /// No common point.
    Disjoint,
    /// The ray, not in the plane, meets the triangle at one point.
    Crossing {
        /// Where.
        at: Contact<RayFeature, TriangleFeature>,
        /// The sign of the ray's direction times the triangle's normal: `Positive` when it leaves through the
        /// side to which the normal points. Never `Zero`.
        direction: Sign,
    },
    /// The ray lies in the plane and meets the triangle at one point.
    CoplanarPoint(Contact<RayFeature, TriangleFeature>),
    /// The ray lies in the plane; the ends of the common segment, in the direction of the ray.
    CoplanarSegment([Contact<RayFeature, TriangleFeature>; 2]),
    /// They meet, and at least one is degenerate.
    Degenerate {
        /// The ray has no direction: it is its origin.
        a: bool,
        /// The triangle is collinear or a single point.
        b: bool,
    },
}

impl RayTriangle {
    /// True when the interior of the ray crosses the interior of the triangle.
    #[must_use]
    pub fn is_proper(self) -> bool {
        matches!(
            self,
            Self::Crossing { at: Contact { a: RayFeature::Interior, b: TriangleFeature::Interior }, .. }
        )
    }
}

/// How the ray from `origin` through the point `through` meets the triangle `t`.
///
/// ```
/// use welter_predicates::Sign;
/// use welter_predicates::intersection::{RayTriangle, ray_triangle};
/// let t = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// let up = ray_triangle([1.0, 1.0, -9.0], [1.0, 1.0, -8.0], t);
/// assert!(up.is_proper());
/// assert!(matches!(up, RayTriangle::Crossing { direction: Sign::Positive, .. }));
/// assert_eq!(ray_triangle([1.0, 1.0, -9.0], [1.0, 1.0, -10.0], t), RayTriangle::Disjoint);
/// ```
pub fn ray_triangle(origin: impl Point<3>, through: impl Point<3>, t: [impl Point<3>; 3]) -> RayTriangle {
    case(&Ray { origin: origin.coords(), along: Along::Point(through.coords()) }, t.map(Point::coords))
}

/// True when the closed ray through a point and the closed triangle meet: [`ray_triangle`] is not `Disjoint`.
///
/// ```
/// use welter_predicates::intersection::ray_intersects_triangle;
/// let t = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// assert!(ray_intersects_triangle([1.0, 1.0, -9.0], [1.0, 1.0, -8.0], t));
/// ```
pub fn ray_intersects_triangle(origin: impl Point<3>, through: impl Point<3>, t: [impl Point<3>; 3]) -> bool {
    ray_triangle(origin, through, t) != RayTriangle::Disjoint
}

/// How the ray from `origin` along the vector `direction` meets the triangle `t`. The direction counts as it is:
/// no sum `origin + direction` is formed, which would round.
///
/// ```
/// use welter_predicates::intersection::{RayTriangle, ray_triangle_direction};
/// let t = [[0.0, 0.0, 1e300], [4.0, 0.0, 1e300], [0.0, 4.0, 1e300]];
/// assert!(ray_triangle_direction([1.0, 1.0, -1e300], [0.0, 0.0, 1e-300], t).is_proper());
/// assert_eq!(ray_triangle_direction([1.0, 1.0, 0.0], [1e-290, 0.0, 1.0], t), RayTriangle::Disjoint);
/// ```
pub fn ray_triangle_direction(
    origin: impl Point<3>,
    direction: impl Point<3>,
    t: [impl Point<3>; 3],
) -> RayTriangle {
    case(&Ray { origin: origin.coords(), along: Along::Vector(direction.coords()) }, t.map(Point::coords))
}

/// How the ray from `origin` along coordinate axis `axis % 3`, towards greater values if `positive`, meets the
/// triangle `t`. The fastest form.
///
/// ```
/// use welter_predicates::intersection::{RayTriangle, ray_triangle_axis};
/// let t = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// assert!(ray_triangle_axis([1.0, 1.0, -9.0], 2, true, t).is_proper());
/// assert_eq!(ray_triangle_axis([1.0, 1.0, -9.0], 2, false, t), RayTriangle::Disjoint);
/// ```
pub fn ray_triangle_axis(
    origin: impl Point<3>,
    axis: usize,
    positive: bool,
    t: [impl Point<3>; 3],
) -> RayTriangle {
    case(&Ray { origin: origin.coords(), along: Along::Axis(axis % 3, positive) }, t.map(Point::coords))
}

/// As [`ray_triangle`], checked; arguments are counted `origin`, `through`, `t[0]`, `t[1]`, `t[2]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_ray_triangle;
/// let t = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// assert_eq!(try_ray_triangle([0.0; 3], [0.0, 0.0, f64::INFINITY], t).unwrap_err().argument, 1);
/// ```
pub fn try_ray_triangle(
    origin: impl Point<3>,
    through: impl Point<3>,
    t: [impl Point<3>; 3],
) -> Result<RayTriangle, NonFinite> {
    let (o, p, t) = (origin.coords(), through.coords(), t.map(Point::coords));
    check_finite(&[o, p, t[0], t[1], t[2]])?;
    Ok(ray_triangle(o, p, t))
}

/// As [`ray_triangle_direction`], checked; arguments are counted `origin`, `direction`, `t[0]`, `t[1]`, `t[2]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_ray_triangle_direction;
/// let t = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
/// assert!(try_ray_triangle_direction([0.0; 3], [0.0, 0.0, f64::NAN], t).is_err());
/// ```
pub fn try_ray_triangle_direction(
    origin: impl Point<3>,
    direction: impl Point<3>,
    t: [impl Point<3>; 3],
) -> Result<RayTriangle, NonFinite> {
    let (o, d, t) = (origin.coords(), direction.coords(), t.map(Point::coords));
    check_finite(&[o, d, t[0], t[1], t[2]])?;
    Ok(ray_triangle_direction(o, d, t))
}

/// As [`ray_triangle_axis`], checked; arguments are counted `origin`, `t[0]`, `t[1]`, `t[2]`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_ray_triangle_axis;
/// let t = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, f64::NAN]];
/// assert_eq!(try_ray_triangle_axis([0.0; 3], 2, true, t).unwrap_err().argument, 3);
/// ```
pub fn try_ray_triangle_axis(
    origin: impl Point<3>,
    axis: usize,
    positive: bool,
    t: [impl Point<3>; 3],
) -> Result<RayTriangle, NonFinite> {
    let (o, t) = (origin.coords(), t.map(Point::coords));
    check_finite(&[o, t[0], t[1], t[2]])?;
    Ok(ray_triangle_axis(o, axis, positive, t))
}

/// What gives a ray its direction.
#[derive(Clone, Copy, Debug)]
enum Along {
    Point(P3),
    Vector(P3),
    Axis(usize, bool),
}

#[derive(Clone, Copy, Debug)]
struct Ray {
    origin: P3,
    along: Along,
}

impl Ray {
    fn is_finite(&self) -> bool {
        match self.along {
            Along::Point(p) | Along::Vector(p) => all_finite(&[self.origin, p]),
            Along::Axis(..) => all_finite(&[self.origin]),
        }
    }

    /// The sign of each component of the direction.
    fn signs(&self) -> [Sign; 3] {
        match self.along {
            Along::Point(p) => core::array::from_fn(|k| Sign::of_difference(p[k], self.origin[k])),
            Along::Vector(d) => d.map(Sign::of),
            Along::Axis(axis, positive) => {
                let sign = if positive { Sign::Positive } else { Sign::Negative };
                core::array::from_fn(|k| if k == axis { sign } else { Sign::Zero })
            }
        }
    }

    /// True when the triangle lies wholly behind the origin or beside the ray along some coordinate axis.
    #[inline]
    fn misses_box(&self, t: &[P3; 3]) -> bool {
        let signs = self.signs();
        (0..3).any(|k| {
            let o = self.origin[k];
            (signs[k] != Sign::Positive && t.iter().all(|p| p[k] > o))
                || (signs[k] != Sign::Negative && t.iter().all(|p| p[k] < o))
        })
    }

    /// `-sign(d . ((s - o) x (t - o)))`: the sign of `orient3d(o, o + d, s, t)`.
    #[inline]
    fn edge(&self, s: P3, t: P3) -> Sign {
        match self.along {
            Along::Point(p) => orient3d(self.origin, p, s, t),
            Along::Vector(d) => -triple_sign(d, self.origin, s, t),
            Along::Axis(axis, positive) => {
                let sign = orient2d(project(self.origin, axis), project(s, axis), project(t, axis));
                if positive { -sign } else { sign }
            }
        }
    }

    /// The ray in the projection along `axis`.
    fn projected(&self, axis: usize) -> Carrier {
        let heading = match self.along {
            Along::Point(p) => Heading::Through(project(p, axis)),
            Along::Vector(d) => Heading::Vector(project(d, axis)),
            Along::Axis(..) => Heading::Vector(project(self.unit(), axis)),
        };
        Carrier::ray(project(self.origin, axis), heading)
    }

    fn unit(&self) -> P3 {
        self.signs().map(|sign| f64::from(sign as i8))
    }

    /// True when `p` lies on the ray, which has a direction.
    fn contains(&self, p: P3) -> bool {
        let signs = self.signs();
        p == self.origin
            || (0..3).all(|k| {
                Sign::of_difference(p[k], self.origin[k]) == signs[k]
                    && self.projected(k).side(project(p, k)).is_zero()
            })
    }

    /// True when the ray, which has a direction, meets a proper segment.
    fn meets_segment(&self, [p, q]: [P3; 2]) -> bool {
        if !self.edge(p, q).is_zero() {
            return false;
        }
        // Coplanar. Where the ray and the segment span a plane, some projection keeps it; else all are collinear.
        for axis in 0..3 {
            let ray = self.projected(axis);
            let (p2, q2) = (project(p, axis), project(q, axis));
            // A projection along the ray sees it as a point, with all sides zero.
            if !ray.side(p2).is_zero() || !ray.side(q2).is_zero() {
                return ray.ray_meets_segment([p2, q2]);
            }
        }
        // Collinear: a segment that holds the origin has an end ahead of it.
        self.contains(p) || self.contains(q)
    }
}

fn case(ray: &Ray, t: [P3; 3]) -> RayTriangle {
    if ray.misses_box(&t) || !all_finite(&t) || !ray.is_finite() {
        return RayTriangle::Disjoint;
    }
    let Some((at, edges)) = stab(|i| ray.edge(t[i], t[(i + 1) % 3])) else {
        return RayTriangle::Disjoint;
    };
    if edges.is_zero() {
        return flat(ray, t);
    }
    // The three edge volumes add up to minus the direction times the normal.
    let direction = -edges;
    let height = -orient3d(t[0], t[1], t[2], ray.origin);
    let on_ray = if height.is_zero() {
        RayFeature::Origin
    } else if height == -direction {
        RayFeature::Interior
    } else {
        return RayTriangle::Disjoint;
    };
    RayTriangle::Crossing { at: Contact::new(on_ray, at), direction }
}

/// The ray lies in the plane of the triangle, or one of them is degenerate.
fn flat(ray: &Ray, t: [P3; 3]) -> RayTriangle {
    let is_point = ray.signs() == [Sign::Zero; 3];
    let axis = proper_axis(t);
    if is_point || axis.is_none() {
        let meets = match Hull3::of_triangle(t) {
            hull if is_point => hull.contains(ray.origin),
            Hull3::Point(p) => ray.contains(p),
            Hull3::Segment(s) => ray.meets_segment(s),
            Hull3::Triangle(_) => false,
        };
        return if meets {
            RayTriangle::Degenerate { a: is_point, b: axis.is_none() }
        } else {
            RayTriangle::Disjoint
        };
    }
    let Some(axis) = axis else { return RayTriangle::Disjoint };
    let name = |a| if a == SegmentFeature::Interior { RayFeature::Interior } else { RayFeature::Origin };
    let ends = ray.projected(axis).clip(t.map(|p| project(p, axis))).get();
    match ends.map(|end| end.map(|(a, b)| Contact::new(name(a), b))) {
        [Some(one), Some(two)] => RayTriangle::CoplanarSegment([one, two]),
        [Some(one), None] => RayTriangle::CoplanarPoint(one),
        _ => RayTriangle::Disjoint,
    }
}
