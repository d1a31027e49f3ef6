//! The flow of a scene: from the tables `[[flows]]` and `[[solids]]` to a sum of primitives.

use super::bounds::Bounds;
use super::solids::Solid;
use crate::failure::Failure;
use crate::runs::settings::{ANY, FINITE, Settings};
use glam::DVec3;
use welter_fluids::procedural::{
    Amplitude, AnyPotential, AnyVelocity, Bounded, DivergentSource, DivergentSourceParameters, Extent,
    Interpolation, Keyframes, Moving, Path, ProceduralError, Pulse, ScalarNoiseParameters, SourceNoise,
    VortexFilament, VortexFilamentParameters, VortexRing, VortexRingParameters, Weighted, WeightedSum, Wind,
    WindParameters,
};
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters, Potential};
use welter_tracking::flows::{FlowError, VelocityField};

/// All flows of a scene: those with a potential, led around the solids, and sources, which are not.
#[derive(Clone, Debug)]
pub(super) struct SceneFlow(WeightedSum<AnyVelocity<'static>>);

impl VelocityField for SceneFlow {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        self.0.velocity(position, time)
    }

    fn confine(&self, from: DVec3, to: DVec3, times: [f64; 2]) -> DVec3 {
        self.0.confine(from, to, times)
    }
}

