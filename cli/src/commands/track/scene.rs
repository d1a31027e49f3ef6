//! A scene of `welter track`, from the file.

use super::flow::SceneFlow;
use super::surface::SurfaceSpec;
use crate::failure::Failure;
use crate::render::{Camera, MAX_SIDE};
use crate::runs::OutputPlan;
use crate::runs::resolved::Resolved;
use crate::runs::settings::{ANY, FINITE, POSITIVE, Settings, read_scene};
use crate::scene::Scene;
use std::path::Path;
use welter_tracking::improvement::{
    CurvatureAdaption, ImprovementParameters, ParameterError, SplitScheme, TopologyParameters,
};
use welter_tracking::integration::{IntegrationError, IntegrationParameters};
use welter_tracking::tracker::TrackerParameters;

/// Most steps of a scene: what can be told from one another in a file name.
const MOST_STEPS: f64 = 1e8;

/// Everything that a scene says.
#[derive(Clone, Debug)]
pub(super) struct TrackScene {
    pub(super) surface: SurfaceSpec,
    pub(super) flow: SceneFlow,
    pub(super) time: TimeSpec,
    pub(super) tracker: TrackerParameters,
    pub(super) output: OutputPlan,
    /// Steps from one independent check of the whole surface to the next; 0 for none.
    pub(super) check_every: u64,
    pub(super) exact: Exact,
}

/// When the steps of a scene end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TimeSpec {
    pub(crate) step: f64,
    pub(crate) steps: u64,
    /// The end of the last step.
    pub(crate) end: f64,
    /// Most parts that a step is made of where the flow or collisions make it shorter.
    pub(crate) most_substeps: u32,
}

/// What is known of the surface at the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Exact {
    None,
    /// It is where it was in the beginning.
    Initial,
    /// Balls that grew or shrank, or the union of two that grew, and shrank after that.
    Offset,
}

impl TimeSpec {
    /// When a step ends, counted from 1 on.
    pub(crate) fn end_of(&self, step: u64) -> f64 {
        if step == self.steps { self.end } else { step as f64 * self.step }
    }
}

impl TrackScene {
    /// The scene of a file; `seed` is for what it gives no seed.
    pub(super) fn read(scene: &Scene, seed: u64) -> Result<(Self, Resolved), Box<Failure>> {
        let folder = scene.name.parent().unwrap_or(Path::new(""));
        Self::read_with_files(scene, seed, Some(folder))
    }

    /// The scene of a state that is at hand: the files of its initial surface need not be there any more.
    pub(super) fn read_resolved(scene: &Scene) -> Result<Self, Box<Failure>> {
        Self::read_with_files(scene, 0, None).map(|(scene, _)| scene)
    }

    fn read_with_files(
        scene: &Scene,
        seed: u64,
        folder: Option<&Path>,
    ) -> Result<(Self, Resolved), Box<Failure>> {
        read_scene(scene, |whole| {
            let surface = whole.table("surface", |surface| SurfaceSpec::read(surface, folder))?;
            let flow = whole.table("flow", |flow| SceneFlow::read(flow, seed))?;
            let time = whole.table("time", read_time)?;
            let improvement = whole
                .table("improvement", |table| read_improvement(table, &ImprovementParameters::default()))?;
            let topology = whole.table("topology", |table| read_topology(table, true))?;
            let integration = whole.table("integration", read_integration)?;
            let tracker = TrackerParameters {
                reference_length: improvement.1,
                improvement: improvement.0,
                topology,
                integration,
            };
            let (output, check_every) = whole.table("output", read_output)?;
            let exact = whole.choice(
                "exact",
                &[("none", Exact::None), ("initial", Exact::Initial), ("offset", Exact::Offset)],
            )?;
            if exact == Exact::Offset && (flow.entropy_schedule().is_none() || surface.balls().is_none()) {
                let what = "only of spheres that move along their normals, with front = \"entropy\", an offset is known";
                return Err(whole.bad("exact", what));
            }
            Ok(Self { surface, flow, time, tracker, output, check_every, exact })
        })
    }
}

