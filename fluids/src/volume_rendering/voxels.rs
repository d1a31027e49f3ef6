//! The volume of smoke in each voxel of a lattice, from its surface.
//!
//! # What it computes
//! For every voxel the integral of the winding number over it: the volume inside, of a surface that is
//! embedded and oriented outward; overlaps count twice, parts turned inside out negatively.
//!
//! # What it promises
//! Exact up to rounding: every triangle is clipped to the voxels it passes, no sample is taken. The sum over
//! all voxels is the signed volume of the surface. The same bits for any number of threads.
//!
//! # Method
//! The winding number of a point is the sum, over the triangles that the ray from it along the third axis
//! crosses, of +1 where the ray leaves the inside and -1 where it enters. So a triangle adds to each voxel
//! the signed volume of the part that lies before it along that axis: in the voxel that holds a piece of it,
//! the prism from the near face to the piece; in all nearer voxels of the column, the area of the piece times
//! the side. The areas are carried to the nearer voxels by one sum along each column. Pieces are clipped
//! polygons \[Sutherland74, Brochu12, section 6.6\]; bands of rows go in parallel, in each the triangles in
//! order.
//!
//! # Complexity
//! Linear in the pieces and in the voxels.

use glam::DVec3;
use rayon::prelude::*;

use super::clip::{Corner, Polygon};

/// Rows of voxels that a thread takes at once. Chosen by trial: fewer repeat the search for triangles, more
/// leave threads idle.
const BAND: usize = 4;

/// The integral of the winding number over each voxel, voxels along the third axis together, then along the
/// first. Corners are in lattice coordinates, within the lattice.
pub(super) fn volumes(corners: &[[DVec3; 3]], size: [usize; 3]) -> Vec<f64> {
    let [nx, ny, nz] = size;
    let mut volumes = vec![0.0; nx * ny * nz];
    if volumes.is_empty() {
        return volumes;
    }
    volumes.par_chunks_mut(nx * nz * BAND).enumerate().for_each(|(band, volumes)| {
        let first = band * BAND;
        let mut areas = vec![0.0; volumes.len()];
        let mut slab = Slab { first, size, areas: &mut areas, volumes };
        let rows = (first as f64, (first + BAND) as f64);
        for triangle in corners {
            let [a, b, c] = triangle.map(|p| p.y);
            if a.min(b).min(c) < rows.1 && a.max(b).max(c) > rows.0 {
                slab.add(triangle);
            }
        }
        slab.carry();
    });
    volumes
}

/// Some rows of voxels.
struct Slab<'a> {
    first: usize,
    size: [usize; 3],
    /// Signed areas of pieces, across the third axis, in each voxel.
    areas: &'a mut [f64],
    volumes: &'a mut [f64],
}

impl Slab<'_> {
    fn add(&mut self, triangle: &[DVec3; 3]) {
        let [nx, ny, nz] = self.size;
        let whole = Polygon::triangle(triangle.map(|point| Corner { point, value: 0.0 }));
        let (mut row, mut column, mut piece) = (whole, whole, whole);
        let mut spare = whole;
        let last_row = (self.first + BAND).min(ny) - 1;
        for j in cells(&whole, 1, self.first, last_row) {
            clip_to_cell(&whole, 1, j, &mut row, &mut spare);
            for i in cells(&row, 0, 0, nx - 1) {
                clip_to_cell(&row, 0, i, &mut column, &mut spare);
                for k in cells(&column, 2, 0, nz - 1) {
                    clip_to_cell(&column, 2, k, &mut piece, &mut spare);
                    let (area, volume) = prism(piece.corners(), k as f64);
                    let at = ((j - self.first) * nx + i) * nz + k;
                    self.areas[at] += area;
                    self.volumes[at] += volume;
                }
            }
        }
    }

    /// Adds the areas beyond each voxel to its volume.
    fn carry(&mut self) {
        let nz = self.size[2];
        for (areas, volumes) in self.areas.chunks(nz).zip(self.volumes.chunks_mut(nz)) {
            let mut beyond = 0.0;
            for (area, volume) in areas.iter().zip(volumes).rev() {
                *volume += beyond;
                beyond += area;
            }
        }
    }
}

