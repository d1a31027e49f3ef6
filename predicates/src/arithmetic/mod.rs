//! Number types in which the predicates' polynomials are evaluated.

pub(crate) mod fixed_point;
pub(crate) mod lattice;
pub(crate) mod scaled;
mod wide;
