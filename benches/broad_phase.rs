//! Benchmark: the broad phase of the surface tracker, over sizes.
//!
//! ```text
//! cargo bench -p welter-benches --bench broad_phase [-- LARGEST [THREADS]]
//! ```
//! LARGEST bounds the triangles of the ladder (default 500000), THREADS the pool (default: all). Of a sphere whose
//! vertices move by up to a tenth of the edge length along each axis, and of one beside a triangle as large as all.
//! Times are the best of three: milliseconds for everything at once; microseconds for one of ten thousand elements,
//! in the order of their ids, as a sweep takes them, or shuffled, which shows the caches. As a baseline the static
//! hierarchies of `welter_meshing` over the same boxes of vertices, edges and triangles are built, refitted and asked for
//! triangles in the same run (`static`, `s refit`, `s query`). Pairs and queries are of the motion, but `e-t rest`, `update`
//! and `move` of the surface at rest. `update` is an edge split that is followed, without the split itself; `move` a vertex
//! that moved, with its star. The exponent is that of the time for everything; of single elements, that of the time for
//! one times the number of triangles. The last columns tell how many pairs there were.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

use glam::DVec3;
use std::hint::black_box;
use std::time::Instant;
use welter_benches::best;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::spatial::{Box3, BoxTree};
use welter_meshing::surface::{EdgeId, TriMesh, TriangleSoup, VertexId};
use welter_tracking::broad_phase::{BroadPhase, Motion};
use welter_tracking::surface::MovingSurface;

const COLUMNS: [&str; 13] = [
    "build", "refresh", "static", "s refit", "v-t", "e-e", "e-t rest", "query v", "query e", "query t",
    "s query", "update", "move",
];
/// From here on times are of one element.
const SINGLE: usize = 7;
const SINGLES: usize = 10_000;

