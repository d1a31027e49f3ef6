//! [`RemeshError`]: why a surface is not remeshed.

use thiserror::Error;

use super::connectivity::NotManifold;
use crate::Cancelled;
use crate::grid::GridError;
use crate::isosurface::IsosurfaceError;

/// Why a surface is not remeshed, or has no starting mesh.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RemeshError {
    /// A parameter is outside of its range.
    #[error("{parameter} is {value}, must be {range}")]
    Parameter {
        /// Its field name.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// The range it must lie in.
        range: &'static str,
    },
    /// The surface has an edge or vertex where it is no manifold.
    #[error(transparent)]
    NotManifold(#[from] NotManifold),
    /// Coordinates are too large for the edge length.
    #[error("a coordinate of {coordinate:e} is more than {most:e}, for an edge length of {edge_length:e}")]
    TooFar {
        /// The largest magnitude of a coordinate.
        coordinate: f64,
        /// The largest that is allowed.
        most: f64,
        /// The edge length asked for.
        edge_length: f64,
    },
    /// The edge length is too small for the area.
    #[error("edge length {edge_length} needs about {triangles:.3e} triangles, more than {most:.3e}")]
    TooManyTriangles {
        /// The edge length asked for.
        edge_length: f64,
        /// About how many triangles it needs.
        triangles: f64,
        /// The most that are made.
        most: f64,
    },
    /// The field has no surface on the grid.
    #[error(transparent)]
    Isosurface(#[from] IsosurfaceError),
    /// There is no such grid.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
