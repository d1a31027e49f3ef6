//! Meshes that are added to a surface: [`MovingSurface::append`].
//!
//! Promise: what was there keeps its values, and its ids but for gaps; the result is that of a surface made of both meshes at once.

use std::ops::Range;

use thiserror::Error;
use welter_meshing::surface::{EdgeId, TriId, TriMesh, VertexId};

use super::attributes::transfer::Transfer;
use super::connectivity::RadialConnectivity;
use super::{EdgeChange, EventKind, MovingSurface, SurfaceDefects, TriangleChange, VertexChange};

/// The most half-edges of a surface: they are numbered with 32 bits, and one number is for none.
pub(super) const MOST_HALF_EDGES: usize = u32::MAX as usize;

/// Why a mesh is not added.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum AppendError {
    /// The mesh is not admissible.
    #[error(transparent)]
    Defects(#[from] SurfaceDefects),
    /// There would be more elements than can be numbered.
    #[error(
        "there would be {vertices} vertices and {triangles} triangles, more than are numbered with 32 bits"
    )]
    TooMany {
        /// How many vertices.
        vertices: usize,
        /// How many triangles.
        triangles: usize,
    },
}

impl MovingSurface {
    /// Adds a mesh beside what is there. It shares nothing with it: its vertices get the ids that are returned, unit masses and
    /// values of attributes as elements that come from nothing (zero, or what a custom rule says). Vertices without
    /// triangles are left out. The surface is compacted first; linear in the number of all elements.
    ///
    /// ```
    /// use welter_meshing::shapes;
    /// use welter_tracking::surface::{MovingSurface, Rule};
    ///
    /// let sphere = shapes::sphere(&shapes::Sphere { edge_length: 0.5, ..Default::default() })?;
    /// let mut surface = MovingSurface::new(&sphere)?;
    /// let count = surface.positions().len();
    /// let age = surface.vertex_attributes_mut().add("age", vec![2.0; count], Rule::Interpolate)?;
    /// let added = surface.append(&sphere)?;
    /// assert_eq!(added, count as u32..2 * count as u32);
    /// let ages = surface.vertex_attributes().values(age);
    /// assert_eq!((ages[0], ages[count]), (2.0, 0.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`AppendError`]; the surface is as it was then.
    pub fn append(&mut self, mesh: &TriMesh) -> Result<Range<u32>, AppendError> {
        let other = RadialConnectivity::new(mesh)?;
        let vertices = self.connectivity.vertex_count() + other.vertex_count();
        let triangles = self.connectivity.triangle_count() + other.triangle_count();
        if triangles > MOST_HALF_EDGES / 3 || vertices >= u32::MAX as usize {
            return Err(AppendError::TooMany { vertices, triangles });
        }
        let _ = self.compact();
        let [v, e, t] =
            [self.positions.len(), self.connectivity.edge_slots(), self.connectivity.triangle_slots()];
        let mut new = vec![VertexId(u32::MAX); mesh.positions().len()];
        for (i, old) in (v..).zip(other.vertices()) {
            new[old.index()] = VertexId::from_index(i);
            self.positions.push(mesh.positions()[old.index()]);
        }
        let mut corners: Vec<[VertexId; 3]> =
            self.connectivity.triangles().map(|t| self.connectivity.corners(t)).collect();
        corners.extend(mesh.triangles().iter().map(|corners| corners.map(|v| new[v.index()])));
        // Edges ascend by their vertices, so those that were there keep their ids.
        self.connectivity = RadialConnectivity::canonical(vertices, corners);
        self.masses.resize(vertices, 1.0);
        let edges = self.connectivity.edge_slots();
        let births = |from: usize, to: usize| {
            let births = (from as u32..to as u32).collect();
            Transfer { births, ..Transfer::default() }
        };
        self.vertex_attributes.transfer(&births(v, vertices), vertices);
        self.edge_attributes.transfer(&births(e, edges), edges);
        self.triangle_attributes.transfer(&births(t, triangles), triangles);
        self.revision += 1;
        let mesh = &self.connectivity;
        let ids = |from: usize, to: usize| from as u32..to as u32;
        self.log.push(
            EventKind::Append,
            ids(v, vertices).map(|v| VertexChange { vertex: VertexId(v), born: true }),
            ids(e, edges).map(EdgeId).map(|edge| EdgeChange { edge, ends: mesh.ends(edge), born: true }),
            ids(t, triangles).map(TriId).map(|triangle| TriangleChange {
                triangle,
                before: None,
                after: Some(mesh.corners(triangle)),
            }),
        );
        Ok(ids(v, vertices))
    }
}
