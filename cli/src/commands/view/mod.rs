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
use page::{Show, page};
use rayon::prelude::*;
use serde_json::json;
use server::Server;
use std::path::{Path, PathBuf};
use welter_meshing::DVec3;
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
    let soups = console.stage(&mut seconds, "reading", || {
        files
            .iter()
            .map(|(name, path)| Ok((name, read(path, args, run)?)))
            .collect::<Result<Vec<_>, Box<Failure>>>()
    })?;
    let (triangles, vertices) = soups.iter().fold((0, 0), |(triangles, vertices), (_, soup)| {
        (triangles.max(soup.triangles.len()), vertices.max(soup.positions.len()))
    });
    let used = || soups.iter().flat_map(|(_, soup)| &soup.positions);
    let min = used().copied().reduce(DVec3::min).unwrap_or_default();
    let max = used().copied().reduce(DVec3::max).unwrap_or_default();
    let cube = Cube::around(min, max);
    let frames: Vec<(String, Vec<u8>)> = console.stage(&mut seconds, "packing", || {
        soups.par_iter().map(|(name, soup)| ((*name).clone(), pack(soup, &cube))).collect()
    });
    drop(soups);
    let bytes: usize = frames.iter().map(|(_, bytes)| bytes.len().div_ceil(3) * 4).sum();
    refuse_longer(bytes, LONGEST, args)?;
    let up = if args.up == UpAxis::Y { "y" } else { "z" };
    let title = shown(&args.input);
    let page = page(&Show { title: &title, frames: &frames, cube, up });
    console.progress.clear();
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
        console.note(&format!(
            "{}: {} frames, {} bytes",
            html.display(),
            frames.len(),
            grouped(page.len() as u64)
        ));
        object["output"] = json!(shown(html));
        console.object(&object)?;
    }
    if let Some(server) = server {
        let asking = Asking::to_leave();
        object["url"] = json!(server.url());
        console.object(&object)?;
        console.note(&format!("{} frames at {} until Ctrl-C", frames.len(), server.url()));
        server.serve(&page, asking.flag());
    }
    Ok(0)
}

/// Refuses pages that are longer than so many bytes.
fn refuse_longer(bytes: usize, most: usize, args: &Args) -> Result<(), Box<Failure>> {
    if bytes <= most {
        return Ok(());
    }
    let every = args.every as usize * bytes.div_ceil(most);
    let failure =
        Failure::new(Code::PageTooLong, format!("the page would take {} bytes", grouped(bytes as u64)));
    Err(failure
        .subject(shown(&args.input))
        .help(format!("welter view {} --every {every}", shell_word(&args.input))))
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
        assert!(refuse_longer(100, 100, &line.args).is_ok());
        let failure = refuse_longer(250, 100, &line.args).unwrap_err();
        assert_eq!((failure.code.id(), failure.help.as_str()), ("W6005", "welter view run --every 6"));
    }
}
