//! The order of advection in each primitive.

use super::{mixture, points, potentials};
use glam::DVec3;
use welter_fluids::procedural::{
    Amplitude, AnyVelocity, BoundaryParameters, Bounded, DivergentSource, DivergentSourceParameters, Extent,
    Interpolation, Keyframes, Moving, Path, Pulse, SourceNoise, Weighted, WeightedSum,
};
use welter_meshing::field::Ball;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::measure::signed_volume;
use welter_tracking::flows::{Advection, Flow, VelocityField};
use welter_tracking::surface::MovingSurface;

/// Flows by name.
fn flows() -> Vec<(&'static str, AnyVelocity<'static>)> {
    let mut flows: Vec<_> =
        potentials(1.0).into_iter().map(|(name, flow)| (name, AnyVelocity::new(flow))).collect();
    // The wind is a straight line, which has no error to measure.
    flows.retain(|(name, _)| *name != "wind");
    for (name, extent) in [("confined source", Extent::Confined), ("unbounded source", Extent::Unbounded)] {
        let parameters = DivergentSourceParameters {
            center: DVec3::new(0.3, 0.2, 0.0),
            radius: 0.8,
            expansion: 3.0,
            extent,
            noise: Some(SourceNoise::default()),
        };
        flows.push((name, AnyVelocity::new(DivergentSource::new(&parameters).unwrap())));
    }
    let ball = Ball { center: DVec3::new(0.2, 1.4, 0.0), radius: 0.6 };
    let parameters = BoundaryParameters { ramp_width: 0.7, anchor: Some(ball.center), path: None };
    flows.push(("around a ball", AnyVelocity::new(Bounded::new(mixture(1.0), ball, &parameters).unwrap())));
    let path = Path::new(vec![(0.1, DVec3::ZERO), (0.83, DVec3::X)], Interpolation::Smooth).unwrap();
    flows.push(("moving", AnyVelocity::new(Moving { part: mixture(1.0), path })));
    let keys = Keyframes::new(vec![(0.0, 0.5), (0.37, 2.0), (0.9, -1.0)], Interpolation::Smooth).unwrap();
    let pulse = Pulse::new(1.5, 0.1, [0.3, 0.1, 0.2], 0.7).unwrap();
    let parts = vec![
        Weighted { part: mixture(1.0), amplitude: Amplitude::Keyed(keys) },
        Weighted { part: mixture(1.0), amplitude: Amplitude::Pulsed(pulse) },
    ];
    flows.push(("keyframes and pulses", AnyVelocity::new(WeightedSum::new(parts))));
    flows
}

fn start() -> MovingSurface {
    let shape = Sphere { radius: 0.7, edge_length: 0.4, ..Sphere::default() };
    MovingSurface::new(&sphere(&shape).unwrap()).unwrap()
}

/// Positions after a time of one.
fn advanced(flow: &impl VelocityField, steps: u32) -> Vec<DVec3> {
    let mut surface = start();
    let vertices: Vec<_> = surface.connectivity().vertices().collect();
    let dt = 1.0 / f64::from(steps);
    let advection = Advection::new(|p: DVec3, t: f64| flow.velocity(p, t));
    for i in 0..steps {
        let ends = advection.advance(&surface, f64::from(i) * dt, dt).unwrap().ends;
        for &v in &vertices {
            surface.set_position(v, ends[v.index()]).unwrap();
        }
    }
    surface.positions().to_vec()
}

#[test]
fn runge_and_kutta_have_order_four_in_each_primitive() {
    for (name, flow) in flows() {
        let reference = advanced(&flow, 320);
        let errors = [40, 80].map(|steps| {
            let ends = advanced(&flow, steps);
            let square: f64 = ends.iter().zip(&reference).map(|(a, b)| a.distance_squared(*b)).sum();
            (square / ends.len() as f64).sqrt()
        });
        let order = (errors[0] / errors[1]).log2();
        println!("{name}: errors {errors:?}, order {order:.3}");
        assert!(order >= 3.9, "{name}: {errors:?}: {order}");
    }
}

