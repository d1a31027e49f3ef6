//! Closed axis-parallel boxes with exact comparisons: [`Box3`].

use glam::DVec3;

/// A closed box `[min.x, max.x] x [min.y, max.y] x [min.z, max.z]`; empty where `min > max` on an axis.
///
/// ```
/// use welter_meshing::{DVec3, spatial::Box3};
/// let a = Box3::of([DVec3::ZERO, DVec3::ONE]);
/// let b = Box3::of([DVec3::ONE, DVec3::splat(2.0)]);
/// assert!(a.meets(&b), "closed boxes that touch meet");
/// assert!(!a.meets(&Box3::EMPTY));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Box3 {
    /// The corner with the smallest coordinates.
    pub min: DVec3,
    /// The corner with the largest coordinates.
    pub max: DVec3,
}

impl Box3 {
    /// The box of no points.
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box around points.
    #[inline]
    #[must_use]
    pub fn of(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| Self { min: b.min.min(p), max: b.max.max(p) })
    }

    /// The smallest box around both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Whether no point lies in the box.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Whether the closed boxes have a common point.
    #[inline]
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Whether the closed box contains the point.
    #[inline]
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        self.min.cmple(point).all() && point.cmple(self.max).all()
    }
}
