//! `welter new`.

use crate::harness::Bench;

/// Every scene is read by the command that it is for, as it is told.
#[test]
fn every_scene_that_is_listed_can_be_written_and_is_read() {
    let bench = Bench::new();
    let (object, _) = bench.json("new --list");
    let scenes = object["scenes"].as_array().unwrap();
    let mut shipped = 0;
    for scene in scenes {
        let name = scene["name"].as_str().unwrap();
        let (written, ran) = bench.json(&format!("new {name} scenes"));
        assert_eq!(ran.exit, Some(0), "{name}: {}", ran.err);
        let next = written["next"].as_str().unwrap();
        let command = scene["command"].as_str().unwrap();
        assert_eq!(written["files"][0], format!("scenes/{name}.toml"));
        assert!(next.starts_with(&format!("welter {command} scenes/{name}.toml -o scenes/{name}")), "{next}");
        match command {
            // Read, and refused for the memory that it would take.
            "isosurface" => {
                let ran = bench.run(&format!("{} --max-memory 1", &next["welter ".len()..]));
                assert_eq!(ran.exit, Some(6), "{name}: {}", ran.err);
            }
            _ => {
                let _ = bench.run(&format!("{command} scenes/{name}.toml --dry-run")).ok();
            }
        }
        shipped += usize::from(command != "isosurface");
    }
    assert!(shipped > 10);
    let listed = bench.run("new --list").ok().out;
    assert!(scenes.iter().all(|scene| listed.contains(scene["description"].as_str().unwrap())), "{listed}");
}

/// Nothing is forgotten: each scene of the folder is listed.
#[test]
fn every_example_is_listed() {
    let (object, _) = Bench::new().json("new --list");
    let listed: Vec<&str> =
        object["scenes"].as_array().unwrap().iter().map(|scene| scene["name"].as_str().unwrap()).collect();
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut count = 0;
    for kind in ["sim", "track", "isosurface"] {
        for entry in std::fs::read_dir(folder.join(kind)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "toml") {
                let name = path.file_stem().unwrap().to_str().unwrap();
                assert!(listed.contains(&name), "{name}");
                count += 1;
            }
        }
    }
    assert_eq!(count, listed.len());
}

#[test]
fn a_scene_is_written_here_and_not_over_another() {
    let bench = Bench::new();
    let told = bench.run("new plume").ok().out;
    assert!(told.starts_with("plume.toml: A thick plume of smoke"), "{told}");
    assert!(told.ends_with("next: welter sim plume.toml -o plume\n"), "{told}");
    assert_eq!(bench.names(), ["plume.toml"]);
    let scene = bench.read("plume.toml");
    bench.file("plume.toml", "mine");
    let ran = bench.run("new plume");
    assert!(ran.exit == Some(7) && ran.err.contains("--force"), "{}", ran.err);
    assert_eq!(bench.read("plume.toml"), b"mine");
    bench.run("new plume --force").ok();
    assert_eq!(bench.read("plume.toml"), scene);
    // One of two files is there: neither is written, and nothing is left.
    bench.file("ring-overlap.off", "mine");
    assert_eq!(bench.run("new offset").exit, Some(7));
    assert_eq!(bench.names(), ["plume.toml", "ring-overlap.off"]);
}

#[test]
fn faults_are_told() {
    let bench = Bench::new();
    let ran = bench.run("new plum");
    assert!(ran.exit == Some(2) && ran.err.contains("W2010") && ran.err.contains("welter new plume"));
    let ran = bench.run("new nothing-of-the-kind");
    assert!(ran.exit == Some(2) && ran.err.contains("welter new --list"), "{}", ran.err);
    assert_eq!(bench.run("new").exit, Some(2));
    let ran = bench.run("new plume a/b");
    assert!(ran.exit == Some(7) && ran.err.contains("mkdir -p a"), "{}", ran.err);
    bench.file("file", "x");
    assert_eq!(bench.run("new plume file").exit, Some(7));
    assert_eq!(bench.names(), ["file"], "nothing is left behind");
}
