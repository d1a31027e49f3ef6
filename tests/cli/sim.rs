//! `welter sim`: scenes, results, what is refused, and runs that are gone on with.

use crate::harness::Bench;
use glam::DVec3;
use serde_json::Value;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use welter_fluids::volume_rendering::{Camera, Light, Medium, RenderParameters, Scene, render};
use welter_meshing::Monitor;
use welter_meshing::io::{Format, Limits, read};
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh};

/// Puffs in a vortex ring, two of them in six steps.
const PUFFS: &str = "[[emissions]]\nshape = \"sphere\"\nscale = 0.3\nedge_length = 0.15\ninterval = 0.15\n[[flows]]\n\
    kind = \"ring\"\nradius = 0.5\ncore = 0.2\n[time]\nstep = 0.04\nsteps = 6\n[output]\nevery = 2\ncheckpoint_every = 2\n";

/// All planes of small pictures in both formats.
const PICTURES: &str = "[render]\nextinction = 8\nsize = [48, 32]\nshadow_resolution = 16\nbackground = [0.1, 0.2, 0.3]\n\
    age_white = 0.2\n[render.camera]\neye = [2, -2, 1]\ntarget = [0, 0, 0.1]\n[render.planes]\nalpha = [\"png\", \"exr\"]\n\
    scatter = [\"png\", \"exr\"]\nage = [\"png\", \"exr\"]\nbackdrop = [\"exr\"]\ncomposite = [\"exr\", \"png\"]\n";

fn number(object: &Value, path: &str) -> f64 {
    object.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} in {object:#}"))
}

fn lines(bench: &Bench, run: &str) -> Vec<Value> {
    let text = String::from_utf8(bench.read(&format!("{run}/stats.jsonl"))).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn the_result_has_every_key_of_the_contract() {
    let bench = Bench::new();
    bench.file("a.toml", format!("{PUFFS}pictures = true\nsize = [60, 40]\n"));
    let (object, ran) = bench.json("sim a.toml -o run");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    assert_eq!(
        (&object["frames"], &object["status"], &object["releases"]["made"]),
        (&4.into(), &"finished".into(), &2.into())
    );
    assert!((number(&object, "/time") - 0.24).abs() < 1e-12);
    for path in ["/elements/triangles", "/seconds_per_frame/total", "/seconds_per_frame/velocity"] {
        assert!(number(&object, path) > 0.0, "{path}");
    }
    assert!(object["solver"].is_string() && object.get("peak_rss_bytes").is_some());
    // Two balls, as polyhedra within them.
    let two = 2.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.3_f64.powi(3);
    assert!((number(&object, "/conserved/volume/released") / two - 1.0).abs() < 0.1, "{object:#}");
    assert!(number(&object, "/conserved/volume/relative_error").abs() < 0.01, "{object:#}");
    let lines = lines(&bench, "run");
    assert_eq!(lines.len(), 7);
    let releases: Vec<usize> = lines.iter().map(|line| line["releases"].as_array().unwrap().len()).collect();
    assert_eq!(releases, [1, 0, 0, 0, 1, 0, 0]);
    let released = |k: usize| lines[k]["released_volume"].to_string();
    assert_eq!((released(1), released(5)), ("0.0".to_owned(), "0.0".to_owned()), "nothing is not -0");
    for frame in 0..4 {
        let bytes = bench.read(&format!("run/paraview/surface_{frame:04}.vtp"));
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4000)]).into_owned();
        assert!(head.contains("Name=\"age\""), "{head}");
        assert!(bench.read(&format!("run/surface/frame_{frame:04}.ply")).starts_with(b"ply"));
        assert!(bench.read(&format!("run/preview/frame_{frame:04}.png")).starts_with(b"\x89PNG"));
    }
    let (checked, _) = bench.json("check run/surface/frame_0003.ply");
    assert_eq!(
        (&checked["files"][0]["components"], &checked["files"][0]["closed"]),
        (&2.into(), &true.into())
    );
}

