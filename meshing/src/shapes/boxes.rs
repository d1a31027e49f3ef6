//! Boxes with faces along the axes, alone and in pairs: [`box_`], [`two_boxes`], [`nested_boxes`],
//! [`coincident_boxes`].
//!
//! Method: each side is divided evenly, each grid square into two triangles whose diagonals alternate, so that no
//! corner of the box is cut off by one triangle only on one side. Corners and edges are exact.

use super::error::{
    ShapeError, divisions, finish, require, require_coordinates, require_length, require_triangles,
};
use crate::surface::{ClosedOrientedMesh, TriangleSoup};
use glam::DVec3;

/// Parameters of [`box_`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Box_ {
    /// Smallest corner. Default: (-1, -1, -1).
    pub min: DVec3,
    /// Largest corner, greater in each coordinate. Default: (1, 1, 1): the cube about the origin of volume 8.
    pub max: DVec3,
    /// Longest grid spacing, positive; diagonals are up to 1.42 times as long. Default: 0.05 (19,200 triangles).
    pub edge_length: f64,
}

impl Default for Box_ {
    fn default() -> Self {
        Self { min: DVec3::NEG_ONE, max: DVec3::ONE, edge_length: 0.05 }
    }
}

/// Parameters of [`two_boxes`], [`nested_boxes`] and [`coincident_boxes`], whose defaults differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxPair {
    /// Smallest and largest corner of the first box.
    pub first: [DVec3; 2],
    /// Smallest and largest corner of the second box.
    pub second: [DVec3; 2],
    /// Whether the second box is oriented inward: nested, it then is a void instead of a second sheet.
    pub second_reversed: bool,
    /// Longest grid spacing, positive.
    pub edge_length: f64,
}

impl BoxPair {
    /// Two boxes whose corners overlap: about 1/12 of each. The offset (1.13, 1.07, 1.19) is no multiple of
    /// the grid spacing, so no vertex or edge of one lies in a face of the other.
    #[must_use]
    pub fn overlapping() -> Self {
        let offset = DVec3::new(1.13, 1.07, 1.19);
        Self {
            first: [DVec3::NEG_ONE, DVec3::ONE],
            second: [DVec3::NEG_ONE + offset, DVec3::ONE + offset],
            second_reversed: false,
            edge_length: 0.1,
        }
    }

    /// A box of side 1 in the middle of one of side 2.
    #[must_use]
    pub fn nested() -> Self {
        Self {
            first: [DVec3::NEG_ONE, DVec3::ONE],
            second: [DVec3::splat(-0.5), DVec3::splat(0.5)],
            second_reversed: false,
            edge_length: 0.08,
        }
    }

    /// Two cubes of side 2 that share the face x = 1 without sharing its vertices.
    #[must_use]
    pub fn coincident() -> Self {
        Self {
            first: [DVec3::NEG_ONE, DVec3::ONE],
            second: [DVec3::new(1.0, -1.0, -1.0), DVec3::new(3.0, 1.0, 1.0)],
            second_reversed: false,
            edge_length: 0.1,
        }
    }
}

/// A box: genus 0, no self-intersection.
///
/// ```
/// use welter_meshing::shapes::{Box_, box_};
/// let mesh = box_(&Box_ { edge_length: 2.0, ..Box_::default() })?;
/// assert_eq!(mesh.triangles().len(), 12);
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn box_(parameters: &Box_) -> Result<ClosedOrientedMesh, ShapeError> {
    let &Box_ { min, max, edge_length } = parameters;
    let mut soup = TriangleSoup::default();
    require_box(["min", "max"], [min, max])?;
    require_length("edge_length", edge_length)?;
    require_triangles(edge_length, triangles([min, max], edge_length))?;
    add_box(&mut soup, [min, max], edge_length, false);
    Ok(finish(soup))
}

/// Two boxes that overlap: 2 components of genus 0; they intersect along a closed curve, inside of which the
/// winding number is 2. Start from [`BoxPair::overlapping`].
///
/// ```
/// use welter_meshing::shapes::{BoxPair, two_boxes};
/// assert_eq!(two_boxes(&BoxPair { edge_length: 9.0, ..BoxPair::overlapping() })?.triangles().len(), 24);
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn two_boxes(parameters: &BoxPair) -> Result<ClosedOrientedMesh, ShapeError> {
    let &BoxPair { first, second, second_reversed, edge_length } = parameters;
    require_box(["first", "first"], first)?;
    require_box(["second", "second"], second)?;
    require_length("edge_length", edge_length)?;
    require_triangles(edge_length, triangles(first, edge_length) + triangles(second, edge_length))?;
    let mut soup = TriangleSoup::default();
    add_box(&mut soup, first, edge_length, false);
    add_box(&mut soup, second, edge_length, second_reversed);
    Ok(finish(soup))
}

/// A box inside another: 2 components of genus 0 that do not touch. The winding number in the inner box is 2, or
/// 0 where `second_reversed` makes it a void. Start from [`BoxPair::nested`].
///
/// ```
/// use welter_meshing::shapes::{BoxPair, nested_boxes};
/// let with_void = BoxPair { edge_length: 9.0, second_reversed: true, ..BoxPair::nested() };
/// assert_eq!(nested_boxes(&with_void)?.triangles().len(), 24);
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range, and where the second box is not strictly inside the first.
pub fn nested_boxes(parameters: &BoxPair) -> Result<ClosedOrientedMesh, ShapeError> {
    let BoxPair { first: [outer_min, outer_max], second: [inner_min, inner_max], .. } = parameters;
    for axis in 0..3 {
        require(inner_min[axis] > outer_min[axis], "second", inner_min[axis], "inside the first box")?;
        require(inner_max[axis] < outer_max[axis], "second", inner_max[axis], "inside the first box")?;
    }
    two_boxes(parameters)
}

