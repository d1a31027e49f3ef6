//! What primitives refuse, each with its place.

use glam::DVec3;
use welter_fluids::procedural::{
    BoundaryParameters, Bounded, DivergentSourceParameters, Interpolation, Keyframes, Path, ProceduralError,
    Pulse, ScalarNoiseParameters, SourceNoise, VortexFilamentParameters, VortexRing, VortexRingParameters,
    Wind, WindParameters,
};
use welter_meshing::field::Ball;
use welter_tracking::flows::FlowError;

fn name_of<T: std::fmt::Debug>(result: Result<T, ProceduralError>) -> &'static str {
    match result {
        Err(
            ProceduralError::Parameter { name, .. }
            | ProceduralError::Noise(FlowError::Parameter { name, .. }),
        ) => name,
        other => panic!("{other:?}"),
    }
}

const INFINITE: DVec3 = DVec3::new(0.0, f64::INFINITY, 0.0);

#[test]
fn rings() {
    let ring = VortexRingParameters::default();
    assert_eq!(name_of(VortexRingParameters { center: INFINITE, ..ring }.validate()), "center");
    for axis in [DVec3::ZERO, INFINITE, DVec3::NAN, DVec3::new(1e-310, 0.0, 0.0)] {
        assert_eq!(name_of(VortexRing::new(&VortexRingParameters { axis, ..ring })), "axis");
    }
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-200, 1e200] {
        assert_eq!(name_of(VortexRingParameters { radius, ..ring }.validate()), "radius");
    }
    for core in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-31, 1e31] {
        assert_eq!(name_of(VortexRingParameters { core, ..ring }.validate()), "core");
    }
    for circulation in [f64::NAN, f64::INFINITY] {
        assert_eq!(name_of(VortexRingParameters { circulation, ..ring }.validate()), "circulation");
    }
    let tiny = VortexRingParameters { radius: 1e-100, core: 1e-101, circulation: 1e300, ..ring };
    assert_eq!(name_of(tiny.validate()), "circulation");
    assert!(ring.validate().is_ok());
}

#[test]
fn filaments() {
    let line = VortexFilamentParameters::default;
    for (count, closed, least) in [(0, false, 2), (1, false, 2), (0, true, 3), (2, true, 3)] {
        let found =
            VortexFilamentParameters { vertices: vec![DVec3::ONE; count], closed, ..line() }.validate();
        assert_eq!(found, Err(ProceduralError::Line { vertices: count, least }));
    }
    let vertices = vec![DVec3::ZERO, DVec3::ONE, INFINITE, DVec3::NAN];
    let found = VortexFilamentParameters { vertices, ..line() }.validate();
    assert_eq!(found, Err(ProceduralError::Vertex { index: 2, position: INFINITE }));
    let point = VortexFilamentParameters { vertices: vec![DVec3::ONE; 4], ..line() };
    assert_eq!(name_of(point.validate()), "longest side of the box around the filament");
    let wide =
        VortexFilamentParameters { vertices: vec![DVec3::splat(-1e308), DVec3::splat(1e308)], ..line() };
    assert_eq!(name_of(wide.validate()), "longest side of the box around the filament");
    assert_eq!(name_of(VortexFilamentParameters { core: 0.0, ..line() }.validate()), "core");
    assert_eq!(
        name_of(VortexFilamentParameters { circulation: f64::NAN, ..line() }.validate()),
        "circulation"
    );
}

#[test]
fn sources_wind_and_noise() {
    let source = DivergentSourceParameters::default();
    assert_eq!(name_of(DivergentSourceParameters { center: INFINITE, ..source }.validate()), "center");
    assert_eq!(name_of(DivergentSourceParameters { radius: 0.0, ..source }.validate()), "radius");
    assert_eq!(name_of(DivergentSourceParameters { expansion: f64::NAN, ..source }.validate()), "expansion");
    let with = |noise| DivergentSourceParameters { noise: Some(noise), ..source };
    let noise = SourceNoise::default();
    assert_eq!(name_of(with(SourceNoise { mean: f64::NAN, ..noise }).validate()), "mean");
    assert_eq!(name_of(with(SourceNoise { variation: f64::INFINITY, ..noise }).validate()), "variation");
    let waves = ScalarNoiseParameters { octaves: 0, ..Default::default() };
    assert_eq!(name_of(with(SourceNoise { waves, ..noise }).validate()), "octaves");
    assert_eq!(name_of(Wind::new(&WindParameters { velocity: INFINITE, origin: DVec3::ZERO })), "velocity");
    assert_eq!(name_of(WindParameters { origin: INFINITE, ..Default::default() }.validate()), "origin");
}

