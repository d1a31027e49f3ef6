//! Polygon file format [Turk94]: text and binary of either byte order.
//!
//! Read: element `vertex` with scalar `x`, `y`, `z`; element `face` with a list `vertex_indices` or `vertex_index` and,
//! where all three are there, `red`, `green`, `blue` (bytes, or floats from 0 to 1); element `tristrips`, whose strips end
//! at -1. Every other element and property is passed over and named in the report.

mod body;
mod header;
mod read;
mod write;

pub(super) use read::read;
pub(super) use write::write;
