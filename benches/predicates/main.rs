//! Benchmark of the predicates beside `robust` and `geometry-predicates`, on the same inputs in the same run.
//!
//! Prints, for each predicate and class of input, the time of each library, its ratio to `robust` and to the faster
//! peer, the share of the evaluations that each stage settled, and how many signs the peers got wrong.
//!
//! The libraries take turns on chunks of the inputs, and of each chunk and library the shortest time over all rounds
//! counts: on a busy machine that is the time without the interruptions. A round visits all chunks before any
//! is repeated, so that branch predictors do not learn them.
//!
//! `cargo bench -p welter-benches --bench predicates [-- FILTER [--quick]]`

#![expect(clippy::print_stdout, reason = "a benchmark prints its figures")]

mod inputs;

use inputs::{Class, Surface, tuples};
use std::hint::black_box;
use std::time::Instant;
use welter_predicates::{Sign, Stage, staged};

/// Distinct inputs per class: too many for a branch predictor to learn.
const COUNT: usize = 32768;
/// Inputs timed at a time: microseconds, so that most chunks are not interrupted.
const CHUNK: usize = 512;

/// One evaluation.
type Evaluate<const N: usize, const P: usize> = fn(&[[f64; N]; P]) -> Sign;
/// The sum of the signs of many evaluations.
type Pass<const N: usize, const P: usize> = fn(&[[[f64; N]; P]]) -> i64;

struct Family<const N: usize, const P: usize> {
    name: &'static str,
    surface: Surface,
    ours: Pass<N, P>,
    robust: Option<Pass<N, P>>,
    geometry_predicates: Option<Pass<N, P>>,
    staged: fn(&[[f64; N]; P]) -> (Sign, Stage),
    peers: [Option<Evaluate<N, P>>; 2],
}

/// One pass over all inputs, with the predicate inlined.
macro_rules! pass {
    ($evaluate:expr) => {
        |inputs| inputs.iter().map(|points| $evaluate(points) as i64).sum()
    };
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let quick = arguments.iter().any(|a| a == "--quick");
    let filter = arguments.iter().find(|a| !a.starts_with("--")).map_or("", String::as_str);
    println!(
        "{:9} {:18} {:>9} {:>9} {:>9} {:>7} {:>7}   settled by stage, wrong signs of the peers",
        "", "", "ours ns", "robust", "geom-pred", "/robust", "/faster"
    );
    let rounds = if quick { 5 } else { 25 };

    run(
        filter,
        rounds,
        &Family {
            name: "orient2d",
            surface: Surface::Flat,
            ours: pass!(|[a, b, c]: &[[f64; 2]; 3]| welter_predicates::orient2d(a, b, c)),
            robust: Some(pass!(robust_orient2d)),
            geometry_predicates: Some(pass!(geometry_orient2d)),
            staged: |[a, b, c]| staged::orient2d(a, b, c),
            peers: [Some(robust_orient2d), Some(geometry_orient2d)],
        },
    );
    run(
        filter,
        rounds,
        &Family {
            name: "orient3d",
            surface: Surface::Flat,
            ours: pass!(|[a, b, c, d]: &[[f64; 3]; 4]| welter_predicates::orient3d(a, b, c, d)),
            robust: Some(pass!(robust_orient3d)),
            geometry_predicates: Some(pass!(geometry_orient3d)),
            staged: |[a, b, c, d]| staged::orient3d(a, b, c, d),
            peers: [Some(robust_orient3d), Some(geometry_orient3d)],
        },
    );
    run(
        filter,
        rounds,
        &Family {
            name: "orient4d",
            surface: Surface::Flat,
            ours: pass!(|[a, b, c, d, e]: &[[f64; 4]; 5]| welter_predicates::orient4d(a, b, c, d, e)),
            robust: None,
            geometry_predicates: None,
            staged: |[a, b, c, d, e]| staged::orient4d(a, b, c, d, e),
            peers: [None, None],
        },
    );
    run(
        filter,
        rounds,
        &Family {
            name: "incircle",
            surface: Surface::Round,
            ours: pass!(|[a, b, c, d]: &[[f64; 2]; 4]| welter_predicates::incircle(a, b, c, d)),
            robust: Some(pass!(robust_incircle)),
            geometry_predicates: Some(pass!(geometry_incircle)),
            staged: |[a, b, c, d]| staged::incircle(a, b, c, d),
            peers: [Some(robust_incircle), Some(geometry_incircle)],
        },
    );
    run(
        filter,
        rounds,
        &Family {
            name: "insphere",
            surface: Surface::Round,
            ours: pass!(|[a, b, c, d, e]: &[[f64; 3]; 5]| welter_predicates::insphere(a, b, c, d, e)),
            robust: Some(pass!(robust_insphere)),
            geometry_predicates: Some(pass!(geometry_insphere)),
            staged: |[a, b, c, d, e]| staged::insphere(a, b, c, d, e),
            peers: [Some(robust_insphere), Some(geometry_insphere)],
        },
    );
}

