//! The part of a grid's wall where samples are negative, as triangles: it closes the surface.
//!
//! The polygons of the cells' faces ([`CellCase::face_polygon`]), each cut into a fan: no three points of one are on a line, for an edge of a face
//! holds at most two of them.

use rayon::prelude::*;

use super::cell::{FACE_CORNERS, corner_offset};
use super::signs::Signs;
use super::{CellCase, CellPoint};

/// The triangles, wall by wall, counterclockwise seen from outside of the grid.
pub(super) fn wall_triangles(signs: &Signs) -> Vec<[u32; 3]> {
    if !signs.is_capped() {
        return Vec::new();
    }
    let cells = signs.grid.cells();
    let mut triangles = Vec::new();
    for face in 0..6 {
        let across = face / 2;
        let [u, v] = [[1, 2], [0, 2], [0, 1]][across];
        let rows: Vec<Vec<[u32; 3]>> = (0..cells[v])
            .into_par_iter()
            .map(|b| {
                let mut row = Vec::new();
                for a in 0..cells[u] {
                    let mut cell = [0; 3];
                    (cell[u], cell[v]) = (a, b);
                    cell[across] = if face % 2 == 0 { 0 } else { cells[across] - 1 };
                    fan(signs, cell, face, &mut row);
                }
                row
            })
            .collect();
        triangles.extend(rows.into_iter().flatten());
    }
    triangles
}

fn fan(signs: &Signs, cell: [u32; 3], face: usize, triangles: &mut Vec<[u32; 3]>) {
    let node = |corner: u8| {
        let offset = corner_offset(corner);
        std::array::from_fn(|axis| cell[axis] + u32::from(offset[axis]))
    };
    let mut case = 0;
    for corner in FACE_CORNERS[face] {
        case |= u8::from(signs.is_negative(node(corner))) << corner;
    }
    if case == 0 {
        return;
    }
    let number = |point: &CellPoint| match *point {
        CellPoint::Corner(corner) => signs.vertex(3, node(corner)),
        CellPoint::Edge(edge) => signs.vertex(usize::from(edge / 4), node(point.ends()[0])),
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
