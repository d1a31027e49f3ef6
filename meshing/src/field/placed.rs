//! Fields elsewhere: [`Placed`] (rotated, scaled, moved) and [`Affine`] (stretched, sheared).
//!
//! # Method
//! The field of a moved body at a point is that of the body at the point moved back. A similarity changes all lengths by its scale, so
//! the value is multiplied by it and a distance stays one; any other linear map changes lengths by direction.

use glam::{DMat3, DVec3};

use crate::field::error::{require, require_coordinates, require_length};
use crate::field::{FieldError, ScalarField, direction};
use crate::shapes::MAX_LENGTH;
use crate::spatial::Box3;

/// The rotation about an axis (of any length) by degrees, counterclockwise seen from the axis' head. Multiples of 90 degrees have no
/// rounding in their sine and cosine.
///
/// ```
/// use welter_meshing::{DVec3, field::rotation_about};
/// assert_eq!(rotation_about(DVec3::Z, 90.0) * DVec3::X, DVec3::Y);
/// ```
#[must_use]
pub fn rotation_about(axis: DVec3, degrees: f64) -> DMat3 {
    let n = direction(axis, DVec3::Z);
    let turn = degrees % 360.0;
    let quarters = turn / 90.0;
    let (sin, cos) = if quarters == quarters.trunc() {
        [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][(quarters as i32).rem_euclid(4) as usize]
    } else {
        libm::sincos(turn.to_radians())
    };
    let cross = DMat3::from_cols_array(&[0.0, n.z, -n.y, -n.z, 0.0, n.x, n.y, -n.x, 0.0]);
    let outer = DMat3::from_cols(n * n.x, n * n.y, n * n.z);
    DMat3::from_diagonal(DVec3::splat(cos)) + cross * sin + outer * (1.0 - cos)
}

/// A field scaled, then rotated, then moved; of a distance it is the distance to the moved body.
///
/// ```
/// use welter_meshing::{DVec3, field::{Cuboid, Placed, ScalarField, rotation_about}};
/// let cube = Placed { scale: 0.5, translation: DVec3::X, ..Placed::of(Cuboid::default()) };
/// assert_eq!(cube.value(DVec3::new(3.5, 0.0, 0.0)), 2.0);
/// let turned = Placed { rotation: rotation_about(DVec3::Z, 45.0), ..cube };
/// assert!(turned.value(DVec3::new(1.6, 0.0, 0.0)) < 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed<F> {
    /// What is moved.
    pub field: F,
    /// A rotation: [`rotation_about`] or a product of such. Default: none.
    pub rotation: DMat3,
    /// The same factor for all lengths, a positive length. Default: 1.
    pub scale: f64,
    /// Where the origin goes. Default: it stays.
    pub translation: DVec3,
}

/// How far the columns of a rotation may be from orthonormal: the rounding of a product of thousands of rotations.
const ORTHONORMAL: f64 = 1e-9;

impl<F> Placed<F> {
    /// The field where it is.
    pub const fn of(field: F) -> Self {
        Self { field, rotation: DMat3::IDENTITY, scale: 1.0, translation: DVec3::ZERO }
    }

    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`FieldError`] with the first that is not.
    pub fn validate(&self) -> Result<(), FieldError> {
        let r = self.rotation;
        let off = (r.transpose() * r - DMat3::IDENTITY)
            .to_cols_array()
            .iter()
            .fold(0.0, |a: f64, b| a.max(b.abs()));
        let rotates = off <= ORTHONORMAL && r.determinant() > 0.0;
        require(rotates, "rotation", off, "orthonormal to 1e-9 and not a reflection")?;
        require_length("scale", self.scale)?;
        require_coordinates("translation", self.translation)
    }
}

impl<F: ScalarField> ScalarField for Placed<F> {
    fn value(&self, point: DVec3) -> f64 {
        self.scale * self.field.value(self.rotation.transpose() * (point - self.translation) / self.scale)
    }

    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        let within = self.rotation.transpose() * (point - self.translation) / self.scale;
        self.rotation * self.field.gradient(within, step / self.scale)
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        let within = self.field.sublevel_bounds(level / self.scale)?;
        Some(image(&within, self.rotation * self.scale, self.translation))
    }
}

/// A field under a linear map and a translation. Values stay as they are, so of a distance it is none, but its sign is right.
///
/// ```
/// use welter_meshing::{DVec3, field::{Affine, Ball, ScalarField}};
/// let matrix = glam::DMat3::from_diagonal(DVec3::new(1.0, 2.0, 0.5));
/// let egg = Affine::new(Ball::default(), matrix, DVec3::ZERO)?;
/// assert!(egg.value(1.9 * DVec3::Y) < 0.0 && egg.value(0.6 * DVec3::Z) > 0.0);
/// # Ok::<(), welter_meshing::field::FieldError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine<F> {
    field: F,
    matrix: DMat3,
    inverse: DMat3,
    translation: DVec3,
}

impl<F> Affine<F> {
    /// The field under `p -> matrix p + translation`.
    ///
    /// # Errors
    /// [`FieldError`] for a matrix without inverse, and for numbers out of range.
    pub fn new(field: F, matrix: DMat3, translation: DVec3) -> Result<Self, FieldError> {
        require_coordinates("translation", translation)?;
        for entry in matrix.to_cols_array() {
            require(entry.abs() <= MAX_LENGTH, "matrix", entry, "at most 1e75 in magnitude")?;
        }
        let determinant = matrix.determinant();
        if determinant == 0.0 || !determinant.is_finite() {
            return Err(FieldError::Singular { determinant });
        }
        let inverse = matrix.inverse();
        if !inverse.is_finite() {
            return Err(FieldError::Singular { determinant });
        }
        Ok(Self { field, matrix, inverse, translation })
    }
}

impl<F: ScalarField> ScalarField for Affine<F> {
    fn value(&self, point: DVec3) -> f64 {
        self.field.value(self.inverse * (point - self.translation))
    }

    fn gradient(&self, point: DVec3, step: f64) -> DVec3 {
        // The step within is the length that the map takes to `step` on average over directions.
        let within = step / libm::cbrt(self.matrix.determinant().abs());
        self.inverse.transpose() * self.field.gradient(self.inverse * (point - self.translation), within)
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        Some(image(&self.field.sublevel_bounds(level)?, self.matrix, self.translation))
    }
}

/// The box around the image of a box.
fn image(around: &Box3, matrix: DMat3, translation: DVec3) -> Box3 {
    if around.is_empty() {
        return Box3::EMPTY;
    }
    let corner = |k: usize| {
        let pick = |axis: usize| if k >> axis & 1 == 0 { around.min[axis] } else { around.max[axis] };
        matrix * DVec3::new(pick(0), pick(1), pick(2)) + translation
    };
    Box3::of((0..8).map(corner))
}
