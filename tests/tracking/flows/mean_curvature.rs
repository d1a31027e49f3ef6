//! Mean curvature, against spheres, tori, planes and boundaries.

use super::{ball, follow, mesh, order, run};
use glam::DVec3;
use welter_kit::evolution::errors;
use welter_meshing::shapes::{Box_, Torus, box_, torus};
use welter_meshing::surface::measure::{area, mean_curvature_normals};
use welter_tracking::flows::{Flow, MeanCurvature, Scheme};
use welter_tracking::surface::MovingSurface;

#[test]
fn spheres_shrink_by_the_sum_of_the_curvatures() {
    for (scheme, bound) in [(Scheme::Euler, 3e-4), (Scheme::Rk4, 5e-5)] {
        let edges = [0.2, 0.1];
        let found = edges.map(|edge_length| {
            let mut surface = ball(1.0, edge_length);
            let flow = MeanCurvature { scheme, ..Default::default() };
            let steps = run(&mut surface, &flow, [0.0, 0.1], 1.0);
            let radius = (1.0_f64 - 4.0 * 0.1).sqrt();
            let errors = errors(&surface.to_mesh(), |p| p.length() - radius);
            println!("sphere of edges {edge_length}, {scheme:?}: {steps} steps, {errors:?}");
            errors.linf
        });
        let order = order(&edges, &found);
        assert!(order > 1.8 && found[1] < bound, "{scheme:?}, {order}: {found:?}");
    }
}

#[test]
fn the_speed_is_a_factor_of_time() {
    let mut slow = ball(1.0, 0.2);
    let mut fast = slow.clone();
    run(&mut slow, &MeanCurvature::default(), [0.0, 0.0625], 1.0);
    run(&mut fast, &MeanCurvature { speed: 4.0, ..Default::default() }, [0.0, 0.015625], 1.0);
    assert_eq!(slow.positions(), fast.positions());
}

/// The velocity of every vertex of a torus of revolution, in the root of the mean square over its area.
#[test]
fn velocities_on_tori_converge() {
    let edges = [0.1, 0.05, 0.025];
    let found = edges.map(|edge_length| {
        let shape = Torus { edge_length, ..Torus::default() };
        let surface = MovingSurface::new(&torus(&shape).unwrap()).unwrap();
        // So short that no vertex is damped.
        let dt = 1e-6;
        // The velocity at the beginning.
        let euler = MeanCurvature { scheme: Scheme::Euler, ..Default::default() };
        let prediction = euler.advance(&surface, 0.0, dt).unwrap();
        assert_eq!(prediction.dt, dt);
        let measured = mean_curvature_normals(&surface.to_mesh());
        let (mut square, mut total) = (0.0, 0.0);
        for (i, (&p, &q)) in surface.positions().iter().zip(&prediction.ends).enumerate() {
            let across = (p.x * p.x + p.y * p.y).sqrt();
            let circle = DVec3::new(p.x, p.y, 0.0) / across * shape.radius;
            let normal = (p - circle) / shape.tube_radius;
            let outward = normal.dot(DVec3::new(p.x, p.y, 0.0) / across);
            let curvature = 1.0 / shape.tube_radius + outward / across;
            let error = (q - p) / dt + curvature * normal;
            square += measured.areas[i] * error.length_squared();
            total += measured.areas[i];
            // The other implementation of the same formula.
            let twin = -2.0 * measured.normals[i];
            assert!(((q - p) / dt - twin).length() < 1e-8 * curvature.abs().max(1.0), "{p}");
        }
        (square / total).sqrt()
    });
    let order = order(&edges, &found);
    println!("torus: errors of velocity {found:?}, order {order}");
    assert!(order > 1.9, "{order}: {found:?}");
}

#[test]
fn planes_and_boundaries_stay() {
    let cube = MovingSurface::new(&box_(&Box_ { edge_length: 0.25, ..Box_::default() }).unwrap()).unwrap();
    let euler = MeanCurvature { scheme: Scheme::Euler, ..Default::default() };
    let found = euler.advance(&cube, 0.0, 1.0).unwrap();
    let mut inside = 0;
    for (&p, &q) in cube.positions().iter().zip(&found.ends) {
        let on = p.to_array().iter().filter(|c| c.abs() == 1.0).count();
        if on == 1 {
            assert!(q.distance(p) < 1e-15, "{p}: {q}");
            inside += 1;
        } else {
            assert!(q.length() < p.length() - 1e-3, "ridges and corners are drawn in: {p}, {q}");
        }
    }
    assert!(inside > 100);

    // Half a cube, open at the top: its boundary stays, the rest moves.
    let mesh_of_cube = cube.to_mesh();
    let below = |t: &&[welter_meshing::surface::VertexId; 3]| {
        t.iter().all(|v| mesh_of_cube.positions()[v.index()].z <= 0.0)
    };
    let triangles = mesh_of_cube.triangles().iter().filter(below).map(|t| t.map(|v| v.0)).collect();
    let mut half = MovingSurface::new(&mesh(mesh_of_cube.positions().to_vec(), triangles)).unwrap();
    let _ = half.compact();
    let before = half.clone();
    run(&mut half, &MeanCurvature::default(), [0.0, 0.1], 1.0);
    let mut still = 0;
    for (&p, &q) in before.positions().iter().zip(half.positions()) {
        assert_eq!(p == q, p.z == 0.0, "{p}: {q}");
        still += usize::from(p == q);
    }
    assert_eq!(still, 32);
    assert!(area(&half.to_mesh()) < area(&before.to_mesh()));
}

