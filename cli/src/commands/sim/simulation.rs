//! Smoke as a solver over time: [`Smoke`].

use super::rendering::Studio;
use super::scene::SimScene;
use super::summary::summary;
use crate::codes::Code;
use crate::commands::track::tracker_failure;
use crate::failure::Failure;
use crate::progress::Progress;
use crate::runs::state::{NoState, Reader, Writer};
use crate::runs::{Frame, PictureProblem, Pictures, Simulation, StepFailure, StepProblem, phase_seconds};
use serde_json::{Map, Value, json};
use welter_fluids::smoke::{
    EmittedShape, Refusal, Released, SmokeError, SmokeSimulation, SmokeState, SmokeStep,
};
use welter_meshing::Monitor;
use welter_meshing::surface::measure::{area, signed_volume};
use welter_meshing::surface::{Topology, TriMesh, TriangleSoup};
use welter_tracking::surface::{UnionOutcome, UnionReport};

/// A run of smoke, and the scene that moves it.
#[derive(Debug)]
pub(super) struct Smoke<'s> {
    scene: &'s SimScene,
    /// For the pictures.
    title: String,
    simulation: SmokeSimulation,
    /// The volume of a release of each emission; none of a sheet.
    volumes: Vec<Option<f64>>,
    /// Steps of the scene that are done.
    step: u64,
    /// None if no pictures of the volume are to be made.
    studio: Option<Studio>,
}

impl<'s> Smoke<'s> {
    /// At the beginning.
    pub(super) fn new(scene: &'s SimScene, title: String, progress: &Progress) -> Result<Self, Box<Failure>> {
        let emissions = scene.emissions(progress)?;
        let volumes = emissions.iter().map(|emission| volume_of(&emission.shape)).collect();
        let studio = scene.studio(&emissions)?;
        let simulation = SmokeSimulation::new(emissions, scene.parameters, &Monitor::none())
            .map_err(|error| refused(&error))?;
        Ok(Self { scene, title, simulation, volumes, step: 0, studio })
    }

    /// At a state that was saved.
    pub(super) fn resumed(
        scene: &'s SimScene,
        title: String,
        state: &[u8],
        progress: &Progress,
    ) -> Result<Self, Box<Failure>> {
        let broken = |error: String| {
            Failure::new(Code::OwnBug, format!("a whole checkpoint cannot be gone on from: {error}"))
        };
        let (step, state) = read_state(state).map_err(|error| broken(error.to_string()))?;
        let emissions = scene.emissions(progress)?;
        let volumes = emissions.iter().map(|emission| volume_of(&emission.shape)).collect();
        let studio = scene.studio(&emissions)?;
        let simulation = SmokeSimulation::resume(emissions, scene.parameters, state, &Monitor::none())
            .map_err(|error| broken(error.to_string()))?;
        Ok(Self { scene, title, simulation, volumes, step, studio })
    }

    /// Numbers of the surface as it is, and what was released.
    fn facts(&self, releases: &[Released]) -> Map<String, Value> {
        let mesh = self.simulation.mesh();
        let topology = Topology::of(&mesh);
        let released = releases
            .iter()
            .filter(|release| release.refusal.is_none())
            .filter_map(|release| match &release.union {
                Some(union) => Some(union.added_volume),
                None => self.volumes[release.emission],
            })
            .sum::<f64>();
        let facts = json!({
            "vertices": mesh.positions().len(),
            "triangles": mesh.triangles().len(),
            "components": topology.components().len(),
            "volume": closed_volume(&mesh, &topology),
            "area": area(&mesh),
            "reference_length": self.simulation.reference_length(),
            "releases": releases.iter().map(told).collect::<Vec<_>>(),
            // A sum of nothing is -0.
            "released_volume": released + 0.0,
        });
        let Value::Object(facts) = facts else { unreachable!("an object was written") };
        facts
    }
}

