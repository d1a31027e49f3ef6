//! Area and signed volume, with error bounds: [`area`], [`signed_volume`].
//!
//! Volume, for triangles `(a, b, c)` of a closed oriented surface and any point `o`:
//! ```text
//!   6 V = sum of det [a - o; b - a; c - a]
//! ```
//! With `o` the smallest corner of the bounding box, and each axis scaled to its extent, all entries are at
//! most 1 in magnitude, so neither a far-away surface nor a flat one loses digits to its place or
//! proportions; and since two of the rows are sides of the triangle, errors are in proportion to areas, not
//! to the number of triangles.
//!
//! Error of a term, with `u = 2^-53` and `p` the determinant with magnitudes for its entries and plus for minus:
//! an entry carries one rounding, a product of three entries two more, the sums of the expression three; so at most
//! `8 u p (1 + 16 u)`. The bound below uses 9 to pay for itself.
//!
//! Area: half the length of the cross product of two sides, each coordinate one rounding off. A coordinate of
//! the cross product is off by at most `4.1 u` times the sum of the magnitudes of its two products (`2 u`
//! from the entries, `u` from the product, `u` from the difference); so its length is off by at most `4.1 u`
//! times the length of the vector of those sums, and `3 u` of itself from the norm.

use super::bounded::Bounded;
use super::extent::{self, Scale};
use super::sum::sums;
use crate::surface::{Topology, TriMesh, VertexId};
use glam::{DVec3, Vec3Swizzles};
use rayon::prelude::*;
use welter_predicates::Sign;

/// Half the distance from 1 to the next number: the relative error of one rounding.
const U: f64 = f64::EPSILON / 2.0;

/// Pays for the sum of up to 2^31 error terms being rounded itself, and for terms of second order.
const SLACK: f64 = 1.0 + 1e-6;

/// The area: the sum over all triangles. Infinite only where it is beyond the range of `f64`.
///
/// ```
/// use welter_meshing::{shapes, surface::measure::area};
/// let cube = shapes::box_(&shapes::Box_ { edge_length: 2.0, ..shapes::Box_::default() })?;
/// assert_eq!(area(&cube), 24.0);
/// # Ok::<(), shapes::ShapeError>(())
/// ```
#[must_use]
pub fn area(mesh: &TriMesh) -> f64 {
    area_bounded(mesh).value()
}

/// The area with its error bound.
///
/// ```
/// use welter_meshing::{shapes, surface::measure::area_bounded};
/// let cube = shapes::box_(&shapes::Box_::default())?;
/// let area = area_bounded(&cube);
/// assert!((area.value() - 24.0).abs() <= area.error_bound() && area.error_bound() < 1e-12);
/// # Ok::<(), shapes::ShapeError>(())
/// ```
#[must_use]
pub fn area_bounded(mesh: &TriMesh) -> Bounded {
    let Some(bounds) = extent::bounding_box(mesh) else { return ZERO };
    let scale = Scale::of_box(bounds);
    let [twice, magnitudes] = sums(mesh.triangles(), |&[a, b, c]| {
        let [a, b, c] = [a, b, c].map(|v| mesh.positions()[v.index()]);
        let (p, q) = (scale.vector(b, a), scale.vector(c, a));
        [p.cross(q).length(), cross_magnitudes(p, q).length()]
    });
    let bound = 0.5 * (4.1 * magnitudes + 5.0 * twice) * U * SLACK + underflow(mesh.triangles());
    Bounded { significand: 0.5 * twice, bound, exponent: 2 * scale.exponent }
}

/// The volume that the surface encloses, counted with its winding number: positive where triangles are
/// counterclockwise seen from outside. Infinite only where it is beyond the range of `f64`. For a surface
/// with boundary, that of the cone over it from the smallest corner of its bounding box.
///
/// ```
/// use welter_meshing::{shapes, surface::measure::signed_volume};
/// let cube = shapes::box_(&shapes::Box_ { edge_length: 2.0, ..shapes::Box_::default() })?;
/// assert_eq!(signed_volume(&cube), 8.0);
/// assert_eq!(signed_volume(&cube.reversed()), -8.0);
/// # Ok::<(), shapes::ShapeError>(())
/// ```
#[must_use]
pub fn signed_volume(mesh: &TriMesh) -> f64 {
    signed_volume_bounded(mesh).value()
}

