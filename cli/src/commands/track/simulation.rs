//! A tracked surface as a solver over time: [`Track`].

use super::scene::TrackScene;
use super::step_failure;
use super::summary::summary;
use crate::codes::Code;
use crate::failure::Failure;
use crate::runs::state::{NoState, Reader, Writer};
use crate::runs::{Frame, Simulation, StepProblem, phase_seconds};
use serde_json::{Map, Value, json};
use welter_meshing::Monitor;
use welter_meshing::spatial::{Bvh, Sharing};
use welter_meshing::surface::measure::{area, signed_volume};
use welter_meshing::surface::{Topology, TriMesh};
use welter_tracking::improvement::ImprovementReport;
use welter_tracking::integration::{IntegrationError, IntegrationReport};
use welter_tracking::surface::MovingSurface;
use welter_tracking::tracker::{PhaseSeconds, SurfaceTracker, TrackerError};

/// A tracker, and the scene that moves it.
#[derive(Debug)]
pub(super) struct Track<'s> {
    scene: &'s TrackScene,
    /// For the pictures.
    title: String,
    tracker: SurfaceTracker,
    /// Steps of the scene that are done; the tracker may have made several of each.
    step: u64,
}

impl<'s> Track<'s> {
    /// At the initial surface.
    pub(super) fn new(scene: &'s TrackScene, title: String, mesh: &TriMesh) -> Result<Self, Box<Failure>> {
        let refused = |failure: Box<Failure>| failure.subject("the surface of the scene");
        let surface = MovingSurface::new(mesh).map_err(|defects| {
            let failure = Failure::new(Code::NotManifold, defects.to_string());
            refused(failure.help("welter check FILE --pairs   # tells every place"))
        })?;
        let tracker = SurfaceTracker::new(surface, scene.tracker)
            .map_err(|error| refused(step_failure::refused_at_the_start(&error)))?;
        Ok(Self { scene, title, tracker, step: 0 })
    }

    /// At a state that was saved.
    pub(super) fn resumed(scene: &'s TrackScene, title: String, state: &[u8]) -> Result<Self, NoState> {
        let saved = Saved::read(state)?;
        let surface = MovingSurface::new(&saved.mesh).map_err(|error| NoState(error.to_string()))?;
        let Saved { step, steps, time, length, .. } = saved;
        let tracker = SurfaceTracker::resume(surface, scene.tracker, length, time, steps)
            .map_err(|error| NoState(error.to_string()))?;
        Ok(Self { scene, title, tracker, step })
    }

    /// Numbers of the surface as it is.
    fn facts(&self, mesh: &TriMesh) -> Map<String, Value> {
        let topology = Topology::of(mesh);
        let whole = topology.is_closed() && topology.is_oriented();
        let facts = json!({
            "vertices": mesh.positions().len(),
            "triangles": mesh.triangles().len(),
            "components": topology.components().len(),
            "genus": topology.genus(),
            "euler_characteristic": topology.euler_characteristic(),
            "volume": whole.then(|| signed_volume(mesh)),
            "area": area(mesh),
        });
        let Value::Object(facts) = facts else { unreachable!("an object was written") };
        facts
    }

    /// Adds how many pairs of triangles meet in more than they share, by a check that knows nothing of the tracker: none, or the step failed.
    fn check(
        &self,
        mesh: &TriMesh,
        monitor: &Monitor<'_>,
        line: &mut Map<String, Value>,
    ) -> Result<(), StepProblem> {
        let every = self.scene.check_every;
        if every > 0 && (self.step.is_multiple_of(every) || self.step == self.scene.time.steps) {
            let pairs = Bvh::new(mesh).self_intersections(Sharing::Index, monitor);
            let pairs = pairs.map_err(|_| StepProblem::Cancelled)?;
            if let Some(first) = pairs.first() {
                return Err(StepProblem::Failed(Box::new(step_failure::intersecting(mesh, &pairs, *first))));
            }
            line.insert("intersections".into(), json!(pairs.len()));
        }
        Ok(())
    }
}

