//! The report of a run of `welter track`, made again.

use super::scene::TrackScene;
use super::simulation::Track;
use crate::codes::Code;
use crate::failure::Failure;
use crate::runs::PastRun;
use crate::scene::Scene;
use serde_json::{Map, Value};
use std::path::Path;

/// Writes the report; gives the result.
pub(crate) fn report(folder: &Path, past: &PastRun) -> Result<Map<String, Value>, Box<Failure>> {
    let scene = TrackScene::read_resolved(&Scene::of(folder, past.state.scene.as_str()))?;
    let track = Track::resumed(&scene, String::new(), &past.state.state).map_err(|error| {
        Failure::new(Code::NoRunFile, format!("its newest checkpoint is none of a surface: {error}"))
            .subject(folder.display().to_string())
            .help("--resume goes on with the run where it can")
    })?;
    past.report(&track)
}
