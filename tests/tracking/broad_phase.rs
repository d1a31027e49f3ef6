//! The broad phase, against all pairs.

mod changes;
mod hostile;
mod laws;
mod pairs;
mod twin;
