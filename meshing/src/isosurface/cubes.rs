//! [`marching_cubes`]: the surface on which samples have a level.
//!
//! # Method
//! Signs of all nodes as bits ([`Signs`]), by which vertices are numbered; positions, slab by slab of the grid ([`Crossings`]); triangles, slab by slab, from the
//! table ([`CellCase`]); the wall's polygons ([`wall`]). Slabs write to their own parts of the arrays: the result does not depend on the number of threads.

use rayon::prelude::*;

use super::crossing::{Crossings, require_room};
use super::signs::{KINDS, Signs, Word, mask_below};
use super::wall::wall_triangles;
use super::{CellCase, IsosurfaceError};
use crate::field::ScalarField;
use crate::grid::Samples;
use crate::surface::{ClosedOrientedMesh, EmbeddedMesh, MAX_TRIANGLES, TriMesh, TriangleSoup};
use crate::{DVec3, Monitor};

/// Default distance of vertices from nodes, in cells: see [`MarchingCubes::margin`].
pub(super) const DEFAULT_MARGIN: f64 = 1.0 / (1 << 20) as f64;

/// Parameters of [`marching_cubes`].
#[derive(Clone, Copy)]
pub struct MarchingCubes<'a> {
    /// The surface is where the samples have this value; finite. Default 0, as for level sets.
    pub level: f64,
    /// How far the vertices stay from the nodes of the grid, in cells: between 2^-40 and 1/4. Default 2^-20: a millionth of a cell, far below what linear
    /// interpolation errs by; but wide enough that triangles next to a node keep a normal with ten digits.
    pub margin: f64,
    /// The field that was sampled, if vertices shall lie on it instead of on the linear interpolant of the samples. Default none.
    pub roots_of: Option<&'a dyn ScalarField>,
}

impl Default for MarchingCubes<'_> {
    fn default() -> Self {
        Self { level: 0.0, margin: DEFAULT_MARGIN, roots_of: None }
    }
}

impl std::fmt::Debug for MarchingCubes<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MarchingCubes")
            .field("level", &self.level)
            .field("margin", &self.margin)
            .field("roots_of", &self.roots_of.map(|_| "a field"))
            .finish()
    }
}

impl MarchingCubes<'_> {
    /// Refuses parameters out of range.
    ///
    /// # Errors
    /// [`IsosurfaceError::Parameter`].
    pub fn validate(&self) -> Result<(), IsosurfaceError> {
        require_level_and_margin(self.level, self.margin)
    }
}

/// The checks that marching cubes and squares share.
pub(super) fn require_level_and_margin(level: f64, margin: f64) -> Result<(), IsosurfaceError> {
    let require = |holds: bool, parameter, value, range| {
        if holds { Ok(()) } else { Err(IsosurfaceError::Parameter { parameter, value, range }) }
    };
    require(level.is_finite(), "level", level, "finite")?;
    let holds = (libm::ldexp(1.0, -40)..=0.25).contains(&margin);
    require(holds, "margin", margin, "between 2^-40 and 1/4")
}

/// The closed surface around the part of the grid where samples are below the level. Where that part reaches the wall of the grid,
/// the wall belongs to the surface.
///
/// The surface is free of self-intersection, whatever the samples are; every edge has two triangles and every vertex one fan. Triangles
/// are counterclockwise seen from where samples are larger. A sample that equals the level counts as larger; infinite samples are allowed, and have the
/// surface as near to their finite neighbours as the margin lets it.
/// Vertices lie on edges of the grid exactly, and strictly between their ends.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, grid::{Grid3, Samples}, isosurface::{MarchingCubes, marching_cubes}};
/// use welter_meshing::surface::measure::signed_volume;
/// let ball = |p: DVec3| p.length() - 0.9;
/// let samples = Samples::of(&Grid3::covering([-1.0; 3], [1.0; 3], 0.125, 1)?, &ball, &Monitor::none())?;
/// let mesh = marching_cubes(&samples, &MarchingCubes::default(), &Monitor::none())?;
/// assert!((signed_volume(&mesh) - 3.05363).abs() < 0.05);
/// // With vertices on the ball itself:
/// let exact = MarchingCubes { roots_of: Some(&ball), ..MarchingCubes::default() };
/// let mesh = marching_cubes(&samples, &exact, &Monitor::none())?;
/// assert!(mesh.positions().iter().all(|p| (p.length() - 0.9).abs() < 1e-12));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`IsosurfaceError`]: a sample that is NaN, parameters out of range, a grid too far from the origin for its spacing, too many vertices, the monitor.
pub fn marching_cubes(
    samples: &Samples<3>,
    parameters: &MarchingCubes<'_>,
    monitor: &Monitor<'_>,
) -> Result<EmbeddedMesh, IsosurfaceError> {
    let mesh = extract(samples, parameters, true, monitor)?;
    Ok(EmbeddedMesh::by_construction(ClosedOrientedMesh::by_construction(mesh)))
}

