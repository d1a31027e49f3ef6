//! `welter info`: what a file holds, without exact tests.

mod surface;
mod volume;

use crate::failure::{Failure, shown};
use crate::input::{Reading, cannot_read, format_of};
use crate::numbers::{grouped, number, point};
use crate::run::{Outcome, Run};
use crate::volume_input::volume_format_of;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use surface::SurfaceFacts;
use volume::VolumeFacts;
use welter_meshing::{DVec3, io::ReadReport};

/// Tell what a file, or each file of a folder, holds: format, sizes, bounding box, groups; of volumetric meshes cells and fields too
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Nothing is tested: for closedness, orientation and self-intersection use `welter check`."
)]
pub(crate) struct Args {
    /// File or folder
    path: PathBuf,
    #[command(flatten)]
    reading: Reading,
}

/// Width of the column of names, unless one is longer.
const LABEL: usize = 13;

/// Groups and fields listed for people; JSON has them all.
const LISTED: usize = 12;

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let folder = args.path.is_dir();
    let files = if folder { files_of(&args.path, &args.reading)? } else { vec![args.path.clone()] };
    if files.is_empty() {
        run.console.result(&format!(
            "{}: no file of a surface (obj, ply, stl, off) or volumetric mesh (vtu, msh, mesh)\n",
            args.path.display()
        ))?;
    }
    let mut list = Vec::new();
    let mut exit = 0;
    let mut rows =
        vec![["file", "format", "bytes", "vertices", "cells", "groups", "size"].map(str::to_owned)];
    for file in &files {
        match About::of(file, &args.reading, run) {
            Ok(about) if folder => {
                rows.push(about.row(file));
                list.push(about.to_json(file));
            }
            Ok(about) => {
                run.console.result(&about.to_text(file))?;
                list.push(about.to_json(file));
            }
            Err(failure) if folder => {
                run.console.error(&failure);
                list.push(json!({ "file": shown(file), "error": failure.to_json() }));
                if exit == 0 {
                    exit = failure.code.exit();
                }
            }
            Err(failure) => return Err(failure),
        }
    }
    if folder && rows.len() > 1 {
        run.console.result(&crate::table::aligned(&rows, &[0, 1]))?;
    }
    run.console.object(&json!({ "files": list }))?;
    Ok(exit)
}

fn files_of(folder: &Path, reading: &Reading) -> Result<Vec<PathBuf>, Box<Failure>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(|error| cannot_read(folder, &error))? {
        let path = entry.map_err(|error| cannot_read(folder, &error))?.path();
        if path.is_file()
            && (format_of(&path, "--from").is_ok() || volume_format_of(&path, reading).is_some())
        {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// What a file holds.
enum About {
    Surface(SurfaceFacts),
    Volume(VolumeFacts),
}

impl About {
    fn of(file: &Path, reading: &Reading, run: &Run) -> Result<Self, Box<Failure>> {
        match volume_format_of(file, reading) {
            Some(format) => VolumeFacts::of(file, format, reading, run).map(Self::Volume),
            None => SurfaceFacts::of(file, reading, run).map(Self::Surface),
        }
    }

    fn row(&self, file: &Path) -> [String; 7] {
        let name = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned();
        match self {
            Self::Surface(facts) => facts.row(name),
            Self::Volume(facts) => facts.row(name),
        }
    }

    fn to_text(&self, file: &Path) -> String {
        let lines = match self {
            Self::Surface(facts) => facts.lines(),
            Self::Volume(facts) => facts.lines(),
        };
        let width = lines.iter().map(|(name, _)| name.len()).max().unwrap_or(0).max(LABEL);
        let text = lines.into_iter().map(|(name, value)| format!("  {name:<width$} {value}\n"));
        format!("{}\n{}", file.display(), text.collect::<String>())
    }

    fn to_json(&self, file: &Path) -> Value {
        match self {
            Self::Surface(facts) => facts.to_json(file),
            Self::Volume(facts) => facts.to_json(file),
        }
    }
}

/// A name and what belongs to it; the name is empty where that of the line before goes on.
type Line = (&'static str, String);

/// Where vertices are.
struct Bounds {
    /// The corners of the box of the finite vertices.
    sides: Option<[DVec3; 2]>,
    non_finite: usize,
}

impl Bounds {
    fn of(positions: &[DVec3]) -> Self {
        let finite = positions.iter().copied().filter(|position| position.is_finite());
        let sides = finite.fold(None, |sides: Option<[DVec3; 2]>, p| {
            Some(sides.map_or([p, p], |[low, high]| [low.min(p), high.max(p)]))
        });
        Self { sides, non_finite: positions.iter().filter(|position| !position.is_finite()).count() }
    }

    fn lines(&self) -> Vec<Line> {
        let mut lines = Vec::new();
        if let Some([low, high]) = self.sides {
            lines.push(("bounding box", format!("{} .. {}", point(low), point(high))));
            lines.push(("size", size([low, high])));
        }
        if self.non_finite > 0 {
            lines.push(("non-finite", format!("{} vertices", grouped(self.non_finite as u64))));
        }
        lines
    }

    fn to_json(&self) -> Value {
        json!(self.sides.map(|[low, high]| [low.to_array(), high.to_array()]))
    }
}

fn not_read(held: &ReadReport) -> impl Iterator<Item = Line> {
    held.ignored.iter().map(|i| ("not read", format!("{} ({})", i.what, grouped(i.count))))
}

fn ignored(held: &ReadReport) -> Vec<Value> {
    held.ignored.iter().map(|i| json!({ "what": i.what, "count": i.count })).collect()
}

fn size([low, high]: [DVec3; 2]) -> String {
    let size = high - low;
    format!("{} x {} x {}", number(size.x), number(size.y), number(size.z))
}
