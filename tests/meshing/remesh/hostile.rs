//! Whatever field and surface are: the result is closed, oriented, embedded and of the same topology, or there is a typed error.

use std::sync::atomic::AtomicBool;

use welter_kit::entropy::{Entropy, stream};
use welter_meshing::remesh::RemeshError;
use welter_meshing::remesh::connectivity::NotManifold;
use welter_meshing::shapes::{Box_, Sphere, Torus, box_, sphere, torus as torus_mesh};
use welter_meshing::spatial::{Winding, winding_number};
use welter_meshing::surface::TriangleSoup;

use super::*;

fn embedded(soup: TriangleSoup) -> EmbeddedMesh {
    EmbeddedMesh::new(ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap()).unwrap()
}

/// Several surfaces as one.
fn together(parts: &[ClosedOrientedMesh]) -> EmbeddedMesh {
    let mut soup = TriangleSoup::default();
    for part in parts {
        let first = soup.positions.len() as u32;
        soup.positions.extend(part.positions());
        soup.triangles.extend(part.triangles().iter().map(|t| t.map(|v| first + v.0)));
    }
    embedded(soup)
}

fn round(radius: f64, edge_length: f64) -> ClosedOrientedMesh {
    sphere(&Sphere { radius, edge_length, ..Sphere::default() }).unwrap()
}

#[test]
fn walls_a_tenth_of_an_edge_length_apart_stay_apart() {
    let (length, gap) = (0.3, 0.03);
    let shell = |p: DVec3| (p.length() - 1.0).abs() - 0.5 * gap;
    let start = together(&[round(1.0 + 0.5 * gap, 0.25), round(1.0 - 0.5 * gap, 0.25).reversed()]);
    let (mesh, report) = remeshed(&start, &shell, length);
    assert_kept(&start, &mesh);
    // Far thinner: triangles bulge by more than the wall is thick. What would cut through the other side is refused.
    let (mesh, thin) = remeshed(&start, &|p: DVec3| (p.length() - 1.0).abs() - 1e-4, length);
    assert_kept(&start, &mesh);
    println!(
        "{} and {} refused for intersection",
        report.refused_for_intersection, thin.refused_for_intersection
    );
    assert!(report.refused_for_intersection < thin.refused_for_intersection);
    assert!(thin.refused_for_intersection > 0 && thin.off_surface > 0);
}

#[test]
fn a_flat_ellipsoid_thinner_than_its_triangles_stays_embedded() {
    let mut soup = round(1.0, 0.15).into_mesh().into_soup();
    soup.positions.iter_mut().for_each(|p| p.z *= 1e-3);
    let start = embedded(soup);
    let (mesh, _) = remeshed(&start, &|p: DVec3| (p / DVec3::new(1.0, 1.0, 1e-3)).length() - 1.0, 0.25);
    assert_kept(&start, &mesh);
}

#[test]
fn components_smaller_than_an_edge_do_not_vanish() {
    let speck =
        sphere(&Sphere { center: DVec3::new(1.3, 0.0, 0.0), radius: 0.05, edge_length: 0.02 }).unwrap();
    let inner = sphere(&Sphere { center: DVec3::ZERO, radius: 1e-6, edge_length: 1e-6 }).unwrap();
    let start = together(&[round(1.0, 0.3), speck, inner.reversed()]);
    let field = |p: DVec3| {
        let speck = (p - DVec3::new(1.3, 0.0, 0.0)).length() - 0.05;
        (p.length() - 1.0).min(speck).max(1e-6 - p.length())
    };
    let (mesh, report) = remeshed(&start, &field, 0.3);
    assert_kept(&start, &mesh);
    assert!(mesh.triangles().len() < start.triangles().len());
    // The void is still inside of the ball, the speck outside.
    let winding = |x: f64| winding_number(&mesh, DVec3::new(x, 0.01, 0.02));
    assert_eq!([winding(0.5), winding(1.15)], [Winding::Number(1), Winding::Number(0)]);
    assert!(report.edges.min < 0.3);
}

