//! [`DistanceParameters`]: what a distance field is to hold, and what is inside; [`DistanceError`].

use thiserror::Error;

use crate::Cancelled;

/// Which winding numbers are inside, where the distance is negative.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum InsideRule {
    /// All but 0: the union of what a surface encloses, whichever way its parts are turned.
    #[default]
    NonZero,
    /// 1 and more: the union of the parts oriented outward, less what is turned inside out.
    Positive,
    /// Odd numbers: what lies in two parts is outside.
    Odd,
}

impl InsideRule {
    /// Whether points with this winding number are inside.
    ///
    /// ```
    /// use welter_meshing::distance::InsideRule;
    /// assert!(InsideRule::NonZero.holds(-1) && InsideRule::Odd.holds(-1) && !InsideRule::Positive.holds(-1));
    /// assert!(InsideRule::NonZero.holds(2) && !InsideRule::Odd.holds(2));
    /// ```
    #[must_use]
    pub fn holds(self, winding: i32) -> bool {
        match self {
            Self::NonZero => winding != 0,
            Self::Positive => winding > 0,
            Self::Odd => winding % 2 != 0,
        }
    }
}

/// What a distance field holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistanceParameters {
    /// Distance up to which it is computed, in the unit of the coordinates; not negative. Nodes that are farther get this
    /// distance itself, with their sign. Default: infinite, that is everywhere.
    pub band: f64,
    /// Which winding numbers are inside; of no matter to unsigned distances. Default: [`InsideRule::NonZero`].
    pub inside: InsideRule,
    /// Whether to keep the closest triangle of each node, 4 bytes a node. Default: no.
    pub closest_triangles: bool,
    /// Whether to keep the winding number of each node, 4 bytes a node. Default: no.
    pub winding_numbers: bool,
}

impl Default for DistanceParameters {
    fn default() -> Self {
        Self {
            band: f64::INFINITY,
            inside: InsideRule::NonZero,
            closest_triangles: false,
            winding_numbers: false,
        }
    }
}

impl DistanceParameters {
    /// # Errors
    /// [`DistanceError::Band`].
    pub fn validate(&self) -> Result<(), DistanceError> {
        if self.band >= 0.0 { Ok(()) } else { Err(DistanceError::Band { band: self.band }) }
    }
}

/// Why there is no distance field.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum DistanceError {
    /// The band is no distance.
    #[error("the band is {band}, must be at least 0")]
    Band {
        /// The band asked for.
        band: f64,
    },
    /// By the monitor.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
