//! What is asked of a run: [`SmokeParameters`].

use welter_tracking::flows::Scheme;
use welter_tracking::improvement::{ImprovementParameters, SplitScheme, TopologyParameters};
use welter_tracking::integration::IntegrationParameters;

use super::{SmokeError, SmokeParameterError};

/// What is done once there are as many triangles as there may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OverBudget {
    /// No more splits: edges grow beyond their limit where the flow stretches them, until collapses elsewhere make room.
    StopSplitting,
    /// The reference length is multiplied by a factor, above 1 and up to 2, at the end of each step in which splits or releases were
    /// refused for the budget: edges get longer everywhere, and triangles fewer by the square of the factor. It never becomes shorter
    /// again.
    Coarsen {
        /// By how much. Default: 1.25, at which a third of the triangles goes; splits and collapses have a ratio of three between
        /// their limits, so that what was just split does not collapse at once.
        factor: f64,
    },
}

impl Default for OverBudget {
    fn default() -> Self {
        Self::Coarsen { factor: 1.25 }
    }
}

/// How smoke is carried. By default as in \[Brochu12, section 5.3\]: with remeshing, without collisions and changes of topology.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmokeParameters {
    /// The time at the beginning, finite. No emission may begin before. Default: 0.
    pub start: f64,
    /// How vertices follow velocities. Default: the method of Runge and Kutta, of order 4.
    pub scheme: Scheme,
    /// To which relative lengths refer, above 0 and finite. Default: none, the mean edge length of the shapes of all emissions.
    pub reference_length: Option<f64>,
    /// How the surface is remeshed at each step; none for not at all. Default: as a tracker does, but for splits in the middle of edges,
    /// which leave the volume as it is: those of butterfly subdivision lie outside of curved parts, and the volume drifts several times
    /// as fast.
    pub remeshing: Option<ImprovementParameters>,
    /// How collisions are resolved; none lets the surface pass through itself. Default: none.
    pub collisions: Option<IntegrationParameters>,
    /// How smoke merges and parts, which asks for collisions; none for not at all. Its `enabled` holds too. Default: none.
    pub topology: Option<TopologyParameters>,
    /// The most triangles, at least 1: a release that would make more is refused, and no edge is split for more. Parting
    /// surfaces, where they may, is not refused for it. Default: 1 million, some hundreds of megabytes.
    pub most_triangles: usize,
    /// What is done once they are there.
    pub over_budget: OverBudget,
    /// The most parts of a step between releases, where collisions make it shorter; at least 1. Default: 1000.
    pub most_substeps: u32,
}

impl Default for SmokeParameters {
    fn default() -> Self {
        Self {
            start: 0.0,
            scheme: Scheme::default(),
            reference_length: None,
            remeshing: Some(ImprovementParameters {
                split_scheme: SplitScheme::Midpoint,
                ..ImprovementParameters::default()
            }),
            collisions: None,
            topology: None,
            most_triangles: 1_000_000,
            over_budget: OverBudget::default(),
            most_substeps: 1000,
        }
    }
}

impl SmokeParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`SmokeError::Parameter`], [`SmokeError::Remeshing`], [`SmokeError::Collisions`] or [`SmokeError::TopologyWithoutCollisions`] for
    /// the first that is not.
    pub fn validate(&self) -> Result<(), SmokeError> {
        let require = |holds: bool, name, value, must| {
            if holds { Ok(()) } else { Err(SmokeParameterError { name, value, must }) }
        };
        require(self.start.is_finite(), "start", self.start, "finite")?;
        if let Some(length) = self.reference_length {
            let ok = length > 0.0 && length.is_finite();
            require(ok, "reference_length", length, "above 0 and finite")?;
        }
        require(self.most_triangles > 0, "most_triangles", self.most_triangles as f64, "at least 1")?;
        require(self.most_substeps > 0, "most_substeps", f64::from(self.most_substeps), "at least 1")?;
        if let OverBudget::Coarsen { factor } = self.over_budget {
            require(factor > 1.0 && factor <= 2.0, "factor", factor, "above 1, up to 2")?;
        }
        if let Some(remeshing) = &self.remeshing {
            remeshing.validate()?;
        }
        if let Some(topology) = &self.topology {
            topology.validate()?;
        }
        if let Some(collisions) = &self.collisions {
            collisions.validate()?;
        } else if self.changes_topology() {
            return Err(SmokeError::TopologyWithoutCollisions);
        }
        Ok(())
    }

    /// Whether smoke merges and parts.
    pub(super) fn changes_topology(&self) -> bool {
        self.topology.is_some_and(|topology| topology.enabled)
    }

    /// Remeshing within the budget.
    pub(super) fn improvement(&self) -> ImprovementParameters {
        match self.remeshing {
            Some(remeshing) => ImprovementParameters {
                most_triangles: remeshing.most_triangles.min(self.most_triangles),
                ..remeshing
            },
            None => ImprovementParameters {
                split: false,
                flip: false,
                collapse: false,
                smoothing: false,
                ..ImprovementParameters::default()
            },
        }
    }
}
