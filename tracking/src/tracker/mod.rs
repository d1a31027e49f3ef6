//! The tracker: a surface that moves with a flow, is remeshed, merges and parts, and never intersects itself.
//!
//! # What it computes
//! Steps of Algorithm 3 of \[Brochu12\]: static operations, the flow, integration.
//!
//! # What it promises
//! * The surface is embedded before and after each step, whatever the flow and the options: each accepted set of positions
//!   has passed the exact static check.
//! * A step ends in bounded time. What cannot be reached without intersection is not reached: the report says how far time
//!   went on.
//! * A step that fails returns an error and leaves the surface as it was.
//! * With topology switched off, no change of topology.
//! * The same bits for any number of threads; and with all lengths (surface, flow) times a power of two, the same
//!   connectivity and the same bits, scaled (for edges from 1e-150 to 1e150). A tracker made of the surface of another goes on
//!   with the same bits as that one: [`SurfaceTracker::resume`].
//!
//! # What it does not promise
//! That the flow is asked only where the surface is: it is asked where smoothing would put the vertices, and once more if they
//! are not free to go there.
//!
//! That the surface follows the flow where it would meet itself: collisions change the motion, and with topology switched
//! on changes of topology do.
//!
//! # Complexity
//! A step is linear in the number of elements in practice; see [`improvement`] and
//! [`integration`].

mod error;
mod immersed;
mod parameters;
mod report;

pub use error::TrackerError;
pub use immersed::ImmersedTracker;
pub use parameters::TrackerParameters;
pub use report::{PhaseSeconds, StepReport};

use crate::broad_phase::{BroadPhase, Motion};
use crate::flows::{Flow, Prediction};
use crate::improvement::{self, ImprovementReport, ParameterError, Stage};
use crate::integration::{self, IntegrationParameters, IntegrationReport};
use crate::surface::{
    AttributeSet, EventLog, MovingSurface, UnionOutcome, UnionParameters, UnionReport, VertexValueError,
};
use glam::DVec3;
use std::ops::Range;
use std::time::Instant;
use welter_meshing::Monitor;
use welter_meshing::surface::{ClosedOrientedMesh, EdgeId, TriId, TriMesh, VertexId};

/// A surface that moves without intersecting itself.
///
/// ```
/// use glam::DVec3;
/// use welter_meshing::{Monitor, shapes::{Sphere, sphere}};
/// use welter_tracking::flows::Advection;
/// use welter_tracking::surface::MovingSurface;
/// use welter_tracking::tracker::{SurfaceTracker, TrackerParameters};
///
/// let ball = sphere(&Sphere { edge_length: 0.3, ..Sphere::default() })?;
/// let mut tracker = SurfaceTracker::new(MovingSurface::new(&ball)?, TrackerParameters::default())?;
/// // Stretch it along x.
/// let flow = Advection::new(|p: DVec3, _time: f64| DVec3::new(p.x, 0.0, 0.0));
/// for _ in 0..5 {
///     let report = tracker.step(&flow, 0.1, &Monitor::none())?;
///     assert_eq!(report.dt, 0.1);
/// }
/// let longest = tracker.surface().positions().iter().map(|p| p.x).fold(0.0, f64::max);
/// assert!((longest / 0.5_f64.exp() - 1.0).abs() < 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SurfaceTracker {
    surface: MovingSurface,
    broad_phase: BroadPhase,
    parameters: TrackerParameters,
    length: f64,
    time: f64,
    steps: u64,
    /// Steps since the trees of the broad phase were built.
    since_built: u32,
}

/// After so many steps the trees of the broad phase are built anew: those that follow a surface that is stretched and
/// remeshed get worse by and by (on the Enright test queries took five times as long after 250 steps), and building costs
/// as much as a fifth of a step.
const LIFE_OF_TREES: u32 = 8;

