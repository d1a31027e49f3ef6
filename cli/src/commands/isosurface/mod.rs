//! `welter isosurface`: the surface of a field that a scene file describes.

mod field;
mod spec;

use crate::closed::closed_oriented;
use crate::codes::Code;
use crate::console::Seconds;
use crate::failure::{Failure, shell_word, shown};
use crate::input::{Input, Reading};
use crate::machine;
use crate::numbers::{self, grouped};
use crate::output::{Output, WriteProblem};
use crate::picture::{self, parse_cut, parse_size};
use crate::render::{Cut, Slice, slice};
use crate::run::{Outcome, Run};
use crate::scene::Scene;
use crate::surface_file::{Writing, refuse_standard_output_with_json, write_surface};
use field::Meshes;
use rayon::prelude::*;
use serde_json::{Value, json};
use spec::{Crossing, Spec, Triangles, Wall};
use std::path::{Path, PathBuf};
use welter_meshing::field::{AnyField, Offset, ScalarField};
use welter_meshing::grid::{Grid2, Grid3, Samples};
use welter_meshing::io::{DataArray, VtkEncoding, WriteError, write_vti};
use welter_meshing::isosurface::{IsosurfaceError, MarchingCubes, marching_cubes, marching_cubes_open};
use welter_meshing::remesh::{Equilateral, RemeshError, equilateral};
use welter_meshing::surface::measure::{angle_statistics, area, signed_volume};
use welter_meshing::surface::{EmbeddedMesh, Topology, TriMesh};
use welter_meshing::{DVec3, Monitor};

