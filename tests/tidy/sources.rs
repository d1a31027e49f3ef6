//! What a source file holds: size, head comment, and constructs that have no place in it.

use crate::code::{strip, without_tests};
use crate::tree::{File, files, report};

/// No file is longer.
const MOST_LINES: usize = 800;
/// Nine of ten files are not longer.
const MOST_LINES_OF_MOST: usize = 500;

fn is_library(file: &File) -> bool {
    ["predicates/src/", "meshing/src/", "tracking/src/", "fluids/src/"]
        .iter()
        .any(|p| file.path.starts_with(p))
}

fn is_product(file: &File) -> bool {
    is_library(file) || file.path.starts_with("cli/src/")
}

/// The lines, counted from 1, that hold `needle` in text prepared by `prepare`.
fn places(file: &File, prepare: fn(&str) -> String, needle: &str) -> Vec<String> {
    let text = prepare(&file.text);
    let hits = text.lines().enumerate().filter(|(_, line)| line.contains(needle));
    hits.map(|(i, _)| format!("{}:{}: {needle}", file.path, i + 1)).collect()
}

#[test]
fn files_are_of_readable_size() {
    let sources = files(&["rs", "md", "sh", "py"]);
    let mut lengths: Vec<(usize, &str)> =
        sources.iter().map(|file| (file.text.lines().count(), file.path.as_str())).collect();
    lengths.sort_unstable();
    let faults: Vec<String> = lengths
        .iter()
        .filter(|(lines, _)| *lines > MOST_LINES)
        .map(|(lines, path)| format!("{path}: {lines} lines"))
        .collect();
    report("a file has at most 800 lines", &faults);
    let (lines, path) = lengths[lengths.len() * 9 / 10];
    assert!(lines <= MOST_LINES_OF_MOST, "the 90th percentile of file lengths is {lines} lines ({path})");
}

#[test]
fn every_source_says_what_it_is() {
    let faults: Vec<String> = files(&["rs"])
        .iter()
        .filter(|file| file.path != "fuzz/build.rs" && !file.text.starts_with("//! "))
        .map(|file| format!("{} does not start with a //! line", file.path))
        .collect();
    report("a source file starts with what it is about", &faults);
}

#[test]
fn every_library_states_its_promises() {
    for name in ["predicates", "meshing", "tracking", "fluids"] {
        let path = format!("{name}/src/lib.rs");
        let sources = files(&["rs"]);
        let file =
            sources.iter().find(|file| file.path == path).unwrap_or_else(|| panic!("{path} is missing"));
        let head: Vec<&str> = file.text.lines().take_while(|line| line.starts_with("//!")).collect();
        assert!(head.join(" ").contains("promise"), "{path}: the head does not say what the crate promises");
        assert!(
            file.text.contains("#![forbid(unsafe_code)]")
                || sources.iter().any(|f| f.path.contains("/simd/")),
            "{path}: unsafe code is not forbidden"
        );
    }
    assert!(
        files(&["rs"]).iter().any(|f| f.path == "predicates/src/lib.rs" && f.text.contains("#![no_std]"))
    );
}

#[test]
fn unsafe_code_stays_in_simd_folders() {
    let outside = |file: &&File| !file.path.contains("/simd/");
    let faults: Vec<String> =
        files(&["rs"]).iter().filter(outside).flat_map(|file| places(file, strip, "unsafe ")).collect();
    report("unsafe code is only in simd/ folders", &faults);
}

#[test]
fn no_test_is_switched_off_and_nothing_is_left_to_do() {
    let needles = ["#[ignore", "todo!(", "unimplemented!(", "dbg!("];
    let faults: Vec<String> = files(&["rs"])
        .iter()
        .flat_map(|file| needles.iter().flat_map(|needle| places(file, strip, needle)).collect::<Vec<_>>())
        .collect();
    report("no ignored test, no gap, no leftover", &faults);
}

#[test]
fn products_do_not_unwrap() {
    let faults: Vec<String> = files(&["rs"])
        .iter()
        .filter(|file| is_product(file))
        .flat_map(|file| places(file, without_tests, ".unwrap()"))
        .collect();
    report("no unwrap() outside tests", &faults);
}

#[test]
fn libraries_do_not_print() {
    let needles = ["println!(", "eprintln!(", "print!("];
    let faults: Vec<String> = files(&["rs"])
        .iter()
        .filter(|file| is_library(file))
        .flat_map(|file| {
            needles.iter().flat_map(|needle| places(file, without_tests, needle)).collect::<Vec<_>>()
        })
        .collect();
    report("libraries give data, the command prints", &faults);
}

#[test]
fn every_source_is_compiled() {
    // A file that no `mod` line names is never built, so its tests never run.
    let sources = files(&["rs"]);
    let roots = ["lib.rs", "main.rs", "build.rs"];
    let mut faults = Vec::new();
    for file in &sources {
        let (folder, name) = file.path.rsplit_once('/').unwrap();
        let top = ["benches", "fuzz/targets"].contains(&folder);
        if top || roots.contains(&name) {
            continue;
        }
        let (module, parent) = if name == "mod.rs" {
            let (parent, module) = folder.rsplit_once('/').unwrap();
            (module, parent)
        } else {
            (name.trim_end_matches(".rs"), folder)
        };
        let declared = sources.iter().any(|other| {
            let is_parent =
                ["lib.rs", "main.rs", "mod.rs"].iter().any(|root| other.path == format!("{parent}/{root}"))
                    || other.path == format!("{parent}.rs");
            is_parent
                && strip(&other.text).lines().any(|line| line.trim().ends_with(&format!("mod {module};")))
        });
        if !declared {
            faults.push(format!("{}: no mod line names it", file.path));
        }
    }
    report("every source file is a module of something", &faults);
}
