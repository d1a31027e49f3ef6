//! Every fuzz target is three lines that call the body of the same name in the kit.

use crate::tree::{files, report};

#[test]
fn targets_only_call_the_kit() {
    let sources = files(&["rs"]);
    let targets: Vec<_> = sources.iter().filter(|file| file.path.starts_with("fuzz/targets/")).collect();
    assert!(!targets.is_empty(), "fuzz/targets/ is empty");
    let manifest = files(&["toml"]).into_iter().find(|file| file.path == "fuzz/Cargo.toml").unwrap();
    let mut faults = Vec::new();
    for target in targets {
        let name = target.path.trim_start_matches("fuzz/targets/").trim_end_matches(".rs");
        let expected = format!(
            "//! Runs `welter_kit::fuzz::{name}`.\n#![no_main]\n\
             libfuzzer_sys::fuzz_target!(|data: &[u8]| welter_kit::fuzz::{name}(data));\n"
        );
        if target.text != expected {
            faults.push(format!("{} is not\n{expected}", target.path));
        }
        if !manifest.text.contains(&format!("path = \"targets/{name}.rs\"")) {
            faults.push(format!("fuzz/Cargo.toml does not build {}", target.path));
        }
        if !welter_kit::fuzz::BODIES.iter().any(|(body, _)| *body == name) {
            faults.push(format!("the stable tests do not run the body {name}"));
        }
    }
    report("a fuzz target calls its body in the kit", &faults);
    assert_eq!(
        welter_kit::fuzz::BODIES.len(),
        sources.iter().filter(|file| file.path.starts_with("fuzz/targets/")).count(),
        "a body has no fuzz target"
    );
}
