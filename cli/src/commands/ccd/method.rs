//! How a query is decided: [`Method`].
//!
//! To add a method: a variant of [`Method`] with a line of help, its name in [`Method::name`], and one arm of
//! [`Method::decider`], which gives a function for each [`Kind`]. A method that does not tell which stage decided gives
//! `settled: None`; the report then has no shares of stages.

use super::kind::Kind;
use clap::ValueEnum;
use welter_predicates::ccd::{Stage, staged};
use welter_tracking::queries::Query;

/// A method, by the name that the command line knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Method {
    /// Every contact in the closed time step, decided exactly
    Exact,
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
            Stage::Subdivision => Self::Filtered,
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

/// Decides a query.
pub(super) type Decider = fn(&Query) -> Decision;

impl Method {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
        }
    }

    /// The function that decides queries of the kind.
    pub(super) fn decider(self, kind: Kind) -> Decider {
        match (self, kind) {
            (Self::Exact, Kind::EdgeEdge) => |q| staged::edge_edge(q.t0, q.t1).into(),
            (Self::Exact, Kind::VertexFace) => |q| staged::vertex_face(q.t0, q.t1).into(),
        }
    }
}
