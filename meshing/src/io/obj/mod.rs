//! Wavefront OBJ [Murray96]: vertices, faces, groups and objects; or lines.
//!
//! Why a reader of our own and not `tobj`, which is its peer in the tests: `tobj` 4.0.5 gives each group vertices of its
//! own in the order of first use, so that surfaces shared between groups fall open and unused vertices vanish; names no
//! line; divides coordinates by a fourth number; reads a face of 104 bytes and a hash entry for each vertex into memory
//! before the first triangle; makes a fan of every polygon; and overflows on `f 1/-9`. Both parse numbers by the standard library, so
//! coordinates are the same bits.

mod read;
mod write;

pub(super) use read::{read, read_polylines, read_with_lines};
pub(super) use write::write;
