//! What a resolution did: [`IntegrationReport`].

/// Counts of what happened on the way from predicted to final positions; of all attempts, where a step was shortened.
#[must_use]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct IntegrationReport {
    /// Pairs of elements nearer than the proximity distance before the step.
    pub proximities: usize,
    /// Repulsions that changed a motion.
    pub repulsions: usize,
    /// Pairs that collide on the way from the surface to the predicted ends, after repulsion; of the first attempt.
    /// None if they were too many to list.
    pub collisions: Option<usize>,
    /// Sweeps of impulses in which there was something to do.
    pub sweeps: usize,
    /// Impulses that changed a motion.
    pub impulses: usize,
    /// Systems of impact zones that were solved.
    pub impact_zones: usize,
    /// The most collisions of an impact zone.
    pub largest_impact_zone: usize,
    /// Systems of impact zones that were singular; those that could be solved in the least squares sense all the same are
    /// among `impact_zones`.
    pub singular_systems: usize,
    /// Rigid motions that zones were given.
    pub rigid_zones: usize,
    /// Rigid zones that were made to rest, since their parts collided with each other all the same.
    pub resting_zones: usize,
    /// How often the step was shortened.
    pub shortenings: usize,
    /// Vertices that stay where they are since nothing else helped.
    pub resting_vertices: usize,
}

impl IntegrationReport {
    /// Adds the counts of another resolution; the largest impact zone is that of both.
    pub fn add(&mut self, other: &Self) {
        self.proximities += other.proximities;
        self.repulsions += other.repulsions;
        self.collisions = self.collisions.zip(other.collisions).map(|(a, b)| a + b);
        self.sweeps += other.sweeps;
        self.impulses += other.impulses;
        self.impact_zones += other.impact_zones;
        self.largest_impact_zone = self.largest_impact_zone.max(other.largest_impact_zone);
        self.singular_systems += other.singular_systems;
        self.rigid_zones += other.rigid_zones;
        self.resting_zones += other.resting_zones;
        self.shortenings += other.shortenings;
        self.resting_vertices += other.resting_vertices;
    }
}
