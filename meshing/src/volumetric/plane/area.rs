//! [`mesh_area`]: from closed curves to quadrilaterals, on as fine a grid as it takes.
//!
//! # What it promises
//! * As many quadrilaterals over each cell that the curves do not meet as they wind around it.
//! * Each component has the Euler characteristic of a surface with the curves in it as boundary, which is the sum of their turning numbers (the
//!   Gauss-Bonnet theorem of a flat surface). If it has another, some feature was too fine for the cells, and they are halved.
//! * Curves that by their turning numbers bound no surface at all are refused, without finer grids.
//!
//! # What it does not promise
//! That every curve that bounds no surface is told so: where no way to tell its sheets apart is consistent, it may be the cells.

use super::front::Front;
use super::verify::euler;
use super::{AreaFinding, AreaHosts, ClosedPolylines, QuadMesh};
use crate::grid::{Grid2, Grid3, MAX_NODES};
use crate::volumetric::error::{Place, Trouble};
use crate::volumetric::frame::Cut;
use crate::volumetric::mesher::{OnGrid, Stopped, mesh_cut};
use crate::volumetric::volume::{copies_by_region, grid_around, on_finer_grids, told};
use crate::volumetric::{VolumeError, VolumeParameters};
use crate::{DVec2, Monitor};

/// A mesh of the area inside of curves: quadrilaterals, several on one cell where sheets overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct AreaMesh {
    /// The quadrilaterals.
    pub mesh: QuadMesh,
    /// The region of the grid that each quadrilateral holds a copy of: nodes that edges connect without meeting the curves. `u32::MAX` for
    /// one that lies between the edges of the grid.
    pub regions: Vec<u32>,
    /// Which copy of its region, from 0.
    pub copies: Vec<u8>,
    /// Where the curves are.
    pub hosts: AreaHosts,
    /// How often the curves wind around each region: so many copies it has.
    pub windings: Vec<i32>,
    /// Whether the curves allow for other surfaces too.
    pub ambiguous: bool,
    /// How often the cells asked for were halved.
    pub refinements: u32,
}

impl AreaMesh {
    /// How many regions of the grid the quadrilaterals hold copies of.
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

/// Meshes the area that curves enclose, on their left. Coarsening, which the parameters may ask for, is not done.
///
/// ```
/// use welter_meshing::{DVec2, Monitor};
/// use welter_meshing::volumetric::{Resolution, VolumeParameters, plane::{ClosedPolylines, mesh_area}};
/// // Two squares that overlap.
/// let square = |x: f64| [[x, x], [x + 2.0, x], [x + 2.0, x + 2.0], [x, x + 2.0]].map(DVec2::from_array);
/// let positions = [square(0.0), square(1.0)].concat();
/// let curves = ClosedPolylines::new(positions, vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7]])?;
/// let parameters = VolumeParameters { resolution: Resolution::Spacing(0.25), ..VolumeParameters::default() };
/// let area = mesh_area(&curves, &parameters, &Monitor::none())?;
/// assert_eq!(area.windings, [0, 1, 2, 1]);
/// assert_eq!(area.mesh.components().1, [1, 1]);
/// assert_eq!((area.region_count(), area.copy_count()), (3, 4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`VolumeError`]: parameters out of range, curves that bound no area, features too fine, or the monitor's wish. Places are at height 0.
pub fn mesh_area(
    curves: &ClosedPolylines,
    parameters: &VolumeParameters,
    monitor: &Monitor<'_>,
) -> Result<AreaMesh, VolumeError> {
    parameters.validate()?;
    if curves.is_empty() {
        return Err(VolumeError::Empty);
    }
    let turnings: Vec<[i64; 2]> = (0..curves.loops().len()).map(|number| curves.turning(number)).collect();
    let impossible = impossible(&turnings);
    let (area, refinements) = on_finer_grids(
        parameters,
        |refinements| grid_for(curves, parameters, refinements),
        |grid, refinements| {
            let area = area_on_grid(curves, &turnings, grid, monitor);
            area.map_err(|stopped| match (told(stopped, grid.spacing(), refinements), &impossible) {
                (VolumeError::UnderResolved { .. }, Some(impossible)) => impossible.clone(),
                (error, _) => error,
            })
        },
    )?;
    Ok(AreaMesh { refinements, ..area })
}

/// The grid of curves, after some halvings of its cells.
fn grid_for(
    curves: &ClosedPolylines,
    parameters: &VolumeParameters,
    refinements: u32,
) -> Result<Grid2, VolumeError> {
    let points = (0..curves.len() as u32).map(|corner| curves.segment(corner)[0]);
    let around =
        points.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[min, max], p| [min.min(p), max.max(p)]);
    grid_around(around[0].to_array(), around[1].to_array(), parameters, refinements)
}

