//! Velocity fields for tests and figures.
//!
//! All are free of divergence, so that the volume within a surface that follows them stays ([`Shear`] if its
//! vectors are perpendicular). Velocities are evaluated by formula; trigonometric functions come from `libm`, so they
//! are the same bits on every machine.

mod curl_noise;
mod enright;
mod rotation;
mod shear;

pub use curl_noise::{CurlNoise, CurlNoiseParameters, Potential, Wave};
pub use enright::Enright;
pub use rotation::Rotation;
pub use shear::Shear;
