//! The distance of every node of a grid to a surface: [`signed_distance`], [`unsigned_distance`].
//!
//! # What it promises
//! * The magnitude at each node is the distance of [`Bvh::closest_point`](crate::spatial::Bvh::closest_point), bit for bit, with the
//!   bound stated there; 0 at nodes that lie on the surface. Of triangles at the same distance the lowest is the closest.
//! * The sign is exact: that of the winding number, which is decided by predicates, under a rule of what is
//!   inside. So it is right next to edges and vertices, and for surfaces that intersect themselves.
//! * Where a band is given, nodes with a distance of more than the band get the band, with their sign.
//! * The same bits for any number of threads.
//!
//! # What it does not promise
//! That the field is the distance to the boundary of what is inside: for a surface that intersects itself it is the distance to all
//! of the surface, also to the parts within. An open mesh has no sign.
//!
//! # Method
//! Nodes are taken in cubes of eight, one descent of the hierarchy each (`nearest.rs`). A grid that is more than
//! 2^13 times finer than the scene, or 2^8 times larger, is beyond single precision: its nodes are taken one by one.
//!
//! # Complexity
//! O(n log n + nodes log n) in practice for n triangles; with a band, O(n log n + nodes) plus O(log n) for the
//! nodes in the band. Near points at the same distance from much of the surface, as at the centre of a sphere, O(n) a node.

use rayon::prelude::*;

use super::search::{LAYERS, Search};
use super::{DistanceError, DistanceParameters, GridWindingNumbers, grid_winding_numbers};
use crate::grid::{Grid3, Samples};
use crate::spatial::Bvh;
use crate::surface::{ClosedOrientedMesh, TriId, TriMesh};
use crate::{Cancelled, Monitor};

/// The distance to a surface at the nodes of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceField {
    /// The distances; negative inside.
    pub distances: Samples<3>,
    /// The closest triangle of each node, `None` for nodes beyond the band; empty unless asked for. In the order of node numbers.
    pub closest: Vec<Option<TriId>>,
    /// The winding numbers, if asked for; none for unsigned distances.
    pub winding: Option<GridWindingNumbers>,
}

/// The distance of every node of a grid to a closed surface, negative inside; in parallel.
///
/// The empty mesh is infinitely far from everywhere.
///
/// ```
/// use welter_meshing::{Monitor, distance::*, grid::Grid3, shapes::{Box_, box_}};
/// let mesh = box_(&Box_::default())?; // [-1, 1]^3
/// let grid = Grid3::new([-2.0; 3], 0.5, [8; 3])?;
/// let field = signed_distance(&mesh, &grid, &DistanceParameters::default(), &Monitor::none())?;
/// assert_eq!(field.distances.at([4, 4, 4]), -1.0); // the middle
/// assert_eq!(field.distances.at([6, 5, 3]), 0.0); // on the side
/// assert_eq!(field.distances.at([8, 8, 8]), 3f64.sqrt()); // the distance to a corner
///
/// let near = DistanceParameters { band: 0.75, ..DistanceParameters::default() };
/// let field = signed_distance(&mesh, &grid, &near, &Monitor::none())?;
/// assert_eq!([field.distances.at([4, 4, 4]), field.distances.at([4, 4, 5])], [-0.75, -0.5]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`DistanceError`]: a band that is no distance, or cancelled by the monitor.
pub fn signed_distance(
    mesh: &ClosedOrientedMesh,
    grid: &Grid3,
    parameters: &DistanceParameters,
    monitor: &Monitor<'_>,
) -> Result<DistanceField, DistanceError> {
    let mut field = unsigned_distance(mesh, grid, parameters, monitor)?;
    let winding = grid_winding_numbers(mesh, grid, monitor)?;
    let values = field.distances.values_mut();
    values.par_iter_mut().zip(winding.numbers()).for_each(|(value, &number)| {
        if parameters.inside.holds(number) {
            *value = -*value;
        }
    });
    winding.on_surface().iter().for_each(|&(node, _)| values[node] = 0.0);
    field.winding = parameters.winding_numbers.then_some(winding);
    Ok(field)
}

/// The distance of every node of a grid to a mesh, which may be open; in parallel.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, distance::*, grid::Grid3, surface::{TriId, TriMesh, TriangleSoup}};
/// let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
/// let mesh = TriMesh::new(TriangleSoup { positions, triangles: vec![[0, 1, 2]], ..Default::default() })?;
/// let grid = Grid3::new([-1.0; 3], 0.25, [8; 3])?;
/// let parameters = DistanceParameters { closest_triangles: true, ..DistanceParameters::default() };
/// let field = unsigned_distance(&mesh, &grid, &parameters, &Monitor::none())?;
/// assert_eq!(field.distances.at([5, 5, 7]), 0.75); // straight above
/// assert_eq!(field.closest[0], Some(TriId(0)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`DistanceError`]: a band that is no distance, or cancelled by the monitor.
pub fn unsigned_distance(
    mesh: &TriMesh,
    grid: &Grid3,
    parameters: &DistanceParameters,
    monitor: &Monitor<'_>,
) -> Result<DistanceField, DistanceError> {
    parameters.validate()?;
    let bvh = Bvh::new(mesh);
    let search = Search::new(&bvh, grid, parameters.band);
    let layer = grid.nodes()[0] as usize * grid.nodes()[1] as usize;
    let mut values = vec![parameters.band; grid.node_count()];
    let mut closest = vec![None; if parameters.closest_triangles { values.len() } else { 0 }];
    let stage = monitor.stage("distances", u64::from(grid.nodes()[2]));
    let slab = |slab: usize, values: &mut [f64], closest: &mut [Option<TriId>]| {
        search.slab(slab * LAYERS, values, closest, &stage)?;
        stage.advance((values.len() / layer) as u64);
        Ok::<(), Cancelled>(())
    };
    let values_of = values.par_chunks_mut(layer * LAYERS).enumerate();
    if parameters.closest_triangles {
        let closest = closest.par_chunks_mut(layer * LAYERS);
        values_of.zip(closest).try_for_each(|((k, values), closest)| slab(k, values, closest))?;
    } else {
        values_of.try_for_each(|(k, values)| slab(k, values, &mut []))?;
    }
    Ok(DistanceField { distances: Samples::new(*grid, values), closest, winding: None })
}
