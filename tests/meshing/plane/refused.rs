//! Curves that bound no area, and input that is none.

use glam::DVec2;
use welter_meshing::Monitor;
use welter_meshing::volumetric::plane::{ClosedPolylines, mesh_area};
use welter_meshing::volumetric::{VolumeError, VolumeParameters};

use super::{curves, meshed};

#[test]
fn figure_eight() {
    let eight = curves(&[vec![[0.0, 0.0], [4.0, 3.0], [4.0, 0.0], [0.0, 3.0]]]);
    let Err(VolumeError::Negative { place, winding }) = meshed(&eight, 0.25) else { panic!() };
    assert_eq!(winding, -1);
    assert!(place.nodes > 0 && place.min.z == 0.0 && place.max.z == 0.0);
    let lobe = [place.min, place.max].map(|p| p.truncate());
    assert!(lobe[0].x >= 0.0 && lobe[1].x <= 4.0 && lobe[0].y >= 0.0 && lobe[1].y <= 3.0, "{lobe:?}");
    let grid_nodes = (0..=16).flat_map(|i| (0..=12).map(move |j| [f64::from(i) / 4.0, f64::from(j) / 4.0]));
    let inside = grid_nodes.filter(|&p| super::winding(&eight, DVec2::from_array(p)) == -1).count();
    assert_eq!(place.nodes, inside as u64);
}

#[test]
fn clockwise() {
    let inside_out = curves(&[vec![[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]]);
    assert!(matches!(meshed(&inside_out, 0.25), Err(VolumeError::Negative { winding: -1, .. })));
}

#[test]
fn winding_twice() {
    // Once around within, once around without: a double cover with a branch point, no immersion.
    let at = |k: i32| {
        let a = std::f64::consts::TAU * f64::from(k) / 24.0;
        let r = 2.0 + (0.5 * a).cos();
        [r * a.cos(), r * a.sin()]
    };
    let twice = curves(&[(0..48).map(at).collect()]);
    assert_eq!(twice.turning(0), [2, 2]);
    let error = meshed(&twice, 0.2).unwrap_err();
    assert_eq!(error, VolumeError::Turning { turning: 2, curves: 1 });
}

#[test]
fn nothing() {
    let nothing = ClosedPolylines::new(vec![DVec2::ZERO], vec![]).unwrap();
    let error = mesh_area(&nothing, &VolumeParameters::default(), &Monitor::none()).unwrap_err();
    assert_eq!(error, VolumeError::Empty);
}

#[test]
fn every_defect_is_named() {
    let positions = vec![DVec2::NAN, DVec2::ZERO, DVec2::X, DVec2::new(0.0, f64::INFINITY)];
    let loops = vec![vec![0, 1, 9], vec![1, 2], vec![], vec![1, 1, 2]];
    let defects = ClosedPolylines::new(positions, loops).unwrap_err();
    assert_eq!(defects.not_finite, [0, 3]);
    assert_eq!(defects.out_of_range, [2]);
    assert_eq!(defects.short, [1, 2]);
    assert_eq!(defects.repeated, [5]);
    assert_eq!(
        defects.to_string(),
        "2 positions are not finite: 0, 3; 1 corner has an index out of range: 2; \
         1 corner has the index of the next one: 5; 2 loops have less than three corners: 1, 2"
    );
}

#[test]
fn degenerate_loops_are_no_panic() {
    for points in
        [[[1.0, 1.0]; 3], [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], [[0.0, 0.0], [1.0, 2.0], [0.0, 0.0]]]
    {
        let flat = curves(&[points.to_vec(), vec![[-1.0, -1.0], [3.0, -1.0], [3.0, 3.0]]]);
        match meshed(&flat, 0.5) {
            Ok(area) => super::check(&flat, &area),
            Err(VolumeError::Negative { .. } | VolumeError::UnderResolved { .. }) => {}
            Err(error) => panic!("{error}"),
        }
    }
}
