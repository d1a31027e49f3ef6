//! `welter ccd`: answers, figures, kinds, and every way in which a file of queries can be wrong.

use crate::harness::{Bench, Ran, permissions_bind, public_queries};
use serde_json::{Value, json};
use std::io::Write;
use std::os::unix::fs::PermissionsExt;
use std::process::Stdio;

/// A vertex on the axis of a resting face, at these heights at the two ends of the step; `tail` ends every row.
/// As two edges these are apart, because the face's last edge stays away from the axis.
fn query(z0: &str, z1: &str, tail: &str) -> String {
    let at = |z: &str| {
        format!("0,1,0,1,{z},1{tail}\n-4,1,-4,1,0,1{tail}\n4,1,-4,1,0,1{tail}\n0,1,4,1,0,1{tail}\n")
    };
    at(z0) + &at(z1)
}

/// The vertex passes through.
fn hit(tail: &str) -> String {
    query("1", "-1", tail)
}

/// It stops half a unit short.
fn miss(tail: &str) -> String {
    query("2", "1", tail)
}

/// Two queries with right answers.
fn right() -> String {
    hit(",1") + &miss(",0")
}

fn place(error: &Value) -> &str {
    error["where"][0].as_str().unwrap_or_default()
}

#[test]
fn a_file_is_answered_and_compared() {
    let bench = Bench::new();
    bench.file("vf.csv", right());
    let (object, ran) = bench.json("ccd vf.csv");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    let file = &object["files"][0];
    assert_eq!((&file["file"], &file["kind"]), (&json!("vf.csv"), &json!("vertex_face")));
    assert_eq!((&file["queries"], &file["collisions"]), (&json!(2), &json!(1)));
    assert_eq!((&file["false_positives"], &file["false_negatives"]), (&json!(0), &json!(0)));
    let stages = ["culled", "filtered", "exact"].map(|stage| file["stages"][stage].as_u64().unwrap());
    assert_eq!(stages.iter().sum::<u64>(), 2);
    assert_eq!(stages[0], 1, "boxes keep the second query apart");
    let (mean, max) = (file["mean_ns"].as_f64().unwrap(), file["max_ns"].as_u64().unwrap());
    assert!(mean > 0.0 && max > 0, "{mean} {max}");
    assert_eq!((&object["method"], &object["error"]), (&json!("exact"), &Value::Null));
    let total = &object["total"];
    for key in ["queries", "collisions", "false_positives", "false_negatives", "mean_ns", "max_ns", "stages"]
    {
        assert_eq!(total["vertex_face"][key], file[key], "{key}");
        assert!(total["edge_edge"].get(key).is_some(), "{key}");
    }
    assert_eq!((&total["edge_edge"]["queries"], &total["edge_edge"]["mean_ns"]), (&json!(0), &Value::Null));
    assert!(
        ran.err.contains("2 queries, 1 with contact: 0 false positives, 0 false negatives"),
        "{}",
        ran.err
    );
}

/// A face that swings through the path of the vertex and back: contact at 1/4 and at 3/4, with which parity has no quarrel.
#[test]
fn methods_differ_where_they_say_so() {
    let bench = Bench::new();
    let row = |[x, y, z]: [&str; 3]| format!("{x},{y},{z},1\n");
    let vertices = [
        ["-1,1", "0,1", "-1,4"],
        ["-4,1", "-4,1", "-4,1"],
        ["4,1", "-4,1", "4,1"],
        ["0,1", "4,1", "0,1"],
        ["1,1", "0,1", "-1,4"],
        ["-4,1", "-4,1", "4,1"],
        ["4,1", "-4,1", "-4,1"],
        ["0,1", "4,1", "0,1"],
    ];
    bench.file("vf.csv", vertices.map(row).concat());
    for (method, false_negatives, staged) in [("exact", 0, true), ("parity", 1, false)] {
        let (object, ran) = bench.json(&format!("ccd vf.csv --method {method}"));
        assert_eq!(ran.exit, Some(0), "{}", ran.err);
        assert_eq!(object["method"], json!(method));
        let file = &object["files"][0];
        assert_eq!(file["false_negatives"], json!(false_negatives), "{method}");
        assert_eq!(file["stages"].is_object(), staged, "{method}");
    }
    // Of the swept simplices it is one contact or another, but the clear cases are the same.
    bench.file("clear-vf.csv", right());
    let (object, ran) = bench.json("ccd clear-vf.csv --method spacetime");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    assert_eq!(
        (&object["files"][0]["false_negatives"], &object["files"][0]["false_positives"]),
        (&json!(0), &json!(0))
    );
}

