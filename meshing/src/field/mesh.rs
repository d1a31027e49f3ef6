//! The signed distance to a closed mesh: [`MeshDistance`].
//!
//! # What it promises
//! * The magnitude is the distance of [`Bvh::closest_point`](crate::spatial::Bvh::closest_point), with the bound stated there.
//! * The sign is exact: it comes from the winding number, by predicates, so it is defined for surfaces that pass through themselves.
//!   On the surface the value is zero.
//!
//! # What it does not promise
//! That zero is only met at the border of the inside: where parts overlap, the mesh has triangles with inside on both
//! sides, and the field is zero on these and negative around them. An offset outward does not see them.
//!
//! # Complexity
//! O(log n) for each of the two queries in practice. All nodes of a grid at once go by
//! [`signed_distance`](crate::distance::signed_distance), which is some fifty times faster and gives the same values.

use glam::DVec3;

use crate::distance::{DistanceError, DistanceParameters, InsideRule, signed_distance};
use crate::field::{ScalarField, direction, grown};
use crate::grid::Grid3;
use crate::spatial::{Box3, Winding, WindingNumbers};
use crate::surface::ClosedOrientedMesh;
use crate::{Cancelled, Monitor};

/// The signed distance to a closed mesh, which may intersect itself.
///
/// Its gradient leads away from the nearest point of the mesh; on the mesh it is the normal of the nearest triangle, and x if
/// that has none.
///
/// ```
/// use welter_meshing::{DVec3, distance::InsideRule, field::{MeshDistance, Offset, ScalarField}, shapes::{Box_, box_}};
/// let mesh = box_(&Box_::default())?; // [-1, 1]^3
/// let field = MeshDistance::new(&mesh, InsideRule::default());
/// assert_eq!(field.value(DVec3::ZERO), -1.0);
/// let larger = Offset { field, distance: 0.5 };
/// assert_eq!(larger.value(DVec3::new(2.0, 0.3, 0.0)), 0.5);
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
#[derive(Clone, Debug)]
pub struct MeshDistance<'m> {
    mesh: &'m ClosedOrientedMesh,
    numbers: WindingNumbers<'m>,
    inside: InsideRule,
    around: Box3,
}

impl<'m> MeshDistance<'m> {
    /// Builds a hierarchy for the mesh.
    #[must_use]
    pub fn new(mesh: &'m ClosedOrientedMesh, inside: InsideRule) -> Self {
        let used = mesh.triangles().iter().flatten().map(|v| mesh.positions()[v.0 as usize]);
        Self { mesh, numbers: WindingNumbers::new(mesh), inside, around: Box3::of(used) }
    }
}

impl ScalarField for MeshDistance<'_> {
    fn value(&self, point: DVec3) -> f64 {
        let Some(closest) = self.numbers.bvh().closest_point(point) else {
            return if point.is_finite() { f64::INFINITY } else { f64::NAN };
        };
        match self.numbers.at(point) {
            Winding::Number(number) if self.inside.holds(number) => -closest.distance,
            Winding::Number(_) => closest.distance,
            Winding::OnSurface { .. } => 0.0,
            Winding::NotFinite => f64::NAN,
        }
    }

    fn gradient(&self, point: DVec3, _step: f64) -> DVec3 {
        let Some(closest) = self.numbers.bvh().closest_point(point) else {
            return DVec3::ZERO;
        };
        let [a, b, c] = self.numbers.bvh().mesh().corners(closest.triangle);
        let normal = direction((b - a).cross(c - a), DVec3::X);
        match self.numbers.at(point) {
            Winding::Number(number) if self.inside.holds(number) => direction(closest.point - point, normal),
            Winding::Number(_) => direction(point - closest.point, normal),
            _ => normal,
        }
    }

    fn sublevel_bounds(&self, level: f64) -> Option<Box3> {
        // A segment from an inner point to the nearest side of the box leaves the solid: the depth is at most that distance.
        Some(if self.around.is_empty() { Box3::EMPTY } else { grown(&self.around, level) })
    }

    fn knows_nodes(&self) -> bool {
        true
    }

    fn at_nodes(&self, grid: &Grid3, monitor: &Monitor<'_>) -> Result<Vec<f64>, Cancelled> {
        let parameters = DistanceParameters { inside: self.inside, ..DistanceParameters::default() };
        match signed_distance(self.mesh, grid, &parameters, monitor) {
            Ok(field) => Ok(field.distances.into_values()),
            Err(DistanceError::Cancelled(cancelled)) => Err(cancelled),
            Err(error) => unreachable!("no parameter was chosen: {error}"),
        }
    }
}
