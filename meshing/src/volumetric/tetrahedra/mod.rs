//! Tetrahedra in place of hexahedra: [`tetrahedra`].
//!
//! # What it computes
//! The body-centred mesh: a vertex at the centre of each hexahedron, and at each of the four edges of a face between two hexahedra a
//! tetrahedron with both of their centres. Where a face has nothing beyond it, its own centre takes the place of the other.
//!
//! # What it promises
//! * The homotopy type is that of the hexahedra, and so are Euler characteristics and Betti numbers: see the rules in `blocks`.
//! * All volumes are positive, and all positions exact. Tetrahedra are of two shapes, with dihedral angles of 60 and 90 degrees, and at the boundary of 45, 60 and 90.
//! * The vertices of the hexahedra keep their numbers; behind them is a vertex for each hexahedron, then those of faces.
//! * Where no face has hexahedra that are coincident, each point of a hexahedron is in its tetrahedra once.
//! * The same for any number of threads.
//!
//! # What it does not promise
//! Volumes where coincident hexahedra meet at a face with one on the other side: the pyramid of that one is there once for each.
//!
//! # Method
//! \[Gagniere22\] 3.9, but for faces with several hexahedra on both sides, which get a centre here. The faces are
//! visited twice, to count and to fill.
//!
//! # Complexity
//! O(n) while cells have few hexahedra, O(n log n) in any case; 56 bytes a hexahedron apart from the mesh, which takes about 290.

mod blocks;
mod locate;

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;
use thiserror::Error;

use super::faces::{self, Face};
use super::neighbours::pieces;
use super::{HexMesh, QUADRILATERALS, TetMesh};
use crate::{Cancelled, DVec3, Monitor};
use blocks::{Block, block_count, blocks, has_centre};
pub use locate::TetrahedronPoint;

/// A mesh of tetrahedra in place of one of hexahedra.
#[derive(Clone, Debug, PartialEq)]
pub struct Tetrahedra {
    mesh: TetMesh,
    /// The corners of each hexahedron, and the first of the four tetrahedra or more at each of its sides, by fours.
    corners: Vec<[u32; 8]>,
    blocks: Vec<[u32; 6]>,
    /// The number of the centre of the first hexahedron.
    first_centre: u32,
}

/// Why there are no tetrahedra.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TetrahedraError {
    /// A centre could only be had rounded.
    #[error(
        "along axis {axis} the middles between nodes from {origin:e} on, {spacing:e} apart, have no exact coordinates; \
         take a spacing and an origin with fewer digits"
    )]
    Inexact {
        /// The axis.
        axis: usize,
        /// The first coordinate of the grid.
        origin: f64,
        /// The spacing of the grid.
        spacing: f64,
    },
    /// Vertices or tetrahedra cannot be numbered with 32 bits.
    #[error("{vertices} vertices and {tetrahedra} tetrahedra are too many")]
    TooMany {
        /// How many vertices there would be.
        vertices: usize,
        /// How many tetrahedra there would be; 0 if they were not counted.
        tetrahedra: usize,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The tetrahedra in place of hexahedra; in parallel.
///
/// ```
/// use welter_meshing::{Monitor, grid::Grid3, volumetric::{HexMesh, tetrahedra}};
/// let grid = Grid3::new([0.0; 3], 1.0, [1; 3])?;
/// let mesh = HexMesh::new(grid, (0..8).collect(), vec![[0, 1, 2, 3, 4, 5, 6, 7]], vec![0])?;
/// let tetrahedra = tetrahedra(&mesh, &Monitor::none())?;
/// // The corners, the centre and the centres of the sides; four tetrahedra at each side.
/// assert_eq!(tetrahedra.mesh().positions.len(), 8 + 1 + 6);
/// assert_eq!(tetrahedra.mesh().tetrahedra.len(), 24);
/// // Which of them holds a point?
/// let point = tetrahedra.locate(0, [0.5, 0.25, 1.0]).expect("in the hexahedron");
/// assert_eq!(point.weights.iter().sum::<f64>(), 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`TetrahedraError`]: centres that are no `f64`, too many vertices or tetrahedra, or cancelled.
pub fn tetrahedra(mesh: &HexMesh, monitor: &Monitor<'_>) -> Result<Tetrahedra, TetrahedraError> {
    let grid = mesh.grid();
    if let Some(axis) = grid.axis_of_inexact_middles() {
        let (origin, spacing) = (grid.origin()[axis], grid.spacing());
        return Err(TetrahedraError::Inexact { axis, origin, spacing });
    }
    let first_centre = mesh.nodes().len();
    let first_face = first_centre + mesh.len();
    let pieces = pieces(mesh);
    let sizes = count(mesh, &pieces, monitor)?;
    let vertices = first_face + sizes.iter().map(|size| size.centres).sum::<usize>();
    let tetrahedra = 4 * sizes.iter().map(|size| size.blocks).sum::<usize>();
    if u32::try_from(vertices.max(tetrahedra)).is_err() {
        return Err(TetrahedraError::TooMany { vertices, tetrahedra });
    }
    let mut filled = TetMesh {
        positions: vec![DVec3::ZERO; vertices],
        tetrahedra: vec![[0; 4]; tetrahedra],
        hexahedra: vec![0; tetrahedra],
    };
    let (corners, rest) = filled.positions.split_at_mut(first_centre);
    let (centres, centres_of_faces) = rest.split_at_mut(mesh.len());
    corners.par_iter_mut().enumerate().for_each(|(v, position)| *position = mesh.position(v as u32));
    centres.par_iter_mut().enumerate().for_each(|(h, position)| {
        let corners = mesh.hexahedra()[h];
        *position = middle(mesh, corners[0], corners[7]);
    });
    let blocks: Vec<[AtomicU32; 6]> = std::iter::repeat_with(Default::default).take(mesh.len()).collect();
    let parts = split(&sizes, first_face, centres_of_faces, &mut filled.tetrahedra, &mut filled.hexahedra);
    let stage = monitor.stage("tetrahedra", mesh.len() as u64);
    pieces.into_par_iter().zip(parts).try_for_each(|(piece, mut part)| {
        stage.check()?;
        let hexahedra = piece.len() as u64;
        faces::visit(mesh, piece, |face| part.fill(mesh, face, &blocks));
        stage.advance(hexahedra);
        Ok::<(), Cancelled>(())
    })?;
    let blocks = blocks.into_iter().map(|sides| sides.map(AtomicU32::into_inner)).collect();
    let corners = mesh.hexahedra().to_vec();
    Ok(Tetrahedra { mesh: filled, corners, blocks, first_centre: first_centre as u32 })
}

impl Tetrahedra {
    /// The mesh. Its vertices are those of the hexahedra, then the centre of each hexahedron, then centres of faces.
    #[must_use]
    pub fn mesh(&self) -> &TetMesh {
        &self.mesh
    }

    /// The mesh alone.
    #[must_use]
    pub fn into_mesh(self) -> TetMesh {
        self.mesh
    }
}

/// What a piece adds.
struct Size {
    blocks: usize,
    centres: usize,
}

fn count(mesh: &HexMesh, pieces: &[Range<usize>], monitor: &Monitor<'_>) -> Result<Vec<Size>, Cancelled> {
    let size = |piece: &Range<usize>| {
        monitor.check()?;
        let mut size = Size { blocks: 0, centres: 0 };
        faces::visit(mesh, piece.clone(), |face| {
            size.blocks += block_count(face);
            size.centres += usize::from(has_centre(face));
        });
        Ok(size)
    };
    pieces.par_iter().map(size).collect()
}

/// What a piece fills in.
struct Part<'a> {
    first_centre: usize,
    first_block: usize,
    centres: &'a mut [DVec3],
    tetrahedra: &'a mut [[u32; 4]],
    hexahedra: &'a mut [u32],
    centres_done: usize,
    blocks_done: usize,
}

