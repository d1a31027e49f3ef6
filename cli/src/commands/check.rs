//! `welter check`: is it closed, is it oriented, where exactly does it intersect itself?
//!
//! The report is the product, so a surface that is open, inconsistently oriented or self-intersecting is reported with
//! exit code 0; `--require` makes a gate of it. Exit code 3 means that some question has no answer because the file
//! holds no mesh: a non-finite coordinate, an index out of range, a triangle with a repeated vertex.

#![allow(clippy::vec_box, reason = "failures travel boxed, so that results stay small")]

use crate::codes::Code;
use crate::examine::{self, Findings, HEADINGS};
use crate::failure::{Failure, shell_word, shown};
use crate::input::{Input, Reading};
use crate::numbers::grouped;
use crate::output::Output;
use crate::run::{Outcome, Run};
use crate::surface_file::{refuse_standard_output, write_surface};
use crate::table::aligned;
use clap::ValueEnum;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use welter_meshing::io::{Format, WriteOptions};
use welter_meshing::spatial::Sharing;
use welter_meshing::surface::{TriMesh, TriMeshDefects, TriMeshError, TriangleSoup};

/// Check surfaces exactly: closed, oriented, manifold, and every pair of triangles that intersect
#[derive(Debug, clap::Args)]
#[command(after_help = "\
A self-intersecting pair is two triangles with a common point outside of the vertex or edge that they share
(the same position; with --shared-by index, the same vertex of the file).
Counts are exact for every finite coordinate.

Exit codes: 0 when every question was answered, whatever the answer; 3 when a file holds no mesh (a non-finite
coordinate, an index out of range, a repeated vertex in a triangle) or lacks what --require asks for; 4 when a
file cannot be read. With several files, the code of the first that failed.

Examples:
  welter check part.stl
  welter check --json --pairs part.obj > part.json
  welter check part.obj --save-bad bad.ply
  welter check --quiet --require embedded *.obj && echo all good")]
pub(crate) struct Args {
    /// Files to check (obj, ply, stl, off); `-` is standard input
    #[arg(required = true)]
    inputs: Vec<PathBuf>,
    /// List every self-intersecting pair of triangles (numbered from 0)
    #[arg(long)]
    pairs: bool,
    /// Write the offending triangles, coloured, as PLY, not overwritten without --force. Red: self-intersecting;
    /// yellow: degenerate; blue: at a boundary; violet: at an edge that is inconsistent or not manifold
    #[arg(long, value_name = "OUT")]
    save_bad: Option<PathBuf>,
    /// Fail with exit code 3 unless every file has this property (may be repeated)
    #[arg(long, value_enum, value_name = "PROPERTY", value_delimiter = ',')]
    require: Vec<Property>,
    /// When two triangles share a vertex, where they may touch: same position, or same index only
    #[arg(long, value_enum, default_value_t = SharedBy::Position, value_name = "WHAT")]
    shared_by: SharedBy,
    #[command(flatten)]
    reading: Reading,
}

/// What makes a vertex of two triangles the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum SharedBy {
    // Same coordinates: right for files whose vertices are not welded.
    Position,
    // Same index: parts that merely touch at separate vertices count as intersecting.
    Index,
}

impl SharedBy {
    fn sharing(self) -> Sharing {
        match self {
            Self::Position => Sharing::Position,
            Self::Index => Sharing::Index,
        }
    }
}

