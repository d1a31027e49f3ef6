//! Smooth noise with an exact gradient: [`GradientNoise`], and sums of it: [`FractalNoise`].
//!
//! # What it computes
//! Gradient noise \[Perlin02\]: each point of the integer lattice has a gradient `g`, one of the twelve from the middle of a cube to its
//! edges, drawn by a hash of the point and a seed. In a cell with the point at `(x, y, z)` in it,
//! ```text
//! noise = sum over the 8 corners c of  w(x, c_x) w(y, c_y) w(z, c_z)  g_c . (p - c)
//! w(t, 1) = 6 t^5 - 15 t^4 + 10 t^3,    w(t, 0) = 1 - w(t, 1)
//! ```
//!
//! # What it promises
//! * Value and gradient are those of the formula up to rounding; second derivatives are continuous, because the first and second derivative
//!   of `w` are zero at 0 and 1. So a curl of such fields is free of divergence and smooth.
//! * Zero at lattice points, and at most [`NOISE_BOUND`] in magnitude.
//! * The same bits on every machine.
//!
//! # What it does not promise
//! Statistical independence of lattice points beyond what the mixing function gives; features that are the same in all directions.
//!
//! # Method
//! The bound: the weights sum to one, `g` has length `sqrt 2`, and the weighted mean of `(p - c)_x^2` is at most
//! `t^2 + w(t, 1) (1 - 2t) <= t - t^2 <= 1/4` for `t <= 1/2`, and by symmetry beyond. So by the inequality of Cauchy and Schwarz
//! the value is at most `sqrt 2 sqrt(3/4)`.
//!
//! The hash adds multiples of the coordinates by odd constants to the seed and mixes by the finalizer of \[Steele14\].

use glam::DVec3;

use crate::field::error::{require, require_length};
use crate::field::{FieldError, ScalarField};

/// The largest magnitude that [`GradientNoise`] can have: `sqrt(3/2)`. Measured maxima are just above 1.
pub const NOISE_BOUND: f64 = 1.224_744_871_391_589_1;

/// Noise of cells of side one.
///
/// ```
/// use welter_meshing::{DVec3, field::{GradientNoise, ScalarField}};
/// let noise = GradientNoise { seed: 7 };
/// let (value, gradient) = noise.at(DVec3::new(0.25, 1.5, -3.75));
/// assert!(value.abs() < 1.0 && gradient.is_finite());
/// assert_eq!(noise.value(DVec3::new(3.0, -2.0, 0.0)), 0.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GradientNoise {
    /// Which of the noises. Default: 0.
    pub seed: u64,
}

impl GradientNoise {
    /// The value and its gradient at a point.
    #[must_use]
    pub fn at(&self, point: DVec3) -> (f64, DVec3) {
        let first = point.floor();
        let inside = point - first;
        let cell = first.to_array().map(|c| c as i64);
        let [x, y, z] = inside.to_array().map(Fade::at);
        let (mut value, mut gradient) = (0.0, DVec3::ZERO);
        for corner in 0..8_u8 {
            let far = [corner & 1, corner >> 1 & 1, corner >> 2 & 1];
            let g = self.lattice_gradient(std::array::from_fn(|k| cell[k].wrapping_add(i64::from(far[k]))));
            let along = g.dot(inside - DVec3::from_array(far.map(f64::from)));
            let [(wx, dx), (wy, dy), (wz, dz)] = [x.of(far[0]), y.of(far[1]), z.of(far[2])];
            let weight = wx * wy * wz;
            value += weight * along;
            gradient += weight * g + along * DVec3::new(dx * wy * wz, wx * dy * wz, wx * wy * dz);
        }
        (value, gradient)
    }

    /// The gradient at a point of the lattice.
    fn lattice_gradient(&self, [x, y, z]: [i64; 3]) -> DVec3 {
        // Odd, so that each coordinate alone is mapped one to one: 2^64 over the golden ratio, sqrt 2 and sqrt 3.
        const FACTORS: [u64; 3] = [0x9e37_79b9_7f4a_7c15, 0xb504_f333_f9de_6485, 0x93cd_3a2c_8198_e269];
        let mut hash = mixed(self.seed ^ FACTORS[0]);
        for (coordinate, factor) in [x, y, z].into_iter().zip(FACTORS) {
            hash = mixed(hash.wrapping_add((coordinate as u64).wrapping_mul(factor)));
        }
        // The upper half times 12: each of the twelve edges up to 2^-28 equally often.
        let edge = ((hash >> 32) * 12) >> 32;
        let (axis, signs) = ((edge >> 2) as usize, edge & 3);
        let mut g = DVec3::ZERO;
        g[(axis + 1) % 3] = if signs & 1 == 0 { 1.0 } else { -1.0 };
        g[(axis + 2) % 3] = if signs & 2 == 0 { 1.0 } else { -1.0 };
        g
    }
}

