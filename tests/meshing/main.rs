//! Integration tests of `welter_meshing`.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a test reports by panic and print"
)]

mod cut_cells;
mod distance;
mod io;
mod isosurface;
mod mesher;
mod plane;
mod remesh;
mod shapes;
mod spatial;
mod surface;
mod volume_files;
mod volumetric;