impl SurfaceTracker {
    /// A tracker of a surface, at time 0. The surface is compacted.
    ///
    /// # Errors
    /// [`TrackerError::Parameter`]; [`TrackerError::Integration`] with the pairs of triangles if the surface intersects itself.
    pub fn new(surface: MovingSurface, parameters: TrackerParameters) -> Result<Self, TrackerError> {
        let length = parameters.reference_length.unwrap_or_else(|| mean_edge_length(&surface));
        Self::resume(surface, parameters, length, 0.0, 0)
    }

    /// A tracker that goes on with the surface of another one, which had this reference length and had come to this time in so many
    /// steps.
    ///
    /// # Errors
    /// As [`SurfaceTracker::new`].
    pub fn resume(
        mut surface: MovingSurface,
        parameters: TrackerParameters,
        length: f64,
        time: f64,
        steps: u64,
    ) -> Result<Self, TrackerError> {
        parameters.improvement.validate()?;
        parameters.topology.validate()?;
        parameters.integration.validate()?;
        if surface.connectivity().edge_count() > 0 {
            require_length(length)?;
        }
        require_time(time)?;
        let _ = surface.compact();
        let _ = surface.take_log();
        let mut broad_phase = BroadPhase::new(&surface, Motion::Rest)?;
        let at_rest = surface.positions().to_vec();
        integration::accept(&mut surface, &mut broad_phase, &at_rest, &Monitor::none())?;
        Ok(Self { surface, broad_phase, parameters, length, time, steps, since_built: 0 })
    }

    /// The surface as it is.
    #[must_use]
    pub fn surface(&self) -> &MovingSurface {
        &self.surface
    }

