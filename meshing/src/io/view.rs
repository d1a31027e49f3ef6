//! What writers take: [`SurfaceData`], and its check.

use super::WriteError;
use crate::surface::{Group, TriMesh, TriangleSoup};
use glam::DVec3;

/// Anything that can be written as a surface file.
pub trait SurfaceData {
    /// Vertex positions.
    fn positions(&self) -> &[DVec3];
    /// Number of triangles.
    fn triangle_count(&self) -> usize;
    /// The vertex indices of triangle `index`, which is below [`triangle_count`](Self::triangle_count).
    fn triangle(&self, index: usize) -> [u32; 3];
    /// Named runs of triangles, ascending and disjoint.
    fn groups(&self) -> &[Group];
    /// One colour a triangle, or empty.
    fn triangle_colors(&self) -> &[[u8; 3]];
}

impl SurfaceData for TriangleSoup {
    fn positions(&self) -> &[DVec3] {
        &self.positions
    }
    fn triangle_count(&self) -> usize {
        self.triangles.len()
    }
    fn triangle(&self, index: usize) -> [u32; 3] {
        self.triangles[index]
    }
    fn groups(&self) -> &[Group] {
        &self.groups
    }
    fn triangle_colors(&self) -> &[[u8; 3]] {
        &self.triangle_colors
    }
}

impl SurfaceData for TriMesh {
    fn positions(&self) -> &[DVec3] {
        self.positions()
    }
    fn triangle_count(&self) -> usize {
        self.triangles().len()
    }
    fn triangle(&self, index: usize) -> [u32; 3] {
        self.triangles()[index].map(|vertex| vertex.0)
    }
    fn groups(&self) -> &[Group] {
        self.groups()
    }
    fn triangle_colors(&self) -> &[[u8; 3]] {
        &[]
    }
}

/// Indices in range, groups ascending and disjoint, colours for all triangles or none, counts within 32 bits.
pub(super) fn check<S: SurfaceData + ?Sized>(surface: &S) -> Result<(), WriteError> {
    let (vertices, triangles) = (surface.positions().len(), surface.triangle_count());
    let limit = u64::from(u32::MAX);
    for (what, count) in [("vertices", vertices), ("triangles", triangles)] {
        if count as u64 > limit {
            return Err(WriteError::TooMany { what, count, limit });
        }
    }
    for triangle in 0..triangles {
        if let Some(index) = surface.triangle(triangle).into_iter().find(|&i| i as usize >= vertices) {
            return Err(WriteError::IndexOutOfRange { triangle, index, vertices });
        }
    }
    let colors = surface.triangle_colors().len();
    if colors != 0 && colors != triangles {
        return Err(WriteError::Colors { colors, triangles });
    }
    let mut done = 0;
    for (group, Group { triangles: run, .. }) in surface.groups().iter().enumerate() {
        if run.start < done || run.end < run.start || run.end as usize > triangles {
            return Err(WriteError::Group { group, start: run.start, end: run.end });
        }
        done = run.end;
    }
    Ok(())
}

/// The triangles as runs: of a group with its name, or of none with an empty name.
pub(super) fn runs<S: SurfaceData + ?Sized>(surface: &S) -> Vec<(&str, std::ops::Range<usize>)> {
    let mut runs = Vec::new();
    let mut done = 0;
    for group in surface.groups() {
        let (start, end) = (group.triangles.start as usize, group.triangles.end as usize);
        if start > done {
            runs.push(("", done..start));
        }
        runs.push((group.name.as_str(), start..end));
        done = end;
    }
    if done < surface.triangle_count() {
        runs.push(("", done..surface.triangle_count()));
    }
    runs
}
