//! Triangles in place of quadrilaterals: [`AreaTriangles`].
//!
//! # What it promises
//! * The homotopy type is that of the quadrilaterals, and so are components and Euler characteristics.
//! * All triangles turn counterclockwise. Their angles are 45 and 90 degrees.
//!
//! # Method
//! The rule of \[Gagniere22\] 3.9 in the plane. Each quadrilateral has a vertex at its centre, and its sides make triangles:
//!
//! | side | with quadrilaterals | triangles |
//! | --- | --- | --- |
//! | standard boundary | one | each end with the centre and the middle of the side |
//! | standard interior | one on each side | each end with both centres |
//! | non-standard boundary | several, all on one side | as standard boundary, each, with one middle |
//! | non-standard interior | one on one side, several on the other | as standard interior, each pair |
//!
//! With several on both sides all pairs would enclose the two ends: a sphere, where there was none. So these hang together by one
//! middle, as on a boundary. Complexity: O(n log n).

use super::QuadMesh;
use super::quad_mesh::SIDES;
use crate::DVec2;

/// Triangles that came from quadrilaterals; they hang together where they have vertices in common.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AreaTriangles {
    /// Where the vertices are: those of the quadrilaterals, then their centres, then the middles of sides.
    pub positions: Vec<DVec2>,
    /// The corners of each triangle, counterclockwise.
    pub triangles: Vec<[u32; 3]>,
    /// The quadrilateral that holds each triangle, or one of the two.
    pub quadrilaterals: Vec<u32>,
}

/// A side of a quadrilateral.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    /// Its ends, the lower one along the side first.
    ends: [u32; 2],
    /// Whether the quadrilateral lies above it.
    above: bool,
    /// The axis across it.
    axis: usize,
    quadrilateral: u32,
}

impl QuadMesh {
    /// The triangles in place of the quadrilaterals. None if their vertices cannot be numbered with 32 bits.
    ///
    /// ```
    /// use welter_meshing::{grid::Grid2, volumetric::plane::QuadMesh};
    /// let grid = Grid2::new([0.0; 2], 1.0, [2, 1])?;
    /// let mesh = QuadMesh::new(grid, (0..6).collect(), vec![[0, 1, 3, 4], [1, 2, 4, 5]], vec![0, 1])?;
    /// let triangles = mesh.triangles().expect("few vertices");
    /// // Two at each of the seven sides.
    /// assert_eq!(triangles.triangles.len(), 14);
    /// assert_eq!(triangles.positions.len(), 6 + 2 + 6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn triangles(&self) -> Option<AreaTriangles> {
        // At most four middles each.
        u32::try_from(self.nodes().len() + 5 * self.len()).ok()?;
        let first_centre = self.nodes().len() as u32;
        let mut out = AreaTriangles {
            positions: (0..first_centre).map(|vertex| self.position(vertex)).collect(),
            ..AreaTriangles::default()
        };
        let half = DVec2::splat(0.5 * self.grid().spacing());
        out.positions.extend(self.quadrilaterals().iter().map(|corners| self.position(corners[0]) + half));
        for sides in self.sides().chunk_by(|a, b| a.ends == b.ends) {
            let (below, above) = sides.split_at(sides.partition_point(|side| !side.above));
            if below.len().min(above.len()) == 1 {
                for low in below {
                    for high in above {
                        out.across(low, [low, high].map(|side| first_centre + side.quadrilateral));
                    }
                }
                continue;
            }
            let middle = out.positions.len() as u32;
            let [a, b] = sides[0].ends.map(|end| self.position(end));
            out.positions.push(a + 0.5 * (b - a));
            for side in below {
                out.across(side, [first_centre + side.quadrilateral, middle]);
            }
            for side in above {
                out.across(side, [middle, first_centre + side.quadrilateral]);
            }
        }
        Some(out)
    }

    /// All sides, those with the same ends together, first the quadrilaterals below.
    fn sides(&self) -> Vec<Side> {
        let mut sides = Vec::with_capacity(4 * self.len());
        for (quadrilateral, corners) in (0..).zip(self.quadrilaterals()) {
            for (number, mut side) in SIDES.into_iter().enumerate() {
                side.sort_unstable();
                let above = number % 2 == 0;
                sides.push(Side { ends: side.map(|c| corners[c]), above, axis: number / 2, quadrilateral });
            }
        }
        sides.sort_unstable();
        sides
    }
}

impl AreaTriangles {
    /// Adds the triangles of both ends of a side with a vertex below and one above.
    fn across(&mut self, side: &Side, [low, high]: [u32; 2]) {
        let [a, b] = side.ends;
        // Along x from below to above, the side runs along y, to the left.
        let triangles =
            if side.axis == 0 { [[low, a, high], [low, high, b]] } else { [[low, high, a], [low, b, high]] };
        for triangle in triangles {
            self.triangles.push(triangle);
            self.quadrilaterals.push(side.quadrilateral);
        }
    }
}