    /// Masses and attributes, to change them.
    pub fn values(&mut self) -> SurfaceValues<'_> {
        SurfaceValues { surface: &mut self.surface }
    }

    /// The parameters.
    #[must_use]
    pub fn parameters(&self) -> &TrackerParameters {
        &self.parameters
    }

    /// The length to which relative lengths refer.
    #[must_use]
    pub fn reference_length(&self) -> f64 {
        self.length
    }

    /// Lets relative lengths refer to another length from now on.
    ///
    /// # Errors
    /// [`TrackerError::Parameter`] unless it is positive and finite.
    pub fn set_reference_length(&mut self, length: f64) -> Result<(), TrackerError> {
        require_length(length)?;
        self.length = length;
        Ok(())
    }

    /// Adds a mesh beside the surface, as [`MovingSurface::append`]; its vertices have these ids until the next step. Time does
    /// not go on.
    ///
    /// ```
    /// use welter_meshing::{DVec3, Monitor, shapes::{Sphere, sphere}, surface::TriMesh};
    /// use welter_tracking::surface::MovingSurface;
    /// use welter_tracking::tracker::{SurfaceTracker, TrackerParameters};
    ///
    /// let ball = sphere(&Sphere { edge_length: 0.5, ..Sphere::default() })?;
    /// let mut tracker = SurfaceTracker::new(MovingSurface::new(&ball)?, TrackerParameters::default())?;
    /// let mut soup = ball.to_soup();
    /// assert!(tracker.insert(&ball, &Monitor::none()).is_err(), "it is there already");
    /// soup.positions.iter_mut().for_each(|p| *p += 3.0 * DVec3::X);
    /// let added = tracker.insert(&TriMesh::new(soup)?, &Monitor::none())?;
    /// assert_eq!(added.len(), ball.positions().len());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`TrackerError::Append`] for what is no surface; [`TrackerError::Integration`] with the pairs of triangles if it meets the
    /// surface or itself, where ids of its triangles are those after the ones that are there; [`TrackerError::Parameter`] if the
    /// tracker has no reference length, since it had no edges and was given none. The surface is as it was then.
    pub fn insert(&mut self, mesh: &TriMesh, monitor: &Monitor<'_>) -> Result<Range<u32>, TrackerError> {
        require_length(self.length)?;
        let mut surface = self.surface.clone();
        let added = surface.append(mesh)?;
        let _ = surface.take_log();
        let mut broad_phase = BroadPhase::new(&surface, Motion::Rest)?;
        let at_rest = surface.positions().to_vec();
        integration::accept(&mut surface, &mut broad_phase, &at_rest, monitor)?;
        (self.surface, self.broad_phase, self.since_built) = (surface, broad_phase, 0);
        Ok(added)
    }

    /// Makes the surface that of its union with a shape, as [`MovingSurface::unite`]. Time does not go on.
    ///
    /// ```
    /// use welter_meshing::{DVec3, Monitor, shapes::{Sphere, sphere}};
    /// use welter_tracking::surface::{MovingSurface, UnionOutcome, UnionParameters};
    /// use welter_tracking::tracker::{SurfaceTracker, TrackerParameters};
    ///
    /// let ball = |x: f64| sphere(&Sphere { center: x * DVec3::X, edge_length: 0.5, ..Sphere::default() });
    /// let surface = MovingSurface::new(ball(0.0)?.as_mesh())?;
    /// let mut tracker = SurfaceTracker::new(surface, TrackerParameters::default())?;
    /// let report = tracker.unite(&ball(1.0)?, &UnionParameters::default(), &Monitor::none())?;
    /// assert_eq!(report.outcome, UnionOutcome::Joined);
    /// assert_eq!(tracker.surface().connectivity().euler_characteristic(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`TrackerError::Union`] with the reason; [`TrackerError::Parameter`] if the tracker has no reference length, since it had no
    /// edges and was given none. The surface is as it was then.
    pub fn unite(
        &mut self,
        shape: &ClosedOrientedMesh,
        parameters: &UnionParameters,
        monitor: &Monitor<'_>,
    ) -> Result<UnionReport, TrackerError> {
        require_length(self.length)?;
        let mut surface = self.surface.clone();
        let report = surface.unite(shape, parameters, monitor)?;
        if report.outcome == UnionOutcome::Within {
            return Ok(report);
        }
        let _ = surface.take_log();
        // It has passed the exact check as a mesh; here it passes the one that the tracker believes in.
        let mut broad_phase = BroadPhase::new(&surface, Motion::Rest)?;
        let at_rest = surface.positions().to_vec();
        integration::accept(&mut surface, &mut broad_phase, &at_rest, monitor)?;
        (self.surface, self.broad_phase, self.since_built) = (surface, broad_phase, 0);
        Ok(report)
    }

    /// How far time has gone on.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// How many steps were made.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Makes one step of at most `dt`: static operations, the flow, integration.
    ///
    /// # Errors
    /// [`TrackerError`]; the surface and the time are as they were then.
    pub fn step(
        &mut self,
        flow: &dyn Flow,
        dt: f64,
        monitor: &Monitor<'_>,
    ) -> Result<StepReport, TrackerError> {
        self.whole_or_not(|tracker, done| {
            tracker.change_connectivity(done, monitor)?;
            let smoothed = tracker.smoothed(done);
            done.dt = match tracker.step_undisturbed(smoothed.as_ref(), flow, dt, done, monitor)? {
                Some(reached) => reached,
                None => tracker.step_with_collisions(smoothed, flow, dt, done, monitor)?,
            };
            tracker.time += done.dt;
            tracker.steps += 1;
            Ok(())
        })
    }

    /// The static operations alone \[Brochu12, Algorithm 1\]; time does not go on.
    ///
    /// # Errors
    /// As [`SurfaceTracker::step`].
    pub fn improve(&mut self, monitor: &Monitor<'_>) -> Result<StepReport, TrackerError> {
        self.whole_or_not(|tracker, done| {
            tracker.change_connectivity(done, monitor)?;
            if let Some(ends) = tracker.smoothed(done) {
                tracker.smooth(ends, done, monitor)?;
            }
            let places = tracker.surface.positions().to_vec();
            tracker.accept(&places, done, monitor)
        })
    }

    /// Integration alone \[Brochu12, Algorithm 2\]: moves the surface towards positions by vertex id, as far as it can go. The
    /// report's `dt` is the part of the way; time does not go on.
    ///
    /// # Errors
    /// As [`SurfaceTracker::step`].
    pub fn move_to(&mut self, ends: Vec<DVec3>, monitor: &Monitor<'_>) -> Result<StepReport, TrackerError> {
        self.whole_or_not(|tracker, done| {
            done.dt = tracker.integrate(ends, done, monitor)?;
            Ok(())
        })
    }

    /// Carries out a part of a step, or restores the surface.
    fn whole_or_not(
        &mut self,
        work: impl FnOnce(&mut Self, &mut Done) -> Result<(), TrackerError>,
    ) -> Result<StepReport, TrackerError> {
        let start = Instant::now();
        let before = self.surface.clone();
        let mut done = Done::default();
        done.integration.collisions = Some(0);
        if let Err(error) = work(self, &mut done) {
            self.broad_phase = BroadPhase::new(&before, Motion::Rest)?;
            self.surface = before;
            return Err(error);
        }
        done.seconds.total = start.elapsed().as_secs_f64();
        let Done { dt, improvement, integration, log, seconds } = done;
        Ok(StepReport { dt, improvement, integration, log, seconds })
    }

    /// Smoothing and the flow as one motion, if nothing is near or in the way: then that is as if one came after
    /// the other. The time that the step takes; none, with the surface as it was, if something was in the way.
    fn step_undisturbed(
        &mut self,
        smoothed: Option<&Vec<DVec3>>,
        flow: &dyn Flow,
        dt: f64,
        done: &mut Done,
        monitor: &Monitor<'_>,
    ) -> Result<Option<f64>, TrackerError> {
        let before = smoothed.map(|ends| self.exchange(ends));
        let predicted = self.predict(flow, dt, done);
        if let Some(before) = &before {
            self.exchange(before);
        }
        // Where smoothing was not undisturbed, the flow may be asked where the surface never is.
        let Ok(Prediction { ends, dt: reached }) = predicted else { return Ok(None) };
        let clock = Instant::now();
        let (surface, broad_phase) = (&self.surface, &mut self.broad_phase);
        let parameters = &self.parameters.integration;
        let free = integration::is_free(surface, broad_phase, &ends, self.length, parameters, monitor)?;
        if !free {
            self.broad_phase.refresh(&self.surface, Motion::Rest)?;
        }
        done.seconds.collisions += clock.elapsed().as_secs_f64();
        if free {
            self.accept(&ends, done, monitor)?;
        }
        Ok(free.then_some(reached))
    }

    /// Smoothing, then the flow, each with its collisions resolved.
    fn step_with_collisions(
        &mut self,
        smoothed: Option<Vec<DVec3>>,
        flow: &dyn Flow,
        dt: f64,
        done: &mut Done,
        monitor: &Monitor<'_>,
    ) -> Result<f64, TrackerError> {
        if let Some(ends) = smoothed {
            self.smooth(ends, done, monitor)?;
        }
        let Prediction { ends, dt: reached } = self.predict(flow, dt, done)?;
        let fraction = self.integrate(ends, done, monitor)?;
        Ok(if fraction == 1.0 { reached } else { fraction * reached })
    }

    /// Where the flow goes, checked.
    fn predict(&self, flow: &dyn Flow, dt: f64, done: &mut Done) -> Result<Prediction, TrackerError> {
        predict(flow, &self.surface, self.time, dt, &mut done.seconds)
    }

    /// Puts the vertices elsewhere, unasked; where they were.
    fn exchange(&mut self, places: &[DVec3]) -> Vec<DVec3> {
        let before = self.surface.positions().to_vec();
        for (v, &place) in (0..).map(VertexId).zip(places) {
            self.surface.set_position(v, place).expect("smoothing gives finite places");
        }
        before
    }

    fn change_connectivity(&mut self, done: &mut Done, monitor: &Monitor<'_>) -> Result<(), TrackerError> {
        self.since_built += 1;
        if self.since_built >= LIFE_OF_TREES {
            // What it answers does not depend on how it was built.
            let clock = Instant::now();
            self.broad_phase = BroadPhase::new(&self.surface, Motion::Rest)?;
            self.since_built = 0;
            done.seconds.collisions += clock.elapsed().as_secs_f64();
        }
        self.remesh(done)?;
        monitor.check()?;
        self.change_topology(done)?;
        monitor.check()?;
        Ok(())
    }

    fn stage(&mut self) -> Stage<'_> {
        Stage {
            surface: &mut self.surface,
            broad_phase: Some(&mut self.broad_phase),
            parameters: &self.parameters.improvement,
            topology: &self.parameters.topology,
            length: self.length,
        }
    }

    fn remesh(&mut self, done: &mut Done) -> Result<(), TrackerError> {
        let clock = Instant::now();
        let (report, log) = self.stage().remesh()?;
        done.improvement.add(&report);
        done.seconds.improvement += clock.elapsed().as_secs_f64();
        self.compact(&log, done);
        Ok(())
    }

    /// Where smoothing would put the vertices, if it is switched on.
    fn smoothed(&self, done: &mut Done) -> Option<Vec<DVec3>> {
        let improvement = &self.parameters.improvement;
        let clock = Instant::now();
        let ends = improvement.smoothing.then(|| improvement::smoothed(&self.surface, improvement))?;
        let moved = ends.iter().zip(self.surface.positions()).filter(|(end, start)| end != start);
        done.improvement.smoothed += moved.count() as u64;
        done.seconds.improvement += clock.elapsed().as_secs_f64();
        Some(ends)
    }

    /// Smoothing as a pseudo-motion, with its collisions resolved; without repulsion, for nothing comes nearer by it.
    fn smooth(
        &mut self,
        ends: Vec<DVec3>,
        done: &mut Done,
        monitor: &Monitor<'_>,
    ) -> Result<(), TrackerError> {
        let clock = Instant::now();
        let parameters =
            IntegrationParameters { check_start: false, proximity_rel: 0.0, ..self.parameters.integration };
        let (surface, broad_phase) = (&self.surface, &mut self.broad_phase);
        let resolved = integration::resolve(surface, broad_phase, ends, self.length, &parameters, monitor)?;
        done.integration.add(&resolved.report);
        integration::pass_through(&mut self.surface, &mut self.broad_phase, &resolved.ends)?;
        done.seconds.improvement += clock.elapsed().as_secs_f64();
        Ok(())
    }

    fn change_topology(&mut self, done: &mut Done) -> Result<(), TrackerError> {
        if !self.parameters.topology.enabled {
            return Ok(());
        }
        let clock = Instant::now();
        let (report, log) = self.stage().change_topology()?;
        done.improvement.add(&report);
        done.seconds.topology += clock.elapsed().as_secs_f64();
        self.compact(&log, done);
        Ok(())
    }

    /// Numbers all elements anew if any came or went, so that what follows depends on the surface alone, not on its
    /// history.
    fn compact(&mut self, log: &EventLog, done: &mut Done) {
        if log.is_empty() {
            return;
        }
        let clock = Instant::now();
        let renumbering = self.surface.compact();
        self.broad_phase.renumber(&renumbering);
        done.log.append(log);
        done.log.append(&self.surface.take_log());
        done.seconds.compaction += clock.elapsed().as_secs_f64();
    }

    /// Moves the surface towards the ends; the part of the way that it went.
    fn integrate(
        &mut self,
        ends: Vec<DVec3>,
        done: &mut Done,
        monitor: &Monitor<'_>,
    ) -> Result<f64, TrackerError> {
        let clock = Instant::now();
        // It was accepted, or changed by what is admitted.
        let parameters = IntegrationParameters { check_start: false, ..self.parameters.integration };
        let (surface, broad_phase) = (&self.surface, &mut self.broad_phase);
        let resolved = integration::resolve(surface, broad_phase, ends, self.length, &parameters, monitor)?;
        done.integration.add(&resolved.report);
        done.seconds.collisions += clock.elapsed().as_secs_f64();
        self.accept(&resolved.ends, done, monitor)?;
        Ok(resolved.fraction)
    }

    fn accept(&mut self, ends: &[DVec3], done: &mut Done, monitor: &Monitor<'_>) -> Result<(), TrackerError> {
        let clock = Instant::now();
        integration::accept(&mut self.surface, &mut self.broad_phase, ends, monitor)?;
        done.seconds.check += clock.elapsed().as_secs_f64();
        Ok(())
    }
}

