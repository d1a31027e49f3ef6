//! [`TriMesh`]: triangles whose positions are finite and whose indices can be followed.
//!
//! Promises: every position is finite; every index is in range; the three indices of a triangle differ; fewer than
//! 2^32 vertices and fewer than 2^32 half-edges, so that vertices, triangles, edges and half-edges all have 32-bit
//! ids; groups are ascending, disjoint runs of triangles; there is one colour a triangle or none at all.
//!
//! Does not promise: that triangles have area, that positions differ, that the surface is closed, oriented or free
//! of self-intersection, or that every vertex is used.
//!
//! Method: one pass over the arrays. Complexity: linear, nothing is allocated unless there is a defect.

use super::list;
use super::{Group, TriId, TriangleSoup, VertexId};
use glam::DVec3;
use std::fmt;
use thiserror::Error;

/// Most vertices of a mesh: ids are 32-bit and `u32::MAX` stays free.
pub const MAX_VERTICES: usize = u32::MAX as usize;

/// Most triangles of a mesh: half-edges (three a triangle) have 32-bit ids too.
pub const MAX_TRIANGLES: usize = u32::MAX as usize / 3;

/// Finite positions, indices in range, no repeated index in a triangle.
///
/// ```
/// use welter_meshing::{DVec3, surface::{TriMesh, TriangleSoup, TriMeshError, VertexId}};
/// let mut soup = TriangleSoup {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
///     triangles: vec![[0, 1, 2]],
///     ..TriangleSoup::default()
/// };
/// assert_eq!(TriMesh::new(soup.clone())?.triangles(), [[VertexId(0), VertexId(1), VertexId(2)]]);
///
/// soup.positions[1].z = f64::NAN;
/// let Err(TriMeshError::Defects(defects)) = TriMesh::new(soup) else { panic!() };
/// assert_eq!(defects.non_finite_vertices[0].vertex, VertexId(1));
/// # Ok::<(), TriMeshError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TriMesh {
    positions: Vec<DVec3>,
    triangles: Vec<[VertexId; 3]>,
    groups: Vec<Group>,
    triangle_colors: Vec<[u8; 3]>,
}

impl TriMesh {
    /// Checks a soup and takes it over, without a copy.
    ///
    /// # Errors
    /// As [`TriMesh::check`]. The soup is dropped then; check first to keep it.
    pub fn new(soup: TriangleSoup) -> Result<Self, TriMeshError> {
        Self::check(&soup)?;
        let TriangleSoup { positions, triangles, groups, triangle_colors } = soup;
        let triangles = triangles.into_iter().map(|t| t.map(VertexId)).collect();
        Ok(Self { positions, triangles, groups, triangle_colors })
    }

    /// Whether [`TriMesh::new`] would accept the soup.
    ///
    /// # Errors
    /// [`TriMeshError`] with every defect, each with its ids and values.
    pub fn check(soup: &TriangleSoup) -> Result<(), TriMeshError> {
        let vertices = soup.positions.len();
        let triangles = soup.triangles.len();
        if vertices > MAX_VERTICES {
            return Err(TriMeshError::TooManyVertices { count: vertices });
        }
        if triangles > MAX_TRIANGLES {
            return Err(TriMeshError::TooManyTriangles { count: triangles });
        }
        let mut defects = TriMeshDefects::default();
        for (i, &position) in soup.positions.iter().enumerate() {
            if !position.is_finite() {
                defects
                    .non_finite_vertices
                    .push(NonFiniteVertex { vertex: VertexId::from_index(i), position });
            }
        }
        for (i, &indices) in soup.triangles.iter().enumerate() {
            let triangle = TriId::from_index(i);
            let [a, b, c] = indices;
            if indices.iter().any(|&v| v as usize >= vertices) {
                defects.indices_out_of_range.push(TriangleIndices { triangle, indices });
            }
            if a == b || b == c || c == a {
                defects.repeated_indices.push(TriangleIndices { triangle, indices });
            }
        }
        let mut free = 0;
        for (i, group) in soup.groups.iter().enumerate() {
            let range = &group.triangles;
            if range.start < free || range.end < range.start || range.end as usize > triangles {
                defects.groups_out_of_order.push(i);
            } else {
                free = range.end;
            }
        }
        let colors = soup.triangle_colors.len();
        if colors != 0 && colors != triangles {
            defects.color_count = Some(colors);
        }
        if defects.is_empty() { Ok(()) } else { Err(TriMeshError::Defects(Box::new(defects))) }
    }

