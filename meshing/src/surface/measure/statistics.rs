//! How well shaped the triangles are: [`angle_statistics`], [`edge_length_statistics`].

use super::extent::{self, Scale};
use super::sum::{CHUNK, sums};
use crate::surface::{EdgeId, Topology, TriId, TriMesh};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Bins of the histogram of angles: of 10 degrees each.
pub const ANGLE_BINS: usize = 18;

/// The angles of all triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct AngleStatistics {
    /// Smallest angle, in radians.
    pub min: f64,
    /// The first triangle that has it.
    pub min_at: TriId,
    /// Largest angle, in radians.
    pub max: f64,
    /// The first triangle that has it.
    pub max_at: TriId,
    /// How many angles there are in each range of 10 degrees; one of 180 degrees counts in the last.
    pub histogram: [u64; ANGLE_BINS],
}

impl AngleStatistics {
    fn of_triangle(mesh: &TriMesh, scale: &Scale, triangle: TriId) -> Self {
        let x = mesh.corners(triangle);
        let angles = [0, 1, 2].map(|k| {
            let (p, q) = (scale.vector(x[(k + 1) % 3], x[k]), scale.vector(x[(k + 2) % 3], x[k]));
            libm::atan2(p.cross(q).length(), p.dot(q))
        });
        let mut histogram = [0; ANGLE_BINS];
        for angle in angles {
            histogram[((angle * (ANGLE_BINS as f64 / PI)) as usize).min(ANGLE_BINS - 1)] += 1;
        }
        let [a, b, c] = angles;
        Self { min: a.min(b).min(c), min_at: triangle, max: a.max(b).max(c), max_at: triangle, histogram }
    }

    /// Of these triangles and of later ones.
    fn and(self, later: Self) -> Self {
        let (min, min_at) =
            if later.min < self.min { (later.min, later.min_at) } else { (self.min, self.min_at) };
        let (max, max_at) =
            if later.max > self.max { (later.max, later.max_at) } else { (self.max, self.max_at) };
        let mut histogram = self.histogram;
        for (bin, count) in histogram.iter_mut().zip(later.histogram) {
            *bin += count;
        }
        Self { min, min_at, max, max_at, histogram }
    }
}

/// The angles at the corners of all triangles; none of a mesh without triangles. Each is within 1e-15 of the angle
/// between the sides as rounded; a corner on a side of length zero counts as angle 0.
///
/// ```
/// use welter_meshing::{shapes, surface::measure::angle_statistics};
/// let cube = shapes::box_(&shapes::Box_::default())?;
/// let angles = angle_statistics(&cube).expect("it has triangles");
/// assert!((angles.min.to_degrees() - 45.0).abs() < 1e-9 && (angles.max.to_degrees() - 90.0).abs() < 1e-9);
/// # Ok::<(), shapes::ShapeError>(())
/// ```
#[must_use]
pub fn angle_statistics(mesh: &TriMesh) -> Option<AngleStatistics> {
    let scale = Scale::of_box(extent::bounding_box(mesh)?);
    let chunks: Vec<_> = (0..mesh.triangles().len().div_ceil(CHUNK))
        .into_par_iter()
        .filter_map(|chunk| {
            let triangles = chunk * CHUNK..mesh.triangles().len().min((chunk + 1) * CHUNK);
            triangles
                .map(|t| AngleStatistics::of_triangle(mesh, &scale, TriId::from_index(t)))
                .reduce(AngleStatistics::and)
        })
        .collect();
    chunks.into_iter().reduce(AngleStatistics::and)
}

/// The lengths of all edges, each counted once. Infinite where beyond the range of `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct EdgeLengthStatistics {
    /// Smallest length.
    pub min: f64,
    /// The first edge that has it.
    pub min_at: EdgeId,
    /// Largest length.
    pub max: f64,
    /// The first edge that has it.
    pub max_at: EdgeId,
    /// Mean length.
    pub mean: f64,
}

/// The lengths of all edges; none of a mesh without triangles.
///
/// ```
/// use welter_meshing::{shapes, surface::{Topology, measure::edge_length_statistics}};
/// let cube = shapes::box_(&shapes::Box_ { edge_length: 2.0, ..Default::default() })?;
/// let lengths = edge_length_statistics(&cube, &Topology::of(&cube)).expect("it has triangles");
/// assert_eq!((lengths.min, lengths.max), (2.0, 8.0_f64.sqrt()));
/// # Ok::<(), shapes::ShapeError>(())
/// ```
#[must_use]
pub fn edge_length_statistics(mesh: &TriMesh, topology: &Topology) -> Option<EdgeLengthStatistics> {
    let scale = Scale::of_box(extent::bounding_box(mesh)?);
    let edges = topology.edges();
    let lengths: Vec<f64> = edges
        .par_iter()
        .map(|edge| {
            let [a, b] = edge.map(|v| mesh.positions()[v.index()]);
            scale.vector(b, a).length()
        })
        .collect();
    let [sum] = sums(&lengths, |&length| [length]);
    let (mut least, mut most) = (0, 0);
    for (i, &length) in lengths.iter().enumerate() {
        if length < lengths[least] {
            least = i;
        }
        if length > lengths[most] {
            most = i;
        }
    }
    let unscaled = |length: f64| libm::scalbn(length, scale.exponent);
    Some(EdgeLengthStatistics {
        min: unscaled(lengths[least]),
        min_at: EdgeId::from_index(least),
        max: unscaled(lengths[most]),
        max_at: EdgeId::from_index(most),
        mean: unscaled(sum / lengths.len() as f64),
    })
}