#[test]
fn keyframes_and_pulses() {
    let new = |keys: &[(f64, f64)]| Keyframes::new(keys.to_vec(), Interpolation::Smooth);
    assert_eq!(new(&[]), Err(ProceduralError::NoKeyframes));
    assert_eq!(new(&[(0.0, 1.0), (0.0, 2.0)]), Err(ProceduralError::KeyTime { index: 1, time: 0.0 }));
    assert_eq!(new(&[(0.0, 1.0), (-1.0, 2.0)]), Err(ProceduralError::KeyTime { index: 1, time: -1.0 }));
    assert!(matches!(new(&[(f64::NAN, 1.0)]), Err(ProceduralError::KeyTime { index: 0, .. })));
    assert!(matches!(new(&[(f64::INFINITY, 1.0)]), Err(ProceduralError::KeyTime { index: 0, .. })));
    assert_eq!(new(&[(0.0, 1.0), (1.0, f64::NAN)]), Err(ProceduralError::KeyValue { index: 1 }));
    assert_eq!(Path::constant(INFINITE), Err(ProceduralError::KeyValue { index: 0 }));
    let rates = Keyframes::with_rates(&[(0.0, 1.0, 0.0), (1.0, 2.0, f64::NAN)]);
    assert_eq!(rates, Err(ProceduralError::KeyValue { index: 1 }));
    assert_eq!(Keyframes::<f64>::with_rates(&[]), Err(ProceduralError::NoKeyframes));
    let still = |_: DVec3, _: f64| DVec3::ZERO;
    let carried = |times, steps| Path::carried(&still, DVec3::ZERO, times, steps);
    assert_eq!(name_of(carried([0.0, 1.0], 0)), "steps");
    assert_eq!(carried([0.0, 0.0], 3), Err(ProceduralError::KeyTime { index: 1, time: 0.0 }));
    assert!(matches!(carried([0.0, f64::INFINITY], 3), Err(ProceduralError::KeyTime { .. })));
    let bursting = |p: DVec3, t: f64| if t > 0.6 { DVec3::INFINITY } else { p };
    let carried = Path::carried(&bursting, DVec3::ONE, [0.0, 1.0], 2);
    assert_eq!(carried, Err(ProceduralError::KeyValue { index: 2 }));
    let inf = f64::INFINITY;
    assert_eq!(name_of(Pulse::new(f64::NAN, 0.0, [1.0, 1.0, 1.0], inf)), "height");
    assert_eq!(name_of(Pulse::new(1.0, inf, [1.0, 1.0, 1.0], inf)), "start");
    assert_eq!(name_of(Pulse::new(1.0, 0.0, [0.0, 1.0, 1.0], inf)), "rise");
    assert_eq!(name_of(Pulse::new(1.0, 0.0, [1.0, -1.0, 1.0], inf)), "top");
    assert_eq!(name_of(Pulse::new(1.0, 0.0, [1.0, 1.0, inf], inf)), "fall");
    assert_eq!(name_of(Pulse::new(1.0, 0.0, [1.0, 1.0, 1.0], 2.5)), "period");
    assert_eq!(name_of(Pulse::new(1.0, 0.0, [1.0, 1.0, 1.0], f64::NAN)), "period");
    // Durations that vanish next to others.
    let vanishing = Pulse::new(1.0, 0.0, [1e20, 1.0, 1.0], inf);
    assert!(matches!(vanishing, Err(ProceduralError::KeyTime { .. })), "{vanishing:?}");
}

#[test]
fn boundaries() {
    let around = |parameters: BoundaryParameters| {
        let wind = Wind::new(&WindParameters::default()).unwrap();
        Bounded::new(wind, Ball::default(), &parameters)
    };
    for ramp_width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let parameters = BoundaryParameters { ramp_width, ..Default::default() };
        assert_eq!(name_of(around(parameters)), "ramp_width");
    }
    let parameters = BoundaryParameters { ramp_width: 1.0, anchor: Some(INFINITE), path: None };
    assert_eq!(name_of(around(parameters)), "anchor");
}
