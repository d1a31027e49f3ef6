//! How a query is decided: [`Method`].
//!
//! To add a method: a variant of [`Method`] with a line of help, its name in [`Method::name`], and one arm of
//! [`Method::decider`], which gives a function for each [`Kind`]. A method that does not tell which stage decided gives
//! `settled: None`; the report then has no shares of stages.

use super::kind::Kind;
use clap::ValueEnum;
use welter_predicates::ccd::{Stage, parity, spacetime, staged};
use welter_tracking::queries::Query;

/// A method, by the name that the command line knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Method {
    /// Every contact in the closed time step, decided exactly
    Exact,
    /// Root parity (Brochu 2012): contacts on the boundary, or an odd number inside; exact, but an even number is not seen
    Parity,
    /// Swept simplices in space-time (Brochu 2012): exact and watertight, but between its ends the step is not straight
    Spacetime,
}

/// Groups of stages, as the report counts them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Settled {
    /// The primitives stay apart along an axis or another direction.
    Culled,
    /// Rounded arithmetic with proven bounds.
    Filtered,
    /// Exact arithmetic.
    Exact,
}

impl Settled {
    pub(super) const ALL: [Self; 3] = [Self::Culled, Self::Filtered, Self::Exact];

    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Culled => "culled",
            Self::Filtered => "filtered",
            Self::Exact => "exact",
        }
    }
}

impl From<Stage> for Settled {
    fn from(stage: Stage) -> Self {
        match stage {
            Stage::Boxes | Stage::Direction => Self::Culled,
            Stage::Subdivision | Stage::DoubleDouble => Self::Filtered,
            Stage::Ends | Stage::Exact | Stage::NonFinite => Self::Exact,
        }
    }
}

/// An answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Decision {
    pub(super) collides: bool,
    /// The stage that gave it, where the method tells.
    pub(super) settled: Option<Settled>,
}

impl From<(bool, Stage)> for Decision {
    fn from((collides, stage): (bool, Stage)) -> Self {
        Self { collides, settled: Some(stage.into()) }
    }
}

/// Of a method that does not tell its stages.
impl From<bool> for Decision {
    fn from(collides: bool) -> Self {
        Self { collides, settled: None }
    }
}

/// Decides a query.
pub(super) type Decider = fn(&Query) -> Decision;

/// Vertices of a query as its indices: each query has four of its own.
const INDICES: [u32; 4] = [0, 1, 2, 3];

impl Method {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Parity => "parity",
            Self::Spacetime => "spacetime",
        }
    }

    /// The function that decides queries of the kind.
    pub(super) fn decider(self, kind: Kind) -> Decider {
        match (self, kind) {
            (Self::Exact, Kind::EdgeEdge) => |q| staged::edge_edge(q.t0, q.t1).into(),
            (Self::Exact, Kind::VertexFace) => |q| staged::vertex_face(q.t0, q.t1).into(),
            (Self::Parity, Kind::EdgeEdge) => |q| parity::edge_edge(q.t0, q.t1).certain().into(),
            (Self::Parity, Kind::VertexFace) => |q| parity::vertex_face(q.t0, q.t1).certain().into(),
            (Self::Spacetime, Kind::EdgeEdge) => |q| spacetime::edge_edge(q.t0, q.t1, INDICES).into(),
            (Self::Spacetime, Kind::VertexFace) => |q| spacetime::vertex_face(q.t0, q.t1, INDICES).into(),
        }
    }
}
