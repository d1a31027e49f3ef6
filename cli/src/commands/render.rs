//! `welter render`: a picture of a surface, or of the boundary of a volumetric mesh.

use crate::codes::Code;
use crate::commands::check::failures_of;
use crate::console::Seconds;
use crate::failure::{Failure, shell_word, shown};
use crate::input::{Input, Reading, STANDARD};
use crate::output::Output;
use crate::picture::{self, View};
use crate::render::{Layer, Paint, Scene};
use crate::run::{Outcome, Run};
use crate::surface_file::refuse_standard_output_with_json;
use crate::volume_input::{VolumeInput, volume_format_of};
use clap::ValueEnum;
use serde_json::json;
use std::path::PathBuf;
use welter_meshing::Monitor;
use welter_meshing::spatial::{Bvh, Sharing};
use welter_meshing::surface::{Topology, TriId, TriMesh, TriangleSoup};

/// Draw a surface, or the boundary of a volumetric mesh, as a PNG picture
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Of a volumetric mesh the faces are drawn that have a cell on one side only. To see its cells, cut open where its
sheets lie over one another: `welter mesh IN -o OUT --picture FILE.png`.

Examples:
  welter render part.stl -o part.png
  welter render part.stl -o part.png --self-intersections --edges --camera 30,20
  welter render part.stl -o part.png --cut z=0.5 --size 1920x1080
  welter render part.vtu -o part.png --color component")]
pub(crate) struct Args {
    /// File to draw (obj, ply, stl, off; vtu, msh, mesh); `-` is standard input
    input: PathBuf,
    /// PNG file to write, not overwritten without --force; `-` is standard output
    #[arg(short, long, value_name = "OUT.png")]
    output: PathBuf,
    /// Colour of the surface
    #[arg(long, value_enum, default_value_t = Coloring::Auto, value_name = "NAME")]
    color: Coloring,
    /// Highlight the triangles that intersect others (found exactly); they show through what hides them
    #[arg(long)]
    self_intersections: bool,
    #[command(flatten)]
    view: View,
    #[command(flatten)]
    reading: Reading,
}

/// What the colour of a triangle tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Coloring {
    // Colours of the file, if it has any, else plain.
    Auto,
    // One colour for the front, another for the back.
    Plain,
    // Each group of the file its own colour.
    Group,
    // Each connected component its own colour.
    Component,
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let console = &run.console;
    refuse_standard_output_with_json(&args.output, run)?;
    let is_png = args.output.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    if !is_png && args.output != std::path::Path::new(STANDARD) && !args.output.exists() {
        return Err(Failure::new(Code::UnknownFormat, "pictures are written as .png")
            .subject(args.output.display().to_string())
            .why("the format is known from the extension, and only PNG is written")
            .help(format!("-o {}", shell_word(&args.output.with_extension("png")))));
    }
    let input = Drawn::open(args)?;
    let output = Output::prepare(&args.output, run.force, &[args.input.as_path()])?;
    let mut seconds = Seconds::default();
    let soup = input.read(args, run, &mut seconds)?;
    if soup.triangles.is_empty() {
        return Err(Failure::new(Code::NoTriangles, "there are no triangles to draw")
            .subject(args.input.display().to_string())
            .help(format!("welter info {}", shell_word(&args.input))));
    }
    if let Err(error) = TriMesh::check(&soup) {
        let mut failures = failures_of(&error, &args.input);
        return Err(failures.swap_remove(0));
    }
    let mesh = TriMesh::new(soup).map_err(|error| failures_of(&error, &args.input).swap_remove(0))?;
    let mut highlighted: Vec<TriId> = Vec::new();
    let mut pairs = None;
    if args.self_intersections {
        let found = console.stage(&mut seconds, "self-intersections", || {
            let report = |p: welter_meshing::Progress| console.progress.report(p.stage, p.done, p.total);
            Bvh::new(&mesh).self_intersections(Sharing::Position, &Monitor::new(Some(&report), None))
        });
        let found = found.map_err(|error| Failure::new(Code::Interrupted, error.to_string()))?;
        pairs = Some(found.len());
        highlighted = found.into_iter().flatten().collect();
    }
    let colors = colors_of(&mesh, args.color);
    let paint = if colors.is_empty() { Paint::Plain } else { Paint::Triangles(&colors) };
    let mut scene = Scene {
        layers: vec![Layer { paint, highlighted: &highlighted, ..Layer::of(&mesh) }],
        ..Scene::default()
    };
    args.view.apply(&mut scene);
    let image = picture::draw(&scene, run, &mut seconds)?;
    console.stage(&mut seconds, "writing", || picture::write_png(&image, output))?;
    console.progress.clear();
    console.note(&format!("{}: {} x {} pixels", args.output.display(), image.width, image.height));
    console.object(&json!({
        "input": shown(&args.input),
        "output": shown(&args.output),
        "width": image.width,
        "height": image.height,
        "triangles": mesh.triangles().len(),
        "self_intersecting_pairs": pairs,
        "seconds": seconds.to_json(),
    }))?;
    Ok(0)
}

/// What is to be drawn, open.
enum Drawn {
    Surface(Input),
    Volume(VolumeInput),
}

impl Drawn {
    fn open(args: &Args) -> Result<Self, Box<Failure>> {
        match volume_format_of(&args.input, &args.reading) {
            Some(format) => VolumeInput::open(&args.input, format, &args.reading).map(Self::Volume),
            None => Input::open(&args.input, &args.reading).map(Self::Surface),
        }
    }

    /// The surface of the file, or the boundary of its volumetric mesh.
    fn read(self, args: &Args, run: &Run, seconds: &mut Seconds) -> Result<TriangleSoup, Box<Failure>> {
        let (console, name) = (&run.console, &args.input);
        let input = match self {
            Self::Surface(input) => {
                return console
                    .stage(seconds, "reading", || input.read(&console.progress))
                    .map(|(soup, _)| soup);
            }
            Self::Volume(input) => input,
        };
        let (mesh, _) = console.stage(seconds, "reading", || input.read(&console.progress))?;
        if let Some(vertex) = mesh.positions.iter().position(|position| !position.is_finite()) {
            return Err(Failure::new(Code::NonFiniteVertex, "a vertex has a non-finite coordinate")
                .subject(name.display().to_string())
                .place(format!("vertex {vertex}, counted from 0"))
                .help(format!("welter info {}   # counts them", shell_word(name))));
        }
        Ok(console.stage(seconds, "boundary", || mesh.boundary()))
    }
}

/// One colour a triangle, or none.
fn colors_of(mesh: &TriMesh, coloring: Coloring) -> Vec<[u8; 3]> {
    match coloring {
        Coloring::Auto => mesh.triangle_colors().to_vec(),
        Coloring::Plain => Vec::new(),
        Coloring::Group => {
            let mut colors = vec![GREY; mesh.triangles().len()];
            for (k, group) in mesh.groups().iter().enumerate() {
                colors[group.triangles.start as usize..group.triangles.end as usize]
                    .fill(picture::distinct(k));
            }
            colors
        }
        Coloring::Component => {
            let topology = Topology::of(mesh);
            let triangles = (0..mesh.triangles().len()).map(TriId::from_index);
            triangles.map(|triangle| picture::distinct(topology.component_of(triangle))).collect()
        }
    }
}

/// Triangles of no group.
const GREY: [u8; 3] = [190, 190, 190];
