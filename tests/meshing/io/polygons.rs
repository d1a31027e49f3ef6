//! Polygons become triangles of the same orientation that cover them once.

use super::read;
use proptest::prelude::*;
use std::collections::BTreeMap;
use welter_meshing::io::Format;

/// Reads one polygon of integer corners as OBJ.
fn triangulate(corners: &[[i64; 3]]) -> Vec<[u32; 3]> {
    let mut file = String::new();
    for [x, y, z] in corners {
        file += &format!("v {x} {y} {z}\n");
    }
    file += "f";
    for k in 1..=corners.len() {
        file += &format!(" {k}");
    }
    read(Format::Obj, file).unwrap().triangles
}

/// The directed edges of the triangles, less those met in both directions, are the polygon's.
fn assert_same_boundary(n: usize, triangles: &[[u32; 3]]) {
    assert_eq!(triangles.len(), n - 2);
    let mut edges = BTreeMap::new();
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry((*from, *to)).or_insert(0) += 1;
            *edges.entry((*to, *from)).or_insert(0) -= 1;
        }
    }
    edges.retain(|_, count| *count > 0);
    let expected: BTreeMap<_, _> = (0..n).map(|k| ((k as u32, ((k + 1) % n) as u32), 1)).collect();
    assert_eq!(edges, expected);
}

/// Twice the area vector of a triangle.
fn area([a, b, c]: [[i64; 3]; 3]) -> [i64; 3] {
    let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// Every triangle turns as the polygon and none has zero area (`strict`), so that the areas, whose sum is the polygon's by
/// the boundary, do not overlap.
fn assert_covered(corners: &[[i64; 3]], strict: bool) {
    let triangles = triangulate(corners);
    assert_same_boundary(corners.len(), &triangles);
    let areas: Vec<_> = triangles.iter().map(|t| area(t.map(|i| corners[i as usize]))).collect();
    let sum = areas.iter().fold([0; 3], |s, a| [0, 1, 2].map(|k| s[k] + a[k]));
    for a in &areas {
        let turn: i64 = (0..3).map(|k| a[k] * sum[k]).sum();
        assert!(if strict { turn > 0 } else { turn >= 0 }, "{corners:?} {triangles:?}");
    }
}

#[test]
fn known_shapes_are_covered_from_any_first_corner() {
    let flat = |points: &[[i64; 2]]| -> Vec<[i64; 3]> { points.iter().map(|p| [p[0], p[1], 0]).collect() };
    for shape in [
        flat(&[[0, 0], [4, 0], [4, 4], [0, 4]]),
        flat(&[[0, 0], [4, 0], [1, 1], [0, 4]]), // a dart: one of its fans folds over
        flat(&[[0, 0], [2, 0], [4, 0], [4, 4], [0, 4]]), // a corner on an edge
        flat(&[[0, 0], [4, 0], [4, 1], [1, 1], [1, 4], [0, 4]]), // an L
        flat(&[
            [0, 0],
            [7, 0],
            [7, 7],
            [2, 7],
            [2, 3],
            [4, 3],
            [4, 5],
            [3, 5],
            [3, 4],
            [3, 6],
            [6, 6],
            [6, 1],
            [1, 1],
            [1, 8],
            [0, 8],
        ]),
        flat(&[[0, 0], [1, 9], [2, 0], [3, 9], [4, 0], [5, 9], [6, 0], [6, -1], [0, -1]]), // a comb
    ] {
        for first in 0..shape.len() {
            let mut corners = shape.clone();
            corners.rotate_left(first);
            assert_covered(&corners, true);
            corners.reverse();
            assert_covered(&corners, true);
            for plane in [
                |p: [i64; 3]| [p[2], p[0], p[1]],
                |p: [i64; 3]| [p[1], p[2], p[0]],
                |p: [i64; 3]| [p[0], p[1], 3 * p[0] - 5 * p[1]],
            ] {
                let turned: Vec<_> = corners.iter().map(|p| plane(*p)).collect();
                assert_covered(&turned, true);
            }
        }
    }
}

/// A band along a spiral: few ears at a time, and most corners of one side see nothing of the other.
#[test]
fn spirals_are_covered() {
    let turn = |k: u32, narrower: f64| {
        let angle = 0.15 * f64::from(k);
        let radius = 500.0 + 200.0 * angle + 90.0 * f64::from(k % 2) - narrower;
        [(radius * angle.cos()).round() as i64, (radius * angle.sin()).round() as i64, 0]
    };
    let mut corners: Vec<_> = (0..150).map(|k| turn(k, 0.0)).collect();
    corners.extend((0..150).rev().map(|k| turn(k, 250.0)));
    for first in [0, 40, 149, 150, 222] {
        let mut corners = corners.clone();
        corners.rotate_left(first);
        assert_covered(&corners, true);
        corners.reverse();
        assert_covered(&corners, true);
    }
}

#[test]
fn polygons_without_an_inside_keep_their_boundary() {
    for corners in [
        vec![[1, 1, 1]; 6],
        (0..7).map(|k| [k, 2 * k, -k]).collect(),
        vec![[0, 0, 0], [4, 4, 0], [4, 0, 0], [0, 4, 0]], // a bow tie: its area vector is zero
        vec![[0, 0, 0], [5, 0, 0], [0, 3, 0], [4, 3, 0], [2, -2, 0]], // a star that crosses itself
        (0..4000).map(|k| [k % 2, k, 0]).collect(),       // more corners than are clipped
    ] {
        assert_same_boundary(corners.len(), &triangulate(&corners));
    }
}

#[test]
fn huge_and_not_finite_corners_keep_their_boundary() {
    let dart =
        |s: &str| format!("v 0 0 0\nv 4e{s} 0 0\nv 1e{s} 1e{s} 0\nv 0 4e{s} 0\nf 2 3 4 1\nf 1 2 3 4\n");
    for exponent in ["307", "-320", "0"] {
        assert_eq!(
            read(Format::Obj, dart(exponent)).unwrap().triangles[..2],
            [[2, 3, 0], [2, 0, 1]],
            "{exponent}"
        );
    }
    let file = "v 0 0 nan\nv 1 0 inf\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 4 3 2 1 4\n";
    assert_eq!(read(Format::Obj, file).unwrap().triangles.len(), 5);
}

proptest! {
    /// Polygons between two chains over the same columns are simple; corners in line are frequent.
    #[test]
    fn monotone_polygons_are_covered(
        columns in prop::collection::vec((0..5_i64, 1..5_i64), 1..40),
        first in 0..100_usize,
        slope in [-3..3_i64, -3..3_i64],
        reversed in any::<bool>(),
    ) {
        let width = columns.len() as i64 + 1;
        let mut corners = vec![[0, 0, 0]];
        corners.extend(columns.iter().enumerate().map(|(k, (below, _))| [k as i64 + 1, -below, 0]));
        corners.push([width, 0, 0]);
        corners.extend(columns.iter().enumerate().rev().map(|(k, (_, above))| [k as i64 + 1, *above, 0]));
        for p in &mut corners {
            p[2] = slope[0] * p[0] + slope[1] * p[1];
        }
        let n = corners.len();
        corners.rotate_left(first % n);
        if reversed {
            corners.reverse();
        }
        assert_covered(&corners, false);
    }

    #[test]
    fn any_polygon_keeps_its_boundary(corners in prop::collection::vec([-3..4_i64, -3..4, -3..4], 3..30)) {
        assert_same_boundary(corners.len(), &triangulate(&corners));
    }
}