/// Steps at the limit do not blow up, on a rough surface either.
#[test]
fn steps_are_stable() {
    let mut surface = ball(1.0, 0.2);
    let mut random = welter_kit::mesher::Random::new(71);
    let vertices: Vec<_> = surface.connectivity().vertices().collect();
    for v in vertices {
        surface.set_position(v, surface.position(v) + 0.02 * random.point()).unwrap();
    }
    let mut last = area(&surface.to_mesh());
    let mut farthest = f64::INFINITY;
    let mut limits = Vec::new();
    for _ in 0..60 {
        let prediction = MeanCurvature::default().advance(&surface, 0.0, 1.0).unwrap();
        follow(&mut surface, &prediction);
        let now = area(&surface.to_mesh());
        assert!(now < last, "the area falls in every step: {last}, {now}");
        last = now;
        let reach = surface.positions().iter().map(|p| p.length()).fold(0.0, f64::max);
        assert!(reach < farthest, "vertices stay within those around them: {farthest}, {reach}");
        farthest = reach;
        limits.push(prediction.dt);
    }
    println!("limits {:.3e} to {:.3e}", limits[0], limits[59]);
}

/// Squares with one diagonal, whose oscillation from vertex to vertex has the largest eigenvalue that there can be: at
/// the limit it neither grows nor falls, beyond it grows.
#[test]
fn the_limit_is_sharp() {
    let side = 12;
    let at = |i: u32, j: u32| i * (side + 1) + j;
    let inner = 1..side;
    let height = 1e-6;
    let positions = (0..=side).flat_map(|i| (0..=side).map(move |j| (i, j))).map(|(i, j)| {
        let sign = if (i + j) % 2 == 0 { 1.0 } else { -1.0 };
        let z = if inner.contains(&i) && inner.contains(&j) { sign * height } else { 0.0 };
        DVec3::new(f64::from(i), f64::from(j), z)
    });
    let cells = (0..side).flat_map(|i| (0..side).map(move |j| (i, j)));
    let triangles = cells
        .flat_map(|(i, j)| {
            [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
        })
        .collect();
    let surface = MovingSurface::new(&mesh(positions.collect(), triangles)).unwrap();
    let euler = MeanCurvature { scheme: Scheme::Euler, ..Default::default() };
    let prediction = euler.advance(&surface, 0.0, 100.0).unwrap();
    // Four neighbours of weight 2 and an area of 1.
    assert!((prediction.dt - 0.25).abs() < 1e-9, "{}", prediction.dt);
    let middle = at(side / 2, side / 2) as usize;
    let z = surface.positions()[middle].z;
    for (times, factor) in [(1.0, -1.0), (1.25, -1.5), (0.5, 0.0)] {
        let moved = z + times * (prediction.ends[middle].z - z);
        assert!((moved / z - factor).abs() < 1e-9, "{times}: {}", moved / z);
    }
    // The polynomial of Runge and Kutta at -2, half a grid away from the boundary.
    let prediction = MeanCurvature::default().advance(&surface, 0.0, 100.0).unwrap();
    let moved = prediction.ends[middle].z / z;
    assert!((moved - 1.0 / 3.0).abs() < 1e-9, "{moved}");
}

/// One sliver does not stop time: it is damped.
#[test]
fn slivers_are_damped() {
    let mut surface = ball(1.0, 0.2);
    let whole = MeanCurvature::default().step(&surface, 0.0, 1.0).unwrap();
    assert_eq!(whole.damped, 0);
    // A vertex next to another.
    let mesh = surface.connectivity();
    let [a, b] = mesh.ends(mesh.edges().next().unwrap());
    let near = surface.position(b).lerp(surface.position(a), 1e-6);
    surface.set_position(a, near).unwrap();
    let damped = MeanCurvature::default().step(&surface, 0.0, 1.0).unwrap();
    assert!(damped.damped >= 1 && damped.damped <= 2, "{}", damped.damped);
    let ratio = damped.prediction.dt / whole.prediction.dt;
    assert!(ratio > 1e-4, "{ratio}");
    let strict = MeanCurvature { stiffness: f64::INFINITY, ..Default::default() };
    let short = strict.step(&surface, 0.0, 1.0).unwrap();
    assert!(short.damped == 0 && short.prediction.dt < 1e-4 * whole.prediction.dt, "{}", short.prediction.dt);
}
