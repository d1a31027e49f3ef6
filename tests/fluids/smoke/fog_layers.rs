//! Sheets as layers: volumes, closedness, ages, what is mixed and what is refused.

use super::{ball, sheet};
use glam::DVec3;
use welter_fluids::smoke::{EmittedShape, FogLayer, FogLayerError};
use welter_meshing::surface::measure::{area, signed_volume};
use welter_meshing::surface::{ClosedOrientedMesh, Topology, TriMesh, TriangleSoup, VertexId};

fn mesh(soup: TriangleSoup) -> TriMesh {
    TriMesh::new(soup).unwrap()
}

fn open_sheet(n: u32) -> TriMesh {
    match sheet(n) {
        EmittedShape::Open(mesh) => mesh,
        EmittedShape::Closed(_) => panic!("a sheet is open"),
    }
}

/// Two meshes side by side.
fn both(a: &TriMesh, b: &TriMesh) -> TriMesh {
    let (mut soup, other) = (a.to_soup(), b.to_soup());
    let base = soup.positions.len() as u32;
    soup.positions.extend(other.positions);
    soup.triangles.extend(other.triangles.iter().map(|t| t.map(|v| base + v)));
    mesh(TriangleSoup { positions: soup.positions, triangles: soup.triangles, ..TriangleSoup::default() })
}

/// A part of the unit sphere around its pole: n rings of vertices up to the angle 1, ever more in a ring, irregularly turned.
fn cap(n: u32) -> TriMesh {
    let mut positions = vec![DVec3::Z];
    let mut triangles = Vec::new();
    for ring in 1..=n {
        let (count, before) = (6 * ring, 6 * (ring - 1));
        let tilt = f64::from(ring) / f64::from(n);
        let base = positions.len() as u32;
        let inner = |k: u32| if before == 0 { 0 } else { base - before + k % before };
        for k in 0..count {
            // Unequal distances along the ring, so that fans are irregular.
            let turn = (f64::from(k) + 0.3 * f64::from(k * (k + ring) % 5 % 2)) / f64::from(count);
            let (s, c) = (turn * std::f64::consts::TAU).sin_cos();
            positions.push(DVec3::new(tilt.sin() * c, tilt.sin() * s, tilt.cos()));
        }
        for side in 0..6 {
            for k in 0..ring {
                let (outer, near) = (side * ring + k, side * (ring - 1) + k);
                triangles.push([base + outer, base + (outer + 1) % count, inner(near)]);
                if k + 1 < ring {
                    triangles.push([inner(near), base + (outer + 1) % count, inner(near + 1)]);
                }
            }
        }
    }
    mesh(TriangleSoup { positions, triangles, ..TriangleSoup::default() })
}

#[test]
fn a_plane_patch_becomes_area_times_thickness() {
    let patch = open_sheet(7);
    for thickness in [0.01, 0.3, 40.0] {
        let layer = FogLayer::new(thickness).close(&patch, &[]).unwrap();
        let volume = signed_volume(&layer.surface);
        assert!((volume / (area(&patch) * thickness) - 1.0).abs() < 1e-12, "{volume}");
        // Twice the triangles, and two for each of the 28 edges of the boundary.
        assert_eq!(layer.surface.triangles().len(), 2 * 98 + 2 * 28);
        assert!(layer.ages.is_empty());
    }
    // In a slanted direction, its part across the patch.
    let slanted = FogLayer { thickness: 0.5, direction: Some(DVec3::new(3.0, -4.0, 0.0)) };
    let volume = signed_volume(&slanted.close(&patch, &[]).unwrap().surface);
    assert!((volume - 0.5 * 0.8).abs() < 1e-12, "{volume}");
}

#[test]
fn the_layer_below_a_cap_has_its_volume_to_order_two() {
    let thickness = 0.2_f64;
    // 2 pi (1 - cos 1) (1 - (1 - t)^3) / 3.
    let exact = std::f64::consts::TAU * (1.0 - 1.0_f64.cos()) * (1.0 - (1.0 - thickness).powi(3)) / 3.0;
    let errors: Vec<f64> = [6, 12, 24, 48]
        .into_iter()
        .map(|n| {
            let layer = FogLayer::new(thickness).close(&cap(n), &[]).unwrap();
            // Every vertex of the lower side is on the smaller sphere, those of the boundary too.
            let vertices = cap(n).positions().len();
            for p in &layer.surface.positions()[vertices..] {
                assert!((p.length() - (1.0 - thickness)).abs() < 1e-12, "{p}");
            }
            (signed_volume(&layer.surface) - exact).abs()
        })
        .collect();
    println!("errors of the volume below a cap: {errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.8..2.2).contains(&order), "{errors:?}");
    }
}

