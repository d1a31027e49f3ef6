//! `welter view`.

use crate::harness::Bench;
use serde_json::Value;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};

const TETRAHEDRON: &str = "v 0 0 0\nv 4 0 0\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

fn page(bench: &Bench, name: &str) -> String {
    String::from_utf8(bench.read(name)).unwrap()
}

/// How many frames a page holds.
fn frames(page: &str) -> usize {
    page.matches("<script type=\"text/plain\"").count()
}

#[test]
fn a_page_names_no_other_file() {
    let bench = Bench::new();
    bench.file("a<b.obj", TETRAHEDRON);
    let (object, ran) = bench.json("view a<b.obj --html a.html");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    let counts = ["frames", "most_vertices", "most_triangles"].map(|key| object[key].as_u64().unwrap());
    assert_eq!((counts, object["output"].as_str()), ([1, 4, 4], Some("a.html")));
    let page = page(&bench, "a.html");
    assert_eq!(object["bytes"].as_u64(), Some(page.len() as u64));
    assert_eq!(frames(&page), 1);
    assert!(page.contains("<title>a&lt;b.obj</title>") && !page.contains("a<b"));
    for outside in ["http:", "https:", "src=", "href=", "import "] {
        assert!(!page.contains(outside), "{outside}");
    }
}

#[test]
fn runs_sequences_and_volumes_are_shown() {
    let bench = Bench::new();
    bench.run("new ring-through-ring").ok();
    let scene = "ring-through-ring.toml -o run --frames ..4 --set render.enabled=false";
    bench.run(&format!("sim {scene}")).ok();
    let shown = |line: &str| {
        let (object, ran) = bench.json(&format!("view {line} --html page.html --force"));
        assert_eq!(ran.exit, Some(0), "{line}: {}", ran.err);
        assert_eq!(object["frames"].as_u64(), Some(frames(&page(&bench, "page.html")) as u64), "{line}");
        object["frames"].as_u64().unwrap()
    };
    assert_eq!(shown("run"), 5);
    assert_eq!(shown("run --every 2"), 3);
    assert_eq!(shown("run/surface/frame_%04d.ply --every 4 --up y"), 2);
    bench.run("shape figure-eight -o a.ply --size 0.3").ok();
    bench.run("mesh a.ply -o a.vtu -r 4 --no-verify").ok();
    assert_eq!(shown("a.vtu"), 1);
}

/// The page, run by Node where that is installed.
#[test]
fn the_page_draws_what_the_files_hold() {
    if Command::new("node").arg("--version").output().is_err() {
        println!("not run: node is not installed");
        return;
    }
    let bench = Bench::new();
    bench.file("f_1.obj", TETRAHEDRON);
    bench.file("f_2.obj", "v 1 0 0\nv 3 0 0\nv 1 1 0\nv 1 0 0.5\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n");
    bench.run("view f_{}.obj --html page.html").ok();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/cli/view_page.js");
    let output = Command::new("node").arg(script).arg(bench.path("page.html")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let seen: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!([0, 1].map(|k| seen["meta"]["frames"][k]["name"].clone()), ["frame 1", "frame 2"]);
    // In units of the longest side, 4.
    assert_eq!(seen["frames"][0]["extent"], serde_json::json!([[0, 1], [0, 0.5], [0, 0.25]]));
    assert_eq!(seen["frames"][1]["extent"], serde_json::json!([[0.25, 0.75], [0, 0.25], [0, 0.125]]));
    let of = |frame: usize, key: &str| seen["frames"][frame][key].as_u64().unwrap();
    assert_eq!([of(0, "vertices"), of(0, "triangles"), of(1, "triangles")], [4, 4, 4]);
    let covered = [of(0, "covered"), of(1, "covered")];
    assert!(covered[0] > 3000 && covered[1] > 500, "{covered:?}");
    assert!((3..6).contains(&(covered[0] / covered[1])), "a quarter of the area: {covered:?}");
    let color = |frame: usize| {
        let channel = |k: usize| seen["frames"][frame]["middle"][k].as_u64().unwrap();
        [channel(0), channel(2)]
    };
    // The second one is inside out: its back is seen, which is orange.
    assert!(color(0)[0] < color(0)[1] && color(1)[0] > color(1)[1], "{:?} {:?}", color(0), color(1));
    // Edges, flat shading, the next frame, and another view change the picture.
    let pictures = seen["pictures"].as_array().unwrap();
    assert!(pictures.windows(2).enumerate().all(|(k, pair)| pair[0] != pair[1] || k == 1), "{pictures:?}");
    let texts: Vec<&str> =
        seen["texts"].as_array().unwrap().iter().map(|text| text.as_str().unwrap()).collect();
    assert_eq!(texts[0], "frame 1: 4 vertices, 4 triangles");
    assert!(texts[3].starts_with("frame 2:"), "{texts:?}");
}

/// A server that does not outlive the test, however that ends.
struct Served(Child);

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn get(at: &str, request: &str) -> String {
    let mut stream = TcpStream::connect(at).unwrap();
    stream.write_all(request.as_bytes()).unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    answer
}

#[test]
fn the_page_is_served_to_this_machine_until_ctrl_c() {
    let bench = Bench::new();
    bench.file("a.obj", TETRAHEDRON);
    bench.run("view a.obj --html a.html").ok();
    let child = bench.command(&["view", "a.obj", "--json"]).stdout(Stdio::piped()).spawn().unwrap();
    let mut served = Served(child);
    let told = serde_json::Deserializer::from_reader(served.0.stdout.take().unwrap());
    let object = told.into_iter::<Value>().next().unwrap().unwrap();
    let url = object["url"].as_str().unwrap();
    let at = url.strip_prefix("http://").and_then(|at| at.strip_suffix('/')).unwrap();
    assert!(at.starts_with("127.0.0.1:"), "{at}");
    let whole = get(at, "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    assert!(whole.starts_with("HTTP/1.1 200 OK\r\n"), "{}", &whole[..200]);
    assert_eq!(whole.split_once("\r\n\r\n").unwrap().1, page(&bench, "a.html"));
    assert!(get(at, "GET /favicon.ico HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 404"));
    assert!(get(at, "POST / HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 405"));
    assert!(get(at, "HEAD / HTTP/1.1\r\n\r\n").ends_with("\r\n\r\n"));
    // What is no request is given up, and the next one is answered.
    let mut rude = TcpStream::connect(at).unwrap();
    let _ = rude.write_all(&vec![b'x'; 40_000]);
    drop(rude);
    assert!(get(at, "GET / HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 200 OK"));
    let kill = format!("kill -INT {}", served.0.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
    assert_eq!(served.0.wait().unwrap().code(), Some(0));
}

#[test]
fn faults_are_told() {
    let bench = Bench::new();
    bench.file("a.obj", TETRAHEDRON);
    bench.file("bad.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n");
    std::fs::create_dir(bench.path("empty")).unwrap();
    bench.fails("view empty --html a.html", "W4013", 4);
    bench.fails("view bad.obj --html a.html", "W3012", 3);
    bench.fails("view nothing.obj --html a.html", "W4001", 4);
    bench.fails("view f_%04d.ply --html a.html", "W4011", 4);
    bench.fails("view a.obj --every 0 --html a.html", "W2001", 2);
    assert_eq!(bench.run("view a.obj --html - --json").exit, Some(2));
    bench.run("view a.obj --html a.html").ok();
    bench.fails("view a.obj --html a.html", "W7003", 7);
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    bench.fails(&format!("view a.obj --port {}", taken.local_addr().unwrap().port()), "W7002", 7);
}