/// Make the surface of a field that a scene file describes
#[derive(Debug, clap::Args)]
#[command(after_help = "\
A scene (TOML) has a table [field] with a tree of fields, and may have [grid] and [surface]:

  [grid]
  cells = 80                  # along the shortest side; or: spacing = 0.02
  [surface]
  crossing = \"root\"           # vertices on the field; or \"linear\"
  [field]
  kind = \"union\"
  blend_width = 0.3
  parts = [
    { kind = \"ball\", radius = 1 },
    { kind = \"torus\", radius = 1.4, tube_radius = 0.2, rotate = { axis = \"x\", degrees = 60 } },
  ]

Kinds and their keys:
  ball        radius, center              half-space    normal, point
  box         min, max, rounding          gyroid        period, thickness
  torus       radius, tube_radius,        text          words, height, pen_radius, depth,
              center, axis                              caps = \"flat\" | \"rounded\"
  capsule     ends, radius                mesh          file (closed; beside the scene),
  cylinder    ends, radius                              inside = \"nonzero\" | \"positive\" | \"odd\"
  ellipsoid   semi_axes, center           constant      value
  union, intersection: parts, blend_width      difference: from, removed, blend_width
  offset: field, distance    shell: field, thickness    complement: field    affine: field, matrix
  noise: wavelength, octaves, gain, lacunarity, seed    displaced: field, amplitude and those of noise
  all: scale, rotate = { axis, degrees }, translate (in this order)
[surface]: level = 0, crossing, wall = \"cap\" | \"open\", triangles = \"marching-cubes\" | \"equilateral\"
[grid]: bounds = [[x, y, z], [x, y, z]] where the field has none of its own

Examples:
  welter isosurface examples/isosurface/gyroid.toml -o gyroid.ply
  welter isosurface scene.toml -o field.vti            the samples, for ParaView
  welter isosurface scene.toml -o part.stl --slice z=0 --slice-picture slice.png")]
pub(crate) struct Args {
    /// Scene to read
    #[arg(value_name = "SPEC.toml")]
    scene: PathBuf,
    #[command(flatten)]
    writing: Writing,
    /// Write the samples too, as VTK image data
    #[arg(long, value_name = "FILE.vti")]
    field: Option<PathBuf>,
    /// Plane of the picture, for example z=0.5
    #[arg(long, value_name = "x|y|z=V", value_parser = parse_cut, requires = "slice_picture")]
    slice: Option<Cut>,
    /// Draw the field in a plane, with contour lines, as PNG
    #[arg(long, value_name = "FILE.png", requires = "slice")]
    slice_picture: Option<PathBuf>,
    /// Width and height of that picture in pixels
    #[arg(long, value_name = "WxH", default_value = "1000x1080", value_parser = parse_size)]
    slice_size: [u32; 2],
    /// Refuse scenes that would take more memory [default: what is free now]
    #[arg(long, value_name = "BYTES")]
    max_memory: Option<u64>,
}

/// Memory for each node of the grid in bytes: the sample, and half as much for signs and the surface.
const BYTES_A_NODE: u64 = 12;

/// The same with meshes in the scene: their winding numbers, and samples of another part to be joined.
const BYTES_A_NODE_WITH_MESHES: u64 = BYTES_A_NODE + 12;

/// Memory for each pixel of the picture in bytes: its colour, and the share of ink.
const BYTES_A_PIXEL: u64 = 7;

/// Nodes along the longer side of the plane of a picture: one for each three pixels; colours and lines are interpolated between.
const SLICE_NODES: f64 = 320.0;

/// The name of the samples in a VTI file.
const ARRAY: &str = "field";

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let console = &run.console;
    let mut seconds = Seconds::default();
    refuse_standard_output_with_json(&args.writing.output, run)?;
    let scene = Scene::read(&args.scene)?;
    let table = scene.parse()?;
    let spec = Spec::of(&scene, &table)?;
    let (_, files) = spec::field(&scene, &table, None)?;
    let outputs = Outputs::prepare(args, run, &files)?;
    let meshes = console.stage(&mut seconds, "reading", || read_meshes(args, run, files))?;
    let (field, _) = spec::field(&scene, &table, Some(&meshes))?;
    let grid = spec.grid(&scene, &field)?;
    require_memory(args, &grid, !meshes.is_empty())?;

    let report = |p: welter_meshing::Progress| console.progress.report(p.stage, p.done, p.total);
    let monitor = Monitor::new(Some(&report), None);
    let mut object = json!({
        "input": shown(&args.scene),
        "output": shown(&args.writing.output),
        "cell_size": grid.spacing(),
        "origin": grid.origin(),
        "grid": grid.cells(),
        "cells": grid.cell_count(),
    });
    if let Some((output, cut)) = outputs.picture {
        let drawn =
            console.stage(&mut seconds, "slice", || draw_slice(args, &scene, &spec, &grid, &field, cut));
        let (image, step) = drawn?;
        picture::write_png(&image, output)?;
        object["contour_step"] = json!(step);
    }
    let samples = console
        .stage(&mut seconds, "sampling", || Samples::of(&grid, &field, &monitor))
        .map_err(|error| Failure::new(Code::Interrupted, error.to_string()))?;
    samples.require_numbers().map_err(|error| undefined(&scene, &IsosurfaceError::from(error)))?;
    let encoding = if args.writing.ascii { VtkEncoding::Ascii } else { VtkEncoding::Appended };
    for output in outputs.fields {
        console.stage(&mut seconds, "writing", || write_field(output, &samples, encoding))?;
    }
    let mut text = format!(
        "{}: {} cells of side {}\n",
        args.scene.display(),
        grid.cells().map(grouped).join(" x "),
        numbers::number(grid.spacing())
    );
    if let Some((output, format)) = outputs.surface {
        let mesh =
            console.stage(&mut seconds, "surface", || surface(&scene, &spec, &samples, &field, &monitor))?;
        drop(samples);
        let facts = console.stage(&mut seconds, "measuring", || facts(&mesh, spec.wall));
        let dropped = console.stage(&mut seconds, "writing", || {
            write_surface(output, format, &mesh, &args.writing.options())
        })?;
        for loss in &dropped {
            console.note(&format!("{}: {loss}", args.writing.output.display()));
        }
        text.push_str(&in_words(&facts));
        facts.into_iter().for_each(|(key, value)| object[key] = value);
    }
    console.progress.clear();
    console.note(&format!("{} written", args.writing.output.display()));
    if args.writing.output != Path::new(crate::input::STANDARD) {
        console.result(&text)?;
    }
    object["seconds"] = seconds.to_json();
    console.object(&object)?;
    Ok(0)
}

/// Where results go, found out before the work.
struct Outputs {
    surface: Option<(Output, welter_meshing::io::Format)>,
    fields: Vec<Output>,
    picture: Option<(Output, Cut)>,
}

impl Outputs {
    fn prepare(args: &Args, run: &Run, meshes: &[PathBuf]) -> Result<Self, Box<Failure>> {
        let names: Vec<PathBuf> = meshes.iter().map(|file| beside(&args.scene, file)).collect();
        let inputs: Vec<&Path> = names.iter().map(PathBuf::as_path).chain([args.scene.as_path()]).collect();
        let open = |name: &Path| Output::prepare(name, run.force, &inputs);
        let output = &args.writing.output;
        let mut outputs = Self { surface: None, fields: Vec::new(), picture: None };
        if args.writing.to.is_none() && has_extension(output, "vti") {
            outputs.fields.push(open(output)?);
        } else {
            let format = args.writing.format().map_err(|failure| {
                let help = failure.help.clone();
                failure.help(format!("{help}; or end the name in .vti for the samples"))
            })?;
            outputs.surface = Some((open(output)?, format));
        }
        if let Some(name) = &args.field {
            require_extension(name, "vti", "samples are written as .vti")?;
            outputs.fields.push(open(name)?);
        }
        if let (Some(name), Some(cut)) = (&args.slice_picture, args.slice) {
            require_extension(name, "png", "pictures are written as .png")?;
            outputs.picture = Some((open(name)?, cut));
        }
        Ok(outputs)
    }
}

fn has_extension(name: &Path, extension: &str) -> bool {
    name.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension))
}

