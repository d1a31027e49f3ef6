//! `welter new`: writes a scene to begin with.

use crate::codes::Code;
use crate::failure::{Failure, shell_word, shown};
use crate::output::{Output, WriteProblem, cannot_write};
use crate::run::{Outcome, Run};
use crate::scene::nearest;
use serde_json::json;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// Write a scene to begin with (`--list` names them)
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  welter new plume && welter sim plume.toml -o plume
  welter new offset scenes     # scenes/offset.toml, and the mesh that it reads

What is written is commented; `welter sim plume.toml --dry-run` tells every other key.")]
pub(crate) struct Args {
    /// Which scene
    #[arg(required_unless_present = "list")]
    kind: Option<String>,
    /// Folder for it; made if its parent exists
    #[arg(default_value = ".")]
    dir: PathBuf,
    /// List the scenes
    #[arg(long)]
    list: bool,
}

/// A scene that comes with the program.
struct Kind {
    name: &'static str,
    /// The command that it is for, and what that makes of it.
    command: &'static str,
    output: &'static str,
    text: &'static str,
    /// Files that it names, beside it.
    beside: &'static [(&'static str, &'static str)],
}

impl Kind {
    const fn of(name: &'static str, [command, output]: [&'static str; 2], text: &'static str) -> Self {
        Self { name, command, output, text, beside: &[] }
    }

    /// Its first sentence, without references.
    fn description(&self) -> String {
        let comments = self.text.lines().map_while(|line| line.strip_prefix('#'));
        let text = comments.map(str::trim).take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
        let sentence = text.split_once(". ").map_or(text.as_str(), |(first, _)| first);
        let mut told = sentence.trim_end_matches('.').to_owned();
        while let Some((from, length)) =
            told.find(" [").and_then(|from| Some((from, told[from..].find(']')?)))
        {
            told.replace_range(from..=from + length, "");
        }
        told
    }

    fn files(&self) -> impl Iterator<Item = (String, &'static str)> {
        let beside = self.beside.iter().map(|(name, text)| ((*name).to_owned(), *text));
        std::iter::once((format!("{}.toml", self.name), self.text)).chain(beside)
    }
}

const SIM: [&str; 2] = ["sim", ""];
const TRACK: [&str; 2] = ["track", ""];
const ISOSURFACE: [&str; 2] = ["isosurface", ".ply"];

/// The scenes under `examples`, in the order in which they are listed.
const KINDS: [Kind; 16] = [
    Kind::of("plume", SIM, include_str!("../../examples/sim/plume.toml")),
    Kind::of("fog", SIM, include_str!("../../examples/sim/fog.toml")),
    Kind::of("dye-drop", SIM, include_str!("../../examples/sim/dye-drop.toml")),
    Kind::of("ring-through-ring", SIM, include_str!("../../examples/sim/ring-through-ring.toml")),
    Kind::of("enright", TRACK, include_str!("../../examples/track/enright.toml")),
    Kind::of("enright-translated", TRACK, include_str!("../../examples/track/enright-translated.toml")),
    Kind::of("normal-motion", TRACK, include_str!("../../examples/track/normal-motion.toml")),
    Kind::of("mean-curvature", TRACK, include_str!("../../examples/track/mean-curvature.toml")),
    Kind::of("curl-noise-sphere", TRACK, include_str!("../../examples/track/curl-noise-sphere.toml")),
    Kind::of("curl-noise-planar", TRACK, include_str!("../../examples/track/curl-noise-planar.toml")),
    Kind::of("open-surface", TRACK, include_str!("../../examples/track/open-surface.toml")),
    Kind::of("jitter", TRACK, include_str!("../../examples/track/jitter.toml")),
    Kind::of("gyroid", ISOSURFACE, include_str!("../../examples/isosurface/gyroid.toml")),
    Kind::of("blobs", ISOSURFACE, include_str!("../../examples/isosurface/blobs.toml")),
    Kind::of("text", ISOSURFACE, include_str!("../../examples/isosurface/text.toml")),
    Kind {
        beside: &[("ring-overlap.off", include_str!("../../examples/isosurface/ring-overlap.off"))],
        ..Kind::of("offset", ISOSURFACE, include_str!("../../examples/isosurface/offset.toml"))
    },
];

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let (false, Some(name)) = (args.list, &args.kind) else { return list(run) };
    let kind = KINDS.iter().find(|kind| kind.name == name).ok_or_else(|| unknown(name))?;
    let made = folder(&args.dir)?;
    // Those that exist are told before the first is written.
    let prepared = kind
        .files()
        .map(|(name, text)| Ok((Output::prepare(&in_folder(&args.dir, &name), run.force, &[])?, text)))
        .collect::<Result<Vec<_>, Box<Failure>>>();
    if prepared.is_err() && made {
        // Empty: nothing has been written.
        let _ = fs::remove_dir(&args.dir);
    }
    let mut paths = Vec::new();
    for (file, text) in prepared? {
        paths.push(file.name().to_owned());
        file.write(|to| to.write_all(text.as_bytes()).map_err(WriteProblem::from))?;
    }
    let scene = &paths[0];
    let output = args.dir.join(format!("{}{}", kind.name, kind.output));
    let next = format!("welter {} {} -o {}", kind.command, shell_word(scene), shell_word(in_here(&output)));
    run.console.result(&format!("{}: {}\n  next: {next}\n", shown(scene), kind.description()))?;
    run.console.object(&json!({
        "kind": kind.name,
        "files": paths.iter().map(|path| shown(path)).collect::<Vec<_>>(),
        "next": next,
    }))?;
    Ok(0)
}

/// A name in the folder of a run, without `./`.
fn in_folder(dir: &Path, name: &str) -> PathBuf {
    in_here(&dir.join(name)).to_owned()
}

fn in_here(path: &Path) -> &Path {
    path.strip_prefix(".").unwrap_or(path)
}

/// Makes the folder, if it is not there; whether it was made.
fn folder(dir: &Path) -> Result<bool, Box<Failure>> {
    if dir.is_dir() {
        return Ok(false);
    }
    let fail = |code, what: &str| Failure::new(code, what).subject(shown(dir));
    if dir.exists() {
        return Err(fail(Code::NotWritable, "this is no folder").help("name a folder"));
    }
    let parent = dir.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !parent.is_dir() {
        return Err(fail(Code::FolderMissing, "the folder above it does not exist")
            .help(format!("mkdir -p {}", shell_word(parent))));
    }
    fs::create_dir(dir).map_err(|error| cannot_write(dir, &error))?;
    Ok(true)
}

fn unknown(name: &str) -> Box<Failure> {
    let names: Vec<&str> = KINDS.iter().map(|kind| kind.name).collect();
    let help = match nearest(name, &names) {
        Some(nearest) => format!("welter new {nearest}"),
        None => "welter new --list".to_owned(),
    };
    Failure::new(Code::UnknownScene, format!("no scene is called `{name}`")).help(help)
}

fn list(run: &Run) -> Outcome {
    let (mut text, mut list) = (String::from("scene               for                what\n"), Vec::new());
    for kind in &KINDS {
        let description = kind.description();
        let _ = writeln!(text, "{:<18}  welter {:<10}  {description}", kind.name, kind.command);
        list.push(json!({ "name": kind.name, "command": kind.command, "description": description }));
    }
    run.console.result(&text)?;
    run.console.object(&json!({ "scenes": list }))?;
    Ok(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn descriptions_are_sentences_without_references() {
        for kind in &KINDS {
            let told = kind.description();
            assert!(!told.is_empty() && !told.contains(['[', '\n']) && !told.ends_with('.'), "{told}");
        }
    }
}
