//! The same bits by any number of threads, and scaled.

use super::{ball, bits, cuboid, moved, ring, unite};
use glam::DVec3;
use welter_meshing::surface::ClosedOrientedMesh;
use welter_tracking::surface::MovingSurface;

/// In general position, and twice not.
fn pairs() -> [[ClosedOrientedMesh; 2]; 3] {
    let unit = cuboid([0.0; 3], [1.0; 3], 0.25);
    let beside = moved(&unit, |p| p + DVec3::new(0.5, 0.5, 0.0));
    let small = ball(DVec3::ZERO, 1.0, 0.3);
    [[ring(0.25), ball(DVec3::new(0.9, 0.2, 0.1), 0.7, 0.2)], [unit, beside], [small.clone(), small]]
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    for [mesh, shape] in pairs() {
        let by = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut surface = MovingSurface::new(&mesh).unwrap();
                let report = unite(&mut surface, &shape).unwrap();
                (bits(&surface), report)
            })
        };
        let one = by(1);
        assert!(by(3) == one && by(8) == one);
    }
}

#[test]
fn scaled_unions_are_the_same_scaled() {
    for [mesh, shape] in pairs() {
        let scaled = |factor: f64| {
            let [mesh, shape] = [&mesh, &shape].map(|mesh| moved(mesh, |p| p * factor));
            let mut surface = MovingSurface::new(&mesh).unwrap();
            let report = unite(&mut surface, &shape).unwrap();
            let mesh = surface.to_mesh();
            let positions: Vec<DVec3> = mesh.positions().iter().map(|&p| p / factor).collect();
            (positions, mesh.triangles().to_vec(), report.shifts, report.shift / factor, report.segments)
        };
        let one = scaled(1.0);
        for exponent in [-500, -60, 1, 40, 500] {
            assert!(scaled(2.0_f64.powi(exponent)) == one, "2^{exponent}");
        }
    }
}

/// Another order of the axes, which keeps orientation: the same solid, in other places of floating point.
#[test]
fn turned_unions_have_the_same_counts() {
    for [mesh, shape] in pairs() {
        let counts = |turn: fn(DVec3) -> DVec3| {
            let [mesh, shape] = [&mesh, &shape].map(|mesh| moved(mesh, turn));
            let mut surface = MovingSurface::new(&mesh).unwrap();
            let report = unite(&mut surface, &shape).unwrap();
            (surface.connectivity().euler_characteristic(), report.shifts, report.outcome)
        };
        assert_eq!(counts(|p| p), counts(|p| DVec3::new(p.z, p.x, p.y)));
        assert_eq!(counts(|p| p), counts(|p| DVec3::new(p.y, -p.x, p.z)));
    }
}
