//! Generators, exact oracles and fuzz bodies.
