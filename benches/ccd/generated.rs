//! Generated inputs, from uniform to degenerate and over the whole exponent range.

use crate::{Bits, Kind, Rounds, Step, per_item};
use std::hint::black_box;
use std::time::Instant;
use welter_predicates::ccd::Stage;

/// How coordinates are drawn.
struct Class {
    name: &'static str,
    queries: usize,
    draw: fn(&mut Bits) -> Step,
}

const CLASSES: [Class; 6] = [
    Class { name: "uniform", queries: 20_000, draw: |bits| each(|| bits.unit()) },
    Class { name: "grid +-4", queries: 20_000, draw: |bits| each(|| grid(bits)) },
    Class { name: "grid +-4, ulps beside", queries: 20_000, draw: |bits| each(|| beside(bits)) },
    Class { name: "grid +-4 in a general plane", queries: 20_000, draw: in_a_plane },
    Class { name: "grid +-4 in z = 0", queries: 20_000, draw: in_a_coordinate_plane },
    Class { name: "exponents +-1000", queries: 100, draw: |bits| each(|| wide(bits)) },
];

fn each(mut draw: impl FnMut() -> f64) -> Step {
    std::array::from_fn(|_| std::array::from_fn(|_| std::array::from_fn(|_| draw())))
}

fn grid(bits: &mut Bits) -> f64 {
    (bits.next() % 9) as f64 - 4.0
}

fn beside(bits: &mut Bits) -> f64 {
    grid(bits) * (1.0 + ((bits.next() % 3) as f64 - 1.0) * f64::EPSILON)
}

fn wide(bits: &mut Bits) -> f64 {
    bits.unit() * 2f64.powi((bits.next() % 2001) as i32 - 1000)
}

fn in_a_plane(bits: &mut Bits) -> Step {
    let mut step = each(|| grid(bits));
    step.as_flattened_mut().iter_mut().for_each(|p| p[2] = p[0] - p[1]);
    step
}

fn in_a_coordinate_plane(bits: &mut Bits) -> Step {
    let mut step = each(|| grid(bits));
    step.as_flattened_mut().iter_mut().for_each(|p| p[2] = 0.0);
    step
}

pub(crate) fn report(rounds: Rounds, unit: f64) {
    println!(
        "{:28} {:11} {:>9} {:>9} {:>11} {:>9}   share by stage, %",
        "generated", "", "mean ns", "ratio", "worst ns", "ratio"
    );
    for class in &CLASSES {
        for kind in Kind::ALL {
            let mut bits = Bits(7);
            let steps: Vec<Step> = (0..class.queries).map(|_| (class.draw)(&mut bits)).collect();
            // The slow class once.
            let passes = if class.queries < 1000 { 1 } else { rounds.passes / 20 + 1 };
            let mean = per_item(passes, steps.len(), || {
                black_box(steps.iter().filter(|step| kind.exact(step).0).count());
            });
            let (mut worst, mut stages) = (0.0f64, [0usize; Stage::ALL.len()]);
            for step in &steps {
                let mut shortest = f64::INFINITY;
                for _ in 0..passes.min(3) {
                    let start = Instant::now();
                    black_box(kind.exact(black_box(step)));
                    shortest = shortest.min(start.elapsed().as_nanos() as f64);
                }
                worst = worst.max(shortest);
                stages[kind.exact(step).1 as usize] += 1;
            }
            let shares: Vec<String> = Stage::ALL
                .iter()
                .zip(stages)
                .filter(|&(_, count)| count > 0)
                .map(|(stage, count)| format!("{stage:?} {:.2}", 100.0 * count as f64 / steps.len() as f64))
                .collect();
            println!(
                "{:28} {:11} {mean:9.1} {:9.1} {worst:11.0} {:9.0}   {}",
                class.name,
                kind.name(),
                mean / unit,
                worst / unit,
                shares.join(" ")
            );
        }
    }
}
