//! Benchmark: cutting the cells of a grid at the surface of a sphere, volumes and areas of the pieces, and quadrature of the degree that products of quadratic
//! B-splines need; on grids of 32^3 to 256^3 nodes.
//!
//! ```text
//! cargo bench -p welter-benches --bench cut_cells [-- LARGEST]
//! ```
//! Times are the best of [`RUNS`], samples excluded; cutting is parallel, sums and quadrature run on one thread. Marching cubes, which has the same surface, is the
//! baseline.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

use std::hint::black_box;

use glam::DVec3;
use welter_benches::best;
use welter_meshing::Monitor;
use welter_meshing::cut_cells::{CutCells, MASS_DEGREE};
use welter_meshing::grid::{Grid3, Samples};
use welter_meshing::isosurface::{MarchingCubes, marching_cubes};
use welter_meshing::quadrature::TetrahedronRule;
use welter_meshing::surface::measure::{area, signed_volume};

/// Runs of each measurement.
const RUNS: usize = 3;

fn measure(n: u32) -> [f64; 2] {
    let grid = Grid3::covering([-1.0; 3], [1.0; 3], 2.0 / f64::from(n - 2), 0).expect("a grid");
    let center = DVec3::new(0.0131, -0.0207, 0.0341);
    let samples =
        Samples::of(&grid, &|p: DVec3| p.distance(center) - 0.801, &Monitor::none()).expect("nobody stops");
    let parameters = MarchingCubes::default();
    let (cut, cells) =
        best(RUNS, || CutCells::new(&samples, &parameters, &Monitor::none()).expect("numbers"));
    let (cubes, mesh) =
        best(RUNS, || marching_cubes(&samples, &parameters, &Monitor::none()).expect("numbers"));
    let (sums, [volume, surface]) = best(RUNS, || [cells.volume(), cells.area()]);
    let rule = TetrahedronRule::of_degree(MASS_DEGREE).expect("a moderate degree");
    let (quadrature, moment) = best(RUNS, || {
        let points = cells.iter().step_by(16).flat_map(|cell| cell.volume_points(&rule));
        points.map(|q| q.weight * q.point.x * q.point.x).sum::<f64>()
    });
    black_box(moment);
    let tetrahedra: usize = cells.iter().map(|cell| cell.tetrahedra().len()).sum();
    println!(
        "{n:4}^3  {:7} cells  {tetrahedra:8} tetrahedra  cut {cut:8.5} s (marching cubes {cubes:8.5} s)  volumes and areas {sums:8.5} s  \
         degree {MASS_DEGREE}: {:6.1} us a cell  difference from the surface: volume {:.1e} area {:.1e}",
        cells.len(),
        quadrature / (cells.len() as f64 / 16.0) * 1e6,
        (volume - signed_volume(&mesh)).abs() / volume,
        (surface - area(&mesh)).abs() / surface
    );
    [cells.len() as f64, cut]
}

fn main() {
    // `cargo bench` passes flags of its own; a bare number is the largest size.
    let largest = std::env::args().skip(1).find_map(|word| word.parse().ok()).unwrap_or(256);
    println!("{} threads", rayon::current_num_threads());
    let rows: Vec<[f64; 2]> = [32, 64, 128, 256].into_iter().filter(|&n| n <= largest).map(measure).collect();
    for pair in rows.windows(2) {
        let exponent = (pair[1][1] / pair[0][1]).ln() / (pair[1][0] / pair[0][0]).ln();
        println!("from {} to {} cells: growth exponent of cutting {exponent:.2}", pair[0][0], pair[1][0]);
    }
}
