//! Benchmark: smoke as a surface and as marker particles of as many bytes, of 4, 16 and 64 times as many; how long they take and how far
//! their pictures are from those of very dense ones \[Brochu12, section 5.5\].
//!
//! ```text
//! cargo bench -p welter-benches --bench smoke_storage [-- TRIANGLES] [--particles=N] [--pictures=DIRECTORY]
//! ```
//! TRIANGLES is about how many the surface ends with (default 25000). N is how many particles a dense cloud has, as a second opinion
//! beside the reference; by default the cloud of 64 times the bytes is it. Pictures are written, as portable graymaps of the composite,
//! if a directory is given.
//!
//! Bytes are those of the least that a frame has to store: positions as three numbers of 8 bytes, an age of 8 bytes for each vertex or
//! particle, and three vertex numbers of 4 bytes for each triangle. Particles fill the balls of the dense reference, so they do not
//! suffer from the coarse ones of the surface. Their radius is the best of several for each number of them, by the composite: what a
//! user would find by trial. The reference is a surface with edges of a third of the length.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

mod difference;
mod plume;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use difference::{Difference, differences};
use plume::{BACKGROUND, FRAMES, STEP};
use welter_fluids::marker_particles::{MarkerParameters, MarkerSimulation, MarkerState};
use welter_fluids::smoke::{SmokeParameters, SmokeSimulation};
use welter_fluids::volume_rendering::{ParticleScene, Picture, Scene, render, render_particles};
use welter_meshing::Monitor;
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh};

/// Edges with which the surface ends at about 25,000 triangles.
const EDGE: f64 = 0.0334;

/// Radii of particles that are tried, in units of the cube root of their volume.
const RADII: [f64; 4] = [1.0, 1.4, 2.0, 2.8];

/// Extinctions: thin and thick smoke, of optical depths of 1 and 5 through a puff.
const EXTINCTIONS: [f64; 2] = [2.0, 10.0];

/// A run, at its end.
struct Run {
    name: String,
    last: Last,
    bytes: usize,
    bytes_of_frames: usize,
    seconds: f64,
}

/// What a run ends with.
enum Last {
    Surface { mesh: ClosedOrientedMesh, ages: Vec<f64> },
    Particles { state: MarkerState, volume: f64 },
}

fn surface_bytes(mesh: &TriMesh) -> usize {
    mesh.positions().len() * (3 * 8 + 8) + mesh.triangles().len() * 3 * 4
}

fn surface(name: &str, edge_length: f64) -> Run {
    let (start, flow) = (Instant::now(), plume::flow());
    let parameters = SmokeParameters { most_triangles: 10_000_000, ..SmokeParameters::default() };
    let emissions = plume::emissions(edge_length);
    let mut smoke = SmokeSimulation::new(emissions, parameters, &Monitor::none()).expect("a run");
    let mut bytes_of_frames = surface_bytes(&smoke.mesh());
    for frame in 1..=FRAMES {
        let step = smoke.step_to(&flow, f64::from(frame) * STEP, &Monitor::none()).expect("a step");
        assert!(step.releases.iter().all(|release| release.refusal.is_none()), "all is released");
        bytes_of_frames += surface_bytes(&smoke.mesh());
    }
    let seconds = start.elapsed().as_secs_f64();
    let mesh = smoke.mesh();
    let bytes = surface_bytes(&mesh);
    let name = format!("{name}, {} triangles", mesh.triangles().len());
    let mesh = ClosedOrientedMesh::new(mesh).expect("closed balls stay closed");
    Run { name, last: Last::Surface { mesh, ages: smoke.ages().to_vec() }, bytes, bytes_of_frames, seconds }
}

fn particles(name: &str, count: usize) -> Run {
    let (start, flow, emissions) = (Instant::now(), plume::flow(), plume::emissions(EDGE / 3.0));
    let end = f64::from(FRAMES) * STEP;
    let parameters = MarkerParameters::within(&emissions, count, end).expect("smoke is released");
    let mut smoke = MarkerSimulation::new(emissions, parameters, &Monitor::none()).expect("a run");
    let mut bytes_of_frames = smoke.state().bytes();
    for frame in 1..=FRAMES {
        let step = smoke.step_to(&flow, f64::from(frame) * STEP, &Monitor::none()).expect("a step");
        bytes_of_frames += step.particles * MarkerState::BYTES_PER_PARTICLE;
    }
    let seconds = start.elapsed().as_secs_f64();
    let name = format!("{name}, {} particles", smoke.state().positions.len());
    let last = Last::Particles { state: smoke.state().clone(), volume: smoke.particle_volume() };
    Run { name, last, bytes: smoke.state().bytes(), bytes_of_frames, seconds }
}

