//! Particles that are released and carried by a flow: [`MarkerSimulation`].
//!
//! # What it computes
//! What is due is released, at its own time; each particle follows the flow; ages grow by the time that went by. Steps are cut at the
//! times of releases, as those of [`SmokeSimulation`](crate::smoke::SmokeSimulation) are, so with the same steps a particle follows
//! the same path as a vertex there, bit for bit, as long as nothing is remeshed.
//!
//! # What it promises
//! * Every particle carries the same volume; those of all releases of an emission so far carry what was released, to half a
//!   particle.
//! * A particle depends on the emission, the release and the flow alone, so runs that divide time into the same steps agree, and a
//!   run that is resumed from a state goes on with the same bits as one that was never stopped.
//! * A step that fails returns an error and leaves everything as it was.
//! * The same bits for any number of threads; and with all lengths times a power of two, volumes times its cube, the same bits,
//!   scaled, as long as nothing is below the smallest normal number.
//!
//! # What it does not promise
//! * That particles stay evenly spread: a flow without divergence keeps their mean density, not the distances.
//! * Merged releases: those are particles like all others, and where shapes overlap there are those of both.
//!
//! # Complexity
//! Linear in the particles and the steps.

use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::Monitor;
use welter_meshing::surface::measure::signed_volume;
use welter_tracking::flows::{NoVelocity, VelocityField};

use super::{MarkerError, MarkerParameters, MarkerState, fill};
use crate::smoke::{Emission, EmissionError, EmittedShape, Release, next_release};

/// How many particles a thread takes at once at least.
const PIECE: usize = 256;

/// The most particles of one emission, so that numbers of them are exact.
const MOST: f64 = (1_u64 << 52) as f64;

/// A release as particles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkerRelease {
    /// Of which emission, from 0.
    pub emission: usize,
    /// Which release of it.
    pub release: Release,
    /// How many particles it is.
    pub particles: usize,
}

/// What a step did.
#[derive(Clone, Debug, Default, PartialEq)]
#[must_use]
pub struct MarkerStep {
    /// What was released, in order of time, then of emissions.
    pub releases: Vec<MarkerRelease>,
    /// Particles at the end.
    pub particles: usize,
}

/// Particles that are released and carried by a flow.
///
/// ```
/// use welter_fluids::marker_particles::{MarkerParameters, MarkerSimulation};
/// use welter_fluids::procedural::{VortexRing, VortexRingParameters};
/// use welter_fluids::smoke::{Emission, EmittedShape, Joining, Schedule};
/// use welter_meshing::{Monitor, shapes::{Sphere, sphere}};
///
/// let puff = sphere(&Sphere { radius: 0.25, edge_length: 0.1, ..Sphere::default() })?;
/// let emissions = vec![Emission {
///     shape: EmittedShape::Closed(puff),
///     schedule: Schedule { start: 0.0, interval: 0.15, count: None },
///     joining: Joining::Separate,
///     path: None,
/// }];
/// let parameters = MarkerParameters::within(&emissions, 600, 0.4)?;
/// let mut smoke = MarkerSimulation::new(emissions, parameters, &Monitor::none())?;
/// let ring = VortexRing::new(&VortexRingParameters::default())?;
/// let step = smoke.step_to(&ring, 0.4, &Monitor::none())?;
/// // Released at 0, 0.15 and 0.3.
/// assert_eq!((step.releases.len(), step.particles), (2, 600));
/// let oldest = smoke.state().ages.iter().copied().fold(0.0, f64::max);
/// assert!((oldest - 0.4).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct MarkerSimulation {
    emissions: Vec<Emission>,
    parameters: MarkerParameters,
    /// Of how many particles a release of each emission is, in the mean.
    shares: Vec<f64>,
    state: MarkerState,
    at_start: Vec<MarkerRelease>,
}

impl MarkerSimulation {
    /// A run at its start, with what is released then.
    ///
    /// # Errors
    /// [`MarkerError`] for parameters or emissions that are out of range.
    pub fn new(
        emissions: Vec<Emission>,
        parameters: MarkerParameters,
        monitor: &Monitor<'_>,
    ) -> Result<Self, MarkerError> {
        let state = MarkerState { time: parameters.start, ..MarkerState::default() };
        let mut run = Self::resume(emissions, parameters, state)?;
        let mut start = run.state.clone();
        run.at_start = run.release(&mut start, monitor)?;
        run.state = start;
        Ok(run)
    }

    /// A run that goes on from a state, as [`MarkerSimulation::state`] gives it, with the emissions and parameters of that run.
    ///
    /// # Errors
    /// As [`MarkerSimulation::new`]; [`MarkerError::StateAges`] and [`MarkerError::StateParticle`] for what is no state.
    pub fn resume(
        emissions: Vec<Emission>,
        parameters: MarkerParameters,
        state: MarkerState,
    ) -> Result<Self, MarkerError> {
        parameters.validate()?;
        let shares = shares(&emissions, &parameters)?;
        let (particles, ages) = (state.positions.len(), state.ages.len());
        if particles != ages {
            return Err(MarkerError::StateAges { ages, particles });
        }
        let mut all = state.positions.iter().zip(&state.ages);
        if let Some(particle) = all.position(|(p, age)| !(p.is_finite() && age.is_finite())) {
            return Err(MarkerError::StateParticle { particle });
        }
        MarkerError::require(state.time.is_finite(), "the time of the state", state.time, "finite")?;
        Ok(Self { emissions, parameters, shares, state, at_start: Vec::new() })
    }

