//! Every place where a surface is not admissible: [`SurfaceDefects`].

use super::RadialConnectivity;
use std::fmt;
use thiserror::Error;
use welter_meshing::surface::{EdgeDefect, TriId, VertexId};

/// Triangles with the same three corners, however oriented.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DoubledTriangles {
    /// The corners, ascending.
    pub corners: [VertexId; 3],
    /// The triangles, ascending; two at least.
    pub triangles: Vec<TriId>,
}

impl fmt::Display for DoubledTriangles {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b, c] = self.corners;
        write!(f, "{} and {} ({}, {}, {})", self.triangles[0].0, self.triangles[1].0, a.0, b.0, c.0)
    }
}

/// Why a surface cannot be tracked: all of its defects \[Brochu12, section 3.2.1\].
#[derive(Clone, Debug, Default, Error, PartialEq, Eq)]
#[non_exhaustive]
pub struct SurfaceDefects {
    /// Edges with two or more triangles that do not run both ways equally often, so also those with an odd number
    /// of three or more; ascending by their vertices.
    pub unbalanced: Vec<EdgeDefect>,
    /// Triangles with the same corners, ordered by the first of them.
    pub doubled: Vec<DoubledTriangles>,
}

impl SurfaceDefects {
    /// True when there is no defect.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.unbalanced.is_empty() && self.doubled.is_empty()
    }

    pub(crate) fn of(surface: &RadialConnectivity) -> Self {
        let mut defects = Self::default();
        for edge in surface.edges() {
            let [a, b] = surface.ends(edge);
            let [low, high] = [a.min(b), a.max(b)];
            let [forward, backward] = surface.directions(edge, low);
            if !balanced(forward, backward) {
                let mut triangles: Vec<TriId> = surface.around_edge(edge).map(|h| h.triangle()).collect();
                triangles.sort_unstable();
                let triangles = triangles.into_boxed_slice();
                defects.unbalanced.push(EdgeDefect { vertices: [low, high], forward, backward, triangles });
            }
            // Each triangle is looked at once, from the edge of its two smaller corners.
            let mut thirds: Vec<(VertexId, TriId)> = surface
                .around_edge(edge)
                .map(|h| (surface.apex(h), h.triangle()))
                .filter(|&(third, _)| third > high)
                .collect();
            thirds.sort_unstable();
            for class in thirds.chunk_by(|a, b| a.0 == b.0).filter(|class| class.len() > 1) {
                let corners = [low, high, class[0].0];
                let triangles = class.iter().map(|&(_, t)| t).collect();
                defects.doubled.push(DoubledTriangles { corners, triangles });
            }
        }
        defects.unbalanced.sort_by_key(|defect| defect.vertices);
        defects.doubled.sort_by(|a, b| a.triangles.cmp(&b.triangles));
        defects
    }
}

/// Whether an edge may have so many triangles one way and the other: a boundary, or equally many.
pub(crate) fn balanced(forward: usize, backward: usize) -> bool {
    forward == backward || forward + backward == 1
}

impl RadialConnectivity {
    /// How many half-edges of an edge begin at one of its ends, and how many at the other.
    pub(crate) fn directions(&self, edge: welter_meshing::surface::EdgeId, from: VertexId) -> [usize; 2] {
        let mut counts = [0; 2];
        self.around_edge(edge).for_each(|h| counts[usize::from(self.tail(h) != from)] += 1);
        counts
    }
}

impl fmt::Display for SurfaceDefects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const NAMED: usize = 3;
        let mut parts = Vec::new();
        let mut list = |names: Vec<String>, [one, many]: [&str; 2]| {
            if !names.is_empty() {
                let what = if names.len() == 1 { one } else { many };
                let dots = if names.len() > NAMED { ", ..." } else { "" };
                let shown = names[..names.len().min(NAMED)].join(", ");
                parts.push(format!("{} {what}: {shown}{dots}", names.len()));
            }
        };
        list(
            self.unbalanced.iter().map(ToString::to_string).collect(),
            ["edge with unbalanced triangles", "edges with unbalanced triangles"],
        );
        list(
            self.doubled.iter().map(ToString::to_string).collect(),
            ["set of triangles with the same corners", "sets of triangles with the same corners"],
        );
        f.write_str(&parts.join("; "))
    }
}
