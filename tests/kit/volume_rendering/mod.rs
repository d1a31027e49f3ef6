//! Slow obvious twins of the volume renderer: every ray meets every triangle, light is marched in small
//! steps.

pub mod convex;
pub mod rays;
pub mod tracer;
