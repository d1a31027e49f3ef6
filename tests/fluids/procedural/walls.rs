//! Solid walls: the flow along them, and particles that do not cross them.

use super::{mixture, points, potentials};
use glam::DVec3;
use rayon::prelude::*;
use welter_fluids::procedural::{
    Amplitude, AnyPotential, BoundaryParameters, Bounded, Interpolation, Path, ProceduralError,
    VectorPotential, VortexRingParameters, Weighted, WeightedSum, Wind, WindParameters,
};
use welter_kit::mesher::Random;
use welter_kit::procedural::followed;
use welter_meshing::field::{AnyField, Ball, Cuboid, HalfSpace, ScalarField, Torus, Union};
use welter_tracking::flows::VelocityField;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters};

fn around<S: ScalarField>(solid: S, width: f64) -> Bounded<impl VectorPotential, S> {
    let parameters = BoundaryParameters { ramp_width: width, ..Default::default() };
    Bounded::new(mixture(1.0), solid, &parameters).unwrap()
}

/// A solid, with points on its wall away from edges and the normals there.
struct Wall {
    name: &'static str,
    solid: AnyField<'static>,
    points: Vec<(DVec3, DVec3)>,
}

fn walls() -> [Wall; 3] {
    let mut random = Random::new(51);
    let ball = Ball { center: DVec3::new(0.2, 0.1, -0.3), radius: 0.5 };
    let on_ball: Vec<_> = points(300, 1.0, 52)
        .into_iter()
        .map(|p| (ball.center + 0.5 * p.normalize(), p.normalize()))
        .collect();
    let cuboid =
        Cuboid { min: DVec3::new(-0.5, -0.25, 0.125), max: DVec3::new(0.5, 0.75, 0.5), rounding: 0.0 };
    let mut on_cuboid = Vec::new();
    for axis in 0..3 {
        for (side, sign) in [(cuboid.min, -1.0), (cuboid.max, 1.0)] {
            for _ in 0..60 {
                let part = DVec3::new(random.unit(), random.unit(), random.unit());
                let mut point = cuboid.min + part * (cuboid.max - cuboid.min);
                point[axis] = side[axis];
                on_cuboid.push((point, sign * DVec3::AXES[axis]));
            }
        }
    }
    let plane = HalfSpace { point: DVec3::new(0.1, 0.2, 0.3), normal: DVec3::new(1.0, -2.0, 2.0) };
    let normal = plane.normal / 3.0;
    let on_plane: Vec<_> = points(300, 1.0, 53)
        .into_iter()
        .map(|p| (plane.point + p - p.dot(normal) * normal, normal))
        .collect();
    [
        Wall { name: "ball", solid: AnyField::new(ball), points: on_ball },
        Wall { name: "cuboid", solid: AnyField::new(cuboid), points: on_cuboid },
        Wall { name: "plane", solid: AnyField::new(plane), points: on_plane },
    ]
}

/// The normal part is the rounding of the position of the wall and of one cross product.
#[test]
fn at_walls_the_flow_is_tangential() {
    for Wall { name, solid, points } in walls() {
        for (kind, flow) in potentials(1.0) {
            let parameters = BoundaryParameters { ramp_width: 0.25, ..Default::default() };
            let bounded = Bounded::new(flow.clone(), solid.clone(), &parameters).unwrap();
            let mut slip: f64 = 0.0;
            for &(point, normal) in &points {
                let free = flow.potential_and_curl(point, 0.7);
                let velocity = bounded.velocity(point, 0.7);
                let scale = free.potential.length() / 0.25 + free.curl.length();
                let across = velocity.dot(normal).abs();
                assert!(across <= 5e-15 * scale, "{name}, {kind}, {point}: {across:e} of {scale}");
                slip = slip.max(velocity.length());
            }
            assert!(slip > 0.1, "{name}, {kind}: the flow slips along the wall, {slip}");
        }
    }
}

