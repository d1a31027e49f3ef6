//! Smoke that is released and carried by a flow: [`SmokeSimulation`].
//!
//! # What it computes
//! The loop of \[Brochu12, section 5.3\]: what is due is released; the surface is remeshed, and merges and parts if it may; each of its
//! vertices follows the flow; ages grow by the time that went by. A step is cut at the times of releases, so that each begins
//! at its own time.
//!
//! # What it promises
//! * After a step to a time, everything is there that was due until that time, that time included, but what the report says was
//!   refused, with the reason.
//! * The age of a vertex is the time since its release; one that remeshing makes has a mean of the ages of its sources, so every age
//!   is between the least and the largest time since a release, up to roundings.
//! * Vertices follow the flow with an error of order four in the step.
//! * There are never more triangles than the budget allows, but for those that close parted surfaces, where these may part.
//! * With collisions, the surface never intersects itself.
//! * A merged release becomes the union with the smoke that is there: what lies inside of both is inside of one surface, and a release
//!   that lies inside of smoke adds nothing. Ages along the curves where both crossed are those of the smoke that was there.
//! * A step that fails returns an error and leaves everything as it was.
//! * The same bits for any number of threads; and a run that is resumed from a state goes on with the same bits as one that was never
//!   stopped.
//!
//! # What it does not promise
//! * That ages follow material points exactly: splits and collapses give means, and smoothing shifts vertices along the surface with
//!   their ages, by a quarter of an edge at most in a step.
//! * Volume: flat triangles change it with an order of two in the edge length, and remeshing adds about as much (`docs/accuracy.md`).
//! * Without collisions, which is the default, that the surface is free of intersections.
//! * Triangles of a good shape where a merged release was united with smoke, before the next step remeshes them.
//! * That a merged release comes about where it is: one that meets smoke in no general position is shifted by small parts of its edges
//!   ([`UnionParameters`](welter_tracking::surface::UnionParameters)), as the report tells.
//!
//! # Complexity
//! A step is linear in the number of elements, and so is each release.

use welter_meshing::Monitor;
use welter_meshing::spatial::self_intersections;
use welter_meshing::surface::{Topology, TriMesh, VertexId};
use welter_tracking::flows::{Advection, Flow, FlowError, Prediction, Scheme, VelocityField};
use welter_tracking::surface::{Attribute, MovingSurface, Rule};

use glam::DVec3;

use super::carrier::Carrier;
use super::emission::next_release;
use super::{
    Emission, EmittedShape, Joining, OverBudget, Refusal, Release, Released, SmokeError, SmokeParameterError,
    SmokeParameters, SmokeState, SmokeStep,
};

/// The name of the attribute of vertices that holds their ages.
const AGE: &str = "age";

/// Smoke that is released and carried by a flow.
///
/// ```
/// use welter_fluids::procedural::{VortexRing, VortexRingParameters};
/// use welter_fluids::smoke::{Emission, EmittedShape, Joining, Schedule, SmokeParameters, SmokeSimulation};
/// use welter_meshing::{Monitor, shapes::{Sphere, sphere}};
///
/// let puff = sphere(&Sphere { radius: 0.25, edge_length: 0.1, ..Sphere::default() })?;
/// let emission = Emission {
///     shape: EmittedShape::Closed(puff),
///     schedule: Schedule { start: 0.0, interval: 0.15, count: None },
///     joining: Joining::Separate,
///     path: None,
/// };
/// let mut smoke = SmokeSimulation::new(vec![emission], SmokeParameters::default(), &Monitor::none())?;
/// let ring = VortexRing::new(&VortexRingParameters::default())?;
/// for frame in 1..=4 {
///     let step = smoke.step_to(&ring, 0.1 * f64::from(frame), &Monitor::none())?;
///     assert!(step.releases.iter().all(|release| release.refusal.is_none()));
/// }
/// // Released at 0, 0.15 and 0.3.
/// let oldest = smoke.ages().iter().copied().fold(0.0, f64::max);
/// let youngest = smoke.ages().iter().copied().fold(1.0, f64::min);
/// assert!((oldest - 0.4).abs() < 1e-12 && (youngest - 0.1).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SmokeSimulation {
    emissions: Vec<Emission>,
    parameters: SmokeParameters,
    carrier: Carrier,
    age: Attribute<f64, VertexId>,
    time: f64,
    at_start: Vec<Released>,
}

impl SmokeSimulation {
    /// A run at its start, with what is released then.
    ///
    /// # Errors
    /// [`SmokeError`] for parameters or emissions that are out of range.
    pub fn new(
        emissions: Vec<Emission>,
        parameters: SmokeParameters,
        monitor: &Monitor<'_>,
    ) -> Result<Self, SmokeError> {
        parameters.validate()?;
        check(&emissions, &parameters, monitor)?;
        let length = reference_length(&emissions, &parameters)?;
        let nothing = TriMesh::new(welter_meshing::surface::TriangleSoup::default())?;
        let time = parameters.start;
        let state = SmokeState { mesh: nothing, ages: Vec::new(), time, reference_length: length };
        let mut smoke = Self::at(emissions, parameters, state)?;
        let mut report = SmokeStep::none();
        smoke.release(time, &mut report, monitor)?;
        if report.met_the_budget() {
            smoke.coarsen()?;
        }
        smoke.at_start = report.releases;
        Ok(smoke)
    }

