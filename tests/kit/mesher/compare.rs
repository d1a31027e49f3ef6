//! Whether two meshes are one but for numbers: [`isomorphic`], [`equals_unfolded`].
//!
//! A connected mesh goes over into another in at most one way once one hexahedron is known, so that trying each on the cell is a complete
//! search.

use std::collections::BTreeMap;

use welter_meshing::grid::Grid3;
use welter_meshing::volumetric::{QUADRILATERALS, VolumeMesh};

use super::{Complex, Solid, Unfolded};

/// How cells and corners of one grid go over into those of another.
pub struct Motion<'a> {
    /// The cell of a cell.
    pub cell: &'a dyn Fn(u64) -> u64,
    /// The corner of each corner.
    pub corners: [usize; 8],
}

impl Motion<'_> {
    /// No motion.
    #[must_use]
    pub fn none() -> Self {
        Self { cell: &|cell| cell, corners: [0, 1, 2, 3, 4, 5, 6, 7] }
    }

    /// The side of each side.
    fn sides(&self) -> [usize; 6] {
        std::array::from_fn(|side| {
            let mut moved = QUADRILATERALS[side].map(|c| self.corners[c]);
            moved.sort_unstable();
            let same = |q: &[usize; 4]| {
                let mut q = *q;
                q.sort_unstable();
                q == moved
            };
            QUADRILATERALS.iter().position(same).expect("a motion of a cube")
        })
    }
}

/// A map of some components.
#[derive(Clone)]
struct Map {
    hexahedra: Vec<Option<u32>>,
    back: Vec<bool>,
    vertices: BTreeMap<u32, u32>,
    vertices_back: BTreeMap<u32, u32>,
}

impl Map {
    fn new(a: &Complex, b: &Complex) -> Self {
        Self {
            hexahedra: vec![None; a.cells.len()],
            back: vec![false; b.cells.len()],
            vertices: BTreeMap::new(),
            vertices_back: BTreeMap::new(),
        }
    }

    /// Maps a hexahedron and all that hang together with it.
    fn follow(
        &mut self,
        a: &Complex,
        b: &Complex,
        motion: &Motion<'_>,
        start: [u32; 2],
    ) -> Result<(), String> {
        let sides = motion.sides();
        let mut stack = vec![start];
        while let Some([x, y]) = stack.pop() {
            if let Some(known) = self.hexahedra[x as usize] {
                if known != y {
                    return Err(format!("hexahedron {x} would be both {known} and {y}"));
                }
                continue;
            }
            if self.back[y as usize] {
                return Err(format!("two hexahedra would be {y}, one of them {x}"));
            }
            let (of_x, of_y) = (x as usize, y as usize);
            if (motion.cell)(a.cells[of_x]) != b.cells[of_y] {
                return Err(format!("hexahedra {x} and {y} are not on one cell"));
            }
            self.hexahedra[of_x] = Some(y);
            self.back[of_y] = true;
            for c in 0..8 {
                let (v, w) = (a.corners[of_x][c], b.corners[of_y][motion.corners[c]]);
                if *self.vertices.entry(v).or_insert(w) != w || *self.vertices_back.entry(w).or_insert(v) != v
                {
                    return Err(format!(
                        "corner {c} of hexahedra {x} and {y}, cell {}: vertices differ",
                        a.cells[of_x]
                    ));
                }
            }
            for (side, &other) in sides.iter().enumerate() {
                let (p, q) = (&a.across[of_x][side], &b.across[of_y][other]);
                if p.len() != q.len() {
                    return Err(format!(
                        "cell {}: across side {side} of hexahedra {x} and {y} lie {p:?} and {q:?}",
                        a.cells[of_x]
                    ));
                }
                // Of several, which is which is not known from here.
                if let ([p], [q]) = (&p[..], &q[..]) {
                    stack.push([*p, *q]);
                }
            }
        }
        Ok(())
    }
}

/// Whether one mesh goes over into the other.
///
/// # Errors
/// What differs.
pub fn isomorphic(a: &Complex, b: &Complex, motion: &Motion<'_>) -> Result<(), String> {
    if a.cells.len() != b.cells.len() {
        return Err(format!("{} hexahedra and {}", a.cells.len(), b.cells.len()));
    }
    let mut on_cell: BTreeMap<u64, Vec<u32>> = BTreeMap::new();
    for (h, &cell) in b.cells.iter().enumerate() {
        on_cell.entry(cell).or_default().push(h as u32);
    }
    let mut map = Map::new(a, b);
    for x in 0..a.cells.len() {
        if map.hexahedra[x].is_some() {
            continue;
        }
        let mut last = String::from("there is none on the cell");
        let candidates = on_cell.get(&(motion.cell)(a.cells[x])).cloned().unwrap_or_default();
        let found = candidates.into_iter().filter(|&y| !map.back[y as usize]).find_map(|y| {
            let mut tried = map.clone();
            match tried.follow(a, b, motion, [x as u32, y]) {
                Ok(()) => Some(tried),
                Err(why) => {
                    last = why;
                    None
                }
            }
        });
        map = found.ok_or_else(|| format!("hexahedron {x} on cell {} has no twin: {last}", a.cells[x]))?;
    }
    Ok(())
}

/// Whether a mesh is that of the solid, with the surface in the right hexahedra.
///
/// # Errors
/// What differs.
pub fn equals_unfolded(volume: &VolumeMesh, solid: &Solid, unfolded: &Unfolded) -> Result<(), String> {
    let (ours, theirs) = (Complex::of_unfolded(unfolded), Complex::of_mesh(&volume.mesh));
    let grid = volume.mesh.grid();
    if let Some(cell) = different_count(&ours, &theirs, grid) {
        return Err(cell);
    }
    let mut map = Map::new(&ours, &theirs);
    let mut pairs = Vec::new();
    for &[h, triangle] in &volume.hosts.triangles {
        let cell = volume.mesh.cells()[h as usize] as usize;
        let hexahedron = unfolded.hexahedron(cell, solid.tet_of[triangle as usize]);
        pairs.push([
            hexahedron.ok_or("a triangle lies in a cell that its tetrahedron does not meet")? as u32,
            h,
        ]);
    }
    for &start in &pairs {
        map.follow(&ours, &theirs, &Motion::none(), start)?;
    }
    match map.hexahedra.iter().position(Option::is_none) {
        Some(left) => Err(format!("hexahedron {left} hangs together with no surface")),
        None => Ok(()),
    }
}

fn different_count(ours: &Complex, theirs: &Complex, grid: &Grid3) -> Option<String> {
    let count = |complex: &Complex| {
        let mut counts: BTreeMap<u64, usize> = BTreeMap::new();
        complex.cells.iter().for_each(|&cell| *counts.entry(cell).or_default() += 1);
        counts
    };
    let (ours, theirs) = (count(ours), count(theirs));
    let mut cells: Vec<u64> = ours.keys().chain(theirs.keys()).copied().collect();
    cells.sort_unstable();
    cells.dedup();
    let of = |counts: &BTreeMap<u64, usize>, cell: u64| counts.get(&cell).copied().unwrap_or(0);
    let wrong: Vec<u64> = cells.into_iter().filter(|&cell| of(&ours, cell) != of(&theirs, cell)).collect();
    let &cell = wrong.first()?;
    Some(format!(
        "{} cells with wrong numbers of hexahedra; cell {:?}: {} instead of {}",
        wrong.len(),
        grid.cell_at(cell as usize),
        of(&theirs, cell),
        of(&ours, cell)
    ))
}
