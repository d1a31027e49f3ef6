//! Why there is no run, or no step of it: [`SmokeError`].

use thiserror::Error;
use welter_meshing::Cancelled;
use welter_meshing::surface::{TriId, TriMeshError};
use welter_tracking::improvement::ParameterError;
use welter_tracking::integration::IntegrationError;
use welter_tracking::surface::{SurfaceDefects, UnionError};
use welter_tracking::tracker::TrackerError;

use super::EmissionError;

/// A parameter of a run that is out of range.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{name} is {value}, must be {must}")]
pub struct SmokeParameterError {
    /// Which parameter.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// What it has to be.
    pub must: &'static str,
}

/// Why there is no run, or no step of it.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum SmokeError {
    /// A parameter is out of range.
    #[error(transparent)]
    Parameter(#[from] SmokeParameterError),
    /// One of remeshing or topology is.
    #[error(transparent)]
    Remeshing(#[from] ParameterError),
    /// One of collisions is.
    #[error(transparent)]
    Collisions(#[from] IntegrationError),
    /// What may pass through itself cannot merge and part.
    #[error(
        "changes of topology need collisions: without, a surface may pass through itself, and what merges is not known"
    )]
    TopologyWithoutCollisions,
    /// There is no emission to take a length from, and none is given.
    #[error("without emissions there is no length to refer to; give reference_length")]
    NoEmission,
    /// An emission is none.
    #[error("emission {emission}: {error}")]
    Emission {
        /// Which emission, from 0.
        emission: usize,
        /// Why.
        error: EmissionError,
    },
    /// The shape of an emission is not admissible as a surface.
    #[error("the shape of emission {emission}: {defects}")]
    Shape {
        /// Which emission, from 0.
        emission: usize,
        /// Where.
        defects: SurfaceDefects,
    },
    /// With collisions, a shape must not intersect itself.
    #[error("the shape of emission {emission} intersects itself: {} pairs of triangles, the first {} and {}",
        pairs.len(), pairs[0][0].0, pairs[0][1].0)]
    ShapeIntersectsItself {
        /// Which emission, from 0.
        emission: usize,
        /// All pairs of triangles that meet in more than they share, sorted; at least one.
        pairs: Vec<[TriId; 2]>,
    },
    /// An emission begins before the run does.
    #[error("emission {emission} begins at {begins}, before the run at {start}")]
    BeginsBefore {
        /// Which emission, from 0.
        emission: usize,
        /// When it begins.
        begins: f64,
        /// When the run does.
        start: f64,
    },
    /// What is to be merged would never be.
    #[error("emission {emission} is to be merged, which needs changes of topology")]
    MergedWithoutTopology {
        /// Which emission, from 0.
        emission: usize,
    },
    /// A step does not lead to a later time.
    #[error("a step from time {time} to {end} is none")]
    Step {
        /// When it would begin.
        time: f64,
        /// When it would end.
        end: f64,
    },
    /// Collisions make steps shorter and shorter.
    #[error("after {substeps} parts of a step there are still {left} left of it, at time {time}")]
    Stuck {
        /// When it stopped.
        time: f64,
        /// How much of the step is left.
        left: f64,
        /// How many parts were made.
        substeps: u32,
    },
    /// The surface cannot be moved.
    #[error("at time {time}: {error}")]
    Tracker {
        /// When.
        time: f64,
        /// Why.
        error: TrackerError,
    },
    /// A state is not one of a run: its surface is none.
    #[error("the surface of the state: {0}")]
    StateMesh(#[from] TriMeshError),
    /// A state is not one of a run: its surface is not admissible.
    #[error("the surface of the state: {0}")]
    StateDefects(SurfaceDefects),
    /// A state has not one age for each vertex.
    #[error("the state has {ages} ages for {vertices} vertices")]
    StateAges {
        /// How many ages.
        ages: usize,
        /// How many vertices.
        vertices: usize,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl SmokeError {
    /// What a tracker said at a time.
    pub(super) fn of_tracker(time: f64, error: TrackerError) -> Self {
        match error {
            TrackerError::Cancelled(cancelled) => cancelled.into(),
            TrackerError::Integration(IntegrationError::Cancelled(cancelled)) => cancelled.into(),
            TrackerError::Union(UnionError::Cancelled(cancelled)) => cancelled.into(),
            error => Self::Tracker { time, error },
        }
    }
}
