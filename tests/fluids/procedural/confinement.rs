//! Steps of any length end outside of solids, and are not changed where there is nothing to be put back.

use super::{mixture, points};
use glam::DVec3;
use rayon::prelude::*;
use welter_fluids::procedural::{
    Amplitude, AnyPotential, AnyVelocity, BoundaryParameters, Bounded, DivergentSource,
    DivergentSourceParameters, Extent, Interpolation, Moving, Path, Weighted, WeightedSum, Wind,
    WindParameters,
};
use welter_kit::procedural::followed;
use welter_meshing::distance::InsideRule;
use welter_meshing::field::{
    AnyField, Ball, Capsule, Cuboid, Ellipsoid, Gyroid, HalfSpace, MeshDistance, Placed, ScalarField, Torus,
    Union, rotation_about,
};
use welter_meshing::shapes::{Sphere, sphere};
use welter_tracking::flows::{Advection, Flow, Scheme, VelocityField, confined};
use welter_tracking::surface::MovingSurface;

fn around<S: ScalarField>(solid: S, width: f64) -> Bounded<WeightedSum<AnyPotential<'static>>, S> {
    let parameters = BoundaryParameters { ramp_width: width, ..Default::default() };
    Bounded::new(mixture(1.0), solid, &parameters).unwrap()
}

fn wind(velocity: DVec3) -> AnyPotential<'static> {
    AnyPotential::new(Wind::new(&WindParameters { velocity, origin: DVec3::ZERO }).unwrap())
}

fn solids() -> Vec<(&'static str, AnyField<'static>)> {
    let ball = Ball { center: DVec3::new(0.2, 0.1, -0.3), radius: 0.5 };
    let cuboid = Cuboid { min: DVec3::splat(-0.5), max: DVec3::new(0.4, 0.3, 0.6), rounding: 0.125 };
    let sharp = Cuboid { rounding: 0.0, ..cuboid };
    let plate = Cuboid { min: DVec3::new(-0.8, -0.8, -0.02), max: DVec3::new(0.8, 0.8, 0.02), rounding: 0.0 };
    let turned = Placed {
        field: sharp,
        rotation: rotation_about(DVec3::new(1.0, 2.0, 3.0), 40.0),
        scale: 1.2,
        translation: DVec3::new(0.1, 0.2, -0.1),
    };
    let two = [-0.35, 0.35].map(|x| Ball { center: DVec3::new(x, 0.0, 0.1), radius: 0.45 });
    let mesh = sphere(&Sphere { radius: 0.6, edge_length: 0.3, ..Sphere::default() }).unwrap();
    // As long as the tests.
    let mesh: &'static _ = Box::leak(Box::new(mesh));
    let plane = HalfSpace { point: DVec3::new(0.1, 0.0, -0.2), normal: DVec3::new(1.0, -2.0, 2.0) };
    let capsule = Capsule { ends: [DVec3::NEG_X, DVec3::splat(0.5)], radius: 0.05 };
    vec![
        ("ball", AnyField::new(ball)),
        ("torus", AnyField::new(Torus { radius: 0.7, tube_radius: 0.25, ..Torus::default() })),
        ("plane", AnyField::new(plane)),
        ("rounded cuboid", AnyField::new(cuboid)),
        ("sharp cuboid", AnyField::new(sharp)),
        ("turned cuboid", AnyField::new(turned)),
        ("thin plate", AnyField::new(plate)),
        ("rod", AnyField::new(capsule)),
        (
            "ellipsoid",
            AnyField::new(Ellipsoid { semi_axes: DVec3::new(0.9, 0.2, 0.5), ..Ellipsoid::default() }),
        ),
        ("union", AnyField::new(Union { parts: two.to_vec(), blend_width: 0.0 })),
        ("blended union", AnyField::new(Union { parts: two.to_vec(), blend_width: 0.2 })),
        ("gyroid", AnyField::new(Gyroid::default())),
        ("mesh", AnyField::new(MeshDistance::new(mesh, InsideRule::default()))),
    ]
}

/// How many particles there are for each solid: `WELTER_PARTICLES`, else fewer.
fn particles() -> usize {
    std::env::var("WELTER_PARTICLES").ok().and_then(|n| n.parse().ok()).unwrap_or(300)
}

