//! The command line itself: help, version, mistakes.

use crate::harness::Bench;

/// Every command, in the order of the help.
const COMMANDS: &[&str] = &[
    "demo",
    "shape",
    "isosurface",
    "mesh",
    "track",
    "sim",
    "new",
    "check",
    "ccd",
    "convert",
    "info",
    "render",
    "view",
    "replay",
    "report",
    "doctor",
    "completions",
];

#[test]
fn version_is_that_of_the_package() {
    let ran = Bench::new().run("-V").ok();
    assert_eq!(ran.out, concat!("welter ", env!("CARGO_PKG_VERSION"), "\n"));
}

#[test]
fn help_names_every_command_and_no_other() {
    let help = Bench::new().run("--help").ok().out;
    let commands: Vec<&str> = help
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .take_while(|line| !line.is_empty())
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert_eq!(commands, [COMMANDS, &["help"]].concat());
}

#[test]
fn every_command_has_help() {
    for command in COMMANDS {
        let ran = Bench::new().run(&format!("{command} --help")).ok();
        assert!(ran.out.contains(&format!("Usage: welter {command}")), "{}", ran.out);
        assert!(ran.out.contains("--json"), "{}", ran.out);
    }
}

#[test]
fn a_mistyped_command_is_told_the_nearest() {
    let error = Bench::new().fails("shap", "W2001", 2);
    assert_eq!(error["help"], "welter shape --help");
}

#[test]
fn commands_that_do_not_exist_yet_are_unknown() {
    for command in ["view", "report", "new", "schema"] {
        Bench::new().fails(command, "W2001", 2);
    }
}

#[test]
fn no_command_unknown_option_missing_argument_and_bad_value_are_usage_errors() {
    let bench = Bench::new();
    for line in ["--quiet", "doctor --bogus", "convert", "doctor -j 0", "doctor -j x", "doctor -q -v"] {
        bench.fails(line, "W2001", 2);
    }
}

#[test]
fn completions_name_the_commands() {
    for shell in ["bash", "zsh", "fish"] {
        let ran = Bench::new().run(&format!("completions {shell}")).ok();
        assert!(ran.out.contains("convert") && ran.err.is_empty(), "{shell}");
    }
}
