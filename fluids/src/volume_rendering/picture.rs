//! One picture from the scene to the planes: [`render`].

use std::time::Instant;

use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::surface::{ClosedOrientedMesh, TriId};

use super::camera::View;
use super::light_space::Lattice;
use super::pixels::{Planes, Studio};
use super::scattering::Sampling;
use super::shadow::Shadow;
use super::solids::Solids;
use super::{Image, Light, Medium, RenderError, RenderParameters, Scene, blur, composite, project};

/// What is seen, in planes of one size.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Picture {
    /// Share of what is behind that the smoke hides, from 0 to 1.
    pub alpha: Image<f32>,
    /// Light scattered once toward the eye, for light of radiance 1 and smoke of albedo 1; from 0 to alpha.
    pub scatter: Image<f32>,
    /// Mean age along the ray's way through the smoke, in the unit of the ages given; 0 where there is no
    /// smoke.
    pub age: Image<f32>,
    /// Radiance of solids and background behind the smoke (red, green, blue).
    pub backdrop: Image<[f32; 3]>,
    /// Radiance of everything (red, green, blue), with alpha and scatter blurred by age if the parameters ask
    /// for it.
    pub composite: Image<[f32; 3]>,
}

/// What was done for a picture.
#[must_use]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct RenderReport {
    /// Triangles of the smoke's surface, or parts of them, that may cover a pixel.
    pub pieces: usize,
    /// Crossings of all rays with the smoke's surface.
    pub crossings: u64,
    /// Most crossings of one ray.
    pub most_crossings: usize,
    /// Pixels whose ray meets the smoke.
    pub covered_pixels: u64,
    /// Pixels whose ray starts where the winding number is not 0: all of them if the eye is in the smoke,
    /// none if it is outside.
    pub pixels_from_inside: u64,
    /// Voxels of the shadow texture along its axes; zeros if there is no smoke.
    pub shadow_size: [usize; 3],
    /// Seconds that the stages took.
    pub seconds: RenderSeconds,
}

/// Seconds by stage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct RenderSeconds {
    /// Shadow texture, and the columns of triangles that cast shadows.
    pub shadow: f64,
    /// Triangles into the image.
    pub projection: f64,
    /// Crossings, transmittance, scattering, solids.
    pub pixels: f64,
    /// Blur by age and composition.
    pub composition: f64,
    /// Everything.
    pub total: f64,
}

/// The picture of a scene, and what was done for it.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::volume_rendering::{Camera, Light, Medium, RenderParameters, Scene, render};
/// use welter_meshing::{Monitor, shapes::{Sphere, sphere}};
///
/// let ball = sphere(&Sphere { edge_length: 0.2, ..Sphere::default() })?;
/// let scene = Scene {
///     smoke: &ball,
///     ages: &[],
///     solids: &[],
///     camera: Camera::toward(DVec3::new(0.0, 0.0, 8.0), DVec3::ZERO),
///     light: Light::default(),
///     medium: Medium::white(0.5),
///     background: [0.0; 3],
/// };
/// let parameters = RenderParameters { width: 65, height: 65, shadow_resolution: 32, ..Default::default() };
/// let (picture, report) = render(&scene, &parameters, &Monitor::none())?;
/// // Through the middle of a ball of radius 1 the optical depth is 0.5 times 2.
/// assert!((picture.alpha.at(32, 32) - (1.0 - (-1.0_f32).exp())).abs() < 0.01);
/// assert!(picture.scatter.at(32, 32) < picture.alpha.at(32, 32));
/// assert_eq!((report.most_crossings, report.pixels_from_inside), (2, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RenderError`]: parameters or scene out of range, or a cancelled operation.
pub fn render(
    scene: &Scene<'_>,
    parameters: &RenderParameters,
    monitor: &Monitor<'_>,
) -> Result<(Picture, RenderReport), RenderError> {
    parameters.validate()?;
    scene.validate()?;
    let start = Instant::now();
    let smoke = scene.smoke;
    let of_solids = scene.solids.iter().flat_map(|solid| solid.mesh.positions());
    let scale = scale_of(smoke.positions().iter().chain(of_solids).chain([&scene.camera.eye]));
    let positions: Vec<DVec3> = smoke.positions().iter().map(|&p| p * scale).collect();
    let extinction = (scene.medium.extinction / scale).min(f64::MAX);

    let stage = monitor.stage("shadow texture", 1);
    let shadow = shadow(scene, parameters, &positions, scale, extinction)?;
    let shadow_size = shadow.lattice().size;
    stage.advance(1);
    monitor.check()?;
    let shadow_end = start.elapsed().as_secs_f64();

    let view = View::new(&scene.camera, scale, [parameters.width, parameters.height])?;
    let corners = |t: usize| smoke.triangles()[t].map(|v| v.0);
    let pieces = project::project(&view, &positions, scene.ages, corners, smoke.triangles().len());
    let solids = Solids::new(scene, &view, scale);
    let projection_end = start.elapsed().as_secs_f64();

    let studio = Studio {
        view,
        pieces,
        solids,
        shadow,
        extinction,
        rule: scene.medium.interior,
        sampling: Sampling::new(parameters),
        background: scene.background.map(|c| c as f32),
    };
    let (planes, counts) = studio.draw(monitor)?;
    let pixels_end = start.elapsed().as_secs_f64();

    let picture = Picture::of(planes, parameters, &scene.light, &scene.medium);
    let seconds = RenderSeconds::of([shadow_end, projection_end, pixels_end, start.elapsed().as_secs_f64()]);
    let report = RenderReport {
        pieces: studio.pieces.len(),
        crossings: counts.crossings,
        most_crossings: counts.most_crossings,
        covered_pixels: counts.covered,
        pixels_from_inside: counts.inside,
        shadow_size,
        seconds,
    };
    Ok((picture, report))
}

