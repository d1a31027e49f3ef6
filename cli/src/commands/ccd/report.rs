//! What was found out, for people and for scripts.

use super::kind::Kind;
use super::measure::Figures;
use super::method::Settled;
use crate::numbers::grouped;
use crate::table::aligned;
use serde_json::{Map, Value, json};

/// The keys of one file, or of a sum; `false_*` is null where no answer is known beforehand.
pub(super) fn to_json(figures: &Figures) -> Map<String, Value> {
    let known = |count: u64| (figures.with_truth > 0).then_some(count);
    let stages = figures.stages().map(|counts| {
        let named = Settled::ALL.into_iter().zip(counts);
        named.map(|(settled, count)| (settled.key().to_owned(), json!(count))).collect::<Map<_, _>>()
    });
    let value = json!({
        "queries": figures.queries,
        "queries_with_truth": figures.with_truth,
        "collisions": figures.collisions,
        "false_positives": known(figures.false_positives),
        "false_negatives": known(figures.false_negatives),
        "mean_ns": figures.mean_ns(),
        "max_ns": figures.max_ns(),
        "stages": stages,
        "rounded_coordinates": figures.rounded,
    });
    match value {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// A table of files and sums.
#[derive(Debug)]
pub(super) struct Table(Vec<[String; 11]>);

impl Table {
    pub(super) fn new() -> Self {
        let heads = [
            "file", "kind", "queries", "contacts", "false +", "false -", "mean ns", "max ns", "culled",
            "filtered", "exact",
        ];
        Self(vec![heads.map(str::to_owned)])
    }

    pub(super) fn push(&mut self, name: String, kind: Kind, figures: &Figures) {
        let known = |count| if figures.with_truth > 0 { grouped(count) } else { "-".to_owned() };
        let mut row = [const { String::new() }; 11];
        let cells = [
            name,
            kind.name().to_owned(),
            grouped(figures.queries),
            grouped(figures.collisions),
            known(figures.false_positives),
            known(figures.false_negatives),
            figures.mean_ns().map_or("-".to_owned(), |ns| grouped(ns.round() as i64)),
            figures.max_ns().map_or("-".to_owned(), grouped),
        ];
        let shares = Settled::ALL.map(|settled| match figures.stages() {
            Some(counts) if figures.queries > 0 => {
                format!("{:.1} %", 100.0 * counts[settled as usize] as f64 / figures.queries as f64)
            }
            _ => "-".to_owned(),
        });
        for (slot, cell) in row.iter_mut().zip(cells.into_iter().chain(shares)) {
            *slot = cell;
        }
        self.0.push(row);
    }

    /// Whether it has rows.
    pub(super) fn is_empty(&self) -> bool {
        self.0.len() == 1
    }

    pub(super) fn to_text(&self) -> String {
        aligned(&self.0, &[0, 1])
    }
}

/// The outcome in one sentence.
pub(super) fn verdict(sums: &[Figures]) -> String {
    let mut all = Figures::default();
    sums.iter().for_each(|figures| all.add(figures));
    let compared = match all.with_truth {
        0 => "answers not compared, for the files tell none".to_owned(),
        known => {
            let missing = all.queries - known;
            let rest = if missing == 0 {
                String::new()
            } else {
                format!(" (and {} not compared, for their files tell no answer)", grouped(missing))
            };
            format!(
                "{} false positives, {} false negatives{rest}",
                grouped(all.false_positives),
                grouped(all.false_negatives)
            )
        }
    };
    format!("{} queries, {} with contact: {compared}\n", grouped(all.queries), grouped(all.collisions))
}
