//! Scalar fields in space: [`ScalarField`]. A surface is where a field is zero; it is negative inside and positive outside.
//!
//! # What it computes
//! | field | value | |
//! | --- | --- | --- |
//! | [`Ball`], [`Cuboid`] (also rounded), [`Torus`], [`Capsule`], [`Cylinder`], [`Ellipsoid`], [`HalfSpace`] | signed distance | exact |
//! | [`MeshDistance`] | signed distance to a closed mesh | exact up to rounding, see there |
//! | [`Text`] | strokes of a pen, extruded | exact outside, a bound inside |
//! | [`Gyroid`] | scaled triply periodic function | a bound |
//! | [`Union`], [`Intersection`], [`Difference`], sharp or blended | least and greatest of parts | a bound |
//! | [`Offset`], [`Shell`], [`Complement`] | shifted, folded, negated | as told there |
//! | [`Placed`] | rotated, scaled, moved | as the field within |
//! | [`Affine`] | stretched and sheared | no distance |
//! | [`GradientNoise`], [`FractalNoise`], [`Displaced`] | noise | no distance |
//!
//! *Exact* means the distance in real arithmetic up to a few roundings of the coordinates; *a bound* means that the magnitude is at
//! most the distance to the zero set, because the field changes by at most one per unit of length \[Hart96\].
//!
//! # What it promises
//! * The same bits on every machine: square roots and `libm` alone.
//! * NaN comes out only for points and parameters that are not finite or beyond 1e150, and NaN in a part is NaN in what is made of it.
//! * Gradients are those of the formula. Where the field has a kink, that of one side: each type tells which.
//! * Values are defined for parameters out of range too; `validate` of a type, or its constructor, refuses those.
//!
//! # What it does not promise
//! A distance where sharp parts are combined: the least of two distances is one outside of a union, and a bound inside.
//!
//! # Composition
//! Types are generic over the fields in them; where the shape of the composition is known only when the program runs, every node is
//! an [`AnyField`].
//!
//! ```
//! use welter_meshing::{DVec3, field::{AnyField, Ball, Cuboid, Difference, ScalarField}};
//! let ball = Ball { radius: 1.0, ..Ball::default() };
//! let cube = Cuboid { min: DVec3::ZERO, max: DVec3::ONE, rounding: 0.0 };
//! let bitten = Difference { from: ball, removed: cube, blend_width: 0.0 };
//! assert!(bitten.value(DVec3::splat(0.25)) > 0.0 && bitten.value(DVec3::splat(-0.25)) < 0.0);
//! let dynamic = Difference { from: AnyField::new(ball), removed: AnyField::new(cube), blend_width: 0.0 };
//! assert_eq!(dynamic.value(DVec3::X), bitten.value(DVec3::X));
//! ```

mod any;
mod combine;
mod displaced;
mod error;
mod gyroid;
mod level;
mod mesh;
mod nodes;
mod noise;
mod placed;
mod primitives;
#[cfg(test)]
mod tests;
pub mod text;

pub use any::AnyField;
pub use combine::{Difference, Intersection, Union, smooth_max, smooth_min};
pub use displaced::Displaced;
pub use error::FieldError;
pub use gyroid::Gyroid;
pub use level::{Complement, Offset, Shell};
pub use mesh::MeshDistance;
pub use noise::{FractalNoise, GradientNoise, NOISE_BOUND};
pub use placed::{Affine, Placed, rotation_about};
pub use primitives::{Ball, Capsule, Cuboid, Cylinder, Ellipsoid, HalfSpace, Torus};
pub use text::{Caps, Text, TextShape};

use glam::DVec3;

use crate::grid::Grid3;
use crate::spatial::Box3;
use crate::{Cancelled, Monitor};

/// A number at each point of space. Negative inside of the surface that it stands for, positive outside.
///
/// Every function of a point is one:
///
/// ```
/// use welter_meshing::{DVec3, field::ScalarField};
/// let ball = |p: DVec3| p.length() - 1.0;
/// assert_eq!(ball.value(DVec3::ZERO), -1.0);
/// assert!(ball.gradient(DVec3::X, 1e-3).abs_diff_eq(DVec3::X, 1e-6));
/// ```
pub trait ScalarField: Sync {
    /// The value at a point.
    fn value(&self, point: DVec3) -> f64;

    /// The gradient at a point. Fields without a closed form take central differences over `step` to each side, a
    /// length over which the field changes little; others do not look at it.
    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        let along = |axis: DVec3| self.value(point + step * axis) - self.value(point - step * axis);
        DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)) / (2.0 * step)
    }

    /// A box outside of which the field is positive, if it is known.
    fn bounds(&self) -> Option<Box3> {
        self.sublevel_bounds(0.0)
    }

    /// A box outside of which the field is greater than `level`, up to rounding, if it is known: what [`ScalarField::bounds`] of
    /// this field plus a constant needs.
    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        let _ = level;
        None
    }

    /// Whether [`ScalarField::at_nodes`] knows a faster way than one node after the other.
    fn knows_nodes(&self) -> bool {
        false
    }

    /// The values at all nodes of a grid in the order of node numbers, the same bits as of [`ScalarField::value`]; in parallel.
    ///
    /// # Errors
    /// [`Cancelled`] by the monitor.
    fn at_nodes(&self, grid: &Grid3, monitor: &Monitor<'_>) -> Result<Vec<f64>, Cancelled> {
        nodes::one_by_one(self, grid, monitor)
    }
}

impl<F: Fn(DVec3) -> f64 + Sync> ScalarField for F {
    fn value(&self, point: DVec3) -> f64 {
        self(point)
    }
}

/// The box grown by a length on all sides; empty where a negative one leaves nothing.
fn grown(around: &Box3, by: f64) -> Box3 {
    let grown = Box3 { min: around.min - by, max: around.max + by };
    if grown.is_empty() { Box3::EMPTY } else { grown }
}

/// The unit vector along `v`, or `otherwise` if it has no direction.
fn direction(v: DVec3, otherwise: DVec3) -> DVec3 {
    let size = v.abs().max_element();
    if size > 0.0 && size.is_finite() {
        let v = v / size;
        v / v.length()
    } else {
        otherwise
    }
}
