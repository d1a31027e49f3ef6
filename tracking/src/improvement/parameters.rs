//! What is asked of the static operations: [`ImprovementParameters`].

use thiserror::Error;

/// Where the new vertex of a split edge goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SplitScheme {
    /// The middle of the edge.
    Midpoint,
    /// Butterfly subdivision \[Dyn90\], where both triangles of the edge have both neighbours; else the middle.
    #[default]
    Butterfly,
    /// Butterfly subdivision with the weights of \[Zorin96\] at vertices of other than six neighbours.
    ModifiedButterfly,
    /// The point that is nearest to the planes of the triangles at both ends \[Garland97\], on the plane across the middle
    /// of the edge.
    Quadric,
    /// The middle of the edge, carried along the normal to cubic polynomials that are fitted to the vertices around its ends
    /// \[Cazals05\]; the mean of both. Unlike subdivision it is as exact on irregular triangulations.
    Fitted,
}

/// How edge lengths follow curvature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvatureAdaption {
    /// Length of an edge over the radius of curvature there, at which it is as long as it may be. Default: 0.5, at which the
    /// middle of a chord is 1/32 of the radius from the arc.
    pub edge_over_radius: f64,
    /// Bounds of the scale of lengths, where 1 is the reference: flat parts are as coarse as the second, strongly curved ones
    /// as fine as the first. Defaults: 0.25 and 2.
    pub scale: [f64; 2],
    /// How much the scale of lengths may change over an edge, as a part of that edge's length over the reference. Default:
    /// 0.3, at which neighbouring edges differ by less than a third.
    pub grading: f64,
}

impl Default for CurvatureAdaption {
    fn default() -> Self {
        Self { edge_over_radius: 0.5, scale: [0.25, 2.0], grading: 0.3 }
    }
}

/// What the static operations aim at. Lengths are relative to the reference length of the tracker, the mean edge
/// length at the beginning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImprovementParameters {
    /// Longer edges are split. Default: 1.5 \[Brochu12, section 3.2.4\].
    pub max_edge_rel: f64,
    /// Shorter edges are collapsed. Default: 0.5 \[Brochu12, section 3.2.4\].
    pub min_edge_rel: f64,
    /// The most volume that a flip or a collapse may change, over the cube of the reference length. Default: 0.005. In the
    /// Enright test at edges of 0.01 flips lose volume all the way, most of them little: with 0.1 \[Brochu12, section 3.2.4\]
    /// 0.14 % were missing at the end, with 0.01 as much as 0.12 % on the way, with this at most 0.06 %.
    pub max_volume_change_rel: f64,
    /// The most that a split may add or take, likewise. A curved surface that is refined gains volume, so the default is above
    /// that: 0.1.
    pub max_split_volume_change_rel: f64,
    /// Whether vertices that are smoothed, or remain of a collapsed edge, are shifted along the normal so that the volume of the
    /// triangles is kept. Where the surface is curved, they then leave the smooth surface on which the other vertices are.
    /// Where vertices go by their own curvature, as in [`MeanCurvature`](crate::flows::MeanCurvature), that matters more:
    /// without, smoothed vertices follow cubic polynomials that are fitted to those around \[Cazals05\], and collapsed
    /// ones go where [`split_scheme`](Self::split_scheme) says. On a shrinking ball of 2000 triangles, without and with
    /// [`SplitScheme::Fitted`], the error is a fiftieth. Default: true.
    pub keeps_volume: bool,
    /// By how much of the reference length a flip has to shorten an edge. Default: 0.01, so that rounding flips
    /// nothing back.
    pub min_flip_gain_rel: f64,
    /// The most sweeps of flips. Default: 5 \[Brochu12, section 3.2.4\].
    pub flip_sweeps: u32,
    /// Triangles with a larger angle, in degrees, get the side opposite of it split. Default: 160.
    pub large_angle: f64,
    /// Of triangles with a smaller angle, in degrees, the side opposite of it is collapsed. Default: 5.
    pub small_angle: f64,
    /// The most, in degrees, by which the normal of a triangle that comes in place of others may differ from the nearest of
    /// theirs. Default: 45: no patch is turned over, which face offsetting needs \[Brochu12, section 3.3.1\].
    pub max_normal_turn: f64,
    /// Where new vertices go.
    pub split_scheme: SplitScheme,
    /// Whether vertices are moved along the surface.
    pub smoothing: bool,
    /// An eigenvalue of the quadric metric tensor, over the largest, above which the surface is not flat in that
    /// direction, where edges collapse and vertices are smoothed: a ridge has two such, a corner three. Default: 0.03, which two
    /// planes of equal weight have whose normals differ by 20 degrees.
    pub ridge_threshold: f64,
    /// Edges whose triangles' normals differ by more, in degrees, are split in the middle, and stencils do not reach across
    /// them. Default: 48: the rim of a sheet thinner than an edge is curved rather than sharp, the edge of a box is sharp.
    pub crease_angle: f64,
    /// Shorter edges where the surface is curved; none by default.
    pub curvature: Option<CurvatureAdaption>,
    /// No edge is split if there were more triangles afterwards. Default: 8 million, some gigabytes.
    pub most_triangles: usize,
    /// Each can be switched off.
    pub split: bool,
    /// As above.
    pub flip: bool,
    /// As above.
    pub collapse: bool,
}

