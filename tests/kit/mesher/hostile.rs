//! Surfaces that are closed and oriented and nothing more: [`soup`].

use glam::DVec3;
use welter_meshing::surface::ClosedOrientedMesh;

use super::Random;
use super::solid::surface_of;

/// A surface made of whole tetrahedra and double sheets over few vertices.
#[derive(Clone, Debug)]
pub struct Soup {
    /// The surface.
    pub surface: ClosedOrientedMesh,
    /// A size of cells that suits it; its coordinates may lie on the planes of the grid.
    pub spacing: f64,
    /// Whether no tetrahedron is inside out, so that no point is of negative depth.
    pub positive: bool,
}

/// The sides of a tetrahedron, outward.
const SIDES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// The soup of a seed.
#[must_use]
pub fn soup(seed: u64) -> Soup {
    let random = &mut Random::new(seed ^ 0x5eed_0000_0000_0000);
    let spacing = 0.25;
    let step = [0.25, 0.125, 1e-3, 0.0][random.below(4) as usize];
    let needle = random.below(4) == 0;
    let count = 4 + random.below(8) as usize;
    let positions: Vec<DVec3> = (0..count)
        .map(|_| {
            let p = random.point();
            let p = if needle { DVec3::new(p.x, p.y * 1e-9, p.z * 1e-4) } else { p };
            // On planes of the grid, between them, or anywhere; several may lie at one place.
            if step > 0.0 { (p / step).round() * step } else { p }
        })
        .collect();
    let positive = random.below(3) > 0;
    let mut triangles = Vec::new();
    let distinct = |random: &mut Random, n: usize| -> Vec<u32> {
        let mut list: Vec<u32> = Vec::new();
        while list.len() < n {
            let v = random.below(count as u64) as u32;
            if !list.contains(&v) {
                list.push(v);
            }
        }
        list
    };
    for _ in 0..1 + random.below(6) {
        let mut tet = distinct(random, 4);
        let [a, b, c, d] = [0, 1, 2, 3].map(|n: usize| positions[tet[n] as usize]);
        // Exact for small multiples of the steps; for others the sign of a flat one does not matter to `positive`.
        let volume = welter_predicates::orient3d(a, b, c, d);
        if volume == welter_predicates::Sign::Positive && (positive || random.below(2) == 0) {
            tet.swap(0, 1);
        }
        let copies = if random.below(8) == 0 { 1 + random.below(5) } else { 1 };
        for _ in 0..copies {
            triangles.extend(SIDES.map(|side| side.map(|n| tet[n])));
        }
    }
    for _ in 0..random.below(4) {
        // A double sheet: a triangle both ways.
        let t = distinct(random, 3);
        triangles.extend([[t[0], t[1], t[2]], [t[1], t[0], t[2]]]);
    }
    for place in (1..triangles.len()).rev() {
        triangles.swap(place, random.below(place as u64 + 1) as usize);
    }
    Soup { surface: surface_of(positions, triangles), spacing, positive }
}
