//! The result of a run, from what was told of its steps: the JSON object of `welter sim`.

use serde_json::{Map, Value, json};

const OPERATIONS: [&str; 7] =
    ["splits", "flips", "collapses", "merges", "separations", "refused", "refused_for_the_budget"];
const PHASES: [&str; 7] =
    ["improvement", "topology", "velocity", "collisions", "compaction", "check", "total"];

/// The result.
pub(super) fn summary(lines: &[&Value]) -> Map<String, Value> {
    let last = lines.last();
    let of = |key: &str| last.map_or(Value::Null, |line| line[key].clone());
    let frames = lines.iter().filter(|line| line["frame"].is_u64()).count();
    let number = |line: &&&Value, key: &str| line[key].as_f64();
    let operations: Map<String, Value> = OPERATIONS
        .iter()
        .map(|key| {
            let sum = lines.iter().filter_map(|line| line["operations"][*key].as_u64()).sum::<u64>();
            ((*key).to_owned(), json!(sum))
        })
        .collect();
    // Of the steps between frames; the initial frame has none.
    let made = frames.saturating_sub(1);
    let seconds: Map<String, Value> = PHASES
        .iter()
        .map(|key| {
            let sum: f64 = lines.iter().filter_map(|line| line["seconds"][*key].as_f64()).sum();
            ((*key).to_owned(), json!((made > 0).then(|| sum / made as f64)))
        })
        .collect();
    let releases = || lines.iter().filter_map(|line| line["releases"].as_array()).flatten();
    let refused = |reason: &str| releases().filter(|release| release["refused"]["reason"] == reason).count();
    let released: f64 = lines.iter().filter_map(|line| number(&line, "released_volume")).sum();
    let volume = of("volume").as_f64();
    let error = volume.map(|volume| (volume - released) / released).filter(|error| error.is_finite());
    let most = lines.iter().filter_map(|line| line["triangles"].as_u64()).max();
    let result = json!({
        "solver": "procedural",
        "frames": frames,
        "steps": lines.len().saturating_sub(1),
        "time": of("time"),
        "elements": { "vertices": of("vertices"), "triangles": of("triangles"), "most_triangles": most },
        "components": of("components"),
        "conserved": { "volume": { "released": released, "final": volume, "relative_error": error } },
        "releases": {
            "made": releases().filter(|release| release["refused"].is_null()).count(),
            "refused": { "intersection": refused("intersection"), "budget": refused("budget") },
        },
        "reference_length": of("reference_length"),
        "operations": operations,
        "seconds_per_frame": seconds,
    });
    let Value::Object(result) = result else { unreachable!("an object was written") };
    result
}
