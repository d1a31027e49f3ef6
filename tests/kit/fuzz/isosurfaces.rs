//! Grids, marching cubes, marching squares and cut cells on few nodes, against integers.

use std::sync::OnceLock;

use glam::DVec3;
use rayon::{ThreadPool, ThreadPoolBuilder};
use rug::ops::Pow;
use rug::{Integer, Rational};
use welter_meshing::Monitor;
use welter_meshing::cut_cells::{CellKind, CutCells};
use welter_meshing::field::ScalarField;
use welter_meshing::grid::{Grid, Grid2, Grid3, Samples};
use welter_meshing::isosurface::{
    IsosurfaceError, MarchingCubes, MarchingSquares, marching_cubes, marching_cubes_open, marching_squares,
};
use welter_meshing::spatial::{Winding, WindingNumbers};
use welter_meshing::surface::{ClosedOrientedMesh, EmbeddedMesh, Topology};

use crate::entropy::Entropy;
use crate::exact::lift;

/// Samples to pick from: small sets, so that zeros and ambiguous faces abound.
const VALUES: [&[f64]; 6] = [
    &[-1.0, 1.0],
    &[-1.0, 0.0, 1.0, -0.0],
    &[-1.0, -1.0, -1.0, 0.0, 0.3],
    &[-1e-300, 5e-324, -5e-324, 1.0, -1.0, 0.0, 1e-323],
    &[f64::NEG_INFINITY, f64::INFINITY, -1.0, f64::MAX, f64::MIN, 0.0],
    &[-1.0, 1e-9, -1e-9, 1e9, -1e9],
];

/// Counts along x at which rows of bits fill a word, or just not.
const ROWS: [u32; 7] = [62, 63, 64, 65, 127, 128, 129];

/// A surface, contours and cut cells of samples drawn from the bytes.
pub fn isosurfaces(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    let entropy = &mut entropy;
    let in_plane: Option<Grid2> = draw_grid(entropy);
    let in_space: Option<Grid3> = draw_grid(entropy);
    let level = entropy.pick(&[0.0, 0.0, 0.0, 0.3, -1.0, f64::MAX, f64::MIN, 5e-324]);
    let margin = entropy.pick(&[2f64.powi(-20), 2f64.powi(-40), 0.25, 1e-3]);
    let wild = Wild { kind: entropy.below(8), seed: u64::from(entropy.byte()) };
    let roots_of = (wild.kind > 1).then_some(&wild as &dyn ScalarField);
    let which = entropy.below(8);
    if let Some(grid) = in_plane {
        contours(&draw_samples(grid, which, entropy), &MarchingSquares { level, margin });
    }
    if let Some(grid) = in_space {
        let samples = draw_samples(grid, which, entropy);
        surface(&samples, &MarchingCubes { level, margin, roots_of });
    }
}

/// A grid whose first node is a multiple of its granule and whose spacing is one; near to where that is no longer exact, too.
fn draw_grid<const D: usize>(entropy: &mut Entropy<'_>) -> Option<Grid<D>> {
    let mut cells = [(); D].map(|()| u32::from(entropy.below(4)) + 1);
    if entropy.below(16) == 15 {
        // With two cells across there are rows that touch the wall at their ends only.
        cells = [(); D].map(|()| u32::from(entropy.below(2)) + 1);
        cells[0] = entropy.pick(&ROWS);
    }
    let granule = 2f64.powi(entropy.pick(&[-2, 0, -24, -2, 120, -180]));
    // The last is a third of 2^53 + 1.
    let multiple = entropy.pick(&[1, 1, 3, 0x00ff_ffff, (1 << 40) + 1, 3_002_399_751_580_331]);
    let mut sure = multiple * u64::from(*cells.iter().max()?) < 1 << 52;
    let origin = [(); D].map(|()| {
        let near = i64::from(entropy.between(-40, 40));
        let from = match entropy.below(8) {
            0 => 1 << 53,
            1 => -(1 << 53),
            2 => 1 << 30,
            3 => -5 * multiple as i64,
            _ => 0,
        };
        let at = (from + near).clamp(-(1 << 53), 1 << 53);
        sure &= at.unsigned_abs() + multiple * 129 < 1 << 52;
        at as f64 * granule
    });
    let spacing = multiple as f64 * granule;
    let grid = match Grid::new(origin, spacing, cells) {
        Ok(grid) => grid,
        Err(error) => {
            assert!(!sure, "{error} {origin:?} {spacing:e} {cells:?}");
            return None;
        }
    };
    let exact = |x: f64| Rational::from_f64(x).expect("finite");
    for axis in 0..D {
        for i in 0..=cells[axis] {
            let expected = exact(origin[axis]) + exact(spacing) * i;
            let got = grid.coordinate(axis, i);
            assert_eq!(exact(got), expected, "node {i} of {cells:?} from {origin:?}, {spacing:e} apart");
        }
    }
    Some(grid)
}

