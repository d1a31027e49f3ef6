//! The part of a grid's wall where samples are negative, as triangles: it closes the surface.
//!
//! The polygons of the cells' faces ([`CellCase::face_polygon`]), each cut into a fan: no three points of one are on a line, for an edge of a face
//! holds at most two of them.
//!
//! # Complexity
//! Linear in the cells at the wall and in the words of their rows of bits.

use rayon::prelude::*;

use super::cell::{FACE_CORNERS, corner_offset};
use super::signs::{KINDS, Signs};
use super::{CellCase, CellPoint, IsosurfaceError};
use crate::Stage;

/// The triangles, wall by wall, counterclockwise seen from outside of the grid.
pub(super) fn wall_triangles(signs: &Signs, stage: &Stage<'_>) -> Result<Vec<[u32; 3]>, IsosurfaceError> {
    if !signs.is_capped() {
        return Ok(Vec::new());
    }
    let cells = signs.grid.cells();
    let mut triangles = Vec::new();
    for face in 0..6 {
        let across = face / 2;
        let [u, v] = [[1, 2], [0, 2], [0, 1]][across];
        let rows: Vec<Vec<[u32; 3]>> = (0..cells[v])
            .into_par_iter()
            .map(|b| {
                stage.check()?;
                let mut cell = [0; 3];
                cell[v] = b;
                cell[across] = if face % 2 == 0 { 0 } else { cells[across] - 1 };
                // Along x there are as many vertices as words to count: once for all cells.
                let counted = (u == 0).then(|| CountedRows::beside(signs, cell, face));
                let number = |kind: usize, node: [u32; 3]| match &counted {
                    Some(counted) => counted.vertex(kind, node),
                    None => signs.vertex(kind, node),
                };
                let mut row = Vec::new();
                for a in 0..cells[u] {
                    cell[u] = a;
                    fan(signs, &number, cell, face, &mut row);
                }
                Ok(row)
            })
            .collect::<Result<_, IsosurfaceError>>()?;
        triangles.extend(rows.into_iter().flatten());
    }
    Ok(triangles)
}

/// The two rows of nodes along x at a face of a row of cells, and how many vertices lie before each of their words.
struct CountedRows<'a> {
    signs: &'a Signs,
    rows: [usize; 2],
    before: [[Vec<u32>; KINDS]; 2],
}

impl<'a> CountedRows<'a> {
    /// The rows at a face of the first cell of a row.
    fn beside(signs: &'a Signs, cell: [u32; 3], face: usize) -> Self {
        let rows = [FACE_CORNERS[face][0], FACE_CORNERS[face][2]].map(|corner| {
            let [_, j, k] = node_of(cell, corner);
            signs.row_of(j, k)
        });
        let before = rows.map(|row| std::array::from_fn(|kind| signs.vertices_before_words(kind, row)));
        Self { signs, rows, before }
    }

    /// As [`Signs::vertex`], for a node of the two rows.
    fn vertex(&self, kind: usize, [i, j, k]: [u32; 3]) -> u32 {
        let row = self.signs.row_of(j, k);
        let which = usize::from(row != self.rows[0]);
        let before = self.before[which][kind][i as usize / 64];
        self.signs.vertex_after(before, kind, [i, j, k])
    }
}

fn node_of(cell: [u32; 3], corner: u8) -> [u32; 3] {
    let offset = corner_offset(corner);
    std::array::from_fn(|axis| cell[axis] + u32::from(offset[axis]))
}

fn fan(
    signs: &Signs,
    vertex: &impl Fn(usize, [u32; 3]) -> u32,
    cell: [u32; 3],
    face: usize,
    triangles: &mut Vec<[u32; 3]>,
) {
    let mut case = 0;
    for corner in FACE_CORNERS[face] {
        case |= u8::from(signs.is_negative(node_of(cell, corner))) << corner;
    }
    if case == 0 {
        return;
    }
    let number = |point: &CellPoint| match *point {
        CellPoint::Corner(corner) => vertex(3, node_of(cell, corner)),
        CellPoint::Edge(edge) => vertex(usize::from(edge / 4), node_of(cell, point.ends()[0])),
    };
    let polygon = CellCase(case).face_polygon(face);
    let first = number(&polygon[0]);
    let mut last = number(&polygon[1]);
    for point in &polygon[2..] {
        let next = number(point);
        triangles.push([first, last, next]);
        last = next;
    }
}
