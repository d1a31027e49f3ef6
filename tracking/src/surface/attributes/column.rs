//! One named array and its rule: [`Column`].

use super::transfer::Transfer;
use super::{AttributeValue, Inherited, Rule};
use welter_meshing::surface::EdgeId;

/// The values of one attribute, by id; those of free ids are without meaning.
#[derive(Clone, Debug)]
pub struct Column<T> {
    pub(super) name: String,
    pub(super) values: Vec<T>,
    pub(super) rule: Rule<T>,
    /// Whether the sign depends on the direction of the edge.
    pub(super) directed: bool,
}

impl<T: AttributeValue> Column<T> {
    pub(super) fn transfer(&mut self, transfer: &Transfer, slots: usize) {
        let mut sources = Vec::new();
        let mut results = Vec::with_capacity(transfer.rows.len());
        for row in transfer.rows.chunk_by(|a, b| a.target == b.target) {
            sources.clear();
            let old = |source: u32, reversed: bool| {
                let value = self.values[source as usize];
                if self.directed && reversed { value.negated() } else { value }
            };
            sources.extend(row.iter().map(|entry| Inherited {
                value: old(entry.source, entry.reversed),
                is_self: entry.source == entry.target,
                interpolation: entry.interpolation,
                share: entry.share,
            }));
            let value = match &self.rule {
                Rule::Interpolate => mean(&sources),
                Rule::Copy => foremost(&sources),
                Rule::Conserve => row.iter().zip(&sources).fold(T::default(), |sum, (entry, source)| {
                    let whole = entry.share == 1.0;
                    let part = if whole {
                        source.value
                    } else {
                        source.value.part(entry.share_before, entry.share, entry.last)
                    };
                    if entry.share == 0.0 { sum } else { sum.plus(part) }
                }),
                Rule::Reset => {
                    sources.iter().find(|source| source.is_self).map_or(T::default(), |source| source.value)
                }
                Rule::Custom(rule) => rule(&sources),
            };
            results.push((row[0].target, value));
        }
        self.values.resize(slots, T::default());
        for &born in &transfer.births {
            self.values[born as usize] = match &self.rule {
                Rule::Custom(rule) => rule(&[]),
                _ => T::default(),
            };
        }
        for (target, value) in results {
            self.values[target as usize] = value;
        }
    }

    /// Gives each new id the value of an old one, which is not smaller; old ids ascend.
    pub(super) fn gather(&mut self, old: impl Iterator<Item = usize>) {
        let mut count = 0;
        for old in old {
            self.values[count] = self.values[old];
            count += 1;
        }
        self.values.truncate(count);
    }

    /// Gives each new edge the value of an old one; with true, of the opposite direction.
    pub(super) fn renumber(&mut self, old: &[(EdgeId, bool)]) {
        let moved = old.iter().map(|&(edge, reversed)| {
            let value = self.values[edge.index()];
            if self.directed && reversed { value.negated() } else { value }
        });
        self.values = moved.collect();
    }
}

/// A source of weight one is taken as it is, bit for bit.
fn mean<T: AttributeValue>(sources: &[Inherited<T>]) -> T {
    match sources.iter().find(|source| source.interpolation == 1.0) {
        Some(whole) => whole.value,
        None => sources
            .iter()
            .filter(|source| source.interpolation != 0.0)
            .fold(T::default(), |sum, source| sum.plus(source.value.times(source.interpolation))),
    }
}

fn foremost<T: AttributeValue>(sources: &[Inherited<T>]) -> T {
    let mut best: Option<&Inherited<T>> = None;
    for source in sources.iter().filter(|source| source.interpolation > 0.0) {
        if best.is_none_or(|best| source.interpolation > best.interpolation) {
            best = Some(source);
        }
    }
    best.map_or(T::default(), |source| source.value)
}
