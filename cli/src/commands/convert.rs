//! `welter convert`: from one surface format to another, one file or a sequence of frames.

use crate::codes::Code;
use crate::console::Seconds;
use crate::failure::{Failure, shell_word, shown};
use crate::input::{Input, Reading};
use crate::numbers::grouped;
use crate::output::Output;
use crate::run::{Outcome, Run};
use crate::sequence::Pattern;
use crate::surface_file::{Writing, refuse_standard_output_with_json, write_surface};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use welter_meshing::surface::{Group, TriangleSoup};

/// Convert a surface, or a sequence of frames, to another format
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  welter convert part.stl -o part.ply
  welter convert 'run/frame_%04d.ply' -o 'obj/frame_{}.obj'
  gunzip -c part.obj.gz | welter convert - --from obj -o part.ply

A pattern stands for a sequence: %04d is a number of four digits, {} one of any length (written as the input
has it). What the output format cannot hold is told, never dropped in silence.")]
pub(crate) struct Args {
    /// File to read (obj, ply, stl, off), `-` for standard input, or a pattern for a sequence
    input: PathBuf,
    #[command(flatten)]
    writing: Writing,
    #[command(flatten)]
    reading: Reading,
    /// Leave out triangles with a repeated vertex or a non-finite corner, and non-finite vertices
    #[arg(long)]
    drop_defects: bool,
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    refuse_standard_output_with_json(&args.writing.output, run)?;
    args.writing.format()?;
    let files: Vec<(PathBuf, PathBuf)> = match (Pattern::of(&args.input), Pattern::of(&args.writing.output)) {
        (Some(from), Some(to)) => {
            from.frames()?.into_iter().map(|frame| (frame.path.clone(), to.path_of(&frame))).collect()
        }
        // A file may really be called so.
        (Some(_), None) if args.input.is_file() => vec![(args.input.clone(), args.writing.output.clone())],
        (Some(_), None) => return Err(one_sided(&args.writing.output, "plain name", "frame_{}.ply")),
        (None, Some(_)) => return Err(one_sided(&args.input, "plain name", "frame_%04d.ply")),
        (None, None) => vec![(args.input.clone(), args.writing.output.clone())],
    };
    let sequence = files.len() > 1;
    // Every output is tried before the first is written.
    let inputs: Vec<&Path> = files.iter().map(|(input, _)| input.as_path()).collect();
    for (_, output) in files.iter().filter(|_| sequence) {
        drop(Output::prepare(output, run.force, &inputs)?);
    }
    let mut seconds = Seconds::default();
    let mut list = Vec::new();
    let total = files.len() as u64;
    for (done, (input, output)) in files.iter().enumerate() {
        if sequence {
            run.console.progress.report("frames", done as u64, total);
        }
        list.push(convert(args, input, output, run, &mut seconds)?);
    }
    if sequence {
        run.console.progress.clear();
        run.console.note(&format!("{} frames written", grouped(total)));
    }
    run.console.object(&json!({ "files": list, "seconds": seconds.to_json() }))?;
    Ok(0)
}

fn one_sided(name: &Path, kind: &str, example: &str) -> Box<Failure> {
    Failure::new(Code::SequenceMismatch, format!("this is a {kind}, and the other side is a pattern"))
        .subject(name.display().to_string())
        .help(format!("use a pattern on both sides, such as {example}"))
}

