//! [`Connectivity::check`]: every invariant, one after the other.

use thiserror::Error;

use super::{Connectivity, HalfEdge};
use crate::surface::{TriId, VertexId};

/// Where a [`Connectivity`] is broken: a bug of this library.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ConnectivityDefect {
    /// A triangle names a vertex twice, or one that is not in use.
    #[error("triangle {} has corners {}, {}, {}", triangle.0, corners[0].0, corners[1].0, corners[2].0)]
    Corners {
        /// Which triangle.
        triangle: TriId,
        /// Its corners.
        corners: [VertexId; 3],
    },
    /// The opposite of a half-edge does not run the other way, or does not name it back.
    #[error("half-edges {} and {} are not opposite", half_edge.0, opposite.0)]
    Opposite {
        /// Which half-edge.
        half_edge: HalfEdge,
        /// Its opposite.
        opposite: HalfEdge,
    },
    /// The half-edge out of a vertex does not begin there.
    #[error("half-edge {} does not begin at vertex {}", half_edge.0, vertex.0)]
    Outgoing {
        /// Which vertex.
        vertex: VertexId,
        /// The half-edge kept for it.
        half_edge: HalfEdge,
    },
    /// Triangles at a vertex that one turn around it does not reach.
    #[error("one turn around vertex {} passes {turn} of its {triangles} triangles", vertex.0)]
    Fan {
        /// Which vertex.
        vertex: VertexId,
        /// How many triangles one turn passes.
        turn: usize,
        /// How many it has.
        triangles: usize,
    },
    /// Two edges with the same ends.
    #[error("two edges join vertices {} and {}", vertices[0].0, vertices[1].0)]
    DoubleEdge {
        /// The ends.
        vertices: [VertexId; 2],
    },
}

impl Connectivity {
    /// Whether every invariant holds. Near linear in the number of triangles.
    ///
    /// # Errors
    /// [`ConnectivityDefect`]: the first that is found.
    pub fn check(&self) -> Result<(), ConnectivityDefect> {
        let mut corners_at = vec![0_usize; self.vertex_slots()];
        for t in self.triangles() {
            let corners = self.corners(t);
            let [a, b, c] = corners;
            let in_use = |v: VertexId| v.index() < self.vertex_slots() && self.has_vertex(v);
            if a == b || b == c || c == a || !corners.into_iter().all(in_use) {
                return Err(ConnectivityDefect::Corners { triangle: t, corners });
            }
            corners.iter().for_each(|v| corners_at[v.index()] += 1);
        }
        for h in self.triangles().flat_map(|t| (0..3).map(move |k| HalfEdge::of(t, k))) {
            let o = self.opposite(h);
            let real = o.0 as usize / 3 < self.triangle_slots() && self.has_triangle(o.triangle());
            if !real || self.opposite(o) != h || self.tail(o) != self.head(h) || self.head(o) != self.tail(h)
            {
                return Err(ConnectivityDefect::Opposite { half_edge: h, opposite: o });
            }
        }
        for v in self.vertices() {
            let h = self.outgoing[v.index()];
            if !self.has_triangle(h.triangle()) || self.tail(h) != v {
                return Err(ConnectivityDefect::Outgoing { vertex: v, half_edge: h });
            }
            let (turn, triangles) = (self.valence(v), corners_at[v.index()]);
            if turn != triangles {
                return Err(ConnectivityDefect::Fan { vertex: v, turn, triangles });
            }
        }
        let mut ends: Vec<[VertexId; 2]> =
            self.edges().map(|h| (self.tail(h), self.head(h))).map(|(a, b)| [a.min(b), a.max(b)]).collect();
        ends.sort_unstable();
        match ends.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(ConnectivityDefect::DoubleEdge { vertices: pair[0] }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Box_, Sphere, Torus, box_, sphere, torus};
    use crate::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};

    fn euler(mesh: &Connectivity) -> i64 {
        mesh.vertices().count() as i64 - mesh.edges().count() as i64 + mesh.triangles().count() as i64
    }

