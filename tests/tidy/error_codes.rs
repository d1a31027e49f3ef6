//! Error codes `W1234` of the command: each is given to one error.

use crate::code::without_tests;
use crate::tree::{files, report};
use std::collections::BTreeMap;

/// String literals `"W1234"` of a source, outside of its tests.
fn codes(text: &str) -> Vec<&str> {
    let parts = text.split('"').skip(1).step_by(2);
    parts
        .filter(|p| p.len() == 5 && p.starts_with('W') && p[1..].chars().all(|c| c.is_ascii_digit()))
        .collect()
}

#[test]
fn an_error_code_is_given_once() {
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for file in files(&["rs"]).iter().filter(|file| file.path.starts_with("cli/src/")) {
        // Line by line: the codes stand in literals, which `without_tests` blanks; its empty lines tell what is a test.
        for (line, code_line) in file.text.lines().zip(without_tests(&file.text).lines()) {
            if code_line.trim().is_empty() {
                continue;
            }
            for code in codes(line) {
                places.entry(code.to_owned()).or_default().push(file.path.clone());
            }
        }
    }
    let faults: Vec<String> = places
        .iter()
        .filter(|(_, at)| at.len() > 1)
        .map(|(code, at)| format!("{code} is given {} times: {}", at.len(), at.join(", ")))
        .collect();
    report("an error code belongs to one error", &faults);
}

#[test]
fn codes_are_recognised() {
    assert_eq!(codes("code(\"W3012\", \"W30\", \"W301x\") // W1111"), ["W3012"]);
}
