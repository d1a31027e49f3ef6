//! Why a change is not made: [`Refusal`].

use super::HalfEdge;
use thiserror::Error;
use welter_meshing::surface::VertexId;

/// Why a change is refused: the surface would not be admissible.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Refusal {
    /// An edge would have triangles that do not balance.
    #[error(
        "the edge between vertices {} and {} would have {forward} triangles one way and {backward} the other",
        vertices[0].0, vertices[1].0
    )]
    Unbalanced {
        /// Its ends, the smaller id first.
        vertices: [VertexId; 2],
        /// How many triangles would run from the first end to the second.
        forward: usize,
        /// How many would run back.
        backward: usize,
    },
    /// Two triangles would have the same corners and the same orientation.
    #[error("two triangles would have the corners {}, {} and {}", corners[0].0, corners[1].0, corners[2].0)]
    Doubled {
        /// The corners in their cyclic order, the smallest first.
        corners: [VertexId; 3],
    },
    /// A triangle would have a vertex twice, or one that is not in use.
    #[error("a triangle would have the corners {}, {} and {}", corners[0].0, corners[1].0, corners[2].0)]
    Corners {
        /// The corners as they were asked for.
        corners: [VertexId; 3],
    },
    /// A vertex, edge or triangle is not in use, or a triangle is named twice.
    #[error("{element} {id} is not in use, or is named twice")]
    NotInUse {
        /// What it is.
        element: &'static str,
        /// Its id.
        id: u32,
    },
    /// Two half-edges that are to be flipped do not run along one edge in opposite directions.
    #[error("half-edges {} and {} are not opposite", half_edges[0].0, half_edges[1].0)]
    NotOpposite {
        /// Which half-edges.
        half_edges: [HalfEdge; 2],
    },
    /// A weight is not between 0 and 1 as the operation needs it.
    #[error("the fraction is {value}, must be {range}")]
    Fraction {
        /// The value given.
        value: f64,
        /// What it must be.
        range: &'static str,
    },
    /// Ids would be used up.
    #[error("the surface would have more elements than there are ids")]
    TooLarge,
}
