//! How often each stage settles a sign, on fixed inputs: a filter that is right but weak, or a stage that nothing
//! reaches, fails here.

use crate::family::{Predicate, for_each_predicate};
use welter_kit::generate::{Kind, seeded};
use welter_predicates::Stage;

/// Inputs counted for each rate.
const COUNT: u64 = 10_000;

/// The share, in percent, of inputs of a kind that a stage settles.
fn share<const D: usize, const N: usize>(predicate: &Predicate<D, N>, kind: Kind, stage: Stage) -> f64 {
    let settled = seeded::<D, N>(kind, COUNT).filter(|p| (predicate.staged)(p).1 == stage).count();
    settled as f64 * 100.0 / COUNT as f64
}

fn staged_variant_agrees<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    for kind in Kind::ALL {
        for p in seeded::<D, N>(kind, 200) {
            let (sign, stage) = (predicate.staged)(&p);
            assert_eq!(sign, (predicate.sign)(&p), "{} {p:?}", predicate.name);
            assert!(stage != Stage::NonFinite, "{} {p:?}", predicate.name);
        }
    }
}

fn the_filter_settles_uniform_input<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    let settled = share(predicate, Kind::Uniform, Stage::Filter);
    assert!(settled >= 99.9, "{}: {settled} %", predicate.name);
}

for_each_predicate! {
    staged_variant_agrees
    the_filter_settles_uniform_input
}
