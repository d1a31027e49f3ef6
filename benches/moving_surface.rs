//! Benchmark: operations on the state of the surface tracker, over sizes.
//!
//! ```text
//! cargo bench -p welter-benches --bench moving_surface [-- LARGEST]
//! ```
//! LARGEST bounds the triangles of the ladder (default 500000). Of a sphere one in eight edges is split; or flipped, or
//! collapsed, where that changes no topology, which is asked each time. After the splits the surface is compacted and
//! checked. Edges are taken in the order of their ids, as a sweep does, or shuffled, which shows the caches. Times are the
//! best of three in microseconds: for one operation that was tried, with plan and log, or for construction, compaction
//! and the check of all invariants a thousand triangles. The exponent is that of the time for all operations of a kind,
//! whose number grows as that of the triangles; the last columns tell how many were done.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

use std::time::Instant;
use welter_benches::best;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::{EdgeId, TriMesh, VertexId};
use welter_tracking::surface::{HalfEdge, MovingSurface, Rule};

const COLUMNS: [&str; 6] = ["construct", "split", "flip", "collapse", "compact", "check"];

/// Nothing beside the vertex that is meant to go.
fn collapse(surface: &mut MovingSurface, edge: EdgeId) -> bool {
    if !surface.connectivity().has_edge(edge) {
        return false;
    }
    let [kept, removed] = surface.connectivity().ends(edge);
    let Ok(plan) = surface.plan_collapse(edge, kept, 0.5) else { return false };
    let mut told = surface.consequences(&plan);
    told.lost_vertices.retain(|&v: &VertexId| v != removed);
    if told != Default::default() {
        return false;
    }
    surface.apply(plan);
    true
}

fn flip(surface: &mut MovingSurface, edge: EdgeId) -> bool {
    let around: Vec<HalfEdge> = surface.connectivity().around_edge(edge).collect();
    let &[h, o] = &around[..] else { return false };
    let Ok(plan) = surface.plan_flip([h, o]) else { return false };
    if surface.consequences(&plan) != Default::default() {
        return false;
    }
    surface.apply(plan);
    true
}

fn split(surface: &mut MovingSurface, edge: EdgeId) -> bool {
    let plan = surface.plan_split(edge, 0.5).expect("an edge in use");
    surface.apply(plan);
    true
}

/// One in eight edges, ascending or in an order without pattern.
fn eighth(surface: &MovingSurface, shuffled: bool) -> Vec<EdgeId> {
    let mut edges: Vec<EdgeId> = surface.connectivity().edges().filter(|e| e.0 % 8 == 0).collect();
    if shuffled {
        edges.sort_by_key(|e| e.0.wrapping_mul(0x9e37_79b9));
    }
    edges
}

fn with_attributes(mesh: &TriMesh) -> MovingSurface {
    let mut surface = MovingSurface::new(mesh).expect("a sphere");
    let [edges, triangles] = [surface.connectivity().edge_slots(), surface.connectivity().triangle_slots()];
    let vertices = mesh.positions().len();
    let at = surface.vertex_attributes_mut();
    at.add("velocity", mesh.positions().to_vec(), Rule::Interpolate).expect("a new name");
    at.add("age", vec![0.0; vertices], Rule::Reset).expect("a new name");
    let at = surface.edge_attributes_mut();
    at.add_directed("circulation", vec![1.0; edges], Rule::Conserve).expect("a new name");
    surface
        .triangle_attributes_mut()
        .add("amount", vec![1.0; triangles], Rule::Conserve)
        .expect("a new name");
    surface
}

/// Microseconds by column, and how many operations there were of each kind.
fn measure(mesh: &TriMesh, attributes: bool, shuffled: bool) -> ([f64; 6], [usize; 3]) {
    let thousands = |n: usize| n as f64 / 1000.0;
    let (seconds, plain) = best(3, || MovingSurface::new(mesh).expect("a sphere"));
    let start = if attributes { with_attributes(mesh) } else { plain };
    let mut times = [f64::INFINITY; 6];
    let mut note = |i: usize, seconds: f64, count: f64| times[i] = times[i].min(seconds * 1e6 / count);
    note(0, seconds, thousands(mesh.triangles().len()));
    let mut counts = [0; 3];
    let edges = eighth(&start, shuffled);
    for _ in 0..3 {
        for (i, operation) in [split, flip, collapse].into_iter().enumerate() {
            let mut surface = start.clone();
            let clock = Instant::now();
            counts[i] = edges.iter().filter(|&&edge| operation(&mut surface, edge)).count();
            note(i + 1, clock.elapsed().as_secs_f64(), edges.len() as f64);
            if i > 0 {
                continue;
            }
            let triangles = thousands(surface.connectivity().triangle_count());
            let clock = Instant::now();
            let _ = surface.compact();
            note(4, clock.elapsed().as_secs_f64(), triangles);
            let clock = Instant::now();
            surface.check().expect("every invariant holds");
            note(5, clock.elapsed().as_secs_f64(), triangles);
        }
    }
    (times, counts)
}

fn main() {
    // `cargo bench` passes flags of its own; a bare number is the largest size.
    let largest = std::env::args().skip(1).find_map(|word| word.parse().ok()).unwrap_or(500_000);
    for (attributes, shuffled) in [(false, false), (true, false), (true, true)] {
        let with = if attributes { "four attributes" } else { "no attributes" };
        println!("{with}, {}", if shuffled { "shuffled" } else { "in order" });
        println!("triangles {}", COLUMNS.map(|name| format!("{name:>10}")).concat());
        let mut rows: Vec<(f64, [f64; 6])> = Vec::new();
        for target in [6_000.0_f64, 25_000.0, 100_000.0, 400_000.0] {
            // An equilateral triangle of edge length L has area sqrt(3) / 4 L^2; the unit sphere has 4 pi.
            let edge_length = (16.0 * std::f64::consts::PI / (3.0_f64.sqrt() * target)).sqrt();
            let mesh = sphere(&Sphere { edge_length, ..Sphere::default() }).expect("a sphere");
            let n = mesh.triangles().len();
            if n > largest {
                break;
            }
            let (times, counts) = measure(&mesh, attributes, shuffled);
            println!("{n:9} {}  {counts:?}", times.map(|t| format!("{t:10.3}")).concat());
            rows.push((n as f64, times));
        }
        if let [first, .., last] = &rows[..] {
            let exponent = |i: usize| 1.0 + (last.1[i] / first.1[i]).ln() / (last.0 / first.0).ln();
            let exponents: [f64; 6] = std::array::from_fn(exponent);
            println!("exponent  {}", exponents.map(|e| format!("{e:10.3}")).concat());
        }
    }
}