/// As [`marching_cubes`], without the wall: the surface ends where it meets the wall of the grid.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, grid::{Grid3, Samples}, isosurface::{MarchingCubes, marching_cubes_open}};
/// let grid = Grid3::new([0.0; 3], 0.5, [2, 2, 2])?;
/// let samples = Samples::of(&grid, &|p: DVec3| p.z - 0.25, &Monitor::none())?;
/// let mesh = marching_cubes_open(&samples, &MarchingCubes::default(), &Monitor::none())?;
/// assert_eq!(mesh.triangles().len(), 8);
/// assert!(mesh.positions().iter().all(|p| p.z == 0.25));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// As [`marching_cubes`].
pub fn marching_cubes_open(
    samples: &Samples<3>,
    parameters: &MarchingCubes<'_>,
    monitor: &Monitor<'_>,
) -> Result<TriMesh, IsosurfaceError> {
    extract(samples, parameters, false, monitor)
}

fn extract(
    samples: &Samples<3>,
    parameters: &MarchingCubes<'_>,
    capped: bool,
    monitor: &Monitor<'_>,
) -> Result<TriMesh, IsosurfaceError> {
    parameters.validate()?;
    require_room(samples.grid(), parameters.margin)?;
    // All stages in the pool at once: each by itself would hand its work over and wait, which takes longer than a small grid does.
    rayon::scope(|_| {
        let signs = Signs::new(samples, parameters.level, capped, monitor)?;
        let positions = positions(&signs, &Crossings { samples, parameters }, monitor)?;
        let triangles = triangles(&signs, monitor)?;
        let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
        Ok(TriMesh::new(soup)
            .expect("finite vertices, numbered without gaps, three different ones a triangle"))
    })
}

/// The position of every vertex.
pub(super) fn positions(
    signs: &Signs,
    crossings: &Crossings<'_>,
    monitor: &Monitor<'_>,
) -> Result<Vec<DVec3>, IsosurfaceError> {
    let [_, ny, nz] = signs.grid.nodes();
    let stage = monitor.stage("vertices", u64::from(nz));
    let row_at = |k: u32| ny as usize * k as usize;
    let mut positions = vec![DVec3::ZERO; signs.vertices];
    let ends = (0..nz).map(|k| signs.vertices_of_row(row_at(k + 1) - 1).end);
    split(&mut positions, ends).into_par_iter().enumerate().try_for_each(|(k, slab)| {
        stage.check()?;
        let mut slab = slab.iter_mut();
        for j in 0..ny {
            let row = row_at(k as u32) + j as usize;
            for kind in 0..KINDS {
                signs.for_each(kind, row, |i| {
                    let node = [i, j, k as u32];
                    let position =
                        if kind < 3 { crossings.at(kind, node) } else { signs.grid.position(node) };
                    *slab.next().expect("as many as were counted") = position;
                });
            }
        }
        stage.advance(1);
        Ok::<_, IsosurfaceError>(())
    })?;
    Ok(positions)
}

/// The triangles: those of cells, cell by cell, then those of the wall.
fn triangles(signs: &Signs, monitor: &Monitor<'_>) -> Result<Vec<[u32; 3]>, IsosurfaceError> {
    let layers = signs.grid.cells()[2];
    let stage = monitor.stage("triangles", 2 * u64::from(layers));
    let wall = wall_triangles(signs, &stage)?;
    let counts: Vec<usize> = (0..layers)
        .into_par_iter()
        .map(|k| {
            stage.check()?;
            let mut count = 0;
            for_each_mixed_cell(signs, k, |_, case, _| count += case.triangle_numbers().len());
            stage.advance(1);
            Ok(count)
        })
        .collect::<Result<_, IsosurfaceError>>()?;
    let in_cells: usize = counts.iter().sum();
    let count = in_cells + wall.len();
    if count > MAX_TRIANGLES {
        return Err(IsosurfaceError::TooMany { what: "triangles", count: count as u64 });
    }
    let mut triangles = Vec::with_capacity(count);
    triangles.resize(in_cells, [0; 3]);
    let ends = counts.iter().scan(0, |sum, &n| {
        *sum += n;
        Some(*sum)
    });
    split(&mut triangles, ends).into_par_iter().enumerate().try_for_each(|(k, slab)| {
        stage.check()?;
        let mut slab = slab.iter_mut();
        for_each_mixed_cell(signs, k as u32, |_, case, edges| {
            let samples = edges.numbers();
            for (triangle, out) in case.triangle_numbers().iter().zip(slab.by_ref()) {
                *out = triangle.map(|point| samples[usize::from(point - super::cell::CORNERS)]);
            }
        });
        stage.advance(1);
        Ok::<_, IsosurfaceError>(())
    })?;
    triangles.extend(wall);
    Ok(triangles)
}

