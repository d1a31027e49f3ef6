//! All parameters of a tracker: [`TrackerParameters`].

use crate::improvement::{ImprovementParameters, TopologyParameters};
use crate::integration::IntegrationParameters;

/// What a tracker is to do at each step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TrackerParameters {
    /// To which relative lengths refer, in the unit of the coordinates. Default: none, the mean edge length at the beginning
    /// \[Brochu12, section 3.2.4\].
    pub reference_length: Option<f64>,
    /// Remeshing.
    pub improvement: ImprovementParameters,
    /// Merging and separation.
    pub topology: TopologyParameters,
    /// Collisions.
    pub integration: IntegrationParameters,
}