#[test]
fn people_get_a_table_with_sums() {
    let bench = Bench::new();
    bench.file("vf.csv", right()).file("ee.csv", miss(",0"));
    let ran = bench.run("ccd vf.csv ee.csv").ok();
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines.len(), 6, "{}", ran.out);
    for (line, start) in lines.iter().zip(["file ", "vf.csv ", "ee.csv ", "total ", "total ", "3 queries"]) {
        assert!(line.starts_with(start), "{}", ran.out);
    }
    assert!(ran.err.is_empty(), "{}", ran.err);
    let quiet = bench.run("ccd -q vf.csv").ok();
    assert_eq!((quiet.out.as_str(), quiet.err.as_str()), ("", ""));
}

#[test]
fn false_answers_are_reported_listed_and_can_be_a_gate() {
    let bench = Bench::new();
    bench.file("vf.csv", right() + &hit(",0") + &miss(",1") + &miss(",1"));
    let (object, ran) = bench.json("ccd vf.csv");
    assert_eq!(ran.exit, Some(0), "the report is what was asked for");
    let file = &object["files"][0];
    assert_eq!((&file["false_positives"], &file["false_negatives"]), (&json!(1), &json!(2)));
    let listed = bench.run("ccd -v vf.csv").ok();
    for line in [
        "vf.csv:17: query 2: contact found, known: none",
        "vf.csv:25: query 3: no contact found, known: contact",
        "vf.csv:33: query 4: no contact found, known: contact",
    ] {
        assert!(listed.err.lines().any(|told| told == line), "{}", listed.err);
    }
    let error = bench.fails("ccd vf.csv --require correct", "W9001", 9);
    assert_eq!(error["what"], "1 false positives, 2 false negatives");
    assert_eq!(
        (place(&error), &error["where_count"]),
        ("vf.csv:17: query 2: contact found, known: none", &json!(3))
    );
    bench.file("good-vf.csv", right());
    bench.run("ccd good-vf.csv --require correct").ok();
}

#[test]
fn without_known_answers_nothing_is_called_false() {
    let bench = Bench::new();
    bench.file("vf.csv", hit("") + &miss(""));
    let (object, ran) = bench.json("ccd vf.csv");
    assert_eq!(ran.exit, Some(0));
    for part in [&object["files"][0], &object["total"]["vertex_face"]] {
        assert_eq!((&part["queries"], &part["collisions"]), (&json!(2), &json!(1)));
        assert!(part["false_positives"].is_null() && part["false_negatives"].is_null(), "{part:#}");
    }
    bench.fails("ccd vf.csv --require correct", "W9002", 9);
}

#[test]
fn answers_are_written_in_the_order_of_the_input() {
    let bench = Bench::new();
    std::fs::create_dir_all(bench.path("set/b")).unwrap();
    bench.file("vf.csv", miss(",0") + &right());
    bench.file("set/b/vf.csv", hit("")).file("set/a-vf.csv", miss("")).file("set/c-vf.CSV", hit(""));
    bench.file("set/notes.txt", "no queries").file("set/._vf.csv", "hidden");
    let (object, ran) = bench.json("ccd vf.csv set --answers out.txt");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    assert_eq!(bench.read("out.txt"), b"0\n1\n0\n0\n1\n1\n");
    assert_eq!(object["answers"], "out.txt");
    let files: Vec<&str> =
        object["files"].as_array().unwrap().iter().map(|file| file["file"].as_str().unwrap()).collect();
    assert_eq!(files, ["vf.csv", "set/a-vf.csv", "set/b/vf.csv", "set/c-vf.CSV"]);
}

