//! Which triangle continues the surface across each edge: [`Pairing`].
//!
//! # What it computes
//! For each half-edge of a closed oriented surface the half-edge on the other side, so that the surface becomes a 2-manifold: edges
//! with more than two triangles fall apart into several. Its components and their Euler characteristics.
//!
//! # Method
//! Of an edge with two triangles these are a pair. Where more meet, as where two cubes have an edge in common, those are paired
//! first that other edges already make one piece of surface, if as many of them run one way as the other: bodies that have an edge in
//! common stay bodies of their own, even if they overlap there. Then what is left. Both times triangles are taken in their order around the
//! edge, which exact orientations tell. Around the edge's direction by the right-hand rule the inside begins at a triangle that runs
//! backward along the edge and ends at one that runs forward: these match like parentheses, the innermost first. So each wedge of
//! solid keeps its own two triangles, and what met along an edge only comes apart.
//!
//! Complexity: O(n log n).

use std::cmp::Ordering;

use welter_predicates::{Sign, orient2d, orient3d};

use crate::DVec3;
use crate::surface::edges::{self, EdgeTable};
use crate::surface::topology::union_find::UnionFind;
use crate::surface::{EdgeId, TriMesh};

/// The surface as a 2-manifold.
#[derive(Clone, Debug)]
pub(crate) struct Pairing {
    opposite: Vec<u32>,
    component_of: Vec<u32>,
    characteristics: Vec<i64>,
}

impl Pairing {
    /// Pairs the half-edges of a mesh whose edges have as many triangles one way as the other.
    pub(crate) fn new(mesh: &TriMesh) -> Self {
        let table = EdgeTable::new(mesh);
        let mut opposite = vec![0; 3 * mesh.triangles().len()];
        let mut pieces = UnionFind::new(mesh.triangles().len());
        let mut shared = Vec::new();
        for edge in table.ids() {
            match *table.half_edges(edge) {
                [a, b] => {
                    opposite[a as usize] = b;
                    opposite[b as usize] = a;
                    pieces.unite(a / 3, b / 3);
                }
                _ => shared.push(edge),
            }
        }
        for edge in shared {
            match_around(mesh, &table, edge, &mut pieces, &mut opposite);
        }
        let mut pairing = Self { opposite, component_of: Vec::new(), characteristics: Vec::new() };
        pairing.count(mesh);
        pairing
    }

    /// The triangle across edge `k` of a triangle.
    pub(crate) fn neighbour(&self, triangle: u32, k: usize) -> u32 {
        self.opposite[3 * triangle as usize + k] / 3
    }

    /// The component of each triangle.
    pub(crate) fn component_of(&self) -> &[u32] {
        &self.component_of
    }

    /// The Euler characteristic of each component.
    pub(crate) fn characteristics(&self) -> &[i64] {
        &self.characteristics
    }

    /// Finds the components and their Euler characteristics: vertices are sets of corners linked through edges.
    fn count(&mut self, mesh: &TriMesh) {
        let corners = self.opposite.len();
        let mut vertices = UnionFind::new(corners);
        let mut components = UnionFind::new(mesh.triangles().len());
        for h in 0..corners as u32 {
            let other = self.opposite[h as usize];
            // The edge runs from the corner of `h` to the next, and on the other side backwards.
            vertices.unite(h, edges::next(other));
            components.unite(h / 3, other / 3);
        }
        self.component_of = vec![0; mesh.triangles().len()];
        for t in 0..mesh.triangles().len() as u32 {
            let root = components.root(t);
            if root == t {
                self.component_of[t as usize] = self.characteristics.len() as u32;
                self.characteristics.push(0);
            } else {
                self.component_of[t as usize] = self.component_of[root as usize];
            }
        }
        for h in 0..corners as u32 {
            let characteristic = &mut self.characteristics[self.component_of[h as usize / 3] as usize];
            *characteristic += i64::from(vertices.root(h) == h);
            *characteristic -= i64::from(h < self.opposite[h as usize]);
            *characteristic += i64::from(h.is_multiple_of(3));
        }
    }
}

