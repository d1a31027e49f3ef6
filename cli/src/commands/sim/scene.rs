//! A scene of `welter sim`, from the file.

use super::bounds::Bounds;
use super::flows::{Part, SceneFlow, read_path};
use super::rendering::{RenderSpec, Studio};
use super::solids::Solid;
use crate::codes::Code;
use crate::commands::track::{
    SurfaceSpec, TimeSpec, read_improvement, read_integration, read_output, read_time, read_topology,
};
use crate::failure::Failure;
use crate::progress::Progress;
use crate::runs::OutputPlan;
use crate::runs::resolved::Resolved;
use crate::runs::settings::{ANY, FINITE, Settings, read_scene};
use crate::scene::Scene;
use std::path::Path;
use welter_fluids::smoke::{
    Emission, EmissionError, EmittedShape, Joining, OverBudget, Schedule, SmokeError, SmokeParameters,
};
use welter_meshing::surface::{ClosedOrientedMesh, Topology};
use welter_tracking::flows::Scheme;

/// Everything that a scene says.
#[derive(Clone, Debug)]
pub(super) struct SimScene {
    emissions: Vec<EmissionSpec>,
    pub(super) flow: SceneFlow,
    pub(super) time: TimeSpec,
    pub(super) parameters: SmokeParameters,
    pub(super) output: OutputPlan,
    /// Boxes around flows.
    bounds: Vec<Bounds>,
    solids: Vec<Solid>,
    render: Option<RenderSpec>,
}

/// An emission whose shape is not built.
#[derive(Clone, Debug)]
struct EmissionSpec {
    surface: SurfaceSpec,
    schedule: Schedule,
    /// `"separate"`: a component of its own; `"merged"`: united with smoke that is there, which needs `[topology]` and `[integration]`.
    joining: Joining,
    path: Option<welter_fluids::procedural::Path>,
}

impl SimScene {
    /// The scene of a file; `seed` is for what it gives no seed.
    pub(super) fn read(scene: &Scene, seed: u64) -> Result<(Self, Resolved), Box<Failure>> {
        let folder = scene.name.parent().unwrap_or(Path::new(""));
        read_scene(scene, |whole| {
            let Some(emissions) = whole.tables("emissions", |table| EmissionSpec::read(table, folder))?
            else {
                return Err(whole
                    .bad("emissions", "nothing is released: there is no [[emissions]]")
                    .help("add [[emissions]], and below it: shape = \"sphere\""));
            };
            let flows = whole.tables("flows", |table| Part::read(table, seed))?.unwrap_or_default();
            let solids = whole.tables("solids", Solid::read)?.unwrap_or_default();
            let (flows, bounds): (Vec<Part>, Vec<Option<Bounds>>) = flows.into_iter().unzip();
            let flow =
                SceneFlow::new(flows, &solids).map_err(|error| whole.bad("solids", error.to_string()))?;
            let time = whole.table("time", read_time)?;
            let smoke = whole.table("smoke", read_smoke)?;
            let (remeshing, reference_length) = whole.table("improvement", |table| {
                let enabled = table.flag("enabled", true)?;
                let default = SmokeParameters::default().remeshing.unwrap_or_default();
                let (parameters, length) = read_improvement(table, &default)?;
                Ok((enabled.then_some(parameters), length))
            })?;
            let topology = whole.table("topology", |table| read_topology(table, false))?;
            let collisions = whole.table("integration", |table| {
                let enabled = table.flag("enabled", false)?;
                Ok(enabled.then_some(read_integration(table)?))
            })?;
            // There is no independent check of a surface that may pass through itself.
            let (output, _) = whole.table("output", read_output)?;
            let given = whole.has("render");
            let render = whole.table("render", |table| RenderSpec::read(table, given, time.end))?;
            let output = OutputPlan { volume: render.is_some(), ..output };
            let parameters = SmokeParameters {
                reference_length,
                remeshing,
                collisions,
                topology: topology.enabled.then_some(topology),
                most_substeps: time.most_substeps,
                ..smoke
            };
            parameters.validate().map_err(|error| whole.bad(key_of(&error), error.to_string()))?;
            let bounds = bounds.into_iter().flatten().collect();
            Ok(Self { emissions, flow, time, parameters, output, bounds, solids, render })
        })
    }

    /// Refuses shapes that would take more memory than there is.
    pub(super) fn require_memory(&self, scene: &Path) -> Result<(), Box<Failure>> {
        self.emissions.iter().try_for_each(|emission| emission.surface.require_memory(scene))?;
        self.render.iter().try_for_each(|render| render.require_memory(scene))
    }

    /// What makes the pictures of smoke from these emissions; none if there are to be none.
    pub(super) fn studio(&self, emissions: &[Emission]) -> Result<Option<Studio>, Box<Failure>> {
        self.render
            .iter()
            .map(|render| Studio::new(render, emissions, &self.bounds, &self.solids))
            .next()
            .transpose()
    }

