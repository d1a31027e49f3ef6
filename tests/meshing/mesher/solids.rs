//! Solids that overlap themselves: the mesh is exactly what their own connectivity says.

use welter_kit::mesher::bodies::body;

use super::unfolded::{Tally, number_from, outcome};

#[test]
fn solids_are_meshed_as_they_hang_together() {
    let first = number_from("WELTER_MESHER_FIRST", 0);
    let refinements = number_from("WELTER_MESHER_REFINEMENTS", 2) as u32;
    let mut tally = Tally::default();
    for seed in first..first + number_from("WELTER_MESHER_SEEDS", 20) {
        tally.add(seed, outcome(&body(seed), seed, refinements));
    }
    tally.print();
    assert!(!tally.any_wrong(), "some meshes are wrong, see above");
}
