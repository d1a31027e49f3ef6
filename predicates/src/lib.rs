//! Exact geometric predicates: signs and yes/no answers that are right for every finite `f64`.
//!
//! ```
//! use welter_predicates::{Sign, orient3d, orient3d_value, try_orient3d};
//!
//! let (a, b, c) = ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
//! assert_eq!(orient3d(a, b, c, [0.3, 0.3, -1e-320]), Sign::Positive);
//! assert_eq!(orient3d(a, b, c, [1e300, -1e300, 0.0]), Sign::Zero);
//! assert!(orient3d_value(a, b, c, [0.3, 0.3, -1e-320]) > 0.0);
//! assert!(try_orient3d(a, b, c, [0.0, 0.0, f64::NAN]).is_err());
//! ```
//!
//! # What is promised
//! * Every sign and every combinatorial case is that of the real numbers that the coordinates are: for subnormal
//!   numbers, for 1e308, for mixtures of both, for every degenerate position. Nothing overflows or underflows.
//! * A `_value` has the right sign and is finite; it is zero only if the exact value is.
//! * Every function is total. Coordinates that are infinite or not a number give [`Sign::Zero`] or the case that
//!   means "nothing"; the `try_` forms name the first such coordinate in a [`NonFinite`].
//! * `f32` coordinates are lifted without rounding. Points may be arrays or references to them, and with the
//!   features `glam` and `mint` the points of these libraries ([`Point`]).
//! * No allocation, no `unsafe`, no `std`, no global state (but the counters of the feature `stats`); the same answer
//!   on every machine.
//!
//! # What is not promised
//! * Magnitudes: a `_value` is a rounded determinant, good for an orientation or an order of size, not for a distance.
//! * Constructions (the point where two segments meet, a circumcentre): they round, and live elsewhere.
//! * Arithmetic other than that of IEEE 754 with rounding to nearest, ties to even, and subnormal numbers: Rust
//!   promises it, except on 32-bit x86 without SSE2.
//! * The stage that settles a sign ([`staged`]), which may change from version to version.
//!
//! # Map
//! | question | where |
//! | --- | --- |
//! | on which side of a line, a plane, a hyperplane? | [`orient2d`], [`orient3d`], [`orient4d`] |
//! | inside a circle, a sphere? | [`incircle`], [`insphere`] |
//! | how do segments, triangles, boxes, tetrahedra meet? | [`intersection`] |
//! | the same without ties | [`sos`] |
//! | the same for a grid moved so that it meets no vertex and no edge | [`moved_grid`] |
//! | do moving vertices, edges and faces touch during a time step? | [`ccd`] |
//! | has a small linear system one solution, with which signs? | [`linear`] |
//! | which stage settled a sign, how often? | [`staged`], [`stats`] |
//!
//! # How
//! A predicate is the sign of a polynomial, written once (`polynomial.rs`) and evaluated in ever wider numbers until
//! the sign is certain (`stage.rs`):
//!
//! ```text
//! filter          rounded f64, error bound from the column maxima       [Shewchuk97]     2-12 ns
//! lattice         coordinates as integers of 29, then 61 bits; exact                    11-130 ns
//! double-double   106 bits, error bound from the permanent              [Joldes17]
//! expansion       sums of nonoverlapping f64, fixed capacity; exact     [Shewchuk97]
//! integer         up to 2100 bits a coordinate; exact, no range to leave
//! ```
//!
//! `docs/accuracy.md` derives the bounds; tests recompute them with the text that the filters run.

#![no_std]
#![forbid(unsafe_code)]

mod arithmetic;
pub mod ccd;
mod filter;
mod finite;
mod incircle;
mod insphere;
pub mod intersection;
pub mod linear;
pub mod moved_grid;
mod orient2d;
mod orient3d;
mod orient4d;
mod point;
mod polynomial;
mod sign;
pub mod sos;
mod stage;
pub mod staged;
pub mod stats;

pub use finite::NonFinite;
pub use incircle::{incircle, incircle_value, try_incircle};
pub use insphere::{insphere, insphere_value, try_insphere};
pub use orient2d::{orient2d, orient2d_value, try_orient2d};
pub use orient3d::{orient3d, orient3d_value, try_orient3d};
pub use orient4d::{orient4d, orient4d_value, try_orient4d};
pub use point::Point;
pub use sign::Sign;
pub use stage::Stage;
