//! The animation: puffs that rise through vortex rings, with fine noise.

use glam::DVec3;
use welter_fluids::procedural::{
    Amplitude, AnyVelocity, VortexRing, VortexRingParameters, Weighted, WeightedSum,
};
use welter_fluids::smoke::{Emission, EmittedShape, Joining, Schedule};
use welter_fluids::volume_rendering::{Camera, InteriorRule, Light, Medium, RenderParameters};
use welter_meshing::shapes::{Sphere, sphere};
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters};

/// From frame to frame, each of them one step.
pub(crate) const STEP: f64 = 0.05;

/// How many frames follow the first.
pub(crate) const FRAMES: u32 = 36;

/// What carries the smoke.
pub(crate) type Flow = WeightedSum<AnyVelocity<'static>>;

/// Balls of radius 1/4, one after the other; `edge_length` is that of their surfaces.
pub(crate) fn emissions(edge_length: f64) -> Vec<Emission> {
    let ball = sphere(&Sphere { radius: 0.25, edge_length, ..Sphere::default() }).expect("a ball");
    let schedule = Schedule { start: 0.0, interval: 0.45, count: None };
    vec![Emission { shape: EmittedShape::Closed(ball), schedule, joining: Joining::Separate, path: None }]
}

/// Three rings above each other, and noise of two octaves.
pub(crate) fn flow() -> Flow {
    let ring = |height: f64, radius: f64, core: f64, circulation: f64| {
        let center = height * DVec3::Y;
        let ring = VortexRingParameters { center, axis: DVec3::Y, radius, core, circulation };
        AnyVelocity::new(VortexRing::new(&ring).expect("a ring"))
    };
    let noise = CurlNoiseParameters {
        seed: 5,
        wavelength: 0.8,
        speed: 0.45,
        octaves: 2,
        waves: 16,
        ..CurlNoiseParameters::default()
    };
    let parts = vec![
        ring(0.2, 0.5, 0.25, 1.6),
        ring(0.9, 0.6, 0.25, 1.4),
        ring(1.7, 0.7, 0.3, 1.2),
        AnyVelocity::new(CurlNoise::new(&noise).expect("a noise")),
    ];
    let whole = |part| Weighted { part, amplitude: Amplitude::Constant(1.0) };
    WeightedSum::new(parts.into_iter().map(whole).collect())
}

/// From where the plume is seen.
pub(crate) fn camera() -> Camera {
    Camera::toward(DVec3::new(2.6, 1.6, 4.2), DVec3::new(0.0, 1.0, 0.0))
}

/// White light from above and the left.
pub(crate) fn light() -> Light {
    Light { direction: DVec3::new(1.0, -1.6, -0.6), ..Light::default() }
}

/// White smoke. Where puffs overlap there is smoke of both, as there is with particles.
pub(crate) fn medium(extinction: f64) -> Medium {
    Medium { interior: InteriorRule::Multiplicity, ..Medium::white(extinction) }
}

/// What is seen behind the smoke: a grey that is neither as bright nor as dark as smoke is.
pub(crate) const BACKGROUND: [f64; 3] = [0.05, 0.05, 0.05];

/// How pictures are made. Light is traced however fine the surface, so that the reference is as exact as the surface that is compared
/// with it.
pub(crate) fn parameters() -> RenderParameters {
    RenderParameters {
        width: 480,
        height: 540,
        shadow_resolution: 160,
        traced_triangles: u32::MAX,
        ..RenderParameters::default()
    }
}
