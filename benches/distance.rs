//! Benchmark: distance fields of grids around meshes of 100,000 triangles, ladders of grids and of triangles, and redistancing;
//! the closest point of one node at a time, ours and `parry3d-f64`'s, beside them.
//!
//! ```text
//! cargo bench -p welter-benches --bench distance [-- CELLS]
//! ```
//! `CELLS` is the largest number of cells along an axis. `RAYON_NUM_THREADS` sets the number of threads. Times are the best of [`RUNS`] and hold everything: hierarchy,
//! distances, signs. Beside each stands the processor time of the run, which other work on the machine disturbs less. A node by itself is
//! measured on every [`SAMPLE`]-th node, on one thread.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

use std::hint::black_box;
use std::time::Instant;

use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::TriMesh as ParryMesh;
use welter_meshing::distance::{
    DistanceParameters, ExtrapolationParameters, RedistanceParameters, extrapolate, grid_winding_numbers,
    redistance, signed_distance,
};
use welter_meshing::grid::{Grid3, Samples};
use welter_meshing::shapes::{Sphere, Torus, sphere, torus};
use welter_meshing::spatial::Bvh;
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh};
use welter_meshing::{DVec3, Monitor};

/// Runs of each measurement.
const RUNS: usize = 3;

/// Nodes in one that is measured by itself.
const SAMPLE: usize = 1511;

/// Width of a narrow band, in cells.
const BAND: f64 = 3.0;

/// Triangles of a geodesic sphere of radius 1 and edge length 1, about.
const TRIANGLES_OF_UNIT_EDGE: f64 = 36.5;

/// Wall time and processor time in seconds.
#[derive(Clone, Copy)]
struct Time {
    wall: f64,
    processor: f64,
}

impl std::fmt::Display for Time {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:7.3} s ({:6.2} s)", self.wall, self.processor)
    }
}

