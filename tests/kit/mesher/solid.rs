//! Solids made of tetrahedra, which may lie over one another in space: [`Solid`].

use std::collections::BTreeMap;

use glam::DVec3;
use welter_meshing::grid::Grid3;
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};
use welter_predicates::moved_grid::orient3d_moved;
use welter_predicates::{Sign, orient3d};

use super::unfolded::cells_near;

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

    /// How many tetrahedra are flat or inside out. With none of them the solid is immersed, if it is around each vertex:
    /// [`Self::folded_vertex`].
    #[must_use]
    pub fn inverted(&self) -> usize {
        self.inside_out().count()
    }

    /// A vertex around which two tetrahedra lie over each other however near, so that the solid is not immersed there. Around an edge
    /// they do so around its ends.
    #[must_use]
    pub fn folded_vertex(&self) -> Option<u32> {
        let mut around = vec![Vec::new(); self.positions.len()];
        for tet in &self.tets {
            for (c, &v) in tet.iter().enumerate() {
                around[v as usize].push([1, 2, 3].map(|step| tet[(c + step) % 4]));
            }
        }
        (0..).zip(&around).find_map(|(v, cones)| {
            let folded =
                |(k, cone): (usize, &[u32; 3])| cones[..k].iter().any(|other| self.overlap(v, *cone, *other));
            cones.iter().enumerate().any(folded).then_some(v)
        })
    }

    /// Whether the cones from a vertex to two triangles have inner points in common: if no plane through two of their edges is between
    /// them.
    fn overlap(&self, vertex: u32, cone: [u32; 3], other: [u32; 3]) -> bool {
        let edges = [cone, other].concat();
        let pairs = (0..6).flat_map(|k| (0..k).map(move |l| [k, l]));
        let side = |[k, l]: [usize; 2], v: u32| {
            let [a, b, c, d] = self.places([vertex, edges[k], edges[l], v]);
            orient3d(a, b, c, d)
        };
        let apart = |pair: [usize; 2]| {
            let [first, second] = [cone, other].map(|cone| cone.map(|v| side(pair, v)));
            let all = |signs: [Sign; 3], not: Sign| signs.iter().all(|&sign| sign != not);
            // Two edges along one line have no plane.
            first.iter().any(|&sign| sign != Sign::Zero)
                && ((all(first, Sign::Negative) && all(second, Sign::Positive))
                    || (all(first, Sign::Positive) && all(second, Sign::Negative)))
        };
        !pairs.into_iter().any(apart)
    }

    /// The corners of the tetrahedra that are flat or inside out.
    pub fn inside_out(&self) -> impl Iterator<Item = [[f64; 3]; 4]> {
        self.tets
            .iter()
            .map(|tet| self.places(*tet))
            .filter(|&[a, b, c, d]| orient3d(a, b, c, d) != Sign::Negative)
    }

    /// For each node of the moved grid, how many tetrahedra contain it, less those that contain it inside out: so often the surface winds
    /// around it.
    #[must_use]
    pub fn depths(&self, grid: &Grid3) -> Vec<i32> {
        let mut depths = vec![0; grid.node_count()];
        for (t, tet) in self.tets.iter().enumerate() {
            let corners = self.places(*tet);
            let sides = [0, 1, 2, 3].map(|side| self.places(self.side(t as u32, side)));
            // The first corners of the cells near the tetrahedron are the nodes near it.
            cells_near(grid, &corners, |node| {
                let [first, rest @ ..] =
                    sides.map(|side| orient3d_moved(side[0], side[1], side[2], grid.node(node)));
                if rest.iter().all(|&side| side == first) {
                    depths[grid.node_index(node)] += match first {
                        Sign::Positive => 1,
                        Sign::Zero => 0,
                        Sign::Negative => -1,
                    };
                }
            });
        }
        depths
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
