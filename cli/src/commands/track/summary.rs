//! The result of a run, from what was told of its steps: the JSON object of `welter track`.

use super::exact;
use super::scene::TrackScene;
use serde_json::{Map, Value, json};
use welter_meshing::surface::TriMesh;

const OPERATIONS: [&str; 8] =
    ["splits", "flips", "collapses", "smoothed", "merges", "separations", "cancelled", "refused"];
const COLLISIONS: [&str; 8] = [
    "proximities",
    "repulsions",
    "impulses",
    "impact_zones",
    "rigid_zones",
    "resting_zones",
    "resting_vertices",
    "dt_halvings",
];
const PHASES: [&str; 7] =
    ["improvement", "topology", "velocity", "collisions", "compaction", "check", "total"];

/// The result; with the surface at the end of the scene, where that was reached.
pub(super) fn summary(scene: &TrackScene, lines: &[&Value], end: Option<&TriMesh>) -> Map<String, Value> {
    let (first, last) = (lines.first(), lines.last());
    let steps = lines.len().saturating_sub(1);
    let of = |line: Option<&&Value>, key: &str| line.map_or(Value::Null, |line| line[key].clone());
    let counts = |key: &str| lines.iter().filter_map(|line| line[key].as_u64()).collect::<Vec<_>>();
    let triangles = counts("triangles");
    let intersections = counts("intersections");
    let sums = |group: &str, keys: &[&str]| {
        let sum = |key: &&str| lines.iter().filter_map(|line| line[group][*key].as_u64()).sum::<u64>();
        Value::Object(keys.iter().map(|key| ((*key).to_owned(), json!(sum(key)))).collect())
    };
    let mean = |key: &&str| {
        let sum = lines.iter().filter_map(|line| line["seconds"][*key].as_f64()).sum::<f64>() + 0.0;
        (steps > 0).then(|| sum / steps as f64)
    };
    let seconds: Map<String, Value> =
        PHASES.iter().map(|key| ((*key).to_owned(), json!(mean(key)))).collect();
    let volume = |line| of(line, "volume").as_f64();
    let relative =
        volume(first).zip(volume(last)).map(|(a, b)| (b - a) / a).filter(|error| error.is_finite());
    let result = json!({
        "steps": steps,
        "time": of(last, "time"),
        "substeps": counts("substeps").iter().sum::<u64>(),
        "triangles": {
            "initial": triangles.first(),
            "min": triangles.iter().min(),
            "max": triangles.iter().max(),
            "final": triangles.last(),
        },
        "volume": { "initial": of(first, "volume"), "final": of(last, "volume"), "relative_error": relative },
        "area": of(last, "area"),
        "components": of(last, "components"),
        "genus": of(last, "genus"),
        "operations": sums("operations", &OPERATIONS),
        "collisions": sums("collisions", &COLLISIONS),
        "intersections": {
            "checked_steps": intersections.len(),
            "max": intersections.iter().max(),
            "final": intersections.last(),
        },
        "seconds_per_step": seconds,
        "error": end.and_then(|end| exact::error(scene, end)).map(|error| error.to_json()),
    });
    let Value::Object(result) = result else { unreachable!("an object was written") };
    result
}
