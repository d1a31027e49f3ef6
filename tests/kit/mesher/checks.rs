//! What is true of every mesh of every surface: [`check`].

use std::collections::BTreeMap;

use welter_meshing::Monitor;
use welter_meshing::distance::grid_winding_numbers;
use welter_meshing::surface::{ClosedOrientedMesh, TriId};
use welter_meshing::volumetric::VolumeMesh;
use welter_predicates::moved_grid::moved_box_meets_segment;

use super::unfolded::{cells_near, meets};
use super::{Complex, Sets};

/// What is not the mesher's fault alone.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// Number of components of the mesh.
    pub components: usize,
    /// How many sides more than two hexahedra have: behind such a side the body falls apart within one cell.
    pub forks: usize,
    /// Components whose Euler characteristic is not half that of their surfaces, with both, the surface's doubled.
    pub odd: Vec<[i64; 2]>,
}

/// Checks counts against winding numbers, and that the surface runs on from hexahedron to hexahedron.
///
/// # Errors
/// The first fault.
pub fn check(surface: &ClosedOrientedMesh, volume: &VolumeMesh) -> Result<Checked, String> {
    let complex = Complex::of_mesh(&volume.mesh);
    if let Some(fault) = complex.faults.first() {
        return Err(fault.clone());
    }
    let allowed = vertices_of_several_sheets(surface);
    if volume.hosts.disagreements > allowed {
        let found = volume.hosts.disagreements;
        return Err(format!("{found} vertices of the surface disagree on their host, {allowed} may"));
    }
    let in_cell = hosts_by_cell(surface, volume)?;
    check_counts(surface, volume, &in_cell)?;
    check_walks(surface, volume, &complex, &in_cell)?;
    let halves = halves(surface, &complex, &in_cell);
    let pairs = complex.characteristics.iter().zip(&halves);
    let odd = pairs.filter(|(ours, half)| 2 * **ours != **half).map(|(&ours, &half)| [ours, half]).collect();
    Ok(Checked { components: complex.characteristics.len(), forks: complex.forks, odd })
}

/// Number of vertices at which the surface is no disc: several sheets meet there, which may lie in several hexahedra.
fn vertices_of_several_sheets(surface: &ClosedOrientedMesh) -> usize {
    let mut around = Sets::new(3 * surface.triangles().len());
    let mut several = vec![false; surface.positions().len()];
    let sided = two_sided_edges(surface);
    for &[(s, ends), (t, _)] in &sided {
        ends.iter().for_each(|&v| around.unite(corner_at(surface, s, v), corner_at(surface, t, v)));
    }
    let mut first = vec![usize::MAX; surface.positions().len()];
    for (t, corners) in surface.triangles().iter().enumerate() {
        for (k, corner) in corners.iter().enumerate() {
            let root = around.root(3 * t + k);
            let known = &mut first[corner.index()];
            if *known == usize::MAX {
                *known = root;
            }
            several[corner.index()] |= *known != root;
        }
    }
    several.iter().filter(|&&several| several).count()
}

/// The number of a triangle's corner among all.
fn corner_at(surface: &ClosedOrientedMesh, t: u32, vertex: u32) -> usize {
    let corners = surface.triangles()[t as usize];
    3 * t as usize + corners.iter().position(|c| c.0 == vertex).expect("a corner of the triangle")
}

type ByCell = BTreeMap<(u64, u32), u32>;

/// The hexahedron of each triangle in each cell that it meets, after a comparison with all cells near it.
fn hosts_by_cell(surface: &ClosedOrientedMesh, volume: &VolumeMesh) -> Result<ByCell, String> {
    let grid = volume.mesh.grid();
    let mut in_cell = ByCell::new();
    for &[h, t] in &volume.hosts.triangles {
        let cell = volume.mesh.cells()[h as usize];
        if let Some(other) = in_cell.insert((cell, t), h) {
            return Err(format!("triangle {t} lies in hexahedra {other} and {h} of one cell"));
        }
    }
    let mut pairs = 0;
    for t in 0..surface.triangles().len() as u32 {
        let corners = surface.corners(TriId(t)).map(|p| p.to_array());
        let mut missing = None;
        cells_near(grid, &corners, |cell| {
            if meets(grid, cell, corners) {
                pairs += 1;
                if !in_cell.contains_key(&(grid.cell_index(cell) as u64, t)) {
                    missing = Some(cell);
                }
            }
        });
        if let Some(cell) = missing {
            return Err(format!("triangle {t} meets cell {cell:?}, but none of its hexahedra"));
        }
    }
    if pairs != in_cell.len() {
        return Err(format!("triangles are in {} hexahedra of {pairs} cells", in_cell.len()));
    }
    Ok(in_cell)
}

