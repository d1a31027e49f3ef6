//! The report of a run: `report.json` for scripts, `report.html` to open in a browser.

use super::frames::volume_path;
use super::record::Status;
use crate::failure::{Failure, shell_word};
use crate::html::Page;
use crate::output::write_whole;
use serde_json::{Map, Value};
use std::fs;
use std::path::Path;

pub(super) const HTML: &str = "report.html";
pub(super) const JSON: &str = "report.json";

/// Values a step that are drawn as curves, where the steps have them.
const CURVES: [(&str, &[&str]); 5] = [
    ("volume", &["volume"]),
    ("area", &["area"]),
    ("triangles", &["triangles"]),
    ("components", &["components"]),
    ("seconds a step", &["seconds", "total"]),
];

/// Writes both files.
pub(super) fn write(
    folder: &Path,
    solver: &str,
    status: Status,
    result: &Map<String, Value>,
    lines: &[&Value],
) -> Result<(), Box<Failure>> {
    let object = Value::Object(result.clone());
    write_whole(&folder.join(JSON), |file| writeln!(file, "{object:#}"))?;
    let graphs: Vec<(String, Vec<f64>)> = CURVES
        .iter()
        .filter_map(|(name, path)| {
            let value = |line: &Value| path.iter().try_fold(line, |at, key| at.get(key))?.as_f64();
            let values: Vec<f64> = lines.iter().map(|line| value(line).unwrap_or(f64::NAN)).collect();
            values.iter().any(|value| value.is_finite()).then(|| ((*name).to_owned(), values))
        })
        .collect();
    let mut rows = Vec::new();
    flatten("", &object, &mut rows);
    let previews = [first_and_last(folder, lines)].concat();
    let pictures: Vec<(&[u8], &str)> =
        previews.iter().map(|(png, caption)| (png.as_slice(), caption.as_str())).collect();
    let last = lines.last().map_or(0.0, |line| line["time"].as_f64().unwrap_or(0.0));
    let word = shell_word(folder);
    let page = Page {
        title: &format!("welter {solver}: {}", folder.display()),
        verdict: &format!("{}: {} steps, to time {last}", status.name(), lines.len().saturating_sub(1)),
        pictures: &pictures,
        graphs: &graphs,
        tables: &[("Result", rows)],
        commands: &[
            format!("welter check {word}/surface/frame_0000.ply"),
            format!("welter render {word}/surface/frame_0000.ply -o closer.png --edges"),
            format!("paraview {word}/paraview/surface.pvd"),
        ],
    };
    write_whole(&folder.join(HTML), |file| file.write_all(page.to_html().as_bytes()))
}

/// Numbers within numbers as rows: `operations.splits`.
fn flatten(path: &str, value: &Value, rows: &mut Vec<(String, String)>) {
    let words = |path: &str| path.replace('_', " ");
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                let path = if path.is_empty() { key.clone() } else { format!("{path}: {key}") };
                flatten(&path, value, rows);
            }
        }
        Value::Null => {}
        Value::String(text) => rows.push((words(path), text.clone())),
        other => rows.push((words(path), other.to_string())),
    }
}

/// The pictures of the first and the last frame that are there.
fn first_and_last(folder: &Path, lines: &[&Value]) -> Vec<(Vec<u8>, String)> {
    let frames: Vec<(u64, f64)> =
        lines.iter().filter_map(|line| Some((line["frame"].as_u64()?, line["time"].as_f64()?))).collect();
    let (Some(first), Some(last)) = (frames.first(), frames.last()) else { return Vec::new() };
    let chosen = if first == last { vec![first] } else { vec![first, last] };
    let picture = |&&(number, time): &&(u64, f64)| {
        let png = fs::read(folder.join(format!("preview/frame_{number:04}.png"))).ok()?;
        Some((png, format!("frame {number}, time {time}")))
    };
    chosen.iter().filter_map(picture).chain(composites(folder, lines)).collect()
}

/// The same of the pictures that a solver has made; not every frame may have them.
fn composites(folder: &Path, lines: &[&Value]) -> Vec<(Vec<u8>, String)> {
    let composite = |line: &&Value| {
        let (number, time) = (line["frame"].as_u64()?, line["time"].as_f64()?);
        let png = fs::read(folder.join(volume_path("composite", number)?)).ok()?;
        Some((png, format!("the volume of frame {number}, time {time}")))
    };
    let with_pictures = || lines.iter().filter(|line| line["pictures"].is_object());
    let first = with_pictures().find_map(composite);
    let last = with_pictures().rev().find_map(composite).filter(|last| Some(last) != first.as_ref());
    first.into_iter().chain(last).collect()
}
