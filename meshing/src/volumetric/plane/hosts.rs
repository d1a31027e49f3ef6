//! Where the curve is in the mesh: [`AreaHosts`].

use super::ClosedPolylines;
use super::front::Front;
use crate::grid::Grid3;
use crate::volumetric::extension::Extension;
use crate::volumetric::hosts::within;

/// A corner of the curve in a quadrilateral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaHost {
    /// The quadrilateral.
    pub quadrilateral: u32,
    /// Coordinates within its cell, each from 0 to 1.
    pub at: [f64; 2],
}

impl AreaHost {
    /// The weights of the four corners of the quadrilateral; bilinear, so the position of the corner of the curve is the weighted sum of theirs.
    ///
    /// ```
    /// use welter_meshing::volumetric::plane::AreaHost;
    /// assert_eq!(AreaHost { quadrilateral: 0, at: [0.25, 1.0] }.weights(), [0.0, 0.0, 0.75, 0.25]);
    /// ```
    #[must_use]
    pub fn weights(&self) -> [f64; 4] {
        let [x, y] = self.at;
        [(1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y]
    }
}

/// Where the curve is in the mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct AreaHosts {
    /// The host of each corner of the curve; those of one index may lie on different sheets.
    pub corners: Vec<AreaHost>,
    /// Each quadrilateral and segment where a segment passes through a quadrilateral, sorted.
    pub segments: Vec<[u32; 2]>,
}

impl AreaHosts {
    /// The segments in a quadrilateral, ascending, each after its number.
    #[must_use]
    pub fn in_quadrilateral(&self, quadrilateral: u32) -> &[[u32; 2]] {
        let begin = self.segments.partition_point(|pair| pair[0] < quadrilateral);
        let end = begin + self.segments[begin..].partition_point(|pair| pair[0] == quadrilateral);
        &self.segments[begin..end]
    }

    /// From the hexahedra of the extension and what became of each.
    pub(super) fn new(curves: &ClosedPolylines, grid: &Grid3, extension: &Extension, became: &[u32]) -> Self {
        let front = Front::new(curves, grid);
        let corners = (0..curves.len() as u32)
            .map(|segment| {
                let p = curves.segment(segment)[0];
                let [i, j] = front.cell_at(p);
                let number = extension.cell_at(j as usize, i).expect("a segment meets the cell of its end");
                let hexahedron =
                    extension.hexahedron_of(number, segment).expect("the segment is in its list");
                let [x, y, _] = within(grid, [i, j, 0], p.extend(0.0));
                AreaHost { quadrilateral: became[hexahedron as usize], at: [x, y] }
            })
            .collect();
        let mut segments = Vec::new();
        for number in 0..extension.cells().items().len() {
            let (list, hexahedra) = extension.triangles(number);
            let pairs = list.iter().zip(hexahedra);
            segments.extend(pairs.map(|(precursor, &h)| [became[h as usize], precursor.triangle]));
        }
        segments.sort_unstable();
        segments.dedup();
        Self { corners, segments }
    }
}
