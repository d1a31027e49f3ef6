//! How the corners, edges and faces of a cubic cell are numbered. The build script reads this file too.
//!
//! ```text
//!   corner c   at (c & 1, c >> 1 & 1, c >> 2 & 1)
//!   edge e     along axis e / 4, from the corner whose other two coordinates are the bits of e % 4, the lower axis first
//!   face f     across axis f / 2, at its lower (f % 2 = 0) or upper side
//!   point p    corner p if p < 8, else a point on edge p - 8
//! ```

/// The point numbers below this are corners.
pub(crate) const CORNERS: u8 = 8;

/// Where a corner is, in cells.
#[allow(dead_code, reason = "the library takes the bits")]
pub(crate) const fn corner_offset(corner: u8) -> [u8; 3] {
    [corner & 1, corner >> 1 & 1, corner >> 2 & 1]
}

/// The two ends of each edge, the lower first.
pub(crate) const EDGE_ENDS: [[u8; 2]; 12] = {
    let mut ends = [[0; 2]; 12];
    let mut edge = 0;
    while edge < 12 {
        let axis = edge / 4;
        let (low, high) = ([1, 0, 0][axis], [2, 2, 1][axis]);
        let from = ((edge as u8 & 1) << low) | ((edge as u8 >> 1 & 1) << high);
        ends[edge] = [from, from | 1 << axis];
        edge += 1;
    }
    ends
};

/// The edge between two neighbouring corners.
#[allow(dead_code, reason = "the build script has no use for it")]
pub(crate) const fn edge_between(a: u8, b: u8) -> u8 {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    let mut edge = 0;
    while EDGE_ENDS[edge as usize][0] != low || EDGE_ENDS[edge as usize][1] != high {
        edge += 1;
    }
    edge
}

/// The four corners of each face, counterclockwise seen from outside of the cell.
#[allow(dead_code, reason = "the build script has no use for it")]
pub(crate) const FACE_CORNERS: [[u8; 4]; 6] = {
    let mut faces = [[0; 4]; 6];
    let mut face = 0;
    while face < 6 {
        // Axes u, v, w in cyclic order are right-handed: u, v turn counterclockwise seen from the upper side of w.
        let (u, v, w) = ((face / 2 + 1) % 3, (face / 2 + 2) % 3, face / 2);
        let base = ((face % 2) as u8) << w;
        let (pu, pv) = (1 << u, 1 << v);
        faces[face] = if face % 2 == 1 {
            [base, base | pu, base | pu | pv, base | pv]
        } else {
            [base, base | pv, base | pu | pv, base | pu]
        };
        face += 1;
    }
    faces
};
