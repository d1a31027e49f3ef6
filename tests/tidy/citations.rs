//! Every `[Key]` that a document or a comment cites stands in `docs/references.bib`.

use crate::tree::{files, report, root};
use std::collections::BTreeSet;

/// Citation keys of a text: a capitalised name and two digits of the year in brackets, `[Shewchuk97]`, also several and
/// with a place, `[Shewchuk97, Bareiss68, section 4]`, also with the brackets escaped for rustdoc.
fn cited(text: &str) -> Vec<&str> {
    let inner = text.split('[').skip(1).filter_map(|rest| rest.split_once(']').map(|(inner, _)| inner));
    let parts = inner.flat_map(|inner| inner.trim_end_matches('\\').split([',', ';']));
    parts.map(str::trim).filter(|part| is_key(part)).collect()
}

fn is_key(text: &str) -> bool {
    let name = text.trim_end_matches(|c: char| c.is_ascii_lowercase());
    let name = if name.ends_with(|c: char| c.is_ascii_digit()) && text.len() <= name.len() + 1 {
        name
    } else {
        text
    };
    let Some((letters, year)) = name.len().checked_sub(2).and_then(|at| name.split_at_checked(at)) else {
        return false;
    };
    year.chars().all(|c| c.is_ascii_digit())
        && letters.len() >= 2
        && letters.starts_with(|c: char| c.is_ascii_uppercase())
        && letters.chars().all(|c| c.is_ascii_alphabetic())
        && letters.contains(|c: char| c.is_ascii_lowercase())
}

/// Keys of the entries of the bibliography, in order.
fn entries(bibliography: &str) -> Vec<(&str, &str)> {
    let mut found = Vec::new();
    for part in bibliography.split("\n@").skip(1) {
        let (_, rest) = part.split_once('{').expect("an entry opens a brace");
        found.push(rest.split_once(',').expect("a key ends with a comma"));
    }
    found
}

/// The comments of a Rust source; all of any other text.
fn prose(path: &str, text: &str) -> String {
    if !path.ends_with(".rs") {
        return text.to_owned();
    }
    text.lines()
        .filter_map(|line| line.split_once("//").map(|(_, comment)| comment))
        .collect::<Vec<_>>()
        .join("\n")
}

#[test]
fn citations_resolve() {
    let bibliography = std::fs::read_to_string(root().join("docs/references.bib")).unwrap();
    let known: BTreeSet<&str> = entries(&bibliography).iter().map(|(key, _)| *key).collect();
    let mut faults = Vec::new();
    let mut count = 0;
    for file in files(&["rs", "md"]) {
        if file.path == "tests/tidy/citations.rs" {
            continue;
        }
        let prose = prose(&file.path, &file.text);
        for key in cited(&prose) {
            count += 1;
            if !known.contains(key) {
                faults.push(format!("{}: [{key}] is not in docs/references.bib", file.path));
            }
        }
    }
    report("a citation key has an entry", &faults);
    assert!(count > 0, "no citation was found anywhere: the search is broken");
}

#[test]
fn entries_are_whole_and_unique() {
    let bibliography = std::fs::read_to_string(root().join("docs/references.bib")).unwrap();
    let mut seen = BTreeSet::new();
    let mut faults = Vec::new();
    for (key, fields) in entries(&bibliography) {
        if !seen.insert(key) {
            faults.push(format!("{key} stands twice"));
        }
        if !is_key(key) {
            faults.push(format!("{key} is not of the form Name97"));
        }
        for field in ["author", "title", "year"] {
            if !fields.lines().any(|line| line.trim_start().starts_with(field) && line.contains('=')) {
                faults.push(format!("{key} has no {field}"));
            }
        }
    }
    report("a bibliography entry has author, title and year", &faults);
}

#[test]
fn keys_are_recognised() {
    assert_eq!(
        cited("as in [Shewchuk97], [Levy16b; Bareiss68, p. 3] and \\[Kettner08\\]"),
        ["Shewchuk97", "Levy16b", "Bareiss68", "Kettner08"]
    );
    assert!(cited("[f64; 97] [Sign] [a97] [U32] [12] [see](x) [N97").is_empty());
}
