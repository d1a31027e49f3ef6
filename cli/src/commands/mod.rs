//! The commands, one a file.

pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod doctor;
pub(crate) mod info;
pub(crate) mod shape;