    /// A run that goes on from a state, as [`SmokeSimulation::state`] gives it, with the emissions and parameters of that run.
    ///
    /// # Errors
    /// As [`SmokeSimulation::new`]; [`SmokeError::StateDefects`], [`SmokeError::StateAges`] and [`SmokeError::Tracker`] for what is no
    /// state of such a run.
    pub fn resume(
        emissions: Vec<Emission>,
        parameters: SmokeParameters,
        state: SmokeState,
        monitor: &Monitor<'_>,
    ) -> Result<Self, SmokeError> {
        parameters.validate()?;
        check(&emissions, &parameters, monitor)?;
        Self::at(emissions, parameters, state)
    }

    fn at(
        emissions: Vec<Emission>,
        parameters: SmokeParameters,
        state: SmokeState,
    ) -> Result<Self, SmokeError> {
        let SmokeState { mesh, ages, time, reference_length } = state;
        let mut surface = MovingSurface::new(&mesh).map_err(SmokeError::StateDefects)?;
        let (count, vertices) = (ages.len(), mesh.positions().len());
        if count != vertices {
            return Err(SmokeError::StateAges { ages: count, vertices });
        }
        if let Some(&age) = ages.iter().find(|age| !age.is_finite()) {
            return Err(SmokeParameterError { name: "age", value: age, must: "finite" }.into());
        }
        let age = surface
            .vertex_attributes_mut()
            .add(AGE, ages, Rule::Interpolate)
            .expect("the first attribute, with a value for each vertex");
        let carrier = Carrier::new(surface, &parameters, reference_length, time)
            .map_err(|error| SmokeError::of_tracker(time, error))?;
        Ok(Self { emissions, parameters, carrier, age, time, at_start: Vec::new() })
    }

    /// Everything that later steps depend on, beside the emissions, the parameters and the flow.
    #[must_use]
    pub fn state(&self) -> SmokeState {
        SmokeState {
            mesh: self.mesh(),
            ages: self.ages().to_vec(),
            time: self.time,
            reference_length: self.reference_length(),
        }
    }

    /// How far time has gone on.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The surface.
    #[must_use]
    pub fn surface(&self) -> &MovingSurface {
        self.carrier.surface()
    }

    /// The surface as a mesh, with the vertices of [`SmokeSimulation::ages`].
    #[must_use]
    pub fn mesh(&self) -> TriMesh {
        self.surface().to_mesh()
    }

    /// The age of each vertex: the time since its release.
    #[must_use]
    pub fn ages(&self) -> &[f64] {
        self.surface().vertex_attributes().values(self.age)
    }

    /// The length to which relative lengths refer.
    #[must_use]
    pub fn reference_length(&self) -> f64 {
        self.carrier.length()
    }

    /// What was to be released at the start; nothing if the run was resumed.
    #[must_use]
    pub fn at_start(&self) -> &[Released] {
        &self.at_start
    }

    /// Goes on to a time with a flow.
    ///
    /// # Errors
    /// [`SmokeError`]; everything is as it was then.
    pub fn step_to(
        &mut self,
        flow: &impl VelocityField,
        end: f64,
        monitor: &Monitor<'_>,
    ) -> Result<SmokeStep, SmokeError> {
        let time = self.time;
        if !(end.is_finite() && end > time) {
            return Err(SmokeError::Step { time, end });
        }
        let before = self.carrier.clone();
        let mut report = SmokeStep::none();
        if let Err(error) = self.go_on(flow, end, &mut report, monitor) {
            (self.carrier, self.time) = (before, time);
            return Err(error);
        }
        let mesh = self.surface().connectivity();
        (report.vertices, report.triangles) = (mesh.vertex_count(), mesh.triangle_count());
        report.reference_length = self.reference_length();
        Ok(report)
    }

    fn go_on(
        &mut self,
        flow: &impl VelocityField,
        end: f64,
        report: &mut SmokeStep,
        monitor: &Monitor<'_>,
    ) -> Result<(), SmokeError> {
        while self.time < end {
            let next = next_release(&self.emissions, self.time, end).unwrap_or(end);
            self.carry(flow, next, report, monitor)?;
            self.release(next, report, monitor)?;
        }
        if report.met_the_budget() {
            self.coarsen()?;
        }
        Ok(())
    }

