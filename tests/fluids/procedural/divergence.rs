//! What flows out of closed surfaces, for everything with a potential: nothing.

use super::{mixture, points, potentials, ring};
use glam::DVec3;
use welter_fluids::procedural::{
    BoundaryParameters, Bounded, Interpolation, Moving, Path, VectorPotential, VortexRingParameters,
};
use welter_kit::procedural::{flux_of_box, flux_of_sphere};
use welter_meshing::field::Ball;
use welter_tracking::flows::VelocityField;

/// Asks that what flows out of some boxes and balls be nothing, next to what flows through.
fn check(name: &str, flow: &impl VectorPotential, size: f64, panels: u32) {
    let at = |p: DVec3| flow.velocity(p, 0.3);
    for center in points(3, 0.5 * size, 41) {
        let half = size * DVec3::new(0.5, 0.3, 0.4);
        let of_box = flux_of_box(at, [center - half, center + half], panels);
        let of_sphere = flux_of_sphere(at, center, 0.4 * size, panels);
        for flux in [of_box, of_sphere] {
            assert!(flux.relative() < 1e-14, "{name} around {center}: {flux:?}");
        }
    }
}

#[test]
fn nothing_flows_out_of_primitives() {
    for (name, flow) in potentials(1.0) {
        check(name, &flow, 1.0, 3);
    }
}

#[test]
fn nothing_flows_out_of_sums_and_moving_parts() {
    check("sum", &mixture(1.0), 1.0, 3);
    let path = Path::new(vec![(0.0, DVec3::ZERO), (1.0, DVec3::X)], Interpolation::Smooth).unwrap();
    check("moving sum", &Moving { part: mixture(1.0), path }, 1.0, 3);
}

#[test]
fn nothing_flows_out_of_huge_and_tiny_flows() {
    for factor in [1e-60, 1e60] {
        check("sum", &mixture(factor), factor, 3);
    }
}

/// Around the core of a ring, much smaller than it, and around the centre and the axis.
#[test]
fn nothing_flows_out_of_the_core() {
    let parameters = VortexRingParameters { core: 0.02, ..Default::default() };
    let ring = ring(parameters);
    let at = |p: DVec3| ring.velocity(p, 0.0);
    for (center, half) in [
        (DVec3::new(1.0, 0.0, 0.0), 0.02),
        (DVec3::new(0.6, 0.01, 0.8), 0.03),
        (DVec3::ZERO, 0.2),
        (DVec3::new(0.0, 0.5, 0.0), 1e-6),
        (DVec3::new(1.01, 0.0, 0.0), 1e-6),
    ] {
        let flux = flux_of_box(at, [center - 1.1 * half, center + 0.9 * half], 4);
        assert!(flux.relative() < 1e-14, "{center} {half}: {flux:?}");
    }
}

/// Around a solid, through its layer and through the solid itself; the ramp is smooth, but of finite order at the end of the layer, so boxes
/// lie within it.
#[test]
fn nothing_flows_out_of_bounded_flows() {
    let ball = Ball { center: DVec3::new(0.2, 0.1, 0.0), radius: 0.3 };
    for anchor in [None, Some(ball.center)] {
        for (name, flow) in potentials(1.0) {
            let parameters = BoundaryParameters { ramp_width: 2.0, anchor, path: None };
            let bounded = Bounded::new(flow, ball, &parameters).unwrap();
            let at = |p: DVec3| bounded.velocity(p, 0.3);
            for (center, half) in [(DVec3::new(0.2, 0.7, 0.1), 0.2), (DVec3::new(0.45, 0.3, 0.2), 0.15)] {
                let flux = flux_of_box(at, [center - half, center + half], 3);
                assert!(flux.relative() < 1e-14, "{name} around {center}: {flux:?}");
            }
            // Nothing flows through spheres around the solid, and nothing at all through its own.
            let around = flux_of_sphere(at, ball.center, 0.5, 5);
            assert!(around.relative() < 1e-14, "{name}: {around:?}");
        }
    }
}