/// On faces whose distance has no rounding nothing at all goes across.
#[test]
fn at_axis_parallel_walls_the_normal_part_is_zero() {
    let [_, Wall { solid, points, .. }, _] = walls();
    let bounded = around(solid, 0.25);
    for (point, normal) in points {
        assert_eq!(bounded.velocity(point, 0.7).dot(normal), 0.0, "{point}");
    }
}

/// Outside of the layer nothing changes; within, the potential falls to zero.
#[test]
fn the_layer_is_as_wide_as_its_width() {
    let ball = Ball::default();
    let (free, bounded) = (mixture(1.0), around(ball, 0.5));
    let mut in_layer = 0;
    for point in points(500, 2.0, 54) {
        let (a, b) = (free.potential_and_curl(point, 0.2), bounded.potential_and_curl(point, 0.2));
        if ball.value(point) >= 0.5 {
            assert_eq!(a, b);
        } else if ball.value(point) > 0.0 && ball.value(point) < 0.45 {
            in_layer += 1;
            assert!(b.potential.length() < a.potential.length() && a.curl != b.curl);
        }
    }
    assert!(in_layer > 50);
}

/// Both walls hold where layers overlap, of solids at rest without anchors.
#[test]
fn both_walls_of_nested_solids_hold() {
    let [left, right] = [-0.6, 0.6].map(|x| Ball { center: DVec3::new(x, 0.0, 0.0), radius: 0.5 });
    let both = around(left, 0.8);
    let parameters = BoundaryParameters { ramp_width: 0.8, ..Default::default() };
    let both = Bounded::new(both, right, &parameters).unwrap();
    let union = around(Union { parts: vec![left, right], blend_width: 0.0 }, 0.2);
    for ball in [left, right] {
        for direction in points(200, 1.0, 55) {
            let normal = direction.normalize();
            let point = ball.center + 0.5 * normal;
            for velocity in [both.velocity(point, 0.1), union.velocity(point, 0.1)] {
                assert!(velocity.dot(normal).abs() < 1e-13, "{point}: {velocity}");
            }
        }
    }
}

/// With an anchor constants in the potential do not matter: the wind of any origin is the same.
#[test]
fn an_anchor_takes_constants_off() {
    let ball = Ball { center: DVec3::new(5.0, 1.0, 2.0), radius: 0.5 };
    let winds = [DVec3::ZERO, ball.center, DVec3::new(-7.0, 30.0, 4.0)].map(|origin| {
        let wind = Wind::new(&WindParameters { velocity: DVec3::new(1.0, 0.5, -2.0), origin }).unwrap();
        let parameters =
            BoundaryParameters { ramp_width: 0.5, anchor: Some(ball.center), ..Default::default() };
        Bounded::new(wind, ball, &parameters).unwrap()
    });
    for point in points(200, 1.0, 56) {
        let [a, b, c] = winds.each_ref().map(|wind| wind.velocity(ball.center + point, 0.0));
        assert!((a - b).length() < 1e-13 && (c - b).length() < 1e-13, "{point}");
        if point.length() > 0.5 {
            assert!(b.length() < 5.0, "not much faster than the wind of 2.3: {b}");
        }
    }
    let normal = DVec3::new(0.6, 0.0, 0.8);
    assert!(winds[0].velocity(ball.center + 0.5 * normal, 0.0).dot(normal).abs() < 1e-13);
}

/// Relative to a solid that moves nothing crosses its wall.
#[test]
fn moving_solids_push_the_fluid() {
    let ball = Ball { center: DVec3::new(0.1, 0.0, 0.0), radius: 0.4 };
    let path = Path::new(vec![(0.0, DVec3::ZERO), (2.0, DVec3::new(1.0, 2.0, 0.0))], Interpolation::Smooth);
    let path = path.unwrap();
    for anchor in [None, Some(ball.center)] {
        let parameters = BoundaryParameters { ramp_width: 0.3, anchor, path: Some(path.clone()) };
        let bounded = Bounded::new(mixture(1.0), ball, &parameters).unwrap();
        for time in [-1.0, 0.5, 1.0, 1.7, 3.0] {
            let (displacement, velocity) = path.value_and_rate(time);
            for direction in points(100, 1.0, 57) {
                let normal = direction.normalize();
                let point = ball.center + displacement + 0.4 * normal;
                let relative = bounded.velocity(point, time) - velocity;
                assert!(relative.dot(normal).abs() < 1e-13, "{anchor:?} {time} {point}: {relative}");
            }
        }
        // Particles in front of it are carried off, not run over.
        let starts: Vec<DVec3> = points(150, 1.5, 58).into_iter().filter(|p| ball.value(*p) > 0.01).collect();
        let least = starts
            .par_iter()
            .map(|&start| {
                let end = followed(|p, t| bounded.velocity(p, t), start, [0.0, 2.0], 400);
                ball.value(end - path.at(2.0))
            })
            .collect::<Vec<_>>()
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        assert!(least > 0.0, "{anchor:?}: {least}");
    }
}

