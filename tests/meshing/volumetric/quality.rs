//! Figures of tetrahedra.

use super::*;
use welter_meshing::DVec3;

fn quality(mesh: &TetMesh) -> TetQuality {
    tetrahedra_quality(mesh, &Monitor::none()).unwrap().unwrap()
}

fn single(corners: [[f64; 3]; 4]) -> TetMesh {
    TetMesh {
        positions: corners.map(DVec3::from_array).to_vec(),
        tetrahedra: vec![[0, 1, 2, 3]],
        hexahedra: vec![0],
    }
}

#[test]
fn tetrahedra_of_hexahedra_are_of_two_shapes() {
    let block = tetrahedra(&blocks([4; 3], 1), &Monitor::none()).unwrap();
    let q = quality(block.mesh());
    let (inner, outer) = (4 * 3 * 3 * 16, 4 * 6 * 16);
    assert_eq!((q.count, q.not_positive, q.first_not_positive), (inner + outer, 0, None));
    assert!((q.volume - 64.0).abs() < 1e-12);
    assert_eq!([q.min_volume, q.max_volume], [1.0 / 24.0, 1.0 / 12.0]);
    // Between centres: four angles of 60 degrees and two of 90. At the boundary: 45, 60, 60 and three times 90.
    let near = |angle: f64, degrees: f64| (angle.to_degrees() - degrees).abs() < 1e-12;
    assert!(near(q.min_dihedral, 45.0) && near(q.max_dihedral, 90.0), "{q:?}");
    assert_eq!(q.dihedral_histogram.iter().sum::<u64>(), 6 * q.count);
    assert_eq!(q.dihedral_histogram[4], outer);
    assert_eq!(q.dihedral_histogram[5] + q.dihedral_histogram[6], 4 * inner + 2 * outer);
    assert_eq!(q.dihedral_histogram[8] + q.dihedral_histogram[9], 2 * inner + 3 * outer);
    assert_eq!(q.ratio_histogram.iter().sum::<u64>(), q.count);
    assert_eq!(q.ratio_histogram[9], inner);
    assert_eq!(q.min_ratio_at, q.min_dihedral_at);
}

#[test]
fn radius_ratios_are_those_of_the_spheres() {
    // Three unit edges at right angles: radii 1 / (3 + sqrt 3) and sqrt(3) / 2.
    let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let expected = 3.0 / (3.0 + 3.0_f64.sqrt()) / (3.0_f64.sqrt() / 2.0);
    for scale in [1.0, 1e-200, 1e200] {
        let q = quality(&single(corner.map(|p| p.map(|x| x * scale))));
        assert!((q.min_ratio - expected).abs() < 1e-15, "{scale} {}", q.min_ratio);
        assert!((q.min_dihedral.to_degrees() - (1.0 / 3.0_f64.sqrt()).acos().to_degrees()).abs() < 1e-12);
        assert_eq!(q.not_positive, 0);
    }
}

#[test]
fn what_is_flat_or_inside_out_is_counted() {
    let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut mesh = single(corner);
    mesh.tetrahedra.push([1, 0, 2, 3]);
    mesh.positions
        .extend([[1.0, 1.0, 0.0], [f64::NAN, 0.0, 0.0], [0.0, f64::INFINITY, 0.0]].map(DVec3::from_array));
    mesh.tetrahedra.extend([[0, 1, 2, 4], [0, 1, 2, 5], [0, 1, 2, 6]]);
    let q = quality(&mesh);
    assert_eq!((q.count, q.not_positive, q.first_not_positive), (5, 4, Some(1)));
    assert_eq!((q.min_ratio, q.min_ratio_at, q.ratio_histogram[0]), (0.0, 1, 4));
    assert_eq!(q.dihedral_histogram.iter().sum::<u64>(), 30);
    assert!(tetrahedra_quality(&TetMesh::default(), &Monitor::none()).unwrap().is_none());
}
