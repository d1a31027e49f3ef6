//! Whether components have half the Euler characteristic of their boundaries.

use super::{Finding, Findings};
use crate::surface::ClosedOrientedMesh;
use crate::volumetric::VolumeMesh;
use crate::volumetric::complex::euler_characteristics;
use crate::volumetric::pairing::Pairing;
use crate::{Cancelled, Monitor};

/// What was found, and the Euler characteristic of each component.
pub(super) fn check(
    surface: &ClosedOrientedMesh,
    volume: &VolumeMesh,
    monitor: &Monitor<'_>,
) -> Result<(Findings, Vec<i64>), Cancelled> {
    let components = euler_characteristics(&volume.mesh, monitor)?;
    let characteristics: Vec<i64> =
        components.counts().iter().map(|counts| counts.euler_characteristic()).collect();
    let pairing = Pairing::new(surface);
    let mut findings = Findings::default();
    let mut of_surface: Vec<Option<u32>> = vec![None; pairing.characteristics().len()];
    for &[hexahedron, triangle] in &volume.hosts.triangles {
        let component = components.labels().of()[hexahedron as usize];
        match &mut of_surface[pairing.component_of()[triangle as usize] as usize] {
            Some(known) if *known != component => {
                findings.add(Finding::Torn { triangle, components: [component, *known] });
            }
            known => *known = Some(component),
        }
    }
    let mut boundary = vec![0; characteristics.len()];
    for (component, characteristic) in of_surface.iter().zip(pairing.characteristics()) {
        if let Some(component) = component {
            boundary[*component as usize] += characteristic;
        }
    }
    for (component, (&characteristic, &surface)) in (0..).zip(characteristics.iter().zip(&boundary)) {
        if 2 * characteristic != surface {
            findings.add(Finding::Euler { component, characteristic, surface });
        }
    }
    Ok((findings, characteristics))
}