/// Which cells along an axis, within bounds, a polygon meets.
#[inline]
fn cells(polygon: &Polygon, axis: usize, first: usize, last: usize) -> std::ops::RangeInclusive<usize> {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for corner in polygon.corners() {
        low = low.min(corner.point[axis]);
        high = high.max(corner.point[axis]);
    }
    // The casts saturate: a polygon that was cut down to nothing has one cell at most, to which it adds
    // nothing.
    (low as usize).clamp(first, last.max(first))..=(high as usize).min(last)
}

/// The part of a polygon between two lattice planes.
#[inline]
fn clip_to_cell(polygon: &Polygon, axis: usize, cell: usize, result: &mut Polygon, spare: &mut Polygon) {
    let (low, high) = (cell as f64, (cell + 1) as f64);
    let below = polygon.corners().iter().any(|c| c.point[axis] < low);
    let above = polygon.corners().iter().any(|c| c.point[axis] > high);
    match (below, above) {
        (false, false) => result.assign(polygon),
        (true, false) => polygon.cut(|p| p[axis] - low, |p| p[axis] = low, result),
        (false, true) => polygon.cut(|p| high - p[axis], |p| p[axis] = high, result),
        (true, true) => {
            polygon.cut(|p| p[axis] - low, |p| p[axis] = low, spare);
            spare.cut(|p| high - p[axis], |p| p[axis] = high, result);
        }
    }
}

/// The signed area of a polygon across the third axis, and the signed volume between it and the plane at
/// `base` of that axis.
#[inline]
fn prism(corners: &[Corner], base: f64) -> (f64, f64) {
    let Some((first, rest)) = corners.split_first() else { return (0.0, 0.0) };
    let a = first.point;
    let (mut twice_area, mut volume) = (0.0, 0.0);
    for pair in rest.windows(2) {
        let (b, c) = (pair[0].point, pair[1].point);
        let twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        twice_area += twice;
        volume += twice * ((a.z - base) + (b.z - base) + (c.z - base));
    }
    (0.5 * twice_area, volume / 6.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The faces of a box, outward.
    fn cuboid(low: DVec3, high: DVec3) -> Vec<[DVec3; 3]> {
        let corner = |bits: usize| {
            DVec3::from_array([0, 1, 2].map(|a| if bits >> a & 1 == 1 { high[a] } else { low[a] }))
        };
        let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]].map(|t| t.map(corner))).collect()
    }

    #[test]
    fn a_box_fills_voxels_by_the_product_of_overlaps() {
        let (low, high) = (DVec3::new(0.3, 1.25, 0.0), DVec3::new(5.0, 9.75, 3.4));
        let size = [5, 11, 4];
        let volumes = volumes(&cuboid(low, high), size);
        for j in 0..size[1] {
            for i in 0..size[0] {
                for k in 0..size[2] {
                    let overlap = |axis: usize, cell: usize| {
                        (high[axis].min(cell as f64 + 1.0) - low[axis].max(cell as f64)).max(0.0)
                    };
                    let expected = overlap(0, i) * overlap(1, j) * overlap(2, k);
                    let volume = volumes[(j * size[0] + i) * size[2] + k];
                    assert!((volume - expected).abs() < 1e-14, "{i} {j} {k}: {volume} {expected}");
                }
            }
        }
    }

    #[test]
    fn planes_of_the_lattice_may_be_faces() {
        let full = volumes(&cuboid(DVec3::ZERO, DVec3::new(2.0, 1.0, 3.0)), [2, 1, 3]);
        assert_eq!(full, [1.0; 6]);
        let reversed: Vec<_> =
            cuboid(DVec3::ZERO, DVec3::ONE).into_iter().map(|[a, b, c]| [a, c, b]).collect();
        assert_eq!(volumes(&reversed, [1, 1, 1]), [-1.0]);
        assert!(volumes(&[], [0, 0, 0]).is_empty());
    }
}