    /// Everything that later steps depend on, beside the emissions, the parameters and the flow.
    #[must_use]
    pub fn state(&self) -> &MarkerState {
        &self.state
    }

    /// The volume of smoke that each particle carries.
    #[must_use]
    pub fn particle_volume(&self) -> f64 {
        self.parameters.particle_volume
    }

    /// What was released at the start; nothing if the run was resumed.
    #[must_use]
    pub fn at_start(&self) -> &[MarkerRelease] {
        &self.at_start
    }

    /// Goes on to a time with a flow.
    ///
    /// # Errors
    /// [`MarkerError`]; everything is as it was then.
    pub fn step_to(
        &mut self,
        flow: &impl VelocityField,
        end: f64,
        monitor: &Monitor<'_>,
    ) -> Result<MarkerStep, MarkerError> {
        let time = self.state.time;
        if !(end.is_finite() && end > time) {
            return Err(MarkerError::Step { time, end });
        }
        let mut state = self.state.clone();
        let mut report = MarkerStep::default();
        while state.time < end {
            monitor.check()?;
            let next = next_release(&self.emissions, state.time, end).unwrap_or(end);
            self.carry(&mut state, flow, next)?;
            report.releases.extend(self.release(&mut state, monitor)?);
        }
        report.particles = state.positions.len();
        self.state = state;
        Ok(report)
    }

    /// Carries what is there to a time.
    fn carry(&self, state: &mut MarkerState, flow: &impl VelocityField, to: f64) -> Result<(), MarkerError> {
        let (time, dt) = (state.time, to - state.time);
        let scheme = self.parameters.scheme;
        let end = |(particle, &start): (usize, &DVec3)| match scheme.follow(flow, start, time, dt) {
            Ok(end) if end.is_finite() => Ok(end),
            Ok(end) => Err(MarkerError::End { particle, start, end }),
            Err(NoVelocity { position, time, velocity }) => {
                Err(MarkerError::Velocity { particle, position, time, velocity })
            }
        };
        let all = state.positions.par_iter().with_min_len(PIECE).enumerate();
        state.positions = match all.map(|it| end(it).ok()).collect::<Option<Vec<DVec3>>>() {
            Some(ends) => ends,
            // Which of several errors a parallel search meets first depends on the threads.
            None => state.positions.iter().enumerate().map(end).collect::<Result<_, _>>()?,
        };
        state.ages.iter_mut().for_each(|age| *age += dt);
        state.time = to;
        Ok(())
    }

    /// Releases what is due at the time of a state.
    fn release(
        &self,
        state: &mut MarkerState,
        monitor: &Monitor<'_>,
    ) -> Result<Vec<MarkerRelease>, MarkerError> {
        let (time, most) = (state.time, self.parameters.most_particles);
        let mut releases = Vec::new();
        for (emission, it) in self.emissions.iter().enumerate() {
            let EmittedShape::Closed(shape) = &it.shape else {
                return Err(MarkerError::Open { emission });
            };
            for release in it.schedule.within(time, time.next_up()) {
                // Whole particles of all releases so far, less those of the releases before: no remainder is kept.
                let until = |index: f64| (index * self.shares[emission]).round().min(MOST) as u64;
                let index = f64::from(release.index);
                let count = until(index + 1.0) - until(index);
                let particles = state.positions.len() as u64 + count;
                if particles > most as u64 {
                    return Err(MarkerError::TooMany { emission, particles, most });
                }
                let seed = (emission as u64) << 32 | u64::from(release.index);
                let points = fill(shape, count as usize, seed, monitor)
                    .map_err(|error| MarkerError::of_filling(emission, error))?;
                let displacement = it.path.as_ref().map_or(DVec3::ZERO, |path| path.at(release.time));
                let first = state.positions.len();
                state.positions.extend(points.iter().map(|&point| point + displacement));
                if state.positions[first..].iter().any(|p| !p.is_finite()) {
                    return Err(MarkerError::Displaced { emission, time });
                }
                state.ages.resize(state.positions.len(), 0.0);
                releases.push(MarkerRelease { emission, release, particles: count as usize });
            }
        }
        Ok(releases)
    }
}

/// Of how many particles a release of each emission is; refuses emissions that are none of such a run.
fn shares(emissions: &[Emission], parameters: &MarkerParameters) -> Result<Vec<f64>, MarkerError> {
    let share = |(emission, it): (usize, &Emission)| {
        it.validate().map_err(|error: EmissionError| MarkerError::Emission { emission, error })?;
        if matches!(it.shape, EmittedShape::Open(_)) {
            return Err(MarkerError::Open { emission });
        }
        let (begins, start) = (it.schedule.start, parameters.start);
        if begins < start {
            return Err(MarkerError::BeginsBefore { emission, begins, start });
        }
        let volume = signed_volume(it.shape.mesh());
        let particles = volume / parameters.particle_volume;
        let fits = volume > 0.0 && volume.is_finite() && (0.0..MOST).contains(&particles);
        if fits { Ok(particles) } else { Err(MarkerError::Volume { emission, volume, particles }) }
    };
    emissions.iter().enumerate().map(share).collect()
}
