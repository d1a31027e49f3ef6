//! Where a run stands: [`SmokeState`].

use welter_meshing::surface::TriMesh;

/// What a run goes on from, with its emissions, parameters and flow.
#[derive(Clone, Debug, PartialEq)]
pub struct SmokeState {
    /// The surface.
    pub mesh: TriMesh,
    /// The age of each vertex.
    pub ages: Vec<f64>,
    /// The time that was reached.
    pub time: f64,
    /// The length to which relative lengths refer.
    pub reference_length: f64,
}
