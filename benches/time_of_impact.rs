//! Benchmark: times of impact and first approaches on random queries, with the share that needed more than
//! one exact decision, beside the plain decision and one `orient3d`.
//!
//! ```text
//! cargo bench -p welter-benches --bench time_of_impact
//! ```
//! Times are nanoseconds a query: means over all batches of a set, of each the best of [`RUNS`] passes, so
//! that other programs on the machine disturb little.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

use std::hint::black_box;
use std::time::Instant;

use welter_predicates::{ccd, orient3d};
use welter_tracking::collision::{
    MinimumSeparationParameters, TimeOfImpactParameters, minimum_separation, time_of_impact,
};

/// Runs of each measurement.
const RUNS: usize = 7;

/// Queries timed together: less than a slice of the scheduler.
const BATCH: usize = 20;

/// Queries of a set.
const QUERIES: usize = 2000;

type Query = [[[f64; 3]; 4]; 2];

/// The same numbers in [-1, 1) on every machine.
struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn query(&mut self) -> Query {
        std::array::from_fn(|_| std::array::from_fn(|_| std::array::from_fn(|_| self.next())))
    }
}

/// The first queries of the sequence whose answer is `hit`.
fn queries(hit: bool, touches: impl Fn(&Query) -> bool) -> Vec<Query> {
    let mut uniform = Uniform(1);
    std::iter::repeat_with(|| uniform.query()).filter(|q| touches(q) == hit).take(QUERIES).collect()
}

/// Nanoseconds a query.
fn nanoseconds<T>(queries: &[Query], run: impl Fn(&Query) -> T) -> f64 {
    let pass = |batch: &[Query]| {
        let start = Instant::now();
        for query in batch {
            black_box(run(black_box(query)));
        }
        start.elapsed().as_secs_f64() * 1e9
    };
    let best = |batch: &[Query]| (0..RUNS).map(|_| pass(batch)).fold(f64::INFINITY, f64::min);
    queries.chunks(BATCH).map(best).sum::<f64>() / queries.len() as f64
}

/// One set of queries through the decision, the time of impact, and the approach within a hundredth.
macro_rules! row {
    ($name:ident, $hit:expr) => {{
        let set = queries($hit, |q| ccd::$name(q[0], q[1]));
        let width = TimeOfImpactParameters::default();
        let near = MinimumSeparationParameters { distance: 0.01, ..Default::default() };
        let impact = |q: &Query| time_of_impact::$name(q[0], q[1], &width).expect("finite");
        let approach = |q: &Query| minimum_separation::$name(q[0], q[1], &near).expect("finite");
        let stages = set.iter().filter(|q| ccd::staged::$name(q[0], q[1]).1 == ccd::Stage::Exact).count();
        let more = set.iter().filter_map(impact).filter(|i| i.decisions > 1).count();
        let steps: u32 = set.iter().filter_map(approach).map(|a| a.steps).sum();
        println!(
            "{:11} {:4} decision {:7.0}   impact {:7.0}   approach {:7.0}   decided exactly {:5.2} %   \
             more than once for the impact {:5.2} %   steps {:.1}",
            stringify!($name),
            if $hit { "hit" } else { "miss" },
            nanoseconds(&set, |q| ccd::$name(q[0], q[1])),
            nanoseconds(&set, impact),
            nanoseconds(&set, approach),
            100.0 * stages as f64 / set.len() as f64,
            100.0 * more as f64 / set.len() as f64,
            f64::from(steps) / set.len() as f64,
        );
    }};
}

fn main() {
    let set = queries(true, |_| true);
    println!("orient3d {:.1} ns", nanoseconds(&set, |q| orient3d(q[0][0], q[0][1], q[0][2], q[0][3])));
    row!(vertex_face, true);
    row!(vertex_face, false);
    row!(edge_edge, true);
    row!(edge_edge, false);
}
