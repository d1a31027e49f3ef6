//! Motion along the normal with the speed of mean curvature: [`MeanCurvature`].
//!
//! # What it computes
//! `dx/dt = speed kappa n` \[Brochu12, equation 3.2\] with `kappa = k1 + k2`, the *sum* of the principal curvatures, and
//! `n` toward the inside of a ball: surfaces of least area are approached, a sphere shrinks as
//! `r(t)^2 = r(0)^2 - 4 speed t`, a cylinder as `r(0)^2 - 2 speed t`.
//!
//! That the sum is meant, not the mean, follows from the figures of \[Brochu12, section 3.3.2\]: their dumbbell, of handle
//! radius 0.2, parts at t = 0.0219, as it does by the sum; by the mean it would at 0.0438.
//!
//! # Method
//! One step of Euler's method, as in \[Brochu12\], or of the method of Runge and Kutta, with the mean curvature normal of \[Meyer03\]:
//! ```text
//!   L(x_i) = 1 / (2 A_i)  sum over edges ij  w_ij (x_j - x_i),      w_ij = cot alpha_ij + cot beta_ij
//! ```
//! where `A_i` is the mixed area (the part of the surface that is nearest to the vertex, where no angle is obtuse). An edge of more than two
//! triangles takes the cotangents of all of them.
//!
//! # Limit of the step
//! The map `x -> x + dt speed L(x)` does not enlarge oscillations as long as `dt speed W_i <= 1`,
//! `W_i = sum |w_ij| / (2 A_i)`, for each vertex: by the theorem of Gershgorin the eigenvalues of `-L` are at most `2 max W`, and at that
//! bound they are multiplied by -1. This is the limit `1 / (A W)` of \[Brochu12, section 3.3.2\].
//! (The method of Runge and Kutta is stable up to 1.39 times that.)
//!
//! At that limit, which is of the order of the square of the edge length, Euler's method delays a sphere by
//! about as much as the edges allow: on spheres nearly all of its error is that of time. The other method costs four
//! evaluations, and leaves the error in space.
//!
//! A single sliver makes `W` as large as it likes, and time would stand still. So vertices with a `W_i` of more than
//! [`MeanCurvature::stiffness`] times the median do not shorten the step: they move with the speed of `1 / (dt W_i)` times
//! their own, that is to the weighted mean of their neighbours at most. [`MeanCurvature::step`] tells how many.
//!
//! # What it promises
//! * The step is stable in the sense above; with Euler's method every vertex ends in the convex hull of its neighbours and
//!   itself, unless angles opposite to its edges sum to more than 180 degrees.
//! * Vertices with flat surroundings do not move, up to roundings: one ring of triangles with Euler's method, four with
//!   that of Runge and Kutta.
//! * Vertices on a boundary stay: the surface spans its boundary like a soap film.
//!
//! # What it does not promise
//! Order 2 at irregular vertices: see `welter_meshing::surface::measure::mean_curvature_normals`. Absence of inverted triangles: tangential
//! motion of the formula is small, but not zero.
//!
//! # Complexity
//! Linear.

mod laplacian;

use glam::DVec3;
use rayon::prelude::*;

use self::laplacian::{Placed, VertexLaplacian};
use super::{Flow, FlowError, PIECE, Prediction, Scheme, move_each, require_step};
use crate::quadric::scale::Scale;
use crate::surface::MovingSurface;

/// The flow of mean curvature.
///
/// ```
/// use welter_meshing::shapes::{Sphere, sphere};
/// use welter_tracking::flows::{Flow, MeanCurvature};
/// use welter_tracking::surface::MovingSurface;
///
/// let ball = sphere(&Sphere { radius: 1.0, edge_length: 0.1, ..Sphere::default() })?;
/// let prediction = MeanCurvature::default().advance(&MovingSurface::new(&ball)?, 0.0, 0.01)?;
/// assert!(prediction.dt < 0.01);
/// let speed = (1.0 - prediction.ends[100].length()) / prediction.dt;
/// assert!((speed - 2.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanCurvature {
    /// Speed where the curvatures sum to one, in length^2 / time, not below 0. Default: 1.
    pub speed: f64,
    /// How positions follow from velocities. Default: Runge and Kutta; \[Brochu12\] takes Euler's method.
    pub scheme: Scheme,
    /// The part of the stable step that is taken, above 0, at most 1. Default: 1, as in \[Brochu12\].
    pub safety: f64,
    /// Vertices whose own limit is shorter than the median of the limits divided by this do not shorten the step; from 1
    /// on, infinite to let every vertex count. Default: 64, that of edges 8 times shorter than the others.
    pub stiffness: f64,
}

