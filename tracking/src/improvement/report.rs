//! What the static operations did: [`ImprovementReport`].

/// Why changes were not made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Refused {
    /// The surface would have met itself, or passed through itself.
    pub intersection: u64,
    /// Triangles would have been turned over, or become too sharp or too long.
    pub shape: u64,
    /// Too much volume would have changed.
    pub volume: u64,
    /// Surfaces would have been joined, parted or pinched where that is switched off, or may not be done so.
    pub topology: u64,
    /// There would have been more triangles than are allowed.
    pub budget: u64,
}

impl Refused {
    /// All of them.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.intersection + self.shape + self.volume + self.topology + self.budget
    }

    fn add(&mut self, other: &Self) {
        self.intersection += other.intersection;
        self.shape += other.shape;
        self.volume += other.volume;
        self.topology += other.topology;
        self.budget += other.budget;
    }
}

/// Counts of what was done to a surface at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[must_use]
pub struct ImprovementReport {
    /// Edges split.
    pub splits: u64,
    /// Edges flipped.
    pub flips: u64,
    /// Edges collapsed.
    pub collapses: u64,
    /// Vertices moved along the surface.
    pub smoothed: u64,
    /// Pairs of edges zipped together.
    pub merges: u64,
    /// Vertices, and rings of three edges, at which the surface was parted.
    pub separations: u64,
    /// Pairs of triangles that cancelled.
    pub cancelled: u64,
    /// What was not done.
    pub refused: Refused,
}

impl ImprovementReport {
    /// Adds the counts of another report.
    pub fn add(&mut self, other: &Self) {
        self.splits += other.splits;
        self.flips += other.flips;
        self.collapses += other.collapses;
        self.smoothed += other.smoothed;
        self.merges += other.merges;
        self.separations += other.separations;
        self.cancelled += other.cancelled;
        self.refused.add(&other.refused);
    }
}