/// The picture of a run at its end, and the seconds that it took. The radius is that of particles.
fn picture(last: &Last, extinction: f64, radius_rel: f64) -> (Picture, f64) {
    let (camera, light, medium) = (plume::camera(), plume::light(), plume::medium(extinction));
    match last {
        Last::Surface { mesh, ages } => {
            let background = BACKGROUND;
            let scene = Scene { smoke: mesh, ages, solids: &[], camera, light, medium, background };
            let (picture, report) =
                render(&scene, &plume::parameters(), &Monitor::none()).expect("a picture");
            (picture, report.seconds.total)
        }
        Last::Particles { state, volume } => {
            let scene = ParticleScene {
                positions: &state.positions,
                ages: &state.ages,
                particle_volume: *volume,
                radius_rel,
                camera,
                light,
                medium,
                background: BACKGROUND,
            };
            let (picture, report) =
                render_particles(&scene, &plume::parameters(), &Monitor::none()).expect("a picture");
            (picture, report.seconds.total)
        }
    }
}

/// The picture that is nearest to the reference, its radius, seconds and differences.
fn best(run: &Run, extinction: f64, reference: &Picture) -> (Picture, f64, f64, [Difference; 3]) {
    let radii = if matches!(run.last, Last::Surface { .. }) { &[0.0][..] } else { &RADII };
    let drawn = radii.iter().map(|&radius| {
        let (picture, seconds) = picture(&run.last, extinction, radius);
        let difference = differences(&picture, reference);
        (picture, radius, seconds, difference)
    });
    let nearest = drawn.min_by(|a, b| a.3[2].root_mean_square.total_cmp(&b.3[2].root_mean_square));
    nearest.expect("a radius")
}

/// Writes the composite as a graymap, white at radiance 1/2.
fn write(picture: &Picture, directory: &Path, name: &str) -> std::io::Result<()> {
    let plane = &picture.composite;
    let mut file = std::fs::File::create(directory.join(format!("{name}.pgm")))?;
    writeln!(file, "P5 {} {} 255", plane.width(), plane.height())?;
    let byte = |pixel: &[f32; 3]| ((2.0 * pixel[1]).clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0).round() as u8;
    file.write_all(&plane.pixels().iter().map(byte).collect::<Vec<u8>>())
}

/// One line of the table: differences to the reference, and of the composite to the dense cloud.
fn row(run: &Run, radius: f64, seconds: f64, differences: &[Difference; 3], to_cloud: Difference) {
    let radius = if radius > 0.0 { format!("{radius:.1}") } else { String::from("-") };
    let [last, all] = [run.bytes, run.bytes_of_frames].map(|bytes| bytes as f64 / 1e6);
    print!("{:42} {last:>8.3} {all:>8.1} {:>8.1} {seconds:>7.2} {radius:>6} ", run.name, run.seconds);
    for it in differences.iter().chain([&to_cloud]) {
        print!("  {:.4} {:.4}", it.root_mean_square, it.percentile);
    }
    println!();
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let option = |key: &str| words.iter().find_map(|word| word.strip_prefix(key).map(String::from));
    let triangles: f64 = words.iter().find_map(|word| word.parse().ok()).unwrap_or(25_000.0);
    let directory = option("--pictures=").map(PathBuf::from);
    let edge = EDGE * (25_000.0 / triangles).sqrt();

    let coarse = surface("surface", edge);
    let fine = surface("reference: edges of a third", edge / 3.0);
    let equal = coarse.bytes / MarkerState::BYTES_PER_PARTICLE;
    let mut runs = vec![coarse];
    runs.extend([1, 4, 16, 64].map(|factor| particles(&format!("{factor} x the bytes"), factor * equal)));
    let dense = option("--particles=").and_then(|n| n.parse().ok());
    runs.extend(dense.map(|count| particles("dense cloud", count)));
    let cloud = &runs[runs.len() - 1];
    println!(
        "{FRAMES} frames of {STEP}, {} x {} pixels",
        plume::parameters().width,
        plume::parameters().height
    );
    for extinction in EXTINCTIONS {
        let (reference, seconds) = picture(&fine.last, extinction, 0.0);
        if let Some(directory) = &directory {
            write(&reference, directory, &format!("reference-{extinction}")).expect("a writable directory");
        }
        let covered = reference.alpha.pixels().iter().filter(|&&alpha| alpha > 0.0).count();
        println!();
        println!("extinction {extinction}, {covered} pixels covered");
        println!(
            "{:42} {:>8} {:>8} {:>8} {:>7} {:>6}   alpha          scatter        composite      to the cloud",
            "", "MB", "all MB", "carry s", "draw s", "radius"
        );
        let (second, ..) = best(cloud, extinction, &reference);
        let [.., to_cloud] = differences(&reference, &second);
        row(&fine, 0.0, seconds, &[Difference::default(); 3], to_cloud);
        for (index, run) in runs.iter().enumerate() {
            let (picture, radius, seconds, to_reference) = best(run, extinction, &reference);
            let [.., to_cloud] = differences(&picture, &second);
            row(run, radius, seconds, &to_reference, to_cloud);
            if let Some(directory) = &directory {
                write(&picture, directory, &format!("run-{index}-{extinction}"))
                    .expect("a writable directory");
            }
        }
    }
}