macro_rules! robust_peer {
    ($name:ident, $f:ident, $n:literal, $p:literal, $coord:expr, $($i:literal)*) => {
        #[inline(always)]
        fn $name(p: &[[f64; $n]; $p]) -> Sign {
            Sign::of(robust::$f($($coord(p[$i])),*))
        }
    };
}

#[inline(always)]
fn coord2(p: [f64; 2]) -> robust::Coord<f64> {
    robust::Coord { x: p[0], y: p[1] }
}

#[inline(always)]
fn coord3(p: [f64; 3]) -> robust::Coord3D<f64> {
    robust::Coord3D { x: p[0], y: p[1], z: p[2] }
}

robust_peer!(robust_orient2d, orient2d, 2, 3, coord2, 0 1 2);
robust_peer!(robust_orient3d, orient3d, 3, 4, coord3, 0 1 2 3);
robust_peer!(robust_incircle, incircle, 2, 4, coord2, 0 1 2 3);
robust_peer!(robust_insphere, insphere, 3, 5, coord3, 0 1 2 3 4);

macro_rules! geometry_peer {
    ($name:ident, $f:ident, $n:literal, $p:literal, $($i:literal)*) => {
        #[inline(always)]
        fn $name(p: &[[f64; $n]; $p]) -> Sign {
            Sign::of(geometry_predicates::$f($(p[$i]),*))
        }
    };
}

geometry_peer!(geometry_orient2d, orient2d, 2, 3, 0 1 2);
geometry_peer!(geometry_orient3d, orient3d, 3, 4, 0 1 2 3);
geometry_peer!(geometry_incircle, incircle, 2, 4, 0 1 2 3);
geometry_peer!(geometry_insphere, insphere, 3, 5, 0 1 2 3 4);

fn run<const N: usize, const P: usize>(filter: &str, rounds: usize, family: &Family<N, P>) {
    for class in Class::ALL {
        let label = format!("{} {}", family.name, class.name());
        if !label.contains(filter) {
            continue;
        }
        let inputs = tuples::<N, P>(class, family.surface, COUNT);
        // Slow classes need fewer inputs to last long enough.
        let timed = if matches!(class, Class::Mixed { .. } | Class::DegenerateMixed { .. }) {
            &inputs[..COUNT / 8]
        } else {
            &inputs[..]
        };
        let passes = [Some(family.ours), family.robust, family.geometry_predicates];
        let mut times =
            passes.map(|pass| pass.map_or(Vec::new(), |_| vec![f64::INFINITY; timed.len().div_ceil(CHUNK)]));
        for _ in 0..rounds {
            for (i, chunk) in timed.chunks(CHUNK).enumerate() {
                for (pass, times) in passes.iter().zip(&mut times) {
                    if let Some(pass) = pass {
                        times[i] = times[i].min(time(*pass, chunk));
                    }
                }
            }
        }
        let times = times.map(|t| t.iter().sum::<f64>() / timed.len() as f64);
        report(family, class, &inputs, &times);
    }
}

/// Nanoseconds of one pass.
fn time<const N: usize, const P: usize>(pass: Pass<N, P>, inputs: &[[[f64; N]; P]]) -> f64 {
    let start = Instant::now();
    black_box(pass(black_box(inputs)));
    start.elapsed().as_nanos() as f64
}

fn report<const N: usize, const P: usize>(
    family: &Family<N, P>,
    class: Class,
    inputs: &[[[f64; N]; P]],
    [ours, robust, geometry]: &[f64; 3],
) {
    let results: Vec<(Sign, Stage)> = inputs.iter().map(family.staged).collect();
    let stages: Vec<String> = Stage::ALL
        .iter()
        .filter_map(|&stage| {
            let hits = results.iter().filter(|r| r.1 == stage).count();
            (hits > 0).then(|| format!("{stage:?} {:.2}%", 100.0 * hits as f64 / inputs.len() as f64))
        })
        .collect();
    let wrong = family.peers.map(|peer| {
        peer.map(|peer| inputs.iter().zip(&results).filter(|(points, r)| peer(points) != r.0).count())
    });
    let wrong = match wrong {
        [Some(0), Some(0)] | [None, _] | [_, None] => String::new(),
        [Some(r), Some(g)] => format!("; wrong of {}: robust {r}, geometry-predicates {g}", inputs.len()),
    };
    let figure = |x: f64, digits: usize| {
        if x > 0.0 && x.is_finite() { format!("{x:.digits$}") } else { "-".to_string() }
    };
    println!(
        "{:9} {:18} {:>9} {:>9} {:>9} {:>7} {:>7}   {}{wrong}",
        family.name,
        class.name(),
        figure(*ours, 1),
        figure(*robust, 1),
        figure(*geometry, 1),
        figure(ours / robust, 3),
        figure(ours / robust.min(*geometry), 3),
        stages.join(" "),
    );
}