/// Where a flow goes, checked.
fn predict(
    flow: &dyn Flow,
    surface: &MovingSurface,
    time: f64,
    dt: f64,
    seconds: &mut PhaseSeconds,
) -> Result<Prediction, TrackerError> {
    let clock = Instant::now();
    let prediction = flow.advance(surface, time, dt)?;
    seconds.velocity += clock.elapsed().as_secs_f64();
    if !(prediction.dt > 0.0 && prediction.dt <= dt) {
        return Err(TrackerError::Step { dt: prediction.dt, asked: dt });
    }
    Ok(prediction)
}

fn require_length(length: f64) -> Result<(), ParameterError> {
    let range = "positive and finite: the mean edge length, unless it is given";
    let error = ParameterError { parameter: "reference_length", value: length, range };
    if length > 0.0 && length.is_finite() { Ok(()) } else { Err(error) }
}

fn require_time(time: f64) -> Result<(), ParameterError> {
    let error = ParameterError { parameter: "time", value: time, range: "finite" };
    if time.is_finite() { Ok(()) } else { Err(error) }
}

/// What of a tracked surface may be changed from outside: all but positions and connectivity.
#[derive(Debug)]
pub struct SurfaceValues<'a> {
    surface: &'a mut MovingSurface,
}

impl SurfaceValues<'_> {
    /// Attributes of vertices.
    #[must_use]
    pub fn vertex_attributes(&mut self) -> &mut AttributeSet<VertexId> {
        self.surface.vertex_attributes_mut()
    }

    /// Attributes of edges.
    #[must_use]
    pub fn edge_attributes(&mut self) -> &mut AttributeSet<EdgeId> {
        self.surface.edge_attributes_mut()
    }

    /// Attributes of triangles.
    #[must_use]
    pub fn triangle_attributes(&mut self) -> &mut AttributeSet<TriId> {
        self.surface.triangle_attributes_mut()
    }

    /// Gives a vertex a mass, as [`MovingSurface::set_mass`].
    ///
    /// # Errors
    /// [`VertexValueError::Mass`] unless it is above zero.
    ///
    /// # Panics
    /// If its id was never given out.
    pub fn set_mass(&mut self, vertex: VertexId, mass: f64) -> Result<(), VertexValueError> {
        self.surface.set_mass(vertex, mass)
    }
}

/// What a step has done so far.
#[derive(Debug, Default)]
struct Done {
    dt: f64,
    improvement: ImprovementReport,
    integration: IntegrationReport,
    log: EventLog,
    seconds: PhaseSeconds,
}

/// The mean of all edge lengths, added up in the order of ids.
fn mean_edge_length(surface: &MovingSurface) -> f64 {
    let mesh = surface.connectivity();
    let length = |e| {
        let [a, b] = mesh.ends(e).map(|v| surface.position(v));
        a.distance(b)
    };
    mesh.edges().map(length).sum::<f64>() / mesh.edge_count() as f64
}
