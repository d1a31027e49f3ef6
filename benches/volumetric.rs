//! Benchmark: volumetric meshes of surfaces that overlap, against the figures of Table 3.1 of \[Gagniere22\]; a ladder of sizes with the exponent of
//! growth, memory, time per stage, and one thread beside all.
//!
//! ```text
//! cargo bench -p welter-benches --bench volumetric [-- HEXAHEDRA]
//! cargo bench -p welter-benches --bench volumetric --features stats -- 0
//! ```
//! The second also tells of each stage how many predicates it asks, and the share that the filter in floating point does not settle.
//! `HEXAHEDRA` is the largest mesh of the ladder, in millions. The times of the chapter were taken on an Intel Core i9-10980XE at 3 GHz. Times are the best of some runs and hold
//! everything from the surface to the mesh; the check (`verify`) stands beside them.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::time::Instant;

use welter_benches::{best, memory};
use welter_meshing::shapes::{BoxPair, Sphere, sphere, two_boxes};
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh};
use welter_meshing::volumetric::{Resolution, VolumeMesh, VolumeParameters, mesh_volume, verify};
use welter_meshing::{DVec3, Monitor, Progress};

/// What a run is compared with.
struct Case {
    name: &'static str,
    surface: ClosedOrientedMesh,
    /// Cells along the shortest side.
    cells: u32,
    runs: usize,
}

fn parameters(cells: u32) -> VolumeParameters {
    VolumeParameters {
        resolution: Resolution::ShortestSide(cells),
        max_refinements: 0,
        ..VolumeParameters::default()
    }
}

fn volume_of(surface: &ClosedOrientedMesh, cells: u32, monitor: &Monitor<'_>) -> VolumeMesh {
    mesh_volume(surface, &parameters(cells), monitor).expect("the surface bounds a volume")
}

/// Two bumpy balls of about 7,000 triangles each that overlap by more than half.
fn twin() -> ClosedOrientedMesh {
    let ball = sphere(&Sphere { edge_length: 0.0722, ..Sphere::default() }).expect("valid parameters");
    let mut soup = ball.to_soup();
    for p in &mut soup.positions {
        let waves = (9.0 * p.x).sin() * (8.0 * p.y).sin() * (7.0 * p.z).sin();
        *p *= 1.0 + 0.15 * waves;
    }
    let (points, count) = (soup.positions.clone(), soup.positions.len() as u32);
    soup.positions.extend(points.into_iter().map(|p| p + DVec3::new(0.31, 0.23, 0.17)));
    let triangles = soup.triangles.clone();
    soup.triangles.extend(triangles.into_iter().map(|t| t.map(|v| v + count)));
    soup.groups.clear();
    ClosedOrientedMesh::new(TriMesh::new(soup).expect("a mesh")).expect("closed")
}

/// Predicates that have been asked, and those of them that the filter did not settle.
#[cfg(feature = "stats")]
fn asked() -> [u64; 2] {
    use welter_predicates::{Stage, stats};
    let counts = stats::snapshot();
    let sum = |wanted: fn(Stage) -> bool| -> u64 {
        let stages = || Stage::ALL.into_iter().filter(|&stage| wanted(stage));
        stats::Kind::ALL
            .iter()
            .flat_map(|&kind| stages().map(move |stage| (kind, stage)))
            .map(|(kind, stage)| counts.get(kind, stage))
            .sum()
    };
    [sum(|_| true), sum(|stage| stage != Stage::Filter)]
}

#[cfg(not(feature = "stats"))]
fn asked() -> [u64; 2] {
    [0; 2]
}

