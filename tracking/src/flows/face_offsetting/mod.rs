//! Motion along the normal: [`FaceOffsetting`].
//!
//! # What it computes
//! `dx/dt = c n` \[Brochu12, equation 3.1\] with the outward normal `n` and a speed `c(x, t)`, by face offsetting \[Jiao07\]:
//! triangles, not vertices, are moved along their normals, and vertices go where the moved planes meet.
//!
//! # Method
//! In a unit of time the plane of triangle `i` moves by its speed `s_i`, taken in the middle of the triangle and of
//! the step. A displacement `d` of a vertex follows these planes best where it minimizes `sum w_i (n_i . d - s_i)^2` over its triangles,
//! weighted by area: `A d = b` with the quadric metric tensor `A = sum w_i n_i n_i^T` and `b = sum w_i s_i n_i`. Along
//! eigenvectors of small eigenvalues the planes say nothing but noise, so `d` is the solution in the primary space (see [`crate::quadric`]):
//! ```text
//!   d = sum over eigenvalues l_k >= threshold l_1  of  e_k (e_k . b) / l_k
//! ```
//! On a smooth part that is a motion along one normal, on a ridge the line in which two planes meet, at a corner
//! the point of three.
//!
//! # Entropy condition
//! Where a ridge advances toward its open side, it stays sharp, and `d` is right: characteristics run into it (shock).
//! Where it advances toward its convex side, they fan out (rarefaction), and by the principle of Huygens the front is the set of points
//! at the distance `|s|` from the old one: it becomes round. With [`Front::Entropy`] a vertex goes in the direction `m` of `d`
//! no farther than the front of its own star would be there, the triangles taken for infinite sectors: to
//! the farthest point that one of the sectors reaches,
//! ```text
//!   |d| <= max over triangles of |s_i| / rho_i,      rho_i = the distance of m from sector i
//! ```
//! which is at least `|s|`, is `|s|` at a convex ridge that advances, and `|d|` itself at a concave one, exactly. With
//! [`Front::Sharp`] ridges stay sharp either way: that is the offset of the planes.
//!
//! A vertex whose triangles move both outward and inward (speeds of both signs) goes by `d`: there is no one front.
//!
//! # Limit of the step
//! Vertices move on straight lines. The normal of a triangle, not of unit length, is then `N(t)`, quadratic in time, and
//! `N(0) . N(t)` falls to [`FaceOffsettingParameters::area_kept`] times `N(0)^2` at the root of a quadratic equation.
//! The step ends before the first of these times, so no triangle turns over \[Jiao07\]. Where the step would come out
//! shorter than [`FaceOffsettingParameters::least_fraction`] of what was asked for, the vertices of the triangles that cause it are
//! held back instead, as far as they must be: a single sliver does not stop time. [`Offsets`] tells of both.
//!
//! # What it promises
//! * No triangle of positive area turns over, or falls below the part that is to be kept, in the sense above (up to
//!   roundings).
//! * Planes move by their speed exactly (up to roundings), the ridges and corners between them as above. Smooth surfaces
//!   move with an error of order two in the edge length.
//!
//! # What it does not promise
//! Motion of triangles that are smaller than the surface by a factor of 2^250. Convergence where improvement turns triangles over, or cuts ridges off: collapses and flips that turn
//! normals much must be refused \[Brochu12, section 3.3.1\].
//!
//! # Complexity
//! Linear. A step that is shortened is computed again, for the middle of the shorter step.

mod sector;
mod step_limit;
mod vertex;

use glam::DVec3;
use welter_meshing::surface::{TriId, VertexId};

use self::step_limit::StepLimit;
use self::vertex::VertexOffset;
use super::{Flow, FlowError, Prediction, each, move_each, require_step, rests};
use crate::quadric::scale::Scale;
use crate::surface::MovingSurface;

