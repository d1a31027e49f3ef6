//! Queries that boxes or a direction decide: one by one, and in batches.

use crate::public::Set;
use crate::{Kind, Rounds, Step, per_item};
use std::hint::black_box;
use welter_predicates::ccd::Stage;
use welter_predicates::ccd::batch::{self, Columns};

pub(crate) fn report(sets: &[Set], rounds: Rounds, unit: f64) {
    println!(
        "{:24} {:>7} {:>8} {:>7} {:>9} {:>7}",
        "culled queries, all sets", "queries", "one ns", "ratio", "batch ns", "ratio"
    );
    for kind in Kind::ALL {
        let culled: Vec<Step> = sets
            .iter()
            .filter(|set| set.kind == kind)
            .flat_map(|set| &set.steps)
            .filter(|step| matches!(kind.exact(step).1, Stage::Boxes | Stage::Direction))
            .copied()
            .collect();
        let columns: [[[Vec<f64>; 3]; 4]; 2] = std::array::from_fn(|t| {
            std::array::from_fn(|p| {
                std::array::from_fn(|k| culled.iter().map(|step| step[t][p][k]).collect())
            })
        });
        let borrowed =
            std::array::from_fn(|t| std::array::from_fn(|p| std::array::from_fn(|k| &columns[t][p][k][..])));
        let Ok(queries) = Columns::new(borrowed) else { continue };
        let mut answers = vec![false; culled.len()];
        let one = per_item(4 * rounds.passes, culled.len(), || {
            black_box(culled.iter().filter(|step| kind.exact(step).0).count());
        });
        let batch = per_item(4 * rounds.passes, culled.len(), || {
            let done = match kind {
                Kind::VertexFace => batch::vertex_face(&queries, &mut answers),
                Kind::EdgeEdge => batch::edge_edge(&queries, &mut answers),
            };
            black_box((done.is_ok(), &answers));
        });
        println!(
            "{:24} {:7} {one:8.1} {:7.1} {batch:9.1} {:7.1}",
            kind.name(),
            culled.len(),
            one / unit,
            batch / unit
        );
    }
    println!();
}
