//! Benchmark of continuous collision queries: the public sets with known answers, beside one `robust::orient3d` in the same run.
//!
//! ```text
//! cargo bench -p welter-benches --bench ccd [--features simd] [-- DIRECTORY] [--quick]
//! ```
//! `DIRECTORY` holds `SET/vertex-face/*.csv` and `SET/edge-edge/*.csv`; it is `../shared/data/ccd-queries` beside the repository
//! unless given. Without it the generated inputs alone are measured, and the report says so.
//!
//! Prints, by set: the mean time of a query over whole passes, its ratio to `robust::orient3d` on uniform input, the worst single query
//! (shortest of several runs of each, one reading of the clock included), wrong answers, and how many queries each stage
//! settled; the means over all sets without [`DEGENERATE_SETS`]; culled queries one by one and in batches; crossing
//! parity and space-time simplices on the same queries; and generated inputs from uniform to degenerate.
//!
//! Of repeated measurements the shortest counts: on a busy machine that is the time without the interruptions.

#![expect(clippy::print_stdout, reason = "a benchmark prints its figures")]

mod culling;
mod generated;
mod public;

use std::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;
use welter_predicates::ccd::{Stage, parity, spacetime, staged};

/// The places of four points at the beginning and at the end of a step.
pub(crate) type Step = [[[f64; 3]; 4]; 2];

/// Sets made of the cases that a query can hardly see in a simulation: left out of the overall mean.
const DEGENERATE_SETS: [&str; 2] = ["cliff-edges", "unit-tests"];

/// A vertex and a face, or two edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    VertexFace,
    EdgeEdge,
}

impl Kind {
    pub(crate) const ALL: [Self; 2] = [Self::VertexFace, Self::EdgeEdge];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::VertexFace => "vertex-face",
            Self::EdgeEdge => "edge-edge",
        }
    }

    pub(crate) fn exact(self, [t0, t1]: &Step) -> (bool, Stage) {
        match self {
            Self::VertexFace => staged::vertex_face(*t0, *t1),
            Self::EdgeEdge => staged::edge_edge(*t0, *t1),
        }
    }

    fn parity(self, [t0, t1]: &Step) -> bool {
        let parity = match self {
            Self::VertexFace => parity::vertex_face(*t0, *t1),
            Self::EdgeEdge => parity::edge_edge(*t0, *t1),
        };
        parity != parity::RootParity::Even
    }

    fn spacetime(self, [t0, t1]: &Step) -> bool {
        match self {
            Self::VertexFace => spacetime::vertex_face(*t0, *t1, [0, 1, 2, 3]),
            Self::EdgeEdge => spacetime::edge_edge(*t0, *t1, [0, 1, 2, 3]),
        }
    }
}

/// How often a measurement is repeated.
#[derive(Clone, Copy)]
pub(crate) struct Rounds {
    /// Passes over a set.
    pub(crate) passes: usize,
    /// Runs of a single query.
    pub(crate) singles: usize,
}

/// The shortest time of one pass, in nanoseconds per item.
pub(crate) fn per_item(passes: usize, items: usize, mut pass: impl FnMut()) -> f64 {
    let mut shortest = f64::INFINITY;
    for _ in 0..passes {
        let start = Instant::now();
        pass();
        shortest = shortest.min(start.elapsed().as_nanos() as f64);
    }
    shortest / items.max(1) as f64
}

/// Pseudorandom bits.
pub(crate) struct Bits(pub(crate) u64);

impl Bits {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    /// Uniform in [-1, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.next() as f64 / f64::from(1u32 << 30) - 1.0
    }
}

/// One `robust::orient3d` on uniform input: the unit of the ratios.
fn robust_orient3d(passes: usize) -> f64 {
    let mut bits = Bits(1);
    let points: Vec<[[f64; 3]; 4]> =
        (0..32768).map(|_| std::array::from_fn(|_| std::array::from_fn(|_| bits.unit()))).collect();
    per_item(passes, points.len(), || {
        let sum: f64 = points
            .iter()
            .map(|p| {
                let [a, b, c, d] = p.map(|[x, y, z]| robust::Coord3D { x, y, z });
                robust::orient3d(a, b, c, d).signum()
            })
            .sum();
        black_box(sum);
    })
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let quick = arguments.iter().any(|a| a == "--quick");
    let directory = arguments.iter().find(|a| !a.starts_with("--")).map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/ccd-queries")),
        PathBuf::from,
    );
    let rounds = if quick { Rounds { passes: 20, singles: 3 } } else { Rounds { passes: 200, singles: 15 } };
    let unit = robust_orient3d(rounds.passes);
    println!("robust::orient3d, uniform: {unit:.1} ns = 1x\n");
    match public::read(&directory) {
        Ok(sets) => {
            public::report(&sets, rounds, unit);
            culling::report(&sets, rounds, unit);
        }
        Err(reason) => println!("public sets not measured: {reason}\n"),
    }
    generated::report(rounds, unit);
}
