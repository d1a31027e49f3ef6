//! Convex polygons cut by planes \[Sutherland74\].
//!
//! The point at which an edge meets a plane is computed from its end inside to its end outside, so that the
//! two polygons on an edge get the same point, bit for bit.

use glam::DVec3;

/// A corner: a point and a number that is linear on the polygon.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Corner {
    pub(super) point: DVec3,
    pub(super) value: f64,
}

/// Most corners. Cutting a polygon of n corners, convex or not, leaves at most n + n/2; six cuts of a
/// triangle at most 28.
const CAPACITY: usize = 28;

/// Most cuts of a triangle for which there is room.
#[cfg(test)]
const CUTS: usize = 6;

/// A polygon that began as a triangle and was cut six times at most.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polygon {
    corners: [Corner; CAPACITY],
    count: usize,
}

impl Polygon {
    pub(super) fn triangle(corners: [Corner; 3]) -> Self {
        let mut all = [Corner::default(); CAPACITY];
        all[..3].copy_from_slice(&corners);
        Self { corners: all, count: 3 }
    }

    pub(super) fn corners(&self) -> &[Corner] {
        &self.corners[..self.count]
    }

    /// Becomes another polygon.
    #[inline]
    pub(super) fn assign(&mut self, other: &Polygon) {
        self.count = other.count;
        self.corners[..other.count].copy_from_slice(other.corners());
    }

    /// What lies where `distance`, which is linear, is above 0. A corner at 0 is outside. Each corner that is
    /// made is passed to `settle`, which may move it onto the plane where rounding has left it beside.
    #[inline]
    pub(super) fn cut(
        &self,
        distance: impl Fn(DVec3) -> f64,
        settle: impl Fn(&mut DVec3),
        result: &mut Polygon,
    ) {
        result.count = 0;
        let Some(last) = self.corners().last() else { return };
        let (mut from, mut from_distance) = (last, distance(last.point));
        for to in self.corners() {
            let to_distance = distance(to.point);
            if (from_distance > 0.0) != (to_distance > 0.0) {
                let [(inside, d), (outside, e)] = if from_distance > 0.0 {
                    [(from, from_distance), (to, to_distance)]
                } else {
                    [(to, to_distance), (from, from_distance)]
                };
                let t = d / (d - e);
                let mut point = inside.point + t * (outside.point - inside.point);
                settle(&mut point);
                result.push(Corner { point, value: inside.value + t * (outside.value - inside.value) });
            }
            if to_distance > 0.0 {
                result.push(*to);
            }
            (from, from_distance) = (to, to_distance);
        }
    }

    #[inline]
    fn push(&mut self, corner: Corner) {
        self.corners[self.count] = corner;
        self.count += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(x: f64, y: f64) -> Corner {
        Corner { point: DVec3::new(x, y, 0.0), value: x }
    }

    #[test]
    fn the_capacity_holds_the_cuts() {
        assert_eq!((0..CUTS).fold(3, |n, _| n + n / 2), CAPACITY);
    }

    #[test]
    fn a_cut_interpolates_and_keeps_the_order() {
        let triangle = Polygon::triangle([corner(-1.0, 0.0), corner(3.0, 0.0), corner(-1.0, 4.0)]);
        let mut result = triangle;
        triangle.cut(|p| p.x, |p| p.x = 0.0, &mut result);
        assert_eq!(result.corners(), [corner(0.0, 0.0), corner(3.0, 0.0), corner(0.0, 3.0)]);
        triangle.cut(|p| p.x - 3.0, |_| (), &mut result);
        assert!(result.corners().is_empty());
    }

    #[test]
    fn neighbours_meet_in_the_same_points() {
        let (a, b) = (corner(0.1, 0.7), corner(0.9, 0.3));
        let mut results = [Polygon::triangle([a, b, corner(0.0, 0.0)]); 2];
        results[0].clone().cut(|p| p.x - 0.3, |_| (), &mut results[0]);
        Polygon::triangle([b, a, corner(1.0, 1.0)]).cut(|p| p.x - 0.3, |_| (), &mut results[1]);
        let made = |polygon: &Polygon| {
            *polygon.corners().iter().find(|c| c.point.y > 0.55 && c.point.y < 0.65).expect("on the edge")
        };
        assert_eq!(made(&results[0]), made(&results[1]));
    }
}
