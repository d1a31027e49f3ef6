//! Where the surface of a scene goes: from the table `[flow]` to a [`Flow`].

use crate::failure::Failure;
use crate::runs::settings::{ANY, FINITE, Settings};
use glam::DVec3;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters, Enright, Potential, Rotation, Shear};
use welter_tracking::flows::{
    Advection, FaceOffsetting, FaceOffsettingParameters, Flow, FlowError, Front, Jitter, MeanCurvature,
    NormalSpeed, Prediction, Scheme, VelocityField,
};
use welter_tracking::surface::MovingSurface;

/// The flow of a scene.
#[derive(Clone, Debug)]
pub(super) enum SceneFlow {
    Advection(Advection<Placed>),
    Normal(FaceOffsetting<Schedule>),
    MeanCurvature(MeanCurvature),
    Jitter(Jitter),
}

/// A velocity field whose origin is elsewhere.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    field: Field,
    origin: DVec3,
}

#[derive(Clone, Debug)]
enum Field {
    Enright(Enright),
    CurlNoise(CurlNoise),
    Rotation(Rotation),
    Shear(Shear),
}

/// Speeds, each from a time on; the first at all times before the second.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Schedule(pub(super) Vec<[f64; 2]>);

impl NormalSpeed for Schedule {
    fn speed(&self, _position: DVec3, time: f64) -> f64 {
        let later = self.0.iter().skip(1).take_while(|[from, _]| *from <= time).last();
        later.or(self.0.first()).map_or(0.0, |[_, speed]| *speed)
    }
}

impl VelocityField for Placed {
    fn velocity(&self, position: DVec3, time: f64) -> DVec3 {
        let position = position - self.origin;
        match &self.field {
            Field::Enright(field) => field.velocity(position, time),
            Field::CurlNoise(field) => field.velocity(position, time),
            Field::Rotation(field) => field.velocity(position, time),
            Field::Shear(field) => field.velocity(position, time),
        }
    }
}

impl Flow for SceneFlow {
    fn advance(&self, surface: &MovingSurface, time: f64, dt: f64) -> Result<Prediction, FlowError> {
        match self {
            Self::Advection(flow) => flow.advance(surface, time, dt),
            Self::Normal(flow) => flow.advance(surface, time, dt),
            Self::MeanCurvature(flow) => flow.advance(surface, time, dt),
            Self::Jitter(flow) => flow.advance(surface, time, dt),
        }
    }
}

#[derive(Clone, Copy)]
enum Kind {
    Enright,
    CurlNoise,
    Rotation,
    Shear,
    Normal,
    MeanCurvature,
    Jitter,
}

const KINDS: [(&str, Kind); 7] = [
    ("enright", Kind::Enright),
    ("curl-noise", Kind::CurlNoise),
    ("rotation", Kind::Rotation),
    ("shear", Kind::Shear),
    ("normal", Kind::Normal),
    ("mean-curvature", Kind::MeanCurvature),
    ("jitter", Kind::Jitter),
];

const SCHEMES: [(&str, Scheme); 2] = [("rk4", Scheme::Rk4), ("euler", Scheme::Euler)];