/// Pairs the half-edges of an edge where more than two triangles meet: those of one piece of surface first.
fn match_around(
    mesh: &TriMesh,
    table: &EdgeTable,
    edge: EdgeId,
    pieces: &mut UnionFind,
    opposite: &mut [u32],
) {
    let [low, high] = table.edges[edge.index()];
    let ends = [low, high].map(|v| mesh.positions()[v.index()]);
    let forward = |h: u32| edges::tail(mesh, h) == low;
    let around =
        Around { ends, apexes: Apexes { mesh }, reference: reference(mesh, table.half_edges(edge), ends) };
    let mut order = table.half_edges(edge).to_vec();
    // Where triangles lie at one angle those that end the inside come first: what touches stays apart.
    // Of several that begin or end there the lowest is outermost, as along the edges of the grid.
    let by_number = |a: u32, b: u32| if forward(a) { b.cmp(&a) } else { a.cmp(&b) };
    order.sort_by(|&a, &b| {
        around.compare(a, b).then(forward(b).cmp(&forward(a))).then_with(|| by_number(a, b))
    });
    // Stable, so that each piece keeps the order around the edge.
    let mut by_piece = order.clone();
    by_piece.sort_by_key(|&h| pieces.root(h / 3));
    let mut loose = Vec::new();
    for piece in by_piece.chunk_by(|&a, &b| pieces.root(a / 3) == pieces.root(b / 3)) {
        if 2 * piece.iter().filter(|&&h| forward(h)).count() == piece.len() {
            match_parentheses(piece, forward, opposite);
        } else {
            loose.extend_from_slice(piece);
        }
    }
    loose.sort_unstable();
    order.retain(|h| loose.binary_search(h).is_ok());
    match_parentheses(&order, forward, opposite);
    for &h in table.half_edges(edge) {
        pieces.unite(h / 3, opposite[h as usize] / 3);
    }
}

/// Pairs half-edges in their order around an edge, as many forward as backward, so that each wedge of solid has its own two.
fn match_parentheses(order: &[u32], forward: impl Fn(u32) -> bool, opposite: &mut [u32]) {
    // Begin where the inside is least deep, so that no wedge is open across the beginning.
    let mut depth = 0i64;
    let (mut least, mut begin) = (i64::MAX, 0);
    for (place, &h) in order.iter().enumerate() {
        if depth < least {
            (least, begin) = (depth, place);
        }
        depth += if forward(h) { -1 } else { 1 };
    }
    let mut open = Vec::new();
    for &h in order[begin..].iter().chain(&order[..begin]) {
        if forward(h) {
            let start: u32 =
                open.pop().expect("as many run forward as backward, and the depth is never negative");
            opposite[h as usize] = start;
            opposite[start as usize] = h;
        } else {
            open.push(h);
        }
    }
}

/// The first apex that is not on the line of the edge.
fn reference(mesh: &TriMesh, half_edges: &[u32], [a, b]: [DVec3; 2]) -> Option<DVec3> {
    half_edges.iter().map(|&h| Apexes { mesh }.of(h)).find(|&p| side_of_line(a, b, p) != [Sign::Zero; 3])
}

/// Orientations of three points along each axis; all zero if they are on one line.
fn side_of_line(a: DVec3, b: DVec3, p: DVec3) -> [Sign; 3] {
    [[1, 2], [2, 0], [0, 1]].map(|[u, v]| orient2d([a[u], a[v]], [b[u], b[v]], [p[u], p[v]]))
}

struct Apexes<'a> {
    mesh: &'a TriMesh,
}

impl Apexes<'_> {
    fn of(&self, half_edge: u32) -> DVec3 {
        self.mesh.positions()[edges::opposite(self.mesh, half_edge).index()]
    }
}

/// The order of triangles around an edge, from a reference on, by the right-hand rule.
struct Around<'a> {
    ends: [DVec3; 2],
    apexes: Apexes<'a>,
    reference: Option<DVec3>,
}

