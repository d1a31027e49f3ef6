//! Bad input of every kind: its exit code, a message with a place and a command that mends it, no panic, no huge
//! allocation.

use crate::harness::{Bench, TETRAHEDRON, permissions_bind};
use std::os::unix::fs::PermissionsExt;

/// Runs `check` on a file; gives the error of that file.
fn check(name: &str, content: impl AsRef<[u8]>, code: &str, exit: i32) -> serde_json::Value {
    let bench = Bench::new();
    bench.file(name, content);
    let error = bench.fails(&format!("check {name}"), code, exit);
    assert_eq!(error["file"], name, "the file is named: {error:#}");
    let (object, _) = bench.json(&format!("check {name}"));
    assert_eq!(object["files"][0]["error"], error, "each file carries its error");
    error
}

fn place(error: &serde_json::Value) -> &str {
    error["where"][0].as_str().unwrap_or_default()
}

#[test]
fn a_missing_file_is_told_with_the_nearest_name() {
    let bench = Bench::new();
    bench.file("dragon.obj", TETRAHEDRON);
    let error = bench.fails("check dragno.obj", "W4001", 4);
    assert_eq!(error["help"], "did you mean ./dragon.obj?");
    let error = bench.fails("check nowhere/at/all.obj", "W4001", 4);
    assert_eq!(error["help"], "ls nowhere/at");
}

#[test]
fn an_unknown_extension_is_told_unless_the_format_is_named() {
    check("part.step", "x", "W4002", 4);
    check("part", "x", "W4002", 4);
    let bench = Bench::new();
    bench.file("part.dat", TETRAHEDRON);
    bench.run("check part.dat --from obj").ok();
}

#[test]
fn a_directory_is_no_surface() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("parts.obj")).unwrap();
    bench.file("parts.obj/a.obj", TETRAHEDRON);
    let error = bench.fails("check parts.obj", "W4003", 4);
    assert!(error["help"].as_str().unwrap().contains("parts.obj/a.obj"), "{error:#}");
}

#[test]
fn an_unreadable_file_is_told() {
    let bench = Bench::new();
    if !permissions_bind(&bench) {
        println!("skipped: permissions do not bind this user");
        return;
    }
    bench.file("a.obj", TETRAHEDRON);
    std::fs::set_permissions(bench.path("a.obj"), std::fs::Permissions::from_mode(0o000)).unwrap();
    let error = bench.fails("check a.obj", "W4004", 4);
    assert_eq!(error["help"], "chmod u+r a.obj");
}

#[test]
fn empty_files_are_told_in_every_format() {
    for name in ["a.obj", "a.ply", "a.stl", "a.off"] {
        check(name, "", "W4005", 4);
    }
    check("blank.obj", " \n\t\n", "W4005", 4);
}

#[test]
fn truncated_binary_files_are_told_with_the_byte() {
    let bench = Bench::new();
    for name in ["a.ply", "a.stl"] {
        bench.run(&format!("shape box -o {name}")).ok();
        let whole = bench.read(name);
        bench.file(name, &whole[..whole.len() - 7]);
        let error = bench.fails(&format!("check {name}"), "W4007", 4);
        assert!(place(&error).contains("byte"), "{error:#}");
    }
}

#[test]
fn malformed_text_is_told_with_the_line() {
    assert_eq!(place(&check("a.obj", "v 0 0 0\nv 1 zero 0\n", "W4006", 4)), "a.obj:2");
    assert_eq!(place(&check("a.off", "OFF\n1 0 0\n0 zero 0\n", "W4006", 4)), "a.off:3");
}

#[test]
fn nan_and_infinity_are_counted_and_named() {
    let text = TETRAHEDRON.replace("v 1 0 0", "v nan 0 0").replace("v 0 1 0", "v 0 -inf 0");
    let error = check("a.obj", &text, "W3012", 3);
    assert_eq!(error["what"], "2 vertices have a non-finite coordinate");
    assert_eq!(place(&error), "vertex 1 at (NaN, 0, 0)");
    assert_eq!(error["help"], "welter convert a.obj -o a-mended.ply --drop-defects");
    let bench = Bench::new();
    bench.file("a.obj", &text);
    let (object, _) = bench.json("check a.obj");
    assert_eq!(object["files"][0]["non_finite_vertices"], 2);
    assert!(object["files"][0]["closed"].is_null(), "no answer, not a wrong one");
}

#[test]
fn the_command_that_help_names_mends_it() {
    let bench = Bench::new();
    bench.file("a.obj", format!("{TETRAHEDRON}v nan 0 0\nf 1 2 5\nf 1 1 2\n"));
    let error = bench.fails("check a.obj", "W3012", 3);
    let help = error["help"].as_str().unwrap();
    bench.run(help.strip_prefix("welter ").unwrap()).ok();
    let (object, ran) = bench.json("check a-mended.ply");
    assert_eq!((ran.exit, &object["files"][0]["closed"]), (Some(0), &true.into()));
}

