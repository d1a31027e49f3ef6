//! Outputs: checked before the work, never half-written, never overwritten unasked.

use crate::harness::{Bench, TETRAHEDRON, permissions_bind};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Stdio;

fn bench() -> Bench {
    let bench = Bench::new();
    bench.file("t.obj", TETRAHEDRON);
    bench
}

#[test]
fn an_existing_output_needs_force() {
    let bench = bench();
    bench.file("out.ply", "mine");
    let error = bench.fails("convert t.obj -o out.ply", "W7003", 7);
    assert!(error["help"].as_str().unwrap().contains("--force"));
    assert_eq!(bench.read("out.ply"), b"mine");
    bench.run("convert t.obj -o out.ply --force").ok();
    assert!(bench.read("out.ply").starts_with(b"ply"));
}

#[test]
fn the_input_is_never_the_output() {
    let bench = bench();
    bench.fails("convert t.obj -o ./t.obj --force", "W2005", 2);
    std::os::unix::fs::symlink(bench.path("t.obj"), bench.path("link.obj")).unwrap();
    bench.fails("convert t.obj -o link.obj --force", "W2005", 2);
    assert_eq!(bench.read("t.obj"), TETRAHEDRON.as_bytes());
}

#[test]
fn a_missing_folder_is_told_with_the_command_that_makes_it() {
    let bench = bench();
    let error = bench.fails("convert t.obj -o no/such/out.ply", "W7001", 7);
    assert_eq!(error["help"], "mkdir -p no/such");
}

#[test]
fn a_directory_is_no_output() {
    let bench = bench();
    std::fs::create_dir(bench.path("dir.ply")).unwrap();
    bench.fails("convert t.obj -o dir.ply --force", "W7005", 7);
}

#[test]
fn a_folder_without_write_permission_is_found_before_the_work() {
    let bench = bench();
    if !permissions_bind(&bench) {
        println!("skipped: permissions do not bind this user");
        return;
    }
    std::fs::create_dir(bench.path("locked")).unwrap();
    std::fs::set_permissions(bench.path("locked"), std::fs::Permissions::from_mode(0o555)).unwrap();
    bench.fails("convert t.obj -o locked/out.ply", "W7002", 7);
}

#[test]
fn a_write_protected_file_stays_even_with_force() {
    let bench = bench();
    bench.file("out.ply", "mine");
    std::fs::set_permissions(bench.path("out.ply"), std::fs::Permissions::from_mode(0o444)).unwrap();
    bench.fails("convert t.obj -o out.ply --force", "W7002", 7);
    assert_eq!(bench.read("out.ply"), b"mine");
}

#[test]
fn a_full_disk_is_exit_7() {
    if !Path::new("/dev/full").exists() {
        println!("skipped: no /dev/full");
        return;
    }
    let error = bench().fails("convert t.obj -o /dev/full --to ply", "W7004", 7);
    assert!(error["what"].as_str().unwrap().contains("no space left"), "{error:#}");
}

#[test]
fn a_full_standard_output_is_exit_7() {
    let Ok(full) = std::fs::File::options().write(true).open("/dev/full") else {
        println!("skipped: no /dev/full");
        return;
    };
    let status =
        bench().command(&["info", "t.obj"]).stdout(Stdio::from(full)).stderr(Stdio::null()).status().unwrap();
    assert_eq!(status.code(), Some(7));
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let bench = bench();
    for args in [["info", "t.obj"].as_slice(), &["shape", "sphere", "-o", "-", "--to", "obj"]] {
        let mut child = bench.command(args).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{args:?}: {err}");
        assert!(!err.contains("error") && !err.contains("panicked"), "{args:?}: {err}");
    }
}

#[test]
fn a_failed_conversion_leaves_nothing_behind() {
    let bench = bench();
    bench.file("bad.obj", "v 0 0 0\nv 1 0 zero\n");
    bench.fails("convert bad.obj -o out.ply", "W4006", 4);
    assert_eq!(bench.names(), ["bad.obj", "t.obj"]);
}

#[test]
fn a_name_as_long_as_names_can_be_is_written() {
    let bench = bench();
    let name = format!("{}.ply", "x".repeat(251));
    bench.run(&format!("convert t.obj -o {name}")).ok();
    assert!(bench.exists(&name));
}

#[test]
fn a_link_stays_and_its_target_is_replaced() {
    let bench = bench();
    bench.file("real.ply", "old");
    std::os::unix::fs::symlink(bench.path("real.ply"), bench.path("link.ply")).unwrap();
    bench.run("convert t.obj -o link.ply --force").ok();
    assert!(bench.path("link.ply").is_symlink());
    assert!(bench.read("real.ply").starts_with(b"ply"));
}

#[test]
fn the_same_input_gives_the_same_bytes_for_any_number_of_threads() {
    let bench = bench();
    bench.run("shape ring-overlap -o one.ply -j 1").ok();
    bench.run("shape ring-overlap -o many.ply -j 4").ok();
    assert!(bench.read("one.ply") == bench.read("many.ply"));
}
