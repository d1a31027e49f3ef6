//! Rays through particles of smoke, by the density alone: no column in closed form, no slices, no texture.

use glam::DVec3;
use welter_fluids::volume_rendering::ParticleScene;

/// What a ray sees.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    /// Share of what is behind that is hidden.
    pub alpha: f64,
    /// Light scattered once, of radiance 1.
    pub scatter: f64,
    /// Mean age over the smoke on the ray.
    pub age: f64,
}

/// Density of smoke, and density times age.
fn density(scene: &ParticleScene<'_>, at: DVec3) -> [f64; 2] {
    let h = scene.radius();
    let middle = 105.0 / (32.0 * std::f64::consts::PI * h.powi(3)) * scene.particle_volume;
    let mut sums = [0.0; 2];
    for (particle, center) in scene.positions.iter().enumerate() {
        let q = at.distance(*center) / h;
        if q < 1.0 {
            let density = middle * (1.0 - q * q).powi(2);
            sums[0] += density;
            sums[1] += density * scene.ages.get(particle).copied().unwrap_or(0.0);
        }
    }
    sums
}

/// Calls `visit` with the middle of each of some steps of a half-line, as far as there may be smoke, and the length of a step.
fn march(
    scene: &ParticleScene<'_>,
    origin: DVec3,
    direction: DVec3,
    steps: u32,
    mut visit: impl FnMut(DVec3, f64),
) {
    let places = || scene.positions.iter().map(|p| (*p - origin).dot(direction));
    let near = (places().fold(f64::INFINITY, f64::min) - scene.radius()).max(0.0);
    let far = places().fold(0.0, f64::max) + scene.radius();
    let length = (far - near) / f64::from(steps);
    for k in 0..steps {
        visit(origin + (near + (f64::from(k) + 0.5) * length) * direction, length);
    }
}

/// The direction of the ray through a pixel, of length 1.
#[must_use]
pub fn direction(scene: &ParticleScene<'_>, size: [u32; 2], pixel: [u32; 2]) -> DVec3 {
    let camera = scene.camera;
    let forward = (camera.target - camera.eye).normalize();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    let half = (0.5 * camera.vertical_field_of_view).tan();
    let from_middle = |k: usize| 2.0 * f64::from(pixel[k]) + 1.0 - f64::from(size[k]);
    let per_pixel = half / f64::from(size[1]);
    (forward + per_pixel * (from_middle(0) * right - from_middle(1) * up)).normalize()
}

/// What the ray of a pixel sees, in steps; each step's light is marched in as many.
#[must_use]
pub fn seen(scene: &ParticleScene<'_>, size: [u32; 2], pixel: [u32; 2], steps: u32, light: bool) -> Seen {
    let extinction = scene.medium.extinction;
    let to_light = -scene.light.direction.normalize();
    let (mut seen, mut sums, mut clear) = (Seen::default(), [0.0; 2], 1.0);
    march(scene, scene.camera.eye, direction(scene, size, pixel), steps, |at, length| {
        let [there, aged] = density(scene, at);
        if there == 0.0 {
            return;
        }
        sums = [sums[0] + length * there, sums[1] + length * aged];
        let beyond = (-extinction * sums[0]).exp();
        if light {
            let mut shadow = 0.0;
            march(scene, at, to_light, steps, |at, length| shadow += length * density(scene, at)[0]);
            seen.scatter += (clear - beyond) * (-extinction * shadow).exp();
        }
        clear = beyond;
    });
    seen.alpha = 1.0 - clear;
    seen.age = if sums[0] > 0.0 { sums[1] / sums[0] } else { 0.0 };
    seen
}
