//! Blur of old smoke across the picture.
//!
//! # What it computes
//! Each pixel of smoke is spread by a Gaussian whose standard deviation follows from its age ([`AgeBlur`]),
//! so that old smoke is soft and young smoke sharp.
//!
//! # What it promises
//! The sums of alpha and of scatter over the image stay, up to rounding in single precision: a pixel's
//! weights add up to 1 also where the image ends. Where the deviation is everywhere the same, the blur is the
//! Gaussian blur, cut at three deviations. The same bits for any number of threads.
//!
//! # What it does not promise
//! Depth: smoke beside a solid also spreads over it, whether before or behind; layers of several ages spread
//! by their mean. Nor alpha up to 1: where old smoke spreads over young smoke that hides everything, the sums
//! of both exceed 1. The composite then takes the background as hidden.
//!
//! # Method
//! Each row, then each column: a pixel adds its value, times the weights, to its neighbours. In the second
//! pass a pixel's deviation is the mean of those that came to it, by alpha.
//!
//! # Complexity
//! Pixels with smoke times the deviation in pixels.

use rayon::prelude::*;

use super::{AgeBlur, Image};

/// A pixel on its way: alpha, scatter, the deviation in pixels times alpha, and nothing, so that it is a
/// vector of four.
type Splat = [f32; 4];

/// Deviations where the kernel is cut: what lies beyond is 0.3 % of it.
const CUT: f32 = 3.0;

/// Below this deviation, in pixels, a neighbour's weight is below 2^-24 and the pixel stays as it is.
const SHARP: f32 = 0.17;

/// Blurred alpha and scatter.
pub(super) fn blur(
    alpha: &Image<f32>,
    scatter: &Image<f32>,
    age: &Image<f32>,
    parameters: &AgeBlur,
) -> (Image<f32>, Image<f32>) {
    let (width, height) = (alpha.width(), alpha.height());
    let mut splats = Image::filled(width, height, [0.0; 4]);
    splats.pixels_mut().par_iter_mut().with_min_len(1024).enumerate().for_each(|(at, splat)| {
        let [alpha, scatter, age] = [alpha, scatter, age].map(|plane| plane.pixels()[at]);
        let deviation = parameters.deviation(f64::from(age), height) as f32;
        *splat = [alpha, scatter, deviation * alpha, 0.0];
    });
    let rows = spread_rows(&splats, Image::filled(width, height, [0.0; 4]));
    let turned = rows.transposed(splats);
    let columns = spread_rows(&turned, rows);
    let splats = columns.transposed(turned);
    let plane = |value: fn(&Splat) -> f32| {
        let mut plane = Image::filled(width, height, 0.0);
        let pairs = plane.pixels_mut().par_iter_mut().zip(splats.pixels()).with_min_len(4096);
        pairs.for_each(|(pixel, splat)| *pixel = value(splat));
        plane
    };
    (plane(|splat| splat[0]), plane(|splat| splat[1]))
}

/// Every row spread, in the memory of another image.
fn spread_rows(image: &Image<Splat>, memory: Image<Splat>) -> Image<Splat> {
    let width = image.width().max(1);
    let mut result = Image::like(image, memory);
    let rows = result.pixels_mut().par_chunks_mut(width).zip(image.pixels().par_chunks(width));
    rows.for_each_init(Vec::new, |weights, (to, from)| {
        to.fill([0.0; 4]);
        for (at, splat) in from.iter().enumerate() {
            spread(splat, at, to, weights);
        }
    });
    result
}

/// Adds a pixel to its neighbours in a row.
fn spread(splat: &Splat, at: usize, row: &mut [Splat], weights: &mut Vec<f32>) {
    if splat[0] <= 0.0 {
        return;
    }
    let deviation = splat[2] / splat[0];
    if deviation.is_nan() || deviation < SHARP {
        add(&mut row[at], splat, 1.0);
        return;
    }
    let reach = (deviation * CUT).ceil() as usize;
    gaussian(deviation, reach, weights);
    let (left, right) = (at.saturating_sub(reach), (at + reach).min(row.len() - 1));
    let weights = &weights[left + reach - at..=right + reach - at];
    let part = 1.0 / weights.iter().sum::<f32>();
    let whole = splat.map(|value| value * part);
    for (pixel, &weight) in row[left..=right].iter_mut().zip(weights) {
        add(pixel, &whole, weight);
    }
}

#[inline]
fn add(pixel: &mut Splat, splat: &Splat, weight: f32) {
    for k in 0..4 {
        pixel[k] += weight * splat[k];
    }
}

/// `exp(-k^2 / (2 d^2))` for k from `-reach` to `reach`, by products: each is the last times a factor that
/// itself falls by a constant one.
fn gaussian(deviation: f32, reach: usize, weights: &mut Vec<f32>) {
    let half = 0.5 / (f64::from(deviation) * f64::from(deviation));
    let mut factor = libm::exp(-half);
    let ratio = factor * factor;
    let mut weight = 1.0;
    weights.clear();
    weights.resize(2 * reach + 1, 0.0);
    for k in 0..=reach {
        weights[reach + k] = weight as f32;
        weights[reach - k] = weight as f32;
        weight *= factor;
        factor *= ratio;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_those_of_a_gaussian() {
        let mut weights = Vec::new();
        gaussian(7.5, 30, &mut weights);
        assert_eq!(weights.len(), 61);
        for (k, &weight) in weights.iter().enumerate() {
            let exact = libm::exp(-((k as f64 - 30.0) / 7.5).powi(2) / 2.0);
            assert!((f64::from(weight) - exact).abs() < 1e-7, "{k}: {weight} {exact}");
        }
    }

    #[test]
    fn energy_stays_and_a_pixel_becomes_a_gaussian() {
        let plane = |value: f32| Image::filled(65, 49, value);
        let (mut alpha, mut scatter, mut age) = (plane(0.0), plane(0.0), plane(0.0));
        (*alpha.at_mut(32, 24), *scatter.at_mut(32, 24), *age.at_mut(32, 24)) = (0.8, 0.4, 4.0);
        let (blurred, lit) = blur(&alpha, &scatter, &age, &AgeBlur::new(0.02));
        let deviation = (0.025_f64).min(0.04) * 49.0;
        for (x, y) in [(32, 24), (33, 24), (30, 26)] {
            let square = (x as f64 - 32.0).powi(2) + (y as f64 - 24.0).powi(2);
            let ratio = f64::from(*blurred.at(x, y) / *blurred.at(32, 24));
            assert!((ratio - libm::exp(-square / (2.0 * deviation * deviation))).abs() < 1e-6);
        }
        let sum = |image: &Image<f32>| image.pixels().iter().map(|&p| f64::from(p)).sum::<f64>();
        assert!((sum(&blurred) - 0.8).abs() < 1e-6 && (sum(&lit) - 0.4).abs() < 1e-6);
        // The same in the corner, where most of the kernel is beside the image.
        (*alpha.at_mut(32, 24), *scatter.at_mut(32, 24)) = (0.0, 0.0);
        (*alpha.at_mut(0, 48), *age.at_mut(0, 48)) = (0.5, 9.0);
        let (blurred, _) = blur(&alpha, &scatter, &age, &AgeBlur::new(0.02));
        assert!((sum(&blurred) - 0.5).abs() < 1e-6);
        // Young smoke stays.
        assert!(blur(&alpha, &scatter, &plane(0.0), &AgeBlur::new(0.02)) == (alpha, scatter));
    }
}
