//! Pairs of elements that may touch, and what of their motion counts: [`ElementPair`], [`Contact`].

use crate::collision::{TimeOfImpactParameters, time_of_impact};
use crate::surface::RadialConnectivity;
use glam::DVec3;
use welter_meshing::surface::{EdgeId, TriId, VertexId};
use welter_predicates::ccd;

/// Two elements without a common vertex that may touch each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ElementPair {
    /// A vertex and a triangle of which it is no corner.
    VertexTriangle(VertexId, TriId),
    /// Two edges, the smaller id first.
    EdgeEdge(EdgeId, EdgeId),
}

impl ElementPair {
    /// Two edges in any order.
    pub(super) fn edges(a: EdgeId, b: EdgeId) -> Self {
        Self::EdgeEdge(a.min(b), a.max(b))
    }

    /// The vertices: the vertex and the corners of the triangle, or the ends of the edges.
    #[must_use]
    pub fn vertices(&self, mesh: &RadialConnectivity) -> [VertexId; 4] {
        match *self {
            Self::VertexTriangle(v, t) => {
                let [a, b, c] = mesh.corners(t);
                [v, a, b, c]
            }
            Self::EdgeEdge(e, f) => {
                let ([a, b], [c, d]) = (mesh.ends(e), mesh.ends(f));
                [a, b, c, d]
            }
        }
    }

    /// Whether the elements touch on the way from some places of their vertices to others: exact; and the stage that
    /// told.
    pub(super) fn collides(&self, from: [DVec3; 4], to: [DVec3; 4]) -> (bool, ccd::Stage) {
        match self {
            Self::VertexTriangle(..) => ccd::staged::vertex_face(from, to),
            Self::EdgeEdge(..) => ccd::staged::edge_edge(from, to),
        }
    }

    /// The contact when they first touch; none if they do not.
    pub(super) fn impact(
        &self,
        vertices: [VertexId; 4],
        from: [DVec3; 4],
        to: [DVec3; 4],
    ) -> Option<Contact> {
        let parameters = TimeOfImpactParameters::default();
        let impact = match self {
            Self::VertexTriangle(..) => time_of_impact::vertex_face(from, to, &parameters),
            Self::EdgeEdge(..) => time_of_impact::edge_edge(from, to, &parameters),
        };
        let impact = impact.expect("positions and ends are finite, the parameters are the default ones")?;
        Some(Contact {
            vertices,
            weights: self.signed(impact.weights),
            normal: DVec3::from_array(impact.normal),
        })
    }

    /// Weights that are negative for the second element, so that a weighted sum is a difference.
    pub(super) fn signed(&self, [a, b, c, d]: [f64; 4]) -> [f64; 4] {
        match self {
            Self::VertexTriangle(..) => [a, -b, -c, -d],
            Self::EdgeEdge(..) => [a, b, -c, -d],
        }
    }
}

/// Where two elements touch or nearly touch, and across which plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contact {
    pub(super) vertices: [VertexId; 4],
    /// Weights of the vertices in the vector from the point of the second element to that of the first: they sum to 0.
    pub(super) weights: [f64; 4],
    /// Unit vector from the second element to the first.
    pub(super) normal: DVec3,
}

impl Contact {
    /// The weighted sum of four vectors.
    pub(super) fn weighted(&self, of: [DVec3; 4]) -> DVec3 {
        let [a, b, c, d]: [DVec3; 4] = std::array::from_fn(|i| self.weights[i] * of[i]);
        (a + b) + (c + d)
    }
}
