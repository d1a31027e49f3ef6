//! A twin of another kind: the arrangement of the curves as a constrained Delaunay triangulation, its faces with winding numbers.

use glam::DVec2;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::volumetric::VolumeError;
use welter_meshing::volumetric::plane::ClosedPolylines;

use super::{check, curves, meshed};

/// Random curves of integer corners.
fn drawn(seed: u64) -> ClosedPolylines {
    let bytes = stream(seed, 256);
    let mut entropy = Entropy::new(&bytes);
    let loops: Vec<Vec<[f64; 2]>> = (0..1 + entropy.below(3))
        .map(|_| {
            let n = 3 + i32::from(entropy.below(4));
            let centre = [0, 1].map(|_| f64::from(entropy.between(-30, 30)));
            let turns = std::f64::consts::TAU / f64::from(n);
            let point = |k: i32, entropy: &mut Entropy<'_>| {
                let radius = f64::from(entropy.between(15, 60));
                let a = turns * f64::from(k);
                [centre[0] + (radius * a.cos()).round(), centre[1] + (radius * a.sin()).round()]
            };
            (0..n).map(|k| point(k, &mut entropy)).collect()
        })
        .collect();
    curves(&loops)
}

/// The triangulation of the curves, split where they intersect.
fn arrangement(curves: &ClosedPolylines) -> ConstrainedDelaunayTriangulation<Point2<f64>> {
    let mut triangulation = ConstrainedDelaunayTriangulation::new();
    for segment in 0..curves.len() as u32 {
        let [p, q] = curves.segment(segment).map(|p| triangulation.insert(Point2::new(p.x, p.y)).unwrap());
        triangulation.add_constraint_and_split(p, q, |point| point);
    }
    triangulation
}

/// The winding number in the middle of a face, by the angles under which the segments are seen. Rounded; the middle is far from the curves or the face is not
/// asked for.
fn by_angles(curves: &ClosedPolylines, at: DVec2) -> i32 {
    let angle: f64 = (0..curves.len() as u32)
        .map(|segment| {
            let [p, q] = curves.segment(segment).map(|p| p - at);
            p.perp_dot(q).atan2(p.dot(q))
        })
        .sum();
    (angle / std::f64::consts::TAU).round() as i32
}

#[test]
fn copies_are_those_of_the_faces() {
    let (mut meshed_count, mut deep, mut cells) = (0, 0, 0);
    for seed in 0..60 {
        let curves = drawn(seed);
        let area = match meshed(&curves, 1.5) {
            Ok(area) => area,
            Err(VolumeError::UnderResolved { .. } | VolumeError::Negative { .. }) => continue,
            Err(error) => panic!("seed {seed}: {error}"),
        };
        meshed_count += 1;
        check(&curves, &area);
        let grid = area.mesh.grid();
        let triangulation = arrangement(&curves);
        // Faces are one where no constraint is between: numbers by flooding from the outer face.
        let mut winding = vec![None; triangulation.num_all_faces()];
        for face in triangulation.inner_faces() {
            let c = face.center();
            winding[face.index()] = Some(by_angles(&curves, DVec2::new(c.x, c.y)));
        }
        for edge in triangulation.undirected_edges().filter(|edge| !edge.is_constraint_edge()) {
            let [a, b] = [edge.as_directed(), edge.as_directed().rev()].map(|e| winding[e.face().index()]);
            if let (Some(a), Some(b)) = (a, b) {
                assert_eq!(a, b, "seed {seed}: faces without a curve between");
            }
        }
        let mut at_curve = vec![false; grid.cell_count()];
        area.hosts
            .segments
            .iter()
            .for_each(|pair| at_curve[area.mesh.cells()[pair[0] as usize] as usize] = true);
        let mut copies = vec![0; grid.cell_count()];
        area.mesh.cells().iter().for_each(|&cell| copies[cell as usize] += 1);
        for cell in (0..grid.cell_count()).filter(|&cell| !at_curve[cell]) {
            let middle = grid.position(grid.cell_at(cell)) + DVec2::splat(0.5 * grid.spacing());
            let expected = match triangulation.locate(Point2::new(middle.x, middle.y)) {
                spade::PositionInTriangulation::OnFace(face) => winding[face.index()].unwrap_or(0),
                spade::PositionInTriangulation::OutsideOfConvexHull(_) => 0,
                _ => continue,
            };
            assert_eq!(copies[cell], expected, "seed {seed}, cell at {middle}");
            cells += 1;
            deep += u32::from(expected > 1);
        }
    }
    assert!(meshed_count >= 20 && cells > 20_000 && deep > 500, "{meshed_count} {cells} {deep}");
}
