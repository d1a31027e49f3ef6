//! A slow obvious twin of pictures of particles: densities of all particles, marched in small steps.

pub mod marched;