#[test]
fn what_is_closed_stays_and_ages_are_carried() {
    let EmittedShape::Closed(ball) = ball(DVec3::new(3.0, 0.0, 0.0), 0.5, 0.2) else {
        panic!("a ball is closed")
    };
    let patch = open_sheet(3);
    for whole in [both(&ball, &patch), both(&patch, &ball)] {
        let ages: Vec<f64> = (0..whole.positions().len()).map(|v| 0.25 * v as f64).collect();
        let closed = FogLayer::new(0.1).close(&whole, &ages).unwrap();
        let volume = signed_volume(&closed.surface);
        assert!((volume - signed_volume(&ball) - 0.1).abs() < 1e-12, "{volume}");
        let (old, new) = closed.surface.positions().split_at(whole.positions().len());
        assert_eq!(old, whole.positions());
        assert_eq!((new.len(), &closed.ages[..old.len()]), (patch.positions().len(), &ages[..]));
        assert_eq!(closed.surface.triangles()[..whole.triangles().len()], whole.triangles()[..]);
        for (p, age) in new.iter().zip(&closed.ages[old.len()..]) {
            let above = old.iter().position(|q| q.distance(*p + DVec3::new(0.0, 0.1, 0.0)) < 1e-12).unwrap();
            assert_eq!(*age, ages[above]);
        }
        let topology = Topology::of(&closed.surface);
        assert_eq!((topology.components().len(), topology.is_vertex_manifold()), (2, true));
    }
    // Without a sheet there is nothing to do.
    let alone = FogLayer::new(0.1).close(&ball, &[]).unwrap();
    assert_eq!(alone.surface, ball);
    let nothing = FogLayer::new(0.1).close(&mesh(TriangleSoup::default()), &[]).unwrap();
    assert!(nothing.surface.triangles().is_empty());
}

/// A bow-tie, a ring with two boundaries, a triangle by itself, one without area: each closed, oriented and of its volume.
#[test]
fn every_sheet_is_closed() {
    let positions = |list: &[[f64; 2]]| list.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect::<Vec<_>>();
    let bow_tie = (
        positions(&[[0.0, 0.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]]),
        vec![[0, 1, 2], [0, 3, 4]],
    );
    let square = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
    let inner = square.map(|p| p.map(|c| 0.5 * c));
    let ring = (0..4_u32).flat_map(|k| [[k, (k + 1) % 4, 4 + k], [4 + k, (k + 1) % 4, 4 + (k + 1) % 4]]);
    let ring = (positions(&[square, inner].concat()), ring.collect());
    let single = (positions(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), vec![[0, 1, 2]]);
    let flat = (positions(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), vec![[0, 1, 2]]);
    for ((positions, triangles), area) in [(bow_tie, 2.0), (ring, 12.0), (single, 0.5), (flat, 0.0)] {
        let sheet = mesh(TriangleSoup { positions, triangles, ..TriangleSoup::default() });
        let layer = FogLayer::new(0.5).close(&sheet, &[]).unwrap();
        assert!(ClosedOrientedMesh::check(&layer.surface).is_ok());
        assert!((signed_volume(&layer.surface) - 0.5 * area).abs() < 1e-12, "{area}");
    }
}

#[test]
fn scaled_sheets_have_the_same_bits() {
    let cap = cap(5);
    let layer = FogLayer::new(0.3).close(&cap, &[]).unwrap();
    for power in [-300, -40, 1, 300] {
        let factor = 2.0_f64.powi(power);
        let mut soup = cap.to_soup();
        soup.positions.iter_mut().for_each(|p| *p *= factor);
        let scaled = FogLayer::new(0.3 * factor).close(&mesh(soup), &[]).unwrap();
        let pairs = scaled.surface.positions().iter().zip(layer.surface.positions());
        assert!(pairs.into_iter().all(|(&a, &b)| a == factor * b), "2^{power}");
    }
}

#[test]
fn what_makes_no_layer_is_refused() {
    let patch = open_sheet(2);
    for thickness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = FogLayer::new(thickness).close(&patch, &[]);
        assert!(matches!(error, Err(FogLayerError::Thickness { .. })), "{thickness}");
    }
    for direction in [DVec3::ZERO, DVec3::splat(f64::INFINITY), DVec3::new(0.0, f64::NAN, 1.0)] {
        let error = FogLayer { direction: Some(direction), ..FogLayer::new(1.0) }.close(&patch, &[]);
        assert!(matches!(error, Err(FogLayerError::Direction { .. })), "{direction}");
    }
    let error = FogLayer::new(1.0).close(&patch, &[0.0; 2]);
    assert!(matches!(error, Err(FogLayerError::AgeCount { vertices: 9, ages: 2 })));
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE];
    let turned = TriangleSoup { positions, triangles: vec![[0, 1, 2], [1, 2, 3]], ..TriangleSoup::default() };
    let error = FogLayer::new(1.0).close(&mesh(turned), &[]);
    assert!(matches!(error, Err(FogLayerError::NotOriented { edges: 1, first: [VertexId(1), VertexId(2)] })));
    let error = FogLayer { thickness: f64::MAX, direction: Some(-DVec3::Y) };
    let mut far = patch.to_soup();
    far.positions[0].y = -f64::MAX;
    assert!(matches!(error.close(&mesh(far), &[]), Err(FogLayerError::OutOfRange(_))));
}
