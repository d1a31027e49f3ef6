//! What moves the surface, with collisions or without: [`Carrier`].

use welter_meshing::Monitor;
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh};
use welter_tracking::flows::Flow;
use welter_tracking::improvement::TopologyParameters;
use welter_tracking::integration::IntegrationError;
use welter_tracking::surface::{MovingSurface, UnionError, UnionParameters, UnionReport};
use welter_tracking::tracker::{
    ImmersedTracker, StepReport, SurfaceTracker, SurfaceValues, TrackerError, TrackerParameters,
};

use super::{Refusal, SmokeParameters};

/// One of the two trackers.
#[derive(Clone, Debug)]
pub(super) enum Carrier {
    /// The surface never meets itself.
    Embedded(Box<SurfaceTracker>),
    /// It may.
    Immersed(Box<ImmersedTracker>),
}

impl Carrier {
    pub(super) fn new(
        surface: MovingSurface,
        parameters: &SmokeParameters,
        length: f64,
        time: f64,
    ) -> Result<Self, TrackerError> {
        let improvement = parameters.improvement();
        let Some(integration) = parameters.collisions else {
            return Ok(Self::Immersed(Box::new(ImmersedTracker::new(surface, improvement, length, time)?)));
        };
        let off = TopologyParameters { enabled: false, ..TopologyParameters::default() };
        let topology = parameters.topology.unwrap_or(off);
        let parameters =
            TrackerParameters { reference_length: Some(length), improvement, topology, integration };
        Ok(Self::Embedded(Box::new(SurfaceTracker::resume(surface, parameters, length, time, 0)?)))
    }

    pub(super) fn surface(&self) -> &MovingSurface {
        match self {
            Self::Embedded(tracker) => tracker.surface(),
            Self::Immersed(tracker) => tracker.surface(),
        }
    }

    pub(super) fn values(&mut self) -> SurfaceValues<'_> {
        match self {
            Self::Embedded(tracker) => tracker.values(),
            Self::Immersed(tracker) => tracker.values(),
        }
    }

    pub(super) fn length(&self) -> f64 {
        match self {
            Self::Embedded(tracker) => tracker.reference_length(),
            Self::Immersed(tracker) => tracker.reference_length(),
        }
    }

    pub(super) fn set_length(&mut self, length: f64) -> Result<(), TrackerError> {
        match self {
            Self::Embedded(tracker) => tracker.set_reference_length(length),
            Self::Immersed(tracker) => tracker.set_reference_length(length),
        }
    }

    pub(super) fn step(
        &mut self,
        flow: &dyn Flow,
        dt: f64,
        monitor: &Monitor<'_>,
    ) -> Result<StepReport, TrackerError> {
        match self {
            Self::Embedded(tracker) => tracker.step(flow, dt, monitor),
            Self::Immersed(tracker) => tracker.step(flow, dt, monitor),
        }
    }

    /// Adds a mesh, or says why not.
    pub(super) fn insert(
        &mut self,
        mesh: &TriMesh,
        monitor: &Monitor<'_>,
    ) -> Result<Option<Refusal>, TrackerError> {
        let inserted = match self {
            Self::Embedded(tracker) => tracker.insert(mesh, monitor),
            Self::Immersed(tracker) => tracker.insert(mesh),
        };
        match inserted {
            Ok(_) => Ok(None),
            Err(TrackerError::Integration(IntegrationError::Intersection { pairs, .. })) => {
                Ok(Some(Refusal::Intersection { pairs: pairs.len() }))
            }
            Err(error) => Err(error),
        }
    }

    /// Unites the surface with a shape, or says why not.
    pub(super) fn unite(
        &mut self,
        shape: &ClosedOrientedMesh,
        most_triangles: usize,
        monitor: &Monitor<'_>,
    ) -> Result<Result<UnionReport, Refusal>, TrackerError> {
        let present = self.surface().connectivity().triangle_count();
        let parameters = UnionParameters { most_triangles, ..UnionParameters::default() };
        let united = match self {
            Self::Embedded(tracker) => tracker.unite(shape, &parameters, monitor),
            // Runs without collisions have no emissions that are merged.
            Self::Immersed(tracker) => tracker.unite(shape, &parameters, monitor),
        };
        match united {
            Ok(report) => Ok(Ok(report)),
            Err(TrackerError::Union(UnionError::SelfIntersection { pairs })) => {
                Ok(Err(Refusal::Intersection { pairs: pairs.len() }))
            }
            Err(TrackerError::Union(UnionError::Budget { .. })) => Ok(Err(Refusal::Budget { present })),
            Err(TrackerError::Union(UnionError::Sheet { .. })) => Ok(Err(Refusal::Sheet)),
            Err(TrackerError::Union(UnionError::InsideOut { .. })) => Ok(Err(Refusal::InsideOut)),
            Err(TrackerError::Union(UnionError::Degenerate { shifts, obstacle })) => {
                Ok(Err(Refusal::Degenerate { shifts, obstacle }))
            }
            Err(error) => Err(error),
        }
    }
}
