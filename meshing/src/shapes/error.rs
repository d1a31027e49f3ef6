//! What a generator refuses: [`ShapeError`], and the checks of parameters that all generators share.

use crate::field::FieldError;
use crate::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};
use glam::DVec3;
use thiserror::Error;

/// Most triangles a generator makes: about 2.4 GB of positions and indices.
pub const MAX_SHAPE_TRIANGLES: u32 = 1 << 26;

/// Most nodes of the grid on which a generator samples a field: 2 GiB of numbers.
pub const MAX_SHAPE_SAMPLES: u32 = 1 << 28;

/// Longest length and largest coordinate of a parameter: squares and cubes of it do not overflow. A larger
/// surface is a scaled copy.
pub const MAX_LENGTH: f64 = 1e75;

/// Shortest length of a parameter: squares and cubes of it do not vanish.
pub const MIN_LENGTH: f64 = 1e-75;

/// Why a generator refuses its parameters.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ShapeError {
    /// No generator of that name.
    #[error("no shape is called {name:?}{}", suggestion(*nearest))]
    UnknownName {
        /// The name asked for.
        name: String,
        /// The most similar name there is, if one is similar at all.
        nearest: Option<&'static str>,
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
    /// The edge length is too small for the extent of the shape.
    #[error(
        "edge length {edge_length} needs about {triangles:.3e} triangles, more than {MAX_SHAPE_TRIANGLES}"
    )]
    TooManyTriangles {
        /// The edge length asked for.
        edge_length: f64,
        /// About how many triangles it needs.
        triangles: f64,
    },
    /// The edge length is too small for the extent of a shape that is the surface of a field.
    #[error(
        "edge length {edge_length} needs a grid of about {samples:.3e} nodes, more than {MAX_SHAPE_SAMPLES}"
    )]
    TooManySamples {
        /// The edge length asked for.
        edge_length: f64,
        /// About how many nodes it needs.
        samples: f64,
    },
    /// The field of the shape is refused.
    #[error(transparent)]
    Field(#[from] FieldError),
}

fn suggestion(nearest: Option<&str>) -> String {
    nearest.map(|name| format!("; did you mean {name:?}?")).unwrap_or_default()
}

/// Refuses a parameter whose `condition` does not hold (NaN never holds).
pub(crate) fn require(
    condition: bool,
    parameter: &'static str,
    value: f64,
    range: &'static str,
) -> Result<(), ShapeError> {
    if condition { Ok(()) } else { Err(ShapeError::Parameter { parameter, value, range }) }
}

/// Refuses what is not a positive length.
pub(crate) fn require_length(parameter: &'static str, value: f64) -> Result<(), ShapeError> {
    let holds = (MIN_LENGTH..=MAX_LENGTH).contains(&value);
    require(holds, parameter, value, "a length between 1e-75 and 1e75")
}

/// Refuses what is not a coordinate of moderate size.
pub(crate) fn require_coordinates(parameter: &'static str, value: DVec3) -> Result<(), ShapeError> {
    for coordinate in value.to_array() {
        require(coordinate.abs() <= MAX_LENGTH, parameter, coordinate, "at most 1e75 in magnitude")?;
    }
    Ok(())
}

/// Refuses more triangles than [`MAX_SHAPE_TRIANGLES`]; to be asked before anything is allocated.
pub(crate) fn require_triangles(edge_length: f64, triangles: f64) -> Result<(), ShapeError> {
    if triangles <= f64::from(MAX_SHAPE_TRIANGLES) {
        Ok(())
    } else {
        Err(ShapeError::TooManyTriangles { edge_length, triangles })
    }
}

/// How many edges of at most `edge_length` divide `length`: a whole number, at least `least`, perhaps far beyond
/// what can be made. Once the triangles are bounded, it can be cast to `u32`.
pub(crate) fn divisions(length: f64, edge_length: f64, least: u32) -> f64 {
    (length / edge_length).ceil().max(f64::from(least))
}

/// The mesh of a soup that a generator made.
pub(crate) fn finish(soup: TriangleSoup) -> ClosedOrientedMesh {
    let mesh =
        TriMesh::new(soup).expect("parameters of moderate size give finite positions, generators valid ids");
    ClosedOrientedMesh::new(mesh).expect("generators make closed, oriented surfaces")
}
