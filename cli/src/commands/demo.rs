//! `welter demo`: builds a surface that intersects itself, checks it exactly, meshes its volume, draws both, and says where the results are.

use crate::codes::Code;
use crate::commands::mesh::Meshed;
use crate::commands::shape;
use crate::console::Seconds;
use crate::examine::{self, Findings};
use crate::failure::{Failure, shell_word, shown};
use crate::html::Page;
use crate::numbers::grouped;
use crate::output::Output;
use crate::picture;
use crate::render::{Caption, Edges, Layer, RenderError, Rgb, Scene, Style};
use crate::run::{Outcome, Run};
use crate::surface_file::write_surface;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use welter_meshing::io::{Format, WriteOptions};
use welter_meshing::spatial::Sharing;
use welter_meshing::surface::{TriId, TriMesh, TriangleSoup};

/// Build a self-intersecting surface, check it exactly, mesh its volume and draw both; no input needed
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Writes the surface (NAME.png, NAME.ply), its volume as hexahedra (NAME-mesh.png, cut open; NAME.vtu), report.json
and report.html into DIR. What an earlier demo wrote there is replaced; anything else is not overwritten without
--force.")]
pub(crate) struct Args {
    /// A surface of `welter shape --list`
    #[arg(default_value = "ring-overlap")]
    name: String,
    /// Folder for the results; made if its parent exists
    #[arg(short, long, value_name = "DIR", default_value = "demo")]
    output: PathBuf,
    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "1600x1200", value_parser = picture::parse_size)]
    size: [u32; 2],
}

/// What `report.json` says of its maker; a folder that has it may be written again.
const MAKER: &str = "welter demo";

/// Cells along the shortest side of the mesh: each is seen on the picture.
const CELLS: u32 = 24;

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let console = &run.console;
    let mut seconds = Seconds::default();
    let closed = console.stage(&mut seconds, "building", || shape::build(&args.name, None))?;
    let mesh: &TriMesh = closed.as_mesh();
    let folder = Folder::prepare(&args.output, run)?;
    let [picture, surface, cut_picture, volume, json_file, html_file] = [
        format!("{}.png", args.name),
        format!("{}.ply", args.name),
        format!("{}-mesh.png", args.name),
        format!("{}.vtu", args.name),
        "report.json".into(),
        "report.html".into(),
    ]
    .map(|name: String| args.output.join(name));
    let open = |path: &Path| Output::prepare(path, run.force || folder.replaceable, &[]);
    let (picture_out, surface_out) = (open(&picture)?, open(&surface)?);
    let (cut_picture_out, volume_out) = (open(&cut_picture)?, open(&volume)?);
    let (json_out, html_out) = (open(&json_file)?, open(&html_file)?);

    let findings = Findings::of(mesh, Sharing::Position, console, seconds)?;
    let mut seconds = findings.seconds.clone();
    let crossing: Vec<TriId> = findings.pairs.iter().flatten().copied().collect();
    let scene = scene(mesh, &args.name, args.size, &crossing, &findings);
    let image = picture::draw(&scene, run, &mut seconds)?;
    let own_bug = |error: RenderError| Failure::new(Code::OwnBug, error.to_string());
    let png = image.to_png().map_err(own_bug)?;
    let meshed = Meshed::of(&closed, CELLS, &args.name, run, &mut seconds)?;
    let title = format!("{}, meshed and cut open", args.name);
    let cut_png = meshed.draw(&title, args.size, run, &mut seconds)?.to_png().map_err(own_bug)?;

    let command = format!("welter demo {} -o {}", args.name, shell_word(&args.output));
    let object = json!({
        "maker": MAKER,
        "version": env!("CARGO_PKG_VERSION"),
        "command": command,
        "shape": args.name,
        "folder": shown(&args.output),
        "picture": shown(&picture),
        "surface": shown(&surface),
        "mesh_picture": shown(&cut_picture),
        "volume": shown(&volume),
        "report": shown(&html_file),
        "findings": Value::Object(findings.to_json(false)),
        "mesh": Value::Object(meshed.facts().to_json()),
        "seconds": seconds.to_json(),
    });
    let page = page(args, &findings, &meshed, [&png, &cut_png], [&surface, &volume], &seconds);
    console.stage(&mut seconds, "writing", || -> Result<(), Box<Failure>> {
        picture_out.write(|file| file.write_all(&png))?;
        let _ = write_surface(surface_out, Format::Ply, &colored(mesh, &crossing), &WriteOptions::default())?;
        cut_picture_out.write(|file| file.write_all(&cut_png))?;
        meshed.write(volume_out)?;
        html_out.write(|file| file.write_all(page.as_bytes()))?;
        json_out.write(|file| writeln!(file, "{object:#}"))
    })?;
    folder.keep();
    console.progress.clear();
    let mut text = examine::block(Path::new(&args.name), &findings);
    text.push_str("\nthe volume within:\n");
    text.push_str(&meshed.facts().in_words());
    text.push_str("\nwritten:\n");
    for (path, what) in [
        (&picture, "the picture; triangles that intersect others are orange"),
        (&surface, "the surface, coloured the same way"),
        (&cut_picture, "the mesh of the volume, cut open: two sheets where it overlaps itself"),
        (&volume, "that mesh, for ParaView"),
        (&html_file, "the report, to open in a browser"),
        (&json_file, "the report for scripts"),
    ] {
        text.push_str(&format!("  {:<28} {what}\n", path.display()));
    }
    console.result(&text)?;
    console.object(&object)?;
    Ok(0)
}

