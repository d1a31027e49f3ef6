//! The exact list of the triangle pairs in which a mesh intersects itself: [`self_intersections`].
//!
//! # What it promises
//! * Exactly the pairs `[i, j]`, `i < j`, whose closed triangles have a common point outside of the vertex or edge that
//!   they share, whatever the finite coordinates; degenerate triangles are the segments or points they are. What counts
//!   as shared is [`Sharing`]; two triangles with three shared corners always count.
//! * Sorted; the same for any number of threads.
//! * A cancelled search returns no list.
//!
//! # What it does not promise
//! The curves of intersection. Nor a bound on the number of pairs: n coincident triangles give n(n - 1)/2.
//!
//! # Method
//! Candidates are the pairs of leaves of a [`Bvh`] whose boxes meet; each is decided by the predicates on its corners
//! (`triangle_pair`).
//!
//! # Complexity
//! O(n log n + k) for k pairs of triangles whose boxes meet.

use glam::DVec3;
use rayon::prelude::*;

use super::{Bvh, descent, triangle_pair::meet_in_more};
use crate::surface::{TriId, TriMesh, VertexId};
use crate::{Cancelled, Monitor};

/// Which corners of two triangles are the same vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Sharing {
    /// Those with the same index. Parts of a mesh that touch at different vertices in one place meet there: the rule for
    /// surfaces that move.
    #[default]
    Index,
    /// Those at the same position. Parts of a mesh that touch at vertices or along edges that coincide exactly do not meet
    /// by that alone: the rule for files whose vertices are not welded.
    Position,
}

/// The sorted list of all pairs `[i, j]`, `i < j`, of triangles whose intersection is more than the vertex or edge they
/// share by index; pairs that share all three vertices always count.
///
/// # Errors
/// [`Cancelled`] by the monitor.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, spatial::self_intersections, surface::{TriId, TriMesh, TriangleSoup}};
/// // The second triangle pierces the first.
/// let positions = [[0., 0., 0.], [4., 0., 0.], [0., 4., 0.], [1., 1., -1.], [1., 1., 1.], [9., 9., 0.]];
/// let soup = TriangleSoup {
///     positions: positions.map(DVec3::from_array).to_vec(),
///     triangles: vec![[0, 1, 2], [3, 4, 5]],
///     ..Default::default()
/// };
/// let mesh = TriMesh::new(soup).expect("finite and in range");
/// assert_eq!(self_intersections(&mesh, &Monitor::none()), Ok(vec![[TriId(0), TriId(1)]]));
/// ```
pub fn self_intersections(mesh: &TriMesh, monitor: &Monitor<'_>) -> Result<Vec<[TriId; 2]>, Cancelled> {
    monitor.stage("building the hierarchy", 0);
    Bvh::new(mesh).self_intersections(Sharing::Index, monitor)
}

impl Bvh<'_> {
    /// The sorted list of all pairs `[i, j]`, `i < j`, of triangles whose intersection is more than the vertex or edge
    /// they share; pairs that share all three vertices always count.
    ///
    /// # Errors
    /// [`Cancelled`] by the monitor.
    ///
    /// ```
    /// use welter_meshing::{DVec3, Monitor, surface::{TriMesh, TriangleSoup}};
    /// use welter_meshing::spatial::{Bvh, Sharing};
    /// // Two triangles along one edge, whose vertices are not welded.
    /// let positions = [[0., 0., 0.], [4., 0., 0.], [0., 4., 0.], [4., 0., 0.], [0., 4., 0.], [4., 4., 0.]];
    /// let soup = TriangleSoup {
    ///     positions: positions.map(DVec3::from_array).to_vec(),
    ///     triangles: vec![[0, 1, 2], [3, 5, 4]],
    ///     ..Default::default()
    /// };
    /// let mesh = TriMesh::new(soup).expect("finite and in range");
    /// let bvh = Bvh::new(&mesh);
    /// assert_eq!(bvh.self_intersections(Sharing::Index, &Monitor::none()).map(|pairs| pairs.len()), Ok(1));
    /// assert_eq!(bvh.self_intersections(Sharing::Position, &Monitor::none()).map(|pairs| pairs.len()), Ok(0));
    /// ```
    pub fn self_intersections(
        &self,
        sharing: Sharing,
        monitor: &Monitor<'_>,
    ) -> Result<Vec<[TriId; 2]>, Cancelled> {
        let positions = self.mesh().positions();
        let renamed: Vec<[VertexId; 3]>;
        let corners = match sharing {
            Sharing::Index => self.mesh().triangles(),
            Sharing::Position => {
                let first = first_at_position(positions);
                renamed = self.mesh().triangles().iter().map(|t| t.map(|v| first[v.index()])).collect();
                &renamed
            }
        };
        let mut pairs = descent::self_pairs(
            self.tree(),
            monitor,
            "intersecting triangle pairs",
            |i, j, _, found: &mut Vec<[TriId; 2]>| {
                let (i, j) = (i.min(j), i.max(j));
                if meet_in_more(|v| positions[v.index()], corners[i as usize], corners[j as usize]) {
                    found.push([TriId(i), TriId(j)]);
                }
            },
        )?;
        descent::sort_pairs(&mut pairs, |t| t.0);
        Ok(pairs)
    }
}

/// For each vertex the first vertex at its position.
fn first_at_position(positions: &[DVec3]) -> Vec<VertexId> {
    // Adding zero makes both zeros one.
    let key = |v: u32| positions[v as usize].to_array().map(|x| (x + 0.0).to_bits());
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.par_sort_unstable_by_key(|&v| (key(v), v));
    let mut first: Vec<VertexId> = (0..positions.len() as u32).map(VertexId).collect();
    for same in order.chunk_by(|&u, &v| key(u) == key(v)) {
        same.iter().for_each(|&v| first[v as usize] = VertexId(same[0]));
    }
    first
}
