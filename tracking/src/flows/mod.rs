//! Where the vertices of a moving surface go: velocity fields, motion along normals, mean curvature.
//!
//! # What it computes
//! A [`Flow`] predicts positions after a step, as if nothing were in the way; the integration makes of them positions
//! without intersection.
//!
//! | flow | motion | limit of the step |
//! | --- | --- | --- |
//! | [`Advection`] | a [`VelocityField`]: one of [`fields`], or any closure; by Euler's method or that of Runge and Kutta | none |
//! | [`FaceOffsetting`] | along the normal, with a given speed and the entropy condition | triangles keep their side |
//! | [`MeanCurvature`] | along the normal, with the speed of mean curvature | stability of Euler's method |
//! | [`Jitter`] | random, for tests of what follows | none |
//!
//! # What it promises
//! * Every predicted position is finite, or the flow says which vertex fails, and why.
//! * Vertices of infinite mass, and ids that are not in use, stay where they are.
//! * The same bits for any number of threads.
//! * Lengths are relative: with all lengths times a power of two (of the surface, of the velocities, of the
//!   parameters that are lengths) positions come out times that power, bit for bit; mean curvature asks for times, which
//!   are squares of lengths, to be multiplied likewise.
//!
//! # What it does not promise
//! Absence of intersections. Motion of one vertex does not see the others, but for the triangles around it.
//!
//! # Complexity
//! Linear in the number of vertices; all flows work in parallel.

mod error;
mod face_offsetting;
pub mod fields;
mod jitter;
mod mean_curvature;
mod random;
mod velocity;

pub use error::FlowError;
pub use face_offsetting::{FaceOffsetting, FaceOffsettingParameters, Front, NormalSpeed, Offsets};
pub use jitter::Jitter;
pub use mean_curvature::{CurvatureStep, MeanCurvature};
pub use velocity::{Advection, NoVelocity, Scheme, VelocityField, confined};

use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::surface::VertexId;

use crate::surface::MovingSurface;

/// Where the vertices of a surface go.
///
/// ```
/// use glam::DVec3;
/// use welter_meshing::shapes::{Sphere, sphere};
/// use welter_tracking::flows::{Flow, FlowError, Prediction};
/// use welter_tracking::surface::MovingSurface;
///
/// /// Up, at most a tenth of a unit of time at once.
/// struct Rise;
/// impl Flow for Rise {
///     fn advance(&self, surface: &MovingSurface, _time: f64, dt: f64) -> Result<Prediction, FlowError> {
///         let dt = dt.min(0.1);
///         Ok(Prediction { ends: surface.positions().iter().map(|&p| p + dt * DVec3::Z).collect(), dt })
///     }
/// }
/// let surface = MovingSurface::new(&*sphere(&Sphere { edge_length: 0.5, ..Sphere::default() })?)?;
/// assert_eq!(Rise.advance(&surface, 0.0, 1.0)?.dt, 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Flow {
    /// Positions by vertex id after a step of at most `dt`; the flow may choose a shorter one and says so.
    ///
    /// # Errors
    /// [`FlowError`]: nothing can be predicted.
    fn advance(&self, surface: &MovingSurface, time: f64, dt: f64) -> Result<Prediction, FlowError>;
}

/// Where vertices would be after a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// Positions by vertex id; those of free ids are without meaning, but finite.
    pub ends: Vec<DVec3>,
    /// The time that the step takes: above 0, at most what was asked for.
    pub dt: f64,
}

/// Refuses a time step that is none.
fn require_step(dt: f64) -> Result<(), FlowError> {
    if dt.is_finite() && dt > 0.0 { Ok(()) } else { Err(FlowError::TimeStep { dt }) }
}

/// How many vertices or triangles a thread takes at once at least.
const PIECE: usize = 256;

/// The end of each vertex that moves, in parallel; others stay. The error is that of the smallest id.
fn move_each(
    surface: &MovingSurface,
    end: impl Fn(VertexId, DVec3) -> Result<DVec3, FlowError> + Sync,
) -> Result<Vec<DVec3>, FlowError> {
    let end = |index: usize| -> Result<DVec3, FlowError> {
        let (vertex, start) = (VertexId::from_index(index), surface.positions()[index]);
        if rests(surface, vertex) {
            return Ok(start);
        }
        let end = end(vertex, start)?;
        if end.is_finite() { Ok(end) } else { Err(FlowError::End { vertex, start, end }) }
    };
    each(surface.positions().len(), end)
}

/// Whether a vertex never moves, or is none.
fn rests(surface: &MovingSurface, vertex: VertexId) -> bool {
    !surface.connectivity().has_vertex(vertex) || surface.masses()[vertex.index()].is_infinite()
}

/// The values of all indices below `count`, in parallel, or the error of the smallest.
fn each<T: Send>(
    count: usize,
    value: impl Fn(usize) -> Result<T, FlowError> + Sync,
) -> Result<Vec<T>, FlowError> {
    let all = (0..count).into_par_iter().with_min_len(PIECE).map(|index| value(index).ok());
    match all.collect::<Option<Vec<T>>>() {
        Some(values) => Ok(values),
        // Which of several errors a parallel search meets first depends on the threads.
        None => (0..count).map(value).collect(),
    }
}
