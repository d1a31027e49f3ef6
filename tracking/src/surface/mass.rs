//! The mass of each vertex: [`MassRule`].

use super::attributes::transfer::Entry;

/// How masses pass through changes. In both cases a vertex of infinite mass, an immovable one, stays immovable, also
/// when an edge at it collapses; a new vertex is immovable only if all of its sources are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MassRule {
    /// A property of the place, as the unit weights of \[Brochu12, section 3.2.7\]: means of the finite masses.
    #[default]
    Interpolate,
    /// An amount: the sum of finite masses is kept to rounding, but for those that an immovable vertex swallows and
    /// those of components that vanish.
    Conserve,
}

impl MassRule {
    /// The mass of one row's target. That of a vertex which merges with an immovable one is for the caller to set.
    pub(crate) fn apply(self, row: &[Entry], old: &[f64], born: bool) -> f64 {
        let mass = |entry: &Entry| old[entry.source as usize];
        let merged = |entry: &&Entry| entry.interpolation > 0.0 || entry.source == entry.target;
        let mut sources = row.iter().filter(merged);
        let immovable = if born {
            sources.all(|entry| mass(entry).is_infinite())
        } else {
            sources.any(|entry| entry.source == entry.target && mass(entry).is_infinite())
        };
        if immovable {
            return f64::INFINITY;
        }
        let finite = row.iter().filter(|&entry| mass(entry).is_finite());
        let sum = match self {
            Self::Interpolate => {
                let sources: Vec<(f64, f64)> =
                    finite.filter(merged).map(|entry| (entry.interpolation, mass(entry))).collect();
                match sources[..] {
                    [(_, only)] => only,
                    _ => {
                        let weights: f64 = sources.iter().map(|&(weight, _)| weight).sum();
                        sources.iter().map(|&(weight, mass)| weight * mass).sum::<f64>() / weights
                    }
                }
            }
            Self::Conserve => finite.map(|entry| entry.share * mass(entry)).sum(),
        };
        // At the ends of the range a sum may round to zero or to infinity, which would have a meaning.
        sum.clamp(f64::from_bits(1), f64::MAX)
    }
}
