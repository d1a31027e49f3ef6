//! Whether what is inside of a surface is inside once: [`misplaced_components`].

use glam::DVec3;
use welter_meshing::spatial::{Winding, winding_number};
use welter_meshing::surface::measure::signed_volume;
use welter_meshing::surface::{ClosedOrientedMesh, Topology, TriId, TriMesh, TriangleSoup};

/// How many components of a closed surface are not where their orientation says: one with its normals outside is to lie
/// where the others wind zero times, a void where they wind once. Components that are open count neither as these nor as others.
#[must_use]
pub fn misplaced_components(mesh: &TriMesh) -> usize {
    let topology = Topology::of(mesh);
    let count = topology.components().len();
    let closed: Vec<bool> = topology.components().iter().map(|c| c.closed).collect();
    let part = |wanted: &dyn Fn(usize) -> bool| {
        let mine = |&(t, _): &(usize, _)| wanted(topology.component_of(TriId::from_index(t)));
        let triangles = mesh.triangles().iter().enumerate().filter(mine);
        let soup = TriangleSoup {
            positions: mesh.positions().to_vec(),
            triangles: triangles.map(|(_, t)| t.map(|v| v.0)).collect(),
            ..TriangleSoup::default()
        };
        TriMesh::new(soup).expect("a part of a mesh")
    };
    let misplaced = |component: usize| {
        let (own, others) = (part(&|c| c == component), part(&|c| c != component && closed[c]));
        let Ok(others) = ClosedOrientedMesh::new(others) else { return false };
        // Of the largest triangle the middle is farthest from what it may share with others.
        let places = own.triangles().iter().map(|t| t.map(|v| own.positions()[v.index()]));
        let area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length();
        let [a, b, c] = places.max_by(|&s, &t| area(s).total_cmp(&area(t))).expect("no component is empty");
        let expected = i32::from(signed_volume(&own) < 0.0);
        winding_number(&others, a / 3.0 + b / 3.0 + c / 3.0) != Winding::Number(expected)
    };
    if count < 2 { 0 } else { (0..count).filter(|&c| closed[c] && misplaced(c)).count() }
}
