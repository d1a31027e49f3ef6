//! Noise with a potential, and noise of one number, against their sums in numbers with derivatives.

use super::points;
use glam::DVec3;
use welter_fluids::procedural::{
    LocalPotential, ScalarNoise, ScalarNoiseParameters, VectorPotential, Wind, WindParameters,
};
use welter_kit::evolution::Dual;
use welter_kit::mesher::Random;
use welter_tracking::flows::VelocityField;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters, Potential, Wave};

/// `k . x + w t + p`.
fn angle(wave: &Wave, x: [Dual; 3], time: f64) -> Dual {
    let along = wave.vector.x * x[0] + wave.vector.y * x[1] + wave.vector.z * x[2];
    along + Dual::constant(wave.frequency * time + wave.phase)
}

fn parameters() -> Vec<CurlNoiseParameters> {
    let one = CurlNoiseParameters::default();
    vec![
        one,
        CurlNoiseParameters { seed: 5, wavelength: 0.3, speed: 7.0, period: 0.2, octaves: 5, ..one },
        CurlNoiseParameters { seed: 9, potential: Potential::Planar, octaves: 1, waves: 3, ..one },
    ]
}

#[test]
fn curl_noise_is_the_curl_of_its_potential() {
    for parameters in parameters() {
        let noise = CurlNoise::new(&parameters).unwrap();
        let sizes: f64 = noise.waves().iter().map(|w| w.amplitude.length()).sum();
        let lengths: f64 = noise.waves().iter().map(|w| w.amplitude.length() / w.vector.length()).sum();
        let mut random = Random::new(21);
        for point in points(500, 3.0, 22) {
            let time = random.between(-2.0, 2.0);
            let x = Dual::coordinates(point);
            let mut sum = [Dual::constant(0.0); 3];
            for wave in noise.waves() {
                // Perpendicular to the wave, with the velocity for a curl.
                let direction = wave.amplitude.cross(wave.vector) / wave.vector.length_squared();
                let sine = angle(wave, x, time).sin();
                for k in 0..3 {
                    sum[k] = sum[k] + direction[k] * sine;
                }
            }
            let LocalPotential { potential, curl } = noise.potential_and_curl(point, time);
            // Angles of a hundred radians, in the twin, are rounded relative to their size.
            let bound = 1e-16 * (20.0 + 10.0 / parameters.wavelength * 2f64.powi(parameters.octaves as i32));
            assert!((curl - Dual::curl(sum)).length() < bound * sizes, "{point}");
            let (expected, divergence) = Dual::divergence(sum);
            assert!((potential - expected).length() < bound * lengths, "{point}: {potential} {expected}");
            assert!(divergence.abs() < 1e-15 * sizes);
            assert_eq!(curl, noise.velocity(point, time));
        }
    }
}

#[test]
fn the_wind_is_the_curl_of_its_potential() {
    let parameters =
        WindParameters { velocity: DVec3::new(1.0, -2.0, 0.5), origin: DVec3::new(3.0, 0.25, -1.0) };
    let wind = Wind::new(&parameters).unwrap();
    for point in points(100, 5.0, 23) {
        let [x, y, z] = Dual::coordinates(point - parameters.origin);
        let w = parameters.velocity;
        let potential = [w.y * z - w.z * y, w.z * x - w.x * z, w.x * y - w.y * x].map(|c| 0.5 * c);
        let found = wind.potential_and_curl(point, 0.0);
        assert_eq!((Dual::curl(potential), found.curl), (w, w));
        assert!((found.potential - Dual::divergence(potential).0).length() < 1e-14);
    }
}

#[test]
fn scalar_noise_is_its_sum_with_its_gradient() {
    let parameters = ScalarNoiseParameters { seed: 3, wavelength: 0.7, octaves: 3, ..Default::default() };
    let noise = ScalarNoise::new(&parameters).unwrap();
    let ScalarNoiseParameters { seed, wavelength, period, octaves, gain, waves } = parameters;
    let speed = 1.0;
    let of_curl = CurlNoiseParameters {
        seed,
        wavelength,
        period,
        octaves,
        gain,
        waves,
        speed,
        potential: Potential::Spatial,
    };
    let waves = CurlNoise::new(&of_curl).unwrap();
    for point in points(300, 2.0, 24) {
        let mut sum = Dual::constant(0.0);
        for wave in waves.waves() {
            sum = sum + wave.amplitude.length() * angle(wave, Dual::coordinates(point), 0.4).cos();
        }
        let (value, gradient) = noise.at(point, 0.4);
        assert!((value - sum.value).abs() < 1e-12 && (gradient - sum.gradient).length() < 1e-10, "{point}");
    }
}

#[test]
fn scalar_noise_has_mean_zero_and_mean_square_one() {
    for seed in 0..3 {
        let noise = ScalarNoise::new(&ScalarNoiseParameters { seed, ..Default::default() }).unwrap();
        let count = 20_000;
        let (mut mean, mut square) = (0.0, 0.0);
        for point in points(count, 1e4, 25) {
            let (value, _) = noise.at(point, 0.0);
            mean += value / count as f64;
            square += value * value / count as f64;
        }
        // Five deviations of the mean of independent samples; the square of a sum of many waves varies by sqrt 2.
        let bound = 5.0 / (count as f64).sqrt();
        assert!(mean.abs() < bound && (square - 1.0).abs() < 1.5 * bound, "{seed}: {mean} {square}");
    }
}