/// Places all around and in a solid, half of them next to its wall or on it.
fn places(solid: &impl ScalarField) -> Vec<DVec3> {
    let near = |(index, place): (usize, DVec3)| match index % 4 {
        0 => place - solid.value(place) * solid.gradient(place, f64::NAN),
        1 => place - 0.99 * solid.value(place) * solid.gradient(place, f64::NAN),
        _ => place,
    };
    points(particles(), 1.5, 71).into_iter().enumerate().map(near).filter(|p| p.is_finite()).collect()
}

/// How many steps of paths ended in the solid, and how many that began outside would have without confinement.
fn crossings(flow: &impl VelocityField, solid: &impl ScalarField, time: f64, steps: u32) -> [usize; 2] {
    let dt = time / f64::from(steps);
    let count = |start: DVec3| {
        let mut x = start;
        let mut counts = [0, 0];
        for i in 0..steps {
            let t = f64::from(i) * dt;
            let raw = followed(|p, t| flow.velocity(p, t), x, [t, t + dt], 1);
            counts[1] += usize::from(solid.value(x) >= 0.0 && solid.value(raw) < 0.0);
            x = Scheme::Rk4.follow(flow, x, t, dt).unwrap();
            counts[0] += usize::from(solid.value(x) < 0.0);
        }
        counts
    };
    let all = places(solid).into_par_iter().map(count).collect::<Vec<_>>();
    all.iter().fold([0, 0], |sum, one| [sum[0] + one[0], sum[1] + one[1]])
}

#[test]
fn no_step_crosses_a_wall() {
    for (name, solid) in solids() {
        let flow = around(solid.clone(), 0.25);
        let mut put_back = 0;
        // At speeds of about 3: from some thirtieth of the solid to steps right through it.
        for steps in [100, 20, 4, 1] {
            let [ours, raw] = crossings(&flow, &solid, 1.0, steps);
            println!("{name}, {steps} steps: {ours} crossings, {raw} without walls");
            assert_eq!(ours, 0, "{name}, {steps} steps");
            put_back += raw;
        }
        assert!(put_back > 0, "{name}: nothing to be put back");
    }
}

/// What is inside goes to the nearest wall; where nothing is inside nothing changes, to the bit.
#[test]
fn only_what_is_inside_is_put_out_and_no_farther() {
    let (mut same, mut mended) = (0, 0);
    for (name, solid) in solids() {
        let flow = around(solid.clone(), 0.25);
        for start in places(&solid) {
            let raw = Scheme::Rk4.follow(&|p: DVec3, t: f64| flow.velocity(p, t), start, 0.3, 0.01).unwrap();
            let end = Scheme::Rk4.follow(&flow, start, 0.3, 0.01).unwrap();
            let reached = solid.value(raw);
            if reached >= 0.0 {
                assert_eq!(raw, end, "{name} {start}");
                same += 1;
            } else if !name.contains("gyroid") {
                // In a union the magnitude is that of the deepest part, and a point goes from part to part: at most 16 times as far.
                let depth = reached.abs() * if name.ends_with("union") { 16.0 } else { 1.0 };
                let back = raw.distance(end);
                assert!(back <= 1.01 * depth + 1e-12, "{name} {start}: {back:e} for {depth:e}");
                mended += 1;
            }
        }
    }
    println!("{same} the same, {mended} put back");
    assert!(mended > 200 && same > 1000);
}

/// A plate far thinner than a step: nobody is on the other side in the end, nor ever.
#[test]
fn no_step_jumps_across_a_plate() {
    for thickness in [0.3, 0.03, 0.003] {
        let wide = DVec3::new(9.0, 9.0, 0.5 * thickness);
        let plate = Cuboid { min: -wide, max: wide, rounding: 0.0 };
        let flow = WeightedSum::new(vec![
            Weighted { part: AnyPotential::new(around(plate, 0.25)), amplitude: Amplitude::Constant(1.0) },
            Weighted { part: wind(DVec3::NEG_Z), amplitude: Amplitude::Constant(1.5) },
        ]);
        for start in points(300, 0.8, 72).into_iter().filter(|p| p.z.abs() > 0.2) {
            let mut at = start;
            for i in 0..8 {
                at = Scheme::Rk4.follow(&flow, at, 0.25 * f64::from(i), 0.25).unwrap();
                assert!(at.z.signum() == start.z.signum(), "{thickness} {start}: {at}");
            }
        }
    }
    // A wind that does not know of a ball stops in front of it, not behind.
    let ball = Ball { center: DVec3::ZERO, radius: 0.5 };
    let parts = [AnyPotential::new(around(ball, 0.25)), wind(4.0 * DVec3::X)];
    let amplitudes = [0.0, 1.0].map(Amplitude::Constant);
    let flow = WeightedSum::new(
        parts.into_iter().zip(amplitudes).map(|(part, amplitude)| Weighted { part, amplitude }).collect(),
    );
    let end = Scheme::Euler.follow(&flow, DVec3::new(-2.0, 0.1, 0.0), 0.0, 1.0).unwrap();
    let front = DVec3::new(-(0.25_f64 - 0.01).sqrt(), 0.1, 0.0);
    assert!(ball.value(end) >= 0.0 && end.distance(front) < 1e-12, "{end}");
    // Beside the ball it passes.
    let beside = DVec3::new(-2.0, 0.6, 0.0);
    assert_eq!(Scheme::Euler.follow(&flow, beside, 0.0, 1.0).unwrap(), beside + 4.0 * DVec3::X);
}

