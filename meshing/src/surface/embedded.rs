//! [`EmbeddedMesh`]: a closed oriented mesh that is proven free of self-intersection.
//!
//! # What it promises
//! No two triangles have a point in common besides the vertex or edge that they share by index: decided by exact
//! predicates for all pairs, for every finite `f64`; or known from the way in which the surface was made, where that
//! way has a proof. Parts that only touch are refused as well.
//!
//! # What it does not promise
//! That every edge has two triangles: more may meet at an edge that they share.
//!
//! # Complexity
//! One exact search ([`self_intersections`]): O(n log n + k) for k pairs of triangles whose boxes meet.

use std::fmt;
use std::ops::Deref;

use thiserror::Error;

use super::list;
use super::{ClosedOrientedMesh, TriId, TriMesh};
use crate::spatial::self_intersections;
use crate::{Cancelled, Monitor};

/// A closed oriented mesh without self-intersection.
///
/// ```
/// use welter_meshing::shapes::{BoxPair, Box_, box_, two_boxes};
/// use welter_meshing::surface::{EmbeddedError, EmbeddedMesh};
/// let mesh = EmbeddedMesh::new(box_(&Box_::default())?)?;
/// assert_eq!(mesh.triangles().len() % 12, 0); // derefs to ClosedOrientedMesh and TriMesh
///
/// let Err(EmbeddedError::SelfIntersections(found)) = EmbeddedMesh::new(two_boxes(&BoxPair::overlapping())?) else {
///     panic!("boxes that cross")
/// };
/// assert!(found.pairs.is_sorted());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct EmbeddedMesh(ClosedOrientedMesh);

impl EmbeddedMesh {
    /// Proves that a mesh is embedded and takes it over.
    ///
    /// # Errors
    /// [`EmbeddedError::SelfIntersections`] with every pair. The mesh is dropped then; check first to keep it.
    pub fn new(mesh: ClosedOrientedMesh) -> Result<Self, EmbeddedError> {
        Self::check(&mesh, &Monitor::none())?;
        Ok(Self(mesh))
    }

    /// Whether [`EmbeddedMesh::new`] would accept the mesh.
    ///
    /// # Errors
    /// As [`EmbeddedMesh::new`], and [`EmbeddedError::Cancelled`] by the monitor.
    pub fn check(mesh: &ClosedOrientedMesh, monitor: &Monitor<'_>) -> Result<(), EmbeddedError> {
        let pairs = self_intersections(mesh, monitor)?;
        if pairs.is_empty() {
            Ok(())
        } else {
            Err(EmbeddedError::SelfIntersections(SelfIntersections { pairs }))
        }
    }

    /// Takes over a mesh that is free of self-intersection by its construction.
    pub(crate) fn by_construction(mesh: ClosedOrientedMesh) -> Self {
        Self(mesh)
    }

    /// The mesh without this promise.
    #[must_use]
    pub fn as_closed_oriented(&self) -> &ClosedOrientedMesh {
        &self.0
    }

    /// The mesh without this promise, taken out.
    #[must_use]
    pub fn into_closed_oriented(self) -> ClosedOrientedMesh {
        self.0
    }
}

impl Deref for EmbeddedMesh {
    type Target = ClosedOrientedMesh;
    fn deref(&self) -> &ClosedOrientedMesh {
        &self.0
    }
}

impl AsRef<TriMesh> for EmbeddedMesh {
    fn as_ref(&self) -> &TriMesh {
        self.0.as_mesh()
    }
}

/// The pairs of triangles in which a surface intersects itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SelfIntersections {
    /// All pairs `[i, j]`, `i < j`, sorted; at least one.
    pub pairs: Vec<[TriId; 2]>,
}

impl fmt::Display for SelfIntersections {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let named: Vec<String> =
            self.pairs.iter().take(4).map(|[i, j]| format!("{} and {}", i.0, j.0)).collect();
        let what = if self.pairs.len() == 1 { "pair" } else { "pairs" };
        write!(f, "{} {what} of intersecting triangles: {}", self.pairs.len(), list::FirstFew(&named))
    }
}

/// Why a mesh is not an [`EmbeddedMesh`].
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum EmbeddedError {
    /// Triangles that intersect, all pairs of them.
    #[error("{0}")]
    SelfIntersections(SelfIntersections),
    /// The monitor asked to stop before there was a proof.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
