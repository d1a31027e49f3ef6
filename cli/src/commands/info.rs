//! `welter info`: what a file holds, without exact tests.

use crate::failure::{Failure, shown};
use crate::input::{Input, Reading, cannot_read, format_of};
use crate::numbers::{bytes, grouped, number, point};
use crate::run::{Outcome, Run};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use welter_meshing::io::Format;
use welter_meshing::surface::TriangleSoup;
use welter_meshing::{DVec3, io::ReadReport};

/// Tell what a surface file, or each surface file of a folder, holds: format, sizes, bounding box, groups
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

/// Groups listed for people; JSON has them all.
const LISTED: usize = 12;

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let folder = args.path.is_dir();
    let files = if folder { surfaces_of(&args.path)? } else { vec![args.path.clone()] };
    if files.is_empty() {
        run.console.result(&format!("{}: no surface file (obj, ply, stl, off)\n", args.path.display()))?;
    }
    let mut list = Vec::new();
    let mut exit = 0;
    let mut rows =
        vec![["file", "format", "bytes", "vertices", "triangles", "groups", "size"].map(str::to_owned)];
    for file in &files {
        match describe(file, &args.reading, run) {
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

fn surfaces_of(folder: &Path) -> Result<Vec<PathBuf>, Box<Failure>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(|error| cannot_read(folder, &error))? {
        let path = entry.map_err(|error| cannot_read(folder, &error))?.path();
        if path.is_file() && format_of(&path, "--from").is_ok() {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

struct About {
    format: Format,
    bytes: Option<u64>,
    soup: TriangleSoup,
    held: ReadReport,
    /// Of the finite vertices.
    bounds: Option<[DVec3; 2]>,
    non_finite: usize,
}

fn describe(file: &Path, reading: &Reading, run: &Run) -> Result<About, Box<Failure>> {
    let input = Input::open(file, reading)?;
    let (format, bytes) = (input.format, input.bytes);
    let (soup, held) = input.read(&run.console.progress)?;
    run.console.progress.clear();
    let finite = soup.positions.iter().copied().filter(|position| position.is_finite());
    let bounds = finite.fold(None, |bounds: Option<[DVec3; 2]>, p| {
        Some(bounds.map_or([p, p], |[low, high]| [low.min(p), high.max(p)]))
    });
    let non_finite = soup.positions.iter().filter(|position| !position.is_finite()).count();
    Ok(About { format, bytes, soup, held, bounds, non_finite })
}

impl About {
    fn row(&self, file: &Path) -> [String; 7] {
        [
            file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned(),
            self.format.to_string(),
            self.bytes.map_or_else(String::new, grouped),
            grouped(self.soup.positions.len() as u64),
            grouped(self.soup.triangles.len() as u64),
            grouped(self.soup.groups.len() as u64),
            self.bounds.map_or_else(String::new, size),
        ]
    }

    fn to_text(&self, file: &Path) -> String {
        let mut text = format!("{}\n", file.display());
        let mut line = |name: &str, value: String| {
            let _ = writeln!(text, "  {name:<13} {value}");
        };
        let size_on_disk = self.bytes.map_or_else(String::new, |count| format!(", {}", bytes(count)));
        line("format", format!("{}{size_on_disk}", self.format));
        line("vertices", grouped(self.soup.positions.len() as u64));
        line("triangles", grouped(self.soup.triangles.len() as u64));
        if let Some([low, high]) = self.bounds {
            line("bounding box", format!("{} .. {}", point(low), point(high)));
            line("size", size([low, high]));
        }
        if self.non_finite > 0 {
            line("non-finite", format!("{} vertices", grouped(self.non_finite as u64)));
        }
        if !self.soup.triangle_colors.is_empty() {
            line("colours", "one a triangle".to_owned());
        }
        for ignored in &self.held.ignored {
            line("not read", format!("{} ({})", ignored.what, grouped(ignored.count)));
        }
        for (k, group) in self.soup.groups.iter().enumerate().take(LISTED) {
            let label = if k == 0 { "groups" } else { "" };
            line(label, format!("{:?}, {} triangles", group.name, grouped(group.triangles.len() as u64)));
        }
        if self.soup.groups.len() > LISTED {
            line("", format!("and {} more", grouped((self.soup.groups.len() - LISTED) as u64)));
        }
        text
    }

    fn to_json(&self, file: &Path) -> Value {
        let groups: Vec<Value> = self
            .soup
            .groups
            .iter()
            .map(|group| json!({ "name": group.name, "triangles": group.triangles.len() }))
            .collect();
        let ignored: Vec<Value> =
            self.held.ignored.iter().map(|i| json!({ "what": i.what, "count": i.count })).collect();
        json!({
            "file": shown(file),
            "format": self.format.extension(),
            "bytes": self.bytes,
            "vertices": self.soup.positions.len(),
            "triangles": self.soup.triangles.len(),
            "non_finite_vertices": self.non_finite,
            "bounding_box": self.bounds.map(|[low, high]| [low.to_array(), high.to_array()]),
            "groups": groups,
            "triangle_colors": !self.soup.triangle_colors.is_empty(),
            "not_read": ignored,
        })
    }
}

fn size([low, high]: [DVec3; 2]) -> String {
    let size = high - low;
    format!("{} x {} x {}", number(size.x), number(size.y), number(size.z))
}
