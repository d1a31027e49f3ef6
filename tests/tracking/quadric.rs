//! The quadric of a vertex, against known shapes and the characteristic polynomial.

mod eigen;
mod vertex;
