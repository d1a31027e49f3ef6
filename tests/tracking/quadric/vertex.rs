//! Ranks, normals and spaces of vertices of known surfaces.

use glam::DVec3;
use welter_kit::mesher::Random;
use welter_kit::surface::{closed_surfaces, non_manifold_surfaces, open_surfaces};
use welter_meshing::shapes::{Box_, Sphere, box_, sphere};
use welter_meshing::surface::{TriMesh, TriangleSoup, VertexId};
use welter_tracking::quadric::VertexQuadric;
use welter_tracking::surface::MovingSurface;

fn mesh(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> TriMesh {
    TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() }).unwrap()
}

#[test]
fn a_cube_has_faces_ridges_and_corners() {
    let cube = MovingSurface::new(&box_(&Box_ { edge_length: 0.25, ..Box_::default() }).unwrap()).unwrap();
    for vertex in cube.connectivity().vertices() {
        let position = cube.position(vertex);
        let sides = position.to_array().map(|c| if c.abs() == 1.0 { c } else { 0.0 });
        let sides = DVec3::from_array(sides);
        let expected = sides.length_squared() as usize;
        let quadric = VertexQuadric::new(&cube, vertex);
        for threshold in [1e-9, 0.03, 0.15] {
            assert_eq!(quadric.rank(threshold), expected, "{position}");
        }
        assert!((quadric.eigenvalues.iter().sum::<f64>() - 1.0).abs() < 1e-15);
        // Along the face or ridge nothing changes.
        let moved = quadric.null_part(sides, 0.03);
        assert!(moved.length() < 1e-15, "{position}: {moved}");
        assert!((quadric.primary_part(sides, 0.03) - sides).length() < 1e-15);
        assert!(quadric.normal().dot(sides) > 0.9, "{position}: {}", quadric.normal());
    }
}

#[test]
fn two_planes_have_the_ratio_of_their_angle() {
    // A ridge along x, each side two triangles of the same area.
    for degrees in [1.0_f64, 5.0, 20.0, 60.0, 89.0] {
        let half = 0.5 * degrees.to_radians();
        let at = |x: f64, y: f64| DVec3::new(x, y * half.cos(), -y.abs() * half.sin());
        let positions = vec![at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(-1.0, 0.0), at(0.0, -1.0)];
        let fan = mesh(positions, vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]);
        let quadric = VertexQuadric::new(&MovingSurface::new(&fan).unwrap(), VertexId(0));
        let ratio = quadric.eigenvalues[1] / quadric.eigenvalues[0];
        assert!((ratio - half.tan().powi(2)).abs() < 1e-14, "{degrees}: {ratio}");
        assert!((quadric.normal() - DVec3::Z).length() < 1e-15);
    }
}

#[test]
fn spheres_are_smooth_with_radial_normals() {
    let mut worst = Vec::new();
    for edge_length in [0.2, 0.1, 0.05] {
        let ball = sphere(&Sphere { radius: 1.0, edge_length, ..Sphere::default() }).unwrap();
        let ball = MovingSurface::new(&ball).unwrap();
        let mut largest: f64 = 0.0;
        for vertex in ball.connectivity().vertices() {
            let quadric = VertexQuadric::new(&ball, vertex);
            assert_eq!(quadric.rank(0.03), 1);
            largest = largest.max((quadric.normal() - ball.position(vertex)).length());
        }
        worst.push(largest);
    }
    println!("largest error of normals of spheres: {worst:?}");
    for pair in worst.windows(2) {
        assert!(pair[1] < 0.6 * pair[0], "{worst:?}");
    }
}

#[test]
fn every_surface_times_a_power_of_two_has_the_same_quadrics() {
    let surfaces = closed_surfaces().into_iter().chain(non_manifold_surfaces()).chain(open_surfaces());
    for (name, original) in surfaces {
        let quadrics = |k: i32| {
            let mut soup = original.to_soup();
            soup.positions.iter_mut().for_each(|p| *p *= 2f64.powi(k));
            let surface = MovingSurface::new(&TriMesh::new(soup).unwrap()).unwrap();
            let all = surface.connectivity().vertices().map(|v| VertexQuadric::new(&surface, v));
            all.map(|q| (q.eigenvalues, q.eigenvectors, q.normal())).collect::<Vec<_>>()
        };
        let expected = quadrics(0);
        for k in [-900, -300, -1, 1, 60, 500, 1000] {
            assert_eq!(quadrics(k), expected, "{name} times 2^{k}");
        }
    }
}

#[test]
fn surfaces_without_area_and_with_huge_and_tiny_triangles_have_finite_quadrics() {
    let mut random = Random::new(41);
    let place = |random: &mut Random, kind: u64| match kind % 4 {
        0 => DVec3::ZERO,
        1 => random.point() * 1e-300,
        2 => random.point() * f64::MAX,
        _ => random.point(),
    };
    for case in 0..2000 {
        let positions: Vec<DVec3> = (0..4).map(|i| place(&mut random, case >> (2 * i))).collect();
        let tetrahedron = mesh(positions, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        let surface = MovingSurface::new(&tetrahedron).unwrap();
        for vertex in surface.connectivity().vertices() {
            let quadric = VertexQuadric::new(&surface, vertex);
            assert!(quadric.eigenvalues.iter().all(|value| value.is_finite()), "{quadric:?}");
            assert!(quadric.eigenvectors.iter().all(|e| (e.length() - 1.0).abs() < 1e-14), "{quadric:?}");
            assert!((quadric.normal().length() - 1.0).abs() < 1e-14, "{quadric:?}");
        }
    }
    let flat = mesh(vec![DVec3::ZERO, DVec3::X, 2.0 * DVec3::X], vec![[0, 1, 2]]);
    let quadric = VertexQuadric::new(&MovingSurface::new(&flat).unwrap(), VertexId(0));
    assert_eq!((quadric.rank(0.03), quadric.eigenvalues), (0, [0.0; 3]));
}