impl Around<'_> {
    fn compare(&self, a: u32, b: u32) -> Ordering {
        let Some(reference) = self.reference else { return Ordering::Equal };
        let (p, q) = (self.apexes.of(a), self.apexes.of(b));
        let (of_p, of_q) = (self.quarter(reference, p), self.quarter(reference, q));
        of_p.cmp(&of_q).then_with(|| {
            if of_p.is_multiple_of(2) {
                return Ordering::Equal;
            }
            match orient3d(self.ends[0], self.ends[1], p, q) {
                Sign::Negative => Ordering::Less,
                Sign::Zero => Ordering::Equal,
                Sign::Positive => Ordering::Greater,
            }
        })
    }

    /// 0 at the angle of the reference (and on the edge's line), 1 before half a turn, 2 at half a turn, 3 behind.
    fn quarter(&self, reference: DVec3, p: DVec3) -> u8 {
        let [a, b] = self.ends;
        match orient3d(a, b, reference, p) {
            Sign::Negative => 1,
            Sign::Positive => 3,
            Sign::Zero => {
                let (here, there) = (side_of_line(a, b, reference), side_of_line(a, b, p));
                let opposed = (0..3).any(|axis| here[axis] * there[axis] == Sign::Negative);
                if opposed { 2 } else { 0 }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{self, Torus};
    use crate::surface::TriangleSoup;

    #[test]
    fn a_torus_is_one_component() {
        let pairing = Pairing::new(&shapes::torus(&Torus::default()).unwrap());
        assert_eq!(pairing.characteristics(), [0]);
    }

    /// Two tetrahedra on either side of the edge 0-1; with `turned` the second one's triangles come first.
    fn wedges(turned: bool) -> TriMesh {
        tetrahedra_at_an_edge([[1., 0.], [1., 1.], [-1., 0.], [-1., -1.]], turned)
    }

    /// Two tetrahedra with the edge 0-1 in common, each between two directions across it.
    fn tetrahedra_at_an_edge(directions: [[f64; 2]; 4], turned: bool) -> TriMesh {
        let apexes = directions.map(|[x, y]| [x, y, 0.0]);
        let positions = [[0., 0., 0.], [0., 0., 1.]].into_iter().chain(apexes);
        let tetrahedron = |p: u32, q: u32| vec![[0, 1, p], [1, 0, q], [0, p, q], [1, q, p]];
        let (mut first, mut second) = (tetrahedron(3, 2), tetrahedron(5, 4));
        if turned {
            std::mem::swap(&mut first, &mut second);
        }
        first.extend(second);
        let positions = positions.map(DVec3::from_array).collect();
        TriMesh::new(TriangleSoup { positions, triangles: first, ..TriangleSoup::default() }).unwrap()
    }

    #[test]
    fn wedges_that_share_an_edge_come_apart() {
        for turned in [false, true] {
            let pairing = Pairing::new(&wedges(turned));
            assert_eq!(pairing.characteristics(), [2, 2]);
            assert_eq!(pairing.component_of(), [0, 0, 0, 0, 1, 1, 1, 1]);
        }
    }

    #[test]
    fn wedges_that_overlap_at_an_edge_stay_bodies_of_their_own() {
        // Crossing, one within the other, and with a side in common.
        for directions in [
            [[1., 0.], [0., 1.], [1., 1.], [-1., 1.]],
            [[1., 0.], [-1., 1.], [1., 1.], [0., 1.]],
            [[1., 0.], [1., 1.], [1., 1.], [0., 1.]],
        ] {
            for turned in [false, true] {
                let pairing = Pairing::new(&tetrahedra_at_an_edge(directions, turned));
                assert_eq!(pairing.characteristics(), [2, 2], "{directions:?}");
                assert_eq!(pairing.component_of(), [0, 0, 0, 0, 1, 1, 1, 1], "{directions:?}");
            }
        }
    }
}
