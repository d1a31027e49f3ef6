//! What lies behind a triangle, as seen from the light: a prism without end.
//!
//! # What it computes
//! For a straight way between two points, in lattice coordinates, the part of it inside the three sides of
//! the prism, and inside its front, the triangle. Both are intervals, since a prism is convex; their ends
//! are exact up to rounding.
//!
//! # What it does not promise
//! That prisms of neighbouring triangles leave no gap: between their intervals there may be one, or an
//! overlap, of the size of rounding.
//!
//! # Method
//! Each side is a linear function that is above 0 inside; the way is clipped where it changes its sign.
//! Coefficients of a side that two triangles share are the same but for their sign, bit for bit, so a point
//! that is on the inner side of one is not on that of the other.

use glam::DVec3;

/// The points behind a triangle, and which way it faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Prism {
    /// Factors of the first two coordinates, and constants, of functions above 0 inside the sides.
    sides: [[f64; 3]; 3],
    /// Factors of the coordinates, and a constant, of a function above 0 behind the triangle's plane.
    front: [f64; 4],
    /// Least and largest of the corners' third coordinates.
    depths: [f64; 2],
    /// 1 if light enters there what is behind the triangle's front, -1 if it leaves.
    pub(super) sign: i32,
}

impl Prism {
    /// The prism behind a triangle; none if the light passes along it.
    pub(super) fn new(corners: &[DVec3; 3]) -> Option<Self> {
        let [a, b, c] = *corners;
        let normal = (b - a).cross(c - a);
        // Light goes along the third axis, and the normal points to where corners are counterclockwise.
        let turn = if normal.z > 0.0 {
            1.0
        } else if normal.z < 0.0 {
            -1.0
        } else {
            return None;
        };
        let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| side(from, to).map(|factor| turn * factor));
        let n = turn * normal;
        let depths = [a.z.min(b.z).min(c.z), a.z.max(b.z).max(c.z)];
        Some(Self { sides, front: [n.x, n.y, n.z, -n.dot(a)], depths, sign: -turn as i32 })
    }

    /// The part of the way between two points inside the sides, in parts of the way.
    #[inline]
    pub(super) fn below(&self, from: DVec3, to: DVec3) -> Option<[f64; 2]> {
        let mut part = [0.0, 1.0];
        let narrowed = |side: &[f64; 3]| {
            narrow_to(&mut part, [from, to].map(|p| at_side(side, p)), |value| is_inner(side, value))
        };
        let inside = self.sides.iter().all(narrowed);
        (inside && part[0] < part[1]).then_some(part)
    }

    /// The part of the way between two points behind the triangle, in parts of the way.
    #[inline]
    pub(super) fn behind(&self, from: DVec3, to: DVec3) -> Option<[f64; 2]> {
        let mut part = self.below(from, to)?;
        let inside = narrow(&mut part, self.at_front(from), self.at_front(to));
        (inside && part[0] < part[1]).then_some(part)
    }

    /// Whether a point has the triangle before or behind it.
    #[inline]
    pub(super) fn is_below(&self, point: DVec3) -> bool {
        self.sides.iter().all(|side| is_inner(side, at_side(side, point)))
    }

    /// How far a point is behind the triangle's plane along the light; no farther than behind all corners,
    /// nor before all.
    #[inline]
    pub(super) fn depth(&self, point: DVec3) -> f64 {
        let [near, far] = self.depths;
        (self.at_front(point) / self.front[2]).max(point.z - far).min(point.z - near)
    }

    /// Whether a part of a box across the light may be inside the sides; rounding does not make it miss one.
    pub(super) fn may_meet(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        const SLACK: f64 = 1.0 / (1_u64 << 44) as f64;
        self.sides.iter().all(|&[x, y, constant]| {
            let along = if x > 0.0 { x * high[0] } else { x * low[0] };
            let across = if y > 0.0 { y * high[1] } else { y * low[1] };
            along + across + constant >= -SLACK * (along.abs() + across.abs() + constant.abs())
        })
    }

    fn at_front(&self, p: DVec3) -> f64 {
        let [x, y, z, constant] = self.front;
        x * p.x + y * p.y + z * p.z + constant
    }
}

