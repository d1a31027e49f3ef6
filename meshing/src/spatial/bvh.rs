//! [`Bvh`]: a bounding volume hierarchy over the triangles of a mesh.
//!
//! # What it promises
//! * Every query answers about the mesh's `f64` coordinates; the hierarchy only leaves out what cannot matter. So answers
//!   depend neither on the shape of the tree, nor on a refit instead of a build, nor on the number of threads.
//! * Box queries are exact about boxes or, by predicates, about triangles; ray queries and self-intersections are exact by predicates;
//!   the closest point is a construction with a stated bound.
//!
//! # What it does not promise
//! See [`BoxTree`].
//!
//! # Complexity
//! Build O(n log n), refit O(n), O(log n + k) a query in practice.

use welter_predicates::intersection::triangle_intersects_box;

use super::descent::{Met, sort_pairs};
use super::{Box3, BoxTree};
use crate::surface::{TriId, TriMesh};
use crate::{Cancelled, Monitor};

/// The tree of another number of boxes was offered for a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a hierarchy of {boxes} boxes cannot be refitted to a mesh of {triangles} triangles")]
pub struct RefitError {
    /// Boxes of the tree.
    pub boxes: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
}

/// A hierarchy over the triangles of a mesh that it borrows.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, spatial::Bvh, surface::{TriId, TriMesh, TriangleSoup}};
/// let positions = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [1., 1., 0.]].map(DVec3::from_array).to_vec();
/// let soup = TriangleSoup { positions, triangles: vec![[0, 1, 2], [3, 2, 1]], ..Default::default() };
/// let mesh = TriMesh::new(soup).expect("finite and in range");
/// let bvh = Bvh::new(&mesh);
/// assert_eq!(bvh.self_pairs(&Monitor::none()), Ok(vec![[TriId(0), TriId(1)]]));
/// ```
#[derive(Clone, Debug)]
pub struct Bvh<'m> {
    mesh: &'m TriMesh,
    tree: BoxTree,
}

impl<'m> Bvh<'m> {
    /// Builds the hierarchy over the triangles of `mesh`.
    #[must_use]
    pub fn new(mesh: &'m TriMesh) -> Self {
        Self { mesh, tree: BoxTree::over(mesh.triangles().len(), |i| triangle_box(mesh, i)) }
    }

    /// Takes the tree of an earlier hierarchy and refits it to `mesh`, whose vertices have moved.
    ///
    /// # Errors
    /// [`RefitError`] if the mesh has not as many triangles as the tree has boxes.
    pub fn refitted(mut tree: BoxTree, mesh: &'m TriMesh) -> Result<Self, RefitError> {
        let triangles = mesh.triangles().len();
        if tree.len() != triangles {
            return Err(RefitError { boxes: tree.len(), triangles });
        }
        tree.refit_over(|i| triangle_box(mesh, i));
        Ok(Self { mesh, tree })
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &'m TriMesh {
        self.mesh
    }

    /// The tree over the triangles' boxes.
    #[must_use]
    pub fn tree(&self) -> &BoxTree {
        &self.tree
    }

    /// Gives up the mesh and keeps the tree, for [`Bvh::refitted`] once the vertices have moved.
    #[must_use]
    pub fn into_tree(self) -> BoxTree {
        self.tree
    }

    /// The box of a triangle.
    #[inline]
    #[must_use]
    pub fn triangle_box(&self, triangle: TriId) -> Box3 {
        triangle_box(self.mesh, triangle.index())
    }

    /// All pairs `[i, j]`, `i < j`, of triangles whose closed boxes meet, sorted. Exact about boxes.
    ///
    /// # Errors
    /// [`Cancelled`] by the monitor.
    pub fn self_pairs(&self, monitor: &Monitor<'_>) -> Result<Vec<[TriId; 2]>, Cancelled> {
        let visit = |i: u32, j: u32, met: Met, out: &mut Vec<[TriId; 2]>| {
            let [i, j] = [TriId(i.min(j)), TriId(i.max(j))];
            if met == Met::Surely || self.triangle_box(i).meets(&self.triangle_box(j)) {
                out.push([i, j]);
            }
        };
        sorted(super::descent::self_pairs(&self.tree, monitor, "pairs of boxes", visit))
    }

    /// All pairs `[i, j]` of a triangle `i` of this mesh and a triangle `j` of the other whose closed boxes meet, sorted.
    /// Exact about boxes.
    ///
    /// # Errors
    /// [`Cancelled`] by the monitor.
    pub fn pairs_with(&self, other: &Bvh<'_>, monitor: &Monitor<'_>) -> Result<Vec<[TriId; 2]>, Cancelled> {
        let tree = other.tree.in_frame(self.tree.frame, |i| triangle_box(other.mesh, i));
        let visit = |i: u32, j: u32, met: Met, out: &mut Vec<[TriId; 2]>| {
            if met == Met::Surely || self.triangle_box(TriId(i)).meets(&other.triangle_box(TriId(j))) {
                out.push([TriId(i), TriId(j)]);
            }
        };
        sorted(super::descent::pairs_between(&self.tree, &tree, monitor, "pairs of boxes", visit))
    }

    /// The triangles whose closed boxes meet `query`, ascending. Exact about boxes; a triangle in the list may pass by.
    #[must_use]
    pub fn boxes_meeting(&self, query: &Box3) -> Vec<TriId> {
        let mut found = Vec::new();
        self.tree.visit_meeting(query, |i| {
            if self.triangle_box(TriId(i)).meets(query) {
                found.push(TriId(i));
            }
        });
        found.sort_unstable();
        found
    }

    /// The triangles that meet the closed box `query`, ascending. Exact, by predicates.
    #[must_use]
    pub fn triangles_meeting(&self, query: &Box3) -> Vec<TriId> {
        let mut found = self.boxes_meeting(query);
        found.retain(|&t| triangle_intersects_box(self.mesh.corners(t), query.min, query.max));
        found
    }
}

#[inline]
fn triangle_box(mesh: &TriMesh, triangle: usize) -> Box3 {
    Box3::of(mesh.corners(TriId(triangle as u32)))
}

fn sorted(found: Result<Vec<[TriId; 2]>, Cancelled>) -> Result<Vec<[TriId; 2]>, Cancelled> {
    let mut found = found?;
    sort_pairs(&mut found, |t| t.0);
    Ok(found)
}
