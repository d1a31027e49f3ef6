//! Flows known by other means: slow sums for vortices, fluxes through closed surfaces, paths of points.
//!
//! * [`LineVortex`]: the integral of Biot and Savart by quadrature, in numbers with derivatives;
//! * [`flux_of_box`], [`flux_of_sphere`]: what flows out of a closed surface, by Gauss quadrature;
//! * [`followed`]: the path of a point by the method of Runge and Kutta.

mod flux;
mod line_vortex;
mod path;

pub use flux::{Flux, flux_of_box, flux_of_sphere};
pub use line_vortex::LineVortex;
pub use path::followed;