/// Sources know nothing of solids, and blow what they carry against them.
#[test]
fn what_sources_blow_stays_beside_the_wall() {
    let solid = Cuboid { min: DVec3::new(0.5, -1.0, -1.0), max: DVec3::new(1.5, 1.0, 1.0), rounding: 0.1 };
    let source = DivergentSourceParameters {
        center: DVec3::ZERO,
        radius: 0.4,
        expansion: 20.0,
        extent: Extent::Unbounded,
        noise: None,
    };
    let source = DivergentSource::new(&source).unwrap();
    let flow = WeightedSum::new(vec![
        Weighted { part: AnyVelocity::new(around(solid, 0.25)), amplitude: Amplitude::Constant(0.5) },
        Weighted { part: AnyVelocity::new(source), amplitude: Amplitude::Constant(1.0) },
    ]);
    for steps in [80, 10, 2] {
        let [ours, raw] = crossings(&flow, &solid, 1.0, steps);
        println!("{steps} steps: {ours} crossings, {raw} without walls");
        assert_eq!(ours, 0);
        assert!(raw > 5, "{raw}");
    }
}

/// In the crease between two solids both walls hold, also of wedges so narrow that rounds of putting back do not end.
#[test]
fn several_walls_hold_at_once() {
    let resting = |width: f64| BoundaryParameters { ramp_width: width, ..Default::default() };
    let [left, right] = [-0.3, 0.3].map(|x| Ball { center: DVec3::new(x, 0.0, 0.0), radius: 0.5 });
    let both = Bounded::new(around(left, 0.2), right, &resting(0.2)).unwrap();
    for steps in [40, 4, 1] {
        for solid in [left, right] {
            let other = if solid == left { right } else { left };
            let starts: Vec<DVec3> =
                points(particles(), 1.0, 73).into_iter().filter(|&p| other.value(p) >= 0.0).collect();
            for start in starts.into_iter().filter(|&p| solid.value(p) >= 0.0) {
                let (mut x, dt) = (start, 1.0 / f64::from(steps));
                for i in 0..steps {
                    x = Scheme::Rk4.follow(&both, x, f64::from(i) * dt, dt).unwrap();
                    assert!(left.value(x) >= 0.0 && right.value(x) >= 0.0, "{steps} {start}: {x}");
                }
            }
        }
    }
    // Wind into wedges between two planes.
    let mut stayed = 0;
    for angle in [1.5, 0.5, 0.1, 0.01, 1e-6] {
        let normals = [1.0, -1.0].map(|sign| DVec3::new(f64::sin(0.5 * angle), 0.0, sign));
        let planes = normals.map(|normal| HalfSpace { point: DVec3::ZERO, normal });
        let calm = WeightedSum::<AnyPotential<'_>>::default();
        let one = Bounded::new(calm, planes[0], &resting(0.25)).unwrap();
        let walls = AnyPotential::new(Bounded::new(one, planes[1], &resting(0.25)).unwrap());
        let flow = WeightedSum::new(
            [walls, wind(DVec3::new(-1.0, 0.5, 0.3))]
                .map(|part| Weighted { part, amplitude: Amplitude::Constant(1.0) })
                .to_vec(),
        );
        let start = DVec3::X;
        for dt in [0.1, 0.9, 3.0] {
            let end = Scheme::Rk4.follow(&flow, start, 0.0, dt).unwrap();
            assert!(planes.iter().all(|plane| plane.value(end) >= 0.0), "{angle} {dt}: {end}");
            stayed += usize::from(end == start);
        }
    }
    assert!((1..15).contains(&stayed), "{stayed}");
}

