//! Benchmark: steps of the surface tracker on the Enright test, over sizes, by phases.
//!
//! ```text
//! cargo bench -p welter-benches --bench tracker [-- LARGEST [THREADS]]
//! ```
//! LARGEST bounds the triangles of the ladder at the beginning (default 400000), THREADS the pool (default 1).
//!
//! A ball of the Enright test \[Brochu12, section 3.3.3\], carried along to the time 0.75, where the field is at its strongest, and
//! remeshed; the time step is one edge length of 0.01 long at edges of 0.01, and in proportion to the edges at other
//! sizes, so that all surfaces are stretched and remeshed alike. Microseconds a triangle and step, of 24 steps after 8 that are not
//! counted: remeshing and smoothing, topology, the flow by Runge and Kutta, collision detection of everything, numbering anew,
//! the exact static check, all. Once with topology changes switched off as in \[Brochu12\], once with them. `coll` holds
//! what the trees of the broad phase take. The last columns are the triangles at the end and operations a step. Exponents are
//! of the time of a phase over the sizes.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::VertexId;
use welter_tracking::flows::fields::Enright;
use welter_tracking::flows::{Advection, Flow, Scheme};
use welter_tracking::surface::MovingSurface;
use welter_tracking::tracker::{PhaseSeconds, SurfaceTracker, TrackerParameters};

/// When the steps begin, and in how many the ball is carried there.
const BEGIN: f64 = 0.75;
const STEPS_BEFORE: u32 = 75;
const UNCOUNTED: usize = 8;
const COUNTED: usize = 24;
const PHASES: [&str; 7] = ["improve", "topology", "velocity", "coll", "compact", "check", "total"];

fn phases(s: &PhaseSeconds) -> [f64; 7] {
    [s.improvement, s.topology, s.velocity, s.collisions, s.compaction, s.check, s.total]
}

/// Microseconds a triangle and step by phase, the mean number of triangles, that at the end, and operations a step.
fn measure(edge_length: f64, topology: bool) -> ([f64; 7], f64, usize, f64) {
    let ball = Sphere { radius: 0.15, center: DVec3::splat(0.35), edge_length };
    let mut surface = MovingSurface::new(&sphere(&ball).expect("a sphere")).expect("admissible");
    let flow = Advection { field: Enright::default(), scheme: Scheme::Rk4 };
    for step in 0..STEPS_BEFORE {
        let dt = BEGIN / f64::from(STEPS_BEFORE);
        let moved = flow.advance(&surface, f64::from(step) * dt, dt).expect("the field is smooth");
        for (v, end) in (0..).map(VertexId).zip(moved.ends) {
            surface.set_position(v, end).expect("finite");
        }
    }
    let mut parameters = TrackerParameters::default();
    parameters.topology.enabled = topology;
    let length = edge_length * 0.9;
    let mut tracker = SurfaceTracker::resume(surface, parameters, length, BEGIN, 0).expect("embedded");
    let (mut sum, mut triangles, mut operations) = (PhaseSeconds::default(), 0, 0);
    for step in 0..UNCOUNTED + COUNTED {
        let report = tracker.step(&flow, edge_length, &Monitor::none()).expect("the field is smooth");
        if step >= UNCOUNTED {
            sum.add(&report.seconds);
            triangles += tracker.surface().connectivity().triangle_count();
            let done = report.improvement;
            operations += done.splits + done.flips + done.collapses;
        }
    }
    let per = |seconds: f64| 1e6 * seconds / triangles as f64;
    let last = tracker.surface().connectivity().triangle_count();
    let steps = COUNTED as f64;
    (phases(&sum).map(per), triangles as f64 / steps, last, operations as f64 / steps)
}

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|a| !a.starts_with("--"));
    let mut number = |default: usize| arguments.next().map_or(default, |a| a.parse().expect("a number"));
    let (largest, threads) = (number(400_000), number(1));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| {
        for topology in [false, true] {
            println!("{threads} threads, topology changes {}", if topology { "on" } else { "off" });
            println!("triangles {}      last  changes", PHASES.map(|p| format!("{p:>8}")).join(" "));
            let mut rows: Vec<(f64, [f64; 7])> = Vec::new();
            for target in [3_750.0, 7_000.0, 15_600.0, 62_500.0, 250_000.0] {
                // The ball is stretched to 1.6 times its area.
                if 1.6 * target > largest as f64 {
                    break;
                }
                // Equilateral triangles of edge L on a sphere of radius 0.15.
                let edge_length = 0.15 * (16.0 * std::f64::consts::PI / (3.0_f64.sqrt() * target)).sqrt();
                let (times, mean, last, changes) = measure(edge_length, topology);
                println!(
                    "{mean:>9.0} {} {last:>9} {changes:>8.0}",
                    times.map(|t| format!("{t:>8.3}")).join(" ")
                );
                rows.push((mean, times));
            }
            if let (Some((n, first)), Some((m, last))) = (rows.first(), rows.last())
                && rows.len() > 1
            {
                let exponent = |k: usize| 1.0 + (last[k] / first[k]).ln() / (m / n).ln();
                let of = |k| {
                    if first[k] > 0.0 && last[k] > 0.0 {
                        format!("{:>8.3}", exponent(k))
                    } else {
                        format!("{:>8}", "-")
                    }
                };
                println!(" exponent {}", std::array::from_fn::<String, 7, _>(of).join(" "));
            }
        }
    });
}
