//! What the broad phase refuses: [`BroadPhaseError`].

use glam::DVec3;
use thiserror::Error;
use welter_meshing::surface::VertexId;

/// Why a motion or a distance is refused.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BroadPhaseError {
    /// There is not one end for each vertex id.
    #[error("a motion has {ends} ends for {vertices} vertex ids")]
    Ends {
        /// How many ends were given.
        ends: usize,
        /// How many vertex ids there are, in use or free.
        vertices: usize,
    },
    /// A vertex in use would end at infinity, or nowhere.
    #[error("vertex {} would move to ({}, {}, {})", vertex.0, end.x, end.y, end.z)]
    End {
        /// Which vertex; the first.
        vertex: VertexId,
        /// Where it would end.
        end: DVec3,
    },
    /// The surface has other elements than those that were followed.
    #[error("the surface has other {elements} than were followed")]
    NotFollowed {
        /// Which kind of element; the first.
        elements: &'static str,
    },
    /// A distance is not a finite number from 0 on.
    #[error("the distance is {distance}, must be finite and not below 0")]
    Distance {
        /// The distance given.
        distance: f64,
    },
}