fn draw_samples<const D: usize>(grid: Grid<D>, which: u8, entropy: &mut Entropy<'_>) -> Samples<D> {
    let values = (0..grid.node_count()).map(|_| match VALUES.get(usize::from(which)) {
        Some(values) => entropy.pick(values),
        None if which == 6 => f64::from(entropy.byte().cast_signed()),
        None => f64::from_bits(entropy.word()),
    });
    Samples::new(grid, values.collect())
}

/// A field that has little to do with the samples.
struct Wild {
    kind: u8,
    seed: u64,
}

impl ScalarField for Wild {
    fn value(&self, point: DVec3) -> f64 {
        let mix = |h: u64, x: f64| (h ^ x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
        let hash = point.to_array().into_iter().fold(self.seed, mix);
        match self.kind {
            2 => f64::NAN,
            3 => f64::from_bits(hash),
            4 => f64::from((hash >> 56) as u8) - 128.0,
            5 => -1.0,
            6 => f64::INFINITY,
            _ => point.element_sum().sin(),
        }
    }
}

/// Whether a refusal is right: the samples have a NaN, or there are few numbers between nodes.
fn is_refused<const D: usize>(samples: &Samples<D>, margin: f64, error: &IsosurfaceError) -> bool {
    match error {
        IsosurfaceError::NotANumber(found) => {
            let first = samples.values().iter().position(|v| v.is_nan()).expect("a NaN");
            found.node == samples.grid().node_at(first)
        }
        IsosurfaceError::TooFine { axis, .. } => {
            let [first, last] = [samples.grid().origin(), samples.grid().max()].map(|p| p[*axis].abs());
            first.max(last) * f64::EPSILON * 2.0 >= margin * samples.grid().spacing()
        }
        _ => false,
    }
}

fn surface(samples: &Samples<3>, parameters: &MarchingCubes<'_>) {
    let closed = match marching_cubes(samples, parameters, &Monitor::none()) {
        Ok(closed) => closed,
        Err(error) => {
            assert!(is_refused(samples, parameters.margin, &error), "{error}");
            assert_eq!(CutCells::new(samples, parameters, &Monitor::none()).map(|c| c.len()), Err(error));
            return;
        }
    };
    assert!(samples.values().iter().all(|v| !v.is_nan()));
    assert_eq!(ClosedOrientedMesh::check(&closed), Ok(()));
    assert_eq!(EmbeddedMesh::check(&closed, &Monitor::none()), Ok(()));
    let topology = Topology::of(&closed);
    assert!(topology.is_edge_manifold() && topology.is_vertex_manifold());
    assert_eq!(topology.unreferenced_vertices().len(), 0);
    vertices_lie_within_edges(samples, parameters.level, closed.positions());
    encloses_the_nodes_below(samples, parameters.level, &closed);
    let open = marching_cubes_open(samples, parameters, &Monitor::none()).expect("as with the wall");
    let cells = CutCells::new(samples, parameters, &Monitor::none()).expect("as the surface");
    assert_eq!(open.positions(), cells.positions());
    assert_eq!(cells.iter().map(|cell| cell.triangles().len()).sum::<usize>(), open.triangles().len());
    kinds_are_those_of_the_nodes(samples, parameters.level, &cells);
    tetrahedra_fill_the_surface(&cells, &closed);
    for pool in pools() {
        let again = pool.install(|| marching_cubes(samples, parameters, &Monitor::none()));
        assert_eq!(again.as_ref(), Ok(&closed), "the number of threads");
    }
}

/// Pools of one and three threads.
fn pools() -> &'static [ThreadPool; 2] {
    static POOLS: OnceLock<[ThreadPool; 2]> = OnceLock::new();
    POOLS.get_or_init(|| [1, 3].map(|n| ThreadPoolBuilder::new().num_threads(n).build().expect("threads")))
}

