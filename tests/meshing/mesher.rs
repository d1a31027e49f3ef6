//! The volumetric mesher against the hexahedra that follow from abstract solids, against laws, and on hostile input.

mod hostile;
mod laws;
mod solids;
mod tubes;
mod unfolded;