/// Two boxes with a common face, of which each has its own copy: 2 components of genus 0 that intersect in
/// coplanar triangles only. Start from [`BoxPair::coincident`].
///
/// ```
/// use welter_meshing::shapes::{BoxPair, coincident_boxes};
/// assert_eq!(coincident_boxes(&BoxPair { edge_length: 9.0, ..BoxPair::coincident() })?.triangles().len(), 24);
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range, and where no face of the second box begins in the plane where one
/// of the first ends.
pub fn coincident_boxes(parameters: &BoxPair) -> Result<ClosedOrientedMesh, ShapeError> {
    let BoxPair { first: [_, first_max], second: [second_min, _], .. } = parameters;
    let shared = (0..3).any(|axis| first_max[axis] == second_min[axis]);
    require(shared, "second", second_min.x, "beginning where the first box ends")?;
    two_boxes(parameters)
}

fn require_box(names: [&'static str; 2], [min, max]: [DVec3; 2]) -> Result<(), ShapeError> {
    require_coordinates(names[0], min)?;
    require_coordinates(names[1], max)?;
    for axis in 0..3 {
        require(min[axis] < max[axis], names[1], max[axis], "greater than the smallest corner")?;
    }
    Ok(())
}

/// Grid cells along each axis.
fn cells([min, max]: [DVec3; 2], edge_length: f64) -> [f64; 3] {
    (max - min).to_array().map(|side| divisions(side, edge_length, 1))
}

fn triangles(corners: [DVec3; 2], edge_length: f64) -> f64 {
    let [x, y, z] = cells(corners, edge_length);
    4.0 * (x * y + y * z + z * x)
}

/// The grid points on the surface of a box, numbered layer by layer: all of the bottom, the rims, all of the top.
struct Lattice {
    cells: [u32; 3],
}

impl Lattice {
    /// Points of a full layer.
    fn layer(&self) -> u32 {
        (self.cells[0] + 1) * (self.cells[1] + 1)
    }

    /// The number of a point on the surface.
    fn id(&self, [i, j, k]: [u32; 3]) -> u32 {
        let [nx, ny, nz] = self.cells;
        let full = |i: u32, j: u32| j * (nx + 1) + i;
        if k == 0 {
            return full(i, j);
        }
        let rims = self.layer() + (k - 1) * 2 * (nx + ny);
        if k == nz {
            return rims + full(i, j);
        }
        rims + match (i, j) {
            (i, 0) => i,
            (i, j) if j == ny => nx + 1 + i,
            (0, j) => 2 * (nx + 1) + j - 1,
            (_, j) => 2 * (nx + 1) + ny - 1 + j - 1,
        }
    }

    /// Every point, in the order of their numbers.
    fn points(&self) -> Vec<[u32; 3]> {
        let [nx, ny, nz] = self.cells;
        let mut points = Vec::new();
        for k in 0..=nz {
            if k == 0 || k == nz {
                points.extend((0..=ny).flat_map(|j| (0..=nx).map(move |i| [i, j, k])));
            } else {
                points.extend([0, ny].into_iter().flat_map(|j| (0..=nx).map(move |i| [i, j, k])));
                points.extend([0, nx].into_iter().flat_map(|i| (1..ny).map(move |j| [i, j, k])));
            }
        }
        points
    }
}

fn add_box(soup: &mut TriangleSoup, [min, max]: [DVec3; 2], edge_length: f64, reversed: bool) {
    let lattice = Lattice { cells: cells([min, max], edge_length).map(|count| count as u32) };
    let cells = lattice.cells;
    let first = soup.positions.len() as u32;
    soup.positions.extend(lattice.points().into_iter().map(|point| {
        DVec3::from_array(std::array::from_fn(|axis| {
            let t = f64::from(point[axis]) / f64::from(cells[axis]);
            // Exact at both ends.
            if t < 0.5 {
                min[axis] + t * (max[axis] - min[axis])
            } else {
                max[axis] - (1.0 - t) * (max[axis] - min[axis])
            }
        }))
    }));
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for far in [false, true] {
            for b in 0..cells[v] {
                for a in 0..cells[u] {
                    let corner = |da: u32, db: u32| {
                        let mut point = [0; 3];
                        point[axis] = if far { cells[axis] } else { 0 };
                        point[u] = a + da;
                        point[v] = b + db;
                        first + lattice.id(point)
                    };
                    // Counterclockwise about the axis: outward on the far side.
                    let quad = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                    let outward = far != reversed;
                    soup.triangles.extend(
                        split(quad, (a + b) % 2 == 1).map(
                            |[p, q, r]| {
                                if outward { [p, q, r] } else { [p, r, q] }
                            },
                        ),
                    );
                }
            }
        }
    }
}

/// Two triangles of a quadrilateral, divided along one diagonal or the other.
fn split([a, b, c, d]: [u32; 4], other: bool) -> [[u32; 3]; 2] {
    if other { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] }
}