/// The least distance of particles that follow the velocities alone: below zero if one is inside at any step.
fn least_distance(
    flow: &(impl VelocityField + ?Sized),
    solid: &impl ScalarField,
    starts: &[DVec3],
    time: f64,
    steps: u32,
) -> f64 {
    let dt = time / f64::from(steps);
    let worst = starts.par_iter().map(|&start| {
        let (mut x, mut least) = (start, solid.value(start));
        for i in 0..steps {
            let t = f64::from(i) * dt;
            x = followed(|p, t| flow.velocity(p, t), x, [t, t + dt], 1);
            least = least.min(solid.value(x));
        }
        least
    });
    worst.collect::<Vec<_>>().into_iter().fold(f64::INFINITY, f64::min)
}

/// Starts outside of a solid, a fifth of them next to the wall.
fn starts(solid: &impl ScalarField, count: usize) -> Vec<DVec3> {
    let mut random = Random::new(59);
    let mut starts = Vec::new();
    while starts.len() < count {
        let point = 1.5 * random.point();
        let distance = solid.value(point);
        if distance < 0.0 {
            continue;
        }
        if starts.len() % 5 == 0 {
            let near = point - (distance - 1e-3) * solid.gradient(point, f64::NAN);
            if (solid.value(near) - 1e-3).abs() < 1e-9 {
                starts.push(near);
            }
        } else {
            starts.push(point);
        }
    }
    starts
}

/// How many particles: 10,000 if `WELTER_PARTICLES` says so, fewer in the short run.
fn particles() -> usize {
    std::env::var("WELTER_PARTICLES").ok().and_then(|n| n.parse().ok()).unwrap_or(500)
}

#[test]
fn small_steps_by_themselves_do_not_cross_round_walls() {
    let ball = Ball { center: DVec3::new(0.2, 0.1, -0.3), radius: 0.5 };
    let torus = Torus { radius: 0.7, tube_radius: 0.25, ..Torus::default() };
    let plane = HalfSpace { point: DVec3::new(0.0, 0.0, 0.0), normal: DVec3::Z };
    // At speeds of about 3 a step is a twentieth of the smallest radius of curvature.
    let solids = [
        ("ball", AnyField::new(ball), 200),
        ("torus", AnyField::new(torus), 400),
        ("plane", AnyField::new(plane), 200),
    ];
    let ring = VortexRingParameters { core: 0.3, center: DVec3::new(0.1, -0.2, 0.3), ..Default::default() };
    let noise = CurlNoiseParameters { seed: 4, octaves: 1, waves: 16, ..Default::default() };
    let mixture = WeightedSum::new(vec![
        Weighted { part: AnyPotential::new(super::ring(ring)), amplitude: Amplitude::Constant(1.0) },
        Weighted {
            part: AnyPotential::new(CurlNoise::new(&noise).unwrap()),
            amplitude: Amplitude::Constant(0.5),
        },
    ]);
    for (name, solid, steps) in solids {
        let parameters = BoundaryParameters { ramp_width: 0.25, ..Default::default() };
        let flow = Bounded::new(mixture.clone(), solid.clone(), &parameters).unwrap();
        let least = least_distance(&flow, &solid, &starts(&solid, particles()), 2.0, steps);
        println!("{name}: {} particles, {steps} steps: within {least:e} of the wall", particles());
        assert!(least > 0.0, "{name}: {least:e}");
    }
}