/// Solids side by side or in each other are left as one is, and not only for the next of them.
#[test]
fn solids_side_by_side_hold_as_one() {
    let cuboid = |low: f64, high: f64| {
        let [min, max] = [DVec3::new(low, -0.5, -0.5), DVec3::new(high, 0.5, 0.25)];
        AnyField::new(Cuboid { min, max, rounding: 0.0 })
    };
    let whole = cuboid(-0.5, 0.5);
    let ball = AnyField::new(Ball { center: DVec3::new(0.0, 0.0, 0.45), radius: 0.5 });
    let floor = AnyField::new(HalfSpace { point: DVec3::ZERO, normal: DVec3::Z });
    let both = AnyField::new(Union { parts: vec![ball.clone(), floor.clone()], blend_width: 0.0 });
    let scenes = [
        ("touching", cuboid(-0.5, 0.0), cuboid(0.0, 0.5), whole.clone()),
        ("overlapping", cuboid(-0.5, 0.0625), cuboid(-0.0625, 0.5), whole),
        ("a ball sunk in a floor", ball, floor, both),
    ];
    let resting = BoundaryParameters { ramp_width: 0.25, ..Default::default() };
    for (name, one, other, whole) in scenes {
        let walls = Bounded::new(around(one.clone(), 0.25), other.clone(), &resting).unwrap();
        // A face that two solids share is in neither.
        let outside = |p: DVec3| whole.value(p) >= 0.0 || (one.value(p) == 0.0 && other.value(p) == 0.0);
        let (mut counts, mut farthest) = ([0, 0], 0.0_f64);
        for pair in points(4 * particles(), 0.7, 75).chunks_exact(2) {
            let (from, to) = (pair[0], pair[1]);
            let within = [from, to].map(|place| whole.value(place) < 0.0);
            let end = confined(&walls, from, to, [0.0, 1.0]);
            assert!(outside(end), "{name}: from {from} to {to} ended at {end}");
            if within[1] {
                counts[usize::from(within[0])] += 1;
                // A point that rests gets out a few times as far away as the wall is.
                let out = confined(&walls, to, to, [0.0, 1.0]);
                assert!(outside(out), "{name}: {to} ended at {out}");
                farthest = farthest.max(out.distance(to) / -whole.value(to));
            }
        }
        let united = around(Union { parts: vec![one.clone(), other.clone()], blend_width: 0.0 }, 0.25);
        for place in points(particles(), 0.7, 76) {
            let out = confined(&united, place, place, [0.0, 1.0]);
            assert!(outside(out), "{name}, as one field: {place} ended at {out}");
        }
        println!("{name}: {counts:?}, {farthest} as far");
        assert!(counts.iter().all(|&count| count > 20), "{name}: {counts:?}");
    }
}

/// Relative to a solid that moves: what it meets it takes along, at any speed and step.
#[test]
fn moving_walls_run_over_nobody() {
    let cuboid = Cuboid { min: DVec3::new(-0.4, -0.5, -0.3), max: DVec3::new(0.1, 0.5, 0.3), rounding: 0.05 };
    let keys = vec![(0.0, DVec3::ZERO), (1.0, DVec3::new(3.0, 1.0, 0.0)), (2.0, DVec3::new(0.0, -1.0, 0.5))];
    let path = Path::new(keys, Interpolation::Smooth).unwrap();
    let parameters = BoundaryParameters { ramp_width: 0.25, path: Some(path.clone()), anchor: None };
    let pushing = Bounded::new(mixture(1.0), cuboid, &parameters).unwrap();
    // The same wall, carried as a whole: it does not push by its velocity, but by being there.
    let carried = Moving { part: around(cuboid, 0.25), path: path.clone() };
    let mut put_back = 0;
    for flow in [AnyVelocity::new(pushing), AnyVelocity::new(carried)] {
        for steps in [100, 20, 5, 1] {
            for start in places(&cuboid) {
                let (mut x, dt) = (start, 2.0 / f64::from(steps));
                for i in 0..steps {
                    let [t, next] = [i, i + 1].map(|i| f64::from(i) * dt);
                    let raw = followed(|p, t| flow.velocity(p, t), x, [t, next], 1);
                    x = Scheme::Rk4.follow(&flow, x, t, next - t).unwrap();
                    put_back += usize::from(raw.distance(x) > 1e-9);
                    let value = cuboid.value(x - path.at(next));
                    assert!(value > -1e-14, "{steps} steps, {start} is at {x}, {value:e}");
                }
            }
        }
    }
    assert!(put_back > 100, "{put_back}");
}

