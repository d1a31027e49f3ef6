//! What must not depend on where a curve lies, how it is numbered, and how large it is.

use glam::DVec2;
use welter_meshing::volumetric::plane::{AreaMesh, ClosedPolylines};

use super::{check, curves, meshed, strip};

const SPACING: f64 = 0.125;

/// A strip with coordinates that are multiples of 1 / 1024, so that moves by whole cells are exact.
fn subject() -> Vec<Vec<[f64; 2]>> {
    let path: Vec<[f64; 2]> = (0..=48)
        .map(|k| {
            let t = -2.0 + 4.0 * f64::from(k) / 48.0;
            [t * t * t - 2.0 * t, 3.0 - t * t]
        })
        .collect();
    let round = |p: [f64; 2]| p.map(|x| (x * 1024.0).round() / 1024.0);
    let strip = strip(&path, 0.75).into_iter().map(round).collect();
    vec![strip, vec![[-1.0, 0.75], [1.5, 1.0], [0.25, 2.5]]]
}

fn moved(map: impl Fn(DVec2) -> DVec2) -> ClosedPolylines {
    let loops: Vec<Vec<[f64; 2]>> = subject()
        .iter()
        .map(|points| points.iter().map(|&p| map(DVec2::from_array(p)).to_array()).collect())
        .collect();
    curves(&loops)
}

/// What does not depend on the numbers of corners: the mesh, and its copies.
fn same_mesh(a: &AreaMesh, b: &AreaMesh) {
    assert_eq!(a.mesh.nodes().len(), b.mesh.nodes().len());
    assert_eq!(a.mesh.cells(), b.mesh.cells());
    assert_eq!(a.windings, b.windings);
    assert_eq!(a.regions.len(), b.regions.len());
    assert_eq!(a.ambiguous, b.ambiguous);
    let sorted = |area: &AreaMesh| {
        let mut all = area.mesh.components().1;
        all.sort_unstable();
        all
    };
    assert_eq!(sorted(a), sorted(b));
}

#[test]
fn shifts_by_whole_cells() {
    let here = meshed(&moved(|p| p), SPACING).unwrap();
    check(&moved(|p| p), &here);
    for shift in [DVec2::new(0.25, -1.5), DVec2::new(-64.0, 128.125)] {
        let there = meshed(&moved(|p| p + shift), SPACING).unwrap();
        assert_eq!(there.mesh.quadrilaterals(), here.mesh.quadrilaterals());
        assert_eq!(there.mesh.nodes(), here.mesh.nodes());
        assert_eq!((&there.regions, &there.copies), (&here.regions, &here.copies));
        assert_eq!(there.hosts, here.hosts);
    }
}

#[test]
fn scales_by_powers_of_two() {
    let here = meshed(&moved(|p| p), SPACING).unwrap();
    for scale in [2f64.powi(-40), 4.0, 2f64.powi(60)] {
        let there = meshed(&moved(|p| scale * p), scale * SPACING).unwrap();
        assert_eq!(there.mesh.quadrilaterals(), here.mesh.quadrilaterals());
        assert_eq!(there.mesh.nodes(), here.mesh.nodes());
        assert_eq!(there.hosts, here.hosts);
    }
}

#[test]
fn other_starts_of_loops_and_other_numbers() {
    let here = meshed(&moved(|p| p), SPACING).unwrap();
    for start in [1, 7, 40] {
        let mut loops = subject();
        for points in &mut loops {
            let by = start % points.len();
            points.rotate_left(by);
        }
        same_mesh(&meshed(&curves(&loops), SPACING).unwrap(), &here);
        loops.reverse();
        let there = curves(&loops);
        let area = meshed(&there, SPACING).unwrap();
        check(&there, &area);
        same_mesh(&area, &here);
    }
}

#[test]
fn more_corners_on_the_same_segments() {
    let here = meshed(&moved(|p| p), SPACING).unwrap();
    let halved: Vec<Vec<[f64; 2]>> = subject()
        .iter()
        .map(|points| {
            (0..2 * points.len())
                .map(|k| {
                    let [a, b] =
                        [k / 2, (k / 2 + k % 2) % points.len()].map(|k| DVec2::from_array(points[k]));
                    (0.5 * (a + b)).to_array()
                })
                .collect()
        })
        .collect();
    same_mesh(&meshed(&curves(&halved), SPACING).unwrap(), &here);
}

#[test]
fn the_same_for_any_number_of_threads() {
    let here = meshed(&moved(|p| p), SPACING).unwrap();
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| meshed(&moved(|p| p), SPACING)).unwrap(), here);
    }
}
