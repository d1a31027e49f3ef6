//! Orders of the schemes, return of the Enright test, volumes.

use super::{ball, order, run};
use glam::DVec3;
use welter_meshing::surface::measure::signed_volume;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters, Enright, Rotation, Shear};
use welter_tracking::flows::{Advection, Flow, Scheme};
use welter_tracking::surface::MovingSurface;

#[test]
fn orders_of_the_schemes_on_a_rotation() {
    let rotation =
        Rotation { center: DVec3::new(0.5, 0.25, 0.0), angular_velocity: DVec3::new(1.0, -2.0, 0.5) };
    let start = ball(1.0, 0.5);
    let error = |scheme: Scheme, steps: u32| {
        let mut surface = start.clone();
        let dt = 1.0 / f64::from(steps);
        run(&mut surface, &Advection { field: rotation, scheme }, [0.0, 1.0], dt);
        let axis = rotation.angular_velocity.normalize();
        let turn = glam::DQuat::from_axis_angle(axis, rotation.angular_velocity.length());
        let exact = |p: DVec3| rotation.center + turn * (p - rotation.center);
        let ends = start.positions().iter().map(|&p| exact(p));
        ends.zip(surface.positions()).map(|(a, &b)| a.distance(b)).fold(0.0, f64::max)
    };
    for (scheme, expected, steps) in [(Scheme::Euler, 1.0, [256, 512]), (Scheme::Rk4, 4.0, [16, 32])] {
        let errors = steps.map(|steps| error(scheme, steps));
        let order = order(&[2.0, 1.0], &errors);
        println!("{scheme:?}: errors {errors:?}, order {order}");
        assert!((order - expected).abs() < 0.1, "{scheme:?}: order {order}, errors {errors:?}");
    }
}

#[test]
fn the_order_of_runge_and_kutta_in_time_dependent_fields() {
    // x' = (cos t + 1) y, y' = -(cos t + 1) x turns by sin t + t.
    let field = |p: DVec3, t: f64| (t.cos() + 1.0) * DVec3::new(p.y, -p.x, 0.0);
    let start = ball(1.0, 0.5);
    let errors = [16, 32].map(|steps| {
        let mut surface = start.clone();
        run(&mut surface, &Advection { field, scheme: Scheme::Rk4 }, [0.0, 2.0], 2.0 / f64::from(steps));
        let turn = glam::DQuat::from_rotation_z(-(2f64.sin() + 2.0));
        let pairs = start.positions().iter().zip(surface.positions());
        pairs.map(|(&p, &q)| (turn * p).distance(q)).fold(0.0, f64::max)
    });
    let order = order(&[2.0, 1.0], &errors);
    assert!((order - 4.0).abs() < 0.15, "{order}: {errors:?}");
}

fn enright_ball(edge_length: f64) -> MovingSurface {
    let mut surface = ball(0.15, edge_length);
    let vertices: Vec<_> = surface.connectivity().vertices().collect();
    for v in vertices {
        surface.set_position(v, surface.position(v) + DVec3::splat(0.35)).unwrap();
    }
    surface
}

#[test]
fn the_enright_test_returns() {
    let start = enright_ball(0.02);
    let mut surface = start.clone();
    let flow = Advection { field: Enright::default(), scheme: Scheme::Rk4 };
    run(&mut surface, &flow, [0.0, 1.5], 0.01);
    let far = start.positions().iter().zip(surface.positions()).map(|(a, b)| a.distance(*b));
    let farthest = far.fold(0.0, f64::max);
    assert!(farthest > 0.3, "half of the time: {farthest}");
    // At rest at half of the period: the second half is the first one backwards.
    run(&mut surface, &flow, [1.5, 3.0], 0.01);
    let back = start.positions().iter().zip(surface.positions()).map(|(a, b)| a.distance(*b));
    let back = back.fold(0.0, f64::max);
    let volumes = [&start, &surface].map(|surface| signed_volume(&surface.to_mesh()));
    let drift = (volumes[1] / volumes[0] - 1.0).abs();
    println!(
        "Enright, no remeshing: farthest {farthest:.3}, back within {back:.3e}, volume drift {drift:.3e}"
    );
    // Errors of order 4 in the step of 0.01: 8e-6 is what is measured at the worst vertex.
    assert!(back < 2e-5, "{back:e}");
    assert!(drift < 1e-6, "{drift:e}");
}

#[test]
fn the_enright_test_returns_with_order_four() {
    let start = enright_ball(0.06);
    let errors = [0.02, 0.01].map(|dt| {
        let mut surface = start.clone();
        run(&mut surface, &Advection { field: Enright::default(), scheme: Scheme::Rk4 }, [0.0, 3.0], dt);
        let pairs = start.positions().iter().zip(surface.positions());
        pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
    });
    let order = order(&[2.0, 1.0], &errors);
    println!("Enright: back within {errors:?}, order {order}");
    assert!(order > 3.5, "{order}: {errors:?}");
}

/// Fields without divergence keep volumes, as far as triangles follow the surface; of linear fields they do exactly.
#[test]
fn volumes_in_fields_without_divergence() {
    let drift = |edge_length: f64, flow: &dyn Flow| {
        let mut surface = ball(0.5, edge_length);
        let before = signed_volume(&surface.to_mesh());
        run(&mut surface, flow, [0.0, 0.5], 0.05);
        (signed_volume(&surface.to_mesh()) / before - 1.0).abs()
    };
    let shear = Advection { field: Shear::default(), scheme: Scheme::Rk4 };
    assert!(drift(0.1, &shear) < 1e-13);
    // Runge and Kutta multiply lengths across the axis by |1 + ia - a^2/2 - ia^3/6 + a^4/24| for a turn by `a`.
    let rotation = Advection { field: Rotation::default(), scheme: Scheme::Rk4 };
    let turn = 0.05 * std::f64::consts::TAU;
    let areas = (1.0 - turn.powi(6) / 72.0 + turn.powi(8) / 576.0).powi(10);
    assert!((drift(0.1, &rotation) - (1.0 - areas)).abs() < 1e-12);
    let noise =
        CurlNoise::new(&CurlNoiseParameters { speed: 0.5, octaves: 1, ..Default::default() }).unwrap();
    let noise = Advection { field: noise, scheme: Scheme::Rk4 };
    let drifts = [0.1, 0.05].map(|edge_length| drift(edge_length, &noise));
    println!("curl noise: relative volume drifts {drifts:?} at edges of 0.1 and 0.05");
    assert!(drifts[1] < 0.35 * drifts[0] && drifts[0] < 0.02, "{drifts:?}");
}