/// Linear keyframes have a kink: in wind, where the method is Simpson's rule, there is no error if steps end on it, and one of order two if
/// they do not.
#[test]
fn linear_keyframes_cost_order_unless_steps_end_on_them() {
    let errors = |middle: f64| {
        let keys = vec![(0.0, 0.0), (middle, 2.0), (1.0, -1.0)];
        let keys = Keyframes::new(keys, Interpolation::Linear).unwrap();
        let (_, wind) = potentials(1.0).pop().unwrap();
        let blown = wind.velocity(DVec3::ZERO, 0.0) * (0.5 * middle * 2.0 + (1.0 - middle) * 0.5);
        let flow = WeightedSum::new(vec![Weighted { part: wind, amplitude: Amplitude::Keyed(keys) }]);
        [40, 160].map(|steps| {
            let ends = advanced(&flow, steps);
            let start = start();
            let gaps = start.positions().iter().zip(&ends).map(|(p, q)| (*q - *p - blown).length());
            gaps.fold(0.0, f64::max)
        })
    };
    // A fifth of a step of forty after the twentieth, and a fifth of one of 160 before another: Simpson's errors are alike.
    let (on, off) = (errors(0.5), errors(0.505));
    println!("errors {on:?} with the keyframe at the end of a step, {off:?} within one");
    let order = 0.5 * (off[0] / off[1]).log2();
    assert!(on[0] < 1e-14 && on[1] < 1e-14 && (order - 2.0).abs() < 1e-3, "{on:?} {off:?}: {order}");
}

/// The volume within a surface stays, up to what triangles differ from the surface, which falls with the square of the edge length at least.
#[test]
fn volumes_stay_in_flows_without_divergence() {
    let ball = Ball { center: DVec3::new(0.2, 0.9, 0.0), radius: 0.3 };
    let parameters = BoundaryParameters { ramp_width: 0.4, anchor: Some(ball.center), path: None };
    let flow = Advection::new(Bounded::new(mixture(1.0), ball, &parameters).unwrap());
    let drifts = [0.2, 0.1].map(|edge_length| {
        let shape = Sphere { radius: 0.5, edge_length, ..Sphere::default() };
        let mut surface = MovingSurface::new(&sphere(&shape).unwrap()).unwrap();
        let before = signed_volume(&surface.to_mesh());
        let vertices: Vec<_> = surface.connectivity().vertices().collect();
        for i in 0..30 {
            let ends = flow.advance(&surface, f64::from(i) * 0.01, 0.01).unwrap().ends;
            for &v in &vertices {
                surface.set_position(v, ends[v.index()]).unwrap();
            }
        }
        (signed_volume(&surface.to_mesh()) / before - 1.0).abs()
    });
    println!("relative volume drifts {drifts:?} at edges of 0.2 and 0.1");
    assert!(drifts[1] < 0.3 * drifts[0] && drifts[1] < 5e-3, "{drifts:?}");
}

#[test]
fn a_source_blows_a_ball_up_by_its_outflow() {
    let parameters =
        DivergentSourceParameters { radius: 0.3, extent: Extent::Unbounded, ..Default::default() };
    let source = DivergentSource::new(&parameters).unwrap();
    // Outside of the source every sphere grows by the outflow: d (4 pi r^3 / 3) / dt.
    for start in points(20, 1.0, 71).into_iter().map(|p| (0.5 + 0.3 * p.x.abs()) * p.normalize()) {
        let end = welter_kit::procedural::followed(|p, t| source.velocity(p, t), start, [0.0, 2.0], 100);
        let grown = 4.0 / 3.0 * std::f64::consts::PI * (end.length().powi(3) - start.length().powi(3));
        assert!((grown / (2.0 * source.outflow()) - 1.0).abs() < 1e-9, "{start}: {grown}");
    }
}