#[test]
fn answers_are_never_written_over_unasked() {
    let bench = Bench::new();
    bench.file("vf.csv", right()).file("out.txt", "mine");
    let error = bench.fails("ccd vf.csv --answers out.txt", "W7003", 7);
    assert!(error["help"].as_str().unwrap().contains("--force"), "{error:#}");
    assert_eq!(bench.read("out.txt"), b"mine");
    bench.run("ccd vf.csv --answers out.txt --force").ok();
    assert_eq!(bench.read("out.txt"), b"1\n0\n");
    bench.fails("ccd vf.csv --answers vf.csv --force", "W2005", 2);
    bench.fails("ccd vf.csv --answers no/such/out.txt", "W7001", 7);
    bench.fails("ccd vf.csv --answers .", "W7005", 7);
    bench.fails("ccd vf.csv --answers -", "W2006", 2);
    if std::path::Path::new("/dev/full").exists() {
        bench.fails("ccd vf.csv --answers /dev/full", "W7004", 7);
    } else {
        println!("skipped: no /dev/full");
    }
}

#[test]
fn answers_with_a_gap_are_not_written_but_false_ones_are() {
    let bench = Bench::new();
    bench.file("a-vf.csv", right()).file("b-vf.csv", right() + "0,1\n").file("c-vf.csv", hit(",0"));
    let (object, ran) = bench.json("ccd a-vf.csv b-vf.csv c-vf.csv --answers out.txt");
    assert_eq!(ran.exit, Some(4));
    assert!(ran.err.contains("note: out.txt: not written"), "{}", ran.err);
    assert_eq!(bench.names(), ["a-vf.csv", "b-vf.csv", "c-vf.csv"], "nothing is left behind");
    let files = object["files"].as_array().unwrap();
    assert_eq!((&files[0]["queries"], &files[2]["queries"]), (&json!(2), &json!(1)), "others are answered");
    assert_eq!((&files[1]["error"]["code"], &object["error"]["code"]), (&json!("W4006"), &json!("W4006")));
    assert_eq!(object["total"]["vertex_face"]["queries"], 3);
    assert!(object.get("answers").is_none());
    let gate = bench.run("ccd c-vf.csv --require correct --answers out.txt");
    assert_eq!((gate.exit, bench.read("out.txt")), (Some(9), b"1\n".to_vec()));
}

#[test]
fn the_kind_is_that_of_the_name_or_the_one_asked_for() {
    let bench = Bench::new();
    for folder in ["edge-edge", "vertex-face", "set"] {
        std::fs::create_dir(bench.path(folder)).unwrap();
    }
    for name in ["edge-edge/0.csv", "vertex-face/0.csv", "set/0.csv", "ee.csv", "vf.csv"] {
        bench.file(name, hit(""));
    }
    // The same rows mean different things, and here have different answers.
    let told = |line: &str| {
        let (object, ran) = bench.json(line);
        assert_eq!(ran.exit, Some(0), "{line}: {}", ran.err);
        let file = &object["files"][0];
        (file["kind"].as_str().unwrap().to_owned(), file["collisions"].as_u64().unwrap())
    };
    let (edges, face) = (("edge_edge".to_owned(), 0), ("vertex_face".to_owned(), 1));
    assert_eq!(told("ccd edge-edge"), edges);
    assert_eq!(told("ccd ee.csv"), edges);
    assert_eq!(told("ccd set/0.csv --kind edge-edge"), edges);
    assert_eq!(told("ccd vf.csv --kind edge-edge"), edges);
    assert_eq!(told("ccd vertex-face/0.csv"), face);
    assert_eq!(told("ccd vf.csv"), face);
    assert_eq!(told("ccd set --kind vertex-face"), face);
    let error = bench.fails("ccd set/0.csv", "W2007", 2);
    assert!(
        error["help"].as_str().unwrap().starts_with("welter ccd set/0.csv --kind edge-edge"),
        "{error:#}"
    );
}

#[test]
fn line_ends_blank_lines_at_the_end_spaces_and_a_byte_order_mark_change_nothing() {
    let bench = Bench::new();
    let plain = right();
    bench.file("vf.csv", plain.replace(",-4,", " ,\t-4 , ").replace('\n', "\r\n") + "\r\n \n\n");
    bench.file("mark-vf.csv", format!("\u{feff}{}", plain.trim_end()));
    for name in ["vf.csv", "mark-vf.csv"] {
        bench.run(&format!("ccd {name} --require correct --answers out.txt --force")).ok();
        assert_eq!(bench.read("out.txt"), b"1\n0\n", "{name}");
    }
}

