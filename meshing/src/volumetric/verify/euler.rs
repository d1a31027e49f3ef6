//! Whether components have half the Euler characteristic of their boundaries.

use super::{Finding, Findings};
use crate::volumetric::complex::euler_characteristics;
use crate::volumetric::pairing::Pairing;
use crate::volumetric::precursors::cell_box;
use crate::volumetric::{Place, VolumeMesh};
use crate::{Cancelled, DVec3, Monitor};

/// What was found, and the Euler characteristic of each component.
pub(in crate::volumetric) fn check(
    volume: &VolumeMesh,
    pairing: &Pairing,
    monitor: &Monitor<'_>,
) -> Result<(Findings, Vec<i64>), Cancelled> {
    let components = euler_characteristics(&volume.mesh, monitor)?;
    let characteristics: Vec<i64> =
        components.counts().iter().map(|counts| counts.euler_characteristic()).collect();
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

/// The box of the component that a finding is about.
pub(in crate::volumetric) fn place_of(
    finding: &Finding,
    volume: &VolumeMesh,
    monitor: &Monitor<'_>,
) -> Result<Place, Cancelled> {
    let of = match *finding {
        Finding::Euler { component, .. } | Finding::Torn { components: [component, _], .. } => component,
        _ => 0,
    };
    let components = euler_characteristics(&volume.mesh, monitor)?;
    let grid = volume.mesh.grid();
    let mut place = Place { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY, nodes: 0 };
    for (hexahedron, _) in components.labels().of().iter().enumerate().filter(|(_, label)| **label == of) {
        let [min, max] = cell_box(grid, grid.cell_at(volume.mesh.cells()[hexahedron] as usize));
        place.min = place.min.min(DVec3::from_array(min));
        place.max = place.max.max(DVec3::from_array(max));
    }
    Ok(place)
}