/// What one step of the scene did, in all steps of the tracker that it took.
#[derive(Debug, Default)]
struct Done {
    substeps: u32,
    least_dt: f64,
    improvement: ImprovementReport,
    integration: IntegrationReport,
    seconds: PhaseSeconds,
}

impl Done {
    fn to_json(&self) -> Map<String, Value> {
        let (a, c, s) = (&self.improvement, &self.integration, &self.seconds);
        let done = json!({
            "substeps": self.substeps,
            "least_dt": self.least_dt,
            "operations": {
                "splits": a.splits,
                "flips": a.flips,
                "collapses": a.collapses,
                "smoothed": a.smoothed,
                "merges": a.merges,
                "separations": a.separations,
                "cancelled": a.cancelled,
                "refused": a.refused.total(),
            },
            "collisions": {
                "proximities": c.proximities,
                "repulsions": c.repulsions,
                "impulses": c.impulses,
                "impact_zones": c.impact_zones,
                "rigid_zones": c.rigid_zones,
                "resting_zones": c.resting_zones,
                "resting_vertices": c.resting_vertices,
                "dt_halvings": c.shortenings,
            },
            "seconds": phase_seconds(s),
        });
        let Value::Object(done) = done else { unreachable!("an object was written") };
        done
    }
}

impl Simulation for Track<'_> {
    fn step(&mut self, monitor: &Monitor<'_>) -> Result<Map<String, Value>, StepProblem> {
        let time = &self.scene.time;
        let end = time.end_of(self.step + 1);
        let mut done = Done { least_dt: f64::INFINITY, ..Done::default() };
        loop {
            let dt = end - self.tracker.time();
            if dt <= 0.0 {
                break;
            }
            if done.substeps == time.most_substeps {
                return Err(StepProblem::Failed(Box::new(step_failure::stuck(time, dt, done.least_dt))));
            }
            let report = self.tracker.step(&self.scene.flow, dt, monitor).map_err(|error| match error {
                TrackerError::Cancelled(_) | TrackerError::Integration(IntegrationError::Cancelled(_)) => {
                    StepProblem::Cancelled
                }
                error => StepProblem::Failed(Box::new(step_failure::tracker_failure(&error))),
            })?;
            done.substeps += 1;
            done.least_dt = done.least_dt.min(report.dt);
            done.improvement.add(&report.improvement);
            done.integration.add(&report.integration);
            done.seconds.add(&report.seconds);
            if report.dt == dt {
                break;
            }
        }
        self.step += 1;
        let mesh = self.tracker.surface().to_mesh();
        let mut line = self.facts(&mesh);
        line.append(&mut done.to_json());
        self.check(&mesh, monitor, &mut line)?;
        Ok(line)
    }

    fn initial(&self) -> Map<String, Value> {
        self.facts(&self.tracker.surface().to_mesh())
    }

    fn time(&self) -> f64 {
        if self.step == 0 { 0.0 } else { self.scene.time.end_of(self.step) }
    }

    fn frame(&self) -> Frame {
        Frame::of(self.tracker.surface().to_mesh(), Vec::new(), &self.title, self.time())
    }

    fn save(&self, state: &mut Writer) {
        state.whole(self.step);
        state.whole(self.tracker.steps());
        state.number(self.tracker.time());
        state.number(self.tracker.reference_length());
        state.mesh(&self.tracker.surface().to_mesh());
    }

    fn mesh_of(&self, state: &[u8]) -> Option<TriMesh> {
        Saved::read(state).ok().map(|saved| saved.mesh)
    }

    fn conclude(&self, lines: &[&Value], complete: bool) -> Map<String, Value> {
        let surface = complete.then(|| self.tracker.surface().to_mesh());
        summary(self.scene, lines, surface.as_ref())
    }
}

/// A state as [`Track::save`](Simulation::save) writes it.
struct Saved {
    step: u64,
    steps: u64,
    time: f64,
    length: f64,
    mesh: TriMesh,
}

