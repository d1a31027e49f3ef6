//! The commands, one a file.

pub(crate) mod ccd;
pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod demo;
pub(crate) mod doctor;
pub(crate) mod info;
pub(crate) mod isosurface;
pub(crate) mod mesh;
pub(crate) mod new;
pub(crate) mod render;
pub(crate) mod replay;
pub(crate) mod report;
pub(crate) mod shape;
pub(crate) mod sim;
pub(crate) mod track;
pub(crate) mod view;