pub(crate) fn read_time(time: &mut Settings<'_>) -> Result<TimeSpec, Box<Failure>> {
    let step = time.number("step", None, POSITIVE)?;
    let (steps, end) = (time.optional_whole("steps", 1)?, time.optional_number("end", POSITIVE)?);
    let spec = match (steps, end) {
        (Some(_), Some(_)) => return Err(time.bad("end", "either steps or end, not both")),
        (None, None) => {
            return Err(time
                .bad("steps", "neither steps nor end is given")
                .help("steps = 100   # in the table [time]"));
        }
        (Some(steps), None) => TimeSpec { step, steps, end: steps as f64 * step, most_substeps: 0 },
        (None, Some(end)) => {
            let parts = end / step;
            // A last step of rounding size is none: 3 / 0.01 is 300 up to rounding.
            let whole = parts.round();
            let steps =
                if (parts - whole).abs() <= 4.0 * f64::EPSILON * parts { whole } else { parts.ceil() };
            TimeSpec { step, steps: steps.min(2.0 * MOST_STEPS) as u64, end, most_substeps: 0 }
        }
    };
    if spec.steps as f64 > MOST_STEPS || !spec.end.is_finite() {
        return Err(time.bad("step", format!("{} steps, at most {MOST_STEPS} are made", spec.steps)));
    }
    Ok(TimeSpec { most_substeps: time.small("most_substeps", 1000, 1)?, ..spec })
}

/// `default` is for what a scene does not say.
pub(crate) fn read_improvement(
    table: &mut Settings<'_>,
    default: &ImprovementParameters,
) -> Result<(ImprovementParameters, Option<f64>), Box<Failure>> {
    let reference_length = table.optional_number("reference_length", POSITIVE)?;
    let mut schemes = [
        ("butterfly", SplitScheme::Butterfly),
        ("fitted", SplitScheme::Fitted),
        ("midpoint", SplitScheme::Midpoint),
        ("modified-butterfly", SplitScheme::ModifiedButterfly),
        ("quadric", SplitScheme::Quadric),
    ];
    // The first choice holds where none is made.
    schemes.sort_by_key(|&(_, scheme)| scheme != default.split_scheme);
    let most = table.whole("most_triangles", default.most_triangles as u64, 0)?;
    let parameters = ImprovementParameters {
        max_edge_rel: table.number("max_edge_rel", default.max_edge_rel, ANY)?,
        min_edge_rel: table.number("min_edge_rel", default.min_edge_rel, ANY)?,
        max_volume_change_rel: table.number("max_volume_change_rel", default.max_volume_change_rel, ANY)?,
        keeps_volume: table.flag("keeps_volume", default.keeps_volume)?,
        max_split_volume_change_rel: table.number(
            "max_split_volume_change_rel",
            default.max_split_volume_change_rel,
            ANY,
        )?,
        min_flip_gain_rel: table.number("min_flip_gain_rel", default.min_flip_gain_rel, ANY)?,
        flip_sweeps: table.small("flip_sweeps", default.flip_sweeps, 0)?,
        large_angle: table.number("large_angle", default.large_angle, ANY)?,
        small_angle: table.number("small_angle", default.small_angle, ANY)?,
        max_normal_turn: table.number("max_normal_turn", default.max_normal_turn, ANY)?,
        split_scheme: table.choice("split_scheme", &schemes)?,
        smoothing: table.flag("smoothing", default.smoothing)?,
        ridge_threshold: table.number("ridge_threshold", default.ridge_threshold, ANY)?,
        crease_angle: table.number("crease_angle", default.crease_angle, ANY)?,
        curvature: table.optional_table("curvature", read_curvature)?,
        most_triangles: usize::try_from(most).unwrap_or(usize::MAX),
        split: table.flag("split", default.split)?,
        flip: table.flag("flip", default.flip)?,
        collapse: table.flag("collapse", default.collapse)?,
    };
    parameters.validate().map_err(|error| out_of_range(table, &error))?;
    Ok((parameters, reference_length))
}

fn read_curvature(table: &mut Settings<'_>) -> Result<CurvatureAdaption, Box<Failure>> {
    let default = CurvatureAdaption::default();
    Ok(CurvatureAdaption {
        edge_over_radius: table.number("edge_over_radius", default.edge_over_radius, POSITIVE)?,
        scale: [
            table.number("least_scale", default.scale[0], POSITIVE)?,
            table.number("greatest_scale", default.scale[1], POSITIVE)?,
        ],
        grading: table.number("grading", default.grading, POSITIVE)?,
    })
}

/// `enabled` is for a scene that does not say.
pub(crate) fn read_topology(
    table: &mut Settings<'_>,
    enabled: bool,
) -> Result<TopologyParameters, Box<Failure>> {
    let default = TopologyParameters::default();
    let parameters = TopologyParameters {
        enabled: table.flag("enabled", enabled)?,
        merge_distance_rel: table.number("merge_distance_rel", default.merge_distance_rel, ANY)?,
    };
    parameters.validate().map_err(|error| out_of_range(table, &error))?;
    Ok(parameters)
}