/// User and system time of the process so far in seconds, where Linux tells it; in steps of 10 ms.
fn processor_time() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after_name = text.rsplit(") ").next().unwrap_or_default();
    let ticks = after_name.split(' ').skip(11).take(2);
    ticks.filter_map(|word| word.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// The best of some runs by wall time, and its result.
fn best<T>(mut run: impl FnMut() -> T) -> (Time, T) {
    let timed = |_| {
        let (start, processor) = (Instant::now(), processor_time());
        let result = black_box(run());
        (Time { wall: start.elapsed().as_secs_f64(), processor: processor_time() - processor }, result)
    };
    (0..RUNS).map(timed).min_by(|a, b| a.0.wall.total_cmp(&b.0.wall)).expect("one run at least")
}

/// A sphere of about so many triangles.
fn ball(triangles: f64) -> ClosedOrientedMesh {
    let edge_length = (TRIANGLES_OF_UNIT_EDGE / triangles).sqrt();
    sphere(&Sphere { edge_length, ..Sphere::default() }).expect("valid parameters")
}

/// A sphere with bumps.
fn bumpy(triangles: f64) -> ClosedOrientedMesh {
    let mut soup = ball(triangles).to_soup();
    for p in &mut soup.positions {
        *p *= 1.0 + 0.08 * (9.0 * p.x).sin() * (8.0 * p.y).sin() * (7.0 * p.z).cos();
    }
    ClosedOrientedMesh::new(TriMesh::new(soup).expect("finite")).expect("closed")
}

fn ring(edge_length: f64) -> ClosedOrientedMesh {
    torus(&Torus { edge_length, ..Torus::default() }).expect("valid parameters")
}

/// About so many cells along the longest side of the mesh's box and four cells on either side.
fn around(mesh: &TriMesh, cells: u32) -> Grid3 {
    let zero = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (min, max) = mesh.positions().iter().fold(zero, |(a, b), &p| (a.min(p), b.max(p)));
    let spacing = (max - min).max_element() / f64::from(cells - 8);
    // A cube, so that all shapes have as many nodes.
    let (middle, half) = (0.5 * (min + max), 0.5 * spacing * f64::from(cells));
    Grid3::covering((middle - half).to_array(), (middle + half).to_array(), spacing, 0).expect("a valid grid")
}

/// Wall times of the narrow band and of the whole grid.
fn measure(name: &str, mesh: &ClosedOrientedMesh, cells: u32) -> [f64; 2] {
    let grid = around(mesh, cells);
    let nobody = Monitor::none();
    let (winding, _) = best(|| grid_winding_numbers(mesh, &grid, &nobody).expect("nobody cancels"));
    let of = |band: f64| {
        let parameters = DistanceParameters { band, ..DistanceParameters::default() };
        best(|| signed_distance(mesh, &grid, &parameters, &nobody).expect("nobody cancels"))
    };
    let (band, near) = of(BAND * grid.spacing());
    let (full, field) = of(f64::INFINITY);
    let limit = BAND * grid.spacing();
    let inside = near.distances.values().iter().filter(|d| d.abs() < limit).count();
    println!(
        "{name:7} {:7} triangles {:9} nodes  signs {winding}   band {band} {inside:8} nodes   full {full}",
        mesh.triangles().len(),
        grid.node_count(),
    );
    black_box(field);
    [band.wall, full.wall]
}

/// Microseconds a node by itself.
fn one_by_one(mesh: &ClosedOrientedMesh, cells: u32) {
    let grid = around(mesh, cells);
    let nodes: Vec<DVec3> =
        (0..grid.node_count()).step_by(SAMPLE).map(|n| grid.position(grid.node_at(n))).collect();
    let bvh = Bvh::new(mesh);
    let (ours, _) =
        best(|| nodes.iter().filter_map(|&p| bvh.closest_point(p)).map(|c| c.distance).sum::<f64>());
    let vertices = mesh.positions().iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
    let indices = mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect();
    let parry = ParryMesh::new(vertices, indices).expect("a valid mesh");
    let distance = |p: &DVec3| parry.distance_to_local_point(Vector::new(p.x, p.y, p.z), false);
    let (theirs, _) = best(|| nodes.iter().map(distance).sum::<f64>());
    let each = |time: Time| 1e6 * time.wall / nodes.len() as f64;
    println!(
        "one node by itself: Bvh::closest_point {:.2} us, parry3d-f64 {:.2} us; for {} nodes {:.1} s and {:.1} s",
        each(ours),
        each(theirs),
        grid.node_count(),
        1e-6 * each(ours) * grid.node_count() as f64,
        1e-6 * each(theirs) * grid.node_count() as f64
    );
}

fn exponent(first: (f64, f64), last: (f64, f64)) -> f64 {
    (last.1 / first.1).ln() / (last.0 / first.0).ln()
}

/// Time and error of redistancing a level set of uneven steepness about a sphere, and time of an extrapolation.
fn redistancing(cells: u32) -> f64 {
    let nobody = Monitor::none();
    let grid = Grid3::new([-1.0; 3], 2.0 / f64::from(cells), [cells; 3]).expect("a power of two");
    let uneven = |p: DVec3| (p.length_squared() - 0.36) * (1.5 + (3.0 * p.x).sin() * (2.0 * p.y + 1.0).cos());
    let level_set = Samples::of(&grid, &uneven, &nobody).expect("nobody cancels");
    let parameters = RedistanceParameters::default();
    let (time, (found, report)) = best(|| redistance(&level_set, &parameters, &nobody).expect("no NaN"));
    let (mut beside, mut far) = (0.0_f64, 0.0_f64);
    for (node, &value) in found.values().iter().enumerate() {
        let radius = grid.position(grid.node_at(node)).length();
        let error = (value - (radius - 0.6)).abs();
        if (radius - 0.6).abs() < 0.5 * grid.spacing() {
            beside = beside.max(error);
        }
        if radius > 0.2 {
            far = far.max(error);
        }
    }
    let constant = ExtrapolationParameters::default();
    let (carried, _) = best(|| extrapolate(&level_set, &found, &constant, &nobody).expect("the same grid"));
    println!(
        "{cells:4} cells  redistance {time} {:2} sweeps   error next to the contour {beside:.2e}, elsewhere {far:.2e}   \
         extrapolate {carried}",
        report.sweeps
    );
    far
}

fn main() {
    // `cargo bench` passes flags of its own; a bare number is the largest grid.
    let largest = std::env::args().skip(1).find_map(|word| word.parse().ok()).unwrap_or(256);
    println!("{} threads; wall time (processor time); band of {BAND} cells", rayon::current_num_threads());
    measure("bumpy", &bumpy(100_000.0), 128.min(largest));
    measure("torus", &ring(0.0178), 128.min(largest));
    let mesh = ball(100_000.0);
    one_by_one(&mesh, 128.min(largest));
    let ladder = |name: &str, rows: Vec<(f64, [f64; 2])>| {
        if let [first, .., last] = rows[..] {
            let [band, full] = [0, 1].map(|i| exponent((first.0, first.1[i]), (last.0, last.1[i])));
            println!(
                "growth exponents in {name} from {:.0} to {:.0}: band {band:.2}, full {full:.2}",
                first.0, last.0
            );
        }
    };
    let cells = [32, 64, 128, 256].into_iter().filter(|&cells| cells <= largest);
    ladder("cells along an axis", cells.map(|n| (f64::from(n), measure("sphere", &mesh, n))).collect());
    let triangles = [1e3, 1e4, 1e5, 4e5];
    ladder("triangles", triangles.map(|n| (n, measure("sphere", &ball(n), 128.min(largest)))).to_vec());
    for cells in [16, 32, 64, 128, 256].into_iter().filter(|&cells| cells <= largest) {
        redistancing(cells);
    }
}
