//! The triangles at fault, coloured: what `--save-bad` writes.

use super::Findings;
use welter_meshing::surface::{TriMesh, TriangleSoup};

/// Self-intersecting.
const RED: [u8; 3] = [222, 60, 20];
/// Degenerate.
const YELLOW: [u8; 3] = [240, 200, 40];
/// At a boundary edge.
const BLUE: [u8; 3] = [40, 110, 220];
/// At an edge that is inconsistent or not manifold.
const VIOLET: [u8; 3] = [150, 60, 190];

/// The offending triangles with the vertices they use, in the order of the mesh; a triangle with several faults takes
/// the colour of the first in the order self-intersecting, degenerate, inconsistent or not manifold, boundary.
pub(crate) fn offending(mesh: &TriMesh, findings: &Findings) -> TriangleSoup {
    let mut color: Vec<Option<[u8; 3]>> = vec![None; mesh.triangles().len()];
    let mut paint = |index: usize, with: [u8; 3]| {
        color[index].get_or_insert(with);
    };
    for id in findings.pairs.iter().flatten() {
        paint(id.index(), RED);
    }
    for id in &findings.degenerate {
        paint(id.index(), YELLOW);
    }
    for id in findings.triangles_at_bad_edges() {
        paint(id.index(), VIOLET);
    }
    for id in findings.triangles_at_boundary() {
        paint(id.index(), BLUE);
    }
    let mut soup = TriangleSoup::default();
    let mut new_index = vec![u32::MAX; mesh.positions().len()];
    for (triangle, color) in mesh.triangles().iter().zip(color) {
        let Some(color) = color else { continue };
        soup.triangles.push(triangle.map(|v| {
            let slot = &mut new_index[v.index()];
            if *slot == u32::MAX {
                *slot = soup.positions.len() as u32;
                soup.positions.push(mesh.positions()[v.index()]);
            }
            *slot
        }));
        soup.triangle_colors.push(color);
    }
    soup
}
