//! The fields: values and divergence by automatic differentiation, statistics of noise.

use glam::DVec3;
use std::f64::consts::{PI, TAU};
use welter_kit::evolution::Dual;
use welter_kit::mesher::Random;
use welter_tracking::flows::VelocityField;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters, Enright, Potential, Rotation, Shear};

/// Compares a field with a formula in numbers with derivatives, and asks that there be no divergence, relative to
/// `slope`, a bound of the derivatives.
fn check(
    field: &impl VelocityField,
    formula: impl Fn([Dual; 3], f64) -> [Dual; 3],
    [speed, slope]: [f64; 2],
) {
    let mut random = Random::new(51);
    for _ in 0..2000 {
        let (place, time) = (2.0 * random.point(), random.between(-3.0, 3.0));
        let (value, divergence) = Dual::divergence(formula(Dual::coordinates(place), time));
        let found = field.velocity(place, time);
        assert!((found - value).length() <= 1e-13 * speed, "{place}, {time}: {found}, not {value}");
        assert!(divergence.abs() <= 1e-14 * slope, "{place}, {time}: divergence {divergence:e}");
    }
}

#[test]
fn enright_is_the_formula_and_free_of_divergence() {
    for (period, size) in [(3.0, 1.0), (0.7, 2.5)] {
        let formula = |p: [Dual; 3], time: f64| {
            let [s1, s2, s3] = p.map(|c| (PI / size * c).sin());
            let [d1, d2, d3] = p.map(|c| (TAU / size * c).sin());
            let speed = size * (TAU * time / period).sin();
            [2.0 * speed * (s1 * s1 * d2 * d3), -speed * (d1 * s2 * s2 * d3), -speed * (d1 * d2 * s3 * s3)]
        };
        // The terms of the divergence are at most 2 pi.
        check(&Enright { period, size }, formula, [size, TAU]);
    }
}

#[test]
fn enright_runs_backwards_in_the_second_half() {
    let field = Enright::default();
    let mut random = Random::new(52);
    for _ in 0..500 {
        let (place, time) = (random.point(), random.between(0.0, 3.0));
        let (there, back) = (field.velocity(place, time), field.velocity(place, 3.0 - time));
        assert!((there + back).length() < 4e-15, "{there} {back}");
        assert!((field.velocity(place, time + 3.0) - there).length() < 4e-15);
    }
    // At rest on the faces of the cube across them.
    assert_eq!(field.velocity(DVec3::new(0.0, 0.3, 0.4), 0.7).x, 0.0);
}

#[test]
fn rotation_and_shear_are_free_of_divergence() {
    let rotation =
        Rotation { center: DVec3::new(0.1, 0.2, 0.3), angular_velocity: DVec3::new(1.0, 2.0, -3.0) };
    let formula = |p: [Dual; 3], _: f64| {
        let w = rotation.angular_velocity;
        let q: [Dual; 3] = std::array::from_fn(|k| p[k] - Dual::constant(rotation.center[k]));
        [w.y * q[2] - w.z * q[1], w.z * q[0] - w.x * q[2], w.x * q[1] - w.y * q[0]]
    };
    check(&rotation, formula, [30.0, 3.0]);
    let shear = Shear {
        center: DVec3::new(0.1, 0.2, 0.3),
        direction: DVec3::new(1.0, 1.0, 0.0),
        gradient: DVec3::new(1.0, -1.0, 2.0),
    };
    let formula = |p: [Dual; 3], _: f64| {
        let at = |k: usize| shear.gradient[k] * (p[k] - Dual::constant(shear.center[k]));
        let along = at(0) + at(1) + at(2);
        [0, 1, 2].map(|k| shear.direction[k] * along)
    };
    check(&shear, formula, [20.0, 2.0]);
}

fn parameters() -> Vec<CurlNoiseParameters> {
    let one = CurlNoiseParameters::default();
    vec![
        one,
        CurlNoiseParameters { seed: 9, potential: Potential::Planar, octaves: 2, ..one },
        CurlNoiseParameters { seed: 5, wavelength: 0.3, speed: 7.0, period: 0.2, waves: 5, ..one },
        CurlNoiseParameters { seed: 5, period: f64::INFINITY, octaves: 1, waves: 3, ..one },
    ]
}

#[test]
fn curl_noise_is_the_curl_of_a_potential_and_free_of_divergence() {
    for parameters in parameters() {
        let noise = CurlNoise::new(&parameters).unwrap();
        let formula = |p: [Dual; 3], time: f64| {
            let mut sum = [Dual::constant(0.0); 3];
            for wave in noise.waves() {
                let along = wave.vector.x * p[0] + wave.vector.y * p[1] + wave.vector.z * p[2];
                let cos = (along + Dual::constant(wave.frequency * time + wave.phase)).cos();
                for (sum, amplitude) in sum.iter_mut().zip(wave.amplitude.to_array()) {
                    *sum = *sum + amplitude * cos;
                }
            }
            sum
        };
        let total = |of: fn(DVec3, DVec3) -> f64| -> f64 {
            noise.waves().iter().map(|w| of(w.vector, w.amplitude)).sum()
        };
        let (speed, slope) = (total(|_, v| v.length()), total(|k, v| k.length() * v.length()));
        // Arguments of some hundred radians are rounded relative to their size.
        check(&noise, formula, [100.0 * speed, slope]);
    }
}

