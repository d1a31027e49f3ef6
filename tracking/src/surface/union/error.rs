//! Why a shape is not united with a surface: [`UnionError`].

use thiserror::Error;
use welter_meshing::Cancelled;
use welter_meshing::surface::TriId;

use super::super::{AppendError, SurfaceDefects};

/// Why a shape is not united with a surface. The surface is as it was then. Triangles of the shape have the ids that they would have if
/// it were added beside the surface.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum UnionError {
    /// Too many shifts are asked for.
    #[error("{shifts} shifts are asked for, must be at most {most}")]
    Shifts {
        /// How many.
        shifts: u32,
        /// The most there may be.
        most: u32,
    },
    /// The shape is no surface, or there would be more elements than can be numbered.
    #[error(transparent)]
    Append(#[from] AppendError),
    /// The surface or the shape intersects itself.
    #[error("{} pairs of triangles of the surface or of the shape intersect, the first {} and {}",
        pairs.len(), pairs[0][0].0, pairs[0][1].0)]
    SelfIntersection {
        /// All such pairs, sorted; at least one.
        pairs: Vec<[TriId; 2]>,
    },
    /// The shape crosses a part of the surface that has a boundary, and so no inside.
    #[error("the shape crosses triangle {}, which is of an open sheet", triangle.0)]
    Sheet {
        /// The first triangle of the sheet that is crossed.
        triangle: TriId,
    },
    /// Where both meet, one of them is inside out: its winding numbers are below zero.
    #[error("triangle {} is of a part that is inside out", triangle.0)]
    InsideOut {
        /// A triangle of that part.
        triangle: TriId,
    },
    /// However the shape is shifted, they meet in a way that is not in general position, or that roundings do not allow.
    #[error("the shape cannot be united with the surface, after {shifts} shifts: {obstacle}")]
    Degenerate {
        /// How often it was shifted.
        shifts: u32,
        /// What was in the way the last time.
        obstacle: UnionObstacle,
    },
    /// There would be more triangles than are allowed.
    #[error("there would be {triangles} triangles, more than the {most} that are allowed")]
    Budget {
        /// How many there would be.
        triangles: usize,
        /// How many there may be.
        most: usize,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<SurfaceDefects> for UnionError {
    fn from(defects: SurfaceDefects) -> Self {
        Self::Append(defects.into())
    }
}

/// What is in the way of a union until the shape is shifted.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum UnionObstacle {
    /// Two triangles meet in a vertex, along an edge, or in one plane.
    #[error("triangles meet in no general position")]
    GeneralPosition,
    /// New vertices are in another order in a triangle or on an edge once they are rounded.
    #[error("roundings change the order of new vertices")]
    Order,
    /// Triangles intersect once their vertices are rounded.
    #[error("roundings make triangles intersect")]
    Intersection,
    /// There is no room for points beside a triangle whose winding numbers would be known.
    #[error("there is no room beside triangles to find winding numbers")]
    Room,
    /// What is on both sides of a curve, or around an edge, does not fit together.
    #[error("the parts of both do not fit together")]
    Parts,
    /// The shape was shifted out of the range of numbers.
    #[error("a shift leads beyond the range of numbers")]
    Range,
}

/// Why an attempt ends.
#[derive(Debug)]
pub(super) enum Stop {
    /// It may succeed after a shift.
    Degenerate(UnionObstacle),
    /// It never will.
    Error(UnionError),
}

impl<E: Into<UnionError>> From<E> for Stop {
    fn from(error: E) -> Self {
        Self::Error(error.into())
    }
}
