//! Pictures as the commands ask for them: options of the command line to a scene, and a scene to a file.

use crate::codes::Code;
use crate::failure::Failure;
use crate::output::{Output, WriteProblem};
use crate::render::{self, Camera, Cut, Image, MAX_SIDE, RenderError, Scene, Up};
use crate::{console::Seconds, machine, numbers, run::Run};
use clap::ValueEnum;

/// Viewpoint, sheet and style.
#[derive(clap::Args, Clone, Debug)]
pub(crate) struct View {
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1200x900", value_parser = parse_size)]
    pub(crate) size: [u32; 2],
    /// From where: degrees around the up axis, degrees above the horizon [default: chosen for the shape]
    #[arg(long, value_name = "AZIMUTH,ELEVATION[,DISTANCE]", value_parser = parse_camera, allow_hyphen_values = true)]
    pub(crate) camera: Option<Camera>,
    /// Axis that points up
    #[arg(long, value_enum, default_value_t = UpAxis::Auto)]
    pub(crate) up: UpAxis,
    /// Remove what lies on the viewer's side of a plane, for example z=0.5
    #[arg(long, value_name = "x|y|z=V", value_parser = parse_cut)]
    pub(crate) cut: Option<Cut>,
    /// Draw the edges of the triangles
    #[arg(long)]
    pub(crate) edges: bool,
    /// One shade a triangle instead of smooth shading
    #[arg(long)]
    pub(crate) flat: bool,
}

/// Which axis points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum UpAxis {
    Auto,
    Y,
    Z,
}

impl View {
    /// Puts the options into a scene.
    pub(crate) fn apply(&self, scene: &mut Scene<'_>) {
        scene.size = self.size;
        scene.camera = self.camera.unwrap_or_default();
        scene.up = match self.up {
            UpAxis::Auto => Up::Automatic,
            UpAxis::Y => Up::Y,
            UpAxis::Z => Up::Z,
        };
        scene.cut = self.cut;
        for layer in &mut scene.layers {
            if self.edges {
                layer.style.edges = Some(render::Edges::default());
            }
            if self.flat {
                layer.style.shading = render::Shading::Flat;
            }
        }
    }
}

pub(crate) fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=MAX_SIDE).contains(side));
    let sides = text.split_once('x').and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| format!("width and height of 1 to {MAX_SIDE} pixels are wanted, such as 1200x900"))
}

pub(crate) fn parse_cut(text: &str) -> Result<Cut, String> {
    let cut = text.split_once('=').and_then(|(axis, value)| {
        let axis = ["x", "y", "z"].iter().position(|name| *name == axis)?;
        Some(Cut { axis, value: value.parse().ok().filter(|value: &f64| value.is_finite())? })
    });
    cut.ok_or_else(|| "an axis and a number are wanted, such as z=0.5".to_owned())
}

pub(crate) fn parse_camera(text: &str) -> Result<Camera, String> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|part| part.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    match numbers.as_deref() {
        Some(&[azimuth, elevation]) => Ok(Camera::Orbit { azimuth, elevation, distance: None }),
        Some(&[azimuth, elevation, distance]) if distance > 0.0 => {
            Ok(Camera::Orbit { azimuth, elevation, distance: Some(distance) })
        }
        _ => Err("two or three numbers are wanted, such as 30,20 or 30,20,5".to_owned()),
    }
}

/// Draws a scene, if the memory it takes is there.
pub(crate) fn draw(scene: &Scene<'_>, run: &Run, seconds: &mut Seconds) -> Result<Image, Box<Failure>> {
    let needed = render::memory_estimate(scene);
    if let Some(free) = machine::available_memory().filter(|&free| needed > free) {
        let what = format!(
            "a picture of {} x {} pixels may take {}, and {} are free",
            scene.size[0],
            scene.size[1],
            numbers::bytes(needed),
            numbers::bytes(free)
        );
        return Err(Failure::new(Code::OverMemory, what).help("--size 1200x900"));
    }
    run.console.stage(seconds, "drawing", || render::render(scene)).map_err(|error| match error {
        RenderError::Parameter { .. } | RenderError::Size { .. } => {
            Failure::new(Code::Usage, error.to_string()).help("welter render --help")
        }
        RenderError::TooManyElements => {
            Failure::new(Code::OverCount, error.to_string()).help("split the file into parts")
        }
        other => Failure::new(Code::OwnBug, other.to_string()).help("send the file to the authors"),
    })
}

/// Writes a picture as PNG.
pub(crate) fn write_png(image: &Image, output: Output) -> Result<(), Box<Failure>> {
    output.write(|file| {
        image.write_png(file).map_err(|error| match error {
            RenderError::Write(error) => WriteProblem::Io(error),
            other => WriteProblem::Failure(Failure::new(Code::OwnBug, other.to_string())),
        })
    })
}

/// Colours that differ well, also for most colour-blind people \[Okabe08\]; they repeat.
pub(crate) fn distinct(k: usize) -> [u8; 3] {
    const COLORS: [[u8; 3]; 7] = [
        [230, 159, 0],
        [86, 180, 233],
        [0, 158, 115],
        [240, 228, 66],
        [0, 114, 178],
        [213, 94, 0],
        [204, 121, 167],
    ];
    COLORS[k % COLORS.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_understood() {
        assert_eq!(parse_size("640x480"), Ok([640, 480]));
        assert_eq!(parse_cut("z=-0.5"), Ok(Cut { axis: 2, value: -0.5 }));
        assert_eq!(
            parse_camera("30,-20"),
            Ok(Camera::Orbit { azimuth: 30.0, elevation: -20.0, distance: None })
        );
    }

    #[test]
    fn nonsense_is_refused() {
        for size in ["640", "0x1", "1x0", "99999x1", "-1x5", "axb", "1x2x3"] {
            assert!(parse_size(size).is_err(), "{size}");
        }
        for cut in ["w=1", "x", "x=nan", "x=inf", "=1"] {
            assert!(parse_cut(cut).is_err(), "{cut}");
        }
        for camera in ["", "1", "1,2,0", "1,2,3,4", "nan,0", "1,2,-1"] {
            assert!(parse_camera(camera).is_err(), "{camera}");
        }
    }
}
