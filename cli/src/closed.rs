//! Surfaces that must bound a volume: from the soup of a file to a closed, oriented mesh, or why it is none.

use crate::codes::Code;
use crate::commands::check::failures_of;
use crate::failure::{Failure, shell_word};
use std::path::Path;
use welter_meshing::surface::{ClosedOrientedError, ClosedOrientedMesh, TriMesh, TriangleSoup};

/// The surface of a file as one that has an inside.
pub(crate) fn closed_oriented(soup: TriangleSoup, name: &Path) -> Result<ClosedOrientedMesh, Box<Failure>> {
    let mesh = TriMesh::new(soup).map_err(|error| failures_of(&error, name).swap_remove(0))?;
    ClosedOrientedMesh::new(mesh).map_err(|error| not_closed(&error, name))
}

fn not_closed(error: &ClosedOrientedError, name: &Path) -> Box<Failure> {
    let code = match error {
        ClosedOrientedError::Defects(found) if found.boundary.is_empty() => Code::NotOriented,
        _ => Code::NotClosed,
    };
    let failure = Failure::new(code, error.to_string())
        .subject(name.display().to_string())
        .why("inside and outside are known only for a closed, oriented surface")
        .help(format!(
            "welter check {} --save-bad bad.ply   # then: welter render bad.ply -o bad.png",
            shell_word(name)
        ));
    match error {
        ClosedOrientedError::Defects(found) => {
            found.iter().fold(failure, |failure, edge| failure.place(format!("edge of vertices {edge}")))
        }
        _ => failure,
    }
}
