//! Tests of `welter_meshing::io`.
