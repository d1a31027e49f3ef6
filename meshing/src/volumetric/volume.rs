//! [`mesh_volume`]: from a surface to a volumetric mesh, on as fine a grid as it takes.

use super::error::{Trouble, VolumeError};
use super::hosts::Hosts;
use super::mesher::{OnGrid, Stopped, mesh_on_grid};
use super::pairing::Pairing;
use super::verify::{check_copies, check_euler, place_of};
use super::{CoarsenError, HexMesh, Resolution, VolumeParameters, euler_characteristics};
use crate::Monitor;
use crate::grid::{Grid, Grid3};
use crate::spatial::Box3;
use crate::surface::ClosedOrientedMesh;

/// A volumetric mesh of a surface that may intersect itself: hexahedra, several on one cell where sheets of the volume overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeMesh {
    /// The hexahedra.
    pub mesh: HexMesh,
    /// The region of the grid that each hexahedron holds a copy of: nodes that edges connect without meeting the surface. `u32::MAX` for one
    /// that lies between the edges of the grid.
    pub regions: Vec<u32>,
    /// Which copy of its region, from 0.
    pub copies: Vec<u8>,
    /// Where the surface is.
    pub hosts: Hosts,
    /// How often the surface winds around each region: so many copies it has.
    pub windings: Vec<i32>,
    /// Whether the surface allows for other volumes too: the immersion is not simple in the sense of \[Li18\].
    pub ambiguous: bool,
    /// How often the cells asked for were halved before they were fine enough.
    pub refinements: u32,
    /// How often the mesh was coarsened by doubling after that.
    pub coarsenings: u32,
}

impl VolumeMesh {
    /// How many regions of the grid the hexahedra hold copies of.
    #[must_use]
    pub fn region_count(&self) -> usize {
        copies_by_region(&self.regions, &self.windings).len()
    }

    /// How many copies of regions there are.
    #[must_use]
    pub fn copy_count(&self) -> usize {
        copies_by_region(&self.regions, &self.windings).iter().map(|&(_, copies)| copies as usize).sum()
    }
}

/// The regions that cells hold copies of, with how many copies each has.
pub(super) fn copies_by_region(regions: &[u32], windings: &[i32]) -> Vec<(u32, u32)> {
    let mut held = vec![false; windings.len()];
    regions.iter().filter(|&&region| region != u32::MAX).for_each(|&region| held[region as usize] = true);
    let held = (0..).zip(&held).filter(|&(_, &held)| held);
    held.map(|(region, _)| (region, windings[region as usize].max(0) as u32)).collect()
}

/// Meshes the volume that a surface encloses.
///
/// ```
/// use welter_meshing::{Monitor, shapes, volumetric::{Resolution, VolumeParameters, mesh_volume}};
/// let surface = shapes::two_boxes(&shapes::BoxPair::overlapping())?;
/// let parameters = VolumeParameters { resolution: Resolution::ShortestSide(16), ..VolumeParameters::default() };
/// let volume = mesh_volume(&surface, &parameters, &Monitor::none())?;
/// // Where the boxes overlap there are two hexahedra on one cell.
/// assert!(volume.mesh.cells().windows(2).any(|pair| pair[0] == pair[1]));
/// assert_eq!(volume.windings.iter().max(), Some(&2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`VolumeError`]: parameters out of range, a surface that bounds no volume, features too fine, or the monitor's wish.
pub fn mesh_volume(
    surface: &ClosedOrientedMesh,
    parameters: &VolumeParameters,
    monitor: &Monitor<'_>,
) -> Result<VolumeMesh, VolumeError> {
    parameters.validate()?;
    if surface.triangles().is_empty() {
        return Err(VolumeError::Empty);
    }
    let pairing = Pairing::new(surface);
    let (volume, refinements) = on_finer_grids(
        parameters,
        |refinements| grid_for(surface, parameters, refinements),
        |grid, refinements| {
            let (on_grid, hosts) = mesh_on_grid(surface, &pairing, grid, monitor)
                .map_err(|stopped| told(stopped, grid.spacing(), refinements))?;
            checked(on_grid, hosts, &pairing, parameters, refinements, monitor)
        },
    )?;
    coarsened(surface, volume, refinements + parameters.coarsenings, monitor)
}

/// The mesh on one grid, unless features of the surface were too fine for its cells.
fn checked(
    on_grid: OnGrid,
    hosts: Hosts,
    pairing: &Pairing,
    parameters: &VolumeParameters,
    refinements: u32,
    monitor: &Monitor<'_>,
) -> Result<VolumeMesh, VolumeError> {
    let OnGrid { mut assembled, windings, between_surface, ambiguous, .. } = on_grid;
    let doubtful = parameters.check_topology && {
        let part = &assembled.of_surface;
        let at_surface = assembled.mesh.with_some(part, |part| euler_characteristics(part, monitor))?;
        let sum = at_surface.total().euler_characteristic() + between_surface;
        2 * sum != pairing.characteristics().iter().sum::<i64>()
    };
    let volume = VolumeMesh {
        mesh: assembled.mesh,
        regions: assembled.regions,
        copies: assembled.copies,
        hosts,
        windings,
        ambiguous,
        refinements,
        coarsenings: 0,
    };
    match if doubtful { fault(&volume, pairing, monitor)? } else { None } {
        None => Ok(volume),
        Some(error) => Err(error),
    }
}

