//! Good triangles: [`equilateral`] makes those of a surface near equilateral; [`starting_mesh`] does so with
//! the surface of a field.
//!
//! # What it promises
//! * The result is closed, oriented and free of self-intersection, as the surface it came from: every change
//!   on the way is admitted by exact predicates only ([`EmbeddedMesh`](crate::surface::EmbeddedMesh) is kept,
//!   not restored).
//! * It has the same components, each of the same genus, nested as before. Nothing vanishes, however small.
//! * The same bits for any number of threads: it is serial. Scaling surface, field and edge length by a power
//!   of two scales the result bit for bit.
//!
//! # What it does not promise
//! * Angles and edge lengths: they are reached by trial and told in the report. On smooth fields whose
//!   features are several edge lengths wide, smallest angles of 30 degrees and a distance of about second
//!   order were measured (1.6 to 2.3; `benches/record/remesh.txt`); where the surface is not resolved, or
//!   parts of it are closer to each other than triangles are flat, changes are refused and thin triangles
//!   stay.
//! * Creases: corners and ridges of a field are not kept sharp, as vertices move along them and across.
//! * Every vertex on the surface: one whose field is NaN, or has no zero within half an edge length along the
//!   normal, or whose way there is barred, stays where it is. The report counts these.
//!
//! # Method
//! Isotropic remeshing \[Botsch04\] with vertices on the zero set of the field: splits, collapses, flips and
//! tangential smoothing in rounds (`rounds`), then a local search for the worst triangles (`worst`). All are
//! instances of one change, the disc that is joined to an apex (`workpiece`).
//!
//! # Complexity
//! Near linear in the number of triangles before and after (measured: power 1.18 from 2,000 to 155,000, for
//! caches), as long as those of the surface given have sizes that differ little; a triangle that is much
//! larger than the others is looked at from all of them until it is split.

mod buckets;
pub mod connectivity;
mod edits;
mod equilateral;
mod error;
mod projection;
mod report;
mod rounds;
mod shape;
mod starting;
mod workpiece;
mod worst;

pub use equilateral::{Equilateral, MOST_TRIANGLES, equilateral};
pub use error::RemeshError;
pub use report::{EdgeLengths, RemeshReport};
pub use starting::{StartingMesh, starting_mesh};