/// Factors of a function above 0 to the left of a directed edge across the light. The opposite edge has the
/// opposite ones, bit for bit.
pub(super) fn side(from: DVec3, to: DVec3) -> [f64; 3] {
    let ordered = (from.x, from.y) <= (to.x, to.y);
    let [p, q] = if ordered { [from, to] } else { [to, from] };
    let (x, y) = (p.y - q.y, q.x - p.x);
    let factors = [x, y, -(x * p.x + y * p.y)];
    if ordered { factors } else { factors.map(|factor| -factor) }
}

#[inline]
pub(super) fn at_side([x, y, constant]: &[f64; 3], p: DVec3) -> f64 {
    x * p.x + y * p.y + constant
}

/// Whether a function of a side with a value is that of a point inside. Of both sides on a shared edge one
/// counts a point on it.
#[inline]
fn is_inner([x, y, _]: &[f64; 3], value: f64) -> bool {
    value > 0.0 || (value == 0.0 && (*x > 0.0 || (*x == 0.0 && *y > 0.0)))
}

/// Narrows an interval to where a linear function with given values at 0 and 1 is above 0; whether anything
/// can be left.
#[inline]
pub(super) fn narrow(part: &mut [f64; 2], at_start: f64, at_end: f64) -> bool {
    narrow_to(part, [at_start, at_end], |value| value > 0.0)
}

/// The same, where it is told which values are inside: all above 0, none below.
#[inline]
fn narrow_to(part: &mut [f64; 2], [start, end]: [f64; 2], inside: impl Fn(f64) -> bool) -> bool {
    match (inside(start), inside(end)) {
        (true, true) => {}
        (true, false) => part[1] = part[1].min(start / (start - end)),
        (false, true) => part[0] = part[0].max(start / (start - end)),
        (false, false) => return false,
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn prism() -> Prism {
        let [a, b, c] = [DVec3::new(1.0, 1.0, 2.0), DVec3::new(5.0, 1.0, 2.0), DVec3::new(1.0, 5.0, 4.0)];
        Prism::new(&[a, b, c]).expect("it faces the light")
    }

    #[test]
    fn ways_are_clipped_to_sides_and_front() {
        let prism = prism();
        let (from, to) = (DVec3::new(0.0, 2.0, 0.0), DVec3::new(8.0, 2.0, 8.0));
        // Inside for x from 1 to 4; the plane has depth 2.5 there.
        assert_eq!(prism.below(from, to), Some([0.125, 0.5]));
        assert_eq!(prism.behind(from, to), Some([2.5 / 8.0, 0.5]));
        assert_eq!(prism.behind(to, from), Some([0.5, 1.0 - 2.5 / 8.0]));
        assert_eq!(prism.behind(from, DVec3::new(8.0, 2.0, 1.0)), None);
        assert_eq!(prism.below(DVec3::new(0.0, 6.0, 0.0), to), None);
        assert_eq!(prism.depth(DVec3::new(2.0, 2.0, 7.0)), 4.5);
        assert_eq!(prism.depth(DVec3::new(2.0, 99.0, 7.0)), 3.0, "no nearer than the farthest corner");
    }

    #[test]
    fn a_point_is_on_one_side_of_a_shared_edge() {
        let mut state = 5_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        for _ in 0..2000 {
            let mut point = || DVec3::new(9.0 * random(), 9.0 * random(), 9.0 * random());
            let (a, b) = (point(), point());
            let on_edge = a + random() * (b - a);
            let (one, other) = (side(a, b), side(b, a));
            let values = [at_side(&one, on_edge), at_side(&other, on_edge)];
            assert_eq!(values[0], -values[1]);
            assert!(is_inner(&one, values[0]) != is_inner(&other, values[1]));
            assert!(is_inner(&one, 0.0) != is_inner(&other, -0.0));
        }
    }

    #[test]
    fn the_sign_tells_which_way_light_goes_and_edges_cast_no_shadow() {
        // Seen from the light, which looks along the third axis, these corners are clockwise: light leaves.
        assert_eq!(prism().sign, -1);
        let upright = [DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.0, 1.0, 5.0)];
        assert_eq!(Prism::new(&upright), None);
        assert!(prism().may_meet([0.0, 0.0], [1.0, 1.0]) && prism().may_meet([3.0, 3.0], [9.0, 9.0]));
        assert!(!prism().may_meet([3.5, 3.5], [9.0, 9.0]) && !prism().may_meet([1.0, -3.0], [9.0, 0.5]));
    }
}
