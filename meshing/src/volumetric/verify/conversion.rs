//! Whether tetrahedra hang together as the hexahedra from which they were made.

use rayon::prelude::*;
use welter_predicates::{Sign, orient3d};

use super::{Finding, Findings};
use crate::Monitor;
use crate::volumetric::complex::{TetError, euler_characteristics, euler_characteristics_of_tetrahedra};
use crate::volumetric::{TetMesh, VolumeMesh};

/// Checks that each tetrahedron has a positive volume, exactly, and that each component of hexahedra became one of tetrahedra with the same Euler
/// characteristic.
///
/// ```
/// use welter_meshing::{Monitor, shapes, volumetric::{VolumeParameters, Resolution, mesh_volume, tetrahedra, verify_conversion}};
/// let surface = shapes::torus(&shapes::Torus::default())?;
/// let parameters = VolumeParameters { resolution: Resolution::ShortestSide(4), ..VolumeParameters::default() };
/// let volume = mesh_volume(&surface, &parameters, &Monitor::none())?;
/// let tetrahedra = tetrahedra(&volume.mesh, &Monitor::none())?;
/// assert!(verify_conversion(&volume, tetrahedra.mesh(), &Monitor::none())?.none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`TetError`]: the tetrahedra are no complex, or cancelled by the monitor.
///
/// # Panics
/// If a tetrahedron names a hexahedron that is none of the mesh.
pub fn verify_conversion(
    volume: &VolumeMesh,
    tetrahedra: &TetMesh,
    monitor: &Monitor<'_>,
) -> Result<Findings, TetError> {
    let after = euler_characteristics_of_tetrahedra(tetrahedra, monitor)?;
    let before = euler_characteristics(&volume.mesh, monitor)?;
    let mut findings = Findings::default();
    let flat: Vec<u32> = (0..tetrahedra.tetrahedra.len() as u32)
        .into_par_iter()
        .filter(|&t| {
            let [a, b, c, d] =
                tetrahedra.tetrahedra[t as usize].map(|v| tetrahedra.positions[v as usize].to_array());
            // `orient3d` is negative where the fourth point is above.
            orient3d(a, b, c, d) != Sign::Negative
        })
        .collect();
    flat.into_iter().for_each(|tetrahedron| findings.add(Finding::Flat { tetrahedron }));
    let mut became: Vec<Option<u32>> = vec![None; before.counts().len()];
    let mut came_from: Vec<Option<u32>> = vec![None; after.counts().len()];
    for (&hexahedron, &ours) in tetrahedra.hexahedra.iter().zip(after.labels().of()) {
        let theirs = before.labels().of()[hexahedron as usize];
        let known =
            [*became[theirs as usize].get_or_insert(ours), *came_from[ours as usize].get_or_insert(theirs)];
        if known != [ours, theirs] {
            findings.add(Finding::Regrouped { hexahedra: theirs, tetrahedra: ours });
        }
    }
    for (component, became) in (0..).zip(became) {
        let characteristic = before.counts()[component as usize].euler_characteristic();
        let of_tetrahedra = became.map(|c| after.counts()[c as usize].euler_characteristic());
        if of_tetrahedra != Some(characteristic) {
            let of_tetrahedra = of_tetrahedra.unwrap_or(0);
            findings.add(Finding::Converted { component, characteristic, of_tetrahedra });
        }
    }
    Ok(findings)
}