pub(crate) fn read_integration(table: &mut Settings<'_>) -> Result<IntegrationParameters, Box<Failure>> {
    let default = IntegrationParameters::default();
    let parameters = IntegrationParameters {
        check_start: table.flag("check_start", default.check_start)?,
        proximity_rel: table.number("proximity_rel", default.proximity_rel, ANY)?,
        friction: table.number("friction", default.friction, ANY)?,
        sweeps: table.small("sweeps", default.sweeps, 0)?,
        zone_rounds: table.small("zone_rounds", default.zone_rounds, 0)?,
        most_zone_collisions: table.small("most_zone_collisions", default.most_zone_collisions, 0)?,
        rigid_rounds: table.small("rigid_rounds", default.rigid_rounds, 0)?,
        most_halvings: table.small("most_halvings", default.most_halvings, 0)?,
        most_collisions_per_vertex: table.small(
            "most_collisions_per_vertex",
            default.most_collisions_per_vertex,
            0,
        )?,
    };
    parameters.validate().map_err(|error| match error {
        IntegrationError::Parameter { parameter, .. } => table.bad(parameter, error.to_string()),
        _ => table.bad("sweeps", error.to_string()),
    })?;
    Ok(parameters)
}

pub(crate) fn read_output(table: &mut Settings<'_>) -> Result<(OutputPlan, u64), Box<Failure>> {
    let every = table.whole("every", 1, 1)?;
    let checkpoint_every = table.whole("checkpoint_every", 10, 1)?;
    let check_every = table.whole("check_every", 1, 0)?;
    let pictures = table.flag("pictures", false)?;
    let size = table.size("size", [800, 600], [1, MAX_SIDE])?;
    let azimuth = table.optional_number("azimuth", FINITE)?;
    let elevation = table.optional_number("elevation", FINITE)?;
    let distance = table.optional_number("distance", POSITIVE)?;
    let camera = (azimuth.is_some() || elevation.is_some() || distance.is_some()).then(|| Camera::Orbit {
        azimuth: azimuth.unwrap_or(30.0),
        elevation: elevation.unwrap_or(20.0),
        distance,
    });
    Ok((
        OutputPlan { every, checkpoint_every, pictures: pictures.then_some(size), camera, volume: false },
        check_every,
    ))
}

fn out_of_range(table: &Settings<'_>, error: &ParameterError) -> Box<Failure> {
    table.bad(error.parameter.split('.').next().unwrap_or("kind"), error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEAST: &str = "[surface]\nshape = \"sphere\"\n[flow]\nkind = \"rotation\"\n[time]\nstep = 0.01\n";

    fn time(text: &str) -> Result<TimeSpec, Box<Failure>> {
        let scene = Scene::of("a.toml", format!("{LEAST}{text}"));
        TrackScene::read(&scene, 0).map(|(scene, _)| scene.time)
    }

    #[test]
    fn the_end_is_met_whether_it_is_a_whole_number_of_steps_or_not() {
        let spec = time("end = 3").unwrap();
        assert_eq!((spec.steps, spec.end, spec.end_of(300)), (300, 3.0, 3.0));
        let spec = time("end = 0.025").unwrap();
        assert_eq!((spec.steps, spec.end_of(2), spec.end_of(3)), (3, 0.02, 0.025));
        for (k, end) in (1..2000).map(|k| (k, f64::from(k) * 0.01)) {
            assert_eq!(time(&format!("end = {end:?}")).unwrap().steps, k as u64, "{end}");
        }
        assert!(time("end = 1\nsteps = 2").is_err() && time("").is_err() && time("end = 1e9").is_err());
    }

    #[test]
    fn every_default_is_told_and_reads_back() {
        let scene = Scene::of("a.toml", format!("{LEAST}steps = 3"));
        let (_, resolved) = TrackScene::read(&scene, 0).unwrap();
        let again = Scene::of("b.toml", resolved.to_toml());
        let (_, twice) = TrackScene::read(&again, 0).unwrap();
        assert_eq!(resolved, twice);
        for key in ["max_edge_rel = 1.5", "merge_distance_rel = 0.1", "sweeps = 3", "scheme = \"rk4\""] {
            assert!(resolved.to_toml().contains(key), "{key}");
        }
    }
}