impl SceneFlow {
    /// `seed` is for what the scene gives no seed.
    pub(super) fn read(flow: &mut Settings<'_>, seed: u64) -> Result<Self, Box<Failure>> {
        match flow.required_choice("kind", &KINDS)? {
            Kind::Enright => {
                let default = Enright::default();
                let field = Enright {
                    period: flow.number("period", default.period, ANY)?,
                    size: flow.number("size", default.size, ANY)?,
                };
                check(flow, field.validate())?;
                Self::advection(flow, Field::Enright(field))
            }
            Kind::CurlNoise => {
                let default = CurlNoiseParameters::default();
                let parameters = CurlNoiseParameters {
                    seed: flow.whole("seed", seed, 0)?,
                    wavelength: flow.number("wavelength", default.wavelength, ANY)?,
                    speed: flow.number("speed", default.speed, ANY)?,
                    period: flow.number("period", default.period, ANY)?,
                    octaves: flow.small("octaves", default.octaves, 0)?,
                    gain: flow.number("gain", default.gain, ANY)?,
                    waves: flow.small("waves", default.waves, 0)?,
                    potential: flow.choice(
                        "potential",
                        &[("spatial", Potential::Spatial), ("planar", Potential::Planar)],
                    )?,
                };
                check(flow, parameters.validate())?;
                let field = CurlNoise::new(&parameters).map_err(|error| fault(flow, &error))?;
                Self::advection(flow, Field::CurlNoise(field))
            }
            Kind::Rotation => {
                let default = Rotation::default();
                let field = Rotation {
                    center: flow.vector("center", default.center)?,
                    angular_velocity: flow.vector("angular_velocity", default.angular_velocity)?,
                };
                Self::advection(flow, Field::Rotation(field))
            }
            Kind::Shear => {
                let default = Shear::default();
                let field = Shear {
                    center: flow.vector("center", default.center)?,
                    direction: flow.vector("direction", default.direction)?,
                    gradient: flow.vector("gradient", default.gradient)?,
                };
                Self::advection(flow, Field::Shear(field))
            }
            Kind::Normal => Self::normal(flow),
            Kind::MeanCurvature => {
                let default = MeanCurvature::default();
                let motion = MeanCurvature {
                    speed: flow.number("speed", default.speed, ANY)?,
                    scheme: flow.choice("scheme", &SCHEMES)?,
                    safety: flow.number("safety", default.safety, ANY)?,
                    stiffness: flow.number("stiffness", default.stiffness, ANY)?,
                };
                check(flow, motion.validate())?;
                Ok(Self::MeanCurvature(motion))
            }
            Kind::Jitter => {
                let jitter = Jitter {
                    amplitude_rel: flow.number("amplitude_rel", Jitter::default().amplitude_rel, ANY)?,
                    seed: flow.whole("seed", seed, 0)?,
                };
                check(flow, jitter.validate())?;
                Ok(Self::Jitter(jitter))
            }
        }
    }

    fn advection(flow: &mut Settings<'_>, field: Field) -> Result<Self, Box<Failure>> {
        let scheme = flow.choice("scheme", &SCHEMES)?;
        let origin = flow.vector("origin", DVec3::ZERO)?;
        Ok(Self::Advection(Advection { field: Placed { field, origin }, scheme }))
    }

    fn normal(flow: &mut Settings<'_>) -> Result<Self, Box<Failure>> {
        let speed = if flow.has("schedule") {
            flow.pairs("schedule", "an array of pairs [time, speed], such as [[0, 0.2], [1, -0.2]]")?
        } else {
            vec![[0.0, flow.number("speed", None, FINITE)?]]
        };
        let default = FaceOffsettingParameters::default();
        let parameters = FaceOffsettingParameters {
            rank_threshold: flow.number("rank_threshold", default.rank_threshold, ANY)?,
            area_kept: flow.number("area_kept", default.area_kept, ANY)?,
            least_fraction: flow.number("least_fraction", default.least_fraction, ANY)?,
        };
        check(flow, parameters.validate())?;
        let front = flow.choice("front", &[("entropy", Front::Entropy), ("sharp", Front::Sharp)])?;
        Ok(Self::Normal(FaceOffsetting { speed: Schedule(speed), front, parameters }))
    }

    /// The speeds of motion along the normal, if it is that, with the entropy condition.
    pub(super) fn entropy_schedule(&self) -> Option<&Schedule> {
        match self {
            Self::Normal(flow) if flow.front == Front::Entropy => Some(&flow.speed),
            _ => None,
        }
    }
}

fn check(flow: &Settings<'_>, valid: Result<(), FlowError>) -> Result<(), Box<Failure>> {
    valid.map_err(|error| fault(flow, &error))
}

fn fault(flow: &Settings<'_>, error: &FlowError) -> Box<Failure> {
    let key = match error {
        FlowError::Parameter { name, .. } => name,
        _ => "kind",
    };
    flow.bad(key, error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_hold_from_their_time_on() {
        let speed = Schedule(vec![[0.5, 1.0], [1.0, -1.0], [2.0, 3.0]]);
        let at = |time: f64| speed.speed(DVec3::ZERO, time);
        assert_eq!((at(0.0), at(0.75), at(1.0), at(1.5), at(9.0)), (1.0, 1.0, -1.0, -1.0, 3.0));
    }
}
