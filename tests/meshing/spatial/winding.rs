//! Exact winding numbers against solid angles and all triangles in turn.

use super::{SCALES, mapped};
use glam::DVec3;
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::Monitor;
use welter_meshing::shapes::{self, Box_, BoxPair, Sphere, Torus};
use welter_meshing::spatial::{Winding, WindingNumbers, winding_number};
use welter_meshing::surface::{ClosedOrientedMesh, TriId};

fn closed(mesh: welter_meshing::surface::TriMesh) -> ClosedOrientedMesh {
    ClosedOrientedMesh::new(mesh).expect("closed and oriented")
}

/// The sum of the triangles' solid angles, by 4 pi.
fn by_solid_angles(mesh: &ClosedOrientedMesh, p: DVec3) -> f64 {
    let angle = |t: u32| {
        let [a, b, c] = mesh.corners(TriId(t)).map(|q| (q - p).normalize());
        2.0 * a.dot(b.cross(c)).atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
    };
    (0..mesh.triangles().len() as u32).map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

fn surfaces() -> Vec<ClosedOrientedMesh> {
    let edge_length = 0.4;
    let pair = |pair: BoxPair| BoxPair { edge_length: 0.5, ..pair };
    vec![
        shapes::sphere(&Sphere { edge_length, ..Sphere::default() }).unwrap(),
        shapes::sphere(&Sphere { edge_length, ..Sphere::default() }).unwrap().reversed(),
        shapes::torus(&Torus { edge_length, ..Torus::default() }).unwrap(),
        shapes::box_(&Box_ { edge_length: 0.5, ..Box_::default() }).unwrap(),
        shapes::two_boxes(&pair(BoxPair::overlapping())).unwrap(),
        shapes::nested_boxes(&pair(BoxPair::nested())).unwrap(),
        shapes::coincident_boxes(&pair(BoxPair::coincident())).unwrap(),
        shapes::by_name("figure-eight", Some(0.4)).unwrap(),
        shapes::by_name("trefoil-overlap", Some(0.4)).unwrap(),
    ]
}

#[test]
fn numbers_agree_with_solid_angles_and_with_all_triangles() {
    let mut seen = std::collections::BTreeMap::new();
    for mesh in surfaces() {
        let numbers = WindingNumbers::new(&mesh);
        let bytes = stream(5, 6000);
        let entropy = &mut Entropy::new(&bytes);
        for _ in 0..120 {
            // Multiples of 1/16: rays through vertices and along edges are common.
            let p = DVec3::from_array([(); 3].map(|()| f64::from(entropy.between(-24, 24)) / 16.0));
            let found = numbers.at(p);
            assert_eq!(found, winding_number(&mesh, p), "{p}");
            match found {
                Winding::Number(number) => {
                    let angles = by_solid_angles(&mesh, p);
                    assert!((angles - f64::from(number)).abs() < 1e-6, "{p}: {number}, {angles}");
                    *seen.entry(number).or_insert(0) += 1;
                }
                other => *seen.entry(i32::from(other == Winding::NotFinite) + 100).or_insert(0) += 1,
            }
        }
    }
    // Outside, inside, turned inside out, twice inside, on the surface.
    assert!(
        [0, 1, -1, 2, 100].iter().all(|number| seen.get(number).is_some_and(|&count| count > 3)),
        "{seen:?}"
    );
    assert!(!seen.contains_key(&101));
}

#[test]
fn points_of_the_surface_are_recognised() {
    for mesh in surfaces() {
        let numbers = WindingNumbers::new(&mesh);
        for t in (0..mesh.triangles().len() as u32).step_by(7) {
            let corners = mesh.corners(TriId(t));
            let on = |p: DVec3| {
                let Winding::OnSurface { triangle } = numbers.at(p) else { panic!("{p} is a vertex") };
                assert!(triangle <= TriId(t));
                assert_eq!(winding_number(&mesh, p), Winding::OnSurface { triangle });
            };
            corners.into_iter().for_each(on);
        }
    }
}

#[test]
fn every_point_of_a_lattice_about_a_box() {
    // All positions relative to vertices, edges and diagonals.
    let mesh = shapes::box_(&Box_ { edge_length: 0.5, ..Box_::default() }).unwrap();
    let numbers = WindingNumbers::new(&mesh);
    let steps = || (-6..=6).map(|i| f64::from(i) / 4.0);
    let points: Vec<DVec3> =
        steps().flat_map(|x| steps().flat_map(move |y| steps().map(move |z| DVec3::new(x, y, z)))).collect();
    for (p, found) in points.iter().zip(numbers.at_all(&points, &Monitor::none()).unwrap()) {
        let size = p.abs().max_element();
        match found {
            Winding::Number(number) => {
                assert_eq!((number, size != 1.0), (i32::from(size < 1.0), true), "{p}")
            }
            _ => assert_eq!(size, 1.0, "{p}"),
        }
    }
}

#[test]
fn nested_and_overlapping_boxes() {
    let at = |mesh: &ClosedOrientedMesh, x, y, z| winding_number(mesh, DVec3::new(x, y, z));
    let overlapping = shapes::two_boxes(&BoxPair::overlapping()).unwrap();
    assert_eq!(at(&overlapping, 0.5, 0.5, 0.5), Winding::Number(2));
    assert_eq!(at(&overlapping, 0.0, 0.0, 0.0), Winding::Number(1));
    assert_eq!(at(&overlapping, 2.0, 2.0, 2.0), Winding::Number(1));
    assert_eq!(at(&overlapping, -0.5, 2.0, 0.5), Winding::Number(0));
    let hollow = shapes::nested_boxes(&BoxPair { second_reversed: true, ..BoxPair::nested() }).unwrap();
    assert_eq!(at(&hollow, 0.0, 0.0, 0.0), Winding::Number(0));
    assert_eq!(at(&hollow, 0.75, 0.0, 0.0), Winding::Number(1));
}

#[test]
fn scales_threads_and_far_points() {
    let mesh = shapes::two_boxes(&BoxPair { edge_length: 0.5, ..BoxPair::overlapping() }).unwrap();
    let points: Vec<DVec3> = (0..400)
        .map(|i| DVec3::new(f64::from(i % 7) - 2.0, f64::from(i % 11) - 3.0, f64::from(i % 13)) / 3.0)
        .collect();
    let expected = WindingNumbers::new(&mesh).at_all(&points, &Monitor::none()).unwrap();
    for threads in [1, 3] {
        let found =
            super::on_threads(threads, || WindingNumbers::new(&mesh).at_all(&points, &Monitor::none()));
        assert_eq!(found, Ok(expected.clone()));
    }
    for [a, b] in SCALES {
        let scale = |p: DVec3| p * a * b;
        let back = |p: DVec3| p / b / a;
        // Where no bit is lost.
        let scaled = mapped(&mesh, scale);
        if scaled.positions().iter().zip(mesh.positions()).all(|(s, p)| back(*s) == *p) {
            let kept: Vec<usize> =
                (0..points.len()).filter(|&i| back(scale(points[i])) == points[i]).collect();
            let moved: Vec<DVec3> = kept.iter().map(|&i| scale(points[i])).collect();
            let found = WindingNumbers::new(&closed(scaled)).at_all(&moved, &Monitor::none()).unwrap();
            assert!(found.into_iter().eq(kept.iter().map(|&i| expected[i])), "{a:e} {b:e}");
        }
    }
    let numbers = WindingNumbers::new(&mesh);
    for p in [DVec3::MAX, DVec3::MIN, DVec3::new(-1e300, 0.1, 0.1), DVec3::splat(1e-320) - 1e9] {
        assert_eq!(numbers.at(p), Winding::Number(0));
    }
    assert!(matches!(numbers.at(DVec3::splat(1e-320)), Winding::Number(1)));
    for p in [DVec3::NAN, DVec3::INFINITY, DVec3::new(f64::NEG_INFINITY, 0.0, 0.0)] {
        assert_eq!(numbers.at(p), Winding::NotFinite);
        assert_eq!(winding_number(&mesh, p), Winding::NotFinite);
    }
}
