//! The report of a run of `welter sim`, made again.

use super::scene::SimScene;
use super::simulation::Smoke;
use crate::failure::Failure;
use crate::run::Run;
use crate::runs::PastRun;
use crate::scene::Scene;
use serde_json::{Map, Value};
use std::path::Path;

/// Writes the report; gives the result.
pub(crate) fn report(folder: &Path, past: &PastRun, run: &Run) -> Result<Map<String, Value>, Box<Failure>> {
    let (scene, _) = SimScene::read(&Scene::of(folder, past.state.scene.as_str()), 0)?;
    let smoke = Smoke::resumed(&scene, String::new(), &past.state.state, &run.console.progress)?;
    past.report(&smoke)
}
