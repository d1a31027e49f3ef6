//! Tests of `welter_meshing::isosurface`.

mod extraction;
mod naive;
mod squares;
mod table;
