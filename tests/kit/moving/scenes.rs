//! Embedded surfaces with gaps from wide to a few units in the last place.

use crate::mesher::Random;
use glam::DVec3;
use welter_meshing::shapes::{Box_, Sphere, Torus, box_, sphere, torus};
use welter_meshing::surface::{TriMesh, TriangleSoup};

/// A surface with a name for messages.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What it is.
    pub name: &'static str,
    /// The surface.
    pub mesh: TriMesh,
}

fn together(name: &'static str, parts: &[(&TriMesh, &dyn Fn(DVec3) -> DVec3)]) -> Scene {
    let mut soup = TriangleSoup::default();
    for (mesh, place) in parts {
        let first = soup.positions.len() as u32;
        soup.positions.extend(mesh.positions().iter().map(|&p| place(p)));
        soup.triangles.extend(mesh.triangles().iter().map(|t| t.map(|v| first + v.0)));
    }
    Scene { name, mesh: TriMesh::new(soup).expect("finite and in range") }
}

/// A square of cells with two triangles each, from the origin along x and y.
#[must_use]
pub fn sheet(cells: u32, width: f64) -> TriMesh {
    let at = |i: u32| width * f64::from(i) / f64::from(cells);
    let positions =
        (0..=cells).flat_map(|y| (0..=cells).map(move |x| DVec3::new(at(x), at(y), 0.0))).collect();
    let id = |x: u32, y: u32| y * (cells + 1) + x;
    let cell = |x: u32, y: u32| {
        let [a, b, c, d] = [id(x, y), id(x + 1, y), id(x + 1, y + 1), id(x, y + 1)];
        if (x + y).is_multiple_of(2) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
    };
    let triangles = (0..cells).flat_map(|y| (0..cells).flat_map(move |x| cell(x, y))).collect();
    TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() }).expect("a sheet")
}

/// Sheets above each other, shifted against each other, with a gap.
#[must_use]
pub fn stack(layers: u32, cells: u32, width: f64, gap: f64) -> TriMesh {
    let sheet = sheet(cells, width);
    let mut soup = TriangleSoup::default();
    for layer in 0..layers {
        let first = soup.positions.len() as u32;
        let shift = DVec3::new(0.01 * width, 0.017 * width, gap) * f64::from(layer);
        soup.positions.extend(sheet.positions().iter().map(|&p| p + shift));
        soup.triangles.extend(sheet.triangles().iter().map(|t| t.map(|v| first + v.0)));
    }
    TriMesh::new(soup).expect("a stack")
}

/// The mean length of the edges of triangles.
#[must_use]
pub fn mean_edge_length(mesh: &TriMesh) -> f64 {
    let at = |v: welter_meshing::surface::VertexId| mesh.positions()[v.index()];
    let lengths = mesh.triangles().iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let (sum, count) = lengths.fold((0.0, 0), |(sum, n), (p, q)| (sum + at(p).distance(at(q)), n + 1));
    sum / f64::from(count.max(1))
}

/// Embedded surfaces of some fifty to five hundred triangles.
///
/// # Panics
/// If a shape cannot be made, which does not happen.
#[must_use]
pub fn scenes(random: &mut Random) -> Vec<Scene> {
    let ball =
        |edge_length| sphere(&Sphere { edge_length, ..Sphere::default() }).expect("a sphere").into_mesh();
    let coarse = ball(0.9);
    let ring = torus(&Torus { edge_length: 0.45, ..Torus::default() }).expect("a torus").into_mesh();
    let cube = box_(&Box_ { edge_length: 1.0, ..Box_::default() }).expect("a box").into_mesh();
    let low = cube.positions().iter().fold(DVec3::INFINITY, |m, &p| m.min(p));
    let high = cube.positions().iter().fold(DVec3::NEG_INFINITY, |m, &p| m.max(p));
    let height = high.z - low.z;
    let identity = |p: DVec3| p;
    let far = DVec3::new(1e6, -2e6, 0.7e6);
    let direction = random.point().normalize_or(DVec3::X);
    let thin = [1e-2, 1e-6, 1e-12][random.below(3) as usize];
    let gap = thin * height;
    vec![
        together("sphere", &[(&ball(0.6), &identity)]),
        together("torus", &[(&ring, &identity)]),
        together(
            "nested spheres",
            &[
                (&coarse, &identity),
                (&coarse, &|p| (1.0 - 10.0 * thin) * p),
                (&coarse, &|p| 0.4 * p + 0.1 * direction),
            ],
        ),
        together(
            "two spheres side by side",
            &[(&coarse, &identity), (&coarse, &|p| p + (2.0 + thin) * direction)],
        ),
        together(
            "stacked boxes",
            &[
                (&cube, &identity),
                (&cube, &|p| p + DVec3::new(0.3, 0.2, height + gap)),
                (&cube, &|p| p + DVec3::new(-0.2, 0.1, 2.0 * (height + gap))),
            ],
        ),
        together(
            "stacked boxes a few units apart",
            &[
                (&cube, &identity),
                (&cube, &|p| DVec3::new(p.x + 0.3, p.y + 0.2, (p.z + height).next_up_by(3))),
            ],
        ),
        together(
            "far from the origin",
            &[(&coarse, &|p| p + far), (&coarse, &|p| p + far + 2.1 * direction)],
        ),
        Scene { name: "sheets", mesh: stack(3, 4, 4.0, thin) },
        together(
            "a sheet above a ball",
            &[(&coarse, &identity), (&sheet(5, 3.0), &|p| p + DVec3::new(-1.5, -1.5, 1.0 + thin))],
        ),
    ]
}

trait Ulps {
    fn next_up_by(self, count: u32) -> Self;
}

impl Ulps for f64 {
    fn next_up_by(self, count: u32) -> Self {
        (0..count).fold(self, |x, _| x.next_up())
    }
}
