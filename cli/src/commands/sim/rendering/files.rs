//! Planes of a picture as files: PNG for looking, EXR for numbers.
//!
//! Promises: alpha and scatter are 16 bits of grey, 65535 for 1; age too, 65535 for an age that the scene gives, and for all above. The
//! colours of composite and backdrop have 8 or 16 bits, with the transfer curve of sRGB (IEC 61966-2-1) and marked so; a radiance
//! below 0 is written as 0, one above 1 as 1. EXR holds the numbers as they are, linear: R, G, B for the composite, and channels of the layers
//! alpha, scatter, age (Y) and backdrop (R, G, B); compressed without loss, in 32 bits, or rounded to 16. A channel with a number beyond
//! those of 16 bits, above 65,504, stays at 32 bits, whatever was asked for, as other channels do not. No time, no name of a program: the
//! same picture gives the same bytes.

use crate::render::Rgb;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Layer, LayerAttributes, LineOrder,
    WritableImage, f16,
};
use rayon::prelude::*;
use std::io::{self, Cursor};
use welter_fluids::volume_rendering::{Image, Picture};

/// A plane of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Plane {
    Alpha,
    Scatter,
    Age,
    Backdrop,
    Composite,
}

/// All planes, with their names in scenes and in files.
pub(super) const PLANES: [(&str, Plane); 5] = [
    ("alpha", Plane::Alpha),
    ("scatter", Plane::Scatter),
    ("age", Plane::Age),
    ("backdrop", Plane::Backdrop),
    ("composite", Plane::Composite),
];

/// The name of the file of several planes.
pub(super) const EXR: &str = "planes";

/// Bits a colour in PNG.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ColorBits {
    Eight,
    Sixteen,
}

/// The numbers of a plane.
enum Numbers<'p> {
    Grey(&'p Image<f32>),
    Colors(&'p Image<[f32; 3]>),
}

fn numbers(picture: &Picture, plane: Plane) -> Numbers<'_> {
    match plane {
        Plane::Alpha => Numbers::Grey(&picture.alpha),
        Plane::Scatter => Numbers::Grey(&picture.scatter),
        Plane::Age => Numbers::Grey(&picture.age),
        Plane::Backdrop => Numbers::Colors(&picture.backdrop),
        Plane::Composite => Numbers::Colors(&picture.composite),
    }
}

/// A plane as PNG; ages are white from `age_white` on.
pub(super) fn png(picture: &Picture, plane: Plane, bits: ColorBits, age_white: f64) -> io::Result<Vec<u8>> {
    let white = if plane == Plane::Age { age_white } else { 1.0 };
    let size = [picture.alpha.width(), picture.alpha.height()].map(|side| side as u32);
    match (numbers(picture, plane), bits) {
        (Numbers::Grey(image), _) => {
            let pixels = image.pixels().par_iter();
            let values: Vec<u16> = pixels.map(|&value| sixteen(f64::from(value) / white)).collect();
            encode(size, png::ColorType::Grayscale, png::BitDepth::Sixteen, &big_endian(&values))
        }
        (Numbers::Colors(image), ColorBits::Eight) => {
            let pixels = image.pixels().par_iter();
            let values: Vec<[u8; 3]> = pixels.map(|&[r, g, b]| Rgb { r, g, b }.to_bytes()).collect();
            encode(size, png::ColorType::Rgb, png::BitDepth::Eight, values.as_flattened())
        }
        (Numbers::Colors(image), ColorBits::Sixteen) => {
            let pixels = image.pixels().par_iter();
            let values: Vec<[u16; 3]> = pixels.map(|p| p.map(|c| sixteen(curve(f64::from(c))))).collect();
            encode(size, png::ColorType::Rgb, png::BitDepth::Sixteen, &big_endian(values.as_flattened()))
        }
    }
}

/// From 0 to 1 in 16 bits, the nearest; what is no number is 0.
fn sixteen(value: f64) -> u16 {
    (value.clamp(0.0, 1.0) * 65535.0).round() as u16
}

/// The transfer curve of sRGB, from linear light to what is written.
fn curve(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

fn big_endian(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_be_bytes()).collect()
}

fn encode(
    [width, height]: [u32; 2],
    color: png::ColorType,
    depth: png::BitDepth,
    bytes: &[u8],
) -> io::Result<Vec<u8>> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(color);
    encoder.set_depth(depth);
    // Grey planes are numbers, not light, and are marked as nothing.
    if color == png::ColorType::Rgb {
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    }
    let mut writer = encoder.write_header().map_err(io::Error::other)?;
    writer.write_image_data(bytes).map_err(io::Error::other)?;
    writer.finish().map_err(io::Error::other)?;
    Ok(file)
}

