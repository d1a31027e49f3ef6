//! Numbers of a surface: area, volume, extent, curvature, angles and edge lengths.
//!
//! Promises: no overflow and no NaN on the way, whatever the coordinates of a [`TriMesh`](super::TriMesh):
//! everything is computed on coordinates scaled by a power of two (which is exact) to the extent of the
//! surface. [`area_bounded`] and [`signed_volume_bounded`] state how far the true value can be; they also
//! express values beyond the range of `f64`. Scaling a mesh by a power of two scales the results bit for bit (short
//! of subnormal ones), and a translation that is exact for every vertex changes no bit of them. The same bits for any
//! number of threads.
//!
//! Does not promise: exact values; these are constructions. Signs that matter are to be asked of predicates,
//! or taken from a value that exceeds its bound ([`Bounded::sign`]).
//!
//! Method: coordinate differences, scaled; compensated sums \[Neumaier74\] over chunks of fixed size, combined
//! in order. Complexity: linear, parallel.

mod bounded;
mod curvature;
mod extent;
mod statistics;
pub(crate) mod sum;
mod volume;

pub use bounded::Bounded;
pub use curvature::{MeanCurvature, mean_curvature_normals};
pub use extent::{BoundingBox, bounding_box};
pub use statistics::{
    ANGLE_BINS, AngleStatistics, EdgeLengthStatistics, angle_statistics, edge_length_statistics,
};
pub use volume::{
    area, area_bounded, component_volumes, inside_out_components, signed_volume, signed_volume_bounded,
};