/// A speed along the outward normal at every point and time. Closures of a position and a time are such
/// speeds, and so are numbers.
pub trait NormalSpeed: Sync {
    /// The speed at a position and a time; below 0 for inward.
    fn speed(&self, position: DVec3, time: f64) -> f64;
}

impl<F: Fn(DVec3, f64) -> f64 + Sync> NormalSpeed for F {
    fn speed(&self, position: DVec3, time: f64) -> f64 {
        self(position, time)
    }
}

impl NormalSpeed for f64 {
    fn speed(&self, _position: DVec3, _time: f64) -> f64 {
        *self
    }
}

/// What ridges and corners become that advance toward their convex side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Front {
    /// Round, by the principle of Huygens: the viscosity solution.
    #[default]
    Entropy,
    /// Sharp: the planes are offset.
    Sharp,
}

/// Numbers that [`FaceOffsetting`] depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceOffsettingParameters {
    /// Eigenvalues below this part of the largest do not count; above 0, below 1. Two planes make a ridge
    /// where their normals differ by more than `2 atan(sqrt(threshold))`; a vertex never moves by more than about
    /// `1 / sqrt(threshold)` times the speed. Default: 0.03, ridges of 20 degrees.
    pub rank_threshold: f64,
    /// The part of its area, projected onto its plane, that every triangle keeps in a step at least; from 0, below 1. Default: 0.1.
    pub area_kept: f64,
    /// A step is not shortened below this part of what was asked for, from 0 to 1. With 0 vertices are held back only
    /// where a speed changes so fast with time that eight steps, each at the limit of the one before, were too long.
    /// Default: 1/64.
    pub least_fraction: f64,
}

impl Default for FaceOffsettingParameters {
    fn default() -> Self {
        Self { rank_threshold: 0.03, area_kept: 0.1, least_fraction: 1.0 / 64.0 }
    }
}

impl FaceOffsettingParameters {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`FlowError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), FlowError> {
        let &Self { rank_threshold, area_kept, least_fraction } = self;
        let between = rank_threshold > 0.0 && rank_threshold < 1.0;
        FlowError::require(between, "rank_threshold", rank_threshold, "above 0 and below 1")?;
        FlowError::require((0.0..1.0).contains(&area_kept), "area_kept", area_kept, "from 0, below 1")?;
        let ok = (0.0..=1.0).contains(&least_fraction);
        FlowError::require(ok, "least_fraction", least_fraction, "from 0 to 1")
    }
}

/// The flow along the normal.
///
/// ```
/// use welter_meshing::shapes::{Sphere, sphere};
/// use welter_tracking::flows::{FaceOffsetting, Flow};
/// use welter_tracking::surface::MovingSurface;
///
/// let ball = sphere(&Sphere { radius: 1.0, edge_length: 0.1, ..Sphere::default() })?;
/// let prediction = FaceOffsetting::new(0.5).advance(&MovingSurface::new(&ball)?, 0.0, 0.1)?;
/// assert!((prediction.ends[100].length() - 1.05).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FaceOffsetting<S> {
    /// The speed along the outward normal.
    pub speed: S,
    /// What becomes of ridges that advance. Default: round.
    pub front: Front,
    /// Thresholds.
    pub parameters: FaceOffsettingParameters,
}

/// What [`FaceOffsetting::offsets`] finds.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Offsets {
    /// Positions and time.
    pub prediction: Prediction,
    /// The triangle that would have turned over in a longer step, if the step was shortened.
    pub limiting: Option<TriId>,
    /// How many vertices were held back.
    pub held: usize,
}

/// How often a shortened step is computed again before vertices are held back: speeds that change with time can ask
/// for shorter and shorter steps.
const MAX_TRIES: usize = 8;

/// A step this much longer than the limit, relative to it, is taken: the limit of a step that was just shortened to its
/// limit comes out as one up to roundings.
const LIMIT_ROUNDING: f64 = 1.0 / (1_u64 << 32) as f64;

