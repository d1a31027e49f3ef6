//! What is told of a step of the tracker that failed: stage, place, and everything needed to ask again.

use super::scene::TimeSpec;
use crate::codes::Code;
use crate::failure::Failure;
use crate::numbers::{number, point};
use crate::runs::StepFailure;
use glam::DVec3;
use serde_json::{Value, json};
use welter_meshing::surface::{TriId, TriMesh};
use welter_tracking::flows::FlowError;
use welter_tracking::integration::{IntegrationError, Tangle};
use welter_tracking::tracker::TrackerError;

/// Pairs of triangles that are listed; all are counted.
const LISTED: usize = 1000;

/// A step that the tracker refuses.
pub(crate) fn tracker_failure(error: &TrackerError) -> StepFailure {
    let stopped = |stage, details| {
        let failure = Failure::new(Code::StepFailed, error.to_string());
        StepFailure { failure: place(failure, error), stage, details }
    };
    match error {
        TrackerError::Flow(flow) => stopped("velocity", flow_details(flow)),
        TrackerError::Integration(found) => match found {
            IntegrationError::NotEmbedded { pairs, first }
            | IntegrationError::Intersection { pairs, first } => {
                // The tracker promises that this cannot be.
                let failure = place(Failure::new(Code::OwnBug, error.to_string()), error);
                StepFailure { failure, stage: "integration", details: tangle_details(pairs, first) }
            }
            _ => stopped("integration", Value::Null),
        },
        _ => stopped("step", Value::Null),
    }
}

/// A surface that intersects itself after a step: the tracker promises that this cannot be.
pub(super) fn intersecting(mesh: &TriMesh, pairs: &[[TriId; 2]], first: [TriId; 2]) -> StepFailure {
    let what = format!(
        "the surface intersects itself: {} pairs of triangles, the first {} and {}",
        pairs.len(),
        first[0].0,
        first[1].0
    );
    let corners = first.map(|t| mesh.triangles()[t.index()]);
    let positions = corners.map(|corners| corners.map(|v| mesh.positions()[v.index()]));
    let tangle = Tangle { triangles: first, corners, before: positions, after: positions };
    let mut failure = Failure::new(Code::OwnBug, what);
    for (triangle, positions) in first.iter().zip(&positions) {
        failure = failure.place(format!("triangle {} at {}", triangle.0, positions.map(point).join(", ")));
    }
    StepFailure { failure, stage: "verification", details: tangle_details(pairs, &tangle) }
}

/// Time that does not go on.
pub(super) fn stuck(time: &TimeSpec, left: f64, least: f64) -> StepFailure {
    let what = format!(
        "after {} parts {} of the step is left: the flow or collisions allow no longer parts",
        time.most_substeps,
        number(left / time.step)
    );
    let failure = Failure::new(Code::StepFailed, what).place(format!("shortest part: {}", number(least)));
    let details = json!({ "parts": time.most_substeps, "left": left, "shortest_part": least });
    StepFailure { failure, stage: "time", details }
}

/// A surface that no tracker takes.
pub(super) fn refused_at_the_start(error: &TrackerError) -> Box<Failure> {
    match error {
        TrackerError::Integration(
            IntegrationError::NotEmbedded { .. } | IntegrationError::Intersection { .. },
        ) => place(Failure::new(Code::SelfIntersecting, error.to_string()), error)
            .why("only a surface that does not intersect itself can be kept so")
            .help("welter check FILE --pairs   # tells every pair"),
        _ => Failure::new(Code::BadValue, error.to_string()).help("welter track --help"),
    }
}

/// Adds where it happened.
fn place(mut failure: Box<Failure>, error: &TrackerError) -> Box<Failure> {
    match error {
        TrackerError::Integration(
            IntegrationError::NotEmbedded { first, .. } | IntegrationError::Intersection { first, .. },
        ) => {
            for k in 0..2 {
                let corners = first.after[k].map(point).join(", ");
                failure = failure.place(format!("triangle {} at {corners}", first.triangles[k].0));
            }
            failure
        }
        TrackerError::Flow(FlowError::Velocity { vertex, position, .. }) => {
            failure.place(format!("vertex {} at {}", vertex.0, point(*position)))
        }
        TrackerError::Flow(FlowError::End { vertex, start, .. }) => {
            failure.place(format!("vertex {} at {}", vertex.0, point(*start)))
        }
        _ => failure,
    }
}

fn flow_details(error: &FlowError) -> Value {
    let array = |p: DVec3| json!(p.to_array());
    match *error {
        FlowError::Velocity { vertex, position, time, velocity } => json!({
            "vertex": vertex.0, "position": array(position), "time": time, "velocity": array(velocity),
        }),
        FlowError::Speed { triangle, position, time, .. } => {
            json!({ "triangle": triangle.0, "position": array(position), "time": time })
        }
        FlowError::End { vertex, start, .. } => json!({ "vertex": vertex.0, "position": array(start) }),
        _ => Value::Null,
    }
}

fn tangle_details(pairs: &[[TriId; 2]], first: &Tangle) -> Value {
    let points = |both: &[[DVec3; 3]; 2]| json!(both.map(|corners| corners.map(|p| p.to_array())));
    json!({
        "pair_count": pairs.len(),
        "pairs": pairs.iter().take(LISTED).map(|pair| pair.map(|t| t.0)).collect::<Vec<_>>(),
        "first": {
            "triangles": first.triangles.map(|t| t.0),
            "corners": first.corners.map(|corners| corners.map(|v| v.0)),
            "before": points(&first.before),
            "after": points(&first.after),
        },
    })
}
