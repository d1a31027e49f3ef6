//! Light along a ray: transmittance, single scattering, and the age of what is seen.
//!
//! # What it computes
//! For a ray with optical depth `t(s)` at the place `s`, and the share `v(s)` of the light that arrives there
//! through smoke and solids:
//! ```text
//!   alpha   = 1 - exp(-t(end))                        what the smoke hides
//!   scatter = integral of exp(-t(s)) v(s) dt(s)       what light reaches the eye after one scattering, if nothing is absorbed
//!   age     = mean over the length of the ray inside  linear between crossings
//! ```
//! So 0 <= scatter <= alpha <= 1, with scatter = alpha where nothing shadows.
//!
//! # What it promises
//! Alpha and age are exact up to rounding for the crossings. Scatter is exact where `v` is linear between
//! samples: each step has its exact weight `exp(-t) - exp(-(t + dt))`, and its sample is taken where the mean
//! of the place by that weight is. A step with the edge of a shadow of a solid in it is divided there, and
//! where the shadow texture does not do a step has its exact mean.
//!
//! # Method
//! Steps are of one length in each stretch, at most a voxel, at most a given optical depth. Light from beyond
//! a given optical depth no longer gets samples of its own.

use glam::DVec3;

use super::RenderParameters;
use super::exponential::exp_of_minus;
use super::resolve::Stretch;
use super::shadow::{LANES, Scratch, Shadow, centre};

/// What the eye sees through smoke that lets less than this share of the light pass has the light of the
/// texture, rough or not.
const FAINT: f64 = 1.0 / 256.0;

/// What a ray meets on its way, as far as it has been followed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Travelled {
    optical_depth: f64,
    /// The share of the light from beyond that comes through: `exp(-optical_depth)`.
    clear: f64,
    scatter: f64,
    length: f64,
    age_times_length: f64,
    /// The share of the light at the last sample.
    light: f32,
}

/// A ray in the lattice of the shadow texture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    /// Where it begins, and how far it goes for each unit of depth.
    pub(super) origin: [f64; 3],
    pub(super) direction: [f64; 3],
    /// Optical depth of smoke of density 1 for each unit of depth.
    pub(super) optical_depth: f64,
}

impl Ray {
    fn at(&self, depth: f64) -> DVec3 {
        DVec3::from_array(self.origin) + depth * DVec3::from_array(self.direction)
    }
}

/// How finely rays are sampled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sampling {
    optical_step: f64,
    /// Optical depth from which on there are no samples.
    deep: f64,
}

impl Sampling {
    pub(super) fn new(parameters: &RenderParameters) -> Self {
        Self { optical_step: parameters.optical_step, deep: -libm::log(parameters.dark) }
    }
}

impl Travelled {
    /// At the eye.
    pub(super) fn start() -> Self {
        Self { optical_depth: 0.0, clear: 1.0, scatter: 0.0, length: 0.0, age_times_length: 0.0, light: 0.0 }
    }

    pub(super) fn alpha(&self) -> f64 {
        -libm::expm1(-self.optical_depth)
    }

    pub(super) fn scatter(&self) -> f64 {
        self.scatter
    }

    /// 0 where there is no smoke.
    pub(super) fn age(&self) -> f64 {
        if self.length > 0.0 { self.age_times_length / self.length } else { 0.0 }
    }

    /// Goes on through a stretch of smoke.
    pub(super) fn pass(
        &mut self,
        stretch: &Stretch,
        ray: &Ray,
        shadow: &Shadow,
        sampling: &Sampling,
        scratch: &mut Scratch,
    ) {
        let length = stretch.far - stretch.near;
        self.length += length;
        self.age_times_length += length * stretch.age;
        let optical_depth = ray.optical_depth * stretch.density * length;
        let (front, sampled) = (self.clear, optical_depth.min(sampling.deep - self.optical_depth));
        let mut unsampled = front;
        if sampled > 0.0 {
            let far = stretch.near + length * (sampled / optical_depth);
            self.scatter += front * self.sample([stretch.near, far], sampled, ray, shadow, sampling, scratch);
            unsampled = front * libm::exp(-sampled);
        }
        self.clear = unsampled;
        if sampled < optical_depth {
            self.clear = libm::exp(-(self.optical_depth + optical_depth));
            self.scatter += (unsampled - self.clear).max(0.0) * f64::from(self.light);
        }
        self.optical_depth += optical_depth;
    }

    /// The scattered light between two depths with smoke of an optical depth between them, as seen from the
    /// first.
    fn sample(
        &mut self,
        [near, far]: [f64; 2],
        optical_depth: f64,
        ray: &Ray,
        shadow: &Shadow,
        sampling: &Sampling,
        scratch: &mut Scratch,
    ) -> f64 {
        let length = far - near;
        // No stretch is longer than the lattice, but by rounding where it is a speck for the eye.
        let [nx, ny, nz] = shadow.lattice().size;
        let voxels = length * ray.direction.iter().map(|d| d * d).sum::<f64>().sqrt();
        let voxels = voxels.min((nx + ny + nz) as f64);
        let steps = (optical_depth / sampling.optical_step).max(voxels).ceil().max(1.0);
        let (step, depth_step) = (optical_depth / steps, length / steps);
        let first = near + centre(step) * depth_step;
        let start = [0, 1, 2].map(|k| (ray.origin[k] + first * ray.direction[k]) as f32);
        let stride = [0, 1, 2].map(|k| (depth_step * ray.direction[k]) as f32);
        let passed = exp_of_minus(step as f32);
        let (mut sum, mut weight) = (0.0_f32, 1.0_f32);
        let steps = steps as u32;
        for block in (0..steps).step_by(LANES) {
            let mut at = [[0.0; LANES]; 3];
            for (axis, places) in at.iter_mut().enumerate() {
                for (lane, place) in places.iter_mut().enumerate() {
                    *place = start[axis] + (block + lane as u32) as f32 * stride[axis];
                }
            }
            let (mut lights, rough) = shadow.transmittances(&at);
            let count = ((steps - block) as usize).min(LANES);
            if shadow.has_solids() || rough.contains(&true) {
                let mut seen = self.clear * f64::from(weight);
                for ((at, light), rough) in (block..).zip(&mut lights[..count]).zip(rough) {
                    let careful = rough && seen > FAINT;
                    if careful || shadow.has_solids() {
                        let ends = [at, at + 1].map(|k| ray.at(near + f64::from(k) * depth_step));
                        *light = shadow.mean(ends, step, (*light, careful), scratch);
                    }
                    seen *= f64::from(passed);
                }
            }
            for &light in &lights[..count] {
                sum += weight * light;
                weight *= passed;
                self.light = light;
            }
        }
        -libm::expm1(-step) * f64::from(sum)
    }
}
