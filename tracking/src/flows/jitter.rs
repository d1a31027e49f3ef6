//! Random displacements, to try what follows: [`Jitter`].
//!
//! A vertex is displaced to a random point of the ball around it, all points of which are equally likely. Nothing relates
//! the displacements of neighbours, so triangles turn over and pass through each other: the integration has to
//! stop that.

use rayon::prelude::*;

use super::random::Random;
use super::{Flow, FlowError, PIECE, Prediction, move_each, require_step};
use crate::quadric::scale::Scale;
use crate::surface::MovingSurface;

/// Displaces each vertex at random in every step.
///
/// ```
/// use welter_meshing::shapes::{Sphere, sphere};
/// use welter_tracking::flows::{Flow, Jitter};
/// use welter_tracking::surface::MovingSurface;
///
/// let surface = MovingSurface::new(&*sphere(&Sphere { edge_length: 0.5, ..Sphere::default() })?)?;
/// let flow = Jitter { amplitude_rel: 0.5, seed: 7 };
/// let prediction = flow.advance(&surface, 0.0, 0.01)?;
/// assert!((prediction.ends[0] - surface.positions()[0]).length() < 0.3);
/// assert_eq!(prediction, flow.advance(&surface, 0.0, 0.01)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jitter {
    /// The largest displacement in a step, however long the step, in mean edge lengths of the surface at its
    /// beginning; from 0 on. Default: 0.5.
    pub amplitude_rel: f64,
    /// Which of the sequences. Displacements are drawn anew for each vertex id and each time at which a step
    /// begins. Default: 0.
    pub seed: u64,
}

impl Default for Jitter {
    fn default() -> Self {
        Self { amplitude_rel: 0.5, seed: 0 }
    }
}

impl Jitter {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`FlowError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), FlowError> {
        let amplitude = self.amplitude_rel;
        let ok = amplitude.is_finite() && amplitude >= 0.0;
        FlowError::require(ok, "amplitude_rel", amplitude, "finite and not below 0")
    }
}

impl Flow for Jitter {
    fn advance(&self, surface: &MovingSurface, time: f64, dt: f64) -> Result<Prediction, FlowError> {
        require_step(dt)?;
        self.validate()?;
        let scale = Scale::of_surface(surface);
        let amplitude = self.amplitude_rel * mean_edge(surface, &scale);
        let ends = move_each(surface, |vertex, start| {
            let mut random = Random::of(&[self.seed, time.to_bits(), u64::from(vertex.0)]);
            // The volume within a radius is its cube.
            let radius = amplitude * libm::cbrt(random.unit());
            Ok(start + scale.restored(radius * random.direction()))
        })?;
        Ok(Prediction { ends, dt })
    }
}

/// The mean length of the edges, in a scale; 0 if there are none.
fn mean_edge(surface: &MovingSurface, scale: &Scale) -> f64 {
    let mesh = surface.connectivity();
    let edges: Vec<_> = mesh.edges().collect();
    let length = |edge| {
        let [a, b] = mesh.ends(edge).map(|v| surface.position(v));
        scale.difference(a, b).length()
    };
    // Sums of pieces of a fixed size, in order.
    let pieces: Vec<f64> =
        edges.par_chunks(PIECE).map(|piece| piece.iter().copied().map(length).sum()).collect();
    if edges.is_empty() { 0.0 } else { pieces.iter().sum::<f64>() / edges.len() as f64 }
}