    /// Carries what is there to a time, in parts if collisions ask for it.
    fn carry(
        &mut self,
        flow: &impl VelocityField,
        to: f64,
        report: &mut SmokeStep,
        monitor: &Monitor<'_>,
    ) -> Result<(), SmokeError> {
        let mut substeps = 0;
        while self.time < to {
            if self.surface().connectivity().triangle_count() == 0 {
                self.time = to;
                break;
            }
            let (time, dt) = (self.time, to - self.time);
            if substeps == self.parameters.most_substeps {
                return Err(SmokeError::Stuck { time, left: dt, substeps });
            }
            substeps += 1;
            let motion = Motion { flow, scheme: self.parameters.scheme, time };
            let step = self
                .carrier
                .step(&motion, dt, monitor)
                .map_err(|error| SmokeError::of_tracker(time, error))?;
            let age = self.age;
            self.carrier
                .values()
                .vertex_attributes()
                .values_mut(age)
                .iter_mut()
                .for_each(|age| *age += step.dt);
            self.time = if step.dt == dt { to } else { time + step.dt };
            report.add(&step);
        }
        Ok(())
    }

    /// Releases what is due at a time.
    fn release(
        &mut self,
        time: f64,
        report: &mut SmokeStep,
        monitor: &Monitor<'_>,
    ) -> Result<(), SmokeError> {
        for emission in 0..self.emissions.len() {
            let due: Vec<Release> = self.emissions[emission].schedule.within(time, time.next_up()).collect();
            for release in due {
                let shape = self.emissions[emission]
                    .released(release)
                    .map_err(|error| SmokeError::Emission { emission, error })?;
                let triangles = shape.mesh().triangles().len();
                let present = self.surface().connectivity().triangle_count();
                let most = self.parameters.most_triangles;
                let released = match &shape {
                    EmittedShape::Closed(shape) if self.emissions[emission].joining == Joining::Merged => {
                        self.carrier.unite(shape, most, monitor).map(|united| united.map(Some))
                    }
                    _ if present + triangles > most => Ok(Err(Refusal::Budget { present })),
                    _ => self
                        .carrier
                        .insert(shape.mesh(), monitor)
                        .map(|refusal| refusal.map_or(Ok(None), Err)),
                };
                let released = released.map_err(|error| SmokeError::of_tracker(time, error))?;
                let (union, refusal) = match released {
                    Ok(union) => (union, None),
                    Err(refusal) => (None, Some(refusal)),
                };
                report.releases.push(Released { emission, release, triangles, refusal, union });
            }
        }
        Ok(())
    }

    /// Makes edges longer, as far as there are numbers for it.
    fn coarsen(&mut self) -> Result<(), SmokeError> {
        let OverBudget::Coarsen { factor } = self.parameters.over_budget else { return Ok(()) };
        let length = factor * self.reference_length();
        if !length.is_finite() {
            return Ok(());
        }
        self.carrier.set_length(length).map_err(|error| SmokeError::of_tracker(self.time, error))
    }
}

/// The flow, at the time of the run rather than that of the tracker, which adds up steps.
struct Motion<'f, F> {
    flow: &'f F,
    scheme: Scheme,
    time: f64,
}

/// A flow that somebody else owns.
struct Lent<'f, F>(&'f F);

impl<F: VelocityField> VelocityField for Lent<'_, F> {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        self.0.velocity(position, time)
    }

    fn confine(&self, from: DVec3, to: DVec3, times: [f64; 2]) -> DVec3 {
        self.0.confine(from, to, times)
    }
}

impl<F: VelocityField> Flow for Motion<'_, F> {
    fn advance(&self, surface: &MovingSurface, _time: f64, dt: f64) -> Result<Prediction, FlowError> {
        Advection { field: Lent(self.flow), scheme: self.scheme }.advance(surface, self.time, dt)
    }
}

/// Refuses emissions that are none of such a run.
fn check(
    emissions: &[Emission],
    parameters: &SmokeParameters,
    monitor: &Monitor<'_>,
) -> Result<(), SmokeError> {
    for (emission, it) in emissions.iter().enumerate() {
        it.validate().map_err(|error| SmokeError::Emission { emission, error })?;
        MovingSurface::new(it.shape.mesh()).map_err(|defects| SmokeError::Shape { emission, defects })?;
        let (begins, start) = (it.schedule.start, parameters.start);
        if begins < start {
            return Err(SmokeError::BeginsBefore { emission, begins, start });
        }
        if it.joining == Joining::Merged && !parameters.changes_topology() {
            return Err(SmokeError::MergedWithoutTopology { emission });
        }
        if parameters.collisions.is_some() {
            let pairs = self_intersections(it.shape.mesh(), monitor)?;
            if !pairs.is_empty() {
                return Err(SmokeError::ShapeIntersectsItself { emission, pairs });
            }
        }
    }
    Ok(())
}

/// The length given, or the mean over the edges of all shapes, added up in their order.
fn reference_length(emissions: &[Emission], parameters: &SmokeParameters) -> Result<f64, SmokeError> {
    if let Some(length) = parameters.reference_length {
        return Ok(length);
    }
    if emissions.is_empty() {
        return Err(SmokeError::NoEmission);
    }
    let (mut sum, mut count) = (0.0, 0.0);
    for emission in emissions {
        let mesh = emission.shape.mesh();
        for ends in Topology::of(mesh).edges() {
            let [a, b] = ends.map(|v| mesh.positions()[v.index()]);
            sum += a.distance(b);
            count += 1.0;
        }
    }
    Ok(sum / count)
}