/// A number in [-1, 1) without pattern.
fn noise(i: usize) -> f64 {
    let z = (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (z >> 11) as f64 / 2f64.powi(52) - 1.0
}

/// Some of `count` numbers: the first ones, or without pattern.
fn some(count: usize, shuffled: bool) -> impl Iterator<Item = u32> {
    (0..SINGLES).map(move |i| ((if shuffled { i * 0x9e37_79b9 } else { i }) % count) as u32)
}

/// A sphere with about so many triangles, and its edge length.
fn input(target: f64, with_a_large_triangle: bool) -> (TriMesh, f64) {
    // An equilateral triangle of edge length L has area sqrt(3) / 4 L^2; the unit sphere has 4 pi.
    let edge_length = (16.0 * std::f64::consts::PI / (3.0_f64.sqrt() * target)).sqrt();
    let mesh = sphere(&Sphere { edge_length, ..Sphere::default() }).expect("a sphere").into_mesh();
    if !with_a_large_triangle {
        return (mesh, edge_length);
    }
    let (mut positions, mut triangles) = (mesh.positions().to_vec(), Vec::new());
    triangles.extend(mesh.triangles().iter().map(|t| t.map(|v| v.0)));
    let next = positions.len() as u32;
    positions.extend([DVec3::new(1.1, -2.0, -2.0), DVec3::new(1.1, 4.0, -2.0), DVec3::new(-1.1, -2.0, 4.0)]);
    triangles.push([next, next + 1, next + 2]);
    let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
    (TriMesh::new(soup).expect("finite and in range"), edge_length)
}

/// Times by column, and how many pairs there were of each kind.
fn measure(mesh: &TriMesh, edge_length: f64, shuffled: bool) -> ([f64; 13], [usize; 3]) {
    let surface = MovingSurface::new(mesh).expect("admissible");
    let connectivity = surface.connectivity();
    let moved = |(i, &p): (usize, &DVec3)| {
        p + 0.1 * edge_length * DVec3::new(noise(3 * i), noise(3 * i + 1), noise(3 * i + 2))
    };
    let ends: Vec<DVec3> = surface.positions().iter().enumerate().map(moved).collect();
    let motion = Motion::To(&ends);
    let swept = |vertices: &[VertexId]| {
        Box3::of(vertices.iter().flat_map(|&v| [surface.position(v), ends[v.index()]]))
    };
    let boxes: [Vec<Box3>; 3] = [
        connectivity.vertices().map(|v| swept(&[v])).collect(),
        connectivity.edges().map(|e| swept(&connectivity.ends(e))).collect(),
        connectivity.triangles().map(|t| swept(&connectivity.corners(t))).collect(),
    ];
    let (mut times, mut counts) = ([0.0; 13], [0; 3]);
    let mut rest;
    (times[0], rest) = best(3, || BroadPhase::new(&surface, Motion::Rest).expect("finite"));
    times[1] = best(3, || rest.refresh(&surface, motion).expect("finite")).0;
    let mut fixed;
    (times[2], fixed) = best(3, || boxes.each_ref().map(|boxes| BoxTree::new(boxes)));
    times[3] = best(3, || fixed.iter_mut().zip(&boxes).for_each(|(tree, boxes)| tree.refit(boxes))).0;
    (times[4], counts[0]) = best(3, || rest.vertex_triangle_pairs(connectivity, 0.0).expect("zero").len());
    (times[5], counts[1]) = best(3, || rest.edge_edge_pairs(connectivity, 0.0).expect("zero").len());
    let each = |seconds: f64| 1e3 * seconds / SINGLES as f64;
    let queries = [
        best(3, || {
            some(boxes[0].len(), shuffled).for_each(|v| {
                black_box(rest.triangles_near_vertex(connectivity, VertexId(v), 0.0).expect("zero"));
            });
        }),
        best(3, || {
            some(boxes[1].len(), shuffled).for_each(|e| {
                black_box(rest.edges_near_edge(connectivity, EdgeId(e), 0.0).expect("zero"));
            });
        }),
        best(3, || {
            some(boxes[2].len(), shuffled).for_each(|t| {
                black_box(rest.triangles_near(&boxes[2][t as usize], 0.0).expect("zero"));
            });
        }),
        best(3, || {
            some(boxes[2].len(), shuffled).for_each(|t| {
                black_box(fixed[2].meeting(&boxes[2], &boxes[2][t as usize]));
            });
        }),
    ];
    queries.iter().zip(SINGLE..).for_each(|(query, i)| times[i] = each(query.0));
    drop(fixed);
    rest.refresh(&surface, Motion::Rest).expect("finite");
    (times[6], counts[2]) = best(3, || rest.edge_triangle_pairs(connectivity, 0.0).expect("zero").len());
    let updates: Vec<[f64; 2]> = (0..3).map(|_| changes(surface.clone(), rest.clone(), shuffled)).collect();
    for i in 0..2 {
        times[11 + i] = each(updates.iter().map(|times| times[i]).fold(f64::INFINITY, f64::min));
    }
    (times.map(|seconds| 1e3 * seconds), counts)
}

/// Seconds for splits of edges that are followed, and for moves of vertices.
fn changes(mut surface: MovingSurface, mut broad_phase: BroadPhase, shuffled: bool) -> [f64; 2] {
    let mut seconds = [0.0; 2];
    for edge in some(surface.connectivity().edge_slots(), shuffled) {
        let plan = surface.plan_split(EdgeId(edge), 0.5).expect("an edge in use");
        surface.apply(plan);
        let log = surface.take_log();
        let clock = Instant::now();
        broad_phase.follow(&surface, Motion::Rest, &log).expect("finite");
        seconds[0] += clock.elapsed().as_secs_f64();
    }
    for vertex in some(surface.connectivity().vertex_slots(), shuffled) {
        let vertex = VertexId(vertex);
        surface.set_position(vertex, 0.999 * surface.position(vertex)).expect("finite");
        let clock = Instant::now();
        broad_phase.moved(&surface, Motion::Rest, &[vertex]).expect("finite");
        seconds[1] += clock.elapsed().as_secs_f64();
    }
    seconds
}

fn ladder(largest: usize) {
    for (with_a_large_triangle, shuffled) in [(false, false), (false, true), (true, false)] {
        let surface = if with_a_large_triangle { "sphere and a large triangle" } else { "sphere" };
        println!("{surface}, {}", if shuffled { "shuffled" } else { "in order" });
        println!("triangles {}", COLUMNS.map(|name| format!("{name:>9}")).concat());
        let mut rows: Vec<(f64, [f64; 13])> = Vec::new();
        for target in [6_000.0_f64, 25_000.0, 100_000.0, 400_000.0] {
            let (mesh, edge_length) = input(target, with_a_large_triangle);
            let n = mesh.triangles().len();
            if n > largest {
                break;
            }
            let (times, counts) = measure(&mesh, edge_length, shuffled);
            println!("{n:9} {}  {counts:?}", times.map(|t| format!("{t:9.3}")).concat());
            rows.push((n as f64, times));
        }
        if let [first, .., last] = &rows[..] {
            let exponents: [f64; 13] = std::array::from_fn(|i| {
                let of_all = if i < SINGLE { 0.0 } else { 1.0 };
                of_all + (last.1[i] / first.1[i]).ln() / (last.0 / first.0).ln()
            });
            println!("exponent  {}", exponents.map(|e| format!("{e:9.3}")).concat());
        }
    }
}

fn main() {
    // `cargo bench` passes flags of its own; bare numbers are the largest size and the number of threads.
    let mut numbers = std::env::args().skip(1).filter_map(|word| word.parse().ok());
    let largest = numbers.next().unwrap_or(500_000);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(numbers.next().unwrap_or(0)).build();
    pool.expect("threads").install(|| ladder(largest));
}
