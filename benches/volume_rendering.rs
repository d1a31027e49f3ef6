//! Benchmark: the volume renderer at the size of the figure of \[Brochu12, section 6.7\], 126,000 triangles
//! at 1600 x 1200 pixels with a shadow texture of 167 x 125 x 82 voxels, by stages.
//!
//! ```text
//! cargo bench -p welter-benches --bench volume_rendering [-- THREADS]
//! ```
//! THREADS sizes the pool (default 2). The smoke is of seven lumpy balls that overlap, seen from the side,
//! with ages and a blur by them; once thin, so that rays are sampled all through, once dense. Times are of
//! the run with the least total of [`RUNS`].

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

use glam::DVec3;
use welter_fluids::volume_rendering::{
    AgeBlur, Camera, Light, Medium, RenderParameters, RenderReport, Scene, render,
};
use welter_meshing::Monitor;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};

/// Runs of each measurement.
const RUNS: usize = 7;

/// Sides of the smoke, in proportion to those of the texture, with the light along the last.
const SIDES: DVec3 = DVec3::new(1.25, 1.67, 0.82);

/// Seven balls of 18,000 triangles each, with lumps, in a box of the given sides.
fn plume() -> ClosedOrientedMesh {
    let mut all = TriangleSoup::default();
    for k in 0..7 {
        let t = f64::from(k) / 6.0;
        let turn = 2.4 * f64::from(k);
        let center = DVec3::new(0.35 * turn.cos(), 2.0 * t, 0.35 * turn.sin());
        let ball = sphere(&Sphere { radius: 1.0, edge_length: 0.0437, ..Sphere::default() }).expect("a ball");
        let base = all.positions.len() as u32;
        let lump = |p: &DVec3| {
            let wave = (9.0 * p.x + turn).sin() * (8.0 * p.y).sin() * (7.0 * p.z - turn).sin();
            center + (0.35 + 0.25 * t) * (1.0 + 0.15 * wave) * *p
        };
        all.positions.extend(ball.positions().iter().map(lump));
        all.triangles.extend(ball.triangles().iter().map(|t| t.map(|v| v.0 + base)));
    }
    let low = all.positions.iter().fold(DVec3::INFINITY, |low, &p| low.min(p));
    let high = all.positions.iter().fold(DVec3::NEG_INFINITY, |high, &p| high.max(p));
    for p in &mut all.positions {
        *p = (*p - low) / (high - low) * SIDES - 0.5 * SIDES;
    }
    ClosedOrientedMesh::new(TriMesh::new(all).expect("numbers")).expect("balls are closed")
}

fn main() {
    let threads = std::env::args().skip(1).find_map(|word| word.parse().ok()).unwrap_or(2);
    let smoke = plume();
    let ages: Vec<f64> = smoke.positions().iter().map(|p| p.y + 0.5 * SIDES.y).collect();
    let scene = |extinction: f64| Scene {
        smoke: &smoke,
        ages: &ages,
        solids: &[],
        camera: Camera::toward(DVec3::new(-1.5, 0.4, 1.3), DVec3::ZERO),
        light: Light { direction: DVec3::NEG_Z, ..Light::default() },
        medium: Medium::white(extinction),
        background: [0.0; 3],
    };
    let parameters = RenderParameters {
        width: 1600,
        height: 1200,
        shadow_resolution: 167,
        age_blur: Some(AgeBlur::new(0.004)),
        ..RenderParameters::default()
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    println!("{threads} threads, {} triangles, 1600 x 1200 pixels", smoke.triangles().len());
    pool.install(|| {
        for extinction in [4.0, 20.0] {
            let run = || render(&scene(extinction), &parameters, &Monitor::none()).expect("a picture").1;
            let reports: Vec<RenderReport> = (0..RUNS).map(|_| run()).collect();
            let best = reports.iter().min_by(|a, b| a.seconds.total.total_cmp(&b.seconds.total));
            let best = best.expect("several runs");
            let s = best.seconds;
            println!(
                "extinction {extinction:4}: {:?} voxels, {} crossings, {:.0} % of the pixels covered\n  shadow {:.3} s  projection {:.3} s  pixels {:.3} s  \
                 blur and composite {:.3} s  total {:.3} s",
                best.shadow_size,
                best.crossings,
                best.covered_pixels as f64 / (1600.0 * 1200.0) * 100.0,
                s.shadow,
                s.projection,
                s.pixels,
                s.composition,
                s.total
            );
        }
    });
}
