//! Benchmark: integration of the surface tracker, without contact over sizes, and in contact against a cubic solver.
//!
//! ```text
//! cargo bench -p welter-benches --bench integration [-- LARGEST [THREADS]]
//! ```
//! LARGEST bounds the triangles (default 100000), THREADS the pool (default 1). Times are the best of five.
//!
//! *Without contact*, of a sphere whose vertices move by up to a tenth of the edge length along each axis: microseconds a
//! triangle of `resolve` (with and without the check of the start) and `accept`, and of their parts: refreshment of the boxes
//! for the motion, the continuous collision detection of everything, the static check.
//!
//! *In contact*, of sheets that are pressed onto each other or slide along each other: three sweeps of impulses over all pairs
//! and the static check, in milliseconds; once with the exact predicates, which also give time and normal, once with
//! [`cubic`], which finds roots of the cubic of coplanarity and accepts contacts within a tolerance. Everything but the
//! test of a pair is the same. The last column is `resolve` and `accept` of the library.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

mod cubic;
mod narrow;
mod scenes;

use glam::DVec3;
use narrow::{Cubic, Exact, sweeps};
use welter_benches::best;
use welter_meshing::Monitor;
use welter_meshing::spatial::meet_in_more;
use welter_predicates::ccd;
use welter_tracking::broad_phase::{BroadPhase, Motion};
use welter_tracking::integration::{IntegrationParameters, IntegrationReport, accept, resolve};
use welter_tracking::surface::MovingSurface;

const RUNS: usize = 5;

fn without_contact(largest: usize) {
    println!("without contact, microseconds a triangle");
    println!("triangles  resolve  no start   accept  refresh      ccd   static  collisions");
    for target in [6_000.0, 25_000.0, 100_000.0] {
        let (surface, length, ends) = scenes::sphere_in_motion(target);
        let n = surface.connectivity().triangle_count();
        if n > largest {
            break;
        }
        let mut broad_phase = BroadPhase::new(&surface, Motion::Rest).expect("finite");
        let nobody = Monitor::none();
        let resolved = |check_start: bool, broad_phase: &mut BroadPhase| {
            let parameters = IntegrationParameters { check_start, ..Default::default() };
            best(RUNS, || {
                broad_phase.refresh(&surface, Motion::Rest).expect("finite");
                let clock = std::time::Instant::now();
                let resolved = resolve(&surface, broad_phase, ends.clone(), length, &parameters, &nobody);
                (clock.elapsed().as_secs_f64(), resolved.expect("embedded").report.collisions)
            })
            .1
        };
        let [(whole, collisions), (no_start, _)] =
            [true, false].map(|start| resolved(start, &mut broad_phase));
        let acceptance = (0..RUNS).map(|_| {
            let (mut surface, mut broad_phase) = (surface.clone(), broad_phase.clone());
            best(1, || accept(&mut surface, &mut broad_phase, &ends, &nobody).expect("embedded")).0
        });
        let acceptance = acceptance.fold(f64::INFINITY, f64::min);
        let refresh = best(RUNS, || broad_phase.refresh(&surface, Motion::To(&ends)).expect("finite")).0;
        let (detection, _) = best(RUNS, || detect(&surface, &broad_phase, &ends));
        broad_phase.refresh(&surface, Motion::At(&ends)).expect("finite");
        let (check, _) = best(RUNS, || static_check(&surface, &broad_phase, &ends));
        let times = [whole, no_start, acceptance, refresh, detection, check];
        println!("{n:9} {} {collisions:?}", times.map(|t| format!("{:9.3}", 1e6 * t / n as f64)).concat());
    }
}

