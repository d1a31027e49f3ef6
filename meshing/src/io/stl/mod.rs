//! Stereolithography [Burns93]: text with any number of solids, and binary.
//!
//! STL has no vertices: corners at equal coordinates become one vertex ([`weld`]), in the order of first appearance.
//! Facet normals are not read; the order of the corners is the orientation.

mod read;
mod read_ascii;
mod weld;
mod write;

pub(super) use read::read;
pub(super) use write::write;