/// Each vertex is a node on the wall, below the level, or lies strictly between two neighbours of which one is below.
fn vertices_lie_within_edges(samples: &Samples<3>, level: f64, positions: &[DVec3]) {
    let grid = samples.grid();
    for position in positions {
        let mut below = [0; 3];
        let mut off = Vec::new();
        for axis in 0..3 {
            let i = (0..grid.nodes()[axis]).rev().find(|&i| grid.coordinate(axis, i) <= position[axis]);
            below[axis] = i.expect("within the grid");
            if grid.coordinate(axis, below[axis]) != position[axis] {
                off.push(axis);
            }
        }
        let is_below = |node| samples.at(node) < level;
        match off[..] {
            [] => {
                let on_wall = (0..3).any(|axis| [0, grid.cells()[axis]].contains(&below[axis]));
                assert!(is_below(below) && on_wall, "{position}");
            }
            [axis] => {
                let mut above = below;
                above[axis] += 1;
                assert_ne!(is_below(below), is_below(above), "{position}");
            }
            _ => panic!("{position} lies on no edge"),
        }
    }
}

fn encloses_the_nodes_below(samples: &Samples<3>, level: f64, mesh: &ClosedOrientedMesh) {
    let numbers = WindingNumbers::new(mesh);
    let grid = samples.grid();
    for number in 0..grid.node_count() {
        let node = grid.node_at(number);
        let on_wall = (0..3).any(|axis| [0, grid.cells()[axis]].contains(&node[axis]));
        let is_below = samples.at(node) < level;
        match numbers.at(grid.position(node)) {
            Winding::OnSurface { .. } => assert!(on_wall && is_below, "{node:?}"),
            Winding::Number(number) => {
                assert_eq!(number, i32::from(is_below), "{node:?}");
                assert!(!(on_wall && is_below), "{node:?}");
            }
            Winding::NotFinite => panic!("{node:?} is finite"),
        }
    }
}

fn kinds_are_those_of_the_nodes(samples: &Samples<3>, level: f64, cells: &CutCells) {
    let grid = samples.grid();
    let inside: Vec<_> = cells.inside_runs().flat_map(|([j, k], run)| run.map(move |i| [i, j, k])).collect();
    assert_eq!(inside.len() as u64, cells.inside_count());
    let mut cut = 0;
    for number in 0..grid.cell_count() {
        let cell @ [i, j, k] = grid.cell_at(number);
        let corner = |c: u32| [i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)];
        let below = (0..8).fold(0, |bits, c| bits | u8::from(samples.at(corner(c)) < level) << c);
        match cells.kind(cell) {
            CellKind::Inside => assert!(
                below == 255 && inside.binary_search_by_key(&[k, j, i], |&[i, j, k]| [k, j, i]).is_ok()
            ),
            CellKind::Outside => assert_eq!(below, 0),
            CellKind::Cut(found) => {
                assert_eq!((found.case().0, found.index()), (below, cell));
                assert_eq!(cells.get(cut).index(), cell);
                cut += 1;
            }
        }
    }
    assert_eq!(cut, cells.len());
}

