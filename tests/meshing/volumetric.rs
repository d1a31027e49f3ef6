//! Tests of `welter_meshing::volumetric`: counts, homology, coarsening and tetrahedra against slow obvious twins on
//! random complexes, and on known shapes.

mod coarsening;
mod conversion;
mod quality;
mod sides;
mod tetrahedra;
mod topology;

use welter_kit::entropy::{Entropy, stream};
use welter_kit::volumetric::{Sheets, random};
use welter_meshing::Monitor;
use welter_meshing::grid::Grid3;
use welter_meshing::volumetric::*;

/// Random complexes of up to three hexahedra a cell.
fn random_meshes(count: u64) -> impl Iterator<Item = HexMesh> {
    (0..count).map(|seed| random(&mut Entropy::new(&stream(seed, 4096)), 1 + (seed % 3) as u8))
}

/// All cells of a grid that pass.
fn cells(grid: [u32; 3], keep: impl Fn([u32; 3]) -> bool) -> Vec<[u32; 3]> {
    let [nx, ny, nz] = grid;
    let all = (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])));
    all.filter(|&cell| keep(cell)).collect()
}

/// One sheet on those cells of a grid that pass.
fn sheet(grid: [u32; 3], keep: impl Fn([u32; 3]) -> bool) -> HexMesh {
    let mut sheets = Sheets::new(grid);
    sheets.sheet(cells(grid, keep));
    sheets.build()
}

/// Sheets on all cells of a grid, as large as need be.
fn blocks(cells: [u32; 3], sheets: u64) -> HexMesh {
    let grid = Grid3::new([0.0; 3], 1.0, cells).unwrap();
    let nodes = (0..sheets * grid.node_count() as u64).map(|v| v / sheets).collect();
    let all = (0..grid.cell_count() as u64).flat_map(|cell| (0..sheets).map(move |sheet| (cell, sheet)));
    let hexahedron = |(cell, sheet): (u64, u64)| {
        let at = grid.cell_at(cell as usize);
        [0, 1, 2, 3, 4, 5, 6, 7].map(|c: usize| {
            let node = [0, 1, 2].map(|axis| at[axis] + (c >> axis & 1) as u32);
            (grid.node_index(node) as u64 * sheets + sheet) as u32
        })
    };
    let hexahedra = all.clone().map(hexahedron).collect();
    HexMesh::new(grid, nodes, hexahedra, all.map(|(cell, _)| cell).collect()).unwrap()
}

/// A path that runs around a square of `size` cells `laps` times and is not glued to itself.
fn coil(size: u32, laps: usize) -> HexMesh {
    let last = size - 1;
    let around = (0..last).map(|i| [i, 0, 0]).chain((0..last).map(|i| [last, i, 0]));
    let around =
        around.chain((0..last).map(|i| [last - i, last, 0])).chain((0..last).map(|i| [0, last - i, 0]));
    let lap: Vec<[u32; 3]> = around.collect();
    let mut sheets = Sheets::new([size, size, 1]);
    sheets.path(std::iter::repeat_n(lap, laps).flatten());
    sheets.build()
}

/// Shapes with their Betti numbers.
fn shapes() -> Vec<(&'static str, HexMesh, Vec<[u64; 4]>)> {
    let ring = |[x, y, _]: [u32; 3]| x != 1 || y != 1;
    let mut separate = Sheets::new([1; 3]);
    separate.add([0; 3]);
    separate.add([0; 3]);
    let mut joint = Sheets::new([2, 1, 1]);
    let [a, b, c] = [[0; 3], [1, 0, 0], [1, 0, 0]].map(|cell| joint.add(cell));
    joint.join(a, b);
    joint.join(a, c);
    let mut pair = Sheets::new([1; 3]);
    let (a, b) = (pair.add([0; 3]), pair.add([0; 3]));
    pair.join_side(a, b, 3);
    let mut strips = Sheets::new([3, 1, 1]);
    let [a, b] = [0, 1].map(|_| strips.path((0..3).map(|x| [x, 0, 0])));
    strips.join_side(a[0], b[0], 0);
    strips.join_side(a[2], b[2], 1);
    let mut sphere = Sheets::new([1; 3]);
    let (a, b) = (sphere.add([0; 3]), sphere.add([0; 3]));
    (0..6).for_each(|side| sphere.join_side(a, b, side));
    let mut cross = Sheets::new([2, 1, 1]);
    let four = [[0; 3], [0; 3], [1, 0, 0], [1, 0, 0]].map(|cell| cross.add(cell));
    [(0, 2), (1, 2), (1, 3)].iter().for_each(|&(a, b)| cross.join(four[a], four[b]));
    vec![
        ("nothing", sheet([1; 3], |_| false), vec![]),
        ("block", sheet([3, 2, 2], |_| true), vec![[1, 0, 0, 0]]),
        ("solid torus", sheet([3, 3, 1], ring), vec![[1, 1, 0, 0]]),
        ("ball with a cavity", sheet([3; 3], |cell| cell != [1; 3]), vec![[1, 0, 1, 0]]),
        (
            "thick torus",
            sheet([5, 5, 3], |c| c[2] != 1 || c[0] % 4 == 0 || c[1] % 4 == 0),
            vec![[1, 0, 1, 0]],
        ),
        ("hollow torus", sheet([7, 7, 3], hollow_torus), vec![[1, 2, 1, 0]]),
        ("two blocks", sheet([5, 2, 2], |[x, ..]| x != 2), vec![[1, 0, 0, 0]; 2]),
        ("two cubes on a cell", separate.build(), vec![[1, 0, 0, 0]; 2]),
        ("Y joint", joint.build(), vec![[1, 0, 0, 0]]),
        ("two cubes with a side", pair.build(), vec![[1, 0, 0, 0]]),
        ("two strips with both ends", strips.build(), vec![[1, 1, 0, 0]]),
        ("two cubes with all sides", sphere.build(), vec![[1, 0, 0, 1]]),
        ("two by two at a face", cross.build(), vec![[1, 0, 0, 0]]),
        ("coil", coil(4, 3), vec![[1, 0, 0, 0]]),
        ("cubes at a corner", sheet([2; 3], |[x, y, z]| x == y && y == z), vec![[1, 0, 0, 0]]),
    ]
}

/// The cells around a closed channel.
fn hollow_torus([x, y, z]: [u32; 3]) -> bool {
    let hole = (x, y) == (3, 3);
    let channel =
        z == 1 && (1..6).contains(&x) && (1..6).contains(&y) && !((2..5).contains(&x) && (2..5).contains(&y));
    !hole && !channel
}