/// What a stage took: its name, seconds, predicates asked and those of them that the filter did not settle.
type StageCost = (&'static str, f64, [u64; 2]);

/// The costs of all stages, in the order in which they began. One that goes on while another has begun counts with that.
fn stages(surface: &ClosedOrientedMesh, cells: u32) -> Vec<StageCost> {
    let seen: Mutex<Vec<(&'static str, Instant, [u64; 2])>> = Mutex::new(Vec::new());
    let report = |progress: Progress| {
        let mut seen = seen.lock().expect("no thread panicked");
        if seen.last().is_none_or(|&(stage, ..)| stage != progress.stage) {
            seen.push((progress.stage, Instant::now(), asked()));
        }
    };
    drop(volume_of(surface, cells, &Monitor::new(Some(&report), None)));
    let end = (Instant::now(), asked());
    let seen = seen.into_inner().expect("no thread panicked");
    let ends = seen.iter().skip(1).map(|&(_, at, asked)| (at, asked)).chain([end]);
    let mut sums: BTreeMap<usize, StageCost> = BTreeMap::new();
    for ((stage, begin, before), (end, after)) in seen.iter().zip(ends) {
        let place = seen.iter().position(|(name, ..)| name == stage).unwrap_or(0);
        let sum = sums.entry(place).or_insert((stage, 0.0, [0; 2]));
        sum.1 += (end - *begin).as_secs_f64();
        sum.2 = [0, 1].map(|n| sum.2[n] + after[n] - before[n]);
    }
    sums.into_values().collect()
}

fn on_one_thread<T: Send>(f: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread").install(f)
}

fn report(case: &Case) -> (f64, f64) {
    let before = memory("VmRSS:");
    let (seconds, volume) = best(case.runs, || volume_of(&case.surface, case.cells, &Monitor::none()));
    let hexahedra = volume.mesh.len() as f64;
    let (check, verification) =
        best(1, || verify(&case.surface, &volume, &Monitor::none()).expect("nobody cancels"));
    let [nx, ny, nz] = volume.mesh.grid().cells();
    println!(
        "{:18} {nx:4}x{ny:4}x{nz:4} {hexahedra:9.0} hexahedra {seconds:8.3} s  {:6.1} ns each  check {check:7.3} s {}",
        case.name,
        1e9 * seconds / hexahedra,
        if verification.passed() { "passed" } else { "FAILED" },
    );
    if let (Some(before), Some(peak)) = (before, memory("VmHWM:")) {
        println!("{:18} peak so far {:.0} MB, {:.0} MB before", "", peak / 1e6, before / 1e6);
    }
    (hexahedra, seconds)
}

fn main() {
    let most: f64 = std::env::args().skip(1).find_map(|argument| argument.parse().ok()).unwrap_or(20.0);
    let boxes = || two_boxes(&BoxPair::overlapping()).expect("valid parameters");
    println!(
        "[Gagniere22]: two boxes 2.80 s (256,368), twin bunnies 31.2 s (1,525,821), dragon 303 s (20 million)"
    );
    report(&Case { name: "two boxes", surface: boxes(), cells: 64, runs: 9 });
    let case = Case { name: "twin", surface: twin(), cells: 118, runs: 5 };
    let (_, two) = report(&case);
    let (one, _) = on_one_thread(|| best(3, || volume_of(&case.surface, case.cells, &Monitor::none())));
    println!("{:18} on one thread {one:.3} s: {:.2} times", "", one / two);
    for (stage, seconds, [all, beyond]) in stages(&case.surface, case.cells) {
        print!("{:18} {stage:30} {seconds:8.4} s", "");
        if all > 0 {
            let share = 100.0 * beyond as f64 / all as f64;
            print!("{all:10} predicates, {share:.4} % not settled by the filter");
        }
        println!();
    }
    let mut last: Option<(f64, f64)> = None;
    for cells in [32, 64, 128, 256, 300, 440] {
        let expected = (f64::from(cells) / 118.0).powi(3) * 1.26e6;
        if expected > most * 1e6 {
            break;
        }
        let now =
            report(&Case { name: "twin", surface: twin(), cells, runs: if expected > 4e6 { 1 } else { 3 } });
        if let Some((hexahedra, seconds)) = last {
            println!("{:18} exponent {:.2}", "", (now.1 / seconds).ln() / (now.0 / hexahedra).ln());
        }
        last = Some(now);
    }
}
