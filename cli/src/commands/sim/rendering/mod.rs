//! Smoke as a volume in pictures: the table `[render]` of a scene, and the pictures of its frames.
//!
//! Map: [`RenderSpec`] is what the scene says; [`camera`] finds where the eye stands for the whole run, [`studio`] holds what is the same
//! in all frames and makes pictures, [`files`] writes their planes.

mod camera;
mod files;
mod studio;

pub(super) use studio::Studio;

use crate::codes::Code;
use crate::failure::Failure;
use crate::machine;
use crate::numbers;
use crate::render::MAX_SIDE;
use crate::runs::settings::{ANY, FINITE, POSITIVE, Settings};
use camera::CameraSpec;
use files::{ColorBits, PLANES, Plane};
use glam::DVec3;
use std::path::Path;
use welter_fluids::smoke::{FogLayer, FogLayerError};
use welter_fluids::volume_rendering::{
    AgeBlur, InteriorRule, Light, MAX_VOXELS, Medium, RenderError, RenderParameters,
};

/// What a scene says of its pictures.
#[derive(Clone, Debug)]
pub(super) struct RenderSpec {
    frames: Selection,
    parameters: RenderParameters,
    camera: CameraSpec,
    light: Light,
    medium: Medium,
    background: [f64; 3],
    /// Of open sheets.
    layer: Option<FogLayer>,
    /// The age that is white in PNG.
    age_white: f64,
    png: Vec<Plane>,
    exr: Vec<Plane>,
    color_bits: ColorBits,
    /// 16 bits a number in EXR.
    half: bool,
}

/// Which frames have pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Selection {
    first: u64,
    last: u64,
    every: u64,
}

impl Selection {
    fn contains(self, frame: u64) -> bool {
        (self.first..=self.last).contains(&frame) && (frame - self.first).is_multiple_of(self.every)
    }
}

/// A format of the files of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
}

const FORMATS: [(&str, Format); 2] = [("png", Format::Png), ("exr", Format::Exr)];

const INTERIORS: [(&str, InteriorRule); 4] = [
    ("non-zero", InteriorRule::NonZero),
    ("positive", InteriorRule::Positive),
    ("odd", InteriorRule::Odd),
    ("multiplicity", InteriorRule::Multiplicity),
];

impl RenderSpec {
    /// What the table says; `given` if there is one, `end` is the time at the end of the scene. None if there are to be no pictures.
    pub(super) fn read(
        table: &mut Settings<'_>,
        given: bool,
        end: f64,
    ) -> Result<Option<Self>, Box<Failure>> {
        let enabled = table.flag("enabled", given)?;
        let default = RenderParameters::default();
        let [width, height] = table.size("size", [default.width, default.height], [1, MAX_SIDE])?;
        let first = table.whole("first_frame", 0, 0)?;
        let last = table.optional_whole("last_frame", first)?.unwrap_or(u64::MAX);
        let frames = Selection { first, last, every: table.whole("every_frame", 1, 1)? };
        // One over the length after which 1/e of the light is left: no length of a scene would do for all.
        let extinction = if enabled {
            table.number("extinction", None, FINITE)?
        } else {
            table.optional_number("extinction", FINITE)?.unwrap_or(0.0)
        };
        let medium = Medium {
            extinction,
            albedo: table.vector("albedo", DVec3::ONE)?.to_array(),
            interior: table.choice("interior", &INTERIORS)?,
        };
        medium.validate().map_err(|error| {
            let key = if error.to_string().contains("albedo") { "albedo" } else { "extinction" };
            table.bad(key, error.to_string())
        })?;
        let background = table.vector("background", DVec3::ZERO)?.to_array();
        require_color(table, "background", background)?;
        let layer = match table.optional_number("layer_thickness", POSITIVE)? {
            Some(thickness) => {
                Some(FogLayer { thickness, direction: table.optional_vector("layer_direction")? })
            }
            None if table.has("layer_direction") => {
                return Err(table
                    .bad("layer_direction", "a thickness belongs to it")
                    .help("layer_thickness = 0.2"));
            }
            None => None,
        };
        if let Some(Err(error)) = layer.as_ref().map(FogLayer::validate) {
            let key = match error {
                FogLayerError::Direction { .. } => "layer_direction",
                _ => "layer_thickness",
            };
            return Err(table.bad(key, error.to_string()));
        }
        let parameters = RenderParameters {
            width,
            height,
            shadow_resolution: table.small("shadow_resolution", default.shadow_resolution, 1)?,
            traced_triangles: table.small("traced_triangles", default.traced_triangles, 0)?,
            optical_step: table.number("optical_step", default.optical_step, ANY)?,
            dark: table.number("dark", default.dark, ANY)?,
            age_blur: table.optional_table("age_blur", read_age_blur)?,
        };
        parameters.validate().map_err(|error| {
            let key = match error {
                RenderError::Parameter { name, .. } => name,
                _ => "size",
            };
            table.bad(key, error.to_string())
        })?;
        let age_white = table.number("age_white", end, POSITIVE)?;
        let color_bits =
            table.choice("png_colors", &[("8-bit", ColorBits::Eight), ("16-bit", ColorBits::Sixteen)])?;
        let half = table.choice("exr_numbers", &[("32-bit", false), ("16-bit", true)])?;
        let light = table.table("light", read_light)?;
        let camera = table.table("camera", CameraSpec::read)?;
        let (png, exr) = table.table("planes", read_planes)?;
        let spec = Self {
            frames,
            parameters,
            camera,
            light,
            medium,
            background,
            layer,
            age_white,
            png,
            exr,
            color_bits,
            half,
        };
        Ok(enabled.then_some(spec))
    }

