//! Benchmark: the surface of a sphere's samples on grids of 32^3 to 512^3 nodes, beside crates of the registry that make a surface of samples; and how
//! volume and area of it converge.
//!
//! ```text
//! cargo bench -p welter-benches --bench isosurface [-- LARGEST]
//! ```
//! `RAYON_NUM_THREADS` sets the number of threads of ours; the peers use one. Ours reads `f64` and gives `f64` and a closed oriented mesh; the peers read `f32`
//! and give `f32`. Times are the best of [`RUNS`], samples excluded. Memory is what a process grows by at most while it makes the surface,
//! the surface included, in parts of the samples' size. Open edges are counted by index.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::hint::black_box;

use fast_surface_nets::ndshape::{RuntimeShape, Shape};
use fast_surface_nets::{SurfaceNetsBuffer, surface_nets};
use glam::DVec3;
use welter_benches::{best, memory};
use welter_meshing::Monitor;
use welter_meshing::grid::{Grid3, Samples};
use welter_meshing::isosurface::{MarchingCubes, marching_cubes};
use welter_meshing::surface::EmbeddedMesh;
use welter_meshing::surface::measure::{area, signed_volume};

/// Runs of each measurement.
const RUNS: usize = 5;

/// Radius of the sphere in a cube of side 2; no node is at this distance from the centre.
const RADIUS: f64 = 0.801;

/// Off the nodes and off the symmetries of the grid.
const CENTER: DVec3 = DVec3::new(0.0131, -0.0207, 0.0341);

fn field(p: DVec3) -> f64 {
    p.distance(CENTER) - RADIUS
}

/// By how much the resident memory of a process of its own grows at most while it makes a surface, in bytes; samples excluded.
fn growth(who: &str, n: u32) -> f64 {
    let this = std::env::current_exe().expect("a program has a path");
    let output = std::process::Command::new(this).args(["--growth", who, &n.to_string()]).output();
    let text = output.map(|o| String::from_utf8_lossy(&o.stdout).into_owned()).unwrap_or_default();
    text.trim().parse().unwrap_or(f64::NAN)
}

/// What such a process prints.
fn print_growth(run: impl FnOnce()) {
    let before = memory("VmRSS:");
    run();
    if let (Some(before), Some(peak)) = (before, memory("VmHWM:")) {
        println!("{}", peak - before);
    }
}

/// Edges that do not have two triangles running opposite ways.
fn open_edges(indices: impl Iterator<Item = [u32; 3]>) -> usize {
    let mut edges: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    for t in indices {
        for [a, b] in [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]] {
            *edges.entry([a.min(b), a.max(b)]).or_insert(0) += if a < b { 1 } else { -1 };
        }
    }
    edges.values().filter(|&&sum| sum != 0).count()
}

struct Row {
    nodes: f64,
    seconds: f64,
    errors: [f64; 2],
}

fn our_samples(n: u32) -> (Samples<3>, f64) {
    let grid =
        Grid3::new([-1.0; 3], 2.0 / f64::from((n - 1).next_power_of_two()), [n - 1; 3]).expect("exact nodes");
    // The cube of side 2, whatever the number of nodes is.
    let scale = 2.0 / (grid.max()[0] + 1.0);
    let samples = Samples::of(&grid, &|p: DVec3| field((p + 1.0) * scale - 1.0), &Monitor::none())
        .expect("nobody stops");
    (samples, scale)
}

fn surface(samples: &Samples<3>) -> EmbeddedMesh {
    marching_cubes(samples, &MarchingCubes::default(), &Monitor::none()).expect("numbers")
}

fn ours(n: u32) -> Row {
    let (samples, scale) = our_samples(n);
    let (seconds, mesh) = best(RUNS, || surface(&samples));
    let (volume, whole) = (4.0 / 3.0 * PI * RADIUS.powi(3), 4.0 * PI * RADIUS * RADIUS);
    let errors = [
        (signed_volume(&mesh) * scale.powi(3) - volume).abs() / volume,
        (area(&mesh) * scale.powi(2) - whole).abs() / whole,
    ];
    let nodes = samples.grid().node_count() as f64;
    println!(
        "{n:4}^3  welter             {seconds:9.5} s   {:8} triangles   memory {:5.2} of the samples   volume {:.2e} area {:.2e}",
        mesh.triangles().len(),
        growth("ours", n) / (8.0 * nodes),
        errors[0],
        errors[1]
    );
    Row { nodes, seconds, errors }
}

