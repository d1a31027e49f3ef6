//! Benchmark: near equilateral triangles from marching cubes. A table of shape and distance over fields and spacings, then time over sizes.
//!
//! ```text
//! cargo bench -p welter-benches --bench remesh [-- speed LARGEST]
//! ```
//! `speed` leaves out the table. LARGEST bounds the triangles of the timed ladder (default 300000). Lengths in the table are the smallest, the first percentile, the mean in
//! spacings, the last percentile and the largest. "Distance" is the largest |f| / |grad f| at 15 points of each triangle, and the order between two spacings; the last line of
//! a field has the order over the whole ladder. Times are those of the processor, where Linux tells them: remeshing is serial.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

use std::time::Instant;

use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::field::ScalarField;
use welter_meshing::grid::{Grid3, Samples};
use welter_meshing::isosurface::{MarchingCubes, marching_cubes};
use welter_meshing::remesh::{Equilateral, StartingMesh, equilateral, starting_mesh};
use welter_meshing::surface::measure::angle_statistics;
use welter_meshing::surface::{EmbeddedMesh, Topology, TriId, TriMesh};

type Field = fn(DVec3) -> f64;

fn ball(p: DVec3) -> f64 {
    p.length() - 0.9
}

fn torus(p: DVec3) -> f64 {
    let across = p.x.hypot(p.y) - 0.65;
    across.hypot(p.z) - 0.25
}

fn two_balls(p: DVec3) -> f64 {
    let at = |x: f64, r: f64| (p - DVec3::new(x, 0.1 * x, 0.03)).length() - r;
    at(-0.5, 0.35).min(at(0.4, 0.42))
}

/// The smooth union of five balls.
fn blobs(p: DVec3) -> f64 {
    let balls = [
        [0.0, 0.0, 0.0, 0.4],
        [0.45, 0.1, 0.0, 0.3],
        [-0.4, 0.2, 0.1, 0.3],
        [0.0, -0.5, 0.1, 0.3],
        [0.1, 0.1, 0.5, 0.3],
    ];
    let sum: f64 =
        balls.iter().map(|&[x, y, z, r]| (-((p - DVec3::new(x, y, z)).length() - r) * 12.0).exp()).sum();
    -sum.ln() / 12.0
}

/// A sheet around the gyroid within a ball, the corner between the two rounded.
fn gyroid(p: DVec3) -> f64 {
    let q = 5.0 * p;
    let value = q.x.sin() * q.y.cos() + q.y.sin() * q.z.cos() + q.z.sin() * q.x.cos();
    let sheet = value.abs() / 7.5 - 0.07;
    let sphere = p.length() - 0.9;
    smooth_max(sheet, sphere, 0.12)
}

fn smooth_max(a: f64, b: f64, width: f64) -> f64 {
    let h = (width - (a - b).abs()).max(0.0) / width;
    a.max(b) + 0.25 * width * h * h
}

/// Two balls and a bar between them, blended near the balls only: nowhere a crease.
fn dumbbell(p: DVec3) -> f64 {
    let balls = (DVec3::new(p.x.abs() - 0.5, p.y, p.z)).length() - 0.38;
    let bar = (p - DVec3::new(p.x.clamp(-0.5, 0.5), 0.0, 0.0)).length() - 0.14;
    -smooth_max(-balls, -bar, 0.1)
}

fn ellipsoid(p: DVec3) -> f64 {
    (p / DVec3::new(0.9, 0.6, 0.4)).length_squared() - 1.0
}

const FIELDS: [(&str, Field); 7] = [
    ("ball", ball),
    ("torus", torus),
    ("two balls", two_balls),
    ("blobs", blobs),
    ("gyroid", gyroid),
    ("dumbbell", dumbbell),
    ("ellipsoid", ellipsoid),
];

/// Largest |f| / |grad f| at a lattice of 15 points on each triangle.
fn farthest(mesh: &TriMesh, field: &impl ScalarField, step: f64) -> f64 {
    let mut farthest = 0.0_f64;
    for t in 0..mesh.triangles().len() {
        let [a, b, c] = mesh.corners(TriId::from_index(t));
        for i in 0..=4 {
            for j in 0..=4 - i {
                let [u, v] = [i, j].map(|k| f64::from(k) / 4.0);
                let p = a + u * (b - a) + v * (c - a);
                farthest = farthest.max(field.value(p).abs() / field.gradient(p, step).length());
            }
        }
    }
    farthest
}

