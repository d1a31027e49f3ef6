//! Number types in which the predicates' polynomials are evaluated.

pub(crate) mod arena;
pub(crate) mod double_double;
pub(crate) mod error_free;
pub(crate) mod expansion;
pub(crate) mod fixed_point;
pub(crate) mod lattice;
pub(crate) mod scaled;
pub(crate) mod small;
pub(crate) mod univariate;
mod wide;
