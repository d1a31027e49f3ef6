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