fn convert(
    args: &Args,
    input: &Path,
    output: &Path,
    run: &Run,
    seconds: &mut Seconds,
) -> Result<Value, Box<Failure>> {
    let console = &run.console;
    let format = args.writing.format()?;
    let source = Input::open(input, &args.reading)?;
    let file = Output::prepare(output, run.force, &[input])?;
    let (mut soup, held) = console.stage(seconds, "reading", || source.read(&console.progress))?;
    let mut dropped: Vec<String> =
        held.ignored.iter().map(|ignored| format!("{} not read", ignored.what)).collect();
    if args.drop_defects {
        let before = (soup.positions.len(), soup.triangles.len());
        soup = without_defects(soup);
        for (count, what) in
            [(before.0 - soup.positions.len(), "vertices"), (before.1 - soup.triangles.len(), "triangles")]
        {
            if count > 0 {
                dropped.push(format!("{} defective {what} left out", grouped(count as u64)));
            }
        }
    }
    dropped.extend(
        console
            .stage(seconds, "writing", || write_surface(file, format, &soup, &args.writing.options()))
            .map_err(|mut failure| {
                failure.help = failure.help.replace(
                    "add --drop-defects",
                    &format!("welter convert {} -o {} --drop-defects", shell_word(input), shell_word(output)),
                );
                failure
            })?,
    );
    for loss in &dropped {
        console.note(&format!("{}: {loss}", output.display()));
    }
    console.detail(
        1,
        &format!(
            "{}: {} vertices, {} triangles",
            output.display(),
            grouped(soup.positions.len() as u64),
            grouped(soup.triangles.len() as u64)
        ),
    );
    Ok(json!({
        "input": shown(input),
        "output": shown(output),
        "format": format.extension(),
        "vertices": soup.positions.len(),
        "triangles": soup.triangles.len(),
        "dropped": dropped,
    }))
}

/// The soup without what keeps it from being a mesh: non-finite vertices, and triangles that name one, a vertex
/// that does not exist, or a vertex twice.
fn without_defects(soup: TriangleSoup) -> TriangleSoup {
    const GONE: u32 = u32::MAX;
    let mut new_index = Vec::with_capacity(soup.positions.len());
    let mut positions = Vec::with_capacity(soup.positions.len());
    for position in soup.positions {
        if position.is_finite() {
            new_index.push(positions.len() as u32);
            positions.push(position);
        } else {
            new_index.push(GONE);
        }
    }
    let mut kept = Vec::new();
    let mut triangles = Vec::with_capacity(soup.triangles.len());
    // How many triangles were kept before each: the new place of a group's ends.
    let mut kept_before = Vec::with_capacity(soup.triangles.len() + 1);
    for (id, triangle) in soup.triangles.iter().enumerate() {
        kept_before.push(triangles.len() as u32);
        let [a, b, c] = triangle.map(|v| new_index.get(v as usize).copied().unwrap_or(GONE));
        if a != GONE && b != GONE && c != GONE && a != b && b != c && c != a {
            triangles.push([a, b, c]);
            kept.push(id);
        }
    }
    kept_before.push(triangles.len() as u32);
    let place = |end: u32| kept_before[(end as usize).min(kept_before.len() - 1)];
    let groups = soup
        .groups
        .into_iter()
        .map(|Group { name, triangles }| Group {
            name,
            triangles: place(triangles.start)..place(triangles.end),
        })
        .collect();
    let triangle_colors = if soup.triangle_colors.len() == soup.triangles.len() {
        kept.iter().map(|&id| soup.triangle_colors[id]).collect()
    } else {
        Vec::new()
    };
    TriangleSoup { positions, triangles, groups, triangle_colors }
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::DVec3;
    use welter_meshing::surface::TriMesh;

    #[test]
    fn what_is_left_without_defects_is_a_mesh() {
        let soup = TriangleSoup {
            positions: vec![DVec3::ZERO, DVec3::NAN, DVec3::X, DVec3::Y, DVec3::INFINITY],
            triangles: vec![[0, 1, 2], [0, 2, 3], [0, 0, 2], [0, 2, 9], [3, 2, 0]],
            groups: vec![
                Group { name: "a".into(), triangles: 0..2 },
                Group { name: "b".into(), triangles: 2..5 },
            ],
            triangle_colors: vec![[0; 3], [1; 3], [2; 3], [3; 3], [4; 3]],
        };
        let soup = without_defects(soup);
        assert_eq!(soup.triangles, [[0, 1, 2], [2, 1, 0]]);
        assert_eq!(soup.triangle_colors, [[1; 3], [4; 3]]);
        assert_eq!((soup.groups[0].triangles.clone(), soup.groups[1].triangles.clone()), (0..1, 1..2));
        assert!(TriMesh::new(soup).is_ok());
    }
}
