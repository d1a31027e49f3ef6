//! [`starting_mesh`]: from a field to near equilateral triangles.

use super::{Equilateral, RemeshError, RemeshReport, equilateral};
use crate::Monitor;
use crate::field::ScalarField;
use crate::grid::{Grid3, Samples};
use crate::isosurface::{MarchingCubes, marching_cubes};
use crate::surface::EmbeddedMesh;

/// Parameters of [`starting_mesh`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartingMesh {
    /// Length that edges shall have, in spacings of the grid; 1/8 to 8. Default 1: as many triangles as the
    /// grid tells shape, about 2.3 for each square of a grid's cell.
    pub edge_length_rel: f64,
    /// As of [`Equilateral`]. Default 6.
    pub rounds: u32,
}

impl Default for StartingMesh {
    fn default() -> Self {
        Self { edge_length_rel: 1.0, rounds: Equilateral::default().rounds }
    }
}

/// The surface of a field, seen by a grid, with triangles near equilateral: [`marching_cubes`], then
/// [`equilateral`].
///
/// Where the field is negative at the wall of the grid the wall closes the surface; vertices there are off
/// the zero set and counted so.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, grid::Grid3, remesh::{StartingMesh, starting_mesh}};
/// let ball = |p: DVec3| p.length() - 1.0;
/// let grid = Grid3::covering([-1.0; 3], [1.0; 3], 0.4, 1)?;
/// let (mesh, report) = starting_mesh(&grid, &ball, &StartingMesh::default(), &Monitor::none())?;
/// assert!(report.smallest_angle.to_degrees() > 20.0);
/// assert_eq!(mesh.positions().len() * 2, mesh.triangles().len() + 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RemeshError`], of the parameters, of [`marching_cubes`] and of [`equilateral`].
pub fn starting_mesh(
    grid: &Grid3,
    field: &impl ScalarField,
    parameters: &StartingMesh,
    monitor: &Monitor<'_>,
) -> Result<(EmbeddedMesh, RemeshReport), RemeshError> {
    let value = parameters.edge_length_rel;
    if !(0.125..=8.0).contains(&value) {
        return Err(RemeshError::Parameter {
            parameter: "edge_length_rel",
            value,
            range: "between 1/8 and 8",
        });
    }
    let edge_length = value * grid.spacing();
    let shape = Equilateral { edge_length, rounds: parameters.rounds, ..Equilateral::default() };
    shape.validate()?;
    let samples = Samples::of(grid, field, monitor)?;
    // On the field itself, not on the interpolant of samples: where two sheets are about a cell apart the interpolant errs by most of a cell.
    let on_field = MarchingCubes { roots_of: Some(field), ..MarchingCubes::default() };
    let mesh = marching_cubes(&samples, &on_field, monitor)?;
    equilateral(&mesh, field, &shape, monitor)
}
