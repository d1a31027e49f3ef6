//! What a step did: [`SmokeStep`].

use welter_tracking::improvement::ImprovementReport;
use welter_tracking::integration::IntegrationReport;
use welter_tracking::surface::{UnionObstacle, UnionReport};
use welter_tracking::tracker::{PhaseSeconds, StepReport};

use super::Release;

/// What became of a release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Released {
    /// Of which emission, from 0.
    pub emission: usize,
    /// Which release of it.
    pub release: Release,
    /// How many triangles it has.
    pub triangles: usize,
    /// Why it was not released; none if it was.
    pub refusal: Option<Refusal>,
    /// How it was united with the smoke that was there; none if it was refused, or is a component of its own.
    pub union: Option<UnionReport>,
}

/// Why a release did not come about. It does not come later either.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Refusal {
    /// With collisions: it would intersect smoke that is there, unless it is to be merged, or itself, displaced to where coordinates are too coarse for it.
    Intersection {
        /// How many pairs of triangles would meet.
        pairs: usize,
    },
    /// It is to be merged, and would cross a sheet, which has no inside.
    Sheet,
    /// It is to be merged, and meets smoke that is inside out.
    InsideOut,
    /// It is to be merged, and meets smoke in no general position, however it is shifted.
    Degenerate {
        /// How often it was shifted.
        shifts: u32,
        /// What was in the way the last time.
        obstacle: UnionObstacle,
    },
    /// There would be more triangles than are allowed.
    Budget {
        /// How many there are.
        present: usize,
    },
}

/// What a step did, with all its parts.
#[derive(Clone, Debug, Default, PartialEq)]
#[must_use]
pub struct SmokeStep {
    /// What was to be released, in order of time, then of emissions.
    pub releases: Vec<Released>,
    /// How many steps of the tracker were made.
    pub substeps: u32,
    /// Remeshing, merging, parting.
    pub improvement: ImprovementReport,
    /// Collisions.
    pub integration: IntegrationReport,
    /// Vertices at the end.
    pub vertices: usize,
    /// Triangles at the end.
    pub triangles: usize,
    /// The reference length at the end.
    pub reference_length: f64,
    /// Where the time went. The one part of a report that differs from run to run.
    pub seconds: PhaseSeconds,
}

impl SmokeStep {
    /// Before anything was done.
    pub(super) fn none() -> Self {
        let integration = IntegrationReport { collisions: Some(0), ..IntegrationReport::default() };
        Self { integration, ..Self::default() }
    }

    pub(super) fn add(&mut self, step: &StepReport) {
        self.substeps += 1;
        self.improvement.add(&step.improvement);
        self.integration.add(&step.integration);
        self.seconds.add(&step.seconds);
    }

    /// Whether anything was refused for the number of triangles.
    pub(super) fn met_the_budget(&self) -> bool {
        let releases = || self.releases.iter().any(|r| matches!(r.refusal, Some(Refusal::Budget { .. })));
        self.improvement.refused.budget > 0 || releases()
    }
}
