//! The edges of the complex: [`visit`] tells for each edge of each hexahedron whether an earlier one has it.
//!
//! An edge is a pair of vertices at the ends of an edge of the grid, so only the hexahedra of the four cells around that can have it.
//! Complexity: O(n) while cells have few hexahedra, O(n log n) in any case.

use std::collections::BTreeMap;
use std::ops::Range;

use super::HexMesh;
use super::neighbours::{Cursor, occupied};

/// How many edges a hexahedron has.
pub(super) const EDGES: usize = 12;

/// The edges of a hexahedron as corners. Edge `4 axis + b + 2 c` runs along its axis, at `b` of 0 or 1 along the next axis and at `c`
/// along the one after that.
pub(super) fn corners(edge: usize) -> [usize; 2] {
    let [axis, next, last] = axes(edge);
    let low = (edge & 1) << next | (edge >> 1 & 1) << last;
    [low, low | 1 << axis]
}

/// The edge between two corners that differ along one axis.
pub(super) fn between(a: usize, b: usize) -> usize {
    let axis = (a ^ b).trailing_zeros() as usize;
    let [_, next, last] = axes(4 * axis);
    4 * axis + (a >> next & 1) + 2 * (a >> last & 1)
}

fn axes(edge: usize) -> [usize; 3] {
    [0, 1, 2].map(|turn| (edge / 4 + turn) % 3)
}

/// An edge of a hexahedron.
pub(super) type EdgePlace = (usize, usize);

/// Calls `each(place, earlier)` for every edge of every hexahedron of a piece, hexahedra ascending within each cell and edge, with
/// an earlier place of the same edge if there is one: on the same cell or one of a lower number. So the places without an earlier
/// one are the edges of the complex, each once.
pub(super) fn visit(mesh: &HexMesh, piece: Range<usize>, mut each: impl FnMut(EdgePlace, Option<EdgePlace>)) {
    let around = around();
    let mut cursors = LOWER.map(Cursor::new);
    let mut seen = Seen::default();
    for (cell, own) in occupied(mesh, piece) {
        let mut lower: [Range<usize>; LOWER.len()] = Default::default();
        for (range, cursor) in lower.iter_mut().zip(&mut cursors) {
            *range = cursor.hexahedra(mesh, cell);
        }
        for (edge, around) in around.iter().enumerate() {
            seen.clear();
            for &(step, other) in around.iter().flatten() {
                for hexahedron in lower[step].clone() {
                    seen.insert(ends(mesh, (hexahedron, other)), (hexahedron, other));
                }
            }
            for hexahedron in own.clone() {
                let place = (hexahedron, edge);
                each(place, seen.insert(ends(mesh, place), place));
            }
        }
    }
}

fn ends(mesh: &HexMesh, (hexahedron, edge): EdgePlace) -> [u32; 2] {
    corners(edge).map(|corner| mesh.hexahedra()[hexahedron][corner])
}

/// The steps to cells of lower numbers with an edge in common.
const LOWER: [[i32; 3]; 9] = [
    [0, -1, -1],
    [-1, 0, -1],
    [0, 0, -1],
    [1, 0, -1],
    [0, 1, -1],
    [-1, -1, 0],
    [0, -1, 0],
    [1, -1, 0],
    [-1, 0, 0],
];

/// For each edge, the steps of [`LOWER`] to the other cells around it, and which of their edges it is.
fn around() -> [[Option<(usize, usize)>; 3]; EDGES] {
    std::array::from_fn(|edge| {
        let axes = axes(edge);
        [1, 2, 3].map(|flips: usize| {
            let mut step = [0; 3];
            for bit in 0..2 {
                if flips >> bit & 1 == 1 {
                    step[axes[bit + 1]] = if edge >> bit & 1 == 1 { 1 } else { -1 };
                }
            }
            LOWER.iter().position(|&lower| lower == step).map(|at| (at, edge ^ flips))
        })
    })
}

/// The edges seen at one place, with where they were seen first. Few, as a rule.
#[derive(Default)]
struct Seen {
    few: Vec<([u32; 2], EdgePlace)>,
    many: BTreeMap<[u32; 2], EdgePlace>,
}

impl Seen {
    /// From how many edges on a search tree is faster than a scan; any number is right.
    const FEW: usize = 32;

    fn clear(&mut self) {
        self.few.clear();
        self.many.clear();
    }

    /// Where the edge was seen first, if it was.
    fn insert(&mut self, ends: [u32; 2], place: EdgePlace) -> Option<EdgePlace> {
        if let Some(&(_, first)) = self.few.iter().find(|(other, _)| *other == ends) {
            return Some(first);
        }
        if self.few.len() < Self::FEW {
            self.few.push((ends, place));
            return None;
        }
        match self.many.entry(ends) {
            std::collections::btree_map::Entry::Occupied(first) => Some(*first.get()),
            std::collections::btree_map::Entry::Vacant(slot) => {
                slot.insert(place);
                None
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_are_numbered_by_their_corners() {
        for edge in 0..EDGES {
            let [a, b] = corners(edge);
            assert_eq!((between(a, b), between(b, a), a ^ b), (edge, edge, 1 << (edge / 4)));
        }
    }

    #[test]
    fn the_other_cells_around_an_edge_have_it_at_the_same_place() {
        let mut found = 0;
        for (edge, around) in around().iter().enumerate() {
            for &(step, other) in around.iter().flatten() {
                found += 1;
                for (corner, same) in corners(edge).into_iter().zip(corners(other)) {
                    for (axis, by) in LOWER[step].into_iter().enumerate() {
                        assert_eq!((corner >> axis & 1) as i32, by + (same >> axis & 1) as i32);
                    }
                }
            }
        }
        // Of the four cells around an edge of the grid, each sees those below it: 0 + 1 + 2 + 3 for each axis.
        assert_eq!(found, 18);
    }

    #[test]
    fn many_edges_are_told_apart_as_few_are() {
        let mut seen = Seen::default();
        for round in 0..2 {
            for i in 0..100 {
                let earlier = seen.insert([i, i + 1], (round, i as usize));
                assert_eq!(earlier, (round == 1).then_some((0, i as usize)));
            }
        }
    }
}