fn volume_of(shape: &EmittedShape) -> Option<f64> {
    match shape {
        EmittedShape::Closed(mesh) => Some(signed_volume(mesh.as_mesh())),
        EmittedShape::Open(_) => None,
    }
}

/// The volume within all components that are closed.
fn closed_volume(mesh: &TriMesh, topology: &Topology) -> f64 {
    if topology.is_closed() {
        return signed_volume(mesh);
    }
    let closed = (0..topology.components().len()).filter(|&c| topology.components()[c].closed);
    let triangles = closed
        .flat_map(|c| topology.component_triangles(c))
        .map(|t| mesh.triangles()[t.index()].map(|v| v.0))
        .collect();
    let soup = TriangleSoup { positions: mesh.positions().to_vec(), triangles, ..TriangleSoup::default() };
    signed_volume(&TriMesh::new(soup).expect("triangles of a mesh"))
}

/// A release, and why it did not come about.
fn told(release: &Released) -> Value {
    let refused = match release.refusal {
        None => Value::Null,
        Some(Refusal::Intersection { pairs }) => json!({ "reason": "intersection", "pairs": pairs }),
        Some(Refusal::Sheet) => json!({ "reason": "sheet" }),
        Some(Refusal::InsideOut) => json!({ "reason": "inside out" }),
        Some(Refusal::Degenerate { shifts, obstacle }) => {
            json!({ "reason": "degenerate", "shifts": shifts, "obstacle": obstacle.to_string() })
        }
        Some(Refusal::Budget { present }) => json!({ "reason": "budget", "present": present }),
        Some(_) => json!({ "reason": "other" }),
    };
    json!({
        "emission": release.emission,
        "index": release.release.index,
        "time": release.release.time,
        "triangles": release.triangles,
        "refused": refused,
        "union": release.union.as_ref().map(united),
    })
}

/// What became of a release that was united with the smoke that was there.
fn united(union: &UnionReport) -> Value {
    let outcome = match union.outcome {
        UnionOutcome::Beside => "beside",
        UnionOutcome::Within => "within",
        UnionOutcome::Joined => "joined",
        _ => "other",
    };
    json!({
        "outcome": outcome,
        "shifts": union.shifts,
        "segments": union.segments,
        "added_volume": union.added_volume,
    })
}

/// What a step did.
fn done(step: &SmokeStep) -> Map<String, Value> {
    let (a, c, s) = (&step.improvement, &step.integration, &step.seconds);
    let done = json!({
        "substeps": step.substeps,
        "operations": {
            "splits": a.splits,
            "flips": a.flips,
            "collapses": a.collapses,
            "smoothed": a.smoothed,
            "merges": a.merges,
            "separations": a.separations,
            "refused": a.refused.total(),
            "refused_for_the_budget": a.refused.budget,
        },
        "collisions": {
            "impulses": c.impulses,
            "impact_zones": c.impact_zones,
            "rigid_zones": c.rigid_zones,
            "dt_halvings": c.shortenings,
        },
        "seconds": phase_seconds(s),
    });
    let Value::Object(done) = done else { unreachable!("an object was written") };
    done
}

/// A run that cannot begin.
fn refused(error: &SmokeError) -> Box<Failure> {
    let code = match error {
        SmokeError::ShapeIntersectsItself { .. } => Code::SelfIntersecting,
        SmokeError::Shape { .. } => Code::NotManifold,
        _ => Code::BadValue,
    };
    Failure::new(code, error.to_string()).subject("the smoke of the scene").help("welter sim --help")
}

/// A step that is not made.
fn failed(error: &SmokeError) -> StepFailure {
    match error {
        SmokeError::Tracker { error, .. } => tracker_failure(error),
        _ => {
            let failure = Failure::new(Code::StepFailed, error.to_string());
            StepFailure { failure, stage: "step", details: Value::Null }
        }
    }
}