/// A flow of a scene by itself.
#[derive(Clone, Debug)]
pub(super) enum Part {
    Potential(Weighted<AnyPotential<'static>>),
    Source(Weighted<AnyVelocity<'static>>),
}

impl SceneFlow {
    pub(super) fn new(parts: Vec<Part>, solids: &[Solid]) -> Result<Self, ProceduralError> {
        let (mut potentials, mut sources) = (Vec::new(), Vec::new());
        for part in parts {
            match part {
                Part::Potential(part) => potentials.push(part),
                Part::Source(part) => sources.push(part),
            }
        }
        let mut flow = AnyPotential::new(WeightedSum::new(potentials));
        for solid in solids {
            flow = AnyPotential::new(Bounded::new(flow, solid.shape.clone(), &solid.boundary)?);
        }
        let whole = Weighted { part: AnyVelocity::new(flow), amplitude: Amplitude::Constant(1.0) };
        sources.insert(0, whole);
        Ok(Self(WeightedSum::new(sources)))
    }
}

#[derive(Clone, Copy)]
enum Kind {
    Ring,
    Filament,
    Wind,
    CurlNoise,
    Source,
}

const KINDS: [(&str, Kind); 5] = [
    ("ring", Kind::Ring),
    ("filament", Kind::Filament),
    ("wind", Kind::Wind),
    ("curl-noise", Kind::CurlNoise),
    ("source", Kind::Source),
];

impl Part {
    /// A flow and the box of what it turns around or spreads from, if that ends somewhere; `seed` is for what the scene gives no seed.
    pub(super) fn read(table: &mut Settings<'_>, seed: u64) -> Result<(Self, Option<Bounds>), Box<Failure>> {
        let kind = table.required_choice("kind", &KINDS)?;
        let amplitude = read_amplitude(table)?;
        let path = read_path(table)?;
        let mut bounds = None;
        let part = match kind {
            Kind::Ring => {
                let (ring, around) = read_ring(table)?;
                bounds = Some(around.along(path.as_ref()));
                AnyPotential::new(ring)
            }
            Kind::Filament => {
                let (filament, around) = read_filament(table)?;
                bounds = around.map(|around| around.along(path.as_ref()));
                AnyPotential::new(filament)
            }
            Kind::Wind => AnyPotential::new(read_wind(table)?),
            Kind::CurlNoise => AnyPotential::new(read_curl_noise(table, seed)?),
            Kind::Source => {
                let (source, around) = read_source(table, seed)?;
                let bounds = around.along(path.as_ref());
                let source = AnyVelocity::new(source);
                let part = match path {
                    Some(path) => AnyVelocity::new(Moving { part: source, path }),
                    None => source,
                };
                return Ok((Self::Source(Weighted { part, amplitude }), Some(bounds)));
            }
        };
        let part = match path {
            Some(path) => AnyPotential::new(Moving { part, path }),
            None => part,
        };
        Ok((Self::Potential(Weighted { part, amplitude }), bounds))
    }
}

fn read_ring(table: &mut Settings<'_>) -> Result<(VortexRing, Bounds), Box<Failure>> {
    let default = VortexRingParameters::default();
    let parameters = VortexRingParameters {
        center: table.vector("center", default.center)?,
        axis: table.vector("axis", DVec3::Z)?,
        radius: table.number("radius", default.radius, ANY)?,
        core: table.number("core", default.core, ANY)?,
        circulation: table.number("circulation", default.circulation, ANY)?,
    };
    let ring = VortexRing::new(&parameters).map_err(|error| fault(table, &error))?;
    Ok((ring, Bounds::around(parameters.center, parameters.radius)))
}

fn read_filament(table: &mut Settings<'_>) -> Result<(VortexFilament, Option<Bounds>), Box<Failure>> {
    let wanted = "an array of points, such as [[0, 0, 0], [1, 0, 0], [1, 1, 0]]";
    let vertices = table.rows("vertices", wanted, false)?.into_iter().map(DVec3::from_array).collect();
    let parameters = VortexFilamentParameters {
        vertices,
        closed: table.flag("closed", true)?,
        core: table.number("core", None, ANY)?,
        circulation: table.number("circulation", 1.0, ANY)?,
    };
    let filament = VortexFilament::new(&parameters).map_err(|error| fault(table, &error))?;
    Ok((filament, Bounds::of(parameters.vertices)))
}

fn read_wind(table: &mut Settings<'_>) -> Result<Wind, Box<Failure>> {
    let default = WindParameters::default();
    let parameters = WindParameters {
        velocity: table.vector("velocity", None)?,
        origin: table.vector("origin", default.origin)?,
    };
    Wind::new(&parameters).map_err(|error| fault(table, &error))
}

fn read_curl_noise(table: &mut Settings<'_>, seed: u64) -> Result<CurlNoise, Box<Failure>> {
    let default = CurlNoiseParameters::default();
    let parameters = CurlNoiseParameters {
        seed: table.whole("seed", seed, 0)?,
        wavelength: table.number("wavelength", default.wavelength, ANY)?,
        speed: table.number("speed", default.speed, ANY)?,
        period: table.number("period", default.period, ANY)?,
        octaves: table.small("octaves", default.octaves, 0)?,
        gain: table.number("gain", default.gain, ANY)?,
        waves: table.small("waves", default.waves, 0)?,
        potential: table
            .choice("potential", &[("spatial", Potential::Spatial), ("planar", Potential::Planar)])?,
    };
    CurlNoise::new(&parameters).map_err(|error| fault(table, &error.into()))
}

fn read_source(table: &mut Settings<'_>, seed: u64) -> Result<(DivergentSource, Bounds), Box<Failure>> {
    let default = DivergentSourceParameters::default();
    let parameters = DivergentSourceParameters {
        center: table.vector("center", default.center)?,
        radius: table.number("radius", default.radius, ANY)?,
        expansion: table.number("expansion", default.expansion, ANY)?,
        extent: table
            .choice("extent", &[("confined", Extent::Confined), ("unbounded", Extent::Unbounded)])?,
        noise: table.optional_table("noise", |noise| {
            let (default, waves) = (SourceNoise::default(), ScalarNoiseParameters::default());
            Ok(SourceNoise {
                mean: noise.number("mean", default.mean, ANY)?,
                variation: noise.number("variation", default.variation, ANY)?,
                waves: ScalarNoiseParameters {
                    seed: noise.whole("seed", seed, 0)?,
                    wavelength: noise.number("wavelength", waves.wavelength, ANY)?,
                    period: noise.number("period", waves.period, ANY)?,
                    octaves: noise.small("octaves", waves.octaves, 0)?,
                    gain: noise.number("gain", waves.gain, ANY)?,
                    waves: noise.small("waves", waves.waves, 0)?,
                },
            })
        })?,
    };
    let source = DivergentSource::new(&parameters).map_err(|error| fault(table, &error))?;
    Ok((source, Bounds::around(parameters.center, parameters.radius)))
}

const INTERPOLATIONS: [(&str, Interpolation); 2] =
    [("smooth", Interpolation::Smooth), ("linear", Interpolation::Linear)];

/// A number, keyframes, or pulses.
fn read_amplitude(table: &mut Settings<'_>) -> Result<Amplitude, Box<Failure>> {
    let keys: Option<Vec<[f64; 2]>> =
        table.optional_rows("amplitude_keys", "an array of pairs [time, amplitude]")?;
    if let Some(keys) = keys {
        if table.has("amplitude") {
            return Err(table.bad("amplitude", "either amplitude or amplitude_keys, not both"));
        }
        let interpolation = table.choice("amplitude_interpolation", &INTERPOLATIONS)?;
        let keys = keys.into_iter().map(|[time, value]| (time, value)).collect();
        return Keyframes::new(keys, interpolation)
            .map(Amplitude::Keyed)
            .map_err(|error| fault(table, &error));
    }
    let height = table.number("amplitude", 1.0, FINITE)?;
    let pulse = table.optional_table("pulse", |pulse| {
        let [rise, top, fall] = [
            pulse.number("rise", 0.25, ANY)?,
            pulse.number("top", 0.5, ANY)?,
            pulse.number("fall", 0.25, ANY)?,
        ];
        let (start, period) = (pulse.number("start", 0.0, ANY)?, pulse.number("period", f64::INFINITY, ANY)?);
        Pulse::new(height, start, [rise, top, fall], period).map_err(|error| fault(pulse, &error))
    })?;
    Ok(pulse.map_or(Amplitude::Constant(height), Amplitude::Pulsed))
}

/// Displacements over time, if there are any.
pub(super) fn read_path(table: &mut Settings<'_>) -> Result<Option<Path>, Box<Failure>> {
    let wanted = "an array of [time, x, y, z], such as [[0, 0, 0, 0], [2, 0, 0, 1]]";
    let Some(keys) = table.optional_rows::<4>("path", wanted)? else { return Ok(None) };
    let interpolation = table.choice("path_interpolation", &INTERPOLATIONS)?;
    let keys = keys.into_iter().map(|[time, x, y, z]| (time, DVec3::new(x, y, z))).collect();
    Path::new(keys, interpolation).map(Some).map_err(|error| fault(table, &error))
}

/// A fault at the key that an error names.
pub(super) fn fault(table: &Settings<'_>, error: &ProceduralError) -> Box<Failure> {
    let key = match error {
        ProceduralError::Parameter { name, .. } => name,
        ProceduralError::Noise(FlowError::Parameter { name, .. }) => name,
        ProceduralError::Vertex { .. } | ProceduralError::Line { .. } => "vertices",
        ProceduralError::NoKeyframes | ProceduralError::KeyTime { .. } | ProceduralError::KeyValue { .. } => {
            if table.has("path") {
                "path"
            } else {
                "amplitude_keys"
            }
        }
        _ => "kind",
    };
    table.bad(key, error.to_string())
}
