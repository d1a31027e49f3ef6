//! The broad phase: which vertices, edges and triangles of a moving surface may come near each other.
//!
//! # What it computes
//! [`BroadPhase`] holds a box for each element, at rest or swept along a step ([`Motion`]), and lists the pairs of
//! elements whose boxes are within a distance: vertices with triangles and edges with edges (proximity, collision), edges
//! with triangles and triangles with each other (intersection), also only those that pass a test, which is then made
//! within the parallel search; those near one element; or those near any box, such as that of a motion that a
//! change of the mesh would amount to \[Brochu12, sections 3.2.2 to 3.2.7\].
//!
//! # What it promises
//! * Nothing is missed: a pair is left out only if its boxes, the exact hulls of the coordinates, are farther apart
//!   than the distance along an axis, without any tolerance, whatever the finite coordinates. Rounding adds pairs whose
//!   gap is above the distance by half a unit in the last place at most.
//! * Lists are sorted by ids. They depend on boxes and distance alone, not on the changes that led to them, nor on
//!   the number of threads. Everything multiplied by a power of two gives the same lists.
//! * Ends that are not finite, and distances that are not, are refused; a box asked about may be infinite.
//!
//! # What it does not promise
//! * That rounded positions between the ends of a motion stay within the box: the lines are exact ones.
//! * A bound on the number of pairs: n elements at one place give n(n - 1)/2. Building does not suffer from them.
//! * To notice what it is not told. Changes of the surface reach it by [`BroadPhase::follow`], [`BroadPhase::moved`] or
//!   [`BroadPhase::refresh`].
//!
//! # Method
//! A binary tree of boxes for each kind of element (`tree`), split at medians, refitted when everything moves and
//! balanced by rebuilding parts when elements come and go. All pairs come from simultaneous descents. Reasons:
//! * Grids, as in \[Brochu12\], need a cell size. A triangle as large as all lies in all cells or in a level of
//!   its own that every query visits, and one far vertex leaves the rest in one cell; so do Morton codes, whose bits are
//!   shared out over the scene. Medians compare coordinates with each other only.
//! * The static hierarchy of `welter_meshing::spatial` has `f32` boxes in a frame of the scene, which changes when the
//!   scene grows, and takes no elements in or out. Here boxes are `f64`: 64 bytes a node, no frame.
//!
//! # Complexity
//! For n elements: building O(n log n); refreshing O(n); a change O(log^2 n) amortised for each element touched,
//! O(n log n) at worst; pairs O(n + k log k) in practice for k pairs whose boxes are near, O(n^2) at worst. 132 bytes an
//! element, twice that during a refresh after elements came or went.

mod error;
mod gap;
mod motion;
mod surface;
mod tree;

pub use error::BroadPhaseError;
pub use motion::Motion;
pub use surface::BroadPhase;