#[test]
fn an_index_out_of_range_is_told_with_its_line() {
    let error = check("a.obj", format!("{TETRAHEDRON}f 1 2 9\n"), "W3010", 3);
    assert_eq!(place(&error), "a.obj:9");
    check("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "W3010", 3);
}

#[test]
fn a_repeated_index_is_counted_and_named() {
    let error = check("a.obj", format!("{TETRAHEDRON}f 2 2 3\n"), "W3011", 3);
    assert_eq!(place(&error), "triangle 4 of vertices 1, 1, 2");
    let bench = Bench::new();
    bench.file("a.obj", format!("{TETRAHEDRON}f 2 2 3\n"));
    assert_eq!(bench.json("check a.obj").0["files"][0]["repeated_indices"], 1);
}

#[test]
fn several_kinds_of_defect_are_all_told() {
    let bench = Bench::new();
    bench.file("a.obj", format!("{TETRAHEDRON}v inf 0 0\nf 2 2 3\n"));
    let ran = bench.run("check a.obj");
    assert!(ran.err.contains("error[W3012]") && ran.err.contains("error[W3011]"), "{}", ran.err);
}

#[test]
fn a_billion_declared_vertices_in_a_small_file_take_no_memory() {
    let ply = "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\nproperty double x\n\
               property double y\nproperty double z\nelement face 1000000000\n\
               property list uchar int vertex_indices\nend_header\n";
    let padded = |head: &str| [head.as_bytes(), &vec![0; 1000 - head.len()]].concat();
    let mut stl = vec![0; 84];
    stl[80..84].copy_from_slice(&1_000_000_000_u32.to_le_bytes());
    stl.resize(1000, 0);
    let off = format!("OFF\n1000000000 1000000000 0\n{}", "0 0 0\n".repeat(150));
    for (name, content) in [("a.ply", padded(ply)), ("a.stl", stl), ("a.off", off.into_bytes())] {
        let bench = Bench::new();
        bench.file(name, content);
        let error = bench.fails(&format!("check {name}"), "W4007", 4);
        assert_eq!(error["file"], name);
        // 200 MB of address space hold the program and its threads, not a billion vertices.
        let limited = std::process::Command::new("sh")
            .args([
                "-c",
                "ulimit -v 400000; exec \"$0\" check \"$1\" -j 1",
                env!("CARGO_BIN_EXE_welter"),
                name,
            ])
            .current_dir(bench.path("."))
            .output()
            .unwrap();
        assert_eq!(limited.status.code(), Some(4), "{}", String::from_utf8_lossy(&limited.stderr));
    }
}

#[test]
fn utf_16_text_is_told_with_the_command_that_converts_it() {
    let utf16: Vec<u8> =
        std::iter::once(0xfeff).chain(TETRAHEDRON.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    let error = check("a.obj", utf16, "W4008", 4);
    assert_eq!(error["help"], "iconv -f UTF-16 -t UTF-8 a.obj > a-utf8.obj");
}

#[test]
fn compressed_data_is_told_with_the_command_that_unpacks_it() {
    let error = check("a.obj", [0x1f, 0x8b, 8, 0, 0, 0, 0, 0], "W4010", 4);
    assert!(error["help"].as_str().unwrap().starts_with("gunzip -c a.obj |"), "{error:#}");
}

#[test]
fn huge_coordinates_are_checked_like_any_other() {
    let bench = Bench::new();
    // Only coordinates are scaled, not indices.
    let scaled =
        |line: &str| if line.starts_with('v') { line.replace('1', "1e308") } else { line.to_owned() };
    let text: String = TETRAHEDRON.lines().map(|line| scaled(line) + "\n").collect();
    bench.file("a.obj", text);
    let (object, ran) = bench.json("check a.obj");
    let file = &object["files"][0];
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    assert_eq!(
        (&file["closed"], &file["oriented"], &file["self_intersecting_pairs"], &file["degenerate_triangles"]),
        (&true.into(), &true.into(), &0.into(), &0.into())
    );
    assert!(file["volume"].is_null(), "1e924 / 6 is no f64");
}

#[test]
fn a_file_larger_than_the_memory_allowed_is_refused_before_it_is_read() {
    let bench = Bench::new();
    bench.file("a.obj", TETRAHEDRON);
    let error = bench.fails("check a.obj --max-memory 100", "W6001", 6);
    assert!(error["help"].as_str().unwrap().starts_with("--max-memory "), "{error:#}");
}

#[test]
fn a_name_that_is_no_unicode_is_read_like_any_other() {
    use std::os::unix::ffi::OsStrExt;
    let bench = Bench::new();
    let name = std::ffi::OsStr::from_bytes(b"caf\xe9.obj");
    if std::fs::write(bench.path(".").join(name), TETRAHEDRON).is_err() {
        println!("skipped: this file system has Unicode names only");
        return;
    }
    for command in ["check", "info"] {
        let output = bench.command(&[command, "--json"]).arg(name).output().unwrap();
        let object: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(
            (output.status.code(), &object["files"][0]["triangles"]),
            (Some(0), &4.into()),
            "{command}"
        );
    }
}

#[test]
fn one_bad_file_does_not_keep_the_others_from_being_checked() {
    let bench = Bench::new();
    bench.file("a.obj", TETRAHEDRON).file("c.obj", TETRAHEDRON);
    let (object, ran) = bench.json("check a.obj missing.obj c.obj");
    assert_eq!(ran.exit, Some(4));
    let files = object["files"].as_array().unwrap();
    assert_eq!(files.len(), 3);
    assert_eq!(files[1]["error"]["code"], "W4001");
    assert_eq!(files[2]["closed"], true);
    assert_eq!(object["error"]["code"], "W4001");
}
