//! [`Surface`]: what is there to be seen after the cut, in view coordinates.

use super::camera::View;
use super::clip::{self, Plane};
use super::model::Model;
use super::scene::Cut;
use glam::DVec3;
use rayon::prelude::*;

/// Part of a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) corners: [DVec3; 3],
    /// The triangle it is a part of.
    pub(super) source: u32,
}

/// Whole triangles and pieces of triangles.
pub(super) struct Surface {
    /// Vertices in view coordinates.
    pub(super) positions: Vec<DVec3>,
    /// Triangles that are whole.
    pub(super) whole: Vec<u32>,
    /// Pieces of those that the cut went through.
    pub(super) pieces: Vec<Piece>,
}

impl Surface {
    /// The model seen from the view, without what the cut removes.
    pub(super) fn of(model: &Model, view: &View, cut: Option<Cut>) -> Self {
        let positions: Vec<DVec3> = model.positions.par_iter().map(|&p| view.of_model(p)).collect();
        let count = model.triangles.len() as u32;
        let Some(cut) = cut else {
            return Self { positions, whole: (0..count).collect(), pieces: Vec::new() };
        };
        // The plane at unit size; the side without the eye is kept.
        let value = model.frame.coordinate(cut.axis, cut.value);
        let side = if view.eye[cut.axis] > value { -1.0 } else { 1.0 };
        let mut normal = DVec3::ZERO;
        normal[cut.axis] = side;
        let in_view = DVec3::new(view.right.dot(normal), view.above.dot(normal), view.toward.dot(normal));
        let plane: Plane = in_view.extend(side * (view.eye[cut.axis] - value));
        // Decided in model coordinates, so that axis-aligned faces on the plane are judged alike.
        let inside: Vec<bool> =
            model.positions.par_iter().map(|p| side * (p[cut.axis] - value) >= 0.0).collect();
        let mut surface = Self { positions, whole: Vec::new(), pieces: Vec::new() };
        for t in 0..count {
            match model.corners(&inside, t) {
                [true, true, true] => surface.whole.push(t),
                [false, false, false] => {}
                _ => clip::clip(model.corners(&surface.positions, t), &[plane], |corners| {
                    surface.pieces.push(Piece { corners, source: t });
                }),
            }
        }
        surface
    }
}
