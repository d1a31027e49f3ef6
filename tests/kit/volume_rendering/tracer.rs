//! Pixels by rays: single scattering with shadows, marched in small steps.

use super::rays::{self, Hit, winding_at};
use glam::DVec3;
use welter_fluids::volume_rendering::{InteriorRule, Scene};
use welter_meshing::surface::{TriId, TriMesh};

/// A scene as lists of triangles.
pub struct Tracer<'a> {
    scene: &'a Scene<'a>,
    smoke: Vec<[DVec3; 3]>,
    solids: Vec<[DVec3; 3]>,
    albedos: Vec<[f64; 3]>,
    to_light: DVec3,
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    /// Share of what is behind that is hidden.
    pub alpha: f64,
    /// Light scattered once, of radiance 1.
    pub scatter: f64,
    /// Mean age over the length inside.
    pub age: f64,
    /// Solid or background behind the smoke.
    pub backdrop: [f64; 3],
    /// Everything.
    pub composite: [f64; 3],
}

fn corners(mesh: &TriMesh) -> Vec<[DVec3; 3]> {
    (0..mesh.triangles().len()).map(|t| mesh.corners(TriId::from_index(t))).collect()
}

impl<'a> Tracer<'a> {
    /// All triangles of the scene.
    #[must_use]
    pub fn new(scene: &'a Scene<'a>) -> Self {
        let solids: Vec<Vec<[DVec3; 3]>> = scene.solids.iter().map(|solid| corners(solid.mesh)).collect();
        let albedos = scene.solids.iter().zip(&solids);
        Self {
            scene,
            smoke: corners(scene.smoke),
            albedos: albedos.flat_map(|(solid, list)| vec![solid.albedo; list.len()]).collect(),
            solids: solids.concat(),
            to_light: -scene.light.direction.normalize(),
        }
    }

    /// The density where the surface winds around a place so often.
    fn density(&self, winding: i32) -> f64 {
        match self.scene.medium.interior {
            InteriorRule::NonZero => f64::from(u8::from(winding != 0)),
            InteriorRule::Positive => f64::from(u8::from(winding > 0)),
            InteriorRule::Odd => f64::from(winding.rem_euclid(2)),
            InteriorRule::Multiplicity => f64::from(winding.abs()),
        }
    }

    /// Length of smoke, times density, between a point and the light.
    fn length_to_light(&self, point: DVec3) -> f64 {
        let hits = rays::crossings(&self.smoke, point, self.to_light);
        let places: Vec<f64> =
            std::iter::once(0.0).chain(hits.iter().map(|h| h.t).filter(|&t| t > 0.0)).collect();
        let part =
            |pair: &[f64]| (pair[1] - pair[0]) * self.density(winding_at(&hits, 0.5 * (pair[0] + pair[1])));
        places.windows(2).map(part).sum()
    }

    /// The share of the light that arrives at a point of the smoke.
    fn lit(&self, point: DVec3) -> f64 {
        if rays::meets(&self.solids, point, self.to_light) {
            return 0.0;
        }
        (-self.scene.medium.extinction * self.length_to_light(point)).exp()
    }

    /// The direction from the eye through the middle of a pixel, of length 1.
    #[must_use]
    pub fn ray(&self, [width, height]: [u32; 2], [x, y]: [u32; 2]) -> DVec3 {
        let camera = self.scene.camera;
        let forward = (camera.target - camera.eye).normalize();
        let right = forward.cross(camera.up).normalize();
        let up = right.cross(forward);
        let half = (0.5 * camera.vertical_field_of_view).tan();
        let across = (f64::from(x) + 0.5 - 0.5 * f64::from(width)) / (0.5 * f64::from(height)) * half;
        let upward = (0.5 * f64::from(height) - f64::from(y) - 0.5) / (0.5 * f64::from(height)) * half;
        (forward + across * right + upward * up).normalize()
    }

    /// Crossings with the smoke along the ray of a pixel, behind the eye too.
    #[must_use]
    pub fn crossings(&self, size: [u32; 2], pixel: [u32; 2]) -> Vec<Hit> {
        rays::crossings(&self.smoke, self.scene.camera.eye, self.ray(size, pixel))
    }

    fn age_of(&self, hit: &Hit) -> f64 {
        let triangle = self.scene.smoke.triangles()[hit.triangle];
        (0..3)
            .map(|k| hit.weights[k] * self.scene.ages.get(triangle[k].index()).copied().unwrap_or(0.0))
            .sum()
    }

    /// A pixel, with so many steps in each stretch of smoke.
    #[must_use]
    pub fn pixel(&self, size: [u32; 2], pixel: [u32; 2], steps: u32) -> Seen {
        let (eye, ray) = (self.scene.camera.eye, self.ray(size, pixel));
        let solid = rays::first(&self.solids, eye, ray);
        let end = solid.map_or(f64::INFINITY, |hit| hit.t);
        let hits = rays::crossings(&self.smoke, eye, ray);
        let mut places: Vec<(f64, f64)> =
            hits.iter().filter(|hit| hit.t > 0.0).map(|hit| (hit.t, self.age_of(hit))).collect();
        if let Some(&(_, age)) = places.first() {
            places.insert(0, (0.0, age));
        }
        let sigma = self.scene.medium.extinction;
        let (mut depth, mut scatter, mut length, mut age) = (0.0_f64, 0.0, 0.0, 0.0);
        for pair in places.windows(2) {
            let ((from, from_age), (to, to_age)) = (pair[0], pair[1]);
            let density = self.density(winding_at(&hits, 0.5 * (from + to)));
            let far = to.min(end);
            if density == 0.0 || far <= from {
                continue;
            }
            let step = (far - from) / f64::from(steps);
            for k in 0..steps {
                let t = from + (f64::from(k) + 0.5) * step;
                let through = sigma * density * step;
                scatter += (-depth - 0.5 * through).exp() * through * self.lit(eye + t * ray);
                depth += through;
                length += step;
                age += step * (from_age + (to_age - from_age) * (t - from) / (to - from));
            }
        }
        let alpha = 1.0 - (-depth).exp();
        let age = if length > 0.0 { age / length } else { 0.0 };
        let backdrop = solid.map_or(self.scene.background, |hit| self.shade(&hit, eye, ray));
        let composite = [0, 1, 2].map(|k| {
            let light = self.scene.light.radiance[k] * scatter + self.scene.light.ambient[k] * alpha;
            self.scene.medium.albedo[k] * light + (1.0 - alpha) * backdrop[k]
        });
        Seen { alpha, scatter, age, backdrop, composite }
    }

    fn shade(&self, hit: &Hit, eye: DVec3, ray: DVec3) -> [f64; 3] {
        let [a, b, c] = self.solids[hit.triangle];
        let normal = (b - a).cross(c - a).normalize();
        let normal = normal * -normal.dot(ray).signum();
        let point = eye + hit.t * ray + 1e-9 * (a - eye).length() * normal;
        let cosine = normal.dot(self.to_light).max(0.0);
        let direct = if cosine > 0.0 { cosine * self.lit(point) } else { 0.0 };
        let (albedo, light) = (self.albedos[hit.triangle], self.scene.light);
        [0, 1, 2].map(|k| albedo[k] * (light.radiance[k] * direct + light.ambient[k]))
    }
}
