//! Solids made of tetrahedra, which may lie over one another in space: [`Solid`].

use std::collections::BTreeMap;

use glam::DVec3;
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};
use welter_predicates::{Sign, orient3d};

/// The paths from corner 0 of a cube to corner 7: six tetrahedra, the same in all cubes, so that they fit.
const PATHS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// The sides of a tetrahedron, counterclockwise from outside where its volume is positive.
const SIDES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// An abstract solid and where its vertices lie.
#[derive(Clone, Debug, Default)]
pub struct Solid {
    /// Where each vertex lies.
    pub positions: Vec<DVec3>,
    /// A number for each vertex that tells the way along the solid, for solids that have one.
    pub along: Vec<f64>,
    /// The tetrahedra.
    pub tets: Vec<[u32; 4]>,
    /// The vertices of the surface's triangles.
    pub triangles: Vec<[u32; 3]>,
    /// The tetrahedron of each triangle.
    pub tet_of: Vec<u32>,
    /// Across each side of each tetrahedron the other one, `u32::MAX` at the surface.
    pub neighbours: Vec<[u32; 4]>,
}

impl Solid {
    /// Cubes of a lattice, six tetrahedra each. Lattice points that `same` makes equal are one vertex; `place` says where a vertex lies and
    /// its way along.
    pub fn of_cubes(
        cubes: &[[i32; 3]],
        same: impl Fn([i32; 3]) -> [i32; 3],
        place: impl Fn([i32; 3]) -> (DVec3, f64),
    ) -> Self {
        let mut solid = Self::default();
        let mut numbers = BTreeMap::new();
        for &cube in cubes {
            let corner: [u32; 8] = std::array::from_fn(|c| {
                let at = same(std::array::from_fn(|axis| cube[axis] + (c >> axis & 1) as i32));
                *numbers.entry(at).or_insert_with(|| {
                    let (position, along) = place(at);
                    solid.positions.push(position);
                    solid.along.push(along);
                    solid.positions.len() as u32 - 1
                })
            });
            for (number, [a, b, _]) in PATHS.into_iter().enumerate() {
                let path = [0, 1 << a, 1 << a | 1 << b, 7].map(|c: usize| corner[c]);
                let even = matches!(number, 0 | 3 | 4);
                solid.tets.push(if even { path } else { [path[0], path[2], path[1], path[3]] });
            }
        }
        solid.find_neighbours();
        solid
    }

    fn find_neighbours(&mut self) {
        let mut sides: Vec<([u32; 3], u32, usize)> = Vec::new();
        for (t, tet) in self.tets.iter().enumerate() {
            for (side, corners) in SIDES.iter().enumerate() {
                let mut key = corners.map(|c| tet[c]);
                key.sort_unstable();
                sides.push((key, t as u32, side));
            }
        }
        sides.sort_unstable();
        self.neighbours = vec![[u32::MAX; 4]; self.tets.len()];
        for group in sides.chunk_by(|a, b| a.0 == b.0) {
            match *group {
                [(_, t, side)] => {
                    self.triangles.push(self.side(t, side));
                    self.tet_of.push(t);
                }
                [(_, s, of_s), (_, t, of_t)] => {
                    self.neighbours[s as usize][of_s] = t;
                    self.neighbours[t as usize][of_t] = s;
                }
                _ => unreachable!("three tetrahedra have a side in common"),
            }
        }
    }

    /// The vertices of a side of a tetrahedron.
    #[must_use]
    pub fn side(&self, tet: u32, side: usize) -> [u32; 3] {
        SIDES[side].map(|c| self.tets[tet as usize][c])
    }

    /// Where the corners of some vertices lie.
    #[must_use]
    pub fn places<const N: usize>(&self, vertices: [u32; N]) -> [[f64; 3]; N] {
        vertices.map(|v| self.positions[v as usize].to_array())
    }

    /// How many tetrahedra are flat or inside out. With none of them the solid is immersed, if it is around each edge and vertex.
    #[must_use]
    pub fn inverted(&self) -> usize {
        let inverted = |tet: &&[u32; 4]| {
            let [a, b, c, d] = self.places(**tet);
            orient3d(a, b, c, d) != Sign::Negative
        };
        self.tets.iter().filter(inverted).count()
    }

    /// Solids beside each other.
    #[must_use]
    pub fn together(solids: &[Self]) -> Self {
        let mut all = Self::default();
        for solid in solids {
            let (v, t) = (all.positions.len() as u32, all.tets.len() as u32);
            all.positions.extend(&solid.positions);
            all.along.extend(&solid.along);
            all.tets.extend(solid.tets.iter().map(|tet| tet.map(|x| x + v)));
            all.triangles.extend(solid.triangles.iter().map(|triangle| triangle.map(|x| x + v)));
            all.tet_of.extend(solid.tet_of.iter().map(|x| x + t));
            let moved = |x: u32| if x == u32::MAX { x } else { x + t };
            all.neighbours.extend(solid.neighbours.iter().map(|n| n.map(moved)));
        }
        all
    }

    /// Its boundary; vertices keep their numbers.
    #[must_use]
    pub fn surface(&self) -> ClosedOrientedMesh {
        surface_of(self.positions.clone(), self.triangles.clone())
    }
}

/// A closed oriented surface that is known to be one.
#[must_use]
pub(super) fn surface_of(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> ClosedOrientedMesh {
    let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
    ClosedOrientedMesh::new(TriMesh::new(soup).expect("finite, in range")).expect("closed and oriented")
}
