//! Weighted sums of flows: [`WeightedSum`].

use glam::DVec3;
use welter_tracking::flows::VelocityField;

use super::{Amplitude, LocalPotential, VectorPotential};

/// A flow and its weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Weighted<F> {
    /// The flow.
    pub part: F,
    /// Its weight, which may depend on time.
    pub amplitude: Amplitude,
}

/// The sum of flows, each times its weight at the time, in their order. A part of weight zero is not evaluated.
/// The walls of all parts hold for the sum, whatever the weights are: what one part would carry through the wall of another stays beside it.
///
/// Of potentials it is a potential: curls are linear, and the weights do not depend on the place.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::procedural::{Amplitude, Weighted, WeightedSum};
/// use welter_tracking::flows::VelocityField;
/// let up = |_: DVec3, _: f64| DVec3::Y;
/// let sum = WeightedSum::new(vec![
///     Weighted { part: up, amplitude: Amplitude::Constant(2.0) },
///     Weighted { part: up, amplitude: Amplitude::Constant(0.5) },
/// ]);
/// assert_eq!(sum.velocity(DVec3::ZERO, 0.0), 2.5 * DVec3::Y);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct WeightedSum<F> {
    /// The parts; none for no flow.
    pub parts: Vec<Weighted<F>>,
}

impl<F> Default for WeightedSum<F> {
    /// No flow.
    fn default() -> Self {
        Self { parts: Vec::new() }
    }
}

impl<F> WeightedSum<F> {
    /// The sum of some parts.
    #[must_use]
    pub fn new(parts: Vec<Weighted<F>>) -> Self {
        Self { parts }
    }

    /// Parts with a weight at a time.
    fn weighted(&self, time: f64) -> impl Iterator<Item = (f64, &F)> {
        self.parts.iter().map(move |p| (p.amplitude.at(time), &p.part)).filter(|(weight, _)| *weight != 0.0)
    }
}

impl<F: VectorPotential> VectorPotential for WeightedSum<F> {
    fn potential_and_curl(&self, position: DVec3, time: f64) -> LocalPotential {
        self.weighted(time).fold(LocalPotential::ZERO, |sum, (weight, part)| {
            let LocalPotential { potential, curl } = part.potential_and_curl(position, time);
            LocalPotential { potential: sum.potential + weight * potential, curl: sum.curl + weight * curl }
        })
    }
}

impl<F: VelocityField> VelocityField for WeightedSum<F> {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        self.weighted(time)
            .fold(DVec3::ZERO, |sum, (weight, part)| sum + weight * part.velocity(position, time))
    }

    fn confine(&self, from: DVec3, to: DVec3, times: [f64; 2]) -> DVec3 {
        let mut ends = self.parts.iter().map(|it| it.part.confine(from, to, times));
        ends.find(|&end| end != to).unwrap_or(to)
    }
}
