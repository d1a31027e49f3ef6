//! Whether what is inside of a surface is inside once: [`misplaced_components`].

use crate::exact::{determinant, lift};
use glam::DVec3;
use rug::Integer;
use welter_meshing::spatial::{Winding, winding_number};
use welter_meshing::surface::measure::signed_volume_bounded;
use welter_meshing::surface::{ClosedOrientedMesh, Topology, TriId, TriMesh, TriangleSoup, VertexId};
use welter_predicates::Sign;

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
        let expected = i32::from(is_void(&own));
        winding_number(&others, a / 3.0 + b / 3.0 + c / 3.0) != Winding::Number(expected)
    };
    if count < 2 { 0 } else { (0..count).filter(|&c| closed[c] && misplaced(c)).count() }
}

/// Whether a closed surface has a negative volume, exactly: next to nothing may be left of one.
fn is_void(mesh: &TriMesh) -> bool {
    let sign = signed_volume_bounded(mesh).sign();
    if sign != Sign::Zero {
        return sign == Sign::Negative;
    }
    let positions: Vec<[f64; 3]> = mesh.positions().iter().map(|p| p.to_array()).collect();
    let lifted = lift(&positions);
    let product = |t: &[VertexId; 3]| determinant(&t.map(|v| lifted[v.index()].to_vec()));
    mesh.triangles().iter().map(product).sum::<Integer>() < 0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron so flat that the volume is rounded to the wrong sign is told by integers, both ways round.
    #[test]
    fn flat_components_are_told_by_their_exact_volume() {
        let mut doubtful = 0;
        for k in 1..200 {
            let tip = f64::from(k) * 0.01;
            let corners = [[0.1, 0.2, 0.3], [1.1, 0.7, 0.9], [0.3, 1.9, 1.2]].map(DVec3::from_array);
            let inside = (corners[0] + corners[1] + corners[2]) / 3.0 + tip * (corners[0] - corners[1]) * 0.1;
            let positions = [corners.to_vec(), vec![inside]].concat();
            let solid = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
            let orientation =
                crate::exact::orient(&positions.iter().map(|p| p.to_array()).collect::<Vec<_>>());
            if orientation == 0 {
                continue;
            }
            let mesh = |turned: bool| {
                let triangles = solid.map(|[a, b, c]| if turned { [a, c, b] } else { [a, b, c] }).to_vec();
                let positions = positions.clone();
                TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() }).unwrap()
            };
            doubtful += usize::from(signed_volume_bounded(&mesh(false)).sign() == Sign::Zero);
            assert_ne!(is_void(&mesh(false)), is_void(&mesh(true)));
            // The tetrahedron whose last corner is on the inner side of the first triangle is a solid.
            let large = [corners.to_vec(), vec![corners[0] + DVec3::new(0.0, 0.0, 1.0)]].concat();
            let same =
                crate::exact::orient(&large.iter().map(|p| p.to_array()).collect::<Vec<_>>()) == orientation;
            let reference = TriMesh::new(TriangleSoup {
                positions: large,
                triangles: solid.to_vec(),
                ..Default::default()
            })
            .unwrap();
            assert_eq!(is_void(&mesh(false)) == is_void(&reference), same);
        }
        assert!(doubtful > 50, "{doubtful}");
    }
}
