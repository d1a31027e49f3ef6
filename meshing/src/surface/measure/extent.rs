//! The bounding box of a surface, and scaling to it: [`bounding_box`].

use crate::surface::{TriMesh, VertexId};
use glam::DVec3;
use rayon::prelude::*;

/// The smallest box with faces along the axes that holds a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingBox {
    /// Its smallest corner.
    pub min: DVec3,
    /// Its largest corner.
    pub max: DVec3,
}

/// The bounding box of the triangles, exactly; none of a mesh without triangles. Unused vertices do not count.
///
/// ```
/// use welter_meshing::{DVec3, shapes, surface::measure::bounding_box};
/// let cube = shapes::box_(&shapes::Box_::default())?;
/// let bounds = bounding_box(&cube).expect("it has triangles");
/// assert_eq!((bounds.min, bounds.max), (DVec3::NEG_ONE, DVec3::ONE));
/// # Ok::<(), shapes::ShapeError>(())
/// ```
#[must_use]
pub fn bounding_box(mesh: &TriMesh) -> Option<BoundingBox> {
    of_triangles(mesh.positions(), mesh.triangles())
}

pub(super) fn of_triangles(positions: &[DVec3], triangles: &[[VertexId; 3]]) -> Option<BoundingBox> {
    // Minimum and maximum do not depend on the order; adding zero makes both zeros the same.
    let empty = || BoundingBox { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
    let bounds = triangles
        .par_iter()
        .fold(empty, |bounds, triangle| {
            triangle.iter().fold(bounds, |BoundingBox { min, max }, v| {
                let p = positions[v.index()] + DVec3::ZERO;
                BoundingBox { min: min.min(p), max: max.max(p) }
            })
        })
        .reduce(empty, |a, b| BoundingBox { min: a.min.min(b.min), max: a.max.max(b.max) });
    (!triangles.is_empty()).then_some(bounds)
}

/// Differences of coordinates along one axis, scaled by a power of two so that none exceeds 1 in magnitude.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Before the subtraction: 1, or 1/2 where the difference could overflow.
    before: f64,
    /// After it, in two steps, since the whole factor can be beyond the range of `f64`.
    after: [f64; 2],
    /// True lengths are 2^exponent times scaled ones.
    pub(super) exponent: i32,
}

impl Scale {
    /// For coordinates between two bounds.
    pub(super) fn of_interval(min: f64, max: f64) -> Self {
        let before = if (max - min).is_finite() { 1.0 } else { 0.5 };
        let (_, exponent) = libm::frexp(max * before - min * before);
        let half = exponent / 2;
        Self {
            before,
            after: [libm::scalbn(1.0, -half), libm::scalbn(1.0, half - exponent)],
            exponent: exponent + i32::from(before < 1.0),
        }
    }

    /// For the longest side of a box.
    pub(super) fn of_box(BoundingBox { min, max }: BoundingBox) -> Self {
        let [a, b, c] = [0, 1, 2].map(|axis| Self::of_interval(min[axis], max[axis]));
        let longest = if b.exponent > a.exponent { b } else { a };
        if c.exponent > longest.exponent { c } else { longest }
    }

    /// `(a - b) / 2^exponent`: one rounding, relative to the difference.
    pub(super) fn difference(&self, a: f64, b: f64) -> f64 {
        (a * self.before - b * self.before) * self.after[0] * self.after[1]
    }

    /// As `difference`, of each coordinate.
    pub(super) fn vector(&self, a: DVec3, b: DVec3) -> DVec3 {
        (a * self.before - b * self.before) * self.after[0] * self.after[1]
    }
}