impl Default for ImprovementParameters {
    fn default() -> Self {
        Self {
            max_edge_rel: 1.5,
            min_edge_rel: 0.5,
            max_volume_change_rel: 0.005,
            max_split_volume_change_rel: 0.1,
            keeps_volume: true,
            min_flip_gain_rel: 0.01,
            flip_sweeps: 5,
            large_angle: 160.0,
            small_angle: 5.0,
            max_normal_turn: 45.0,
            split_scheme: SplitScheme::default(),
            smoothing: true,
            ridge_threshold: 0.03,
            crease_angle: 48.0,
            curvature: None,
            most_triangles: 8_000_000,
            split: true,
            flip: true,
            collapse: true,
        }
    }
}

/// What is asked of changes of topology.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TopologyParameters {
    /// Whether surfaces merge and separate at all. Without, every change that would do so is refused. Default: true.
    pub enabled: bool,
    /// Edges nearer to each other than this part of the reference length are merged. Default: 0.1, a fifth of the
    /// shortest edges that remain.
    pub merge_distance_rel: f64,
}

impl Default for TopologyParameters {
    fn default() -> Self {
        Self { enabled: true, merge_distance_rel: 0.1 }
    }
}

/// A parameter that is out of its range.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{parameter} is {value}, must be {range}")]
pub struct ParameterError {
    /// Its field name.
    pub parameter: &'static str,
    /// The value given.
    pub value: f64,
    /// The range it must lie in.
    pub range: &'static str,
}

fn require(
    holds: bool,
    parameter: &'static str,
    value: f64,
    range: &'static str,
) -> Result<(), ParameterError> {
    if holds { Ok(()) } else { Err(ParameterError { parameter, value, range }) }
}

impl ImprovementParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`ParameterError`] with the first that is not.
    pub fn validate(&self) -> Result<(), ParameterError> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let (max, min) = (self.max_edge_rel, self.min_edge_rel);
        require(positive(max), "max_edge_rel", max, "positive and finite")?;
        require(
            min >= 0.0 && 2.0 * min < max,
            "min_edge_rel",
            min,
            "not negative, below half of max_edge_rel",
        )?;
        for (parameter, value) in [
            ("max_volume_change_rel", self.max_volume_change_rel),
            ("max_split_volume_change_rel", self.max_split_volume_change_rel),
        ] {
            require(value >= 0.0, parameter, value, "not negative; infinite for no bound")?;
        }
        let gain = self.min_flip_gain_rel;
        require(positive(gain), "min_flip_gain_rel", gain, "positive and finite")?;
        let (large, small) = (self.large_angle, self.small_angle);
        require((60.0..=180.0).contains(&large), "large_angle", large, "from 60 to 180 degrees")?;
        require((0.0..=60.0).contains(&small), "small_angle", small, "from 0 to 60 degrees")?;
        let turn = self.max_normal_turn;
        require((0.0..=180.0).contains(&turn), "max_normal_turn", turn, "from 0 to 180 degrees")?;
        let ridge = self.ridge_threshold;
        require((0.0..=1.0).contains(&ridge), "ridge_threshold", ridge, "from 0 to 1")?;
        let crease = self.crease_angle;
        require((0.0..=180.0).contains(&crease), "crease_angle", crease, "from 0 to 180 degrees")?;
        let Some(CurvatureAdaption { edge_over_radius, scale: [low, high], grading }) = self.curvature else {
            return Ok(());
        };
        require(
            positive(edge_over_radius),
            "curvature.edge_over_radius",
            edge_over_radius,
            "positive and finite",
        )?;
        require(positive(low) && low <= high, "curvature.scale[0]", low, "positive, not above scale[1]")?;
        require(positive(high), "curvature.scale[1]", high, "positive and finite")?;
        require(positive(grading), "curvature.grading", grading, "positive and finite")
    }
}

impl TopologyParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`ParameterError`] with the first that is not.
    pub fn validate(&self) -> Result<(), ParameterError> {
        let distance = self.merge_distance_rel;
        let holds = distance >= 0.0 && distance.is_finite();
        require(holds, "merge_distance_rel", distance, "not negative, finite")
    }
}