/// Advection of surfaces and paths of points go by the same steps.
#[test]
fn surfaces_and_carried_points_stay_beside_walls() {
    let solid = Cuboid { min: DVec3::splat(0.3), max: DVec3::splat(1.3), rounding: 0.05 };
    let parts = [AnyPotential::new(around(solid, 0.25)), wind(DVec3::ONE)];
    let parts = parts.map(|part| Weighted { part, amplitude: Amplitude::Constant(1.0) });
    let flow = WeightedSum::new(parts.to_vec());
    let shape = sphere(&Sphere { radius: 0.3, edge_length: 0.1, ..Sphere::default() }).unwrap();
    let surface = MovingSurface::new(&shape).unwrap();
    let ends = Advection::new(flow.clone()).advance(&surface, 0.0, 0.5).unwrap().ends;
    let touching = ends.iter().filter(|&&end| solid.value(end) < 1e-9).count();
    assert!(touching > 20 && ends.iter().all(|&end| solid.value(end) >= 0.0), "{touching}");
    let path = Path::carried(&flow, DVec3::ZERO, [0.0, 1.0], 10).unwrap();
    for i in 0..=10 {
        let at = path.at(f64::from(i) / 10.0);
        assert!(solid.value(at) >= -1e-15, "{at}");
    }
}

/// With all lengths times a power of two ends are too; the order of axes does not matter.
#[test]
fn scale_and_axes_do_not_matter() {
    let shape = |factor: f64| Torus { radius: 0.7 * factor, tube_radius: 0.2 * factor, ..Torus::default() };
    let ends = |factor: f64| -> Vec<DVec3> {
        let parameters = BoundaryParameters { ramp_width: 0.25 * factor, ..Default::default() };
        let flow = Bounded::new(mixture(factor), shape(factor), &parameters).unwrap();
        let starts = places(&shape(1.0));
        starts.into_iter().map(|p| Scheme::Rk4.follow(&flow, factor * p, 0.2, 0.2).unwrap()).collect()
    };
    let one = ends(1.0);
    for k in [-200, -3, 1, 40, 200] {
        let factor = 2f64.powi(k);
        assert!(ends(factor).iter().zip(&one).all(|(a, b)| *a == factor * b), "2^{k}");
    }
    // Boxes: values and gradients take each axis by itself.
    let turn = |p: DVec3| DVec3::new(p.y, p.z, p.x);
    let calm = WeightedSum::<AnyPotential<'_>>::default;
    let parameters = BoundaryParameters { ramp_width: 0.25, ..Default::default() };
    let cuboid = Cuboid { min: DVec3::new(-0.3, -0.2, -0.1), max: DVec3::new(0.5, 0.4, 0.25), rounding: 0.0 };
    let turned = Cuboid { min: turn(cuboid.min), max: turn(cuboid.max), rounding: 0.0 };
    let walls = [cuboid, turned].map(|it| Bounded::new(calm(), it, &parameters).unwrap());
    let all = points(400, 1.0, 74);
    for pair in all.chunks_exact(2) {
        let ends = [pair.to_vec(), pair.iter().map(|&p| turn(p)).collect()];
        let [a, b] = [0, 1].map(|i| confined(&walls[i], ends[i][0], ends[i][1], [0.0, 1.0]));
        assert!((turn(a) - b).length() <= 1e-15, "{pair:?}: {a} {b}");
    }
}

/// What is no number is told by the flow, not hidden by a wall.
#[test]
fn hostile_ends() {
    let flow = around(Ball::default(), 0.25);
    for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
        let end = confined(&flow, DVec3::X * 2.0, DVec3::splat(bad), [0.0, 1.0]);
        assert!(!end.is_finite());
        let from = confined(&flow, DVec3::splat(bad), DVec3::ZERO, [0.0, 1.0]);
        assert_eq!(from, DVec3::ZERO);
    }
    for far in [1e20, 1e100, 1e149] {
        let end = confined(&flow, DVec3::new(far, 0.1, 0.0), DVec3::ZERO, [0.0, 1.0]);
        assert!(Ball::default().value(end) >= 0.0, "{far:e}: {end}");
        let end = confined(&flow, DVec3::new(-2.0, 0.1, 0.0), DVec3::new(far, 0.1, 0.0), [0.0, 1.0]);
        assert!(end.x < 0.0 && Ball::default().value(end) >= 0.0, "{far:e}: {end}");
    }
}
