//! Where a run stands: [`MarkerState`].

use glam::DVec3;

/// What a run goes on from, with its emissions, parameters and flow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MarkerState {
    /// The particles, in the order of their releases.
    pub positions: Vec<DVec3>,
    /// The age of each.
    pub ages: Vec<f64>,
    /// The time that was reached.
    pub time: f64,
}

impl MarkerState {
    /// What a particle takes: a position of three numbers and an age, 8 bytes each.
    pub const BYTES_PER_PARTICLE: usize = 32;

    /// Bytes of the positions and ages.
    ///
    /// ```
    /// use welter_fluids::marker_particles::MarkerState;
    /// let state = MarkerState { positions: vec![glam::DVec3::X; 3], ages: vec![0.0; 3], time: 0.0 };
    /// assert_eq!(state.bytes(), 96);
    /// ```
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.positions.len() * Self::BYTES_PER_PARTICLE
    }
}