fn grid(spacing: f64) -> Grid3 {
    Grid3::covering([-1.0; 3], [1.0; 3], spacing, 1).expect("a small grid")
}

fn quality() {
    println!(
        "triangles   before: angle   after: angles       edges / mean            near mean  off   refused(shape, meet)   distance  order"
    );
    let mut least = 180.0_f64;
    for (name, field) in FIELDS {
        let mut ladder: Vec<(f64, f64)> = Vec::new();
        let order = |from: (f64, f64), to: (f64, f64)| (from.1 / to.1).ln() / (from.0 / to.0).ln();
        for cells in [16, 24, 32, 48, 64] {
            let spacing = 2.0 / f64::from(cells);
            let nobody = Monitor::none();
            let samples = Samples::of(&grid(spacing), &field, &nobody).expect("nobody cancels");
            let cubes = marching_cubes(&samples, &MarchingCubes::default(), &nobody).expect("numbers");
            let before = angle_statistics(&cubes).expect("triangles").min.to_degrees();
            let parameters = StartingMesh::default();
            let (mesh, report) =
                starting_mesh(&grid(spacing), &field, &parameters, &nobody).expect("numbers");
            let embedded = EmbeddedMesh::check(&mesh, &nobody).is_ok();
            let same =
                Topology::of(&mesh).euler_characteristic() == Topology::of(&cubes).euler_characteristic();
            let far = farthest(&mesh, &field, spacing * 1e-3);
            let step = ladder.last().map_or(f64::NAN, |&coarser| order(coarser, (spacing, far)));
            ladder.push((spacing, far));
            least = least.min(report.smallest_angle.to_degrees());
            let e = report.edges;
            println!(
                "{name:10} {:7} {before:9.1e}  {:5.1} {:6.1}   {:.2} {:.2} | {:.3} | {:.2} {:.2}   {:.5}  {:3}   {:6} {:5}   {far:.2e}  {step:5.2}  {}",
                mesh.triangles().len(),
                report.smallest_angle.to_degrees(),
                report.largest_angle.to_degrees(),
                e.min / e.mean,
                e.first_percentile / e.mean,
                e.mean / spacing,
                e.last_percentile / e.mean,
                e.max / e.mean,
                e.near_mean,
                report.off_surface,
                report.refused_for_shape,
                report.refused_for_intersection,
                if embedded && same { "" } else { "NOT EMBEDDED, OR OF OTHER TOPOLOGY" },
            );
        }
        println!("{name:10} order {:.2}", order(ladder[0], ladder[ladder.len() - 1]));
    }
    println!("smallest angle of all: {least:.1} degrees");
}

/// Time that this process has computed for.
fn processor_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? * 1e-9)
}

fn speed(largest: usize) {
    let mut rows: Vec<(f64, f64)> = Vec::new();
    for cells in [26, 40, 80, 160, 250] {
        let spacing = 2.0 / f64::from(cells);
        let nobody = Monitor::none();
        let samples = Samples::of(&grid(spacing), &(blobs as Field), &nobody).expect("nobody cancels");
        let cubes = marching_cubes(&samples, &MarchingCubes::default(), &nobody).expect("numbers");
        let parameters = Equilateral { edge_length: spacing, ..Equilateral::default() };
        if cubes.triangles().len() > largest {
            break;
        }
        let (start, busy) = (Instant::now(), processor_seconds());
        let (mesh, report) = equilateral(&cubes, &(blobs as Field), &parameters, &nobody).expect("numbers");
        let seconds = match (busy, processor_seconds()) {
            (Some(before), Some(after)) => after - before,
            _ => start.elapsed().as_secs_f64(),
        };
        let n = mesh.triangles().len();
        println!(
            "blobs: {} -> {n} triangles in {seconds:.3} s, {:.2e} s a triangle; {} splits, {} collapses, {} flips, {} moves",
            cubes.triangles().len(),
            seconds / n as f64,
            report.splits,
            report.collapses,
            report.flips,
            report.moves
        );
        rows.push((n as f64, seconds));
    }
    if let [first, .., last] = &rows[..] {
        println!("growth exponent of time: {:.2}", (last.1 / first.1).ln() / (last.0 / first.0).ln());
    }
}

fn main() {
    // `cargo bench` passes flags of its own; a bare number is the largest size.
    let largest = std::env::args().skip(1).find_map(|word| word.parse().ok()).unwrap_or(300_000);
    if std::env::args().all(|word| word != "speed") {
        quality();
    }
    speed(largest);
}
