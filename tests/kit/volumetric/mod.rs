//! Volumetric meshes: built sheet by sheet ([`Sheets`]) or at random ([`random`]), and slow obvious twins of what is
//! computed of them.

mod cells;
mod coarse;
mod sheets;

pub use cells::{Homology, homology_of_hexahedra, homology_of_tetrahedra};
pub use coarse::coarse_by_pairs;
pub use sheets::{Sheets, random};