/// Mixes 64 bits so that each bit of the result depends on all \[Steele14\].
fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The weight of the far corner along an axis and its derivative.
#[derive(Clone, Copy)]
struct Fade {
    weight: f64,
    slope: f64,
}

impl Fade {
    fn at(t: f64) -> Self {
        let back = t - 1.0;
        Self { weight: t * t * t * (t * (t * 6.0 - 15.0) + 10.0), slope: 30.0 * t * t * back * back }
    }

    /// Weight and derivative for the far (1) or near corner.
    fn of(self, far: u8) -> (f64, f64) {
        if far == 1 { (self.weight, self.slope) } else { (1.0 - self.weight, -self.slope) }
    }
}

impl ScalarField for GradientNoise {
    fn value(&self, point: DVec3) -> f64 {
        self.at(point).0
    }

    fn gradient(&self, point: DVec3, _step: f64) -> DVec3 {
        self.at(point).1
    }
}

/// A sum of noises, each finer and weaker than the one before, whose amplitudes sum to one.
///
/// ```
/// use welter_meshing::{DVec3, field::{FractalNoise, ScalarField}};
/// let noise = FractalNoise { wavelength: 0.5, octaves: 4, ..FractalNoise::default() };
/// assert!(noise.value(DVec3::new(0.1, 0.2, 0.3)).abs() < 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FractalNoise {
    /// Which of the noises; each octave has its own. Default: 0.
    pub seed: u64,
    /// Side of the cells of the first octave, a positive length. Default: 1.
    pub wavelength: f64,
    /// Number of noises, 1 to 32. Default: 1.
    pub octaves: u32,
    /// Amplitude of an octave over that of the one before, in (0, 1]. Default: 0.5 (slopes of all octaves are equal).
    pub gain: f64,
    /// Wavelength of an octave over that of the next, in [1, 16]. Default: 2.
    pub lacunarity: f64,
}

impl Default for FractalNoise {
    fn default() -> Self {
        Self { seed: 0, wavelength: 1.0, octaves: 1, gain: 0.5, lacunarity: 2.0 }
    }
}

/// Most octaves: beyond, with factors of two, cells are finer than the digits of the first one's coordinates.
const MAX_OCTAVES: u32 = 32;

impl FractalNoise {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`FieldError`] with the first that is not.
    pub fn validate(&self) -> Result<(), FieldError> {
        require_length("wavelength", self.wavelength)?;
        let octaves = (1..=MAX_OCTAVES).contains(&self.octaves);
        require(octaves, "octaves", f64::from(self.octaves), "1 to 32")?;
        require(self.gain > 0.0 && self.gain <= 1.0, "gain", self.gain, "above 0 and at most 1")?;
        require((1.0..=16.0).contains(&self.lacunarity), "lacunarity", self.lacunarity, "1 to 16")
    }

    /// The value and its gradient at a point.
    #[must_use]
    pub fn at(&self, point: DVec3) -> (f64, DVec3) {
        let (mut value, mut gradient, mut sum) = (0.0, DVec3::ZERO, 0.0);
        let (mut amplitude, mut frequency) = (1.0, 1.0 / self.wavelength);
        for octave in 0..self.octaves.min(MAX_OCTAVES) {
            let noise = GradientNoise { seed: mixed(self.seed.wrapping_add(u64::from(octave) << 32)) };
            let (v, g) = noise.at(point * frequency);
            value += amplitude * v;
            gradient += amplitude * frequency * g;
            sum += amplitude;
            amplitude *= self.gain;
            frequency *= self.lacunarity;
        }
        if sum == 0.0 { (0.0, DVec3::ZERO) } else { (value / sum, gradient / sum) }
    }
}

impl ScalarField for FractalNoise {
    fn value(&self, point: DVec3) -> f64 {
        self.at(point).0
    }

    fn gradient(&self, point: DVec3, _step: f64) -> DVec3 {
        self.at(point).1
    }
}