/// The signed volume with its error bound.
///
/// ```
/// use welter_meshing::{shapes, surface::measure::signed_volume_bounded};
/// use welter_predicates::Sign;
/// let cube = shapes::box_(&shapes::Box_::default())?;
/// let volume = signed_volume_bounded(&cube);
/// assert!((volume.value() - 8.0).abs() <= volume.error_bound() && volume.error_bound() < 1e-12);
/// assert_eq!(volume.sign(), Sign::Positive);
/// # Ok::<(), shapes::ShapeError>(())
/// ```
#[must_use]
pub fn signed_volume_bounded(mesh: &TriMesh) -> Bounded {
    volume_of(mesh.positions(), mesh.triangles())
}

/// The signed volume of each component, in the order of [`Topology::components`].
///
/// ```
/// use welter_meshing::{shapes, surface::{Topology, measure::component_volumes}};
/// let mesh = shapes::by_name("box-with-void", None)?;
/// let volumes = component_volumes(&mesh, &Topology::of(&mesh));
/// assert!(volumes[0].value() > 7.9 && volumes[1].value() < -0.9);
/// # Ok::<(), shapes::ShapeError>(())
/// ```
#[must_use]
pub fn component_volumes(mesh: &TriMesh, topology: &Topology) -> Vec<Bounded> {
    (0..topology.components().len())
        .into_par_iter()
        .map(|component| {
            let ids = topology.component_triangles(component);
            let triangles: Vec<_> = ids.iter().map(|t| mesh.triangles()[t.index()]).collect();
            volume_of(mesh.positions(), &triangles)
        })
        .collect()
}

/// The components, as indices into [`Topology::components`], that are closed and oriented and have negative volume
/// beyond doubt: solids turned inside out, or the walls of voids.
///
/// ```
/// use welter_meshing::{shapes, surface::{Topology, measure::inside_out_components}};
/// let mesh = shapes::by_name("box-with-void", None)?;
/// assert_eq!(inside_out_components(&mesh, &Topology::of(&mesh)), [1]);
/// # Ok::<(), shapes::ShapeError>(())
/// ```
#[must_use]
pub fn inside_out_components(mesh: &TriMesh, topology: &Topology) -> Vec<usize> {
    let volumes = component_volumes(mesh, topology);
    let inside_out = |&i: &usize| {
        let component = &topology.components()[i];
        component.closed && component.oriented && volumes[i].sign() == Sign::Negative
    };
    (0..volumes.len()).filter(inside_out).collect()
}

const ZERO: Bounded = Bounded { significand: 0.0, bound: 0.0, exponent: 0 };

/// What products that underflow can lose. At most 16 a triangle, each less than the smallest normal number.
fn underflow(triangles: &[[VertexId; 3]]) -> f64 {
    16.0 * triangles.len() as f64 * f64::MIN_POSITIVE
}

/// The cross product with magnitudes for its products and plus for minus.
fn cross_magnitudes(p: DVec3, q: DVec3) -> DVec3 {
    let (p, q) = (p.abs(), q.abs());
    p.yzx() * q.zxy() + p.zxy() * q.yzx()
}

fn volume_of(positions: &[DVec3], triangles: &[[VertexId; 3]]) -> Bounded {
    let Some(bounds) = extent::of_triangles(positions, triangles) else { return ZERO };
    let scales = [0, 1, 2].map(|axis| Scale::of_interval(bounds.min[axis], bounds.max[axis]));
    let difference = |p: DVec3, q: DVec3| {
        DVec3::from_array([0, 1, 2].map(|axis| scales[axis].difference(p[axis], q[axis])))
    };
    let [six_fold, magnitudes] = sums(triangles, |&[a, b, c]| {
        let [a, b, c] = [a, b, c].map(|v| positions[v.index()]);
        let (p, q, r) = (difference(a, bounds.min), difference(b, a), difference(c, a));
        [p.dot(q.cross(r)), p.dot(cross_magnitudes(q, r))]
    });
    Bounded {
        significand: six_fold / 6.0,
        bound: (9.0 * magnitudes + 3.0 * six_fold.abs()) * U * SLACK / 6.0 + underflow(triangles),
        exponent: scales.iter().map(|scale| scale.exponent).sum(),
    }
}