    /// Refuses pictures that would take more memory than there is.
    pub(super) fn require_memory(&self, scene: &Path) -> Result<(), Box<Failure>> {
        let (width, height) = (u64::from(self.parameters.width), u64::from(self.parameters.height));
        // Planes 36 bytes a pixel, blur 40 more, files of numbers twice that of their planes; 12 a voxel.
        let blur = if self.parameters.age_blur.is_some() { 40 } else { 0 };
        let files = 8 * (self.exr.len() + self.png.len()) as u64;
        let voxels = u64::from(self.parameters.shadow_resolution).pow(3).min(MAX_VOXELS);
        let needed = width * height * (36 + blur + files) + 12 * voxels;
        match machine::available_memory().filter(|&free| needed > free) {
            None => Ok(()),
            Some(free) => {
                let what = format!(
                    "pictures of {width} x {height} pixels may take {}, and {} are free",
                    numbers::bytes(needed),
                    numbers::bytes(free)
                );
                Err(Failure::new(Code::OverMemory, what)
                    .subject(scene.display().to_string())
                    .help("--set render.size=[960,540] --set render.shadow_resolution=128"))
            }
        }
    }
}

fn read_age_blur(table: &mut Settings<'_>) -> Result<AgeBlur, Box<Failure>> {
    let spread_rel = table.number("spread_rel", None, ANY)?;
    let most_rel = table.number("most_rel", AgeBlur::new(spread_rel).most_rel, ANY)?;
    let blur = AgeBlur { spread_rel, most_rel };
    blur.validate().map_err(|error| {
        let key = match error {
            RenderError::Parameter { name, .. } => name,
            _ => "spread_rel",
        };
        table.bad(key, error.to_string())
    })?;
    Ok(blur)
}

fn read_light(table: &mut Settings<'_>) -> Result<Light, Box<Failure>> {
    let default = Light::default();
    let light = Light {
        // From above, the front and the left of a camera at the default azimuth, with z upward.
        direction: table.vector("direction", DVec3::new(0.0, 1.0, -1.5))?,
        radiance: table.vector("radiance", DVec3::from_array(default.radiance))?.to_array(),
        ambient: table.vector("ambient", DVec3::from_array(default.ambient))?.to_array(),
    };
    light.validate().map_err(|error| {
        let what = error.to_string();
        let key = ["radiance", "ambient"].into_iter().find(|key| what.contains(key)).unwrap_or("direction");
        table.bad(key, what)
    })?;
    Ok(light)
}

/// The planes that are written as PNG, and those that are written as EXR.
fn read_planes(table: &mut Settings<'_>) -> Result<(Vec<Plane>, Vec<Plane>), Box<Failure>> {
    let (mut png, mut exr) = (Vec::new(), Vec::new());
    for (name, plane) in PLANES {
        let default: &[usize] = if plane == Plane::Composite { &[0] } else { &[] };
        let formats = table.choices(name, default, &FORMATS)?;
        if formats.contains(&Format::Png) {
            png.push(plane);
        }
        if formats.contains(&Format::Exr) {
            exr.push(plane);
        }
    }
    Ok((png, exr))
}

/// Refuses a colour that the renderer would refuse.
pub(super) fn require_color(
    table: &Settings<'_>,
    key: &'static str,
    color: [f64; 3],
) -> Result<(), Box<Failure>> {
    const MOST: f64 = (1_u64 << 40) as f64;
    if color.iter().all(|c| (0.0..=MOST).contains(c)) {
        return Ok(());
    }
    Err(table.bad(key, format!("`{key}` is {color:?}, and red, green and blue from 0 to {MOST} are wanted")))
}