/// Meshes on the grid after no halving of its cells, and on finer ones while its cells are too large. Returns the number of halvings too.
pub(super) fn on_finer_grids<G, T>(
    parameters: &VolumeParameters,
    grid_for: impl Fn(u32) -> Result<G, VolumeError>,
    mesh_on: impl Fn(&G, u32) -> Result<T, VolumeError>,
) -> Result<(T, u32), VolumeError> {
    let mut refinements = 0;
    let mut grid = grid_for(refinements)?;
    loop {
        let error = match mesh_on(&grid, refinements) {
            Ok(mesh) => return Ok((mesh, refinements)),
            Err(error) => error,
        };
        let finer = refinements + 1;
        let more = matches!(error, VolumeError::UnderResolved { .. }) && finer <= parameters.max_refinements;
        grid = match grid_for(finer) {
            Ok(grid) if more => grid,
            _ => return Err(error),
        };
        refinements = finer;
    }
}

/// Whether features of the surface were too fine for the cells though nothing went wrong: a tunnel or a gap within one.
fn fault(
    volume: &VolumeMesh,
    pairing: &Pairing,
    monitor: &Monitor<'_>,
) -> Result<Option<VolumeError>, VolumeError> {
    let (findings, _) = check_euler(volume, pairing, monitor)?;
    let Some(finding) = findings.first.first() else { return Ok(None) };
    let what = "its Euler characteristic is not half that of its boundary, as where a tunnel or a gap is within one cell";
    let grid = volume.mesh.grid();
    let place = place_of(finding, volume, monitor)?;
    Ok(Some(VolumeError::UnderResolved {
        place,
        what,
        spacing: grid.spacing(),
        refinements: volume.refinements,
    }))
}

/// The mesh coarsened so often, or as often as its topology is kept and no larger hexahedron holds two of the sheets that lie over one
/// another.
fn coarsened(
    surface: &ClosedOrientedMesh,
    mut volume: VolumeMesh,
    times: u32,
    monitor: &Monitor<'_>,
) -> Result<VolumeMesh, VolumeError> {
    for _ in 0..times {
        match volume.coarsened(monitor) {
            Ok((coarse, report)) if report.kept() && check_copies(surface, &coarse, monitor)?.0.none() => {
                volume = coarse;
            }
            Err(CoarsenError::Cancelled(cancelled)) => return Err(cancelled.into()),
            Ok(_) | Err(_) => break,
        }
    }
    Ok(volume)
}

/// The grid of a surface, after some halvings of its cells.
///
/// # Errors
/// [`VolumeError::Grid`] and [`VolumeError::TooLarge`].
pub(crate) fn grid_for(
    surface: &ClosedOrientedMesh,
    parameters: &VolumeParameters,
    refinements: u32,
) -> Result<Grid3, VolumeError> {
    let around = Box3::of(surface.triangles().iter().flatten().map(|v| surface.positions()[v.index()]));
    grid_around(around.min.to_array(), around.max.to_array(), parameters, refinements)
}

/// The grid around a box, after some halvings of its cells.
///
/// # Errors
/// [`VolumeError::Grid`] and [`VolumeError::TooLarge`].
pub(super) fn grid_around<const D: usize>(
    min: [f64; D],
    max: [f64; D],
    parameters: &VolumeParameters,
    refinements: u32,
) -> Result<Grid<D>, VolumeError> {
    let size: [f64; D] = std::array::from_fn(|axis| max[axis] - min[axis]);
    let spacing = match parameters.resolution {
        Resolution::Spacing(spacing) => spacing,
        // A flat surface has no shortest side; the next one stands for it.
        Resolution::ShortestSide(n) => {
            let mut sides = size;
            sides.sort_by(f64::total_cmp);
            let side = sides.into_iter().find(|&side| side > 0.0).unwrap_or(1.0);
            side / f64::from(n)
        }
    };
    let spacing = spacing * 0.5f64.powi(refinements as i32);
    let cells = size.iter().map(|side| side / spacing + 3.0).product::<f64>();
    if cells > parameters.max_cells as f64 {
        let count = if cells < 1e18 { cells as u64 } else { u64::MAX };
        return Err(VolumeError::TooLarge { what: "cells of the grid", count, most: parameters.max_cells });
    }
    Ok(Grid::covering(min, max, spacing, 1)?)
}

/// What went wrong, with its place.
pub(super) fn told(Stopped { trouble, place }: Stopped, spacing: f64, refinements: u32) -> VolumeError {
    let under_resolved = |what| VolumeError::UnderResolved { place, what, spacing, refinements };
    match trouble {
        Trouble::Negative { winding, .. } => VolumeError::Negative { place, winding },
        Trouble::TooManyCopies { copies, .. } => {
            VolumeError::TooManyCopies { place, copies, most: super::copies::MAX_COPIES }
        }
        Trouble::Contradiction { given_up: false, .. } => {
            under_resolved("no way to tell its sheets apart is consistent")
        }
        Trouble::Contradiction { given_up: true, .. } => {
            under_resolved("no way to tell its sheets apart was found")
        }
        Trouble::Cell { what, .. } => under_resolved(what),
        Trouble::TooLarge { what, count, most } => VolumeError::TooLarge { what, count, most },
        Trouble::Cancelled(cancelled) => VolumeError::Cancelled(cancelled),
    }
}
