//! Gauss quadrature on segments, triangles, tetrahedra and cubes, of any degree up to [`MAX_DEGREE`].
//!
//! # What it promises
//! * A rule of degree `d` integrates every polynomial of total degree `d` (on cubes: of degree `d` in each coordinate) without error but rounding.
//! * Weights are positive and add up to 1: the measure of the simplex is a factor of the caller's.
//!
//! # What it does not promise
//! The fewest points there can be: rules on triangles and tetrahedra are products of rules on segments.
//!
//! # Method
//! The conical product of Gauss-Jacobi rules \[Stroud71\]: a simplex is a cone over one of a dimension less, with the weight `(1 - s)^m` along its axis.
//! Nodes by Newton's method with deflation \[Karniadakis05\].

mod gauss;
mod rule;

use gauss::gauss_jacobi;
pub use rule::{CubeRule, DegreeError, MAX_DEGREE, SegmentRule, SimplexRule, TetrahedronRule, TriangleRule};
