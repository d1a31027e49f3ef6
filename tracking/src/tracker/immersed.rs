//! The tracker without collisions: [`ImmersedTracker`].
//!
//! # What it computes
//! Steps of remeshing and of a flow. Nothing is asked about intersections: the surface is immersed in space rather than
//! embedded. \[Brochu12, section 5.3\] tracks smoke so: a flow without divergence makes a surface meet itself only by the
//! errors of steps and triangles, and collisions are most of the cost.
//!
//! # What it promises
//! * Vertices go just where the flow puts them.
//! * No change of topology: components, holes, boundaries and singular vertices stay.
//! * A step that fails returns an error and leaves the surface as it was.
//! * The same bits for any number of threads, and with all lengths times a power of two, as for a
//!   [`SurfaceTracker`](super::SurfaceTracker). As long as that one, with topology switched off, refuses nothing for an intersection and
//!   meets nothing on its way, both give the same bits.
//!
//! # What it does not promise
//! That the surface encloses anything: it may pass through itself and turn inside out.
//!
//! # Complexity
//! Linear in the number of elements, and some microseconds for each change of connectivity.

use super::{PhaseSeconds, StepReport, SurfaceValues, TrackerError, predict, require_length, require_time};
use crate::broad_phase::BroadPhaseError;
use crate::flows::Flow;
use crate::improvement::{ImprovementParameters, ImprovementReport, Stage, TopologyParameters, smoothed};
use crate::integration::IntegrationReport;
use crate::surface::{EventLog, MovingSurface, UnionParameters, UnionReport};
use glam::DVec3;
use std::ops::Range;
use std::time::Instant;
use welter_meshing::Monitor;
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh, VertexId};

/// A surface that moves with a flow and is remeshed, and may pass through itself.
///
/// ```
/// use glam::DVec3;
/// use welter_meshing::{Monitor, shapes::{Sphere, sphere}};
/// use welter_tracking::flows::Advection;
/// use welter_tracking::improvement::ImprovementParameters;
/// use welter_tracking::surface::MovingSurface;
/// use welter_tracking::tracker::ImmersedTracker;
///
/// let ball = sphere(&Sphere { edge_length: 0.3, ..Sphere::default() })?;
/// let mut tracker = ImmersedTracker::new(MovingSurface::new(&ball)?, ImprovementParameters::default(), 0.3, 0.0)?;
/// // Both halves go through each other.
/// let through = Advection::new(|p: DVec3, _: f64| DVec3::new(0.0, 0.0, -2.0 * p.z.signum()));
/// for _ in 0..10 {
///     let report = tracker.step(&through, 0.1, &Monitor::none())?;
///     assert_eq!((report.dt, report.improvement.refused.intersection), (0.1, 0));
/// }
/// assert_eq!(tracker.time(), (0..10).fold(0.0, |time, _| time + 0.1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ImmersedTracker {
    surface: MovingSurface,
    improvement: ImprovementParameters,
    length: f64,
    time: f64,
}

