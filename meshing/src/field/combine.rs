//! Unions, intersections and differences of fields, sharp or blended: [`Union`], [`Intersection`], [`Difference`].
//!
//! # Method
//! The least value for a union, the greatest for an intersection \[Hart96\]; what is removed is negated. Blended, the least of `a` and
//! `b` is the polynomial smooth minimum [`smooth_min`], with `w` the width of the blend and `h = max(w - |a - b|, 0)`:
//! ```text
//! m(a, b) = min(a, b) - h^2 / (4 w)       gradient = (1 - h / 2w) grad(lesser) + (h / 2w) grad(greater)
//! ```
//! It is continuously differentiable in `a` and `b`, rises with each of them, and its gradient is a convex combination of theirs: so a
//! bound of a distance stays one. It differs from the sharp minimum only where `|a - b| < w`, by at most `w / 4`, where `a = b`.
//!
//! More than two parts are blended in order, each with what came before, which for three and more depends on their order. By
//! induction the result is never below `min - w`: were it there it would differ by `w` from every part.
//!
//! # What it promises
//! * Sharp: a distance outside of a union and inside of an intersection of exact distances, a bound elsewhere.
//! * De Morgan's laws hold bit for bit: an intersection is the negated union of the negated parts, blended or not.
//! * Two parts may be exchanged without changing a bit of the value.

use glam::DVec3;

use crate::field::error::{require, require_length_or_zero};
use crate::field::{FieldError, ScalarField, nodes};
use crate::grid::Grid3;
use crate::spatial::Box3;
use crate::{Cancelled, Monitor};

/// The smooth minimum of two numbers: the least of them, less at most a quarter of `width` where they differ by less than `width`.
///
/// ```
/// use welter_meshing::field::smooth_min;
/// assert_eq!(smooth_min(1.0, 3.0, 2.0), 1.0);
/// assert_eq!(smooth_min(1.0, 1.0, 2.0), 0.5);
/// assert_eq!(smooth_min(1.0, 1.5, 0.0), 1.0);
/// ```
#[inline]
#[must_use]
pub fn smooth_min(a: f64, b: f64, width: f64) -> f64 {
    let depth = (width - (a - b).abs()).max(0.0);
    // NaN in either is NaN in the result, which `f64::min` does not do.
    let least = if a.is_nan() || a <= b { a } else { b };
    if depth > 0.0 { least - depth * depth / (4.0 * width) } else { least }
}

/// The smooth maximum: `-smooth_min(-a, -b, width)`.
#[inline]
#[must_use]
pub fn smooth_max(a: f64, b: f64, width: f64) -> f64 {
    -smooth_min(-a, -b, width)
}

/// Value and gradient of the smooth minimum; of equal values without a blend the first counts.
fn blend(a: (f64, DVec3), b: (f64, DVec3), width: f64) -> (f64, DVec3) {
    let value = smooth_min(a.0, b.0, width);
    let (lesser, greater) = if b.0 < a.0 { (b.1, a.1) } else { (a.1, b.1) };
    let depth = (width - (a.0 - b.0).abs()).max(0.0);
    let share = if depth > 0.0 { depth / (2.0 * width) } else { 0.0 };
    (value, if share > 0.0 { (1.0 - share) * lesser + share * greater } else { lesser })
}

/// What a blend of `parts` fields may take off the least of them.
fn deepest(parts: usize, width: f64) -> f64 {
    width * (0.25 * parts.saturating_sub(1) as f64).min(1.0)
}

/// Everything that is in one of the parts; without parts, positive infinity everywhere.
///
/// Its gradient where two sharp parts are equal is that of the first.
///
/// ```
/// use welter_meshing::{DVec3, field::{Ball, ScalarField, Union}};
/// let at = |x| Ball { center: DVec3::new(x, 0.0, 0.0), radius: 0.5 };
/// let sharp = Union { parts: vec![at(-0.5), at(0.5)], blend_width: 0.0 };
/// assert_eq!(sharp.value(DVec3::ZERO), 0.0);
/// let blended = Union { blend_width: 0.4, ..sharp };
/// assert!((blended.value(DVec3::ZERO) + 0.1).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Union<F> {
    /// What is united.
    pub parts: Vec<F>,
    /// Difference of values below which two parts are blended, 0 or a length. Default: 0, sharp.
    pub blend_width: f64,
}

/// Everything that is in all of the parts; without parts, negative infinity everywhere.
///
/// Its gradient where two sharp parts are equal is that of the first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Intersection<F> {
    /// What is intersected.
    pub parts: Vec<F>,
    /// Difference of values below which two parts are blended, 0 or a length. Default: 0, sharp.
    pub blend_width: f64,
}

/// What is in one field and not in the other.
///
/// Its gradient where both are equal in magnitude is that of `from`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference<A, B> {
    /// What something is taken from.
    pub from: A,
    /// What is taken away.
    pub removed: B,
    /// Difference of values below which they are blended, 0 or a length. Default: 0, sharp.
    pub blend_width: f64,
}

