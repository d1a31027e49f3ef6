//! Where a point of a hexahedron is among the tetrahedra: [`TetrahedronPoint`].
//!
//! The pyramid over a side holds the points whose distance `s` from the centre is largest along the axis of that side, and of its
//! tetrahedra the one at the edge in whose direction the point is farther off, by `d`, than along the edge, by `e`. With the cell as the unit of
//! length, the weights of the ends of the edge are `d - e` and `d + e`, and the others
//! ```text
//!   centre of the hexahedron   1 - d - s    1 - 2 s
//!   the hexahedron beyond      s - d
//!   the centre of the side                  2 (s - d)
//! ```
//! None is negative, as `|e| <= d <= s <= 1/2`.

use super::Tetrahedra;

/// A point as a mean of the corners of a tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetrahedronPoint {
    /// The tetrahedron.
    pub tetrahedron: usize,
    /// The weights of its corners: not negative, and of sum 1 up to rounding.
    pub weights: [f64; 4],
}

impl Tetrahedra {
    /// The tetrahedron that holds a point of a hexahedron, and its weights there. The point is given by its coordinates in the
    /// hexahedron, from 0 to 1 along each axis. Where several coincident hexahedra lie beyond a side, one of their tetrahedra is taken.
    ///
    /// Each weight is off by at most 2^-52. `None` if there is no such hexahedron, or if a coordinate is not from 0 to 1.
    #[must_use]
    pub fn locate(&self, hexahedron: usize, at: [f64; 3]) -> Option<TetrahedronPoint> {
        let corners = self.corners.get(hexahedron)?;
        if !at.iter().all(|c| (0.0..=1.0).contains(c)) {
            return None;
        }
        let from_centre = at.map(|c| c - 0.5);
        let [axis, across, along] = by_magnitude(from_centre);
        let upper = |axis: usize| usize::from(from_centre[axis] > 0.0) << axis;
        let low = upper(axis) | upper(across);
        let ends = [corners[low], corners[low | 1 << along]];
        let block = 4 * self.blocks[hexahedron][2 * axis + usize::from(from_centre[axis] > 0.0)] as usize;
        let has_ends = |t: &usize| ends.iter().all(|end| self.mesh.tetrahedra[*t].contains(end));
        let tetrahedron =
            (block..block + 4).find(has_ends).expect("each edge of the side has one of the four");

        let (s, d, e) = (from_centre[axis].abs(), from_centre[across].abs(), from_centre[along]);
        let centre = self.first_centre + hexahedron as u32;
        let first_face = self.first_centre as usize + self.corners.len();
        let at_side = self.mesh.tetrahedra[tetrahedron].iter().any(|&v| v as usize >= first_face);
        let [own, beyond] = if at_side { [1.0 - 2.0 * s, 2.0 * (s - d)] } else { [(1.0 - d) - s, s - d] };
        let weight = |vertex| match vertex {
            v if v == ends[0] => d - e,
            v if v == ends[1] => d + e,
            v if v == centre => own,
            _ => beyond,
        };
        Some(TetrahedronPoint { tetrahedron, weights: self.mesh.tetrahedra[tetrahedron].map(weight) })
    }
}

/// The axes by the magnitude of the coordinates, largest first; the earlier of equal ones.
fn by_magnitude(x: [f64; 3]) -> [usize; 3] {
    let mut axes = [0, 1, 2];
    axes.sort_by(|&a, &b| x[b].abs().total_cmp(&x[a].abs()));
    axes
}

#[cfg(test)]
mod tests {
    use super::by_magnitude;

    #[test]
    fn axes_are_sorted_by_magnitude() {
        assert_eq!(by_magnitude([0.1, -0.3, 0.2]), [1, 2, 0]);
        assert_eq!(by_magnitude([0.0; 3]), [0, 1, 2]);
        assert_eq!(by_magnitude([0.1, 0.2, -0.2]), [1, 2, 0]);
    }
}
