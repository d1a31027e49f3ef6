//! The driver of the method: [`mesh_on_grid`], whose lines are the stages of \[Gagniere22\] Ch. 3 on one grid.

use super::assembly::{Assembled, assemble};
use super::cells::CellHexahedra;
use super::characteristic::between_surface;
use super::crossings::Crossings;
use super::error::{Place, Trouble};
use super::extension::Extension;
use super::frame::Cut;
use super::gluing::Outside;
use super::hosts::Hosts;
use super::pairing::Pairing;
use super::pieces::{Pieces, Regions};
use super::precursors::precursors;
use super::sheets::Sheets;
use super::walls::walls;
use crate::grid::Grid3;
use crate::surface::TriMesh;
use crate::{Cancelled, DVec3, Monitor};

/// A mesh on one grid.
pub(super) struct OnGrid {
    pub(super) assembled: Assembled,
    /// What became of each hexahedron of the extension.
    pub(super) became: Vec<u32>,
    pub(super) windings: Vec<i32>,
    /// What cells that the surface does not meet add to the Euler characteristic.
    pub(super) between_surface: i64,
    pub(super) ambiguous: bool,
}

/// What went wrong, and where.
pub(super) struct Stopped {
    pub(super) trouble: Trouble,
    pub(super) place: Place,
}

impl Stopped {
    /// At no place more than at another.
    pub(super) fn nowhere(trouble: impl Into<Trouble>, grid: &Grid3) -> Self {
        Self { trouble: trouble.into(), place: place_of_cell(grid, [0; 3]) }
    }
}

/// Meshes the volume of a surface on the cells of a grid, or says what went wrong.
pub(super) fn mesh_on_grid(
    mesh: &TriMesh,
    pairing: &Pairing,
    grid: &Grid3,
    monitor: &Monitor<'_>,
) -> Result<(OnGrid, Hosts), Stopped> {
    let (extension, crossings) = cut(mesh, pairing, grid, monitor).map_err(|c| Stopped::nowhere(c, grid))?;
    let on_grid = mesh_cut(&Cut { grid, crossings: &crossings, extension: &extension }, monitor)?;
    let hosts = Hosts::new(mesh, grid, &extension, |h| on_grid.became[h as usize]);
    Ok((on_grid, hosts))
}

/// From where the surface meets the cells and cuts their edges to the mesh.
pub(super) fn mesh_cut(cut: &Cut<'_>, monitor: &Monitor<'_>) -> Result<OnGrid, Stopped> {
    let grid = cut.grid;
    let nowhere = |cancelled: Cancelled| Stopped::nowhere(cancelled, grid);
    let whole = regions(cut, None, monitor).map_err(nowhere)?;
    let stopped =
        |trouble, regions: &Regions<'_>| Stopped { trouble, place: place_of(trouble, grid, regions) };
    match sew(cut, &whole, monitor) {
        // Perhaps copies of a region change places around it: then only its parts have copies.
        Err(Trouble::Contradiction { given_up: false, .. }) => {
            let split = regions(cut, Some(&whole), monitor).map_err(nowhere)?;
            let sewn = sew(cut, &split, monitor).map_err(|trouble| stopped(trouble, &split))?;
            Ok(OnGrid { windings: whole.windings().to_vec(), ..sewn })
        }
        sewn => sewn.map_err(|trouble| stopped(trouble, &whole)),
    }
}

/// Where the surface meets the cells, and where it cuts their edges.
fn cut(
    mesh: &TriMesh,
    pairing: &Pairing,
    grid: &Grid3,
    monitor: &Monitor<'_>,
) -> Result<(Extension, Crossings), Cancelled> {
    let precursors = precursors(mesh, grid, monitor)?;
    let extension = Extension::new(mesh, pairing, grid, precursors, monitor)?;
    Ok((extension, Crossings::new(mesh, grid, monitor)?))
}

/// The regions of the grid, or the parts of those of two or more copies.
fn regions<'a>(
    cut: &Cut<'a>,
    whole: Option<&Regions<'_>>,
    monitor: &Monitor<'_>,
) -> Result<Regions<'a>, Cancelled> {
    let mut pieces = Pieces::new(cut.grid, cut.crossings, whole.is_some());
    let pairs = walls(cut, &pieces, monitor)?;
    pieces.add_walls(&pairs);
    Ok(pieces.regions(whole))
}

/// From regions to the mesh.
fn sew(cut: &Cut<'_>, regions: &Regions<'_>, monitor: &Monitor<'_>) -> Result<OnGrid, Trouble> {
    if let Some(region) = largest_negative(cut.grid, regions) {
        return Err(Trouble::Negative { region, winding: regions.windings()[region as usize] });
    }
    let sheets = Sheets::new(cut, regions, monitor)?;
    let cells = CellHexahedra::new(cut, regions, &sheets, monitor)?;
    let outside = Outside::new(cut, &cells, monitor)?;
    let assembled = assemble(*cut, regions, &sheets, &cells, &outside, monitor)?;
    let became =
        (0..cut.extension.count()).map(|h| assembled.of_surface[cells.of_extension(h) as usize]).collect();
    Ok(OnGrid {
        assembled,
        became,
        windings: regions.windings().to_vec(),
        between_surface: between_surface(cut, regions),
        ambiguous: sheets.ambiguous(),
    })
}

/// The region of negative winding number with the most nodes, the first of those with as many.
fn largest_negative(grid: &Grid3, regions: &Regions<'_>) -> Option<u32> {
    let first = regions.windings().iter().position(|&winding| winding < 0)?;
    let mut nodes = vec![0; regions.windings().len()];
    regions.pieces.for_each_piece(grid, |piece, _, _, count| nodes[regions.of(piece) as usize] += count);
    let negative = (first..nodes.len()).filter(|&region| regions.windings()[region] < 0);
    negative.rev().max_by_key(|&region| nodes[region]).map(|region| region as u32)
}

/// Where something went wrong.
fn place_of(trouble: Trouble, grid: &Grid3, regions: &Regions<'_>) -> Place {
    match trouble {
        Trouble::Negative { region, .. }
        | Trouble::TooManyCopies { region, .. }
        | Trouble::Contradiction { region, .. } => place_of_region(grid, regions, region),
        Trouble::Cell { cell, .. } => place_of_cell(grid, cell),
        Trouble::TooLarge { .. } | Trouble::Cancelled(_) => place_of_cell(grid, [0; 3]),
    }
}

fn place_of_cell(grid: &Grid3, cell: [u32; 3]) -> Place {
    let corner = |index: [u32; 3]| DVec3::from_array(grid.node(index));
    Place { min: corner(cell), max: corner(cell.map(|i| i + 1)), nodes: 0 }
}

/// The box around the nodes of a region, and around the edges on which its pieces lie if it has no nodes.
fn place_of_region(grid: &Grid3, regions: &Regions<'_>, region: u32) -> Place {
    let mut place = Place { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY, nodes: 0 };
    let mut include = |node: [u32; 3]| {
        let p = DVec3::from_array(grid.node(node));
        (place.min, place.max) = (place.min.min(p), place.max.max(p));
    };
    let mut nodes = 0;
    regions.pieces.for_each_piece(grid, |piece, first, last, count| {
        if regions.of(piece) == region {
            include(first);
            include(last);
            nodes += count;
        }
    });
    Place { nodes, ..place }
}
