//! Laws: what renumbering, reversing, exact moves and powers of two change, and what not; and threads.

use super::*;
use welter_kit::generate::number;
use welter_meshing::shapes;
use welter_meshing::surface::measure::*;

fn meshes() -> Vec<TriMesh> {
    shapes::NAMES.iter().map(|shape| shapes::by_name(shape.name, Some(0.2)).unwrap().into_mesh()).collect()
}

#[test]
fn renumbering_changes_no_count() {
    for (i, mesh) in meshes().iter().enumerate() {
        let other = renumbered(mesh, i as u64);
        let (a, b) = (Topology::of(mesh), Topology::of(&other));
        assert_eq!(a.euler_characteristic(), b.euler_characteristic());
        assert_eq!(a.genus(), b.genus());
        assert_eq!(a.edges().len(), b.edges().len());
        let sizes = |t: &Topology| {
            let mut sizes: Vec<_> =
                t.components().iter().map(|c| (c.triangles, c.vertices, c.genus)).collect();
            sizes.sort_unstable();
            sizes
        };
        assert_eq!(sizes(&a), sizes(&b));
        assert_eq!(duplicate_vertices(mesh).len(), duplicate_vertices(&other).len());
        let volume = signed_volume_bounded(mesh);
        let difference = (volume.value() - signed_volume(&other)).abs();
        assert!(difference <= 2.0 * volume.error_bound());
        assert_eq!(bounding_box(mesh), bounding_box(&other));
        let histogram = |m: &TriMesh| angle_statistics(m).unwrap().histogram;
        assert_eq!(histogram(mesh).iter().sum::<u64>(), histogram(&other).iter().sum::<u64>());
        assert!(ClosedOrientedMesh::check(&other).is_ok());
    }
}

#[test]
fn reversing_negates_the_volume_and_keeps_area_and_curvature() {
    for mesh in meshes() {
        let other = mesh.clone().reversed();
        let volume = signed_volume_bounded(&mesh);
        assert!((volume.value() + signed_volume(&other)).abs() <= 2.0 * volume.error_bound());
        assert!((area(&mesh) - area(&other)).abs() <= 2.0 * area_bounded(&mesh).error_bound());
        let [a, b] = [&mesh, &other].map(|m| mean_curvature_normals(m).normals);
        assert!(a.iter().zip(&b).all(|(a, b)| a.distance(*b) <= 1e-9 * (1.0 + a.length())));
        let (a, b) = (Topology::of(&mesh), Topology::of(&other));
        assert_eq!(a.edges(), b.edges());
        assert_eq!(a.genus(), b.genus());
        assert_eq!(other.reversed(), mesh);
    }
}

#[test]
fn exact_translations_change_no_bit_of_volume_and_area() {
    for mesh in meshes() {
        // On a grid of 2^-30, so that the translation by small integers is exact.
        let grid = number::power_of_two(30);
        let mesh = moved(&mesh, |p| (p * grid).round() / grid);
        let other = moved(&mesh, |p| p + DVec3::new(1024.0, -77.0, 5.5));
        assert_eq!(signed_volume(&mesh).to_bits(), signed_volume(&other).to_bits());
        assert_eq!(area(&mesh).to_bits(), area(&other).to_bits());
        assert_eq!(angle_statistics(&mesh), angle_statistics(&other));
        assert_eq!(mean_curvature_normals(&mesh), mean_curvature_normals(&other));
    }
}

#[test]
fn powers_of_two_scale_the_bits() {
    for mesh in meshes() {
        for exponent in [-3, 1, 100, -100] {
            let scale = number::power_of_two(exponent);
            let other = moved(&mesh, |p| p * scale);
            assert_eq!(signed_volume(&other), signed_volume(&mesh) * scale * scale * scale);
            assert_eq!(area(&other), area(&mesh) * scale * scale);
            assert_eq!(angle_statistics(&mesh), angle_statistics(&other));
            let [a, b] = [&mesh, &other].map(|m| mean_curvature_normals(m).normals);
            assert!(a.iter().zip(&b).all(|(a, b)| *a == *b * scale));
        }
    }
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let mesh = shapes::by_name("double-moebius", Some(0.03)).unwrap();
    let everything = || {
        let topology = Topology::of(&mesh);
        let text = format!(
            "{topology:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?}",
            duplicate_vertices(&mesh),
            duplicate_triangles(&mesh, &topology),
            degenerate_triangles(&mesh),
            area_bounded(&mesh),
            component_volumes(&mesh, &topology),
            mean_curvature_normals(&mesh),
            angle_statistics(&mesh),
            edge_length_statistics(&mesh, &topology),
        );
        (text, bounding_box(&mesh))
    };
    let one = with_threads(1, everything);
    for threads in [2, 3, 8] {
        assert!(with_threads(threads, everything) == one, "{threads} threads");
    }
}
