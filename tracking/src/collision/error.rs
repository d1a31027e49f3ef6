//! What a construction of collision refuses: [`CollisionError`], and the checks that all of them share.

use thiserror::Error;

/// Why a query is refused.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CollisionError {
    /// A coordinate is infinite or not a number.
    #[error("coordinate {coordinate} of {vertex} at time {time} is {value}, not a finite number")]
    NonFinite {
        /// The end of the step, 0 or 1.
        time: u8,
        /// The vertex, by the name that the function's documentation gives it.
        vertex: &'static str,
        /// Which coordinate of it, counted from 0.
        coordinate: usize,
        /// The value found there.
        value: f64,
    },
    /// A parameter is outside its range.
    #[error("{parameter} is {value}, must be {range}")]
    Parameter {
        /// Its field name.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// The range it must lie in.
        range: &'static str,
    },
}

/// Finds the first coordinate that is not finite.
pub(super) fn check_finite<const D: usize, const P: usize>(
    names: &[&'static str; P],
    ends: [&[[f64; D]; P]; 2],
) -> Result<(), CollisionError> {
    for (time, points) in (0..).zip(ends) {
        for (&vertex, point) in names.iter().zip(points) {
            if let Some(coordinate) = point.iter().position(|x| !x.is_finite()) {
                let value = point[coordinate];
                return Err(CollisionError::NonFinite { time, vertex, coordinate, value });
            }
        }
    }
    Ok(())
}

/// Refuses a parameter whose `condition` does not hold (NaN never holds).
pub(super) fn require(
    condition: bool,
    parameter: &'static str,
    value: f64,
    range: &'static str,
) -> Result<(), CollisionError> {
    if condition { Ok(()) } else { Err(CollisionError::Parameter { parameter, value, range }) }
}