/// What can be required.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Property {
    // No boundary edge.
    Closed,
    // Neighbours agree on the inside.
    Oriented,
    // Edges have at most two triangles, vertices one fan.
    Manifold,
    // Closed, oriented, and free of self-intersection.
    Embedded,
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let console = &run.console;
    let bad = prepare_save_bad(args, run)?;
    let single = args.inputs.len() == 1;
    let mut rows = vec![HEADINGS.map(str::to_owned)];
    let mut files = Vec::new();
    let mut first: Option<Box<Failure>> = None;
    let mut mesh_of_single = None;
    for file in &args.inputs {
        let mut object = Map::new();
        object.insert("file".to_owned(), json!(shown(file)));
        let mut failures = Vec::new();
        match check(file, args, run) {
            Ok((mesh, findings)) => {
                object.extend(findings.to_json(args.pairs));
                failures = lacking(file, &findings, &args.require);
                if single {
                    console.result(&examine::block(file, &findings))?;
                    if args.pairs && !console.json {
                        console.result(&list_of_pairs(&findings))?;
                    }
                    mesh_of_single = Some((mesh, findings));
                } else {
                    console.detail(1, &format!("{}: {}", file.display(), findings.verdict()));
                    rows.push(examine::row(file, &findings));
                }
            }
            Err(Unchecked { known, failures: found }) => {
                object.extend(known);
                failures.extend(found);
            }
        }
        for failure in failures {
            console.error(&failure);
            object.entry("error").or_insert_with(|| failure.to_json());
            first.get_or_insert(failure);
        }
        files.push(Value::Object(object));
    }
    if rows.len() > 1 {
        console.result(&aligned(&rows, &[0]))?;
    }
    let mut object = Map::new();
    object.insert("files".to_owned(), Value::Array(files));
    if let (Some(output), Some((mesh, findings))) = (bad, &mesh_of_single) {
        let surface = examine::offending(mesh, findings);
        let count = surface.triangles.len();
        let name = output.name().to_owned();
        let _ = write_surface(output, Format::Ply, &surface, &WriteOptions::default())?;
        console.note(&format!("{}: {} offending triangles", name.display(), grouped(count as u64)));
        object.insert("save_bad".to_owned(), json!({ "file": shown(&name), "triangles": count }));
    }
    if let Some(failure) = &first {
        object.insert("error".to_owned(), failure.to_json());
    }
    console.object(&Value::Object(object))?;
    Ok(first.map_or(0, |failure| failure.code.exit()))
}

fn prepare_save_bad(args: &Args, run: &Run) -> Result<Option<Output>, Box<Failure>> {
    let Some(name) = &args.save_bad else {
        return Ok(None);
    };
    if args.inputs.len() != 1 {
        return Err(Failure::new(Code::Usage, "--save-bad goes with one input")
            .why(
                "the triangles of several files would end up in one, without a trace of where they came from",
            )
            .help(format!("welter check {} --save-bad {}", shell_word(&args.inputs[0]), shell_word(name))));
    }
    refuse_standard_output(name)?;
    Output::prepare(name, run.force, &[args.inputs[0].as_path()]).map(Some)
}

/// A file without findings: what is known of it all the same, and why there are none.
struct Unchecked {
    known: Map<String, Value>,
    failures: Vec<Box<Failure>>,
}

impl From<Box<Failure>> for Unchecked {
    fn from(failure: Box<Failure>) -> Self {
        Self { known: Map::new(), failures: vec![failure] }
    }
}

fn check(file: &Path, args: &Args, run: &Run) -> Result<(TriMesh, Findings), Unchecked> {
    let console = &run.console;
    let mut seconds = crate::console::Seconds::default();
    let input = Input::open(file, &args.reading)?;
    let (soup, held) = console.stage(&mut seconds, "reading", || input.read(&console.progress))?;
    for ignored in &held.ignored {
        console.detail(
            2,
            &format!("{}: {} ({}) passed over", file.display(), ignored.what, grouped(ignored.count)),
        );
    }
    let mesh = mesh_of(soup, file)?;
    let findings = Findings::of(&mesh, args.shared_by.sharing(), console, seconds)?;
    console.progress.clear();
    Ok((mesh, findings))
}

/// The soup as a mesh, or every defect.
fn mesh_of(soup: TriangleSoup, file: &Path) -> Result<TriMesh, Unchecked> {
    if let Err(error) = TriMesh::check(&soup) {
        let mut known = Map::new();
        if let TriMeshError::Defects(defects) = &error {
            known = examine::json_of_defects(&soup, defects);
        }
        return Err(Unchecked { known, failures: failures_of(&error, file) });
    }
    TriMesh::new(soup).map_err(|error| Unchecked { known: Map::new(), failures: failures_of(&error, file) })
}