/// The folder of the results. If it was made here and the work fails, it is taken away again.
struct Folder<'a> {
    path: &'a Path,
    made: bool,
    /// Holds the results of an earlier demo.
    replaceable: bool,
}

impl<'a> Folder<'a> {
    fn prepare(path: &'a Path, run: &Run) -> Result<Self, Box<Failure>> {
        let shown = || path.display().to_string();
        if path == Path::new(crate::input::STANDARD) {
            return Err(Failure::new(Code::NotWritable, "a demo is a folder of files")
                .subject(shown())
                .help("welter demo -o demo"));
        }
        match fs::metadata(path) {
            Ok(meta) if meta.is_dir() => {
                let report = fs::read(path.join("report.json")).unwrap_or_default();
                let replaceable =
                    serde_json::from_slice::<Value>(&report).is_ok_and(|report| report["maker"] == MAKER);
                Ok(Self { path, made: false, replaceable })
            }
            Ok(_) => Err(Failure::new(Code::OutputExists, "this is a file, and a folder is needed")
                .subject(shown())
                .help("name another folder with -o")),
            Err(_) => {
                fs::create_dir(path).map_err(|error| crate::output::cannot_write(path, &error))?;
                run.console.detail(2, &format!("made folder {}", path.display()));
                Ok(Self { path, made: true, replaceable: false })
            }
        }
    }

    fn keep(mut self) {
        self.made = false;
    }
}

impl Drop for Folder<'_> {
    fn drop(&mut self) {
        if self.made {
            // Removes it only if it is empty.
            let _ = fs::remove_dir(self.path);
        }
    }
}

fn scene<'a>(
    mesh: &'a TriMesh,
    name: &str,
    size: [u32; 2],
    crossing: &'a [TriId],
    findings: &Findings,
) -> Scene<'a> {
    let style = Style { edges: Some(Edges::default()), ..Style::default() };
    let lines = vec![
        (Some(style.front), format!("{} triangles", grouped(findings.triangles as u64))),
        (Some(style.accent), format!("{} self-intersecting pairs", grouped(findings.pairs.len() as u64))),
    ];
    let lines: Vec<(Option<Rgb>, String)> = lines;
    Scene {
        layers: vec![Layer { highlighted: crossing, style, ..Layer::of(mesh) }],
        size,
        caption: Caption { title: name.to_owned(), lines, ..Caption::default() },
        ..Scene::default()
    }
}

/// The surface with the colours of the picture.
fn colored(mesh: &TriMesh, crossing: &[TriId]) -> TriangleSoup {
    let style = Style::default();
    let mut soup = mesh.to_soup();
    soup.triangle_colors = vec![style.front.to_bytes(); soup.triangles.len()];
    for id in crossing {
        soup.triangle_colors[id.index()] = style.accent.to_bytes();
    }
    soup
}

fn page(
    args: &Args,
    findings: &Findings,
    meshed: &Meshed,
    [png, cut_png]: [&[u8]; 2],
    [surface, volume]: [&Path; 2],
    seconds: &Seconds,
) -> String {
    let seconds = seconds.to_json();
    let rows = |value: &Value| -> Vec<(String, String)> {
        let Value::Object(map) = value else { return Vec::new() };
        map.iter().map(|(name, value)| (name.replace('_', " "), seconds_of(value))).collect()
    };
    let tables = [
        (
            "Findings",
            examine::facts(findings).into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
        ),
        (
            "The volume within",
            meshed.facts().rows().into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
        ),
        ("Seconds", rows(&seconds)),
    ];
    let (word, mesh) = (shell_word(surface), shell_word(volume));
    let caption =
        format!("{}: triangles that intersect others are orange and show through what hides them", args.name);
    Page {
        title: &format!("welter demo: {}", args.name),
        verdict: &findings.verdict(),
        pictures: &[
            (png, &caption),
            (cut_png, "its volume as hexahedra, cut open; two colours on one face: two hexahedra on one cell, of different sheets"),
        ],
        graphs: &[],
        tables: &tables,
        commands: &[
            format!("welter check {word} --pairs"),
            format!("welter render {word} -o closer.png --camera 20,60 --self-intersections"),
            format!("welter mesh {word} -o {mesh} -r 63 --force"),
            "welter shape --list".to_owned(),
            "welter check your-own-part.stl".to_owned(),
        ],
    }
    .to_html()
}

fn seconds_of(value: &Value) -> String {
    value.as_f64().map_or_else(|| value.to_string(), |seconds| format!("{seconds:.3}"))
}