/// Why no surface has curves with these turning numbers as its boundary. One with `b` boundary curves has an Euler characteristic of at
/// most `b`, and even or odd as `b` is.
fn impossible(turnings: &[[i64; 2]]) -> Option<VolumeError> {
    let sum = |end: usize| turnings.iter().map(|turning| turning[end]).sum::<i64>();
    let (least, most, curves) = (sum(0), sum(1), turnings.len());
    let even_and_odd = least == most && (least - curves as i64) % 2 != 0;
    (least > curves as i64 || even_and_odd).then_some(VolumeError::Turning { turning: least, curves })
}

/// The mesh on one grid.
fn area_on_grid(
    curves: &ClosedPolylines,
    turnings: &[[i64; 2]],
    grid: &Grid2,
    monitor: &Monitor<'_>,
) -> Result<AreaMesh, Stopped> {
    let ([x, y], [nx, ny]) = (grid.origin(), grid.cells());
    let layer = Grid3::new([x, y, 0.0], grid.spacing(), [nx, ny, 1]).map_err(|_| Stopped {
        trouble: Trouble::TooLarge {
            what: "nodes of the grid",
            count: grid.node_count() as u64,
            most: MAX_NODES / 2,
        },
        place: box_of(grid.origin(), grid.max(), 0),
    })?;
    let front = Front::new(curves, &layer);
    let stopped = |cancelled| Stopped::nowhere(cancelled, &layer);
    let extension = front.extension(monitor).map_err(stopped)?;
    let crossings = front.crossings(monitor).map_err(stopped)?;
    let cut = Cut { grid: &layer, crossings: &crossings, extension: &extension };
    let on_grid =
        mesh_cut(&cut, monitor).map_err(|stopped| Stopped { place: flat_place(stopped.place), ..stopped })?;
    let hosts = AreaHosts::new(curves, &layer, &extension, &on_grid.became);
    let area = flat(grid, on_grid, hosts);
    match wrong_component(curves, turnings, &area) {
        Some((cell, what)) => {
            let place = box_of(grid.node(cell), grid.node(cell.map(|i| i + 1)), 0);
            let trouble = Trouble::Cell { cell: [cell[0], cell[1], 0], what };
            Err(Stopped { trouble, place })
        }
        None => Ok(area),
    }
}

/// The lower side of a layer of hexahedra.
fn flat(grid: &Grid2, on_grid: OnGrid, hosts: AreaHosts) -> AreaMesh {
    let OnGrid { assembled, windings, ambiguous, .. } = on_grid;
    let count = grid.node_count() as u64;
    let mut nodes = Vec::with_capacity(assembled.mesh.nodes().len() / 2);
    let mut number = vec![u32::MAX; assembled.mesh.nodes().len()];
    for (number, &node) in number.iter_mut().zip(assembled.mesh.nodes()) {
        if node < count {
            *number = nodes.len() as u32;
            nodes.push(node);
        }
    }
    let lower = |corners: &[u32; 8]| [0, 1, 2, 3].map(|c| number[corners[c] as usize]);
    let quadrilaterals = assembled.mesh.hexahedra().iter().map(lower).collect();
    let mesh = QuadMesh::by_construction(*grid, nodes, quadrilaterals, assembled.mesh.cells().to_vec());
    let (regions, copies) = (assembled.regions, assembled.copies);
    AreaMesh { mesh, regions, copies, hosts, windings, ambiguous, refinements: 0 }
}

/// A cell of a component that is not what the curves in it bound, and why.
fn wrong_component(
    curves: &ClosedPolylines,
    turnings: &[[i64; 2]],
    area: &AreaMesh,
) -> Option<([u32; 2], &'static str)> {
    let (findings, _) = euler(curves, turnings, area);
    let (quadrilateral, what) = match *findings.first.first()? {
        AreaFinding::Euler { component, .. } => {
            let (of, _) = area.mesh.components();
            let quadrilateral = of.iter().position(|&other| other == component)?;
            (quadrilateral, "the component from here on is not what its curves bound")
        }
        AreaFinding::Torn { corner, .. } => {
            let host = area.hosts.corners[corner as usize].quadrilateral as usize;
            (host, "a curve passes from one component to another")
        }
        _ => return None,
    };
    Some((area.mesh.grid().cell_at(area.mesh.cells()[quadrilateral] as usize), what))
}

/// A place in a layer as one in the plane. What spans both sides of the layer has half as many nodes.
fn flat_place(place: Place) -> Place {
    let nodes = if place.min.z < place.max.z { place.nodes / 2 } else { place.nodes };
    Place { min: place.min.truncate().extend(0.0), max: place.max.truncate().extend(0.0), nodes }
}

fn box_of(min: [f64; 2], max: [f64; 2], nodes: u64) -> Place {
    Place { min: DVec2::from_array(min).extend(0.0), max: DVec2::from_array(max).extend(0.0), nodes }
}