impl<S: NormalSpeed> FaceOffsetting<S> {
    /// The flow of a speed with the entropy condition and default thresholds.
    pub fn new(speed: S) -> Self {
        Self { speed, front: Front::default(), parameters: FaceOffsettingParameters::default() }
    }

    /// As [`Flow::advance`], with what limited the step.
    ///
    /// # Errors
    /// As [`Flow::advance`].
    pub fn offsets(&self, surface: &MovingSurface, time: f64, dt: f64) -> Result<Offsets, FlowError> {
        require_step(dt)?;
        self.parameters.validate()?;
        let scale = Scale::of_surface(surface);
        let limit = StepLimit { surface, scale: &scale, area_kept: self.parameters.area_kept };
        let shortest = self.parameters.least_fraction * dt;
        let (mut taken, mut limiting, mut tries) = (dt, None, 0);
        loop {
            tries += 1;
            if taken <= 0.0 || time + taken == time {
                return Err(FlowError::NoProgress { time, dt, limit: taken });
            }
            let mut motion = self.displacements(surface, &scale, time, taken)?;
            let (fraction, triangle) = limit.first(&motion);
            let fits = fraction >= 1.0 - LIMIT_ROUNDING;
            if fits || taken <= shortest || tries == MAX_TRIES {
                let held = if fits { 0 } else { limit.hold(&mut motion) };
                let ends = move_each(surface, |vertex, start| Ok(start + motion[vertex.index()]))?;
                return Ok(Offsets { prediction: Prediction { ends, dt: taken }, limiting, held });
            }
            limiting = triangle;
            taken = (taken * fraction).max(shortest);
        }
    }

    /// How far each vertex goes in a step, if nothing limits it. Zero for those that do not move.
    fn displacements(
        &self,
        surface: &MovingSurface,
        scale: &Scale,
        time: f64,
        dt: f64,
    ) -> Result<Vec<DVec3>, FlowError> {
        let mut speeds = self.speeds(surface, time + 0.5 * dt)?;
        let unit = Scale::of_length(speeds.iter().fold(0.0, |largest: f64, s| largest.max(s.abs())), 1.0);
        speeds.iter_mut().for_each(|speed| *speed = unit.scaled(*speed));
        let threshold = self.parameters.rank_threshold;
        each(surface.connectivity().vertex_slots(), |index| {
            let vertex = VertexId::from_index(index);
            if rests(surface, vertex) {
                return Ok(DVec3::ZERO);
            }
            let offset = VertexOffset::new(surface, scale, &speeds, vertex, threshold);
            let velocity = if self.front == Front::Entropy { offset.with_entropy() } else { offset.sharp() };
            let displacement = dt * unit.restored(velocity);
            let start = surface.position(vertex);
            let end = start + displacement;
            if end.is_finite() { Ok(displacement) } else { Err(FlowError::End { vertex, start, end }) }
        })
    }

    /// The speed of each triangle id.
    fn speeds(&self, surface: &MovingSurface, time: f64) -> Result<Vec<f64>, FlowError> {
        let mesh = surface.connectivity();
        each(mesh.triangle_slots(), |index| {
            let triangle = TriId::from_index(index);
            if !mesh.has_triangle(triangle) {
                return Ok(0.0);
            }
            let [a, b, c] = mesh.corners(triangle).map(|v| surface.position(v) / 3.0);
            let position = a + b + c;
            let speed = self.speed.speed(position, time);
            if speed.is_finite() {
                Ok(speed)
            } else {
                Err(FlowError::Speed { triangle, position, time, speed })
            }
        })
    }
}

impl<S: NormalSpeed> Flow for FaceOffsetting<S> {
    fn advance(&self, surface: &MovingSurface, time: f64, dt: f64) -> Result<Prediction, FlowError> {
        Ok(self.offsets(surface, time, dt)?.prediction)
    }
}