fn require_extension(name: &Path, extension: &str, what: &str) -> Result<(), Box<Failure>> {
    if has_extension(name, extension) {
        return Ok(());
    }
    Err(Failure::new(Code::UnknownFormat, what)
        .subject(name.display().to_string())
        .why("the format is known from the extension")
        .help(shell_word(&name.with_extension(extension))))
}

/// A file that a scene names, relative to the folder of the scene.
fn beside(scene: &Path, file: &Path) -> PathBuf {
    scene.parent().unwrap_or(Path::new("")).join(file)
}

fn read_meshes(args: &Args, run: &Run, files: Vec<PathBuf>) -> Result<Meshes, Box<Failure>> {
    let mut meshes = Meshes::new();
    for file in files {
        if meshes.contains_key(&file) {
            continue;
        }
        let name = beside(&args.scene, &file);
        let input = Input::open(&name, &Reading { from: None, max_memory: args.max_memory })?;
        let (soup, _) = input.read(&run.console.progress)?;
        let mesh = closed_oriented(soup, &name)?;
        meshes.insert(file, mesh);
    }
    Ok(meshes)
}

fn require_memory(args: &Args, grid: &Grid3, has_meshes: bool) -> Result<(), Box<Failure>> {
    let pixels = args.slice_picture.as_ref().map_or(0, |_| args.slice_size.map(u64::from).iter().product());
    let bytes = if has_meshes { BYTES_A_NODE_WITH_MESHES } else { BYTES_A_NODE };
    let nodes = (grid.node_count() as u64).saturating_mul(bytes);
    let needed = nodes.saturating_add(pixels * BYTES_A_PIXEL);
    match args.max_memory.or_else(machine::available_memory) {
        Some(free) if needed > free => {
            let what = format!(
                "a grid of {} nodes{} may take {}, and {} {}",
                grouped(grid.node_count() as i64),
                if pixels > 0 {
                    format!(" and a picture of {} pixels", grouped(pixels as i64))
                } else {
                    String::new()
                },
                numbers::bytes(needed),
                numbers::bytes(free),
                if args.max_memory.is_some() { "are allowed" } else { "are free" }
            );
            Err(Failure::new(Code::OverMemory, what)
                .subject(args.scene.display().to_string())
                .help("take fewer cells or a larger spacing in the table [grid]"))
        }
        _ => Ok(()),
    }
}

/// The failure for a field that has no surface.
fn undefined(scene: &Scene, error: &IsosurfaceError) -> Box<Failure> {
    let failure = |code, help: &str| {
        Failure::new(code, error.to_string()).subject(scene.name.display().to_string()).help(help)
    };
    match error {
        IsosurfaceError::NotANumber(_) => {
            failure(Code::UndefinedField, "take a smaller box, or smaller parameters")
        }
        IsosurfaceError::TooFine { .. } => failure(Code::GridRefused, "move the grid nearer to the origin"),
        IsosurfaceError::TooMany { .. } => failure(Code::OverCount, "take fewer cells or a larger spacing"),
        IsosurfaceError::Cancelled(_) => failure(Code::Interrupted, "run the same command again"),
        _ => failure(Code::OwnBug, "send the scene to the authors"),
    }
}

fn surface(
    scene: &Scene,
    spec: &Spec,
    samples: &Samples<3>,
    field: &AnyField<'_>,
    monitor: &Monitor<'_>,
) -> Result<TriMesh, Box<Failure>> {
    let roots_of = (spec.crossing == Crossing::Root).then_some(field as &dyn ScalarField);
    let marching = MarchingCubes { level: spec.level, roots_of, ..MarchingCubes::default() };
    let undefined = |error| undefined(scene, &error);
    let mesh = match (spec.wall, spec.triangles) {
        (Wall::Open, _) => marching_cubes_open(samples, &marching, monitor).map_err(undefined)?,
        (Wall::Cap, Triangles::MarchingCubes) => {
            let mesh = marching_cubes(samples, &marching, monitor).map_err(undefined)?;
            mesh.into_closed_oriented().into_mesh()
        }
        (Wall::Cap, Triangles::Equilateral) => {
            let mesh = marching_cubes(samples, &marching, monitor).map_err(undefined)?;
            remeshed(scene, &mesh, spec.level, samples.grid().spacing(), field, monitor)?
        }
    };
    if mesh.triangles().is_empty() {
        let (least, greatest) = samples
            .values()
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)));
        return Err(Failure::new(
            Code::EmptySurface,
            format!("the field does not cross {} in the grid", spec.level),
        )
        .subject(scene.name.display().to_string())
        .place(format!("samples from {} to {}", numbers::number(least), numbers::number(greatest)))
        .help("take another level or box, or more cells: features smaller than a cell are not seen"));
    }
    Ok(mesh)
}