/// The root of the mean square of how far particles that start on a wall are off it after a time of one.
fn off_the_wall<S: ScalarField + Copy>(solid: S, wall: &[DVec3], steps: u32) -> f64 {
    let flow = around(solid, 0.25);
    let off = wall
        .par_iter()
        .map(|&start| solid.value(followed(|p, t| flow.velocity(p, t), start, [0.0, 1.0], steps)).powi(2));
    (off.collect::<Vec<_>>().iter().sum::<f64>() / wall.len() as f64).sqrt()
}

/// Particles that start on a wall leave it by the error of the method alone: of order four where the distance is smooth, of order two where
/// its second derivatives jump, as where a face joins a round edge.
#[test]
fn walls_are_crossed_by_the_error_of_the_method() {
    let ball = Ball { center: DVec3::new(0.2, 0.1, -0.3), radius: 0.5 };
    let on_ball: Vec<DVec3> =
        points(100, 1.0, 60).into_iter().map(|p| ball.center + 0.5 * p.normalize()).collect();
    let cuboid = Cuboid { min: DVec3::splat(-0.5), max: DVec3::splat(0.4), rounding: 0.125 };
    let on_cuboid: Vec<DVec3> = points(400, 1.5, 62)
        .into_iter()
        .filter(|&p| cuboid.value(p) > 0.0)
        .map(|p| p - cuboid.value(p) * cuboid.gradient(p, f64::NAN))
        .collect();
    let errors_on_ball = [40, 80, 160].map(|steps| off_the_wall(ball, &on_ball, steps));
    let errors_on_cuboid = [50, 200, 800].map(|steps| off_the_wall(cuboid, &on_cuboid, steps));
    println!("ball, 40, 80, 160 steps: off the wall by {errors_on_ball:?}");
    println!("rounded cuboid, 50, 200, 800 steps: off the wall by {errors_on_cuboid:?}");
    let order = |errors: [f64; 3], ratio: f64| (errors[1] / errors[2]).ln() / ratio.ln();
    assert!(order(errors_on_ball, 2.0) > 3.9);
    assert!(order(errors_on_cuboid, 4.0) > 1.8);
}

/// Velocities do not lead out of a solid either; only [`VelocityField::confine`] does.
#[test]
fn velocities_do_not_lead_out_of_solids() {
    let ball = Ball { center: DVec3::ZERO, radius: 1.0 };
    let flow = around(ball, 0.25);
    let inside: Vec<DVec3> = points(200, 0.95, 61).into_iter().filter(|p| p.length() < 0.95).collect();
    let largest = inside
        .par_iter()
        .map(|&start| ball.value(followed(|p, t| flow.velocity(p, t), start, [0.0, 1.0], 400)));
    let largest = largest.collect::<Vec<_>>().into_iter().fold(f64::NEG_INFINITY, f64::max);
    assert!(largest < 0.0, "{largest:e}");
}

/// A distance known by its values alone has no exact gradient.
#[test]
fn finite_differences_are_refused() {
    let (_, wind) = potentials(1.0).pop().unwrap();
    let closure = |p: DVec3| p.length() - 1.0;
    let parameters = BoundaryParameters { ramp_width: 1.0, ..Default::default() };
    let refused = Bounded::<AnyPotential<'_>, _>::new(wind.clone(), closure, &parameters);
    assert!(matches!(refused, Err(ProceduralError::NoExactGradient)));
    // Hidden in a union it is met only where it is nearest: velocities there are no numbers.
    let far = Ball { center: DVec3::new(0.0, 0.0, 0.25), radius: 0.25 };
    let parts = vec![AnyField::new(far), AnyField::new(|p: DVec3| p.distance(DVec3::X * 4.0) - 1.0)];
    let hidden = Bounded::new(wind, Union { parts, blend_width: 0.0 }, &parameters).unwrap();
    assert!(hidden.velocity(DVec3::new(0.0, 0.0, 0.7), 0.0).is_finite());
    assert!(hidden.velocity(DVec3::new(4.0, 1.2, 0.0), 0.0).is_nan());
}