#[test]
fn a_coordinate_that_is_no_f64_is_refused_or_rounded_when_asked() {
    let bench = Bench::new();
    bench.file("vf.csv", right().replacen("-4,1", "-4,3", 1));
    let error = bench.fails("ccd vf.csv", "W4012", 4);
    assert_eq!(place(&error), "vf.csv:2");
    assert_eq!(error["what"], "column 1: -4/3 equals no f64, the nearest is -1.3333333333333333e0");
    let help = error["help"].as_str().unwrap();
    let mended = help.strip_prefix("welter ").unwrap().split("   #").next().unwrap();
    let (object, ran) = bench.json(mended);
    assert_eq!((ran.exit, &object["files"][0]["rounded_coordinates"]), (Some(0), &json!(1)));
    assert!(ran.err.contains("note: vf.csv: 1 coordinates rounded"), "{}", ran.err);
    // Beyond the range nothing is near.
    bench.file("vf.csv", right().replacen("-4,1", &format!("1{},1", "0".repeat(309)), 1));
    for line in ["ccd vf.csv", "ccd vf.csv --rounded"] {
        assert!(
            bench.fails(line, "W4012", 4)["what"].as_str().unwrap().ends_with("is beyond the range of f64")
        );
    }
}

#[test]
fn bad_content_is_told_with_the_line() {
    let bench = Bench::new();
    let swap = |from: &str, to: &str| right().replacen(from, to, 1).into_bytes();
    let cut: String = right().lines().take(13).map(|line| format!("{line}\n")).collect();
    let cases: [(Vec<u8>, &str, &str, &str); 14] = [
        (Vec::new(), "W4005", "", "the file is empty"),
        (b" \n\r\n\t".to_vec(), "W4005", "", "the file is empty"),
        (cut.into_bytes(), "W4007", "vf.csv:13", "the file ends here, after 5 of 8 rows of a query"),
        (
            swap("4,1,-4,1,0,1,1", "4,1,-4,1,1"),
            "W4006",
            "vf.csv:2",
            "5 columns, expected 7 as on the first row",
        ),
        (swap("0,1,0,1,1,1,1", "0,1,0,1,1,1,1,1"), "W4006", "vf.csv:1", "8 columns, expected 6 or 7"),
        (
            swap("0,1,4,1,0,1,1", "0,1,4,1,0,1"),
            "W4006",
            "vf.csv:4",
            "6 columns, expected 7 as on the first row",
        ),
        (swap("4,1,-4", "4,1,4.5"), "W4006", "vf.csv:2", "column 3: expected an integer, found `4.5`"),
        (swap("4,1,-4", "4,1,"), "W4006", "vf.csv:2", "column 3: expected an integer, found ``"),
        (swap("4,1,-4", "4,0,-4"), "W4006", "vf.csv:2", "column 2: the denominator is zero"),
        (swap("0,1,0,1,1,1,1", "0,1,0,1,1,1,2"), "W4006", "vf.csv:1", "column 7: expected 0 or 1, found `2`"),
        (
            swap("0,1,4,1,0,1,1", "0,1,4,1,0,1,0"),
            "W4006",
            "vf.csv:4",
            "column 7: the query that begins on line 1 has both answers, 0 and 1",
        ),
        (swap("0,1,1\n", "0,1,1\n\n"), "W4006", "vf.csv:3", "the line is blank, and rows follow"),
        (b"0,1,0,1,\xff,1,1\n".to_vec(), "W4008", "vf.csv:1", "byte 9 of the line is not UTF-8 text"),
        (vec![b'7'; 3_000_000], "W4006", "vf.csv:1", "the line is longer than 8192 bytes"),
    ];
    for (content, code, at, what) in cases {
        bench.file("vf.csv", &content);
        let error = bench.fails("ccd vf.csv", code, 4);
        assert_eq!((error["file"].as_str(), place(&error)), (Some("vf.csv"), at), "{error:#}");
        assert!(error["what"].as_str().unwrap().starts_with(what), "{what}: {error:#}");
    }
}

