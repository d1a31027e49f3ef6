//! What a step did: [`StepReport`].

use crate::improvement::ImprovementReport;
use crate::integration::IntegrationReport;
use crate::surface::EventLog;

/// Wall-clock time by phase, in seconds. The one part of a report that differs from run to run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PhaseSeconds {
    /// Splits, flips, collapses and smoothing, with what makes them safe.
    pub improvement: f64,
    /// Merging and separation.
    pub topology: f64,
    /// The flow.
    pub velocity: f64,
    /// Proximity, impulses, impact zones.
    pub collisions: f64,
    /// Numbering all elements anew.
    pub compaction: f64,
    /// The exact check of the positions that are accepted.
    pub check: f64,
    /// All of the step.
    pub total: f64,
}

impl PhaseSeconds {
    /// Adds those of another step.
    pub fn add(&mut self, other: &Self) {
        self.improvement += other.improvement;
        self.topology += other.topology;
        self.velocity += other.velocity;
        self.collisions += other.collisions;
        self.compaction += other.compaction;
        self.check += other.check;
        self.total += other.total;
    }
}

/// What one step of a tracker did.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct StepReport {
    /// How far time went on: what was asked for, unless the flow or collisions made the step shorter.
    pub dt: f64,
    /// What the static operations did.
    pub improvement: ImprovementReport,
    /// What collision resolution did, to the motion of the flow and to that of smoothing.
    pub integration: IntegrationReport,
    /// Every change of connectivity, in order.
    pub log: EventLog,
    /// Where the time went.
    pub seconds: PhaseSeconds,
}
