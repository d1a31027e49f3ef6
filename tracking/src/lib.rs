//! Moving surfaces: remeshing, topology change, collision resolution, flows, cloth and elastic solids.
//!
//! # What it holds today
//! [`tracker`]: surfaces that move with a flow and never intersect themselves. Its stages stand alone as well:
//!
//! | module | what it does |
//! | --- | --- |
//! | [`surface`] | the state: triangles, masses and attributes that change together, with a log of all changes |
//! | [`improvement`] | parameters and reports of the static operations: remeshing, merging, separation |
//! | [`flows`] | predicts positions: velocity fields, motion along normals, mean curvature, any closure |
//! | [`integration`] | makes of them positions that can be reached without a collision |
//! | [`broad_phase`] | which elements may come near each other, at rest or along a step |
//! | [`collision`] | when moving primitives first touch or come within a distance of each other, where, along which normal |
//! | [`quadric`] | ridges and corners, by the quadric metric tensor |
//! | [`queries`] | reads continuous collision queries with known answers |
//!
//! # What it promises
//! * A surface that starts free of self-intersection stays so after every step, whatever the motion; each accepted
//!   set of positions is proven so by the exact static check.
//! * Topology changes (merging, separation) happen only where they are switched on.
//! * Lengths are relative to the mesh: scaling by a power of two scales the result bit for bit.
//! * A step that cannot be completed returns a typed error and leaves the surface as it was.
//!
//! # What it will hold
//! Cloth and elastic solids.

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

/// The code in the README is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
