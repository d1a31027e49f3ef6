//! Built-in surfaces of any resolution.
//!
//! Every generator gives a closed surface whose triangles are oriented outward (counterclockwise seen from
//! outside, so that the signed volume is positive), with the same bits on every machine and for any number of
//! threads. Each has a parameter struct with defaults of 5,000 to 20,000 triangles. What to expect of the
//! defaults, at any resolution that resolves them:
//!
//! | name | components | genus of each | Euler characteristic | intersects itself |
//! | --- | --- | --- | --- | --- |
//! | `sphere` | 1 | 0 | 2 | no |
//! | `two-spheres` | 2 | 0 | 4 | no |
//! | `torus` | 1 | 1 | 0 | no |
//! | `box` | 1 | 0 | 2 | no |
//! | `dumbbell` | 1 | 0 | 2 | no |
//! | `two-boxes` | 2 | 0 | 4 | yes, in a closed curve |
//! | `nested-boxes` | 2 | 0 | 4 | no; winding number 2 inside |
//! | `box-with-void` | 2 | 0 | 4 | no; winding number 0 inside |
//! | `coincident-boxes` | 2 | 0 | 4 | yes, in coplanar triangles |
//! | `ring-overlap` | 1 | 0 | 2 | yes |
//! | `helix-overlap` | 1 | 0 | 2 | yes |
//! | `trefoil-overlap` | 1 | 1 | 0 | yes, at three crossings |
//! | `figure-eight` | 1 | 1 | 0 | yes, at one crossing |
//! | `moebius` | 1 | 1 | 0 | no |
//! | `double-moebius` | 1 | 1 | 0 | yes, all along |
//! | `gyroid` | 1 | 13 | -24 | no |
//! | `text` | 4 | 0 | 8 | no |
//!
//! Does not promise: well-shaped triangles at resolutions near the size of the features, nor in the last two, which are the
//! surfaces of fields (`from_field.rs`).

mod boxes;
mod by_name;
mod dumbbell;
mod error;
mod from_field;
mod moebius;
mod rings;
mod sphere;
mod sweep;
mod torus;
mod tubes;

pub use boxes::{Box_, BoxPair, box_, coincident_boxes, nested_boxes, two_boxes};
pub use by_name::{NAMES, NamedShape, by_name};
pub use dumbbell::{Dumbbell, dumbbell};
pub use error::{MAX_LENGTH, MAX_SHAPE_SAMPLES, MAX_SHAPE_TRIANGLES, MIN_LENGTH, ShapeError};
pub use from_field::{GyroidBall, TextSurface, gyroid_ball, text_surface};
pub use moebius::{Moebius, double_moebius, moebius};
pub use sphere::{Sphere, TwoSpheres, sphere, two_spheres};
pub use sweep::{Sweep, sweep};
pub use torus::{Torus, torus};
pub use tubes::{
    FigureEight, HelixOverlap, RingOverlap, TrefoilOverlap, figure_eight, helix_overlap, ring_overlap,
    trefoil_overlap,
};
