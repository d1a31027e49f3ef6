//! Tests of `welter_meshing::spatial`.
