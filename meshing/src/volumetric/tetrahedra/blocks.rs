//! The tetrahedra at a face: [`blocks`].
//!
//! Let `S` be the hexahedra at a face. In the complex of hexahedra the pyramids from their centres to the face are the join of the
//! four edges around the face with a cone over the points `S`, since the face is such a cone over its edges. Any tree in place of the
//! cone that has the points `S` among its nodes keeps the homotopy type, as it can be deformed into the cone with `S` at rest:
//! ```text
//!   one hexahedron on one of the sides   the star from it to those on the other side: pairs of centres, no new vertex
//!   any others                           the star from a vertex at the centre of the face
//! ```
//! One centre of a face on the boundary for each of several hexahedra would leave a bubble between them, a 2-sphere; and all pairs of
//! `m` hexahedra on one side with `n` on the other are a graph with `(m - 1) (n - 1)` cycles, each of which makes a 3-sphere. In the
//! second case \[Gagniere22\] takes all pairs: this is where the method here departs from the text.

use super::super::faces::Face;

/// Four tetrahedra, one at each edge of a side of a hexahedron: they have its two vertices, the centre of the hexahedron, and that of the
/// hexahedron beyond or, if there is none, of the side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Block {
    pub(super) hexahedron: usize,
    pub(super) side: usize,
    pub(super) beyond: Option<usize>,
}

/// Whether the face gets a vertex at its centre.
pub(super) fn has_centre(face: &Face<'_>) -> bool {
    match (face.below.len(), face.above.len()) {
        (0, _) | (_, 0) => true,
        (1, _) | (_, 1) => false,
        _ => true,
    }
}

/// The blocks of a face.
pub(super) fn blocks<'a>(face: &'a Face<'_>) -> impl Iterator<Item = Block> + 'a {
    let centre = has_centre(face);
    let (lower, upper) = (2 * face.axis, 2 * face.axis + 1);
    let pairs = face.below.iter().flat_map(|&below| face.above.iter().map(move |&above| (below, above)));
    let pairs = pairs.filter(move |_| !centre);
    let pairs =
        pairs.map(move |(below, above)| Block { hexahedron: below, side: upper, beyond: Some(above) });
    let below = face.below.iter().map(move |&hexahedron| Block { hexahedron, side: upper, beyond: None });
    let above = face.above.iter().map(move |&hexahedron| Block { hexahedron, side: lower, beyond: None });
    pairs.chain(below.chain(above).filter(move |_| centre))
}

/// How many blocks a face has.
pub(super) fn block_count(face: &Face<'_>) -> usize {
    let (below, above) = (face.below.len(), face.above.len());
    if has_centre(face) { below + above } else { below * above }
}
