//! [`RemeshReport`]: what was done and what came out.

use super::shape::area_vector;
use super::workpiece::Workpiece;
use crate::DVec3;
use crate::field::ScalarField;

/// The lengths of all edges.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EdgeLengths {
    /// Smallest length.
    pub min: f64,
    /// One edge in a hundred is shorter.
    pub first_percentile: f64,
    /// Mean length.
    pub mean: f64,
    /// One edge in a hundred is longer.
    pub last_percentile: f64,
    /// Largest length.
    pub max: f64,
    /// Share of the edges with lengths between half and three halves of the mean.
    pub near_mean: f64,
}

impl EdgeLengths {
    /// Of a list of lengths; zeros for an empty list.
    fn of(mut lengths: Vec<f64>) -> Self {
        lengths.sort_unstable_by(f64::total_cmp);
        let (Some(&min), Some(&max)) = (lengths.first(), lengths.last()) else { return Self::default() };
        let count = lengths.len() as f64;
        let mean = lengths.iter().sum::<f64>() / count;
        let near = lengths.iter().filter(|&&length| (0.5 * mean..=1.5 * mean).contains(&length)).count();
        let at = |percent: usize| lengths[(lengths.len() - 1) * percent / 100];
        Self {
            min,
            first_percentile: at(1),
            mean,
            last_percentile: at(99),
            max,
            near_mean: near as f64 / count,
        }
    }
}

/// What [`equilateral`](super::equilateral) did, and the shape of the triangles it made.
#[must_use]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct RemeshReport {
    /// Edges split.
    pub splits: u64,
    /// Edges collapsed.
    pub collapses: u64,
    /// Edges flipped.
    pub flips: u64,
    /// Moves of vertices.
    pub moves: u64,
    /// Changes that were not made because of the shape of the triangles they would have made.
    pub refused_for_shape: u64,
    /// Changes that were not made because the surface would have met itself.
    pub refused_for_intersection: u64,
    /// Vertices that are not on the zero set: no zero was found near them, or the way there was refused.
    pub off_surface: u64,
    /// Smallest angle of all triangles, in radians; pi/3 if there are none.
    pub smallest_angle: f64,
    /// Largest angle of all triangles, in radians; pi/3 if there are none.
    pub largest_angle: f64,
    /// Lengths of edges.
    pub edges: EdgeLengths,
}

impl RemeshReport {
    /// Fills in the shape of the triangles.
    pub(super) fn measure<F: ScalarField>(&mut self, piece: &Workpiece<'_, F>) {
        self.refused_for_shape = piece.refused.shape;
        self.refused_for_intersection = piece.refused.intersection;
        self.edges = EdgeLengths::of(piece.mesh.edges().map(|h| piece.squared(h).sqrt()).collect());
        let third = std::f64::consts::FRAC_PI_3;
        (self.smallest_angle, self.largest_angle) = (third, third);
        for t in piece.mesh.triangles() {
            for angle in angles(piece.corners(t)) {
                self.smallest_angle = self.smallest_angle.min(angle);
                self.largest_angle = self.largest_angle.max(angle);
            }
        }
    }
}

/// The angles at the corners.
fn angles([a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let area = area_vector([a, b, c]).length();
    [[a, b, c], [b, c, a], [c, a, b]].map(|[p, q, r]| libm::atan2(area, (q - p).dot(r - p)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_known_lengths() {
        let lengths = EdgeLengths::of((1..=101).map(f64::from).rev().collect());
        assert_eq!((lengths.min, lengths.mean, lengths.max), (1.0, 51.0, 101.0));
        assert_eq!((lengths.first_percentile, lengths.last_percentile), (2.0, 100.0));
        assert_eq!(lengths.near_mean, 51.0 / 101.0); // 26 to 76
        assert_eq!(EdgeLengths::of(Vec::new()), EdgeLengths::default());
    }

    #[test]
    fn angles_of_a_known_triangle() {
        let [right, half, other] = angles([DVec3::ZERO, DVec3::X, DVec3::Y]).map(f64::to_degrees);
        assert!((right - 90.0).abs() < 1e-12 && (half - 45.0).abs() < 1e-12 && (other - 45.0).abs() < 1e-12);
    }
}
