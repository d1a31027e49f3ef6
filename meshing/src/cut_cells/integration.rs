//! Quadrature over cut cells: points with weights, for the caller's integrand.

use glam::DVec3;

use super::cell::{fan, length, tetrahedron_volume, triangle_normal};
use super::{CutCell, CutCells};
use crate::quadrature::{CubeRule, TetrahedronRule, TriangleRule};

/// Total degree of the product of two triquadratic B-splines on a cell, as in the mass matrix: twice 2 along each of three axes.
pub const MASS_DEGREE: u32 = 12;

/// Total degree of one triquadratic B-spline, as in a lumped mass matrix and in forces.
pub const LUMPED_MASS_DEGREE: u32 = 6;

/// Total degree of a trilinear function times a derivative of a triquadratic B-spline, as in the divergence: 3 and 5.
pub const DIVERGENCE_DEGREE: u32 = 8;

/// Total degree of a trilinear function times a triquadratic B-spline, as in boundary conditions; the normal is constant on a triangle.
pub const BOUNDARY_DEGREE: u32 = 9;

/// A quadrature point in a volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumePoint {
    /// Where it is.
    pub point: DVec3,
    /// Its weight, a volume.
    pub weight: f64,
}

/// A quadrature point on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Where it is.
    pub point: DVec3,
    /// The normal there, times the weight of the point, an area: for the flux of a field.
    pub weighted_normal: DVec3,
}

impl SurfacePoint {
    /// The weight of the point, an area.
    #[must_use]
    pub fn weight(&self) -> f64 {
        length(self.weighted_normal)
    }
}

impl CutCell<'_> {
    /// Quadrature points of the negative part.
    ///
    /// ```
    /// use welter_meshing::{DVec3, Monitor, grid::{Grid3, Samples}, isosurface::MarchingCubes};
    /// use welter_meshing::{cut_cells::CutCells, quadrature::TetrahedronRule};
    /// let grid = Grid3::new([0.0; 3], 1.0, [1; 3])?;
    /// let samples = Samples::of(&grid, &|p: DVec3| p.x + p.y + p.z - 0.5, &Monitor::none())?;
    /// let cells = CutCells::new(&samples, &MarchingCubes::default(), &Monitor::none())?;
    /// let rule = TetrahedronRule::of_degree(3)?;
    /// let moment: f64 = cells.get(0).volume_points(&rule).map(|q| q.weight * q.point.x * q.point.y * q.point.z).sum();
    /// assert!((moment - 0.5_f64.powi(6) / 720.0).abs() < 1e-18);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn volume_points<'r>(
        &self,
        rule: &'r TetrahedronRule,
    ) -> impl Iterator<Item = VolumePoint> + use<'r> {
        self.tetrahedra().flat_map(move |corners| {
            let volume = tetrahedron_volume(corners);
            rule.points()
                .iter()
                .map(move |(l, w)| VolumePoint { point: mix(&corners, l), weight: w * volume })
        })
    }

    /// Quadrature points of the surface in the cell; normals point to the positive side.
    pub fn surface_points<'r>(&self, rule: &'r TriangleRule) -> impl Iterator<Item = SurfacePoint> + use<'r> {
        self.triangles().flat_map(move |corners| on_triangle(corners, rule))
    }

    /// Quadrature points of the negative part of a face of the cell; normals point out of the cell.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn face_points<'r>(
        &self,
        face: usize,
        rule: &'r TriangleRule,
    ) -> impl Iterator<Item = SurfacePoint> + use<'r> {
        let triangles: Vec<_> = fan(&self.face(face)).collect();
        triangles.into_iter().flat_map(move |corners| on_triangle(corners, rule))
    }
}

impl CutCells {
    /// Quadrature points of a cell as a whole, for those inside.
    pub fn cell_points<'r>(
        &self,
        index: [u32; 3],
        rule: &'r CubeRule,
    ) -> impl Iterator<Item = VolumePoint> + use<'r> {
        let (start, spacing) = (self.grid().position(index), self.grid().spacing());
        let volume = spacing.powi(3);
        rule.points().iter().map(move |&(at, w)| VolumePoint {
            point: start + spacing * DVec3::from_array(at),
            weight: w * volume,
        })
    }
}

fn on_triangle(corners: [DVec3; 3], rule: &TriangleRule) -> impl Iterator<Item = SurfacePoint> + use<'_> {
    let normal = triangle_normal(corners);
    rule.points()
        .iter()
        .map(move |(l, w)| SurfacePoint { point: mix(&corners, l), weighted_normal: *w * normal })
}

/// The point with barycentric coordinates, as the first corner and multiples of sides: so that a small simplex far away keeps its digits.
fn mix<const N: usize>(corners: &[DVec3; N], coordinates: &[f64; N]) -> DVec3 {
    let first = corners[0];
    let from_first: DVec3 = corners.iter().zip(coordinates).skip(1).map(|(&c, &l)| l * (c - first)).sum();
    first + from_first
}
