//! The state of the surface tracker: connectivity, attributes, masses and the log.

mod append;
mod attributes;
mod construction;
mod named;
pub(crate) mod random;
mod union;