    /// The content as a soup again, without a copy.
    #[must_use]
    pub fn into_soup(self) -> TriangleSoup {
        TriangleSoup {
            positions: self.positions,
            triangles: self.triangles.into_iter().map(|t| t.map(|v| v.0)).collect(),
            groups: self.groups,
            triangle_colors: self.triangle_colors,
        }
    }

    /// A copy of the content as a soup.
    #[must_use]
    pub fn to_soup(&self) -> TriangleSoup {
        self.clone().into_soup()
    }

    /// Vertex positions.
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The corners of each triangle.
    #[must_use]
    pub fn triangles(&self) -> &[[VertexId; 3]] {
        &self.triangles
    }

    /// Named runs of triangles, ascending and disjoint.
    #[must_use]
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// One colour (red, green, blue) a triangle, or empty.
    #[must_use]
    pub fn triangle_colors(&self) -> &[[u8; 3]] {
        &self.triangle_colors
    }

    /// The positions of a triangle's corners.
    ///
    /// # Panics
    /// If the triangle is not one of this mesh.
    #[must_use]
    pub fn corners(&self, triangle: TriId) -> [DVec3; 3] {
        self.triangles[triangle.index()].map(|v| self.positions[v.index()])
    }

    /// The same surface seen from its other side: every triangle's orientation reversed.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        for triangle in &mut self.triangles {
            triangle.swap(1, 2);
        }
        self
    }
}

/// A vertex with an infinite coordinate or one that is not a number.
#[derive(Clone, Copy, Debug)]
pub struct NonFiniteVertex {
    /// Which vertex.
    pub vertex: VertexId,
    /// Its position as given.
    pub position: DVec3,
}

impl fmt::Display for NonFiniteVertex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DVec3 { x, y, z } = self.position;
        write!(f, "{} ({x}, {y}, {z})", self.vertex.0)
    }
}

/// A triangle and its vertex indices as given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TriangleIndices {
    /// Which triangle.
    pub triangle: TriId,
    /// Its three vertex indices.
    pub indices: [u32; 3],
}

impl fmt::Display for TriangleIndices {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b, c] = self.indices;
        write!(f, "{} ({a}, {b}, {c})", self.triangle.0)
    }
}

/// Everything that keeps a soup from being a [`TriMesh`], each list in ascending order.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct TriMeshDefects {
    /// Vertices with an infinite coordinate or one that is not a number.
    pub non_finite_vertices: Vec<NonFiniteVertex>,
    /// Triangles with an index that is not that of a vertex.
    pub indices_out_of_range: Vec<TriangleIndices>,
    /// Triangles that name a vertex twice.
    pub repeated_indices: Vec<TriangleIndices>,
    /// Groups (by their place in the list) whose run of triangles is reversed, out of range, or begins before the
    /// end of an earlier one.
    pub groups_out_of_order: Vec<usize>,
    /// The number of triangle colours, where it is neither none nor one a triangle.
    pub color_count: Option<usize>,
}

impl TriMeshDefects {
    /// True when there is no defect.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.non_finite_vertices.is_empty()
            && self.indices_out_of_range.is_empty()
            && self.repeated_indices.is_empty()
            && self.groups_out_of_order.is_empty()
            && self.color_count.is_none()
    }
}

impl fmt::Display for TriMeshDefects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        list::describe(
            &mut parts,
            &self.non_finite_vertices,
            ["vertex has a non-finite coordinate", "vertices have a non-finite coordinate"],
        );
        list::describe(
            &mut parts,
            &self.indices_out_of_range,
            ["triangle has an index out of range", "triangles have an index out of range"],
        );
        list::describe(
            &mut parts,
            &self.repeated_indices,
            ["triangle names a vertex twice", "triangles name a vertex twice"],
        );
        list::describe(
            &mut parts,
            &self.groups_out_of_order,
            ["group has a bad run of triangles", "groups have a bad run of triangles"],
        );
        if let Some(count) = self.color_count {
            parts.push(format!("{count} triangle colours, not one a triangle"));
        }
        f.write_str(&parts.join("; "))
    }
}

/// Why a soup is not a [`TriMesh`].
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum TriMeshError {
    /// More vertices than ids.
    #[error("{count} vertices; a mesh has at most {MAX_VERTICES}")]
    TooManyVertices {
        /// How many there are.
        count: usize,
    },
    /// More triangles than ids.
    #[error("{count} triangles; a mesh has at most {MAX_TRIANGLES}")]
    TooManyTriangles {
        /// How many there are.
        count: usize,
    },
    /// Elements at fault, all of them.
    #[error("{0}")]
    Defects(Box<TriMeshDefects>),
}
