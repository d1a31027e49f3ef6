//! The typed error of the checked entry points: [`NonFinite`].

use core::fmt;

/// A coordinate that a checked predicate refuses: infinite or not a number.
#[derive(Clone, Copy, Debug)]
pub struct NonFinite {
    /// Which argument, counted from 0.
    pub argument: usize,
    /// Which coordinate of it, counted from 0.
    pub coordinate: usize,
    /// The value found there.
    pub value: f64,
}

impl PartialEq for NonFinite {
    fn eq(&self, other: &Self) -> bool {
        // Bits, so that an error that holds a NaN equals itself.
        (self.argument, self.coordinate, self.value.to_bits())
            == (other.argument, other.coordinate, other.value.to_bits())
    }
}

impl Eq for NonFinite {}

impl fmt::Display for NonFinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { argument, coordinate, value } = self;
        write!(f, "coordinate {coordinate} of argument {argument} is {value}, not a finite number")
    }
}

impl core::error::Error for NonFinite {}

/// Finds the first coordinate that is not finite.
///
/// # Errors
/// [`NonFinite`] with its place.
pub(crate) fn check_finite<const N: usize>(points: &[[f64; N]]) -> Result<(), NonFinite> {
    for (argument, point) in points.iter().enumerate() {
        for (coordinate, &value) in point.iter().enumerate() {
            if !value.is_finite() {
                return Err(NonFinite { argument, coordinate, value });
            }
        }
    }
    Ok(())
}
