//! Tests of `welter_meshing::surface`.
