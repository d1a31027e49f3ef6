//! `welter view`: surfaces to turn and to play, in a browser.

mod frame;
mod page;
mod server;

use crate::codes::Code;
use crate::commands::check::failures_of;
use crate::console::Seconds;
use crate::failure::{Failure, shell_word, shown};
use crate::input::{Input, Reading};
use crate::interrupt::Asking;
use crate::numbers::grouped;
use crate::output::{Output, WriteProblem};
use crate::picture::UpAxis;
use crate::run::{Outcome, Run};
use crate::sequence::Pattern;
use crate::surface_file::refuse_standard_output_with_json;
use crate::volume_input::{VolumeInput, volume_format_of};
use frame::{Cube, pack};
use page::{Framed, Show, page};
use serde_json::json;
use server::Server;
use std::path::{Path, PathBuf};
use welter_meshing::surface::{TriMesh, TriangleSoup};

/// Look at a surface, or at the frames of a run, in a browser
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The page draws by itself: it needs no network and no graphics card. Of a volumetric mesh the boundary is shown.
Positions are rounded to a millionth of the size of what is shown.

Examples:
  welter view part.stl                    # until Ctrl-C, at the address that is told
  welter view part.stl --html part.html   # a page to keep or to send
  welter view run --html run.html         # all frames of a run, with a slider
  welter view 'obj/frame_%04d.obj' --every 5")]
pub(crate) struct Args {
    /// File (obj, ply, stl, off; vtu, msh, mesh), folder of a run, or a pattern for a sequence
    input: PathBuf,
    /// Write the page, which names no other file, not overwritten without --force; `-` is standard output
    #[arg(long, value_name = "OUT.html")]
    html: Option<PathBuf>,
    /// Show every K-th frame
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Port of 127.0.0.1 to serve the page at [default: any that is free]
    #[arg(
        long,
        value_name = "PORT",
        default_value_t = 0,
        hide_default_value = true,
        conflicts_with = "html"
    )]
    port: u16,
    /// Axis that points up; by default z
    #[arg(long, value_enum, default_value_t = UpAxis::Auto, hide_default_value = true)]
    up: UpAxis,
    #[command(flatten)]
    reading: Reading,
}

/// The longest page: browsers take about twice as much, and refuse texts of half a gigabyte.
const LONGEST: usize = 256 << 20;

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let console = &run.console;
    if let Some(html) = &args.html {
        refuse_standard_output_with_json(html, run)?;
    }
    let files = files(args)?;
    let output = match &args.html {
        Some(html) => Some(Output::prepare(html, run.force, &[args.input.as_path()])?),
        None => None,
    };
    let server = if output.is_none() { Some(Server::open(args.port)?) } else { None };
    let mut seconds = Seconds::default();
    let (mut triangles, mut vertices, mut length, mut frames) = (0, 0, 0, Vec::new());
    for (at, (name, path)) in files.iter().enumerate() {
        let soup = console.stage(&mut seconds, "reading", || read(path, args, run))?;
        let cube = Cube::of(&soup.positions);
        let bytes = console.stage(&mut seconds, "packing", || pack(&soup, &cube));
        (triangles, vertices) = (triangles.max(soup.triangles.len()), vertices.max(soup.positions.len()));
        // Four letters for three bytes.
        length += bytes.len().div_ceil(3) * 4;
        refuse_longer(length, LONGEST, [at + 1, files.len()], args)?;
        frames.push(Framed { name: name.clone(), cube, bytes });
    }
    let up = if args.up == UpAxis::Y { "y" } else { "z" };
    let title = shown(&args.input);
    let page = page(&Show { title: &title, frames: &frames, up });
    console.progress.clear();
    let shown_frames = match frames.len() {
        1 => "1 frame".to_owned(),
        count => format!("{} frames", grouped(count as u64)),
    };
    let mut object = json!({
        "input": title,
        "frames": frames.len(),
        "most_vertices": vertices,
        "most_triangles": triangles,
        "bytes": page.len(),
        "seconds": seconds.to_json(),
    });
    if let (Some(output), Some(html)) = (output, &args.html) {
        output.write(|file| file.write_all(page.as_bytes()).map_err(WriteProblem::from))?;
        console.note(&format!("{}: {shown_frames}, {} bytes", html.display(), grouped(page.len() as u64)));
        object["output"] = json!(shown(html));
        console.object(&object)?;
    }
    if let Some(server) = server {
        let asking = Asking::to_leave();
        object["url"] = json!(server.url());
        console.object(&object)?;
        console.note(&format!("{shown_frames} at {} until Ctrl-C", server.url()));
        server.serve(&page, asking.flag());
    }
    Ok(0)
}