/// Whether a number has one of 16 bits next to it, not infinity: the largest is 65,504.
fn fits_half(value: f32) -> bool {
    f16::from_f32(value).is_finite()
}

/// Planes as one EXR file.
pub(super) fn exr(picture: &Picture, planes: &[Plane], half: bool) -> io::Result<Vec<u8>> {
    let channel = |name: String, values: Vec<f32>| {
        let samples = if half && values.iter().all(|&value| fits_half(value)) {
            FlatSamples::F16(values.into_iter().map(f16::from_f32).collect())
        } else {
            FlatSamples::F32(values)
        };
        AnyChannel::new(name.as_str(), samples)
    };
    let mut channels = Vec::new();
    for (name, plane) in PLANES.iter().filter(|(_, plane)| planes.contains(plane)) {
        match numbers(picture, *plane) {
            Numbers::Grey(image) => channels.push(channel(format!("{name}.Y"), image.pixels().to_vec())),
            Numbers::Colors(image) => {
                for (k, color) in ["R", "G", "B"].into_iter().enumerate() {
                    // The picture itself is what programs look for under no layer.
                    let name =
                        if *plane == Plane::Composite { color.to_owned() } else { format!("{name}.{color}") };
                    channels.push(channel(name, image.pixels().iter().map(|pixel| pixel[k]).collect()));
                }
            }
        }
    }
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let layer = Layer::new(
        (picture.alpha.width(), picture.alpha.height()),
        LayerAttributes::default(),
        encoding,
        AnyChannels::sort(channels.into_iter().collect()),
    );
    let mut file = Vec::new();
    exr::prelude::Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(Cursor::new(&mut file))
        .map_err(io::Error::other)?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{ReadChannels, ReadLayers};
    use glam::DVec3;
    use welter_fluids::volume_rendering::{Camera, Light, Medium, RenderParameters, Scene, render};
    use welter_meshing::Monitor;
    use welter_meshing::shapes::{Sphere, sphere};

    /// A ball, young on one side and old on the other, too bright in places.
    fn picture() -> Picture {
        let ball = sphere(&Sphere { edge_length: 0.3, ..Sphere::default() }).unwrap();
        let ages: Vec<f64> = ball.positions().iter().map(|p| 2.0 + 2.0 * p.x).collect();
        let scene = Scene {
            smoke: &ball,
            ages: &ages,
            solids: &[],
            camera: Camera::toward(DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO),
            light: Light { radiance: [2.5, 2.0, 1.0], ..Light::default() },
            medium: Medium::white(3.0),
            background: [0.25, 0.001, 0.0],
        };
        let parameters =
            RenderParameters { width: 23, height: 17, shadow_resolution: 16, ..Default::default() };
        render(&scene, &parameters, &Monitor::none()).unwrap().0
    }

    fn decoded(file: &[u8]) -> (png::ColorType, png::BitDepth, Vec<u8>) {
        let mut reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        assert_eq!((info.width, info.height), (23, 17));
        (info.color_type, info.bit_depth, bytes)
    }

    #[test]
    fn png_reads_back_as_the_planes() {
        let picture = picture();
        for (plane, image, white) in [
            (Plane::Alpha, &picture.alpha, 1.0),
            (Plane::Scatter, &picture.scatter, 1.0),
            (Plane::Age, &picture.age, 3.0),
        ] {
            let file = png(&picture, plane, ColorBits::Eight, 3.0).unwrap();
            let (color, depth, bytes) = decoded(&file);
            assert_eq!((color, depth), (png::ColorType::Grayscale, png::BitDepth::Sixteen));
            let (mut ones, mut between) = (0, 0);
            for (two, value) in bytes.chunks_exact(2).zip(image.pixels()) {
                let read = f64::from(u16::from_be_bytes([two[0], two[1]])) / 65535.0;
                assert!((read - (f64::from(*value) / white).min(1.0)).abs() <= 0.5001 / 65535.0, "{plane:?}");
                ones += usize::from(read == 1.0);
                between += usize::from(read > 0.0 && read < 1.0);
            }
            assert!(between > 20 && (plane != Plane::Age || ones > 5), "{plane:?}: {ones} {between}");
        }
        for (plane, image) in [(Plane::Composite, &picture.composite), (Plane::Backdrop, &picture.backdrop)] {
            let (color, depth, bytes) = decoded(&png(&picture, plane, ColorBits::Sixteen, 1.0).unwrap());
            assert_eq!((color, depth), (png::ColorType::Rgb, png::BitDepth::Sixteen));
            let mut clipped = 0;
            for (two, value) in bytes.chunks_exact(2).zip(image.pixels().as_flattened()) {
                let written = f64::from(u16::from_be_bytes([two[0], two[1]])) / 65535.0;
                // The curve backwards.
                let light =
                    if written <= 0.040_45 { written / 12.92 } else { ((written + 0.055) / 1.055).powf(2.4) };
                assert!((light - f64::from(*value).min(1.0)).abs() < 2e-5, "{plane:?}: {light} {value}");
                clipped += usize::from(*value > 1.0);
            }
            assert!(plane != Plane::Composite || clipped > 10, "{clipped}");
            let (_, depth, eight) = decoded(&png(&picture, plane, ColorBits::Eight, 1.0).unwrap());
            assert_eq!(depth, png::BitDepth::Eight);
            for (&eight, two) in eight.iter().zip(bytes.chunks_exact(2)) {
                let sixteen = f64::from(u16::from_be_bytes([two[0], two[1]])) / 257.0;
                assert!((f64::from(eight) - sixteen).abs() < 0.51, "{eight} {sixteen}");
            }
        }
    }

    /// The channels of a file by name.
    fn channels(file: &[u8]) -> Vec<(String, Vec<f32>)> {
        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(file))
            .unwrap();
        let list = &image.layer_data.channel_data.list;
        list.iter().map(|c| (c.name.to_string(), c.sample_data.values_as_f32().collect())).collect()
    }

    #[test]
    fn exr_reads_back_as_the_planes_to_the_bit() {
        let picture = picture();
        let all: Vec<Plane> = PLANES.iter().map(|(_, plane)| *plane).collect();
        let color =
            |image: &Image<[f32; 3]>, k: usize| image.pixels().iter().map(|p| p[k]).collect::<Vec<_>>();
        let wanted = [
            ("B", color(&picture.composite, 2)),
            ("G", color(&picture.composite, 1)),
            ("R", color(&picture.composite, 0)),
            ("age.Y", picture.age.pixels().to_vec()),
            ("alpha.Y", picture.alpha.pixels().to_vec()),
            ("backdrop.B", color(&picture.backdrop, 2)),
            ("backdrop.G", color(&picture.backdrop, 1)),
            ("backdrop.R", color(&picture.backdrop, 0)),
            ("scatter.Y", picture.scatter.pixels().to_vec()),
        ];
        let file = exr(&picture, &all, false).unwrap();
        assert_eq!(file, exr(&picture, &all, false).unwrap());
        let read = channels(&file);
        assert_eq!(read.len(), 9);
        for ((name, values), (known, exact)) in read.iter().zip(&wanted) {
            assert!(name == known && values == exact, "{name} {known}");
        }
        let rounded = channels(&exr(&picture, &all, true).unwrap());
        for ((name, values), (_, exact)) in rounded.iter().zip(&wanted) {
            let worst =
                values.iter().zip(exact).map(|(a, b)| (a - b).abs() / b.max(1e-3)).fold(0.0, f32::max);
            assert!(worst <= 1.0 / 2048.0, "{name}: {worst}");
        }
        assert_eq!(channels(&exr(&picture, &[Plane::Age], false).unwrap()).len(), 1);
    }

    #[test]
    fn what_half_precision_does_not_hold_is_written_in_single() {
        let mut picture = picture();
        // Numbers up to 65,519 round to the largest of 16 bits, from 65,520 on to infinity.
        for (largest, exact) in [(65_504.0_f32, false), (65_519.0, false), (65_520.0, true), (1e12, true)] {
            picture.composite.at_mut(3, 2)[0] = largest;
            let read = channels(&exr(&picture, &[Plane::Composite, Plane::Alpha], true).unwrap());
            let values = |wanted: &str| &read.iter().find(|(name, _)| name == wanted).unwrap().1;
            let red = || picture.composite.pixels().iter().map(|pixel| pixel[0]);
            let most = values("R").iter().fold(0.0_f32, |most, &value| most.max(value));
            assert_eq!(most, if exact { largest } else { 65_504.0 });
            assert_eq!(red().eq(values("R").iter().copied()), exact, "{largest}");
            // The others fit.
            for (name, numbers) in [("G", 1), ("alpha.Y", 3)] {
                let exact: Vec<f32> = match numbers {
                    3 => picture.alpha.pixels().to_vec(),
                    k => picture.composite.pixels().iter().map(|pixel| pixel[k]).collect(),
                };
                assert!(
                    *values(name) != exact && values(name).iter().all(|value| value.is_finite()),
                    "{name}"
                );
            }
        }
    }
}
