//! What the shadow texture is made of, for those who want to look at it: [`voxel_volumes`].

use glam::DVec3;
use welter_meshing::surface::ClosedOrientedMesh;

use super::light_space::Lattice;
use super::picture::{corners_of, scale_of};
use super::{RenderError, voxels};

/// The volume of smoke in each cube of a lattice: [`voxel_volumes`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct VoxelVolumes {
    /// Unit vectors along which the cubes stand in rows, the last the way of the light.
    pub axes: [DVec3; 3],
    /// The corner of the lattice with the least coordinates along the axes, as these coordinates.
    pub origin: DVec3,
    /// Side of a cube; 0 if there is none.
    pub spacing: f64,
    /// Cubes along each axis.
    pub size: [usize; 3],
    /// The integral of the winding number over each cube; cubes along the last axis stand together, then
    /// those along the first.
    pub volumes: Vec<f64>,
}

/// The integral of the winding number of a surface over each cube of a lattice that encloses it, aligned with
/// a light, with `resolution` cubes along its longest side (from 1 to 4096): the volume inside, of an
/// embedded surface. Exact up to rounding.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::volume_rendering::voxel_volumes;
/// use welter_meshing::shapes::{Box_, box_};
/// let smoke = box_(&Box_ { min: DVec3::ZERO, max: DVec3::new(4.0, 2.0, 1.0), edge_length: 1.0 })?;
/// let voxels = voxel_volumes(&smoke, DVec3::NEG_Z, 2)?;
/// assert_eq!(voxels.size.iter().product::<usize>(), 2);
/// assert_eq!(voxels.volumes, [4.0, 4.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RenderError`]: no direction, too many voxels.
pub fn voxel_volumes(
    smoke: &ClosedOrientedMesh,
    light: DVec3,
    resolution: u32,
) -> Result<VoxelVolumes, RenderError> {
    RenderError::require_finite("the direction of the light", light)?;
    let fits = (1..=4096).contains(&resolution);
    RenderError::require(fits, "resolution", f64::from(resolution), "from 1 to 4096")?;
    let scale = scale_of(smoke.positions().iter());
    let positions: Vec<DVec3> = smoke.positions().iter().map(|&p| p * scale).collect();
    let corners = corners_of(smoke, &positions);
    let lattice = Lattice::enclosing(corners.iter().flatten().copied(), 0.0, light, resolution)?;
    let mut volumes = Vec::new();
    if !lattice.is_empty() {
        let placed: Vec<_> = corners.iter().map(|t| t.map(|p| lattice.place_inside(p))).collect();
        volumes = voxels::volumes(&placed, lattice.size);
    }
    let Lattice { axes, origin, spacing, size } = lattice;
    let (origin, spacing) = (origin / scale, spacing / scale);
    volumes.iter_mut().for_each(|volume| *volume *= spacing * spacing * spacing);
    Ok(VoxelVolumes { axes, origin, spacing, size, volumes })
}
