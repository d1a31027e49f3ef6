//! Laws: scaling by powers of two, threads, reversal of field and surface, translation; and that a good mesh is left as it is, nearly.

use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::measure::signed_volume;

use super::*;

#[test]
fn scaling_by_a_power_of_two_scales_every_bit() {
    let (mesh, report) = remeshed(&cubes(&grid(11), &blobs), &blobs, 0.18);
    for exponent in [-200, -1, 3, 200] {
        let scale = 2f64.powi(exponent);
        let mut soup = cubes(&grid(11), &blobs).to_soup();
        soup.positions.iter_mut().for_each(|p| *p *= scale);
        let scaled =
            EmbeddedMesh::new(ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap()).unwrap();
        let field = |p: DVec3| blobs(p / scale) * scale;
        let (result, again) = remeshed(&scaled, &field, 0.18 * scale);
        assert_eq!(result.triangles(), mesh.triangles(), "2^{exponent}");
        assert!(result.positions().iter().zip(mesh.positions()).all(|(p, q)| *p == *q * scale));
        assert_eq!((report.moves, report.smallest_angle), (again.moves, again.smallest_angle));
    }
}

#[test]
fn the_unit_of_the_field_does_not_matter() {
    let (mesh, _) = remeshed(&cubes(&grid(10), &ball), &ball, 0.2);
    for unit in [2f64.powi(-300), 2f64.powi(40)] {
        let field = |p: DVec3| ball(p) * unit;
        assert_eq!(remeshed(&cubes(&grid(10), &ball), &field, 0.2).0, mesh);
    }
}

#[test]
fn a_surface_and_a_field_that_are_both_turned_inside_out_give_the_same_turned_inside_out() {
    let start = cubes(&grid(10), &blobs);
    let (mesh, _) = remeshed(&start, &blobs, 0.2);
    // The same surface from a field of the other sign: the sides are told apart by the triangles.
    let (other, _) = remeshed(&start, &|p: DVec3| -blobs(p), 0.2);
    assert_eq!(mesh, other);
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| super::start(&grid(12), &blobs))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn an_exact_translation_changes_rounding_only() {
    let offset = DVec3::new(4.0, -8.0, 16.0);
    let start = cubes(&grid(12), &blobs);
    let mut soup = start.to_soup();
    // Rounded to multiples of 2^-40, both can be expressed.
    let rounded = |p: DVec3| (p * 2f64.powi(40)).round() / 2f64.powi(40);
    soup.positions.iter_mut().for_each(|p| *p = rounded(*p));
    let mut moved = soup.clone();
    moved.positions.iter_mut().for_each(|p| *p += offset);
    let [here, there] = [soup, moved].map(|soup| {
        EmbeddedMesh::new(ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap()).unwrap()
    });
    let (here, _) = remeshed(&here, &blobs, 0.17);
    let (there, _) = remeshed(&there, &|p: DVec3| blobs(p - offset), 0.17);
    assert_eq!(here.triangles(), there.triangles());
    let farthest = here.positions().iter().zip(there.positions()).map(|(p, q)| (*p + offset).distance(*q));
    assert!(farthest.fold(0.0, f64::max) < 1e-9);
}

#[test]
fn a_geodesic_sphere_of_the_right_edge_length_stays_good() {
    let start =
        EmbeddedMesh::new(sphere(&Sphere { edge_length: 0.65, ..Sphere::default() }).unwrap()).unwrap();
    let (mesh, report) = remeshed(&start, &|p: DVec3| p.length() - 1.0, 0.4);
    assert_eq!((report.splits, report.collapses, report.flips), (0, 0, 0));
    assert!(report.smallest_angle.to_degrees() > 50.0, "{}", report.smallest_angle.to_degrees());
    assert!((signed_volume(&mesh) - signed_volume(&start)).abs() < 0.01);
}
