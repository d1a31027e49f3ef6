//! Marching cubes the slow, obvious way: cell by cell, vertices in a map by the edge they lie on.

use std::collections::BTreeMap;

use glam::DVec3;
use welter_meshing::grid::Samples;
use welter_meshing::isosurface::CellPoint::{Corner, Edge};
use welter_meshing::isosurface::{CellCase, CellPoint};

/// The two nodes at the ends of an edge; a node twice.
type Key = [[u32; 3]; 2];

fn key(cell: [u32; 3], point: CellPoint) -> Key {
    point.ends().map(|c| {
        [cell[0] + u32::from(c & 1), cell[1] + u32::from(c >> 1 & 1), cell[2] + u32::from(c >> 2 & 1)]
    })
}

/// The triangles as positions, in no particular order: of the surface alone, or with the wall's polygons cut into fans.
pub(super) fn triangles(samples: &Samples<3>, level: f64, margin: f64, capped: bool) -> Vec<[DVec3; 3]> {
    let grid = samples.grid();
    let mut places: BTreeMap<Key, DVec3> = BTreeMap::new();
    let mut found = Vec::new();
    for number in 0..grid.cell_count() {
        let cell = grid.cell_at(number);
        let mut case = CellCase(0);
        for c in 0..8 {
            case.0 |= u8::from(samples.at(key(cell, Corner(c))[0]) < level) << c;
        }
        let mut polygons: Vec<Vec<CellPoint>> = case.triangles().map(|t| t.to_vec()).collect();
        for face in (0..6).filter(|_| capped) {
            let axis = face / 2;
            let on_wall = if face % 2 == 0 { cell[axis] == 0 } else { cell[axis] + 1 == grid.cells()[axis] };
            if on_wall {
                polygons.push(case.face_polygon(face).to_vec());
            }
        }
        for polygon in polygons {
            let corners: Vec<DVec3> = polygon
                .iter()
                .map(|&point| {
                    *places
                        .entry(key(cell, point))
                        .or_insert_with(|| place(samples, level, margin, key(cell, point), point))
                })
                .collect();
            found.extend((2..corners.len()).map(|i| [corners[0], corners[i - 1], corners[i]]));
        }
    }
    found
}

fn place(samples: &Samples<3>, level: f64, margin: f64, ends: Key, point: CellPoint) -> DVec3 {
    let [low, high] = ends.map(|node| samples.grid().position(node));
    if matches!(point, Corner(_)) {
        return low;
    }
    let Edge(edge) = point else { unreachable!("a corner or an edge") };
    let [a, b] = ends.map(|node| samples.at(node) / 2.0 - level / 2.0);
    let at = match [a, b].map(f64::is_infinite) {
        [true, true] => 0.5,
        [true, false] => 1.0,
        [false, true] => 0.0,
        [false, false] => (a / 2.0) / (a / 2.0 - b / 2.0),
    };
    let at = if at.is_nan() { 0.5 } else { at.clamp(margin, 1.0 - margin) };
    let mut place = low;
    let axis = usize::from(edge / 4);
    place[axis] = low[axis] + at * (high[axis] - low[axis]);
    place
}