/// The scenes that are shipped, coarser and for a frame.
#[test]
fn the_examples_that_are_shipped_work() {
    let bench = Bench::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/sim");
    let mut scenes: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    scenes.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    assert!(scenes.len() >= 4);
    for scene in scenes {
        let name = scene.file_stem().unwrap().to_str().unwrap().to_owned();
        let line = format!(
            "sim {} -o {name} --frames ..1 --set output.pictures=false --set render.size=[64,36]",
            scene.display()
        );
        let (object, ran) = bench.json(&line);
        assert_eq!(ran.exit, Some(0), "{name}: {}", ran.err);
        assert_eq!((&object["status"], &object["frames"]), (&"stopped".into(), &2.into()), "{name}");
        // A sheet encloses nothing, and so there is no change of it either.
        match object.pointer("/conserved/volume/relative_error").and_then(Value::as_f64) {
            Some(error) => assert!(error.abs() < 0.01, "{name}: {object:#}"),
            None => assert_eq!((name.as_str(), number(&object, "/conserved/volume/released")), ("fog", 0.0)),
        }
        assert_eq!(object["rendering"]["frames"], 2, "{name}: {object:#}");
    }
}

#[test]
fn a_dry_run_tells_the_scene_and_writes_nothing() {
    let bench = Bench::new();
    bench.file("a.toml", PUFFS);
    let ran =
        bench.run("sim a.toml --dry-run --set smoke.coarsening=1.5 --set integration.enabled=true").ok();
    for line in ["coarsening = 1.5\n", "split_scheme = \"midpoint\"\n", "joining = \"separate\"\n"] {
        assert!(ran.out.contains(line), "{}", ran.out);
        for absent in ["# count = ...", "# reference_length = ...", "# [flows.pulse] ...", "# [[solids]] ..."]
        {
            assert!(ran.out.lines().any(|line| line == absent), "{absent}");
        }
    }
    for line in [
        "[render]\nenabled = false\nsize = [960, 540]\nfirst_frame = 0\nevery_frame = 1\nalbedo = [1.0, 1.0, 1.0]\n",
        "interior = \"non-zero\"\nbackground = [0.0, 0.0, 0.0]\nshadow_resolution = 128\ntraced_triangles = 16\n",
        "age_white = 0.24\npng_colors = \"8-bit\"\nexr_numbers = \"32-bit\"\n",
        "\n\n[render.light]\ndirection = ",
        "[render.camera]\nup = [0.0, 0.0, 1.0]\nfield_of_view = 40.0\nazimuth = 30.0\nelevation = 10.0\nfill = 0.9\n",
        "[render.planes]\nalpha = []\nscatter = []\nage = []\nbackdrop = []\ncomposite = [\"png\"]\n",
    ] {
        assert!(ran.out.contains(line), "{line} in {}", ran.out);
    }
    assert_eq!(bench.names(), ["a.toml"]);
    bench.file("b.toml", &ran.out);
    assert_eq!(bench.run("sim b.toml --dry-run").ok().out, ran.out);
}

