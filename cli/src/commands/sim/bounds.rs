//! Boxes along the axes, for a view that holds a whole run: [`Bounds`].

use glam::DVec3;
use welter_fluids::procedural::Path;

/// A box, from its least to its greatest coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
}

impl Bounds {
    /// Around a point, as far to all sides.
    pub(super) fn around(center: DVec3, reach: f64) -> Self {
        Self { low: center - DVec3::splat(reach), high: center + DVec3::splat(reach) }
    }

    /// The least one that holds all points; none without any.
    pub(super) fn of(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        points.into_iter().map(|p| Self { low: p, high: p }).reduce(Self::joined)
    }

    /// The least one that holds both.
    pub(super) fn joined(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Larger by a length on every side.
    pub(super) fn grown(self, by: f64) -> Self {
        Self { low: self.low - DVec3::splat(by), high: self.high + DVec3::splat(by) }
    }

    /// What it covers while it is displaced along a path.
    pub(super) fn along(self, path: Option<&Path>) -> Self {
        let keys = path.map_or(&[][..], |path| path.keys());
        let displaced = |&(_, by): &(f64, DVec3)| Self { low: self.low + by, high: self.high + by };
        keys.iter().map(displaced).reduce(Self::joined).unwrap_or(self)
    }

    pub(super) fn middle(&self) -> DVec3 {
        0.5 * self.low + 0.5 * self.high
    }

    pub(super) fn diagonal(&self) -> f64 {
        self.low.distance(self.high)
    }

    pub(super) fn corners(&self) -> [DVec3; 8] {
        let ends = [self.low, self.high];
        std::array::from_fn(|k| DVec3::new(ends[k & 1].x, ends[k >> 1 & 1].y, ends[k >> 2].z))
    }
}
