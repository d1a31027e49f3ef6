//! [`RadialConnectivity::check`]: every invariant, from scratch.

use super::{HalfEdge, NO_HALF_EDGE, NO_VERTEX, RadialConnectivity, SurfaceDefects};
use thiserror::Error;
use welter_meshing::surface::{EdgeId, TriId, VertexId};

/// Where a [`RadialConnectivity`] is broken: a bug of this library.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ConnectivityDefect {
    /// A triangle names a vertex twice, or one that does not exist.
    #[error("triangle {} has corners {}, {}, {}", triangle.0, corners[0].0, corners[1].0, corners[2].0)]
    Corners {
        /// Which triangle.
        triangle: TriId,
        /// Its corners.
        corners: [VertexId; 3],
    },
    /// A half-edge is on an edge that is not in use or has other ends.
    #[error("half-edge {} is not on edge {}", half_edge.0, edge.0)]
    Edge {
        /// Which half-edge.
        half_edge: HalfEdge,
        /// The edge kept for it.
        edge: EdgeId,
    },
    /// The cycle around an edge leads to another edge or passes a wrong number of half-edges.
    #[error("the cycle around edge {} passes {cycle} half-edges of {half_edges}", edge.0)]
    Cycle {
        /// Which edge.
        edge: EdgeId,
        /// How many half-edges the cycle passes before it is left or too long.
        cycle: usize,
        /// How many half-edges name the edge.
        half_edges: usize,
    },
    /// The list of a vertex leads elsewhere, or its links or its count are wrong.
    #[error("the list of vertex {} passes {list} of its {corners} corners", vertex.0)]
    Star {
        /// Which vertex.
        vertex: VertexId,
        /// How many corners the list passes before it is left or too long.
        list: usize,
        /// How many corners there are.
        corners: usize,
    },
    /// Two edges with the same ends.
    #[error("two edges join vertices {} and {}", vertices[0].0, vertices[1].0)]
    DoubleEdge {
        /// The ends.
        vertices: [VertexId; 2],
    },
    /// Free ids are not those that are not in use, each once.
    #[error("the free {elements} are not those out of use")]
    Free {
        /// Of what.
        elements: &'static str,
    },
    /// All links are right, but the surface is not admissible.
    #[error(transparent)]
    Inadmissible(#[from] SurfaceDefects),
}