/// Each fault of a scene, the line that is told, and a word of the help.
#[test]
fn faults_of_scenes_are_told_with_their_line() {
    let bench = Bench::new();
    let with = |before: &str, after: &str| PUFFS.replacen(before, after, 1);
    for (text, code, line, help) in [
        (with("interval", "intervall"), "W5002", 5, "`interval`"),
        (with("[output]", "[outptu]"), "W5002", 13, "`output`"),
        (with("core = 0.2", "velocity = [0, 0, 1]"), "W5002", 9, ""),
        (with("kind = \"ring\"", "kind = \"rings\""), "W5004", 7, "\"ring\""),
        (with("kind = \"ring\"", ""), "W5003", 6, "kind = "),
        (with("core = 0.2", "core = -1"), "W5004", 9, ""),
        (with("core = 0.2", "path = [[0, 1]]"), "W5004", 9, ""),
        (with("interval = 0.15", "interval = 0"), "W5004", 5, ""),
        (with("interval = 0.15", "start = -1"), "W5004", 5, ""),
        (with("interval = 0.15", "count = 3"), "W5004", 5, "interval"),
        (with("interval = 0.15", "joining = \"merged\""), "W5004", 0, ""),
        (with("shape = \"sphere\"", "shape = \"spere\""), "W5004", 2, "--list"),
        (with("[output]", "[topology]\nenabled = true\n[output]"), "W5004", 13, ""),
        (with("[output]", "[smoke]\ncoarsening = 1\n[output]"), "W5004", 14, ""),
        (with("[output]", "[[solids]]\nkind = \"ball\"\nradius = 1\n[output]"), "W5003", 13, "ramp_width"),
        (
            with("[output]", "[[solids]]\nkind = \"ball\"\nradius = -1\nramp_width = 1\n[output]"),
            "W5004",
            15,
            "",
        ),
        (
            with(
                "[output]",
                "[[solids]]\nkind = \"box\"\nmin = [0, 0, 0]\nmax = [1, 0, 1]\nramp_width = 1\n[output]",
            ),
            "W5004",
            16,
            "",
        ),
        (
            with(
                "[output]",
                "[[solids]]\nkind = \"capsule\"\nends = [[0, 0, 1]]\nradius = 1\nramp_width = 1\n[output]",
            ),
            "W5004",
            15,
            "",
        ),
        (with("[output]", "[rendre]\nextinction = 1\n[output]"), "W5002", 13, "`render`"),
        (with("[output]", "[render]\nextinktion = 1\n[output]"), "W5003", 13, "extinction = "),
        (with("[output]", "[render]\nextinction = 1\nalbdeo = [1, 1, 1]\n[output]"), "W5002", 15, "`albedo`"),
        (with("[output]", "[render]\nextinction = -1\n[output]"), "W5004", 14, ""),
        (
            with("[output]", "[render]\nextinction = 1\n[render.camera]\neye = [1, 0, 0]\n[output]"),
            "W5004",
            16,
            "target",
        ),
        (
            with("[output]", "[render]\nextinction = 1\n[render.camera]\nazimut = 3\n[output]"),
            "W5002",
            16,
            "`azimuth`",
        ),
        (
            with("[output]", "[render]\nextinction = 1\n[render.light]\ndirection = [0, 0, 0]\n[output]"),
            "W5004",
            16,
            "",
        ),
        (
            with("[output]", "[render]\nextinction = 1\n[render.planes]\nalpha = [\"pgn\"]\n[output]"),
            "W5004",
            16,
            "\"png\"",
        ),
        (
            with("[output]", "[render]\nextinction = 1\n[render.planes]\nage = \"png\"\n[output]"),
            "W5004",
            16,
            "",
        ),
        (
            with("[output]", "[render]\nextinction = 1\nlayer_direction = [0, 0, -1]\n[output]"),
            "W5004",
            15,
            "layer_thickness",
        ),
        (with("[output]", "[render]\nextinction = 1\nlayer_thickness = 0\n[output]"), "W5004", 15, ""),
        (with("[output]", "[render]\nextinction = 1\nshadow_resolution = 5000\n[output]"), "W5004", 15, ""),
        ("[time]\nstep = 1\nsteps = 1\n".to_owned(), "W5004", 0, "[[emissions]]"),
    ] {
        bench.file("a.toml", &text);
        let error = bench.fails("sim a.toml -o run", code, 5);
        if line > 0 {
            assert_eq!(error["where"][0], format!("a.toml:{line}"), "{text}: {error:#}");
        }
        assert!(error["help"].as_str().unwrap().contains(help), "{text}: {error:#}");
    }
    bench.file("a.toml", PUFFS);
    bench.fails("sim a.toml", "W2001", 2);
    bench.fails("sim a.toml -o run --frames 3..1", "W2001", 2);
    bench.fails("sim a.toml -o run --frames 1..2", "W2001", 2);
    bench.fails("sim a.toml -o run --resume --force", "W2001", 2);
    assert!(!bench.exists("run/run.json"), "nothing was run");
}

/// The files of the pictures of a frame.
fn pictures_of(frame: u32) -> Vec<String> {
    let png = ["alpha", "scatter", "age", "composite"].map(|plane| format!("volume/{plane}_{frame:04}.png"));
    png.into_iter().chain([format!("volume/planes_{frame:04}.exr")]).collect()
}