#[test]
fn curl_noise_has_its_speed_and_mean_zero() {
    for parameters in parameters() {
        let noise = CurlNoise::new(&parameters).unwrap();
        let mut random = Random::new(53);
        let (mut mean, mut square, count) = (DVec3::ZERO, 0.0, 20_000);
        for _ in 0..count {
            let place = 1e4 * parameters.wavelength * random.point();
            let v = noise.velocity(place, 0.0);
            mean += v / f64::from(count);
            square += v.length_squared() / f64::from(count);
        }
        // The mean of N independent samples is within speed / sqrt N, and so is the square, relatively: five times that.
        let bound = 5.0 / f64::from(count).sqrt();
        assert!(mean.length() < bound * parameters.speed, "{parameters:?}: mean {mean}");
        let ratio = square / parameters.speed.powi(2);
        assert!((ratio - 1.0).abs() < 2.0 * bound, "{parameters:?}: mean square {ratio} of the speed's");
    }
}

#[test]
fn curl_noise_has_the_wavelengths_and_periods_asked_for() {
    for parameters in parameters() {
        let noise = CurlNoise::new(&parameters).unwrap();
        assert_eq!(noise.waves().len(), (parameters.waves * parameters.octaves) as usize);
        for (octave, waves) in noise.waves().chunks(parameters.waves as usize).enumerate() {
            let wavelength = parameters.wavelength / 2f64.powi(octave as i32);
            let turnover = 2f64.powi(octave as i32) * parameters.gain.powi(octave as i32);
            for wave in waves {
                let ratio = TAU / wave.vector.length() / wavelength;
                assert!((0.707..1.415).contains(&ratio), "{ratio}");
                assert!(
                    wave.frequency.abs() * parameters.period / turnover <= TAU * 1.000_001
                        || parameters.period.is_infinite()
                );
                assert!(parameters.period.is_finite() || wave.frequency == 0.0);
                assert!(
                    wave.amplitude.dot(wave.vector).abs()
                        < 1e-15 * wave.amplitude.length() * wave.vector.length()
                );
                if parameters.potential == Potential::Planar {
                    assert_eq!((wave.vector.z, wave.amplitude.z), (0.0, 0.0));
                }
            }
        }
    }
}

/// The change over small distances and times is bounded by the sums of the waves.
#[test]
fn curl_noise_is_smooth_in_space_and_time() {
    let noise = CurlNoise::new(&CurlNoiseParameters::default()).unwrap();
    let slope: f64 = noise.waves().iter().map(|w| w.vector.length() * w.amplitude.length()).sum();
    let rate: f64 = noise.waves().iter().map(|w| w.frequency.abs() * w.amplitude.length()).sum();
    let mut random = Random::new(54);
    let mut largest: f64 = 0.0;
    for _ in 0..2000 {
        let (place, time, step) = (random.point(), random.unit(), 1e-4 * random.point());
        let here = noise.velocity(place, time);
        let moved = (noise.velocity(place + step, time) - here).length();
        assert!(moved <= slope * step.length() + 1e-13);
        largest = largest.max(moved / (slope * step.length()));
        assert!((noise.velocity(place, time + 1e-4) - here).length() <= 1e-4 * rate + 1e-13);
    }
    assert!(largest > 0.01, "it changes at all: {largest}");
}

#[test]
fn seeds_give_fields_that_have_nothing_to_do_with_each_other() {
    let fields: Vec<CurlNoise> = (0..6)
        .map(|seed| CurlNoise::new(&CurlNoiseParameters { seed, ..Default::default() }).unwrap())
        .collect();
    let mut random = Random::new(55);
    let places: Vec<DVec3> = (0..4000).map(|_| 1e3 * random.point()).collect();
    let values: Vec<Vec<DVec3>> =
        fields.iter().map(|field| places.iter().map(|&p| field.velocity(p, 0.0)).collect()).collect();
    for i in 0..6 {
        for j in 0..i {
            let product: f64 = values[i].iter().zip(&values[j]).map(|(a, b)| a.dot(*b)).sum();
            let correlation = product / places.len() as f64;
            // Five times the deviation of the mean of independent samples.
            assert!(correlation.abs() < 5.0 / (places.len() as f64).sqrt(), "{i} and {j}: {correlation}");
        }
    }
    let again = CurlNoise::new(&CurlNoiseParameters { seed: 3, ..Default::default() }).unwrap();
    assert_eq!(again, fields[3]);
}

#[test]
fn lengths_times_a_power_of_two_give_velocities_times_that_power() {
    let mut random = Random::new(56);
    for k in [-1000, -300, -3, 1, 40, 500] {
        let factor = 2f64.powi(k);
        for parameters in parameters() {
            let one = CurlNoise::new(&parameters).unwrap();
            let large = CurlNoiseParameters {
                wavelength: factor * parameters.wavelength,
                speed: factor * parameters.speed,
                ..parameters
            };
            let large = CurlNoise::new(&large).unwrap();
            for _ in 0..50 {
                let (place, time) = (random.point(), random.unit());
                assert_eq!(large.velocity(factor * place, time), factor * one.velocity(place, time), "2^{k}");
                let (one, large) = (Enright::default(), Enright { size: factor, ..Default::default() });
                assert_eq!(large.velocity(factor * place, time), factor * one.velocity(place, time), "2^{k}");
            }
        }
    }
}