    /// The emissions, with their shapes.
    pub(super) fn emissions(&self, progress: &Progress) -> Result<Vec<Emission>, Box<Failure>> {
        self.emissions.iter().enumerate().map(|(k, emission)| emission.build(k, progress)).collect()
    }
}

/// The table that an error of the parameters is about.
fn key_of(error: &SmokeError) -> &'static str {
    match error {
        SmokeError::TopologyWithoutCollisions => "topology",
        SmokeError::Remeshing(_) => "improvement",
        SmokeError::Collisions(_) => "integration",
        _ => "smoke",
    }
}

fn read_smoke(table: &mut Settings<'_>) -> Result<SmokeParameters, Box<Failure>> {
    let default = SmokeParameters::default();
    let scheme = table.choice("scheme", &[("rk4", Scheme::Rk4), ("euler", Scheme::Euler)])?;
    let most = table.whole("most_triangles", default.most_triangles as u64, 1)?;
    let factor = table.number("coarsening", 1.25, ANY)?;
    let over_budget = table.choice(
        "over_budget",
        &[("coarsen", OverBudget::Coarsen { factor }), ("stop-splitting", OverBudget::StopSplitting)],
    )?;
    let most_triangles = usize::try_from(most).unwrap_or(usize::MAX);
    let parameters = SmokeParameters { scheme, most_triangles, over_budget, ..default };
    parameters.validate().map_err(|error| table.bad("coarsening", error.to_string()))?;
    Ok(parameters)
}

impl EmissionSpec {
    fn read(table: &mut Settings<'_>, folder: &Path) -> Result<Self, Box<Failure>> {
        let surface = SurfaceSpec::read(table, Some(folder))?;
        let default = Schedule::default();
        let start = table.number("start", default.start, FINITE)?;
        let interval = table.optional_number("interval", ANY)?;
        let count = table.optional_whole("count", 1)?.map(|count| u32::try_from(count).unwrap_or(u32::MAX));
        let schedule = match interval {
            Some(interval) => Schedule { start, interval, count },
            None if count.is_some_and(|count| count > 1) => {
                return Err(table.bad("count", "several releases need an interval").help("interval = 0.1"));
            }
            None => Schedule { start, ..default },
        };
        schedule.validate().map_err(|error| {
            let key = match error {
                EmissionError::Parameter { name, .. } => name,
                _ => "start",
            };
            table.bad(key, error.to_string())
        })?;
        let joining =
            table.choice("joining", &[("separate", Joining::Separate), ("merged", Joining::Merged)])?;
        if start < 0.0 {
            return Err(table.bad("start", "a scene begins at time 0"));
        }
        Ok(Self { surface, schedule, joining, path: read_path(table)? })
    }

    fn build(&self, number: usize, progress: &Progress) -> Result<Emission, Box<Failure>> {
        let mesh = self.surface.build(progress)?;
        let refused = |what: String| {
            Failure::new(Code::BadValue, what)
                .subject(format!("emissions[{number}]"))
                .help("welter check FILE   # tells what is wrong with a surface")
        };
        let shape = if Topology::of(&mesh).is_closed() {
            EmittedShape::Closed(ClosedOrientedMesh::new(mesh).map_err(|error| refused(error.to_string()))?)
        } else {
            EmittedShape::Open(mesh)
        };
        let &Self { schedule, joining, .. } = self;
        let emission = Emission { shape, schedule, joining, path: self.path.clone() };
        emission.validate().map_err(|error| refused(error.to_string()))?;
        Ok(emission)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_default_is_told_and_reads_back() {
        let text = "[[emissions]]\nshape = \"sphere\"\ninterval = 0.5\npath = [[0, 0, 0, 0], [1, 2, 0, 0]]\n\
            [[flows]]\nkind = \"ring\"\n[[flows]]\nkind = \"source\"\namplitude_keys = [[0, 1], [1, 0]]\n[flows.noise]\n\
            [[flows]]\nkind = \"curl-noise\"\n[flows.pulse]\n[[flows]]\nkind = \"filament\"\ncore = 0.1\n\
            vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n[[flows]]\nkind = \"wind\"\nvelocity = [0, 0, 1]\n\
            [[solids]]\nkind = \"ball\"\nradius = 0.5\nramp_width = 0.2\n[[solids]]\nkind = \"capsule\"\nradius = 0.5\n\
            ends = [[0, 0, 0], [0, 0, 1]]\nramp_width = 0.2\n[time]\nstep = 0.1\nsteps = 3\n";
        let (_, resolved) = SimScene::read(&Scene::of("a.toml", text), 5).unwrap();
        let told = resolved.to_toml();
        let (_, twice) = SimScene::read(&Scene::of("b.toml", told.clone()), 0).unwrap();
        assert_eq!(resolved, twice);
        for line in
            ["seed = 5", "over_budget = \"coarsen\"", "enabled = false", "extent = \"confined\"", "top = 0.5"]
        {
            assert!(told.contains(line), "{line} in {told}");
        }
    }
}