/// The numbers of a grey PNG file of 16 bits, from 0 to 1.
fn grey(file: &[u8]) -> Vec<f64> {
    let mut reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!((info.width, info.height, info.bit_depth), (48, 32, png::BitDepth::Sixteen));
    bytes.chunks_exact(2).map(|two| f64::from(u16::from_be_bytes([two[0], two[1]])) / 65535.0).collect()
}

/// A channel of an EXR file.
fn channel(file: &[u8], name: &str) -> Vec<f32> {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    let image = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer();
    let image = image.all_attributes().from_buffered(Cursor::new(file)).unwrap();
    let channels = &image.layer_data.channel_data.list;
    let channel = channels.iter().find(|channel| channel.name.eq(name)).unwrap();
    channel.sample_data.values_as_f32().collect()
}

/// The files hold what the library renders of the surface that was written.
#[test]
fn pictures_of_the_volume_are_those_of_the_library() {
    let bench = Bench::new();
    bench.file("a.toml", format!("{PUFFS}{PICTURES}"));
    let (object, ran) = bench.json("sim a.toml -o run --set render.first_frame=1 --set render.every_frame=2");
    assert_eq!(ran.exit, Some(0), "{}", ran.err);
    assert_eq!(object["rendering"]["frames"], 2, "{object:#}");
    for key in [
        "seconds_per_frame/simulation",
        "seconds_per_frame/rendering",
        "rendering/seconds_per_picture/pixels",
    ] {
        assert!(number(&object, &format!("/{key}")) > 0.0, "{key}");
    }
    let lines = lines(&bench, "run");
    for (frame, step) in [(0, 0), (1, 2), (2, 4), (3, 6)] {
        let files = pictures_of(frame);
        assert!(files.iter().all(|name| bench.exists(&format!("run/{name}")) == (frame % 2 == 1)), "{frame}");
        let told = lines[step]["pictures"]["files"].as_array().map_or(0, Vec::len);
        assert_eq!(told, if frame % 2 == 1 { 5 } else { 0 });
    }
    let file = bench.read("run/volume/planes_0003.exr");
    let soup = read(Format::Ply, &bench.read("run/surface/frame_0003.ply")[..], &Limits::default()).unwrap();
    let smoke = ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap();
    let eye = DVec3::new(2.0, -2.0, 1.0);
    let scene = Scene {
        smoke: &smoke,
        ages: &[],
        solids: &[],
        camera: Camera { up: DVec3::Z, ..Camera::toward(eye, DVec3::new(0.0, 0.0, 0.1)) },
        light: Light { direction: DVec3::new(0.0, 1.0, -1.5), ..Light::default() },
        medium: Medium::white(8.0),
        background: [0.1, 0.2, 0.3],
    };
    let parameters = RenderParameters { width: 48, height: 32, shadow_resolution: 16, ..Default::default() };
    let (picture, _) = render(&scene, &parameters, &Monitor::none()).unwrap();
    assert!(picture.alpha.pixels().iter().filter(|&&alpha| alpha > 0.5).count() > 50);
    for (name, plane) in [("alpha.Y", &picture.alpha), ("scatter.Y", &picture.scatter)] {
        assert!(channel(&file, name) == plane.pixels(), "{name}");
    }
    for (k, name) in ["R", "G", "B"].into_iter().enumerate() {
        let plane: Vec<f32> = picture.composite.pixels().iter().map(|pixel| pixel[k]).collect();
        assert!(channel(&file, name) == plane, "{name}");
    }
    // PNG beside it: ages as parts of 0.2, from the puffs of 0 and 0.15 at 0.24.
    for (plane, white) in [("alpha", 1.0), ("scatter", 1.0), ("age", 0.2)] {
        let png = grey(&bench.read(&format!("run/volume/{plane}_0003.png")));
        let exr = channel(&file, &format!("{plane}.Y"));
        for (a, b) in png.iter().zip(&exr) {
            assert!((a - (f64::from(*b) / white).min(1.0)).abs() < 0.51 / 65535.0, "{plane}: {a} {b}");
        }
        assert!(plane != "age" || exr.iter().any(|age| (0.08..0.1).contains(age)), "{exr:?}");
    }
    let report = String::from_utf8(bench.read("run/report.html")).unwrap();
    assert_eq!(report.matches("the volume of frame").count(), 4, "two pictures, each with its caption");
}

