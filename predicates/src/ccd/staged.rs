//! The queries with the [`Stage`](super::Stage) that settled each: for benchmarks, rate tests and tuning.
//!
//! They cost what the plain functions cost.
//!
//! ```
//! use welter_predicates::ccd::{Stage, staged};
//! let face = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
//! let v = |z| [[0.0, 0.0, z], face[0], face[1], face[2]];
//! assert_eq!(staged::vertex_face(v(2.0), v(1.0)), (false, Stage::Boxes));
//! assert_eq!(staged::vertex_face(v(1.0), v(0.0)), (true, Stage::Ends));
//! ```

pub use super::query::staged_edge_edge as edge_edge;
pub use super::query::staged_vertex_face as vertex_face;
pub use super::query::staged_vertex_segment_2d as vertex_segment_2d;
