//! The surface of a tracker: triangles that change while they move.
//!
//! # What it computes
//! [`MovingSurface`] holds positions, masses, named attributes and connectivity, and carries all of them
//! through five operations: an edge is split, flipped or collapsed; triangles are replaced by others; the fans of a
//! vertex part. It keeps a log of them. Two more take in a mesh: beside the surface ([`MovingSurface::append`]), or as the union with it
//! ([`MovingSurface::unite`]).
//!
//! # What it promises
//! * After every operation the surface is admissible \[Brochu12, section 3.2.1\]: each edge has one triangle, or as
//!   many one way as the other; no two triangles have the same corners. What would break that is refused beforehand,
//!   with the place. [`MovingSurface::check`] finds from scratch whether anything is broken.
//! * Edges with any number of triangles are split, flipped and collapsed like others, and so are those of open
//!   surfaces.
//! * What an operation would do besides (edges that join, holes that open, triangles that cancel, vertices that go or
//!   become singular) is told before anything is changed: [`MovingSurface::consequences`].
//! * Attributes follow the rules that the user gives: [`Rule`].
//! * The log tells the whole history: [`EventLog`].
//! * The same calls give the same bits.
//!
//! # What it does not promise
//! Anything about geometry, but for the union: whether triangles intersect, which edges are to be changed, where vertices go. Positions
//! are carried along, on straight lines between the ends of edges.
//!
//! # Method
//! An operation is a [`Plan`], made for one state, and [`MovingSurface::apply`] carries it out. Plans come down to
//! one primitive, triangles that get other corners, go or come (`connectivity/change.rs`), and to one table of where
//! values come from (`attributes/transfer.rs`).
//!
//! # Complexity
//! An operation costs about as much as the stars that it touches, whatever the size of the surface. Consequences compare
//! the triangles there with each other, so they cost the square of their number, which shows at vertices of thousands.
//! Compaction is linear in the number of elements.

mod append;
mod attributes;
mod connectivity;
mod log;
mod mass;
mod moving_surface;
mod operations;
mod union;

pub use append::AppendError;
pub use attributes::{Attribute, AttributeError, AttributeSet, AttributeValue, CustomRule, Inherited, Rule};
pub use connectivity::{
    ConnectivityDefect, Consequences, DoubledTriangles, HalfEdge, RadialConnectivity, Refusal, SurfaceDefects,
};
pub use log::{EdgeChange, Event, EventKind, EventLog, TriangleChange, VertexChange};
pub use mass::MassRule;
pub use moving_surface::{MovingSurface, Renumbering, StateDefect, VertexValueError};
pub use operations::{Outcome, Plan};
pub use union::{UnionError, UnionObstacle, UnionOutcome, UnionParameters, UnionReport};
