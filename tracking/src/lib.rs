//! Moving surfaces: remeshing, topology change, collision resolution, flows, cloth and elastic solids.
//!
//! # What it holds today
//! [`collision`]: when moving primitives first touch or come within a distance of each other, where, and along which normal.
//! It promises never to be late and to miss nothing, proven for every finite `f64`.
//!
//! [`surface`]: the state of a surface tracker: triangles, masses and attributes that change together, by splits, flips
//! and collapses of edges, merging and separation. It promises that edges stay balanced, and says beforehand what a
//! change would do to the topology.
//!
//! [`broad_phase`]: which elements of such a surface may come near each other, at rest or along a step. It promises to miss
//! none, without a tolerance, and to follow changes without being built anew.
//!
//! [`flows`]: where vertices want to go: velocity fields, motion along normals, mean curvature. It promises finite
//! positions, and says which vertex fails.
//!
//! [`quadric`]: whether the surface is smooth, a ridge or a corner at a vertex. It promises the same bits at every scale.
//! [`integration`]: from predicted positions to positions at which the surface does not intersect itself, by repulsion, impulses,
//! impact zones and shorter steps. It promises that after every step, proven by the exact static check.
//!
//! [`queries`]: the reader of continuous collision queries with known answers.
//!
//! # What it will promise
//! * A surface that starts free of self-intersection stays so after every step, whatever the motion; each accepted
//!   set of positions is proven so by the exact static check.
//! * Topology changes (merging, separation) happen only where they are switched on.
//! * Lengths are relative to the mesh: scaling by a power of two scales the result bit for bit.
//! * A step that cannot be completed returns a typed error and leaves the mesh as it was.

#![forbid(unsafe_code)]

pub mod broad_phase;
pub mod collision;
pub mod flows;
pub mod improvement;
pub mod integration;
pub mod quadric;
pub mod queries;
pub mod surface;
pub mod tracker;
