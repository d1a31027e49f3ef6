//! Curl noise as a potential.
//!
//! [`CurlNoise`] is a sum of plane waves \[Bridson07, Kraichnan70\]; the potential of each is known as well as its velocity, so
//! there is nothing to add but the trait. Where the noise is bounded by solids, it is the potential that is multiplied.

use glam::DVec3;
use welter_tracking::flows::fields::CurlNoise;

use super::{LocalPotential, VectorPotential};

impl VectorPotential for CurlNoise {
    fn potential_and_curl(&self, position: DVec3, time: f64) -> LocalPotential {
        let (potential, curl) = self.potential_and_velocity(position, time);
        LocalPotential { potential, curl }
    }
}
