//! How often each stage settles a sign, on fixed inputs: a filter that is right but weak, or a stage that nothing
//! reaches, fails here.

use crate::family::{Predicate, for_each_predicate};
use welter_kit::entropy::{Entropy, stream};
use welter_kit::generate::{Kind, seeded};
use welter_predicates::Stage;

/// Inputs counted for each rate.
const COUNT: u64 = 2000;

/// The shares, in percent, of inputs that each stage settles.
struct Shares([f64; Stage::ALL.len()]);

impl Shares {
    fn of(stages: impl Iterator<Item = Stage>) -> Self {
        let mut counts = [0.0; Stage::ALL.len()];
        for stage in stages {
            counts[stage as usize] += 1.0;
        }
        let total: f64 = counts.iter().sum();
        Self(counts.map(|count| count * 100.0 / total))
    }

    fn on<const D: usize, const N: usize>(predicate: &Predicate<D, N>, kind: Kind) -> Self {
        Self::of(seeded::<D, N>(kind, COUNT).map(|p| (predicate.staged)(&p).1))
    }

    /// Of signs that are not zero, at about `2^-bits` from degenerate.
    fn near<const D: usize, const N: usize>(predicate: &Predicate<D, N>, bits: i32) -> Self {
        let inputs =
            (0..400).map(|seed| (predicate.graded)(Some(bits), &mut Entropy::new(&stream(seed, 500))));
        let settled = inputs.map(|p| (predicate.staged)(&p)).filter(|(sign, _)| !sign.is_zero());
        Self::of(settled.map(|(_, stage)| stage))
    }

    /// The share settled by these stages together.
    fn by(&self, stages: &[Stage]) -> f64 {
        stages.iter().map(|&stage| self.0[stage as usize]).sum()
    }
}

/// The least distance from degenerate, in bits, at which the stages up to `stage` settle half of the signs.
fn reach<const D: usize, const N: usize>(predicate: &Predicate<D, N>, stage: Stage) -> i32 {
    let stages: Vec<Stage> = Stage::ALL.into_iter().filter(|&other| other <= stage).collect();
    (10..200).take_while(|&bits| Shares::near(predicate, bits).by(&stages) >= 50.0).last().unwrap_or(0)
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
    let shares = Shares::on(predicate, Kind::Uniform);
    assert!(shares.by(&[Stage::Filter]) >= 99.9, "{}: {:?}", predicate.name, shares.0);
}

fn error_bounds_reach_as_far_as_derived<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    // A bound that is twice as large as it need be loses one bit; one that gains two is smaller than can be proven.
    for (stage, recorded) in
        [(Stage::Filter, predicate.filter_reach), (Stage::DoubleDouble, predicate.double_double_reach)]
    {
        let found = reach(predicate, stage);
        assert!(
            (recorded..=recorded + 1).contains(&found),
            "{}: {stage:?} settles half of the signs to 2^-{found}, not 2^-{recorded}",
            predicate.name
        );
    }
}

fn lattices_need_nothing_after_the_lattice<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    // Common scaling keeps a lattice; so do the ends of the exponent range.
    for kind in [Kind::Grid, Kind::FlatGrid, Kind::Dyadic, Kind::Scaled, Kind::Subnormal, Kind::NearMax] {
        let shares = Shares::on(predicate, kind);
        assert_eq!(shares.by(&[Stage::Filter, Stage::Lattice]), 100.0, "{} {kind:?}", predicate.name);
    }
    let flat = Shares::on(predicate, Kind::FlatGrid);
    assert!(flat.by(&[Stage::Lattice]) >= 90.0, "{}: zeros are not settled by a filter", predicate.name);
}

fn double_double_settles_what_is_nearly_degenerate<const D: usize, const N: usize>(
    predicate: &Predicate<D, N>,
) {
    for bits in [predicate.filter_reach + 8, predicate.double_double_reach - 8] {
        let shares = Shares::near(predicate, bits);
        assert!(shares.by(&[Stage::DoubleDouble]) >= 95.0, "{} {bits}: {:?}", predicate.name, shares.0);
    }
    for kind in [Kind::NearFlat, Kind::NearSphere] {
        let shares = Shares::on(predicate, kind);
        let exact = shares.by(&[Stage::Expansion, Stage::Integer]);
        assert!(exact <= 7.0, "{} {kind:?}: {:?}", predicate.name, shares.0);
    }
}

fn expansions_settle_the_rest_within_range<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    let shares = Shares::near(predicate, predicate.double_double_reach + 12);
    assert!(shares.by(&[Stage::Expansion]) >= 80.0, "{}: {:?}", predicate.name, shares.0);
}

fn spread_exponents_are_mostly_settled_early<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    let shares = Shares::on(predicate, Kind::Exponents);
    let early = shares.by(&[Stage::Filter, Stage::DoubleDouble]);
    assert!(early >= predicate.early_on_exponents, "{}: {:?}", predicate.name, shares.0);
}

fn every_stage_is_reached<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    let mut all: Vec<Shares> =
        [Kind::Uniform, Kind::Grid, Kind::Exponents].map(|k| Shares::on(predicate, k)).into();
    all.extend([60, 130].map(|bits| Shares::near(predicate, bits)));
    for stage in Stage::ALL.into_iter().filter(|&stage| stage != Stage::NonFinite) {
        assert!(all.iter().any(|shares| shares.by(&[stage]) >= 1.0), "{}: {stage:?} is dead", predicate.name);
    }
    let mut p = [[0.0; D]; N];
    p[N - 1][D - 1] = f64::NAN;
    assert_eq!((predicate.staged)(&p).1, Stage::NonFinite);
}

for_each_predicate! {
    staged_variant_agrees
    the_filter_settles_uniform_input
    error_bounds_reach_as_far_as_derived
    lattices_need_nothing_after_the_lattice
    double_double_settles_what_is_nearly_degenerate
    expansions_settle_the_rest_within_range
    spread_exponents_are_mostly_settled_early
    every_stage_is_reached
}