impl Simulation for Smoke<'_> {
    fn step(&mut self, monitor: &Monitor<'_>) -> Result<Map<String, Value>, StepProblem> {
        let end = self.scene.time.end_of(self.step + 1);
        let step = self.simulation.step_to(&self.scene.flow, end, monitor).map_err(|error| match error {
            SmokeError::Cancelled(_) => StepProblem::Cancelled,
            error => StepProblem::Failed(Box::new(failed(&error))),
        })?;
        self.step += 1;
        let mut line = self.facts(&step.releases);
        line.append(&mut done(&step));
        Ok(line)
    }

    fn initial(&self) -> Map<String, Value> {
        self.facts(self.simulation.at_start())
    }

    fn time(&self) -> f64 {
        self.simulation.time()
    }

    fn frame(&self) -> Frame {
        let arrays = vec![("age", self.simulation.ages().to_vec())];
        Frame::of(self.simulation.mesh(), arrays, &self.title, self.time())
    }

    fn pictures(&self, number: u64, monitor: &Monitor<'_>) -> Result<Pictures, PictureProblem> {
        match &self.studio {
            Some(studio) if studio.draws(number) => {
                studio.draw(&self.simulation.mesh(), self.simulation.ages(), self.time(), monitor)
            }
            _ => Ok(Pictures::default()),
        }
    }

    fn save(&self, state: &mut Writer) {
        let smoke = self.simulation.state();
        state.whole(self.step);
        state.number(smoke.time);
        state.number(smoke.reference_length);
        state.numbers(&smoke.ages);
        state.mesh(&smoke.mesh);
    }

    fn mesh_of(&self, state: &[u8]) -> Option<TriMesh> {
        read_state(state).ok().map(|(_, state)| state.mesh)
    }

    fn conclude(&self, lines: &[&Value], _complete: bool) -> Map<String, Value> {
        summary(lines)
    }
}

/// A state as [`Smoke::save`](Simulation::save) writes it, and the number of its step.
fn read_state(state: &[u8]) -> Result<(u64, SmokeState), NoState> {
    let mut reader = Reader(state);
    let step = reader.whole()?;
    let (time, reference_length) = (reader.number()?, reader.number()?);
    let ages = reader.numbers()?;
    let mesh = reader.mesh()?;
    reader.end()?;
    Ok((step, SmokeState { mesh, ages, time, reference_length }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::ProgressMode;
    use crate::scene::Scene;

    const SCENE: &str = "[[emissions]]\nshape = \"sphere\"\nscale = 0.3\nedge_length = 0.15\ninterval = 0.15\n\
        [[flows]]\nkind = \"ring\"\nradius = 0.5\n[time]\nstep = 0.1\nsteps = 4\n";

    #[test]
    fn a_state_is_read_back_and_nothing_else_is() {
        let (scene, _) = SimScene::read(&Scene::of("a.toml", SCENE), 0).unwrap();
        let progress = Progress::new(ProgressMode::None, true);
        let mut smoke = Smoke::new(&scene, String::new(), &progress).unwrap();
        let mut last = Vec::new();
        for _ in 0..4 {
            let mut state = Writer::default();
            smoke.save(&mut state);
            let mut again = Smoke::resumed(&scene, String::new(), &state.0, &progress).unwrap();
            let mut saved = Writer::default();
            again.save(&mut saved);
            assert!(saved.0 == state.0);
            let [Ok(mut one), Ok(mut other)] = [&mut smoke, &mut again].map(|s| s.step(&Monitor::none()))
            else {
                panic!("a step fails");
            };
            for line in [&mut one, &mut other] {
                let _ = line.remove("seconds");
            }
            assert_eq!(one, other);
            last = state.0;
        }
        // Bytes that a checksum would let pass, had they been written so: refused, or a surface.
        for at in (0..last.len()).step_by(61) {
            let mut changed = last.clone();
            changed[at] ^= 0x81;
            let _ = Smoke::resumed(&scene, String::new(), &changed, &progress);
            assert!(Smoke::resumed(&scene, String::new(), &last[..at], &progress).is_err(), "cut at {at}");
        }
    }
}