fn split<'a>(
    sizes: &[Size],
    mut first_centre: usize,
    mut centres: &'a mut [DVec3],
    mut tetrahedra: &'a mut [[u32; 4]],
    mut hexahedra: &'a mut [u32],
) -> Vec<Part<'a>> {
    let mut first_block = 0;
    let mut parts = Vec::with_capacity(sizes.len());
    for size in sizes {
        let part = Part {
            first_centre,
            first_block,
            centres: centres.split_off_mut(..size.centres).expect("the sum of all sizes"),
            tetrahedra: tetrahedra.split_off_mut(..4 * size.blocks).expect("the sum of all sizes"),
            hexahedra: hexahedra.split_off_mut(..4 * size.blocks).expect("the sum of all sizes"),
            centres_done: 0,
            blocks_done: 0,
        };
        (first_centre, first_block) = (first_centre + size.centres, first_block + size.blocks);
        parts.push(part);
    }
    parts
}

impl Part<'_> {
    fn fill(&mut self, mesh: &HexMesh, face: &Face<'_>, blocks_of: &[[AtomicU32; 6]]) {
        let centre = (self.first_centre + self.centres_done) as u32;
        if has_centre(face) {
            self.centres[self.centres_done] = middle(mesh, face.vertices[0], face.vertices[2]);
            self.centres_done += 1;
        }
        for block in blocks(face) {
            self.add(mesh, block, centre);
            let number = (self.first_block + self.blocks_done) as u32;
            // Of several blocks at a side the last one stays; one thread visits the face, so that is the same in every run.
            blocks_of[block.hexahedron][block.side].store(number, Relaxed);
            if let Some(beyond) = block.beyond {
                blocks_of[beyond][block.side ^ 1].store(number, Relaxed);
            }
            self.blocks_done += 1;
        }
    }

    fn add(&mut self, mesh: &HexMesh, block: Block, centre_of_face: u32) {
        let centre_of = |hexahedron: usize| (mesh.nodes().len() + hexahedron) as u32;
        let corners = mesh.hexahedra()[block.hexahedron];
        let last = block.beyond.map_or(centre_of_face, centre_of);
        for k in 0..4 {
            let [a, b] = [k, (k + 1) % 4].map(|k| corners[QUADRILATERALS[block.side][k]]);
            self.tetrahedra[4 * self.blocks_done + k] = [a, b, centre_of(block.hexahedron), last];
            self.hexahedra[4 * self.blocks_done + k] = block.hexahedron as u32;
        }
    }
}

/// Half way between two vertices. Exact where middles between nodes are.
fn middle(mesh: &HexMesh, a: u32, b: u32) -> DVec3 {
    (mesh.position(a) + mesh.position(b)) / 2.0
}
