//! Flows around solids as curls: potential, velocity and divergence by automatic differentiation.

use super::{points, potentials, ring};
use glam::DVec3;
use welter_fluids::procedural::{
    Amplitude, AnyPotential, BoundaryParameters, Bounded, Interpolation, Path, VectorPotential,
    VortexRingParameters, Weighted, WeightedSum, Wind, WindParameters,
};
use welter_kit::evolution::Dual;
use welter_kit::procedural::{LineVortex, flux_of_box};
use welter_meshing::field::{Ball, Cuboid, ScalarField, Union};
use welter_tracking::flows::VelocityField;

type Dual3 = [Dual; 3];

fn constant(v: DVec3) -> Dual3 {
    v.to_array().map(Dual::constant)
}

fn plus(a: Dual3, b: Dual3) -> Dual3 {
    std::array::from_fn(|k| a[k] + b[k])
}

fn minus(a: Dual3, b: Dual3) -> Dual3 {
    std::array::from_fn(|k| a[k] - b[k])
}

fn times(s: Dual, a: Dual3) -> Dual3 {
    a.map(|c| s * c)
}

fn cross(a: Dual3, b: Dual3) -> Dual3 {
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn length(a: Dual3) -> Dual {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

/// The ramp and its slope from their integral, the terms of the binomial one by one.
fn ramp(s: Dual) -> (Dual, Dual) {
    if s.value.abs() >= 1.0 {
        return (Dual::constant(s.value.signum()), Dual::constant(0.0));
    }
    let (mut sum, mut slope, mut power) = (Dual::constant(0.0), Dual::constant(0.0), Dual::constant(1.0));
    for (i, binomial) in [1.0, -5.0, 10.0, -10.0, 5.0, -1.0].into_iter().enumerate() {
        slope = slope + binomial * power;
        sum = sum + (binomial / (2 * i + 1) as f64) * (power * s);
        power = power * s * s;
    }
    (693.0 / 256.0 * sum, 693.0 / 256.0 * slope)
}

/// A solid in numbers with derivatives: distance and its gradient.
trait Twin: ScalarField + Copy {
    fn distance(&self, x: Dual3) -> (Dual, Dual3);
}

impl Twin for Ball {
    fn distance(&self, x: Dual3) -> (Dual, Dual3) {
        let d = minus(x, constant(self.center));
        let r = length(d);
        (r - Dual::constant(self.radius), times(r.recip(), d))
    }
}

impl Twin for Cuboid {
    /// Outside alone.
    fn distance(&self, x: Dual3) -> (Dual, Dual3) {
        let off: Dual3 = std::array::from_fn(|k| match x[k].value {
            v if v < self.min[k] => x[k] - Dual::constant(self.min[k]),
            v if v > self.max[k] => x[k] - Dual::constant(self.max[k]),
            _ => Dual::constant(0.0),
        });
        let r = length(off);
        (r, times(r.recip(), off))
    }
}

const WIND: WindParameters =
    WindParameters { velocity: DVec3::new(0.4, -1.0, 0.5), origin: DVec3::new(0.5, 0.25, 1.0) };

fn vortex() -> VortexRingParameters {
    VortexRingParameters { center: DVec3::new(0.1, 0.2, 0.3), core: 0.3, ..Default::default() }
}

/// Wind and a ring.
fn free() -> WeightedSum<AnyPotential<'static>> {
    let part = |part| Weighted { part, amplitude: Amplitude::Constant(1.0) };
    WeightedSum::new(vec![
        part(AnyPotential::new(Wind::new(&WIND).unwrap())),
        part(AnyPotential::new(ring(vortex()))),
    ])
}

/// Potential and velocity of the same.
fn free_twin(twin: &LineVortex, x: Dual3) -> (Dual3, Dual3) {
    let half = times(Dual::constant(0.5), constant(WIND.velocity));
    let wind = cross(half, minus(x, constant(WIND.origin)));
    (plus(wind, twin.potential(x)), plus(constant(WIND.velocity), twin.velocity(x)))
}

fn check<S: Twin>(solid: S, parameters: &BoundaryParameters, places: &[DVec3]) {
    let bounded = Bounded::new(free(), solid, parameters).unwrap();
    let v = vortex();
    let line = LineVortex::circle([v.center, v.axis], v.radius, v.core, v.circulation, 400);
    let time = 0.8;
    let (displacement, velocity) =
        parameters.path.as_ref().map_or((DVec3::ZERO, DVec3::ZERO), |path| path.value_and_rate(time));
    let gauge = match parameters.anchor {
        Some(anchor) => Dual::divergence(free_twin(&line, Dual::coordinates(anchor + displacement)).0).0,
        None => DVec3::ZERO,
    };
    let anchor = parameters.anchor.unwrap_or(DVec3::ZERO) + displacement;
    let (mut in_layer, mut worst): (u32, f64) = (0, 0.0);
    for &point in places {
        let x = Dual::coordinates(point);
        let (psi, u) = free_twin(&line, x);
        let half = constant(0.5 * velocity);
        let wall = plus(cross(half, minus(x, constant(anchor))), constant(gauge));
        let (distance, normal) = solid.distance(minus(x, constant(displacement)));
        let width = Dual::constant(parameters.ramp_width).recip();
        let (value, slope) = ramp(distance * width);
        let potential = plus(wall, times(value, minus(psi, wall)));
        let across = times(slope * width, cross(normal, minus(psi, wall)));
        let flow = plus(constant(velocity), plus(times(value, minus(u, constant(velocity))), across));
        in_layer += u32::from(slope.value > 0.1);

        let found = bounded.potential_and_curl(point, time);
        let (expected, divergence) = Dual::divergence(flow);
        let scale = expected.length() + 3.0 * (1.0 + psi[0].value.abs()) / parameters.ramp_width;
        let gap = (found.potential - Dual::divergence(potential).0).length();
        assert!(gap < 1e-14 * (1.0 + found.potential.length()), "{point}: potential {gap:e}");
        for expected in [expected, Dual::curl(potential)] {
            let gap = (found.curl - expected).length();
            assert!(gap < 1e-14 * scale, "{point}: {} not {expected}: {gap:e}", found.curl);
        }
        // Derivatives of the flow are of the order of its changes over the width, and of the normal over the distance.
        let slopes = scale / parameters.ramp_width;
        assert!(divergence.abs() < 1e-14 * slopes, "{point}: divergence {divergence:e} of {slopes}");
        worst = worst.max(divergence.abs() / slopes);
    }
    assert!(in_layer > 50, "{in_layer} points in the layer");
    println!("divergence at most {worst:e} of the slopes");
}

/// Potentials, their curls and velocities, at rest and moving, with and without an anchor, outside and inside.
#[test]
fn bounded_flows_are_curls_of_their_potentials() {
    let path = Path::new(vec![(0.0, DVec3::ZERO), (2.0, DVec3::new(0.5, 1.0, 0.0))], Interpolation::Smooth);
    let path = path.unwrap();
    let ball = Ball { center: DVec3::new(-0.2, 0.1, 0.0), radius: 0.75 };
    let cuboid = Cuboid { min: DVec3::splat(-0.5), max: DVec3::splat(0.25), rounding: 0.0 };
    for anchor in [None, Some(DVec3::new(-0.1, 0.0, 0.1))] {
        for path in [None, Some(path.clone())] {
            let parameters = BoundaryParameters { ramp_width: 0.5, anchor, path };
            let displacement = parameters.path.as_ref().map_or(DVec3::ZERO, |path| path.at(0.8));
            // Not at the centre, where the distance has its kink.
            let mut places: Vec<DVec3> = points(400, 1.5, 101)
                .into_iter()
                .filter(|p| (*p - displacement).distance(ball.center) > 0.05)
                .collect();
            places.extend(
                points(100, 1.0, 102).iter().map(|p| displacement + ball.center + 0.75 * p.normalize()),
            );
            check(ball, &parameters, &places);
            places.retain(|p| cuboid.value(*p - displacement) > 1e-3);
            check(cuboid, &parameters, &places);
        }
    }
}

/// Half way between two balls the distance has a kink; nothing comes into being there.
#[test]
fn nothing_flows_out_of_kinks() {
    let balls = [-0.5, 0.5].map(|x| Ball { center: DVec3::new(x, 0.0, 0.0), radius: 0.375 });
    let solid = Union { parts: balls.to_vec(), blend_width: 0.0 };
    for (name, flow) in potentials(1.0) {
        let parameters = BoundaryParameters { ramp_width: 1.0, ..Default::default() };
        let bounded = Bounded::new(flow, solid.clone(), &parameters).unwrap();
        let at = |p: DVec3| bounded.velocity(p, 0.3);
        // Panels end on the plane x = 0.
        let half = DVec3::new(0.1, 0.15, 0.2);
        for center in [DVec3::new(0.0, 0.25, 0.0), DVec3::new(0.0, -0.1, 0.3)] {
            let flux = flux_of_box(at, [center - half, center + half], 4);
            assert!(flux.relative() < 1e-14, "{name}: {flux:?}");
        }
        let beside = 1e-12 * DVec3::X;
        let jump = at(beside) - at(-beside);
        assert!(jump.length() > 1e-3 && jump.x.abs() < 1e-10, "{name}: {jump}");
    }
}
