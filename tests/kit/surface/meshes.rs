//! Small surfaces to be changed: closed, open, and with edges of many triangles.

use glam::DVec3;
use welter_meshing::shapes::{Box_, Sphere, Torus, box_, sphere, torus};
use welter_meshing::surface::{TriMesh, TriangleSoup, VertexId};

/// A surface with a name for messages.
pub type Named = (&'static str, TriMesh);

const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn mesh(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> TriMesh {
    TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() }).expect("a mesh")
}

/// Distinct points with few digits.
fn points(count: u32) -> Vec<DVec3> {
    let at = |i: u32, step: u32| f64::from(i * step % 64) / 64.0;
    (0..count).map(|i| DVec3::new(at(i, 7), at(i, 11), at(i, 27))).collect()
}

/// A tetrahedron, a box, a sphere and a torus.
#[must_use]
pub fn closed_surfaces() -> Vec<Named> {
    let sphere = sphere(&Sphere { edge_length: 0.5, ..Sphere::default() }).expect("a sphere");
    let torus = torus(&Torus { edge_length: 0.5, ..Torus::default() }).expect("a torus");
    let cube = box_(&Box_ { edge_length: 1.0, ..Box_::default() }).expect("a box");
    vec![
        ("tetrahedron", mesh(points(4), TETRAHEDRON.to_vec())),
        ("box", cube.into_mesh()),
        ("sphere", sphere.into_mesh()),
        ("torus", torus.into_mesh()),
    ]
}

/// Tetrahedra around an edge or a vertex, each edge balanced.
#[must_use]
pub fn non_manifold_surfaces() -> Vec<Named> {
    let together = |count: u32, name: fn(u32, u32) -> u32| {
        let triangles = (0..count).flat_map(|i| TETRAHEDRON.map(|t| t.map(|v| name(i, v)))).collect();
        mesh(points(4 * count), triangles)
    };
    // Vertices 0 and 1 are common to all, the others each one's own.
    let at_edge = |i: u32, v: u32| if v < 2 { v } else { v + 2 * i };
    let at_vertex = |i: u32, v: u32| if v < 1 { v } else { v + 3 * i };
    vec![
        ("two tetrahedra at an edge", together(2, at_edge)),
        ("five tetrahedra at an edge", together(5, at_edge)),
        ("three tetrahedra at a vertex", together(3, at_vertex)),
    ]
}

/// A triangle, a square of a grid, and a tube.
#[must_use]
pub fn open_surfaces() -> Vec<Named> {
    let cells = |columns: u32, rows: u32, closed: bool| {
        let width = if closed { columns } else { columns + 1 };
        let at = |x: u32, y: u32| y * width + x % width;
        let cell = |x: u32, y: u32| {
            let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
            [[a, b, c], [a, c, d]]
        };
        let triangles = (0..rows).flat_map(|y| (0..columns).flat_map(move |x| cell(x, y))).collect();
        mesh(points(width * (rows + 1)), triangles)
    };
    vec![
        ("triangle", mesh(points(3), vec![[0, 1, 2]])),
        ("grid", cells(6, 6, false)),
        ("tube", cells(7, 4, true)),
    ]
}

/// The triangles of a tube between two holes of four edges each: the boundaries of the two triangles that were
/// removed there, in their direction. The first corner of one is joined to the corner `turn` of the other.
#[must_use]
pub fn tube_between(one: [VertexId; 4], other: [VertexId; 4], turn: usize) -> Vec<[VertexId; 3]> {
    let back = |i: usize| other[(turn + 8 - i) % 4];
    (0..4)
        .flat_map(|i| {
            let next = (i + 1) % 4;
            [[one[i], one[next], back(i)], [back(i + 1), back(i), one[next]]]
        })
        .collect()
}
