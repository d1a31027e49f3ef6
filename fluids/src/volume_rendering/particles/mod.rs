//! The picture of smoke that is given by marker particles: [`render_particles`].
//!
//! # What it computes
//! [`ParticleScene`]: each particle is a ball of smoke that fades toward its border, by a compact kernel with the particle's volume as its
//! integral; where balls overlap, densities add up. The planes are those of [`Picture`](super::Picture), in the same light and with the
//! same definitions, so the picture can be compared with that of a surface, number by number.
//! ```text
//!   density(x) = v sum over particles of W(|x - x_i|),   W(r) = 105 / (32 pi h^3) (1 - r^2/h^2)^2 inside of h
//! ```
//! The radius `h` is [`ParticleScene::radius_rel`] times the cube root of the volume `v` of a particle: the distance between
//! particles at the density of smoke.
//!
//! # What it promises
//! * Alpha is `1 - exp(-extinction length)`, with the integral of the density along the ray from the eye on as the length, in closed
//!   form, and so is each part of it between two slices of depth.
//! * The age is the mean over that length, a particle's age being the same all through it.
//! * The shadow texture holds the volume of all particles, to rounding.
//! * The same bits for any number of threads, and, with all lengths times a power of two, the volume of a particle times its cube
//!   and the extinction divided by the power, the same bits too, as long as nothing is below the smallest normal number.
//!
//! # What it does not promise
//! * A density of 1 inside: it is grainy, by how much particles are uneven and few.
//! * Solids.
//! * A sharp border: it is as wide as the radius.
//!
//! # Method
//! ```text
//! kernel    column of smoke along a line through a ball, whole and up to a place
//! discs     which pixels a ball may cover
//! columns   columns of all balls along the rays of a tile, sorted into slices of depth
//! deposit   volume of smoke in each voxel of the shadow texture
//! picture   the stages in turn; transmittance and scattering are those of the surface, a slice being a stretch of smoke
//! ```
//! Kernel and sums are those of smoothed particles \[Muller03\].
//!
//! # Complexity
//! Linear in the particles, the pixels that each covers, and the voxels that each fills.

mod columns;
mod deposit;
mod discs;
mod kernel;
mod picture;
mod scene;

pub use picture::{ParticleReport, render_particles};
pub use scene::ParticleScene;