impl Default for MeanCurvature {
    fn default() -> Self {
        Self { speed: 1.0, scheme: Scheme::Rk4, safety: 1.0, stiffness: 64.0 }
    }
}

/// What [`MeanCurvature::step`] finds.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CurvatureStep {
    /// Positions and time.
    pub prediction: Prediction,
    /// How many vertices were too stiff for the step, and moved less far than their curvature asks for.
    pub damped: usize,
}

impl MeanCurvature {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`FlowError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), FlowError> {
        let &Self { speed, safety, stiffness, .. } = self;
        FlowError::require(speed.is_finite() && speed >= 0.0, "speed", speed, "finite and not below 0")?;
        FlowError::require(safety > 0.0 && safety <= 1.0, "safety", safety, "above 0 and at most 1")?;
        FlowError::require(stiffness >= 1.0, "stiffness", stiffness, "at least 1")
    }

    /// As [`Flow::advance`], and how many vertices were damped.
    ///
    /// # Errors
    /// As [`Flow::advance`].
    pub fn step(&self, surface: &MovingSurface, time: f64, dt: f64) -> Result<CurvatureStep, FlowError> {
        require_step(dt)?;
        self.validate()?;
        let scale = Scale::of_surface(surface);
        let laplacians = |positions: &[DVec3]| Placed { surface, positions, scale: &scale }.laplacians();
        let start = surface.positions();
        let first = laplacians(start);
        // In scaled units times are squares of lengths, over the speed.
        let limit = self.safety / self.followed(&first);
        let true_limit = scale.restored_power(limit, 2) / self.speed;
        let taken = if true_limit < dt { true_limit } else { dt };
        if taken <= 0.0 || taken.is_nan() || time + taken == time {
            return Err(FlowError::NoProgress { time, dt, limit: true_limit });
        }
        let reach = if true_limit < dt { limit } else { scale.scaled_power(dt * self.speed, 2) };

        // What each vertex moves in the whole step, with the velocity of each stage.
        let moves = |sums: &[VertexLaplacian]| -> Vec<DVec3> {
            sums.par_iter().with_min_len(PIECE).map(|v| scale.restored(v.displacement(reach))).collect()
        };
        let looking_ahead = |moves: &[DVec3], part: f64| {
            move_each(surface, |vertex, start| Ok(start + part * moves[vertex.index()]))
        };
        let k1 = moves(&first);
        let ends = match self.scheme {
            Scheme::Euler => looking_ahead(&k1, 1.0)?,
            Scheme::Rk4 => {
                let k2 = moves(&laplacians(&looking_ahead(&k1, 0.5)?));
                let k3 = moves(&laplacians(&looking_ahead(&k2, 0.5)?));
                let k4 = moves(&laplacians(&looking_ahead(&k3, 1.0)?));
                move_each(surface, |vertex, start| {
                    let i = vertex.index();
                    Ok(start + (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0)
                })?
            }
        };
        let damped = first.iter().filter(|v| v.moves() && reach * v.stiffness() > 1.0).count();
        Ok(CurvatureStep { prediction: Prediction { ends, dt: taken }, damped })
    }

    /// The largest stiffness that shortens the step.
    fn followed(&self, vertices: &[VertexLaplacian]) -> f64 {
        let mut all: Vec<f64> =
            vertices.iter().filter(|v| v.moves()).map(VertexLaplacian::stiffness).collect();
        if all.is_empty() {
            return 0.0;
        }
        let stiffest = all.iter().copied().fold(0.0, f64::max);
        let middle = all.len() / 2;
        let median = *all.select_nth_unstable_by(middle, f64::total_cmp).1;
        stiffest.min(self.stiffness * median)
    }
}

impl Flow for MeanCurvature {
    fn advance(&self, surface: &MovingSurface, time: f64, dt: f64) -> Result<Prediction, FlowError> {
        Ok(self.step(surface, time, dt)?.prediction)
    }
}