fn nets_samples(n: u32) -> (RuntimeShape<u32, 3>, Vec<f32>) {
    let shape = RuntimeShape::<u32, 3>::new([n; 3]);
    let samples: Vec<f32> = (0..shape.size())
        .map(|i| {
            field(DVec3::from_array(
                shape.delinearize(i).map(|c| 2.0 * f64::from(c) / f64::from(n - 1) - 1.0),
            )) as f32
        })
        .collect();
    (shape, samples)
}

fn nets(n: u32, (shape, samples): &(RuntimeShape<u32, 3>, Vec<f32>)) -> SurfaceNetsBuffer {
    let mut buffer = SurfaceNetsBuffer::default();
    surface_nets(samples, shape, [0; 3], [n - 1; 3], &mut buffer);
    buffer
}

fn surface_nets_of(n: u32) {
    let samples = nets_samples(n);
    let (seconds, buffer) = best(RUNS, || nets(n, &samples));
    let triangles = buffer.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]);
    println!(
        "{n:4}^3  fast-surface-nets  {seconds:9.5} s   {:8} triangles   memory {:5.2} of the samples   {} open edges",
        buffer.indices.len() / 3,
        growth("nets", n) / (4.0 * samples.1.len() as f64),
        open_edges(triangles)
    );
}

struct Lookup {
    samples: Vec<f32>,
    n: usize,
}

impl isosurface::source::Source for Lookup {
    fn sample(&self, x: f32, y: f32, z: f32) -> f32 {
        // It asks for one layer beyond the last.
        let at = |c: f32| ((c * (self.n - 1) as f32 + 0.5) as usize).min(self.n - 1);
        self.samples[at(x) + self.n * (at(y) + self.n * at(z))]
    }
}

fn lookup(n: u32) -> Lookup {
    let at = |c: u32| 2.0 * f64::from(c) / f64::from(n - 1) - 1.0;
    let samples =
        (0..n.pow(3)).map(|i| field(DVec3::new(at(i % n), at(i / n % n), at(i / n / n))) as f32).collect();
    Lookup { samples, n: n as usize }
}

fn cubes(n: u32, source: &Lookup) -> (Vec<f32>, Vec<u32>) {
    let (mut vertices, mut indices) = (Vec::new(), Vec::new());
    isosurface::marching_cubes::MarchingCubes::new(n as usize).extract(source, &mut vertices, &mut indices);
    (vertices, indices)
}

fn isosurface_of(n: u32) {
    let source = lookup(n);
    let (seconds, (_, indices)) = best(RUNS, || cubes(n, &source));
    println!(
        "{n:4}^3  isosurface         {seconds:9.5} s   {:8} triangles   memory {:5.2} of the samples   {} open edges",
        indices.len() / 3,
        growth("isosurface", n) / (4.0 * source.samples.len() as f64),
        open_edges(indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]))
    );
}

/// The process that measures memory: `--growth WHO N`.
fn measure_growth(who: &str, n: u32) {
    match who {
        "ours" => {
            let (samples, _) = our_samples(n);
            print_growth(|| drop(black_box(surface(&samples))));
        }
        "nets" => {
            let samples = nets_samples(n);
            print_growth(|| drop(black_box(nets(n, &samples))));
        }
        _ => {
            let source = lookup(n);
            print_growth(|| drop(black_box(cubes(n, &source))));
        }
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let [flag, who, n] = &words[..]
        && flag == "--growth"
    {
        return measure_growth(who, n.parse().expect("a number of nodes"));
    }
    // `cargo bench` passes flags of its own; a bare number is the largest size.
    let largest = words.iter().find_map(|word| word.parse().ok()).unwrap_or(256);
    println!("{} threads", rayon::current_num_threads());
    let mut rows = Vec::new();
    for n in [32, 64, 128, 256, 512].into_iter().filter(|&n| n <= largest) {
        rows.push(ours(n));
        surface_nets_of(n);
        isosurface_of(n);
    }
    for pair in rows.windows(2) {
        let order = |of: usize| (pair[0].errors[of] / pair[1].errors[of]).log2();
        println!(
            "from {:.0} to {:.0} nodes: growth exponent {:.2}, order of volume {:.2}, of area {:.2}",
            pair[0].nodes,
            pair[1].nodes,
            (pair[1].seconds / pair[0].seconds).ln() / (pair[1].nodes / pair[0].nodes).ln(),
            order(0),
            order(1)
        );
    }
}
