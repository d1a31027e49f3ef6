//! The result of a run, from what was told of its steps: the JSON object of `welter sim`.

use serde_json::{Map, Value, json};

const OPERATIONS: [&str; 7] =
    ["splits", "flips", "collapses", "merges", "separations", "refused", "refused_for_the_budget"];
const PHASES: [&str; 6] = ["improvement", "topology", "velocity", "collisions", "compaction", "check"];
const RENDERING: [&str; 7] = ["layers", "shadow", "projection", "pixels", "composition", "encoding", "total"];

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
    let sum = |path: &str| lines.iter().filter_map(|line| line.pointer(path)?.as_f64()).sum::<f64>() + 0.0;
    let per_frame = |key: &str| (made > 0).then(|| sum(&format!("/seconds/{key}")) / made as f64);
    let mut seconds: Map<String, Value> =
        PHASES.iter().map(|key| ((*key).to_owned(), json!(per_frame(key)))).collect();
    let drawn = lines.iter().filter(|line| line["pictures"].is_object()).count();
    let per_picture = |key: &str| sum(&format!("/seconds/rendering/{key}")) / drawn as f64;
    let rendering = (drawn > 0).then(|| {
        let stages = RENDERING.iter().map(|key| ((*key).to_owned(), json!(per_picture(key))));
        json!({
            "frames": drawn,
            "seconds_per_picture": stages.collect::<Map<_, _>>(),
            "crossings": lines.iter().filter_map(|line| line["pictures"]["crossings"].as_u64()).sum::<u64>(),
        })
    });
    // Pictures are shared out to all frames, those without one too, so that the parts add up.
    let rendered = (drawn > 0 && frames > 0).then(|| sum("/seconds/rendering/total") / frames as f64);
    let simulated = per_frame("total");
    seconds.insert("simulation".into(), json!(simulated));
    seconds.insert("rendering".into(), json!(rendered));
    let total = simulated.map(|simulated| simulated + rendered.unwrap_or(0.0)).or(rendered);
    seconds.insert("total".into(), json!(total));
    let releases = || lines.iter().filter_map(|line| line["releases"].as_array()).flatten();
    let refused = |reason: &str| releases().filter(|release| release["refused"]["reason"] == reason).count();
    let united = |outcome: &str| releases().filter(|release| release["union"]["outcome"] == outcome).count();
    let shifted = releases().filter(|release| release["union"]["shifts"].as_u64() > Some(0)).count();
    let released = lines.iter().filter_map(|line| number(&line, "released_volume")).sum::<f64>() + 0.0;
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
            "united": {
                "joined": united("joined"), "within": united("within"), "shifted": shifted,
            },
            "refused": {
                "intersection": refused("intersection"), "budget": refused("budget"), "sheet": refused("sheet"),
                "inside_out": refused("inside out"), "degenerate": refused("degenerate"),
            },
        },
        "reference_length": of("reference_length"),
        "operations": operations,
        "seconds_per_frame": seconds,
        "rendering": rendering,
    });
    let Value::Object(result) = result else { unreachable!("an object was written") };
    result
}
