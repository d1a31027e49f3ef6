//! Surfaces that move, known by other means: exact solutions, and slow solvers of another kind.
//!
//! * [`errors`]: how far a surface is from a known one, given by its signed distance;
//! * [`Dual`]: numbers with exact derivatives, to check fields for divergence;
//! * [`Profile`]: surfaces of revolution by the line that generates them, with their signed distance;
//! * [`two_balls`]: two balls that grow together and shrink again along their normals, exactly (the viscosity solution);
//! * [`MeridianFlow`] and [`MeridianLevelSet`]: mean curvature of surfaces of revolution, by the motion of the generating line
//!   and by a level set in the half plane.

mod dual;
mod dumbbell;
mod errors;
mod level_set;
mod meridian;
mod profile;
mod two_balls;

pub use dual::Dual;
pub use dumbbell::DumbbellProfile;
pub use errors::{SurfaceErrors, errors, hausdorff_to_sphere};
pub use level_set::MeridianLevelSet;
pub use meridian::{End, MeridianFlow};
pub use profile::{Piece, Profile, half_plane};
pub use two_balls::{TwoBalls, two_balls};
