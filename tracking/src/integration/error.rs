//! Why a step cannot be resolved or accepted: [`IntegrationError`].

use crate::broad_phase::BroadPhaseError;
use glam::DVec3;
use thiserror::Error;
use welter_meshing::Cancelled;
use welter_meshing::surface::{TriId, VertexId};

/// A pair of triangles that meet in more than they share, with all that is needed to ask again.
#[derive(Clone, Debug, PartialEq)]
pub struct Tangle {
    /// Which triangles; the smaller id first.
    pub triangles: [TriId; 2],
    /// Their corners.
    pub corners: [[VertexId; 3]; 2],
    /// Where the corners are on the surface.
    pub before: [[DVec3; 3]; 2],
    /// Where they meet: at the ends that were refused; as `before` if the surface itself is tangled.
    pub after: [[DVec3; 3]; 2],
}

/// Why a step is refused. The surface is as it was before, in every case.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum IntegrationError {
    /// The ends are none of this surface, or one is not finite; or the broad phase has not followed the surface.
    #[error(transparent)]
    BroadPhase(#[from] BroadPhaseError),
    /// The operation was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A parameter is out of its range.
    #[error("{parameter} is {value}, must be {range}")]
    Parameter {
        /// Its field name.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// The range it must lie in.
        range: &'static str,
    },
    /// The surface intersects itself before the step.
    #[error(
        "the surface intersects itself before the step: {} pairs of triangles, the first {} and {}",
        pairs.len(), first.triangles[0].0, first.triangles[1].0
    )]
    NotEmbedded {
        /// All pairs of triangles that meet in more than they share, sorted.
        pairs: Vec<[TriId; 2]>,
        /// The first of them.
        first: Box<Tangle>,
    },
    /// The surface would intersect itself at the ends given. Ends that [`resolve`](super::resolve) returned for a surface
    /// that was embedded never do: then this is a bug, and `first` holds what is needed to find it.
    #[error(
        "the surface would intersect itself after the step: {} pairs of triangles, the first {} and {}",
        pairs.len(), first.triangles[0].0, first.triangles[1].0
    )]
    Intersection {
        /// All pairs of triangles that would meet in more than they share, sorted.
        pairs: Vec<[TriId; 2]>,
        /// The first of them.
        first: Box<Tangle>,
    },
}
