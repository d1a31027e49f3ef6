//! Tests of `welter_meshing::shapes`.