#[test]
fn what_cannot_be_read_is_found_before_the_work() {
    let bench = Bench::new();
    bench.file("vf.csv", right());
    std::fs::create_dir(bench.path("empty")).unwrap();
    for (line, code, exit) in [
        ("ccd vf.csv nowhere-vf.csv --answers out.txt", "W4001", 4),
        ("ccd empty", "W4011", 4),
        ("ccd", "W2001", 2),
        ("ccd vf.csv --method guess", "W2001", 2),
        ("ccd vf.csv --kind triangle", "W2001", 2),
        ("ccd vf.csv --repeat -1", "W2001", 2),
    ] {
        bench.fails(line, code, exit);
    }
    assert_eq!(bench.names(), ["empty", "vf.csv"]);
    if !permissions_bind(&bench) {
        println!("skipped: permissions do not bind this user");
        return;
    }
    std::fs::set_permissions(bench.path("vf.csv"), std::fs::Permissions::from_mode(0o000)).unwrap();
    bench.fails("ccd vf.csv", "W4004", 4);
}

#[test]
fn queries_keep_their_numbers_beyond_a_block() {
    let bench = Bench::new();
    // More than two blocks, with one false answer near the end.
    let mut text = miss(",0").repeat(2500) + &hit(",0") + &miss(",0");
    bench.file("vf.csv", &text);
    let ran = bench.run("ccd vf.csv -v --repeat 0 --answers out.txt --progress plain").ok();
    assert!(ran.err.contains("vf.csv:20001: query 2500: contact found, known: none"), "{}", ran.err);
    assert!(ran.err.contains("queries: 100 %"), "{}", ran.err);
    text = "0\n".repeat(2500) + "1\n0\n";
    assert!(bench.read("out.txt") == text.as_bytes());
    let (object, _) = bench.json("ccd vf.csv --repeat 0");
    let file = &object["files"][0];
    assert!(file["mean_ns"].is_null() && file["max_ns"].is_null(), "nothing was timed");
    assert_eq!(file["queries"], 2502);
}

#[test]
fn standard_input_is_read_where_the_kind_is_named() {
    let bench = Bench::new();
    bench.fails("ccd -", "W2007", 2);
    let args = ["ccd", "-", "--kind", "vertex-face", "--require", "correct", "--answers", "out.txt"];
    let mut child = bench.command(&args).stdin(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(right().as_bytes()).unwrap();
    Ran::of(child.wait_with_output().unwrap()).ok();
    assert_eq!(bench.read("out.txt"), b"1\n0\n");
}

#[test]
fn ctrl_c_leaves_no_answers() {
    let bench = Bench::new();
    let args = ["ccd", "-", "--kind", "vertex-face", "--answers", "out.txt"];
    let mut child = bench.command(&args).stdin(Stdio::piped()).spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    input.write_all(hit("").as_bytes()).unwrap();
    bench.interrupt_writing(child, 0);
    assert_eq!(bench.names(), [""; 0]);
}

#[test]
fn public_queries_have_no_false_answer() {
    let Some(folder) = public_queries() else {
        println!("skipped: the public queries are not there");
        return;
    };
    let output = Bench::new()
        .command(&["ccd", "--json", "--require", "correct", "--repeat", "0"])
        .arg(folder)
        .output()
        .unwrap();
    let ran = Ran::of(output).ok();
    let object: Value = serde_json::from_str(&ran.out).unwrap();
    for kind in ["edge_edge", "vertex_face"] {
        let total = &object["total"][kind];
        assert!(total["queries"].as_u64().unwrap() > 1000, "{total:#}");
        assert_eq!(total["queries"], total["queries_with_truth"]);
        assert_eq!((&total["false_positives"], &total["false_negatives"]), (&json!(0), &json!(0)), "{kind}");
        let stages: u64 = total["stages"].as_object().unwrap().values().map(|n| n.as_u64().unwrap()).sum();
        assert_eq!(json!(stages), total["queries"]);
    }
}
