//! What must not change the lists: the scale, the number of threads.

use super::twin::{Lists, loose};
use glam::DVec3;
use welter_kit::mesher::Random;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::VertexId;
use welter_tracking::broad_phase::{BroadPhase, Motion};
use welter_tracking::surface::MovingSurface;

#[test]
fn everything_times_a_power_of_two_has_the_same_pairs() {
    let mut random = Random::new(11);
    // Multiples of 2^-20, which all of these scales keep.
    let mut point = |size: f64| {
        let p = size * random.point();
        DVec3::from_array(p.to_array().map(|x| (x * 2f64.powi(20)).round() / 2f64.powi(20)))
    };
    let corners: Vec<[DVec3; 3]> = (0..150)
        .map(|_| {
            let place = point(0.5);
            std::array::from_fn(|_| place + point(0.1))
        })
        .collect();
    let ends: Vec<DVec3> = corners.iter().flatten().map(|&p| p + point(0.05)).collect();
    let lists = |k: i32| {
        let scale = 2f64.powi(k);
        let surface = loose(corners.iter().map(|t| t.map(|p| scale * p)).collect());
        let ends: Vec<DVec3> = ends.iter().map(|&p| scale * p).collect();
        [Motion::Rest, Motion::To(&ends)].map(|motion| {
            let broad_phase = BroadPhase::new(&surface, motion).unwrap();
            [0.0, 0.125].map(|distance| Lists::of(&broad_phase, &surface, scale * distance))
        })
    };
    let expected = lists(0);
    assert!(expected.iter().flatten().all(|lists| lists.len() > 100));
    for k in [-1000, -500, -30, -1, 1, 77, 512, 1000] {
        assert_eq!(lists(k), expected, "2^{k}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_lists() {
    let mesh = sphere(&Sphere { edge_length: 0.05, ..Sphere::default() }).unwrap();
    let lists = || {
        let mut random = Random::new(12);
        let mut surface = MovingSurface::new(&mesh).unwrap();
        let ends: Vec<DVec3> = surface.positions().iter().map(|&p| p + 0.01 * random.point()).collect();
        let mut broad_phase = BroadPhase::new(&surface, Motion::Rest).unwrap();
        let mut all = vec![Lists::of(&broad_phase, &surface, 0.0)];
        broad_phase.refresh(&surface, Motion::To(&ends)).unwrap();
        all.push(Lists::of(&broad_phase, &surface, 0.0));
        // Vertices exchange their places, so the trees are built anew.
        for (i, &end) in ends.iter().enumerate() {
            let vertex = VertexId(((i * 4099) % ends.len()) as u32);
            surface.set_position(vertex, if i % 3 == 0 { end } else { surface.position(vertex) }).unwrap();
        }
        broad_phase.refresh(&surface, Motion::Rest).unwrap();
        let some: Vec<VertexId> = (0..500).map(VertexId).collect();
        for &vertex in &some {
            surface.set_position(vertex, random.point()).unwrap();
        }
        broad_phase.moved(&surface, Motion::Rest, &some).unwrap();
        let mesh = surface.connectivity();
        let vertex_triangle = broad_phase.vertex_triangle_pairs(mesh, 0.0).unwrap();
        (all, vertex_triangle, format!("{broad_phase:?}"))
    };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(lists)
    };
    let one = on(1);
    assert!(one.0[0].len() > 10_000);
    for threads in [2, 3, 8] {
        // The trees too, node by node.
        assert!(on(threads) == one, "{threads} threads");
    }
}
