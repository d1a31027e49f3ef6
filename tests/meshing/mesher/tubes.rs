//! Tubes that pass through themselves: copies are those that winding numbers, the tube's own tetrahedra and its connectivity say.

use welter_kit::mesher::bodies::tube_body;
use welter_kit::mesher::check;
use welter_meshing::Monitor;
use welter_meshing::volumetric::{mesh_volume, verify};

use super::unfolded::{Class, Tally, number_from, outcome, parameters};

/// Refinements that are tried beyond those asked for, before a seed counts as refused.
const FURTHER: u32 = 2;

/// Fewer seeds in debug builds, which are twenty times slower.
const SEEDS: u64 = if cfg!(debug_assertions) { 15 } else { 100 };

/// `WELTER_MESHER_TUBES` is the number of seeds, `WELTER_MESHER_REFINEMENTS` how often cells may be halved.
#[test]
fn tubes_have_as_many_copies_as_they_lie_over_themselves() {
    let first = number_from("WELTER_MESHER_FIRST", 0);
    let count = number_from("WELTER_MESHER_TUBES", SEEDS);
    let refinements = number_from("WELTER_MESHER_REFINEMENTS", 2) as u32;
    let mut tally = Tally::default();
    for seed in first..first + count {
        let body = tube_body(seed);
        let group = body.name.rsplit_once(", ").map_or("", |(group, _)| group).to_owned();
        let mut outcome_of_seed = outcome(&body, seed, refinements);
        for further in 1..=FURTHER {
            if outcome_of_seed.immersed
                && matches!(outcome_of_seed.class, Class::UnderResolved | Class::Missed)
            {
                let before = outcome_of_seed.note;
                outcome_of_seed = outcome(&body, seed, refinements + further);
                outcome_of_seed.note += &format!("; with {} refinements {before}", refinements + further - 1);
            }
        }
        tally.add(seed, outcome_of_seed.of(&group));
    }
    tally.print();
    assert!(!tally.any_wrong(), "some meshes are wrong, see above");
    // What is immersed is meshed, or bounds another volume too.
    assert_eq!(
        tally.as_unfolded + tally.ambiguous_immersed,
        tally.immersed,
        "some tubes were refused though they are immersed, see above"
    );
    assert!(100 * tally.immersed >= 80 * count as usize, "too few tubes are immersed");
    assert!(100 * tally.overlapping >= 99 * tally.meshed, "too few tubes overlap themselves");
}

/// In cells twice as large one hexahedron would hold two sheets, with the Euler characteristic as it was.
#[test]
fn sheets_of_tubes_stay_apart_in_larger_cells() {
    for seed in [278, 384] {
        let body = tube_body(seed);
        let surface = body.solid.surface();
        let volume = mesh_volume(&surface, &parameters(&body, seed, 2), &Monitor::none()).unwrap();
        assert!(volume.coarsenings < volume.refinements, "seed {seed}");
        check(&surface, &volume).unwrap();
        assert!(verify(&surface, &volume, &Monitor::none()).unwrap().passed(), "seed {seed}");
        let (coarse, report) = volume.coarsened(&Monitor::none()).unwrap();
        assert!(report.kept(), "seed {seed}");
        let found = verify(&surface, &coarse, &Monitor::none()).unwrap();
        assert!(
            found.winding_copies.count > 0 && found.euler.none() && found.embedding.none(),
            "seed {seed}"
        );
    }
}