/// A sheet, the only thing that is released, becomes a layer, if it is said how thick; solids are drawn.
#[test]
fn sheets_are_drawn_as_layers_and_solids_beside_them() {
    let bench = Bench::new();
    let sheet = "[[emissions]]\nshape = \"sheet\"\nedge_length = 0.2\n[[flows]]\nkind = \"wind\"\nvelocity = [1, 0, 0]\n\
        [[solids]]\nkind = \"ball\"\nradius = 0.2\nramp_width = 0.1\ncenter = [0, 0, 0.8]\nalbedo = [1, 0, 0]\n\
        [time]\nstep = 0.05\nsteps = 1\n";
    let planes = PICTURES.replace("scatter = [\"png\", \"exr\"]\n", "");
    bench.file("a.toml", format!("{sheet}{planes}"));
    let error = bench.fails("sim a.toml -o run", "W5004", 5);
    assert!(error["help"].as_str().unwrap().contains("layer_thickness"), "{error:#}");
    assert!(!bench.exists("run/run.json"));
    bench.run("sim a.toml -o thin --set render.layer_thickness=0.05").ok();
    bench.run("sim a.toml -o thick --set render.layer_thickness=0.5").ok();
    let sum = |run: &str| {
        let file = bench.read(&format!("{run}/volume/planes_0001.exr"));
        let red = channel(&file, "backdrop.R")
            .iter()
            .zip(channel(&file, "backdrop.G"))
            .filter(|(r, g)| **r > 4.0 * g)
            .count();
        assert!(red > 5, "{red} pixels of the ball");
        channel(&file, "alpha.Y").iter().map(|&alpha| f64::from(alpha)).sum::<f64>()
    };
    assert!(sum("thick") > 1.5 * sum("thin"), "{} {}", sum("thick"), sum("thin"));
    let (object, _) = bench.json("sim a.toml -o none --set render.enabled=false");
    assert!(object["rendering"].is_null() && !bench.exists("none/volume"));
}

/// What of a run does not depend on the clock.
fn content(bench: &Bench, run: &str) -> Vec<Vec<u8>> {
    let mut files: Vec<Vec<u8>> = (0..4)
        .flat_map(|k| [format!("surface/frame_{k:04}.ply"), format!("paraview/surface_{k:04}.vtp")])
        .map(|name| bench.read(&format!("{run}/{name}")))
        .collect();
    files.push(bench.read(&format!("{run}/paraview/surface.pvd")));
    for name in (0..4).flat_map(pictures_of) {
        files.push(bench.read(&format!("{run}/{name}")));
    }
    for mut line in lines(bench, run) {
        line.as_object_mut().unwrap().remove("seconds");
        files.push(line.to_string().into_bytes());
    }
    files
}

/// Stopped in the middle and gone on with, with other threads: the same bytes.
#[test]
fn a_run_that_is_stopped_goes_on_with_the_same_bits() {
    let bench = Bench::new();
    bench.file(
        "a.toml",
        format!("{PUFFS}[smoke]\nmost_triangles = 420\n[integration]\nenabled = true\n{PICTURES}"),
    );
    bench.run("sim a.toml -o whole -j 1").ok();
    bench.run("sim a.toml -o parts --frames ..1 -j 2").ok();
    assert!(!bench.exists("parts/surface/frame_0002.ply"));
    bench.fails("sim a.toml -o parts --frames 3.. --resume", "W2001", 2);
    bench.fails("sim a.toml -o parts --resume --set time.step=0.05", "W5009", 5);
    bench.run("sim a.toml -o parts --frames 2..2 --resume").ok();
    bench.run("sim a.toml -o parts --resume").ok();
    assert!(content(&bench, "whole") == content(&bench, "parts"));
    // A checkpoint can be run alone.
    let checkpoint = bench.path("whole/checkpoint");
    let names = std::fs::read_dir(checkpoint).unwrap().map(|e| e.unwrap().path());
    let mut names: Vec<PathBuf> = names.collect();
    names.sort();
    let (object, ran) = bench.json(&format!("replay {}", names[0].display()));
    assert_eq!((ran.exit, &object["solver"]), (Some(0), &"sim".into()), "{}", ran.err);
}