fn validate(parts: usize, width: f64) -> Result<(), FieldError> {
    require(parts > 0, "number of parts", parts as f64, "at least 1")?;
    require_length_or_zero("blend_width", width)
}

impl<F> Union<F> {
    /// Whether there is a part and the blend is in range.
    ///
    /// # Errors
    /// [`FieldError`] if not.
    pub fn validate(&self) -> Result<(), FieldError> {
        validate(self.parts.len(), self.blend_width)
    }
}

impl<F> Intersection<F> {
    /// Whether there is a part and the blend is in range.
    ///
    /// # Errors
    /// [`FieldError`] if not.
    pub fn validate(&self) -> Result<(), FieldError> {
        validate(self.parts.len(), self.blend_width)
    }
}

impl<A, B> Difference<A, B> {
    /// Whether the blend is in range.
    ///
    /// # Errors
    /// [`FieldError`] if not.
    pub fn validate(&self) -> Result<(), FieldError> {
        validate(2, self.blend_width)
    }
}

/// Folds values and gradients of parts by the smooth minimum, each with its sign turned if `negated`.
fn folded<F: ScalarField>(parts: &[F], point: DVec3, step: f64, width: f64, sign: f64) -> (f64, DVec3) {
    let each = parts.iter().map(|part| (sign * part.value(point), sign * part.gradient(point, step)));
    each.reduce(|a, b| blend(a, b, width)).unwrap_or((f64::INFINITY, DVec3::ZERO))
}

impl<F: ScalarField> ScalarField for Union<F> {
    fn value(&self, point: DVec3) -> f64 {
        let values = self.parts.iter().map(|part| part.value(point));
        values.reduce(|a, b| smooth_min(a, b, self.blend_width)).unwrap_or(f64::INFINITY)
    }

    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        folded(&self.parts, point, step, self.blend_width, 1.0).1
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        let level = level + deepest(self.parts.len(), self.blend_width);
        self.parts
            .iter()
            .try_fold(Box3::EMPTY, |around, part| Some(around.union(&part.sublevel_bounds(level)?)))
    }

    fn knows_nodes(&self) -> bool {
        self.parts.iter().any(ScalarField::knows_nodes)
    }

    fn at_nodes(&self, grid: &Grid3, monitor: &Monitor<'_>) -> Result<Vec<f64>, Cancelled> {
        if !self.knows_nodes() {
            return nodes::one_by_one(self, grid, monitor);
        }
        let joined = |a, b| smooth_min(a, b, self.blend_width);
        nodes::folded(&self.parts, f64::INFINITY, grid, monitor, joined)
    }
}

impl<F: ScalarField> ScalarField for Intersection<F> {
    fn value(&self, point: DVec3) -> f64 {
        let values = self.parts.iter().map(|part| part.value(point));
        values.reduce(|a, b| smooth_max(a, b, self.blend_width)).unwrap_or(f64::NEG_INFINITY)
    }

    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        -folded(&self.parts, point, step, self.blend_width, -1.0).1
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        // A smooth maximum is at least each part.
        self.parts.iter().filter_map(|part| part.sublevel_bounds(level)).reduce(|a, b| common(&a, &b))
    }

    fn knows_nodes(&self) -> bool {
        self.parts.iter().any(ScalarField::knows_nodes)
    }

    fn at_nodes(&self, grid: &Grid3, monitor: &Monitor<'_>) -> Result<Vec<f64>, Cancelled> {
        if !self.knows_nodes() {
            return nodes::one_by_one(self, grid, monitor);
        }
        let joined = |a, b| smooth_max(a, b, self.blend_width);
        nodes::folded(&self.parts, f64::NEG_INFINITY, grid, monitor, joined)
    }
}

impl<A: ScalarField, B: ScalarField> ScalarField for Difference<A, B> {
    fn value(&self, point: DVec3) -> f64 {
        smooth_max(self.from.value(point), -self.removed.value(point), self.blend_width)
    }

    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        let from = (-self.from.value(point), -self.from.gradient(point, step));
        let removed = (self.removed.value(point), self.removed.gradient(point, step));
        -blend(from, removed, self.blend_width).1
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        self.from.sublevel_bounds(level)
    }

    fn knows_nodes(&self) -> bool {
        self.from.knows_nodes() || self.removed.knows_nodes()
    }

    fn at_nodes(&self, grid: &Grid3, monitor: &Monitor<'_>) -> Result<Vec<f64>, Cancelled> {
        if !self.knows_nodes() {
            return nodes::one_by_one(self, grid, monitor);
        }
        let (from, removed) = (self.from.at_nodes(grid, monitor)?, self.removed.at_nodes(grid, monitor)?);
        Ok(nodes::joined(from, &removed, |a, b| smooth_max(a, -b, self.blend_width)))
    }
}

/// The points of both boxes.
fn common(a: &Box3, b: &Box3) -> Box3 {
    let common = Box3 { min: a.min.max(b.min), max: a.max.min(b.max) };
    if common.is_empty() { Box3::EMPTY } else { common }
}