impl RadialConnectivity {
    /// Whether every invariant holds. Near linear in the number of triangles.
    ///
    /// # Errors
    /// [`ConnectivityDefect`]: the first that is found.
    pub fn check(&self) -> Result<(), ConnectivityDefect> {
        let mut corners_at = vec![0_usize; self.vertex_slots()];
        let mut sides_on = vec![0_usize; self.edge_slots()];
        for triangle in self.triangles() {
            let corners = self.corners(triangle);
            let [a, b, c] = corners;
            if a == b || b == c || c == a || corners.iter().any(|v| v.index() >= self.vertex_slots()) {
                return Err(ConnectivityDefect::Corners { triangle, corners });
            }
            for half_edge in (0..3).map(|k| HalfEdge::of(triangle, k)) {
                corners_at[self.tail(half_edge).index()] += 1;
                let edge = self.edge(half_edge);
                let ways = [
                    [self.tail(half_edge), self.head(half_edge)],
                    [self.head(half_edge), self.tail(half_edge)],
                ];
                if !self.has_edge(edge) || !ways.contains(&self.ends(edge)) {
                    return Err(ConnectivityDefect::Edge { half_edge, edge });
                }
                sides_on[edge.index()] += 1;
            }
        }
        self.check_cycles(&sides_on)?;
        self.check_stars(&corners_at)?;
        let mut ends: Vec<[VertexId; 2]> =
            self.edges().map(|e| self.ends(e)).map(|[a, b]| [a.min(b), a.max(b)]).collect();
        ends.sort_unstable();
        if let Some(pair) = ends.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(ConnectivityDefect::DoubleEdge { vertices: pair[0] });
        }
        let free = |list: Vec<u32>, unused: Vec<u32>, elements| {
            let mut list = list;
            list.sort_unstable();
            if list == unused { Ok(()) } else { Err(ConnectivityDefect::Free { elements }) }
        };
        let unused =
            |slots: usize, used: &dyn Fn(u32) -> bool| (0..slots as u32).filter(|&i| !used(i)).collect();
        free(
            self.free_vertices.iter().map(|v| v.0).collect(),
            unused(self.vertex_slots(), &|i| self.has_vertex(VertexId(i))),
            "vertices",
        )?;
        free(
            self.free_edges.iter().map(|e| e.0).collect(),
            unused(self.edge_slots(), &|i| self.has_edge(EdgeId(i))),
            "edges",
        )?;
        free(
            self.free_triangles.iter().map(|t| t.0).collect(),
            unused(self.triangle_slots(), &|i| self.has_triangle(TriId(i))),
            "triangles",
        )?;
        let defects = SurfaceDefects::of(self);
        if defects.is_empty() { Ok(()) } else { Err(defects.into()) }
    }

    fn is_in_use(&self, half_edge: HalfEdge) -> bool {
        half_edge != NO_HALF_EDGE && self.has_triangle(half_edge.triangle())
    }

    fn check_cycles(&self, sides_on: &[usize]) -> Result<(), ConnectivityDefect> {
        for edge in (0..self.edge_slots() as u32).map(EdgeId) {
            let first = self.edges[edge.index()].first;
            let (mut cycle, mut h) = (0, first);
            while self.is_in_use(h) && self.edge(h) == edge && cycle <= sides_on[edge.index()] {
                cycle += 1;
                h = self.links[h.0 as usize].radial;
                if h == first {
                    break;
                }
            }
            let stray = cycle == 0 && first != NO_HALF_EDGE;
            if cycle != sides_on[edge.index()] || h != first || stray {
                return Err(ConnectivityDefect::Cycle { edge, cycle, half_edges: sides_on[edge.index()] });
            }
        }
        Ok(())
    }

    fn check_stars(&self, corners_at: &[usize]) -> Result<(), ConnectivityDefect> {
        for vertex in (0..self.vertex_slots() as u32).map(VertexId) {
            let slot = self.vertices[vertex.index()];
            let corners = corners_at[vertex.index()];
            let (mut list, mut previous, mut h) = (0, NO_HALF_EDGE, slot.first);
            while self.is_in_use(h)
                && self.tail(h) == vertex
                && self.links[h.0 as usize].previous == previous
                && list <= corners
            {
                list += 1;
                (previous, h) = (h, self.links[h.0 as usize].next);
            }
            if list != corners || h != NO_HALF_EDGE || slot.triangles as usize != corners {
                return Err(ConnectivityDefect::Star { vertex, list, corners });
            }
        }
        // A triangle out of use keeps no corner.
        let kept = |corners: &&[VertexId; 3]| corners[0] == NO_VERTEX && corners[1..] != [NO_VERTEX; 2];
        if self.triangles.iter().any(|corners| kept(&corners)) {
            return Err(ConnectivityDefect::Free { elements: "triangles" });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::shapes::{Sphere, sphere};

    #[test]
    fn each_invariant_has_a_violation_that_is_found() {
        let mesh = sphere(&Sphere { edge_length: 0.8, ..Sphere::default() }).unwrap();
        let good = RadialConnectivity::new(&mesh).unwrap();
        assert_eq!(good.check(), Ok(()));
        let broken = |change: fn(&mut RadialConnectivity)| {
            let mut mesh = good.clone();
            change(&mut mesh);
            mesh.check().unwrap_err()
        };
        let first = |vertex: u32| VertexId(vertex);
        let corners = broken(|mesh| mesh.triangles[0][0] = mesh.triangles[0][1]);
        assert!(matches!(corners, ConnectivityDefect::Corners { triangle: TriId(0), .. }));
        let edge = broken(|mesh| {
            let edge = mesh.links[1].edge;
            mesh.links[1].edge = std::mem::replace(&mut mesh.links[0].edge, edge);
        });
        assert!(matches!(edge, ConnectivityDefect::Edge { half_edge: HalfEdge(0), .. }));
        let cycle = broken(|mesh| mesh.links[0].radial = HalfEdge(0));
        assert!(matches!(cycle, ConnectivityDefect::Cycle { half_edges: 2, .. }));
        let empty = broken(|mesh| {
            mesh.edges.push(mesh.edges[0]);
        });
        assert!(matches!(empty, ConnectivityDefect::Cycle { half_edges: 0, .. }));
        let star = broken(|mesh| mesh.vertices[0].triangles += 1);
        assert!(matches!(star, ConnectivityDefect::Star { vertex, .. } if vertex == first(0)));
        let list = broken(|mesh| {
            let second = mesh.links[mesh.vertices[3].first.0 as usize].next;
            mesh.links[second.0 as usize].previous = NO_HALF_EDGE;
        });
        assert!(matches!(list, ConnectivityDefect::Star { vertex, list: 1, .. } if vertex == first(3)));
        for (free, name) in [
            (broken(|mesh| mesh.free_vertices.push(VertexId(0))), "vertices"),
            (broken(|mesh| mesh.free_edges.push(EdgeId(0))), "edges"),
            (broken(|mesh| mesh.free_triangles.push(TriId(0))), "triangles"),
        ] {
            assert_eq!(free, ConnectivityDefect::Free { elements: name });
        }
        let double = broken(|mesh| {
            // Of the two half-edges on an edge one goes to an edge of its own.
            let (one, other) = (HalfEdge(0), mesh.links[0].radial);
            let ends = mesh.ends(mesh.edge(one));
            mesh.unlink_edge(other);
            let own = mesh.new_edge(ends);
            mesh.link_edge(other, own);
        });
        assert!(matches!(double, ConnectivityDefect::DoubleEdge { .. }));
        let unbalanced = broken(|mesh| {
            // A third triangle on an edge, linked as it should be.
            let h = HalfEdge(0);
            let far =
                mesh.vertices().find(|&v| v != mesh.tail(h) && mesh.edge_between(v, mesh.tail(h)).is_none());
            let (a, b) = (mesh.tail(h), mesh.head(h));
            let corners = [a, b, far.unwrap()];
            let t = mesh.new_triangle();
            for (k, corner) in corners.into_iter().enumerate() {
                mesh.link_vertex(HalfEdge::of(t, k), corner);
            }
            for k in 0..3 {
                let ends = [corners[k], corners[(k + 1) % 3]];
                let old = if k == 0 { Some(mesh.edge(h)) } else { mesh.edge_of_other_triangle(ends, t) };
                let edge = old.unwrap_or_else(|| mesh.new_edge(ends));
                mesh.link_edge(HalfEdge::of(t, k), edge);
            }
        });
        let ConnectivityDefect::Inadmissible(defects) = unbalanced else { panic!("{unbalanced:?}") };
        assert_eq!((defects.unbalanced[0].forward, defects.unbalanced[0].backward), (2, 1));
    }

    impl RadialConnectivity {
        fn edge_of_other_triangle(&self, ends: [VertexId; 2], but: TriId) -> Option<EdgeId> {
            let half_edges =
                self.triangles().filter(|&t| t != but).flat_map(|t| (0..3).map(move |k| HalfEdge::of(t, k)));
            let mut on = half_edges.filter(|&h| {
                let ways = [[self.tail(h), self.head(h)], [self.head(h), self.tail(h)]];
                ways.contains(&ends)
            });
            on.next().map(|h| self.edge(h))
        }
    }
}