/// One failure for each kind of defect.
pub(crate) fn failures_of(error: &TriMeshError, file: &Path) -> Vec<Box<Failure>> {
    let shown = file.display().to_string();
    let mended = match file.file_stem() {
        Some(stem) => file.with_file_name(format!("{}-mended.ply", stem.to_string_lossy())),
        None => PathBuf::from("mended.ply"),
    };
    let help = format!("welter convert {} -o {} --drop-defects", shell_word(file), shell_word(&mended));
    let TriMeshError::Defects(defects) = error else {
        return vec![
            Failure::new(Code::OverCount, error.to_string()).subject(shown).help("split the file into parts"),
        ];
    };
    let TriMeshDefects { non_finite_vertices, indices_out_of_range, repeated_indices, .. } = &**defects;
    let count = |n: usize, one: &str, many: &str| {
        if n == 1 { format!("1 {one}") } else { format!("{} {many}", grouped(n as u64)) }
    };
    let mut failures = Vec::new();
    if !non_finite_vertices.is_empty() {
        let what = count(
            non_finite_vertices.len(),
            "vertex has a non-finite coordinate",
            "vertices have a non-finite coordinate",
        );
        let failure = Failure::new(Code::NonFiniteVertex, what);
        failures.push(non_finite_vertices.iter().fold(failure, |failure, found| {
            let p = found.position;
            failure.place(format!("vertex {} at ({}, {}, {})", found.vertex.0, p.x, p.y, p.z))
        }));
    }
    for (list, code, one, many) in [
        (
            indices_out_of_range,
            Code::IndexOutOfRange,
            "triangle has an index out of range",
            "triangles have an index out of range",
        ),
        (
            repeated_indices,
            Code::RepeatedIndex,
            "triangle names a vertex twice",
            "triangles name a vertex twice",
        ),
    ] {
        if !list.is_empty() {
            let failure = Failure::new(code, count(list.len(), one, many));
            failures.push(list.iter().fold(failure, |failure, found| {
                let [a, b, c] = found.indices;
                failure.place(format!("triangle {} of vertices {a}, {b}, {c}", found.triangle.0))
            }));
        }
    }
    if failures.is_empty() {
        failures.push(Failure::new(
            Code::OwnBug,
            format!("a reader gave groups or colours that do not fit: {defects}"),
        ));
    }
    failures.into_iter().map(|failure| failure.subject(shown.clone()).help(help.clone())).collect()
}

/// A failure for each required property that the file lacks.
fn lacking(file: &Path, findings: &Findings, required: &[Property]) -> Vec<Box<Failure>> {
    let wants = |property| required.contains(&property) || required.contains(&Property::Embedded);
    let word = shell_word(file);
    let look = format!("welter check {word} --save-bad bad.ply   # then: welter render bad.ply -o bad.png");
    let fail =
        |code, what: String| Failure::new(code, what).subject(file.display().to_string()).help(look.clone());
    let mut failures = Vec::new();
    if wants(Property::Closed) && !findings.topology.is_closed() {
        failures.push(fail(
            Code::NotClosed,
            format!("{} boundary edges", grouped(findings.boundary_edges.len() as u64)),
        ));
    }
    if wants(Property::Oriented) && !findings.topology.is_oriented() {
        let count = grouped(findings.topology.inconsistent_edges().len() as u64);
        failures
            .push(fail(Code::NotOriented, format!("{count} edges whose triangles disagree on the inside")));
    }
    if required.contains(&Property::Manifold)
        && !(findings.topology.is_edge_manifold() && findings.topology.is_vertex_manifold())
    {
        let (edges, vertices) =
            (findings.topology.non_manifold_edges().len(), findings.topology.non_manifold_vertices().len());
        failures.push(fail(
            Code::NotManifold,
            format!(
                "{} non-manifold edges, {} non-manifold vertices",
                grouped(edges as u64),
                grouped(vertices as u64)
            ),
        ));
    }
    if let (true, Some([i, j])) = (required.contains(&Property::Embedded), findings.pairs.first()) {
        let what = format!("{} self-intersecting triangle pairs", grouped(findings.pairs.len() as u64));
        failures
            .push(fail(Code::SelfIntersecting, what).place(format!("first: triangles {} and {}", i.0, j.0)));
    }
    failures
}

fn list_of_pairs(findings: &Findings) -> String {
    let mut text = String::new();
    for [i, j] in &findings.pairs {
        text.push_str(&format!("{} {}\n", i.0, j.0));
    }
    text
}