#[test]
fn triangles_of_all_kinds_of_badness() {
    // Random samples: the surface is rough on the scale of the grid, and has slivers of a millionth of a cell.
    for seed in 0..2 {
        let grid = Grid3::new([0.0; 3], 1.0, [4; 3]).unwrap();
        let bytes = stream(seed, 8 * grid.node_count());
        let mut entropy = Entropy::new(&bytes);
        let values = (0..grid.node_count()).map(|_| (entropy.word() % 9) as f64 - 4.0).collect();
        let samples = Samples::new(grid, values);
        let start = marching_cubes(&samples, &MarchingCubes::default(), &Monitor::none()).unwrap();
        let interpolant = |p: DVec3| samples.interpolate(p.to_array());
        let (mesh, report) = remeshed(&start, &interpolant, 0.6);
        assert_kept(&start, &mesh);
        println!(
            "{} refused for shape, {} for intersection",
            report.refused_for_shape, report.refused_for_intersection
        );
        assert!(report.refused_for_shape > 0 && report.refused_for_intersection > 0);
    }
}

#[test]
fn the_interpolant_of_samples_is_a_field_too() {
    let grid = grid(12);
    let samples = Samples::of(&grid, &ball, &Monitor::none()).unwrap();
    let interpolant = |p: DVec3| samples.interpolate(p.to_array());
    let start = cubes(&grid, &ball);
    let (mesh, report) = remeshed(&start, &interpolant, grid.spacing());
    assert_kept(&start, &mesh);
    assert!(report.smallest_angle.to_degrees() > 20.0 && report.edges.near_mean > 0.99);
    assert!(mesh.positions().iter().all(|&p| interpolant(p).abs() < 1e-9));
}

#[test]
fn where_the_field_is_nan_vertices_stay() {
    let field = |p: DVec3| if p.x > 0.3 { f64::NAN } else { p.length() - 1.0 };
    let start = together(&[round(1.0, 0.3)]);
    let (mesh, report) = remeshed(&start, &field, 0.25);
    assert_kept(&start, &mesh);
    assert!(report.off_surface > 0);
    let on = mesh.positions().iter().filter(|p| p.x < 0.2);
    assert!(on.clone().count() > 50 && on.into_iter().all(|p| (p.length() - 1.0).abs() < 1e-9));
    // Nowhere a number, infinite everywhere, and zero everywhere.
    for value in [f64::NAN, f64::INFINITY, 0.0] {
        let (mesh, report) = remeshed(&start, &|_: DVec3| value, 0.25);
        assert_kept(&start, &mesh);
        assert_eq!(report.off_surface > 0, value != 0.0);
    }
}

#[test]
fn a_gradient_of_zero_on_the_surface_is_no_obstacle() {
    let start = together(&[round(1.0, 0.3)]);
    // Of the cube differences tell a slope, but not how flat it is at the zero.
    let fields: [(Field, f64); 2] =
        [(|p| (p.length() - 1.0).powi(3), 5e-6 * 0.25), (|p| (p.length() - 1.0).signum(), 1e-10)];
    for (field, accuracy) in fields {
        let (mesh, report) = remeshed(&start, &field, 0.25);
        assert_kept(&start, &mesh);
        assert!(report.smallest_angle.to_degrees() > 20.0);
        let off = mesh.positions().iter().map(|p| (p.length() - 1.0).abs()).fold(0.0, f64::max);
        assert!(off <= accuracy, "{off:e}");
    }
}

#[test]
fn edges_far_longer_and_far_shorter_than_asked_for() {
    let start = together(&[box_(&Box_ { edge_length: 4.0, ..Box_::default() }).unwrap()]);
    let (mesh, report) = remeshed(&start, &|p: DVec3| p.length() - 1.3, 0.2);
    assert_kept(&start, &mesh);
    assert!(report.smallest_angle.to_degrees() > 20.0 && report.edges.near_mean > 0.99);
    // Most of the box is farther from the ball than vertices are projected; what is near is on it.
    let off = mesh.positions().iter().filter(|p| (p.length() - 1.3).abs() > 1e-9).count() as u64;
    assert!(
        off == report.off_surface
            && (mesh.positions().len() as u64 / 2..mesh.positions().len() as u64).contains(&off)
    );
    let fine =
        EmbeddedMesh::new(torus_mesh(&Torus { edge_length: 0.2, ..Torus::default() }).unwrap()).unwrap();
    let far = |p: DVec3| p.length() - 9.0;
    let (mesh, _) = remeshed(&fine, &far, 20.0);
    assert_kept(&fine, &mesh);
    assert!(mesh.triangles().len() < 40, "{} triangles", mesh.triangles().len());
}

