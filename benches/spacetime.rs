//! Benchmark of space-time collision queries beside their twin by elimination and the queries of straight
//! motion.
//!
//! Prints nanoseconds a query on the same inputs in the same run, and the share of them that collide. Methods
//! take turns on chunks of the inputs, of which the shortest time over all rounds counts.
//!
//! `cargo bench -p welter-benches --bench spacetime`

#![expect(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::hint::black_box;
use std::time::Instant;
use welter_predicates::ccd::{self, spacetime, spacetime::by_elimination};

const COUNT: usize = 8192;
const CHUNK: usize = 64;
const ROUNDS: usize = 7;

type Query = [[[f64; 3]; 4]; 2];
type Method = fn(&Query) -> bool;
/// A class of inputs: its name, and a coordinate from random bits.
type Class = (&'static str, fn(u64) -> f64);

/// Numbers of the vertices: not in the order of the arguments.
const INDICES: [u32; 4] = [3, 1, 2, 0];

/// Queries whose coordinates `number` draws from random bits.
fn queries(number: fn(u64) -> f64) -> Vec<Query> {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        number(z ^ (z >> 31))
    };
    (0..COUNT)
        .map(|_| std::array::from_fn(|_| std::array::from_fn(|_| std::array::from_fn(|_| next()))))
        .collect()
}

fn run(label: &str, inputs: &[Query], methods: [Method; 3]) {
    let mut best = vec![[f64::INFINITY; 3]; COUNT / CHUNK];
    for _ in 0..ROUNDS {
        for (chunk, best) in inputs.chunks(CHUNK).zip(&mut best) {
            for (best, method) in best.iter_mut().zip(methods) {
                let start = Instant::now();
                black_box(chunk.iter().filter(|query| method(black_box(query))).count());
                *best = best.min(start.elapsed().as_nanos() as f64);
            }
        }
    }
    let [ours, twin, straight] =
        [0, 1, 2].map(|i| best.iter().map(|chunk| chunk[i]).sum::<f64>() / COUNT as f64);
    let hits = inputs.iter().filter(|query| methods[0](query)).count();
    println!(
        "{label:26} space-time {ours:7.0}  by elimination {twin:8.0}  straight motion {straight:8.0}  collide {:.1}%",
        100.0 * hits as f64 / COUNT as f64
    );
}

fn main() {
    let classes: [Class; 2] = [
        ("uniform", |bits| (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0),
        ("grid of +-2", |bits| (bits % 5) as f64 - 2.0),
    ];
    println!("nanoseconds a query");
    for (class, number) in classes {
        let mut inputs = queries(number);
        for flat in [false, true] {
            if flat {
                inputs.iter_mut().for_each(|q| q.as_flattened_mut().iter_mut().for_each(|p| p[2] = 1.0));
            }
            let label = |pair: &str| format!("{pair} {class}{}", if flat { ", flat" } else { "" });
            run(
                &label("vf"),
                &inputs,
                [
                    |&[t0, t1]| spacetime::vertex_face(t0, t1, INDICES),
                    |&[t0, t1]| by_elimination::vertex_face(t0, t1, INDICES),
                    |&[t0, t1]| ccd::vertex_face(t0, t1),
                ],
            );
            run(
                &label("ee"),
                &inputs,
                [
                    |&[t0, t1]| spacetime::edge_edge(t0, t1, INDICES),
                    |&[t0, t1]| by_elimination::edge_edge(t0, t1, INDICES),
                    |&[t0, t1]| ccd::edge_edge(t0, t1),
                ],
            );
        }
    }
}
