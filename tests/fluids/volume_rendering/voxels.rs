//! Volumes of smoke in the voxels of the shadow texture.

use super::{ball, moved, together};
use glam::DVec3;
use welter_fluids::volume_rendering::{VoxelVolumes, voxel_volumes};
use welter_kit::volume_rendering::convex;
use welter_meshing::shapes::{Torus, torus, trefoil_overlap};
use welter_meshing::surface::measure::signed_volume;
use welter_meshing::surface::{ClosedOrientedMesh, TriId};

const LIGHTS: [DVec3; 4] = [DVec3::X, DVec3::NEG_Y, DVec3::new(0.3, -0.8, 0.4), DVec3::new(-1.0, 1e-9, 1e-3)];

fn sum(voxels: &VoxelVolumes) -> f64 {
    voxels.volumes.iter().sum()
}

#[test]
fn the_sum_is_the_volume_of_the_surface() {
    let shapes = [
        ("ball", ball(DVec3::new(10.0, -3.0, 0.2), 1.0, 0.05)),
        ("torus", torus(&Torus { edge_length: 0.1, ..Torus::default() }).unwrap()),
        ("ball inside out", ball(DVec3::ZERO, 0.3, 0.1).reversed()),
        ("knot through itself", trefoil_overlap(&Default::default()).unwrap()),
        ("two balls", together(vec![ball(DVec3::ZERO, 1.0, 0.2), ball(DVec3::X, 0.9, 0.2)])),
    ];
    let mut worst = 0.0_f64;
    for (name, shape) in &shapes {
        let exact = signed_volume(shape);
        for light in LIGHTS {
            for resolution in [1, 7, 40] {
                let voxels = voxel_volumes(shape, light, resolution).unwrap();
                let error = (sum(&voxels) - exact).abs() / exact.abs();
                worst = worst.max(error);
                assert!(error < 1e-12, "{name} {light} {resolution}: {error}");
            }
        }
    }
    println!("sums of voxels differ from volumes by {worst:.1e} of them at most");
}

#[test]
fn every_voxel_holds_what_a_cut_polyhedron_holds() {
    let shape = moved(&ball(DVec3::new(0.2, 0.1, -0.3), 1.0, 0.35), |p| p * DVec3::new(1.0, 0.6, 0.8));
    let faces: convex::Faces =
        (0..shape.triangles().len()).map(|t| shape.corners(TriId::from_index(t)).to_vec()).collect();
    for light in LIGHTS {
        let voxels = voxel_volumes(&shape, light, 9).unwrap();
        let [nx, ny, nz] = voxels.size;
        let whole = voxels.spacing.powi(3);
        let mut partly = 0;
        for j in 0..ny {
            for i in 0..nx {
                for k in 0..nz {
                    let low = [i, j, k].map(|n| n as f64 * voxels.spacing);
                    let low = (0..3).map(|a| voxels.origin[a] + low[a]).collect::<Vec<_>>();
                    let low = [low[0], low[1], low[2]];
                    let high = low.map(|v| v + voxels.spacing);
                    let expected = convex::volume_in_box(&faces, voxels.axes, low, high);
                    let volume = voxels.volumes[(j * nx + i) * nz + k];
                    assert!((volume - expected).abs() < 1e-12 * whole, "{i} {j} {k}: {volume} {expected}");
                    partly += usize::from(volume > 0.01 * whole && volume < 0.99 * whole);
                }
            }
        }
        assert!(partly > 100, "{partly}");
    }
}

#[test]
fn overlaps_count_twice_and_reversed_parts_negatively() {
    let (a, b) = (ball(DVec3::ZERO, 1.0, 0.3), ball(DVec3::new(0.5, 0.3, 0.0), 0.9, 0.3));
    // Specks around keep the lattice of all the same.
    let corner =
        |k: u32| DVec3::from_array([0, 1, 2].map(|axis| if k >> axis & 1 == 1 { 3.0 } else { -3.0 }));
    let specks = || (0..8).map(|k| ball(corner(k), 0.1, 0.1));
    let with_specks = |parts: Vec<ClosedOrientedMesh>| {
        let all = together(specks().chain(parts).collect());
        voxel_volumes(&all, LIGHTS[2], 24).unwrap()
    };
    let none = with_specks(vec![]);
    let [one, two, both] = [vec![a.clone()], vec![b.clone()], vec![a.clone(), b.clone()]].map(with_specks);
    let reversed = with_specks(vec![a, b.reversed()]);
    assert!(one.size == both.size && one.origin == both.origin && one.spacing == both.spacing);
    let cube = one.spacing.powi(3);
    let mut worst = 0.0_f64;
    for at in 0..none.volumes.len() {
        let [n, a, b] = [&none, &one, &two].map(|v| v.volumes[at]);
        worst = worst.max((both.volumes[at] - (a + b - n)).abs() / cube);
        worst = worst.max((reversed.volumes[at] - (a - b + n)).abs() / cube);
    }
    println!("sums of two surfaces differ from both together by {worst:.1e} of a voxel at most");
    assert!(worst < 1e-12);
    assert!(both.volumes.iter().any(|&v| v > 1.999 * cube));
}