#[test]
fn what_cannot_be_done_is_refused_by_name() {
    let mesh = together(&[round(1.0, 0.5)]);
    let with =
        |parameters: Equilateral| equilateral(&mesh, &ball, &parameters, &Monitor::none()).unwrap_err();
    let default = Equilateral::default();
    for edge_length in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e80] {
        let error = with(Equilateral { edge_length, ..default });
        assert!(matches!(error, RemeshError::Parameter { parameter: "edge_length", .. }), "{error}");
    }
    let error = with(Equilateral { goal_angle: 1.1, ..default });
    assert!(matches!(error, RemeshError::Parameter { parameter: "goal_angle", .. }));
    let error = with(Equilateral { rounds: 1001, ..default });
    assert!(matches!(error, RemeshError::Parameter { parameter: "rounds", .. }));
    assert!(matches!(with(Equilateral { edge_length: 1e-20, ..default }), RemeshError::TooFar { .. }));
    assert!(matches!(
        with(Equilateral { edge_length: 1e-6, ..default }),
        RemeshError::TooManyTriangles { .. }
    ));

    let stop = AtomicBool::new(true);
    let cancelled = equilateral(&mesh, &ball, &default, &Monitor::new(None, Some(&stop)));
    assert!(matches!(cancelled, Err(RemeshError::Cancelled(_))));

    // Two tetrahedra along an edge.
    let positions = [[0., 0., 0.], [0., 0., 1.], [1., 0., 0.], [1., 1., 0.5], [-1., 0., 0.], [-1., -1., 0.5]];
    let corner = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let triangles = [corner, corner.map(|t| t.map(|v| if v < 2 { v } else { v + 2 }))].concat();
    let positions = positions.map(DVec3::from_array).to_vec();
    let joined = embedded(TriangleSoup { positions, triangles, ..TriangleSoup::default() });
    let error = equilateral(&joined, &ball, &default, &Monitor::none()).unwrap_err();
    assert!(matches!(error, RemeshError::NotManifold(NotManifold::Edge { triangles: 4, .. })), "{error}");

    let parameters = StartingMesh { edge_length_rel: 0.0, ..StartingMesh::default() };
    let error = starting_mesh(&grid(4), &ball, &parameters, &Monitor::none()).unwrap_err();
    assert!(matches!(error, RemeshError::Parameter { parameter: "edge_length_rel", .. }));
    let error = starting_mesh(&grid(4), &|_: DVec3| f64::NAN, &StartingMesh::default(), &Monitor::none());
    assert!(matches!(error, Err(RemeshError::Isosurface(_))));
}

#[test]
fn a_needle_of_no_area_is_too_long_all_the_same() {
    let [l, w] = [1e9, 1e-9];
    let positions =
        [[0.0, 0.0, 0.0], [l, 0.0, 0.0], [0.5 * l, w, 0.0], [0.5 * l, 0.0, w]].map(DVec3::from_array);
    let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let needle =
        embedded(TriangleSoup { positions: positions.to_vec(), triangles, ..TriangleSoup::default() });
    let parameters = Equilateral { edge_length: 1.0, ..Equilateral::default() };
    let error = equilateral(&needle, &|p: DVec3| p.y, &parameters, &Monitor::none()).unwrap_err();
    assert!(matches!(error, RemeshError::TooManyTriangles { triangles, .. } if triangles > 2e9), "{error}");
}

#[test]
fn a_surface_without_triangles_stays_without() {
    let nothing = cubes(&grid(4), &|_: DVec3| 1.0);
    let (mesh, report) = remeshed(&nothing, &ball, 0.1);
    assert!(mesh.triangles().is_empty() && report.edges.mean == 0.0);
}