fn check_counts(surface: &ClosedOrientedMesh, volume: &VolumeMesh, in_cell: &ByCell) -> Result<(), String> {
    let grid = volume.mesh.grid();
    let winding = grid_winding_numbers(surface, grid, &Monitor::none()).map_err(|e| e.to_string())?;
    let mut counts = vec![0u32; grid.cell_count()];
    volume.mesh.cells().iter().for_each(|&cell| counts[cell as usize] += 1);
    let mut touched = vec![false; grid.cell_count()];
    in_cell.keys().for_each(|&(cell, _)| touched[cell as usize] = true);
    for cell in 0..grid.cell_count() {
        let first = grid.cell_at(cell);
        let corners: [i32; 8] = std::array::from_fn(|c| {
            let node = std::array::from_fn(|axis| first[axis] + (c >> axis & 1) as u32);
            winding.numbers()[grid.node_index(node)]
        });
        let most = corners.iter().copied().max().unwrap_or(0);
        let least = corners.iter().copied().min().unwrap_or(0);
        let count = counts[cell] as i32;
        if least < 0 || (!touched[cell] && (least != most || count != most)) || count < most {
            return Err(format!(
                "cell {first:?} (touched: {}) has {count} hexahedra, its corners are {corners:?} deep",
                touched[cell]
            ));
        }
    }
    Ok(())
}

/// A triangle in two cells side by side lies in two hexahedra with a common side; an edge lies in one hexahedron with both its triangles.
fn check_walks(
    surface: &ClosedOrientedMesh,
    volume: &VolumeMesh,
    complex: &Complex,
    in_cell: &ByCell,
) -> Result<(), String> {
    let grid = volume.mesh.grid();
    for (&(cell, t), &h) in in_cell {
        for axis in 0..3 {
            let mut behind = grid.cell_at(cell as usize);
            behind[axis] += 1;
            if behind[axis] == grid.cells()[axis] {
                continue;
            }
            if let Some(&other) = in_cell.get(&(grid.cell_index(behind) as u64, t))
                && !complex.across[h as usize][2 * axis + 1].contains(&other)
            {
                return Err(format!("triangle {t} goes on from hexahedron {h} to {other}, which are apart"));
            }
        }
    }
    for [(s, ends), (t, _)] in two_sided_edges(surface) {
        let segment = ends.map(|v| surface.positions()[v as usize].to_array());
        let mut fault = None;
        cells_near(grid, &segment, |cell| {
            let number = grid.cell_index(cell) as u64;
            let hosts = [s, t].map(|t| in_cell.get(&(number, t)));
            if moved_box_meets_segment(grid.node(cell), grid.node(cell.map(|i| i + 1)), segment)
                && (hosts[0].is_none() || hosts[0] != hosts[1])
            {
                fault = Some(format!("the edge of triangles {s} and {t} is in {hosts:?} in cell {cell:?}"));
            }
        });
        if let Some(fault) = fault {
            return Err(fault);
        }
    }
    Ok(())
}

/// Edges with two triangles: each triangle, with the ends of the edge in its direction.
fn two_sided_edges(surface: &ClosedOrientedMesh) -> Vec<[(u32, [u32; 2]); 2]> {
    let mut edges: BTreeMap<[u32; 2], Vec<(u32, [u32; 2])>> = BTreeMap::new();
    for (t, corners) in surface.triangles().iter().enumerate() {
        for k in 0..3 {
            let ends = [corners[k].0, corners[(k + 1) % 3].0];
            edges.entry([ends[0].min(ends[1]), ends[0].max(ends[1])]).or_default().push((t as u32, ends));
        }
    }
    edges.into_values().filter_map(|list| <[_; 2]>::try_from(list).ok()).collect()
}

/// For each component of the mesh the sum of its surfaces' Euler characteristics, for surfaces with two triangles at each edge.
fn halves(surface: &ClosedOrientedMesh, complex: &Complex, in_cell: &ByCell) -> Vec<i64> {
    let mut sums = vec![0i64; complex.characteristics.len()];
    let count = surface.triangles().len();
    let mut vertices = Sets::new(3 * count);
    let edges = two_sided_edges(surface);
    let mut of_triangle = vec![usize::MAX; count];
    for (&(_, t), &h) in in_cell {
        of_triangle[t as usize] = complex.component_of[h as usize];
    }
    if 2 * edges.len() != 3 * count {
        // Where more triangles meet at an edge, which two go on is not ours to say.
        return complex.characteristics.iter().map(|c| 2 * c).collect();
    }
    for &[(s, ends), (t, _)] in &edges {
        ends.iter().for_each(|&v| vertices.unite(corner_at(surface, s, v), corner_at(surface, t, v)));
        sums[of_triangle[s as usize]] -= 1;
    }
    for h in 0..3 * count {
        sums[of_triangle[h / 3]] += i64::from(vertices.root(h) == h) + i64::from(h % 3 == 0);
    }
    sums
}
