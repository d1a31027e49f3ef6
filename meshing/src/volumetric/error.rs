//! Why there is no volumetric mesh: [`VolumeError`].

use thiserror::Error;

use crate::grid::GridError;
use crate::io::text::Decimal;
use crate::{Cancelled, DVec3};

/// Where something is: a box of cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Its lower corner.
    pub min: DVec3,
    /// Its upper corner.
    pub max: DVec3,
    /// How many nodes of the grid belong to it; 0 if it lies between nodes.
    pub nodes: u64,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (min, max) = (self.min, self.max);
        let [a, b] = [min, max].map(|corner| corner.to_array().map(Decimal));
        write!(f, "({}, {}, {}) to ({}, {}, {})", a[0], a[1], a[2], b[0], b[1], b[2])
    }
}

/// Why there is no volumetric mesh.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum VolumeError {
    /// The parameters allow for no grid.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A parameter is out of its range.
    #[error("{name} is {}, must be {range}", Decimal(*value))]
    Parameter {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// The surface has no triangles, or there are no curves.
    #[error("there is no surface and no curve")]
    Empty,
    /// Around some place the surface winds the wrong way: no volume has such a boundary.
    #[error(
        "around {place} the surface winds {winding} times: it is inside out there, and no volume has such a boundary"
    )]
    Negative {
        /// Where.
        place: Place,
        /// How often the surface winds around it.
        winding: i32,
    },
    /// Curves in the plane turn around so often that no surface has them as its boundary.
    #[error(
        "the curves turn around {turning} times in all: no surface with {curves} boundary curves does so"
    )]
    Turning {
        /// The sum of their turning numbers, at least.
        turning: i64,
        /// How many curves.
        curves: usize,
    },
    /// More sheets lie over one another than can be told apart.
    #[error("{copies} sheets lie over one another around {place}, at most {most} can be told apart")]
    TooManyCopies {
        /// Where.
        place: Place,
        /// How many sheets.
        copies: u32,
        /// How many there may be.
        most: u32,
    },
    /// Features of the surface are too fine for the cells, at every size that was tried.
    #[error(
        "cells of size {} are too large at {place}: {what}; \
         {refinements} refinements did not help, and a further one is beyond the limit",
        Decimal(*spacing)
    )]
    UnderResolved {
        /// Where.
        place: Place,
        /// What went wrong there.
        what: &'static str,
        /// The size of the last cells.
        spacing: f64,
        /// How often the cells were halved.
        refinements: u32,
    },
    /// More cells than a parameter allows.
    #[error("{what}: {count}, at most {most} are allowed")]
    TooLarge {
        /// What there would be too many of.
        what: &'static str,
        /// How many.
        count: u64,
        /// How many there may be.
        most: u64,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// What went wrong on one grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Trouble {
    Negative { region: u32, winding: i32 },
    TooManyCopies { region: u32, copies: u32 },
    Contradiction { region: u32, given_up: bool },
    Cell { cell: [u32; 3], what: &'static str },
    TooLarge { what: &'static str, count: u64, most: u64 },
    Cancelled(Cancelled),
}

impl From<Cancelled> for Trouble {
    fn from(cancelled: Cancelled) -> Self {
        Self::Cancelled(cancelled)
    }
}
