//! [`FlatTriangle`]: squared distances of eight points to a triangle in single precision, with a bound of their error.
//!
//! # What it promises
//! For points and triangles in the frame of a scene (`spatial::frame`), points at most `reach >= 1` from its middle along an
//! axis: the square root of the value differs from the distance of the exact point to the exact triangle, degenerate or not, by at
//! most [`tolerance`]`(reach)`.
//!
//! # Method
//! The triangle has a frame of its own, computed in double precision: its origin at one end of the longest edge, the first axis
//! along that edge, the second in its plane toward the third corner, the third normal to it. A point is taken into that frame; the
//! distance in the plane is 0 inside of the three edges and between the ends of the longest, else the least of the distances to them; that and
//! the height above the plane give the distance. Since the first axis is the longest edge, the third corner lies above that
//! edge, and where it lies so little above it that the second axis is not well defined, any will do.
//!
//! # The bound
//! In units of e = 2^-24 reach. A coordinate relative to the origin is at most 2 and errs by 4 (the point's and the origin's roundings 1
//! each, that of the difference 2), the vector by 7. An axis errs by 1 / reach per component, so a coordinate in the
//! triangle's frame errs by 7 + 3.5 from these and 10.5 from three products and two sums of at most 3.5 reach: 21. A
//! coordinate along another edge comes from two of them, with as many roundings again: 50. Such an error changes the distance to an edge by
//! as much. A point that errs by 50 in its sides may be taken to be inside where it is outside; since the longest edge is the base, and the
//! point lies between its ends, it is no farther than twice that from the triangle, at the apex, whose angle is 60 degrees or more. (Without the
//! ends of the base it might be far beyond the tip of a needle.) So the distance in the plane errs by 100, and with the height
//! above it, 21, by at most 103. The squares, sums and constants of the triangle, which are at most 2, add less than 19.
//! Together 122, less than the 128 that are 2^-17 reach.

use glam::{DVec2, DVec3, Vec4};

/// Height of a triangle over its longest edge below which its direction is not looked for; part of that edge. With it the
/// direction is known to 2^-12, and better after one correction; without it the triangle is displaced by that much, far below the
/// tolerance.
const FLAT: f64 = 1.0 / (1u64 << 40) as f64;

/// Points that are looked at together.
pub(super) const LANES: usize = 8;

/// Bound on the error of a distance, see the head.
pub(super) fn tolerance(reach: f64) -> f64 {
    reach / (1 << 17) as f64
}

/// Numbers of eight points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lanes(pub(super) [Vec4; 2]);

impl Lanes {
    pub(super) fn splat(value: f32) -> Self {
        Self([Vec4::splat(value); 2])
    }

    pub(super) fn of(values: [f32; LANES]) -> Self {
        let [a, b, c, d, e, f, g, h] = values;
        Self([Vec4::new(a, b, c, d), Vec4::new(e, f, g, h)])
    }

    pub(super) fn to_array(self) -> [f32; LANES] {
        let ([a, b, c, d], [e, f, g, h]) = (self.0[0].to_array(), self.0[1].to_array());
        [a, b, c, d, e, f, g, h]
    }

    #[inline(always)]
    pub(super) fn map(self, f: impl Fn(Vec4) -> Vec4) -> Self {
        // Not `array::map`, which is not inlined here.
        Self([f(self.0[0]), f(self.0[1])])
    }

    #[inline(always)]
    pub(super) fn min(self, other: Self) -> Self {
        Self([self.0[0].min(other.0[0]), self.0[1].min(other.0[1])])
    }

    /// Whether one at least is not greater than the other's.
    #[inline(always)]
    pub(super) fn any_at_most(self, other: Self) -> bool {
        (self.0[0].cmple(other.0[0]) | self.0[1].cmple(other.0[1])).any()
    }
}

/// Eight points in the frame of the scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Points {
    pub(super) x: Lanes,
    pub(super) y: Lanes,
    pub(super) z: Lanes,
}

impl Points {
    /// A function of each of the points.
    #[inline(always)]
    pub(super) fn each(&self, f: impl Fn(Vec4, Vec4, Vec4) -> Vec4) -> Lanes {
        let ([x0, x1], [y0, y1], [z0, z1]) = (self.x.0, self.y.0, self.z.0);
        Lanes([f(x0, y0, z0), f(x1, y1, z1)])
    }
}

/// Square roots, by the vector unit.
#[inline(always)]
pub(super) fn square_root(v: Vec4) -> Vec4 {
    let [a, b, c, d] = v.to_array();
    Vec4::new(a.sqrt(), b.sqrt(), c.sqrt(), d.sqrt())
}

/// A triangle in its own frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlatTriangle {
    origin: [f32; 3],
    axes: [[f32; 3]; 3],
    /// Unit directions and lengths of the edges in the plane; the first runs along the first axis.
    base: f32,
    second: Edge,
    third: Edge,
    /// Whether the computed distance in double precision is known no better than this one.
    pub(super) sliver: bool,
}

/// An edge of the triangle in its plane.
#[derive(Clone, Copy, Debug)]
struct Edge {
    start: [f32; 2],
    direction: [f32; 2],
    length: f32,
}

impl Edge {
    fn between(a: DVec2, b: DVec2) -> Self {
        let along = b - a;
        let length = along.length();
        let direction = if length > 0.0 { along / length } else { DVec2::X };
        let single = |v: DVec2| [v.x as f32, v.y as f32];
        Self { start: single(a), direction: single(direction), length: length as f32 }
    }

    /// Squared distances to the edge, and on which side the points are, positive inside.
    #[inline(always)]
    fn distance(&self, x: Vec4, y: Vec4) -> (Vec4, Vec4) {
        let (x, y) = (x - self.start[0], y - self.start[1]);
        let [u, v] = self.direction;
        let (along, across) = (x * u + y * v, y * u - x * v);
        let beyond = along - along.max(Vec4::ZERO).min(Vec4::splat(self.length));
        (beyond * beyond + across * across, across)
    }
}

