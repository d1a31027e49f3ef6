//! Static operations: the surface is remeshed, merged and separated while it is at rest \[Brochu12, sections 3.2.4 to 3.2.6\].
//!
//! | operation | rule | where it falls back to | file |
//! | --- | --- | --- | --- |
//! | edge split | edges longer than the limit, longest first; sides opposite of large angles | the middle | `split`, `angles` |
//! | edge flip | apexes nearer than the ends, in sweeps | nothing | `flip` |
//! | edge collapse | edges shorter than the limit, shortest first; sides opposite of small angles | the middle, an end | `collapse`, `angles` |
//! | null-space smoothing | towards the neighbours, along the surface | what collision resolution leaves of it | `smoothing` |
//! | separation | singular vertices; rings of three edges where they would collapse | less far apart | `separation`, `parting` |
//! | merging | near edges across a gap, nearest first | another way to join them | `merging` |
//!
//! # What it promises
//! * A surface that is embedded stays so: every change is admitted by exact predicates first (`embedding`, `parting`,
//!   `merging`), and nothing passes through anything. Not so in an [`ImmersedTracker`](crate::tracker::ImmersedTracker), which asks
//!   for shapes and volumes alone.
//! * With topology switched off no change of topology is made: components, holes, boundaries stay.
//! * All lengths are relative to a reference length: times a power of two, surface and reference give the same changes, and the
//!   same bits, scaled; as long as squares of lengths are normal numbers (edges from 1e-150 to 1e150).
//! * The same bits for any number of threads.
//! * Vertices of infinite mass stay where they are.
//!
//! # What it does not promise
//! Edge lengths and angles: changes that are not admitted are counted in the report, and tried again at the next call.
//!
//! # Complexity
//! Linear in the number of elements, to look at all of them, and about 20 microseconds for each change that is admitted.

mod angles;
mod collapse;
mod embedding;
mod filling;
mod flip;
mod merging;
mod osculating;
mod parameters;
mod parting;
mod placement;
mod report;
mod separation;
mod shape;
mod sizing;
mod smoothing;
mod split;
mod workpiece;

pub use parameters::{
    CurvatureAdaption, ImprovementParameters, ParameterError, SplitScheme, TopologyParameters,
};
pub use report::{ImprovementReport, Refused};
pub(crate) use smoothing::smoothed;

use crate::broad_phase::{BroadPhase, BroadPhaseError, Motion};
use crate::surface::{EventLog, MovingSurface};
use sizing::Sizing;
use workpiece::Workpiece;

/// What the static operations work on: the surface, and the broad phase that has followed it at rest; without one the surface may
/// intersect itself, and nothing merges.
pub(crate) struct Stage<'a> {
    pub(crate) surface: &'a mut MovingSurface,
    pub(crate) broad_phase: Option<&'a mut BroadPhase>,
    pub(crate) parameters: &'a ImprovementParameters,
    pub(crate) topology: &'a TopologyParameters,
    pub(crate) length: f64,
}

impl Stage<'_> {
    fn run(
        &mut self,
        work: impl FnOnce(&mut Workpiece<'_>),
    ) -> Result<(ImprovementReport, EventLog), BroadPhaseError> {
        let earlier = self.surface.take_log();
        if let (false, Some(broad_phase)) = (earlier.is_empty(), &mut self.broad_phase) {
            broad_phase.follow(self.surface, Motion::Rest, &earlier)?;
        }
        let sizing = Sizing::new(self.surface, self.length, self.parameters.curvature.as_ref());
        let mut piece = Workpiece {
            surface: &mut *self.surface,
            broad_phase: self.broad_phase.as_deref_mut(),
            parameters: self.parameters,
            topology: self.topology,
            length: self.length,
            sizing,
            least_agreement: libm::cos(self.parameters.max_normal_turn.to_radians()),
            crease_cosine: libm::cos(self.parameters.crease_angle.to_radians()),
            report: ImprovementReport::default(),
        };
        work(&mut piece);
        let report = piece.report;
        let log = self.surface.take_log();
        if let Some(broad_phase) = &mut self.broad_phase {
            broad_phase.follow(self.surface, Motion::Rest, &log)?;
        }
        Ok((report, log))
    }

    /// Splits, flips and collapses edges.
    pub(crate) fn remesh(&mut self) -> Result<(ImprovementReport, EventLog), BroadPhaseError> {
        let parameters = self.parameters;
        self.run(|piece| {
            if parameters.split {
                piece.split_long_edges();
                piece.split_large_angles();
            }
            if parameters.flip {
                piece.flip_edges();
            }
            if parameters.collapse {
                piece.collapse_short_edges();
                piece.collapse_small_angles();
            }
            if piece.topology.enabled {
                piece.separate_singular_vertices();
            }
        })
    }

    /// Merges what is near, and separates what then hangs together in a vertex.
    pub(crate) fn change_topology(&mut self) -> Result<(ImprovementReport, EventLog), BroadPhaseError> {
        self.run(|piece| {
            if piece.topology.enabled {
                piece.merge_close_edges();
                piece.separate_singular_vertices();
            }
        })
    }
}
