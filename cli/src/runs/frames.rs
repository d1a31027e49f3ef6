//! The frames of a run: surfaces as PLY, for ParaView with their numbers at vertices, pictures of them, and those that a solver makes.
//!
//! Promises: frame 0 is the initial state; each file is written whole or not at all; the list for ParaView has the true time of each frame.

use super::{Frame, Pictures, Plan};
use crate::codes::Code;
use crate::console::Seconds;
use crate::failure::Failure;
use crate::output::{Output, WriteProblem, cannot_write, write_whole};
use crate::picture::{self, write_png};
use crate::render::{Camera, Caption, Edges, Layer, Scene, Style};
use crate::run::Run;
use crate::surface_file::write_surface;
use std::fs;
use std::path::Path;
use welter_meshing::io::{
    DataArray, Format, TimedFile, VtkEncoding, WriteError, WriteOptions, write_pvd, write_vtp,
};

/// The folders of frames, and the names of their files around the number.
const FILES: [(&str, &str, &str); 3] =
    [("surface", "frame_", ".ply"), ("paraview", "surface_", ".vtp"), ("preview", "frame_", ".png")];

/// The folder of pictures that a solver makes by itself.
const VOLUME: &str = "volume";

/// What such pictures show, and what their files end with: `volume/composite_0000.png`.
const VOLUME_PICTURES: [(&str, &str); 6] = [
    ("alpha", ".png"),
    ("scatter", ".png"),
    ("age", ".png"),
    ("backdrop", ".png"),
    ("composite", ".png"),
    ("planes", ".exr"),
];

/// The list for ParaView.
const LIST: &str = "paraview/surface.pvd";

fn path(which: usize, number: u64) -> String {
    let (folder, before, after) = FILES[which];
    format!("{folder}/{before}{number:04}{after}")
}

/// Makes the folders.
pub(super) fn prepare(folder: &Path, plan: &Plan) -> Result<(), Box<Failure>> {
    for (name, _, _) in &FILES[..if plan.output.pictures.is_some() { 3 } else { 2 }] {
        let path = folder.join(name);
        fs::create_dir_all(&path).map_err(|error| cannot_write(&path, &error))?;
    }
    if plan.output.volume {
        let path = folder.join(VOLUME);
        fs::create_dir_all(&path).map_err(|error| cannot_write(&path, &error))?;
    }
    Ok(())
}

/// The name of a picture that a solver makes, in the folder of the run.
pub(super) fn volume_path(what: &str, number: u64) -> Option<String> {
    let (what, after) = VOLUME_PICTURES.iter().find(|(known, _)| *known == what)?;
    Some(format!("{VOLUME}/{what}_{number:04}{after}"))
}

/// Removes the frames from a number on: those of an earlier run, or of steps that will be done again.
pub(super) fn remove_from(folder: &Path, number: u64) {
    let remove = |name: &str, before: &str, after: &str| {
        for entry in fs::read_dir(folder.join(name)).into_iter().flatten().flatten() {
            let file = entry.file_name();
            let digits = file.to_str().and_then(|f| f.strip_prefix(before)?.strip_suffix(after));
            if digits.and_then(|digits| digits.parse::<u64>().ok()).is_some_and(|k| k >= number) {
                let _ = fs::remove_file(entry.path());
            }
        }
    };
    FILES.iter().for_each(|(name, before, after)| remove(name, before, after));
    VOLUME_PICTURES.iter().for_each(|(what, after)| remove(VOLUME, &format!("{what}_"), after));
    if number == 0 {
        let _ = fs::remove_file(folder.join(LIST));
    }
}

/// Writes the files of a frame.
pub(super) fn write(
    folder: &Path,
    frame: &Frame,
    number: u64,
    plan: &Plan,
    run: &Run,
    seconds: &mut Seconds,
) -> Result<(), Box<Failure>> {
    let ply = folder.join(path(0, number));
    let vtp = folder.join(path(1, number));
    let _ =
        write_surface(Output::prepare(&ply, true, &[])?, Format::Ply, &frame.mesh, &WriteOptions::default())?;
    let arrays: Vec<DataArray<'_>> =
        frame.arrays.iter().map(|(name, values)| DataArray::scalars(name, values)).collect();
    write_whole(&vtp, |file| {
        write_vtp(file, &frame.mesh, &arrays, &[], VtkEncoding::Appended).map_err(problem)
    })?;
    if let Some(size) = plan.output.pictures {
        draw(&folder.join(path(2, number)), frame, size, plan.output.camera, run, seconds)?;
    }
    Ok(())
}

/// Writes the pictures that a solver has made of a frame; gives their names.
pub(super) fn write_pictures(
    folder: &Path,
    pictures: &Pictures,
    number: u64,
) -> Result<Vec<String>, Box<Failure>> {
    let write = |(what, bytes): &(&'static str, Vec<u8>)| {
        let name = volume_path(what, number).ok_or_else(|| {
            Failure::new(Code::OwnBug, format!("a picture of {what} has no place in a run"))
        })?;
        write_whole(&folder.join(&name), |file| file.write_all(bytes))?;
        Ok(name)
    };
    pictures.files.iter().map(write).collect()
}

/// Writes the list of all frames up to now.
pub(super) fn write_list(folder: &Path, times: &[f64]) -> Result<(), Box<Failure>> {
    let files: Vec<String> = (0..times.len() as u64)
        .map(|number| path(1, number).split_once('/').map(|(_, file)| file.to_owned()).unwrap_or_default())
        .collect();
    let list: Vec<TimedFile<'_>> =
        times.iter().zip(&files).map(|(&time, file)| TimedFile { time, file }).collect();
    write_whole(&folder.join(LIST), |file| write_pvd(file, &list).map_err(problem))
}

fn problem(error: WriteError) -> WriteProblem {
    match error {
        WriteError::Io(error) => WriteProblem::Io(error),
        other => WriteProblem::Failure(Failure::new(Code::OwnBug, other.to_string())),
    }
}

/// The picture of a frame.
fn draw(
    name: &Path,
    frame: &Frame,
    size: [u32; 2],
    camera: Option<Camera>,
    run: &Run,
    seconds: &mut Seconds,
) -> Result<(), Box<Failure>> {
    let style = Style { edges: Some(Edges::default()), ..Style::default() };
    // A surface that has vanished has nothing to frame.
    let layers = if frame.mesh.triangles().is_empty() {
        Vec::new()
    } else {
        vec![Layer { style, ..Layer::of(&frame.mesh) }]
    };
    let lines = frame.caption.iter().map(|line| (None, line.clone())).collect();
    let scene = Scene {
        layers,
        size,
        camera: camera.unwrap_or_default(),
        floor: false,
        caption: Caption { title: frame.title.clone(), lines, ..Caption::default() },
        ..Scene::default()
    };
    let image = picture::draw(&scene, run, seconds)?;
    write_png(&image, Output::prepare(name, true, &[])?)
}
