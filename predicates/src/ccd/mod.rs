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
//! # Method
//! Stages, each of which leaves to the next what it cannot decide:
//!
//! 1. boxes, by exact comparison of coordinates;
//! 2. separating directions, in rounded arithmetic with proven bounds (`separation`);
//! 3. crossings well inside or well outside, in rounded arithmetic with proven bounds (`crossing`);
//! 4. contact at the ends of the step, by [`crate::intersection`];
//! 5. the complete decision in exact integers (`decide`, whose head states the algorithm and its proof).
//!
//! In contrast to crossing parity \[Brochu12\] an even number of contacts is seen, and no ray is cast. Cost: of the public queries
//! that the tests read, nine in ten end at the first two stages. The last takes up to about a tenth of a millisecond
//! for coordinates of ordinary size, and up to a fraction of a second where exponents fill the whole range.

mod crossing;
mod decide;
mod query;
mod separation;
mod stage;
pub mod staged;

pub use query::{
    ContactTimes, edge_edge, edge_edge_during, edge_edge_times, vertex_face, vertex_face_during,
    vertex_face_times, vertex_segment_2d, vertex_segment_2d_during, vertex_segment_2d_times,
};
pub use stage::Stage;