/// All tetrahedra have a positive volume, and with the cells inside they have that of the surface: no digit is missing.
fn tetrahedra_fill_the_surface(cells: &CutCells, closed: &ClosedOrientedMesh) {
    let solids = cells.iter().flat_map(|cell| cell.tetrahedra().collect::<Vec<_>>());
    let solids: Vec<[DVec3; 4]> = solids.collect();
    let apex = DVec3::from_array(cells.grid().origin());
    let cones = closed.triangles().iter().map(|t| {
        let [a, b, c] = t.map(|v| closed.positions()[v.index()]);
        [apex, a, b, c]
    });
    let tetrahedra: Vec<[DVec3; 4]> = solids.iter().copied().chain(cones).collect();
    let mut points: Vec<[f64; 3]> = tetrahedra.iter().flatten().map(DVec3::to_array).collect();
    points.push([cells.grid().spacing(), 0.0, 0.0]);
    let mut lifted = lift(&points);
    let [spacing, ..] = lifted.pop().expect("the spacing");
    let volumes: Vec<Integer> = lifted.chunks(4).map(six_volumes).collect();
    let (solid, cones) = volumes.split_at(solids.len());
    assert!(solid.iter().all(|volume| volume.cmp0().is_gt()), "a tetrahedron without volume");
    let whole = Integer::from(6 * cells.inside_count()) * spacing.pow(3);
    assert_eq!(whole + Integer::sum(solid.iter()), Integer::from(Integer::sum(cones.iter())));
}

/// Six times the volume of a tetrahedron.
fn six_volumes(corners: &[[Integer; 3]]) -> Integer {
    let side = |i: usize| -> [Integer; 3] {
        std::array::from_fn(|k| Integer::from(&corners[i][k] - &corners[0][k]))
    };
    let [u, v, w] = [side(1), side(2), side(3)];
    let minor = |i: usize, j: usize| Integer::from(&v[i] * &w[j]) - Integer::from(&v[j] * &w[i]);
    minor(1, 2) * &u[0] + minor(2, 0) * &u[1] + minor(0, 1) * &u[2]
}

/// Contours end at the wall only, run on as lines, and bound the polygons of their squares.
fn contours(samples: &Samples<2>, parameters: &MarchingSquares) {
    let contours = match marching_squares(samples, parameters, &Monitor::none()) {
        Ok(contours) => contours,
        Err(error) => return assert!(is_refused(samples, parameters.margin, &error), "{error}"),
    };
    let grid = samples.grid();
    let mut degrees = vec![[0; 2]; contours.positions.len()];
    for &[a, b] in &contours.segments {
        degrees[a as usize][0] += 1;
        degrees[b as usize][1] += 1;
    }
    for (degree, p) in degrees.iter().zip(&contours.positions) {
        let on_wall = (0..2).any(|axis| [grid.origin()[axis], grid.max()[axis]].contains(&p[axis]));
        assert!(
            if on_wall { [[0, 1], [1, 0]].contains(degree) } else { *degree == [1, 1] },
            "{degree:?} {p}"
        );
    }
    let mut joined: Vec<[u32; 2]> = contours
        .lines()
        .iter()
        .flat_map(|line| line.windows(2).map(|pair| [pair[0], pair[1]]).collect::<Vec<_>>())
        .collect();
    let mut segments = contours.segments.clone();
    joined.sort_unstable();
    segments.sort_unstable();
    assert_eq!(joined, segments);
    let below = |node| samples.at(node) < parameters.level;
    let edges = (0..grid.node_count()).map(|n| grid.node_at(n)).flat_map(|node| {
        [0, 1].map(|axis| {
            let mut end = node;
            end[axis] += 1;
            usize::from(end[axis] < grid.nodes()[axis] && below(node) != below(end))
        })
    });
    assert_eq!(edges.sum::<usize>(), contours.positions.len());
}