/// Cuts an array into parts that end at the given places.
fn split<T>(mut array: &mut [T], ends: impl Iterator<Item = usize>) -> Vec<&mut [T]> {
    let mut start = 0;
    let mut parts = Vec::new();
    for end in ends {
        let (part, rest) = array.split_at_mut(end - start);
        parts.push(part);
        (array, start) = (rest, end);
    }
    parts
}

/// The numbers of the samples on the edges of one cell, computed when asked for.
pub(super) struct EdgeNumbers<'a> {
    /// Samples of the four rows' x-edges, two rows' y-edges and two rows' z-edges: bits, and the number of the first bit.
    rows: &'a [(u64, u32); 8],
    bit: u32,
}

impl EdgeNumbers<'_> {
    /// By edge; meaningless for edges without a sample.
    #[inline]
    pub(super) fn numbers(&self) -> [u32; 12] {
        let below = mask_below(self.bit as usize);
        let here = self.rows.map(|(bits, first)| first + (bits & below).count_ones());
        let next = |row: usize| here[row] + (self.rows[row].0 >> self.bit & 1) as u32;
        [
            here[0],
            here[1],
            here[2],
            here[3],
            here[4],
            next(4),
            here[5],
            next(5),
            here[6],
            next(6),
            here[7],
            next(7),
        ]
    }
}

/// Calls `visit` with the index, the case and the numbers of samples of every cell of layer `k` that the surface passes through, in the order of
/// cell numbers.
pub(super) fn for_each_mixed_cell(
    signs: &Signs,
    k: u32,
    mut visit: impl FnMut([u32; 3], CellCase, EdgeNumbers<'_>),
) {
    for j in 0..signs.grid.cells()[1] {
        let rows = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[dj, dk]| signs.row_of(j + dj, k + dk));
        let mut first = [
            signs.first(rows[0], 0),
            signs.first(rows[1], 0),
            signs.first(rows[2], 0),
            signs.first(rows[3], 0),
            signs.first(rows[0], 1),
            signs.first(rows[2], 1),
            signs.first(rows[0], 2),
            signs.first(rows[1], 2),
        ];
        for w in 0..signs.row(rows[0]).len() {
            let words = rows.map(|row| signs.word(row, w));
            let inner = signs.inner_mask(w);
            let any = words.iter().fold(0, |any, word| any | word.here | word.next);
            let all = words.iter().fold(u64::MAX, |all, word| all & word.here & word.next);
            let mut mixed = any & !all & inner;
            if mixed == 0 {
                // No edge of these cells has a sample either.
                continue;
            }
            let samples = edge_bits(&words, inner);
            let numbered: [(u64, u32); 8] = std::array::from_fn(|row| (samples[row], first[row]));
            while mixed != 0 {
                let bit = mixed.trailing_zeros();
                mixed &= mixed - 1;
                visit(
                    [64 * w as u32 + bit, j, k],
                    case_at(&words, bit),
                    EdgeNumbers { rows: &numbered, bit },
                );
            }
            for (first, bits) in first.iter_mut().zip(samples) {
                *first += bits.count_ones();
            }
        }
    }
}

/// Which edges have a sample: x-edges of the four rows, y-edges of the lower and upper row, z-edges of the front and back row.
#[inline]
fn edge_bits(words: &[Word; 4], inner: u64) -> [u64; 8] {
    let x = words.map(|word| (word.here ^ word.next) & inner);
    let [a, b, c, d] = words.map(|word| word.here);
    [x[0], x[1], x[2], x[3], a ^ b, c ^ d, a ^ c, b ^ d]
}

#[inline]
fn case_at(words: &[Word; 4], bit: u32) -> CellCase {
    let mut case = 0;
    for (row, word) in words.iter().enumerate() {
        case |= (word.here >> bit & 1) << (2 * row) | (word.next >> bit & 1) << (2 * row + 1);
    }
    CellCase(case as u8)
}
