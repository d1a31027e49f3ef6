//! What a union did: [`UnionReport`].

use glam::DVec3;

/// What became of the shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum UnionOutcome {
    /// It lay apart from the surface, whole: it was added beside it.
    Beside,
    /// It lay within the surface, whole: nothing was changed.
    Within,
    /// It crossed the surface, or took in parts of it, or parts of it lay within.
    Joined,
}

/// What a union did.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct UnionReport {
    /// What became of the shape.
    pub outcome: UnionOutcome,
    /// How often the shape was shifted before it met the surface in general position.
    pub shifts: u32,
    /// By how much the shape was shifted in the end.
    pub shift: DVec3,
    /// Of how many segments the curves are along which both cross.
    pub segments: usize,
    /// How many triangles of the surface went, whole or cut.
    pub removed_triangles: usize,
    /// How many triangles came, of the shape or as parts of cut ones.
    pub new_triangles: usize,
    /// How many vertices came.
    pub new_vertices: usize,
    /// By how much the volume inside grew. Infinite or not a number where volumes are beyond the range of numbers.
    pub added_volume: f64,
}