impl FlatTriangle {
    /// The triangle with these corners in the frame of the scene.
    pub(super) fn of(corners: [DVec3; 3]) -> Self {
        let length = |e: usize| (corners[(e + 1) % 3] - corners[e]).length_squared();
        let longest = (1..3).fold(0, |best, e| if length(e) > length(best) { e } else { best });
        let [a, b, c] = [0, 1, 2].map(|k| corners[(longest + k) % 3]);
        let base = b - a;
        let x = base.try_normalize().unwrap_or(DVec3::X);
        let across = (c - a) - x * (c - a).dot(x);
        // What is left of a sliver may be rounding alone, in any direction.
        let y = if across.length() > FLAT * base.length() {
            let across = across.normalize();
            (across - x * across.dot(x)).normalize()
        } else {
            x.any_orthonormal_vector()
        };
        let (base, apex) = (base.dot(x), DVec2::new((c - a).dot(x), (c - a).dot(y)));
        let single = |v: DVec3| v.to_array().map(|t| t as f32);
        Self {
            origin: single(a),
            axes: [single(x), single(y), single(x.cross(y))],
            base: base as f32,
            second: Edge::between(DVec2::new(base, 0.0), apex),
            third: Edge::between(apex, DVec2::ZERO),
            sliver: is_sliver(corners),
        }
    }

    /// Squared distances of the points.
    #[inline(always)]
    pub(super) fn squared_distances(&self, points: &Points) -> Lanes {
        points.each(|x, y, z| {
            let (x, y, z) = (x - self.origin[0], y - self.origin[1], z - self.origin[2]);
            let along = |axis: &[f32; 3]| x * axis[0] + y * axis[1] + z * axis[2];
            let (u, v, w) = (along(&self.axes[0]), along(&self.axes[1]), along(&self.axes[2]));
            let beyond = u - u.max(Vec4::ZERO).min(Vec4::splat(self.base));
            let first = beyond * beyond + v * v;
            let (second, second_side) = self.second.distance(u, v);
            let (third, third_side) = self.third.distance(u, v);
            let along_base = u.min(self.base - u);
            let inside = along_base.min(v.min(second_side).min(third_side)).cmpge(Vec4::ZERO);
            let in_plane = Vec4::select(inside, Vec4::ZERO, first.min(second).min(third));
            in_plane + w * w
        })
    }
}

/// Whether the error of `spatial::closest` for the triangle is more than 2^-34 of its edges: it is 2^-48 over the square of
/// the sine of the angle at the first corner.
fn is_sliver([a, b, c]: [DVec3; 3]) -> bool {
    const SINE_SQUARED: f64 = 1.0 / (1 << 14) as f64;
    let (u, v) = (b - a, c - a);
    let square = u.cross(v).length_squared();
    // Also where it is NaN or lost to underflow.
    !(square > SINE_SQUARED * u.length_squared() * v.length_squared() && square > f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spatial::closest::triangle_distance;

    #[test]
    fn the_error_stays_within_its_bound() {
        let mut state = 7_u32;
        let mut unit = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 23) - 1.0
        };
        let mut worst = 0.0_f64;
        for k in 0..3000 {
            let mut point = |size: f64| DVec3::new(unit(), unit(), unit()) * size;
            let reach = [1.0, 1.0, 30.0][k % 3];
            // Stout ones of all sizes, needles and caps down to none of any height; the longest edge anywhere.
            let (a, size, flat) =
                (point(0.5), 0.5 / f64::from(1 << (k % 11)), 8_f64.powi(-((k % 20) as i32)));
            let (b, apex) = (a + point(size), point(size));
            let c = a + (b - a) * 0.3 + apex * if k % 20 == 19 { 0.0 } else { flat };
            let mut corners = [a, b, c];
            corners.rotate_left(k % 3);
            let flat = FlatTriangle::of(corners);
            let points: [DVec3; LANES] = std::array::from_fn(|lane| match lane {
                0 => a + point(0.01),
                1 => b + (b - a) * 0.1,
                2 => (a + b + c) / 3.0 + point(1e-5),
                _ => point(reach),
            });
            let lanes = |axis: usize| Lanes::of(points.map(|p| p[axis] as f32));
            let found = flat.squared_distances(&Points { x: lanes(0), y: lanes(1), z: lanes(2) });
            for (p, square) in points.into_iter().zip(found.to_array()) {
                let reach = p.abs().max_element().max(1.0);
                // In double precision slivers are right to 2^-15 of an edge only; both ways give the distance of a point of theirs.
                let mut exact = triangle_distance(corners.map(|q| q - p));
                if flat.sliver {
                    exact = exact.min(by_pieces(corners, p));
                }
                worst = worst.max((f64::from(square).sqrt() - exact).abs() / tolerance(reach));
            }
        }
        assert!(worst < 122.0 / 128.0 && worst > 0.02, "{worst} of the tolerance");
    }

    /// About the distance to a sliver, by a search among the segments from its first corner.
    fn by_pieces([a, b, c]: [DVec3; 3], p: DVec3) -> f64 {
        let to_segment = |t: f64| {
            let (end, start) = (b + (c - b) * t, a);
            let along = end - start;
            let s = ((p - start).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            let s = if s.is_nan() { 0.0 } else { s };
            (start + along * s - p).length()
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..100 {
            let (x, y) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if to_segment(x) < to_segment(y) { high = y } else { low = x }
        }
        to_segment(0.5 * (low + high)).min(to_segment(0.0)).min(to_segment(1.0))
    }
}
