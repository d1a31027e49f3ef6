//! [`FieldError`]: why there is no such field.

use glam::DVec3;
use thiserror::Error;

use crate::shapes::{MAX_LENGTH, MIN_LENGTH};

/// Why the parameters of a field are refused.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum FieldError {
    /// A parameter is outside its range.
    #[error("{parameter} is {value:?}, must be {range}")]
    Parameter {
        /// Its field name.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// The range it must lie in.
        range: &'static str,
    },
    /// A linear map that takes space to a plane, a line or a point, or has numbers that are not finite.
    #[error("the matrix has determinant {determinant}, so it cannot be undone")]
    Singular {
        /// Its determinant.
        determinant: f64,
    },
    /// The words have nothing to be drawn.
    #[error("the text has no visible character")]
    NoStrokes,
    /// More characters than a text may have.
    #[error("the text has {characters} characters, more than {limit}")]
    TextTooLong {
        /// How many it has.
        characters: usize,
        /// How many it may have.
        limit: usize,
    },
}

/// Refuses a parameter whose `condition` does not hold (NaN never holds).
pub(super) fn require(
    condition: bool,
    parameter: &'static str,
    value: f64,
    range: &'static str,
) -> Result<(), FieldError> {
    if condition { Ok(()) } else { Err(FieldError::Parameter { parameter, value, range }) }
}

/// Refuses what is not a positive length.
pub(super) fn require_length(parameter: &'static str, value: f64) -> Result<(), FieldError> {
    let holds = (MIN_LENGTH..=MAX_LENGTH).contains(&value);
    require(holds, parameter, value, "a length between 1e-75 and 1e75")
}

/// Refuses what is neither zero nor a positive length.
pub(super) fn require_length_or_zero(parameter: &'static str, value: f64) -> Result<(), FieldError> {
    let holds = value == 0.0 || (MIN_LENGTH..=MAX_LENGTH).contains(&value);
    require(holds, parameter, value, "0 or a length between 1e-75 and 1e75")
}

/// Refuses what is not a coordinate of moderate size.
pub(super) fn require_coordinates(parameter: &'static str, value: DVec3) -> Result<(), FieldError> {
    for coordinate in value.to_array() {
        require(coordinate.abs() <= MAX_LENGTH, parameter, coordinate, "at most 1e75 in magnitude")?;
    }
    Ok(())
}

/// Refuses what has no direction.
pub(super) fn require_direction(parameter: &'static str, value: DVec3) -> Result<(), FieldError> {
    require_coordinates(parameter, value)?;
    let size = value.abs().max_element();
    require(size >= MIN_LENGTH, parameter, size, "a vector with a component of at least 1e-75")
}
