//! `welter shape`: writes a built-in surface.

use crate::codes::Code;
use crate::console::Seconds;
use crate::failure::{Failure, shown};
use crate::input::FormatName;
use crate::numbers::grouped;
use crate::output::Output;
use crate::run::{Outcome, Run};
use crate::surface_file::{Writing, refuse_standard_output_with_json, write_surface};
use serde_json::json;
use std::fmt::Write as _;
use std::path::PathBuf;
use welter_meshing::shapes::{NAMES, ShapeError, TextSurface, by_name, text_surface};
use welter_meshing::surface::ClosedOrientedMesh;

/// Write a built-in surface (`--list` names them)
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  welter shape ring-overlap -o ring.ply --size 0.05
  welter shape text --text welter -o sign.stl")]
pub(crate) struct Args {
    /// Which surface
    #[arg(required_unless_present = "list")]
    name: Option<String>,
    /// List the built-in surfaces
    #[arg(long)]
    list: bool,
    /// Edge length of the triangles, absolute [default: 5,000 to 20,000 triangles]
    #[arg(long, value_name = "H", allow_negative_numbers = true)]
    size: Option<f64>,
    /// What the surface `text` says; lines are separated by a line end [default: curl]
    #[arg(long, value_name = "WORDS")]
    text: Option<String>,
    /// File to write (obj, ply, stl, off), not overwritten without --force; `-` is standard output
    #[arg(short, long, value_name = "OUT", required_unless_present = "list")]
    output: Option<PathBuf>,
    /// Format of the output [default: by its extension]; needed for standard output
    #[arg(long, value_enum, value_name = "FORMAT")]
    to: Option<FormatName>,
    /// Write text where the format has text and binary (PLY, STL)
    #[arg(long)]
    ascii: bool,
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let (false, Some(name), Some(output)) = (args.list, &args.name, &args.output) else {
        return list(run);
    };
    let writing = Writing { output: output.clone(), to: args.to, ascii: args.ascii };
    refuse_standard_output_with_json(output, run)?;
    let format = writing.format()?;
    let file = Output::prepare(output, run.force, &[])?;
    let mut seconds = Seconds::default();
    let mesh = run.console.stage(&mut seconds, "building", || match &args.text {
        Some(words) => build_text(name, words, args.size),
        None => build(name, args.size),
    })?;
    let dropped = run
        .console
        .stage(&mut seconds, "writing", || write_surface(file, format, mesh.as_mesh(), &writing.options()))?;
    for loss in &dropped {
        run.console.note(&format!("{}: {loss}", output.display()));
    }
    run.console.note(&format!(
        "{}: {name}, {} vertices, {} triangles",
        output.display(),
        grouped(mesh.positions().len() as u64),
        grouped(mesh.triangles().len() as u64)
    ));
    run.console.object(&json!({
        "shape": name,
        "output": shown(output),
        "format": format.extension(),
        "vertices": mesh.positions().len(),
        "triangles": mesh.triangles().len(),
        "dropped": dropped,
        "seconds": seconds.to_json(),
    }))?;
    Ok(0)
}

/// A built-in surface by name.
pub(crate) fn build(name: &str, size: Option<f64>) -> Result<ClosedOrientedMesh, Box<Failure>> {
    by_name(name, size).map_err(|error| refused(name, &error))
}

/// The surface `text` with these words.
fn build_text(name: &str, words: &str, size: Option<f64>) -> Result<ClosedOrientedMesh, Box<Failure>> {
    if name != "text" {
        return Err(Failure::new(Code::Usage, format!("--text is for the surface `text`, not for `{name}`"))
            .help("welter shape text --text WORDS -o words.ply"));
    }
    let mut parameters = TextSurface::default();
    words.clone_into(&mut parameters.shape.words);
    parameters.edge_length = size.unwrap_or(parameters.edge_length);
    text_surface(&parameters).map_err(|error| refused(name, &error))
}

fn refused(name: &str, error: &ShapeError) -> Box<Failure> {
    match error {
        ShapeError::Field(_) => Failure::new(Code::TextNotDrawn, error.to_string())
            .subject(name)
            .help("welter shape text --text welter -o text.ply"),
        ShapeError::UnknownName { nearest, .. } => Failure::new(Code::UnknownShape, error.to_string()).help(
            nearest.map_or("welter shape --list".to_owned(), |nearest| {
                format!("welter shape {nearest} -o {nearest}.ply")
            }),
        ),
        _ => Failure::new(Code::SizeOutOfRange, error.to_string())
            .subject(name)
            .help(format!("welter shape {name} -o {name}.ply   # its default size")),
    }
}

fn list(run: &Run) -> Outcome {
    let mut text = String::from("name               comp.  genus  self-int.  what\n");
    let mut list = Vec::new();
    for shape in NAMES {
        let crossing = if shape.self_intersecting { "yes" } else { "no" };
        let _ = writeln!(
            text,
            "{:<18} {:>5}  {:>5}  {crossing:<9}  {}",
            shape.name, shape.components, shape.genus, shape.description
        );
        list.push(json!({
            "name": shape.name,
            "components": shape.components,
            "genus": shape.genus,
            "self_intersecting": shape.self_intersecting,
            "description": shape.description,
        }));
    }
    run.console.result(&text)?;
    run.console.object(&json!({ "shapes": list }))?;
    Ok(0)
}