    /// A sequence of numbers without pattern \[ONeill14\].
    fn numbers() -> impl FnMut(usize) -> usize {
        let mut state = 1_u64;
        move |below| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize % below
        }
    }

    #[test]
    fn thousands_of_random_operations_keep_every_invariant_and_the_topology() {
        let surfaces = [
            (sphere(&Sphere { edge_length: 0.6, ..Sphere::default() }).unwrap(), 2),
            (torus(&Torus { edge_length: 0.5, ..Torus::default() }).unwrap(), 0),
        ];
        for (surface, expected) in surfaces {
            let mut mesh = Connectivity::new(&surface).unwrap();
            let mut below = numbers();
            let mut done = [0; 3];
            for step in 0..4000 {
                let h = HalfEdge(below(3 * mesh.triangle_slots()) as u32);
                if !mesh.has_triangle(h.triangle()) {
                    continue;
                }
                // More collapses than splits: also the smallest surface of each topology is reached.
                match below(5) {
                    0 => {
                        mesh.split(h);
                        done[0] += 1;
                    }
                    1 | 2 if mesh.can_flip(h) => {
                        mesh.flip(h);
                        done[1] += 1;
                    }
                    3 | 4 if mesh.can_collapse(h) => {
                        mesh.collapse(h);
                        done[2] += 1;
                    }
                    _ => {}
                }
                if step % 40 == 0 {
                    assert_eq!((mesh.check(), euler(&mesh)), (Ok(()), expected));
                }
            }
            assert!(done.iter().all(|&count| count > 100), "{done:?}");
        }
    }

    #[test]
    fn a_tetrahedron_is_as_far_as_collapses_go() {
        let mut mesh =
            Connectivity::new(&box_(&Box_ { edge_length: 0.5, ..Box_::default() }).unwrap()).unwrap();
        loop {
            let some = mesh.edges().find(|&h| mesh.can_collapse(h));
            let Some(h) = some else { break };
            mesh.collapse(h);
            assert_eq!(mesh.check(), Ok(()));
        }
        assert_eq!(mesh.triangles().count(), 4);
        assert!(mesh.edges().all(|h| !mesh.can_flip(h)));
    }

    #[test]
    fn the_inverse_of_a_split_and_of_a_flip() {
        let surface = sphere(&Sphere { edge_length: 0.8, ..Sphere::default() }).unwrap();
        let before = Connectivity::new(&surface).unwrap();
        for h in before.edges().collect::<Vec<_>>() {
            let mut mesh = before.clone();
            let m = mesh.split(h);
            let back = mesh.around(m).find(|&spoke| mesh.head(spoke) == before.head(h)).unwrap();
            mesh.collapse(mesh.opposite(back));
            let sorted = |mesh: &Connectivity| {
                let mut all: Vec<_> = mesh
                    .triangles()
                    .map(|t| {
                        let mut corners = mesh.corners(t);
                        let least = (0..3).min_by_key(|&k| corners[k]).unwrap();
                        corners.rotate_left(least);
                        corners
                    })
                    .collect();
                all.sort_unstable();
                all
            };
            assert_eq!(sorted(&mesh), sorted(&before));
            if before.can_flip(h) {
                let mut mesh = before.clone();
                mesh.flip(h);
                mesh.flip(HalfEdge::of(h.triangle(), 0));
                assert_eq!(sorted(&mesh), sorted(&before));
            }
        }
    }

    #[test]
    fn what_is_no_manifold_is_refused_with_its_place() {
        let tetrahedron = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let second = |name: fn(u32) -> u32| tetrahedron.map(|t| t.map(name));
        let build = |more: [[u32; 3]; 4]| {
            let triangles = [tetrahedron, more].concat();
            let positions = (0..8).map(f64::from).map(|i| glam::DVec3::new(i, i * i, i * i * i)).collect();
            let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
            Connectivity::new(&ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap())
        };
        let edge = build(second(|v| if v < 2 { v } else { v + 2 })).unwrap_err();
        assert_eq!(
            edge,
            super::super::NotManifold::Edge { vertices: [VertexId(0), VertexId(1)], triangles: 4 }
        );
        let vertex = build(second(|v| if v < 1 { v } else { v + 3 })).unwrap_err();
        assert_eq!(vertex, super::super::NotManifold::Vertex { vertex: VertexId(0) });
        assert!(build(second(|v| v + 4)).is_ok());
    }

    #[test]
    fn each_invariant_has_a_violation_that_is_found() {
        let surface = sphere(&Sphere { edge_length: 0.8, ..Sphere::default() }).unwrap();
        let good = Connectivity::new(&surface).unwrap();
        let broken = |change: fn(&mut Connectivity)| {
            let mut mesh = good.clone();
            change(&mut mesh);
            mesh.check().unwrap_err()
        };
        let corners = broken(|mesh| mesh.triangles[0][0] = mesh.triangles[0][1]);
        assert!(matches!(corners, ConnectivityDefect::Corners { triangle: TriId(0), .. }));
        let opposite = broken(|mesh| mesh.opposite.swap(0, 1));
        assert!(matches!(opposite, ConnectivityDefect::Opposite { half_edge: HalfEdge(0), .. }));
        let outgoing = broken(|mesh| mesh.outgoing[0] = mesh.outgoing[1]);
        assert!(matches!(outgoing, ConnectivityDefect::Outgoing { vertex: VertexId(0), .. }));
        let fan = broken(|mesh| {
            // All triangles of one vertex go to a far one.
            let (from, to) = (VertexId(0), VertexId(11));
            for h in mesh.around(from).collect::<Vec<_>>() {
                mesh.triangles[h.triangle().index()][h.side()] = to;
            }
            mesh.outgoing[0] = HalfEdge::NONE;
        });
        assert!(matches!(fan, ConnectivityDefect::Fan { vertex: VertexId(11), .. }));
    }
}