/// The surface with triangles near equilateral, their edges as long as the cells of the grid.
fn remeshed(
    scene: &Scene,
    mesh: &EmbeddedMesh,
    level: f64,
    edge_length: f64,
    field: &AnyField<'_>,
    monitor: &Monitor<'_>,
) -> Result<TriMesh, Box<Failure>> {
    let surface = Offset { field: field.clone(), distance: level };
    let parameters = Equilateral { edge_length, ..Equilateral::default() };
    let subject = scene.name.display().to_string();
    match equilateral(mesh, &surface, &parameters, monitor) {
        Ok((mesh, _)) => Ok(mesh.into_closed_oriented().into_mesh()),
        Err(RemeshError::TooFar { .. } | RemeshError::TooManyTriangles { .. }) => {
            let what = "the cells are too small for near equilateral triangles";
            Err(Failure::new(Code::GridRefused, what)
                .subject(subject)
                .help("take a larger spacing, or triangles = \"marching-cubes\""))
        }
        Err(error) => Err(Failure::new(Code::OwnBug, error.to_string())
            .subject(subject)
            .help("send the scene to the authors")),
    }
}

/// What is told of the surface, in the order of the contract. Open surfaces have no volume.
fn facts(mesh: &TriMesh, wall: Wall) -> Vec<(&'static str, Value)> {
    let topology = Topology::of(mesh);
    let volume = (wall == Wall::Cap).then(|| signed_volume(mesh));
    vec![
        ("vertices", json!(mesh.positions().len())),
        ("triangles", json!(mesh.triangles().len())),
        ("components", json!(topology.components().len())),
        ("euler_characteristic", json!(topology.euler_characteristic())),
        ("volume", json!(volume)),
        ("area", json!(area(mesh))),
        ("smallest_angle", json!(angle_statistics(mesh).map(|angles| angles.min.to_degrees()))),
    ]
}

fn in_words(facts: &[(&'static str, Value)]) -> String {
    let shown = |value: &Value| match (value.as_i64(), value.as_f64()) {
        (Some(count), _) => grouped(count),
        (None, Some(number)) => numbers::number(number),
        _ => "none (open)".to_owned(),
    };
    let lines = facts.iter().map(|(key, value)| format!("  {:<22}{}\n", key.replace('_', " "), shown(value)));
    lines.collect()
}

fn write_field(output: Output, samples: &Samples<3>, encoding: VtkEncoding) -> Result<(), Box<Failure>> {
    let name = output.name().display().to_string();
    output.write(|file| {
        let array = DataArray::scalars(ARRAY, samples.values());
        write_vti(file, samples.grid(), &[array], &[], encoding).map_err(|error| match error {
            WriteError::Io(error) => WriteProblem::Io(error),
            other => WriteProblem::Failure(Failure::new(Code::OwnBug, other.to_string()).subject(&name)),
        })
    })
}

/// The picture of a plane and the step between its contours.
fn draw_slice(
    args: &Args,
    scene: &Scene,
    spec: &Spec,
    grid: &Grid3,
    field: &AnyField<'_>,
    cut: Cut,
) -> Result<(crate::render::Image, f64), Box<Failure>> {
    // The two other axes, so that what is up in space is up on the picture.
    let [right, up] = [[1, 2], [0, 2], [0, 1]][cut.axis];
    let plane = |corner: [f64; 3]| [corner[right], corner[up]];
    let (min, max) = (plane(grid.origin()), plane(grid.max()));
    let spacing = (max[0] - min[0]).max(max[1] - min[1]) / SLICE_NODES;
    let plane = Grid2::covering(min, max, spacing, 0).map_err(|error| {
        Failure::new(Code::GridRefused, error.to_string()).subject(scene.name.display().to_string())
    })?;
    let value = |node: usize| {
        let p = plane.position(plane.node_at(node));
        let mut point = DVec3::splat(cut.value);
        (point[right], point[up]) = (p.x, p.y);
        field.value(point)
    };
    let values: Vec<f64> = (0..plane.node_count()).into_par_iter().map(value).collect();
    let samples = Samples::new(plane, values);
    let names = ["x", "y", "z"];
    let stem = args.scene.file_stem().unwrap_or_default().to_string_lossy();
    let view = Slice {
        samples: &samples,
        level: spec.level,
        axes: [names[right], names[up]],
        title: format!("{stem}, {} = {}", names[cut.axis], numbers::number(cut.value)),
        size: args.slice_size,
    };
    slice(&view).map_err(|error| undefined(scene, &error))
}
