//! What tells whether tetrahedra hang together as their hexahedra.

use super::*;
use welter_meshing::DVec3;
use welter_meshing::shapes::{BoxPair, Torus, torus, two_boxes};
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh};
use welter_meshing::volumetric::{
    Finding, Resolution, VolumeMesh, VolumeParameters, mesh_volume, verify_conversion,
};

/// Two overlapping boxes and, elsewhere, a torus: components of Euler characteristics 1, 1 and 0.
fn volume() -> VolumeMesh {
    let mut soup = two_boxes(&BoxPair::overlapping()).unwrap().to_soup();
    let ring = torus(&Torus::default()).unwrap();
    let shift = soup.positions.len() as u32;
    soup.positions.extend(ring.positions().iter().map(|&p| p + DVec3::splat(10.0)));
    soup.triangles.extend(ring.triangles().iter().map(|t| t.map(|v| v.0 + shift)));
    soup.groups.clear();
    let surface = ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap();
    let parameters = VolumeParameters { resolution: Resolution::Spacing(0.2), ..VolumeParameters::default() };
    mesh_volume(&surface, &parameters, &Monitor::none()).unwrap()
}

fn findings(volume: &VolumeMesh, change: impl FnOnce(&mut TetMesh)) -> Vec<Finding> {
    let made = tetrahedra(&volume.mesh, &Monitor::none()).unwrap();
    let mut mesh = made.mesh().clone();
    change(&mut mesh);
    verify_conversion(volume, &mesh, &Monitor::none()).unwrap().first
}

#[test]
fn tetrahedra_are_as_their_hexahedra() {
    assert_eq!(findings(&volume(), |_| ()), []);
}

#[test]
fn faults_of_tetrahedra_are_found() {
    let volume = volume();
    // One inside out.
    let turned = findings(&volume, |mesh| mesh.tetrahedra[7].swap(0, 1));
    assert_eq!(turned, [Finding::Flat { tetrahedron: 7 }]);
    // A hole: a tetrahedron within is missing, so that its boundary is a cavity.
    let counts = |mesh: &TetMesh| {
        let mut of_vertex = vec![0; mesh.positions.len()];
        mesh.tetrahedra.iter().flatten().for_each(|&v| of_vertex[v as usize] += 1);
        of_vertex
    };
    let hole = findings(&volume, |mesh| {
        let of_vertex = counts(mesh);
        // Vertices within have at least 24 tetrahedra around them, nodes at a corner of the boundary far fewer.
        let within = (0..mesh.tetrahedra.len())
            .max_by_key(|&t| mesh.tetrahedra[t].iter().map(|&v| of_vertex[v as usize]).min())
            .unwrap();
        mesh.tetrahedra.remove(within);
        mesh.hexahedra.remove(within);
    });
    assert!(
        matches!(hole[..], [Finding::Converted { characteristic, of_tetrahedra, .. }] if of_tetrahedra == characteristic + 1),
        "{hole:?}"
    );
    // One that hangs together with nothing.
    let loose = findings(&volume, |mesh| {
        let copies: Vec<DVec3> = mesh.tetrahedra[0].iter().map(|&v| mesh.positions[v as usize]).collect();
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(copies);
        mesh.tetrahedra[0] = [0, 1, 2, 3].map(|n| first + n);
    });
    assert!(loose.iter().any(|finding| matches!(finding, Finding::Regrouped { .. })), "{loose:?}");
    // Two components that have a vertex in common.
    let joined = findings(&volume, |mesh| {
        let last = mesh.tetrahedra.len() - 1;
        let (vertex, other) = (mesh.tetrahedra[0][0], mesh.tetrahedra[last][0]);
        mesh.positions[other as usize] = mesh.positions[vertex as usize];
        mesh.tetrahedra.iter_mut().flatten().filter(|v| **v == other).for_each(|v| *v = vertex);
    });
    assert!(joined.iter().any(|finding| matches!(finding, Finding::Regrouped { .. })), "{joined:?}");
}
