//! Benchmark of the exact linear solver and of its stages, beside Cramer's rule, on the same inputs in the same
//! run.
//!
//! Prints, for each size and class of input, the nanoseconds a system of each method and the ratio of the
//! solver to filtered determinants, with the share of the systems that the two filters settle. What a filter
//! leaves goes to the exact stage of its method. Methods take turns on chunks of the inputs, of which the
//! shortest time over all rounds counts.
//!
//! `cargo bench -p welter-benches --bench linear [-- FILTER [--quick]]`

#![expect(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::hint::black_box;
use std::time::Instant;
use welter_predicates::linear::{Solution, solve, staged};

/// Distinct systems per class: too many for a branch predictor to learn.
const COUNT: usize = 4096;
/// Systems timed at a time.
const CHUNK: usize = 64;

type System<const N: usize> = ([[f64; N]; N], [f64; N]);
type Method<const N: usize> = fn(&[[f64; N]; N], &[f64; N]) -> Option<Solution<N>>;

/// Where the coefficients come from.
#[derive(Clone, Copy, Debug)]
enum Class {
    /// Uniform in [-1, 1).
    Uniform,
    /// -4, -3, ... 4.
    Grid,
    /// Uniform, the last row the sum of two others up to rounding.
    NearlySingular,
    /// Six points of space-time: coordinates uniform, times 0 and 1, weights that add up to one.
    SpaceTime,
}

/// splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    fn uniform(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    fn grid(&mut self) -> f64 {
        (self.next() % 9) as f64 - 4.0
    }
}

fn systems<const N: usize>(class: Class) -> Vec<System<N>> {
    let mut random = Random(1);
    (0..COUNT)
        .map(|_| {
            let mut entry = || if matches!(class, Class::Grid) { random.grid() } else { random.uniform() };
            let mut a: [[f64; N]; N] = std::array::from_fn(|_| std::array::from_fn(|_| entry()));
            let mut b: [f64; N] = std::array::from_fn(|_| entry());
            match class {
                Class::NearlySingular => a[N - 1] = std::array::from_fn(|j| a[0][j] + a[1][j]),
                Class::SpaceTime => {
                    // The segment 0, 1 and a simplex of the rest; times in row N - 3, then the sums of weights.
                    a[N - 3] = std::array::from_fn(|j| if j == 1 || j + 1 == N { 1.0 } else { 0.0 });
                    a[N - 2] = [1.0; N];
                    a[N - 1] = std::array::from_fn(|j| if j < 2 { 1.0 } else { 0.0 });
                    b = [0.0; N];
                    b[N - 1] = 1.0;
                }
                Class::Uniform | Class::Grid => {}
            }
            (a, b)
        })
        .collect()
}

fn filtered_determinants<const N: usize>(a: &[[f64; N]; N], b: &[f64; N]) -> Option<Solution<N>> {
    staged::by_filtered_determinants(a, b).or_else(|| staged::by_determinants(a, b))
}

fn run<const N: usize>(filter: &str, rounds: usize) {
    let methods: [(&str, Method<N>); 6] = [
        ("solve", |a, b| Some(solve(a, b))),
        ("filtered Cramer", filtered_determinants),
        ("machine", staged::by_machine_integers),
        ("expansions", staged::by_expansions),
        ("integers", staged::by_integers),
        ("exact Cramer", staged::by_determinants),
    ];
    for class in [Class::Uniform, Class::SpaceTime, Class::Grid, Class::NearlySingular] {
        let label = format!("{N}x{N} {class:?}");
        if !label.contains(filter) {
            continue;
        }
        let inputs = systems::<N>(class);
        let mut best = vec![[f64::INFINITY; 6]; COUNT / CHUNK];
        let mut answered = [0; 6];
        for round in 0..rounds {
            for (chunk, best) in inputs.chunks(CHUNK).zip(&mut best) {
                for (i, (_, method)) in methods.iter().enumerate() {
                    let start = Instant::now();
                    let count = chunk
                        .iter()
                        .filter(|(a, b)| black_box(method(black_box(a), black_box(b))).is_some())
                        .count();
                    best[i] = best[i].min(start.elapsed().as_nanos() as f64);
                    answered[i] += if round == 0 { count } else { 0 };
                }
            }
        }
        let nanoseconds = |i: usize| best.iter().map(|chunk| chunk[i]).sum::<f64>() / COUNT as f64;
        let share = |stage: Method<N>| {
            100.0 * inputs.iter().filter(|(a, b)| stage(a, b).is_some()).count() as f64 / COUNT as f64
        };
        print!("{label:20}");
        for (i, (name, _)) in methods.iter().enumerate() {
            if answered[i] == COUNT {
                print!("  {name} {:.0}", nanoseconds(i));
            } else {
                print!("  {name} - ({:.0}%)", 100.0 * answered[i] as f64 / COUNT as f64);
            }
        }
        println!(
            "  ratio {:.2}; filters settle {:.2}% and {:.2}%",
            nanoseconds(0) / nanoseconds(1),
            share(staged::by_filter),
            share(staged::by_filtered_determinants)
        );
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let quick = arguments.iter().any(|a| a == "--quick");
    let filter = arguments.iter().find(|a| !a.starts_with("--")).map_or("", String::as_str);
    let rounds = if quick { 3 } else { 15 };
    println!("nanoseconds a system");
    run::<5>(filter, rounds);
    run::<6>(filter, rounds);
}