/// Refuses pages that are longer than so many bytes, once so many frames of all are.
fn refuse_longer(
    bytes: usize,
    most: usize,
    [done, all]: [usize; 2],
    args: &Args,
) -> Result<(), Box<Failure>> {
    if bytes <= most {
        return Ok(());
    }
    let whole = (bytes / done).saturating_mul(all).max(bytes);
    let what = format!("the page would take some {} bytes", grouped(whole as u64));
    let failure = Failure::new(Code::PageTooLong, what).subject(shown(&args.input));
    let every = args.every as usize * whole.div_ceil(most);
    Err(if all == 1 {
        failure.help(format!("welter render {} -o picture.png", shell_word(&args.input)))
    } else {
        failure.help(format!("welter view {} --every {every}", shell_word(&args.input)))
    })
}

/// The names and files of all frames that are shown.
fn files(args: &Args) -> Result<Vec<(String, PathBuf)>, Box<Failure>> {
    let frames = if args.input.is_dir() {
        let pattern = args.input.join("surface").join("frame_%04d.ply");
        let found = Pattern::of(&pattern).map(|pattern| pattern.frames());
        match found {
            Some(Ok(frames)) => frames,
            _ => {
                return Err(Failure::new(Code::NoRunFile, "the folder holds no frames of a run")
                    .subject(shown(&args.input))
                    .help("name a folder that has surface/frame_0000.ply, or a file"));
            }
        }
    } else if let Some(pattern) = Pattern::of(&args.input).filter(|_| !args.input.exists()) {
        pattern.frames()?
    } else {
        return Ok(vec![(shown(&args.input), args.input.clone())]);
    };
    let named = |frame: crate::sequence::Frame| (format!("frame {}", frame.number), frame.path);
    Ok(frames.into_iter().step_by(args.every as usize).map(named).collect())
}

/// The surface of a file, or the boundary of its volumetric mesh; refused if it is no mesh. No triangles are nothing to be seen, no fault.
fn read(path: &Path, args: &Args, run: &Run) -> Result<TriangleSoup, Box<Failure>> {
    let progress = &run.console.progress;
    let soup = match volume_format_of(path, &args.reading) {
        Some(format) => {
            let (mesh, _) = VolumeInput::open(path, format, &args.reading)?.read(progress)?;
            if let Some(vertex) = mesh.positions.iter().position(|position| !position.is_finite()) {
                return Err(Failure::new(Code::NonFiniteVertex, "a vertex has a non-finite coordinate")
                    .subject(shown(path))
                    .place(format!("vertex {vertex}, counted from 0"))
                    .help(format!("welter info {}   # counts them", shell_word(path))));
            }
            mesh.boundary()
        }
        None => Input::open(path, &args.reading)?.read(progress)?.0,
    };
    match TriMesh::check(&soup) {
        Ok(()) => Ok(soup),
        Err(error) => Err(failures_of(&error, path).swap_remove(0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct Line {
        #[command(flatten)]
        args: Args,
    }

    #[test]
    fn long_pages_are_refused_with_what_would_do() {
        let line = Line::parse_from(["view", "run", "--every", "2"]);
        assert!(refuse_longer(100, 100, [1, 3], &line.args).is_ok());
        let told = |bytes, frames| refuse_longer(bytes, 100, frames, &line.args).unwrap_err();
        let failure = told(150, [1, 3]);
        assert_eq!((failure.code.id(), failure.help.as_str()), ("W6005", "welter view run --every 10"));
        assert_eq!(told(150, [1, 1]).help, "welter render run -o picture.png");
    }
}
