//! Boxes of elements at rest and in motion: [`Motion`].

use super::BroadPhaseError;
use crate::surface::MovingSurface;
use glam::DVec3;
use welter_meshing::spatial::Box3;
use welter_meshing::surface::{EdgeId, TriId, VertexId};

/// What the vertices of a surface do, for which candidates are asked.
#[derive(Clone, Copy, Debug)]
pub enum Motion<'a> {
    /// They stay where they are: for proximity and intersection.
    Rest,
    /// Each goes on a straight line to its end, by vertex id; those of free ids do not matter. For collision.
    To(&'a [DVec3]),
    /// They are at other places, by vertex id; those of free ids do not matter. To check positions before they are taken.
    At(&'a [DVec3]),
}

/// The boxes of a surface's elements; exact, for the coordinates on a line between two points are between theirs.
#[derive(Clone, Copy)]
pub(super) struct Boxes<'a> {
    surface: &'a MovingSurface,
    motion: Motion<'a>,
}

impl<'a> Boxes<'a> {
    pub(super) fn new(surface: &'a MovingSurface, motion: Motion<'a>) -> Result<Self, BroadPhaseError> {
        if let Motion::To(ends) | Motion::At(ends) = motion {
            let vertices = surface.connectivity().vertex_slots();
            if ends.len() != vertices {
                return Err(BroadPhaseError::Ends { ends: ends.len(), vertices });
            }
        }
        Ok(Self { surface, motion })
    }

    /// Whether all of some vertices end somewhere.
    pub(super) fn check(&self, vertices: impl Iterator<Item = VertexId>) -> Result<(), BroadPhaseError> {
        let (Motion::To(ends) | Motion::At(ends)) = self.motion else { return Ok(()) };
        for vertex in vertices {
            let end = ends[vertex.index()];
            if !end.is_finite() {
                return Err(BroadPhaseError::End { vertex, end });
            }
        }
        Ok(())
    }

    fn of<const N: usize>(&self, vertices: [VertexId; N]) -> Box3 {
        let at_rest = || Box3::of(vertices.map(|v| self.surface.position(v)));
        let at = |places: &[DVec3]| Box3::of(vertices.map(|v| places[v.index()]));
        match self.motion {
            Motion::Rest => at_rest(),
            Motion::To(ends) => at_rest().union(&at(ends)),
            Motion::At(places) => at(places),
        }
    }

    pub(super) fn vertex(&self, v: u32) -> Box3 {
        self.of([VertexId(v)])
    }

    pub(super) fn edge(&self, e: u32) -> Box3 {
        self.of(self.surface.connectivity().ends(EdgeId(e)))
    }

    pub(super) fn triangle(&self, t: u32) -> Box3 {
        self.of(self.surface.connectivity().corners(TriId(t)))
    }
}
