//! Moving surfaces: remeshing, topology change, collision resolution, flows, cloth and elastic solids.
//!
//! # What it will promise
//! * A surface that starts free of self-intersection stays so after every step, whatever the motion; each accepted
//!   set of positions is proven so by the exact static check.
//! * Topology changes (merging, separation) happen only where they are switched on.
//! * Lengths are relative to the mesh: scaling by a power of two scales the result bit for bit.
//! * A step that cannot be completed returns a typed error and leaves the mesh as it was.
//!
//! # What it holds today
//! [`queries`], the reader of continuous collision queries with known answers. Else the crate marks its place in the
//! dependency direction predicates -> meshing -> tracking -> fluids.

#![forbid(unsafe_code)]

pub mod queries;
