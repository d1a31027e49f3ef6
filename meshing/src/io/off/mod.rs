//! Object file format of Geomview \[Phillips93\], text.
//!
//! Read: `OFF` with any of the prefixes `ST`, `C`, `N` (vertex attributes, passed over); the counts on the same line or
//! the next; comments from `#`; one vertex or face a line; face colours of three or four numbers, kept where every face
//! has one. Four-dimensional, `n`-dimensional and binary files are refused.

mod read;
mod write;

pub(super) use read::read;
pub(super) use write::write;