impl Saved {
    fn read(state: &[u8]) -> Result<Self, NoState> {
        let mut reader = Reader(state);
        let (step, steps) = (reader.whole()?, reader.whole()?);
        let (time, length) = (reader.number()?, reader.number()?);
        let mesh = reader.mesh()?;
        reader.end()?;
        Ok(Self { step, steps, time, length, mesh })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::{Progress, ProgressMode};
    use crate::scene::Scene;
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

    /// A step with collisions.
    fn scene() -> TrackScene {
        let text = "[surface]\nshape = \"sphere\"\nedge_length = 0.6\n[flow]\nkind = \"jitter\"\namplitude_rel = 1\n\
            [time]\nstep = 1\nsteps = 3\n";
        TrackScene::read(&Scene::of("a.toml", text), 0).unwrap().0
    }

    #[test]
    fn a_step_that_is_stopped_anywhere_says_so() {
        let scene = scene();
        let mesh = scene.surface.build(&Progress::new(ProgressMode::None, true)).unwrap();
        let start = Track::new(&scene, String::new(), &mesh).unwrap();
        let mut state = Writer::default();
        start.save(&mut state);
        let (mut stopped, mut next) = (0, 0);
        loop {
            let at = next;
            next += 1 + at / 8;
            let (stop, reports) = (AtomicBool::new(at == 0), AtomicUsize::new(0));
            let report = |_| {
                if reports.fetch_add(1, Ordering::Relaxed) + 1 == at {
                    stop.store(true, Ordering::Relaxed);
                }
            };
            let mut track = Track::resumed(&scene, String::new(), &state.0).unwrap();
            match track.step(&Monitor::new(Some(&report), Some(&stop))) {
                Err(StepProblem::Cancelled) => stopped += 1,
                Err(StepProblem::Failed(failed)) => panic!("{:?}", failed.failure),
                Ok(_) if reports.load(Ordering::Relaxed) < at => break,
                // The last report of a step may come after the last question.
                Ok(_) => {}
            }
        }
        assert!(stopped > 10, "{stopped}");
    }

    #[test]
    fn a_state_is_read_back_and_nothing_else_is() {
        let scene = scene();
        let mesh = scene.surface.build(&Progress::new(ProgressMode::None, true)).unwrap();
        let mut track = Track::new(&scene, String::new(), &mesh).unwrap();
        let mut lines = Vec::new();
        let mut states = Vec::new();
        for _ in 0..3 {
            let mut state = Writer::default();
            track.save(&mut state);
            states.push(state.0);
            let Ok(mut line) = track.step(&Monitor::none()) else { panic!("a step fails") };
            line.remove("seconds");
            lines.push(line);
        }
        for (state, line) in states.iter().zip(&lines) {
            let mut again = Track::resumed(&scene, String::new(), state).unwrap();
            let mut saved = Writer::default();
            again.save(&mut saved);
            assert!(saved.0 == *state);
            let Ok(mut told) = again.step(&Monitor::none()) else { panic!("a step fails") };
            told.remove("seconds");
            assert_eq!(told, *line);
        }
        // The independent check refuses what intersects itself.
        let crossing = crate::commands::shape::build("two-boxes", Some(1.0)).unwrap();
        let Err(StepProblem::Failed(failed)) =
            track.check(crossing.as_mesh(), &Monitor::none(), &mut Map::new())
        else {
            panic!("two boxes that cross pass the check");
        };
        assert_eq!((failed.failure.code, failed.stage), (Code::OwnBug, "verification"));
        assert!(failed.details["pair_count"].as_u64().is_some_and(|count| count > 0));
        // Bytes that a checksum would let pass, had they been written so: refused, or a surface.
        let state = &states[0];
        for at in (0..state.len()).step_by(7) {
            let mut changed = state.clone();
            changed[at] ^= 0x81;
            let _ = Track::resumed(&scene, String::new(), &changed);
            assert!(Track::resumed(&scene, String::new(), &state[..at]).is_err(), "cut at {at}");
        }
    }
}