impl Picture {
    /// The planes with their composite, blurred by age if asked for.
    pub(super) fn of(planes: Planes, parameters: &RenderParameters, light: &Light, medium: &Medium) -> Self {
        let Planes { alpha, scatter, age, backdrop } = planes;
        let over = |alpha: &Image<f32>, scatter: &Image<f32>| {
            composite::composite(alpha, scatter, &backdrop, light, medium)
        };
        let composite = match &parameters.age_blur {
            None => over(&alpha, &scatter),
            Some(blur) => {
                let (alpha, scatter) = blur::blur(&alpha, &scatter, &age, blur);
                over(&alpha, &scatter)
            }
        };
        Self { alpha, scatter, age, backdrop, composite }
    }
}

impl RenderSeconds {
    /// From the times at which the shadow, the projection, the pixels and all were done, since the beginning.
    pub(super) fn of([shadow, projection, pixels, total]: [f64; 4]) -> Self {
        Self {
            shadow,
            projection: projection - shadow,
            pixels: pixels - projection,
            composition: total - pixels,
            total,
        }
    }
}

/// The power of two by which coordinates are multiplied so that the largest is from 1/2 to 1, as far as there
/// is one.
///
/// So no sum or product of coordinates overflows, and lengths times a power of two give the same numbers.
pub(super) fn scale_of<'p>(points: impl Iterator<Item = &'p DVec3>) -> f64 {
    let largest = points.fold(0.0_f64, |largest, p| largest.max(p.abs().max_element()));
    let (_, exponent) = libm::frexp(largest);
    libm::ldexp(1.0, (-exponent).clamp(-1022, 1023))
}

pub(super) fn corners_of(smoke: &ClosedOrientedMesh, positions: &[DVec3]) -> Vec<[DVec3; 3]> {
    smoke.triangles().iter().map(|t| t.map(|v| positions[v.index()])).collect()
}

fn shadow(
    scene: &Scene<'_>,
    parameters: &RenderParameters,
    positions: &[DVec3],
    scale: f64,
    extinction: f64,
) -> Result<Shadow, RenderError> {
    let corners = corners_of(scene.smoke, positions);
    let light = scene.light.direction;
    let lattice =
        Lattice::enclosing(corners.iter().flatten().copied(), 0.0, light, parameters.shadow_resolution)?;
    let triangles = |mesh: &welter_meshing::surface::TriMesh| {
        let count = mesh.triangles().len();
        (0..count).map(|t| mesh.corners(TriId::from_index(t)).map(|p| p * scale)).collect::<Vec<_>>()
    };
    let solids: Vec<[DVec3; 3]> = scene.solids.iter().flat_map(|solid| triangles(solid.mesh)).collect();
    let (rule, traced) = (scene.medium.interior, parameters.traced_triangles as usize);
    Ok(Shadow::new(lattice, &corners, &solids, extinction, rule, traced))
}
