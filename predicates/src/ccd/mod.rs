//! Exact continuous collision detection: does a moving primitive touch another during a time step?
//!
//! Vertices move on straight lines at constant speed from their place at time 0 to their place at time 1.
//!
//! # Promises
//! * The answer is right for every finite `f64`: contacts at one time or at several, tangential ones, coplanar and
//!   collinear motion, degenerate and resting primitives, subnormal numbers and 1e308.
//! * Primitives are closed sets and the time step is the closed interval [0, 1].
//! * The answer depends on the given numbers alone. It is the same under renaming of vertices and axes, mirroring,
//!   reversal of time and scaling by powers of two.
//! * No allocation, no recursion; the worst case is bounded by a constant.
//!
//! # Non-promises
//! * Motion on other than straight lines, and contact within a distance.
//! * Where and when: these are constructions, not predicates.
//!
//! [`spacetime`] asks the same of another motion, made of flat pieces of space-time.
//!
//! # Method
//! Stages, each of which leaves to the next what it cannot decide:
//!
//! 1. boxes, by exact comparison of coordinates (`settle`);
//! 2. separating directions, in rounded arithmetic with proven bounds (`separation`);
//! 3. the step cut into intervals that rounded arithmetic with proven bounds can decide (`subdivision`, and `planar` for
//!    motion in a coordinate plane);
//! 4. contact at the ends of the step, by [`crate::intersection`];
//! 5. as 3., in double-double numbers;
//! 6. the complete decision in exact integers (`decide`, whose head states the algorithm and its proof).
//!
//! Cost, measured: 5 to 25 ns where boxes or a direction decide, 0.2 to 0.6 microseconds in intervals of `f64`, 1 to 10 in double-double numbers, up to
//! 10 in integers at a single root, 50 at double or several roots and 140 for such roots a few ulps from degenerate. Where exponents fill
//! the whole range the integers have thousands of words: a quarter of a second is the most that was seen, and the sizes of the arenas
//! bound it.
//!
//! In contrast to crossing parity ([`parity`], \[Brochu12\]) an even number of contacts is seen, and no ray is cast. Which stage settled
//! a query is told by [`staged`].

mod at_root;
pub mod batch;
mod corners;
mod decide;
mod exact;
mod moment;
mod number;
pub mod parity;
mod planar;
mod query;
mod separation;
mod settle;
pub mod spacetime;
mod stage;
pub mod staged;
mod subdivision;
mod trajectory;

pub use query::{
    ContactTimes, edge_edge, edge_edge_during, edge_edge_times, vertex_face, vertex_face_during,
    vertex_face_times, vertex_segment_2d, vertex_segment_2d_during, vertex_segment_2d_times,
};
pub use stage::Stage;

/// The whole time step.
const STEP: [f64; 2] = [0.0, 1.0];

/// Corners of the polygon that holds the origin when a vertex touches a face: differences of the points v, f0, f1, f2.
const VERTEX_FACE: [(usize, usize); 3] = [(1, 0), (2, 0), (3, 0)];

/// The same for the points ea0, ea1, eb0, eb1, in order around the parallelogram.
const EDGE_EDGE: [(usize, usize); 4] = [(0, 2), (1, 2), (1, 3), (0, 3)];

/// The same for the points v, s0, s1 of the plane.
const VERTEX_SEGMENT: [(usize, usize); 2] = [(1, 0), (2, 0)];
