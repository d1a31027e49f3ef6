//! Integration tests: meshing.
mod io;
mod shapes;
mod spatial;
mod surface;