fn detect(surface: &MovingSurface, broad_phase: &BroadPhase, ends: &[DVec3]) -> usize {
    let mesh = surface.connectivity();
    let vertex_triangle = broad_phase.vertex_triangle_pairs_that(mesh, 0.0, |v, t| {
        let [a, b, c] = mesh.corners(t);
        let four = [v, a, b, c];
        ccd::vertex_face(four.map(|v| surface.position(v)), four.map(|v| ends[v.index()]))
    });
    let edge_edge = broad_phase.edge_edge_pairs_that(mesh, 0.0, |e, f| {
        let ([a, b], [c, d]) = (mesh.ends(e), mesh.ends(f));
        let four = [a, b, c, d];
        ccd::edge_edge(four.map(|v| surface.position(v)), four.map(|v| ends[v.index()]))
    });
    vertex_triangle.expect("zero").len() + edge_edge.expect("zero").len()
}

fn static_check(surface: &MovingSurface, broad_phase: &BroadPhase, places: &[DVec3]) -> usize {
    let mesh = surface.connectivity();
    let meet = |s, t| meet_in_more(|v| places[v.index()], mesh.corners(s), mesh.corners(t));
    broad_phase.triangle_pairs_that(0.0, meet).expect("zero").len()
}

fn in_contact(largest: usize) {
    println!("in contact, milliseconds; pairs that touched in the first sweep, impulses of all");
    println!(
        "scene                triangles     exact     cubic  ratio   library  exact hits, impulses; cubic hits, impulses"
    );
    for scene in
        scenes::contacts().into_iter().filter(|s| s.surface.connectivity().triangle_count() <= largest)
    {
        let scenes::Contacts { name, surface, ends, length } = scene;
        let mut broad_phase = BroadPhase::new(&surface, Motion::Rest).expect("finite");
        // In turns, so that both see the same load of the machine.
        let mut times = [f64::INFINITY; 3];
        let mut found = [[0; 2]; 2];
        for _ in 0..RUNS {
            let exact = best(1, || sweeps(&surface, &mut broad_phase, &ends, &Exact));
            let cubic = best(1, || sweeps(&surface, &mut broad_phase, &ends, &Cubic::of(length)));
            found = [exact.1, cubic.1];
            broad_phase.refresh(&surface, Motion::Rest).expect("finite");
            let library = library(&surface, &broad_phase, &ends, length);
            for (time, new) in times.iter_mut().zip([exact.0, cubic.0, library]) {
                *time = time.min(new);
            }
        }
        let report = report(&surface, &broad_phase, &ends, length);
        let n = surface.connectivity().triangle_count();
        let [exact, cubic, library] = times.map(|t| 1e3 * t);
        println!("{name:20} {n:9} {exact:9.2} {cubic:9.2} {:6.2} {library:9.2}  {found:?}", exact / cubic);
        println!("    {report:?}");
    }
}

/// What the library needed.
fn report(
    surface: &MovingSurface,
    broad_phase: &BroadPhase,
    ends: &[DVec3],
    length: f64,
) -> IntegrationReport {
    let parameters = IntegrationParameters { check_start: false, ..Default::default() };
    resolve(surface, &mut broad_phase.clone(), ends.to_vec(), length, &parameters, &Monitor::none())
        .expect("embedded")
        .report
}

/// Seconds of a whole step.
fn library(surface: &MovingSurface, broad_phase: &BroadPhase, ends: &[DVec3], length: f64) -> f64 {
    let (mut surface, mut broad_phase) = (surface.clone(), broad_phase.clone());
    let parameters = IntegrationParameters { check_start: false, ..Default::default() };
    let nobody = Monitor::none();
    best(1, || {
        let resolved = resolve(&surface, &mut broad_phase, ends.to_vec(), length, &parameters, &nobody)
            .expect("embedded");
        accept(&mut surface, &mut broad_phase, &resolved.ends, &nobody).expect("resolved");
    })
    .0
}

fn main() {
    // `cargo bench` passes flags of its own; bare numbers are the largest size and the number of threads.
    let mut numbers = std::env::args().skip(1).filter_map(|word| word.parse().ok());
    let largest = numbers.next().unwrap_or(150_000);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(numbers.next().unwrap_or(1)).build();
    pool.expect("threads").install(|| {
        without_contact(largest);
        in_contact(largest);
    });
}