impl ImmersedTracker {
    /// A tracker of a surface at a time, with the length to which relative lengths refer. The surface is compacted. One that is made
    /// of the surface of another goes on with the same bits as that one.
    ///
    /// # Errors
    /// [`TrackerError::Parameter`].
    pub fn new(
        mut surface: MovingSurface,
        improvement: ImprovementParameters,
        length: f64,
        time: f64,
    ) -> Result<Self, TrackerError> {
        improvement.validate()?;
        require_length(length)?;
        require_time(time)?;
        let _ = surface.compact();
        let _ = surface.take_log();
        Ok(Self { surface, improvement, length, time })
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

    /// How far time has gone on.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Adds a mesh beside the surface, as [`MovingSurface::append`], wherever that is; its vertices have these ids until the next
    /// step.
    ///
    /// # Errors
    /// [`TrackerError::Append`] for what is no surface.
    pub fn insert(&mut self, mesh: &TriMesh) -> Result<Range<u32>, TrackerError> {
        let added = self.surface.append(mesh)?;
        let _ = self.surface.take_log();
        Ok(added)
    }

    /// Makes the surface that of its union with a shape, as [`MovingSurface::unite`], which refuses one that passes through itself.
    ///
    /// # Errors
    /// [`TrackerError::Union`] with the reason; the surface is as it was then.
    pub fn unite(
        &mut self,
        shape: &ClosedOrientedMesh,
        parameters: &UnionParameters,
        monitor: &Monitor<'_>,
    ) -> Result<UnionReport, TrackerError> {
        let report = self.surface.unite(shape, parameters, monitor)?;
        let _ = self.surface.take_log();
        Ok(report)
    }

    /// Makes one step of at most `dt`: remeshing, smoothing, the flow.
    ///
    /// # Errors
    /// [`TrackerError`]; the surface and the time are as they were then.
    pub fn step(
        &mut self,
        flow: &dyn Flow,
        dt: f64,
        monitor: &Monitor<'_>,
    ) -> Result<StepReport, TrackerError> {
        let start = Instant::now();
        let before = self.surface.clone();
        let mut report = StepReport {
            dt: 0.0,
            improvement: ImprovementReport::default(),
            integration: IntegrationReport { collisions: Some(0), ..IntegrationReport::default() },
            log: EventLog::default(),
            seconds: PhaseSeconds::default(),
        };
        if let Err(error) = self.move_on(flow, dt, &mut report, monitor) {
            self.surface = before;
            return Err(error);
        }
        self.time += report.dt;
        report.seconds.total = start.elapsed().as_secs_f64();
        Ok(report)
    }

    fn move_on(
        &mut self,
        flow: &dyn Flow,
        dt: f64,
        report: &mut StepReport,
        monitor: &Monitor<'_>,
    ) -> Result<(), TrackerError> {
        self.remesh(report)?;
        monitor.check()?;
        self.smooth(report);
        let prediction = predict(flow, &self.surface, self.time, dt, &mut report.seconds)?;
        monitor.check()?;
        let (ends, vertices) = (prediction.ends.len(), self.surface.positions().len());
        if ends != vertices {
            return Err(BroadPhaseError::Ends { ends, vertices }.into());
        }
        report.dt = prediction.dt;
        self.place(&prediction.ends)
    }

    fn remesh(&mut self, report: &mut StepReport) -> Result<(), TrackerError> {
        let clock = Instant::now();
        let topology = TopologyParameters { enabled: false, ..TopologyParameters::default() };
        let mut stage = Stage {
            surface: &mut self.surface,
            broad_phase: None,
            parameters: &self.improvement,
            topology: &topology,
            length: self.length,
        };
        let (improvement, log) = stage.remesh()?;
        report.improvement.add(&improvement);
        report.seconds.improvement += clock.elapsed().as_secs_f64();
        if !log.is_empty() {
            let clock = Instant::now();
            let _ = self.surface.compact();
            report.log.append(&log);
            report.log.append(&self.surface.take_log());
            report.seconds.compaction += clock.elapsed().as_secs_f64();
        }
        Ok(())
    }

    fn smooth(&mut self, report: &mut StepReport) {
        if !self.improvement.smoothing {
            return;
        }
        let clock = Instant::now();
        let ends = smoothed(&self.surface, &self.improvement);
        let moved = ends.iter().zip(self.surface.positions()).filter(|(end, start)| end != start);
        report.improvement.smoothed += moved.count() as u64;
        self.place(&ends).expect("smoothing gives finite places");
        report.seconds.improvement += clock.elapsed().as_secs_f64();
    }

    fn place(&mut self, ends: &[DVec3]) -> Result<(), TrackerError> {
        for (v, &end) in (0..).map(VertexId).zip(ends) {
            self.surface.set_position(v, end)?;
        }
        Ok(())
    }
}
