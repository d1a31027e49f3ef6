//! Marching squares: the 16 cases, and contours of drawn and of smooth samples.

use std::f64::consts::PI;

use glam::DVec2;
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::Monitor;
use welter_meshing::grid::{Grid2, Samples};
use welter_meshing::isosurface::SquarePoint::{Corner, Edge};
use welter_meshing::isosurface::{
    CellCase, CellPoint, Contours, IsosurfaceError, MarchingSquares, SquareCase, SquarePoint,
    marching_squares,
};
use welter_predicates::{Sign, orient2d};

fn corner(c: u8) -> DVec2 {
    DVec2::new(f64::from(c & 1), f64::from(c >> 1))
}

fn place(point: SquarePoint, at: [f64; 4]) -> DVec2 {
    let [low, high] = point.ends().map(corner);
    match point {
        Corner(_) => low,
        Edge(e) => low + at[usize::from(e)] * (high - low),
    }
}

fn doubled_area(polygon: &[DVec2]) -> f64 {
    (0..polygon.len()).map(|i| polygon[i].perp_dot(polygon[(i + 1) % polygon.len()])).sum()
}

#[test]
fn triangles_tile_the_polygon_wherever_samples_are() {
    for case in (0..16).map(SquareCase) {
        let polygon = case.polygon();
        assert_eq!(polygon.is_empty(), case.0 == 0);
        assert!(case.0 == 0 || polygon[0] == Corner(case.0.trailing_zeros() as u8));
        for choice in 0..81_usize {
            let at = std::array::from_fn(|e| {
                [1.0 / 1024.0, 0.5, 1.0 - 1.0 / 1024.0][choice / 3_usize.pow(e as u32) % 3]
            });
            let whole = doubled_area(&polygon.iter().map(|&p| place(p, at)).collect::<Vec<_>>());
            let mut sum = 0.0;
            for triangle in case.triangles() {
                let [a, b, c] = triangle.map(|p| place(p, at));
                assert_eq!(orient2d(a, b, c), Sign::Positive, "{case:?} {at:?}");
                sum += doubled_area(&[a, b, c]);
            }
            assert_eq!(sum, whole, "{case:?}: nothing is rounded, the areas are those of dyadic points");
        }
    }
}

#[test]
fn the_rule_is_that_of_the_faces_of_cubes() {
    // The lower face across z, seen from outside, runs the other way round.
    for case in (0..16).map(SquareCase) {
        let as_square = |p: &CellPoint| match *p {
            CellPoint::Corner(c) => Corner(c),
            CellPoint::Edge(_) => {
                (0..4).map(Edge).find(|e| e.ends() == p.ends()).expect("an edge of the face")
            }
        };
        let mut face: Vec<_> = CellCase(case.0).face_polygon(4).iter().map(as_square).collect();
        face.reverse();
        let lowest = face.iter().position(|p| Some(p) == face.iter().min()).unwrap_or(0);
        face.rotate_left(lowest);
        assert_eq!(face, case.polygon());
    }
}

fn contours(samples: &Samples<2>) -> Contours {
    marching_squares(samples, &MarchingSquares::default(), &Monitor::none()).expect("numbers")
}

#[test]
fn contours_of_any_samples_separate_the_signs() {
    for (seed, values) in
        [&[-1.0, 1.0][..], &[-1.0, 0.0, 2.0, -0.0], &[f64::INFINITY, -3.0]].into_iter().enumerate()
    {
        let grid = Grid2::new([-1.0, 2.0], 0.5, [9, 7]).unwrap();
        let choices = stream(seed as u64, grid.node_count());
        let mut entropy = Entropy::new(&choices);
        let samples = Samples::new(grid, (0..grid.node_count()).map(|_| entropy.pick(values)).collect());
        let contours = contours(&samples);
        let mut degrees = vec![[0; 2]; contours.positions.len()];
        for &[a, b] in &contours.segments {
            degrees[a as usize][0] += 1;
            degrees[b as usize][1] += 1;
        }
        let (min, max) = (DVec2::from_array(grid.origin()), DVec2::from_array(grid.max()));
        for (degree, p) in degrees.iter().zip(&contours.positions) {
            let on_wall = p.cmpeq(min).any() || p.cmpeq(max).any();
            assert!(*degree == [1, 1] || on_wall && degree.iter().sum::<i32>() == 1, "{degree:?} at {p}");
        }
        let in_lines: usize = contours.lines().iter().map(|line| line.len() - 1).sum();
        assert_eq!(in_lines, contours.segments.len());
        crossings_change_the_sign(&samples, &contours);
    }
}

/// Between neighbouring nodes of a row, the contour is crossed just where the sign changes.
fn crossings_change_the_sign(samples: &Samples<2>, contours: &Contours) {
    let grid = samples.grid();
    for j in 0..grid.nodes()[1] {
        for i in 0..grid.cells()[0] {
            let [a, b] = [[i, j], [i + 1, j]].map(|node| grid.position(node));
            let between = |p: &&DVec2| p.y == a.y && a.x < p.x && p.x < b.x;
            let changes = (samples.at([i, j]) < 0.0) != (samples.at([i + 1, j]) < 0.0);
            assert_eq!(contours.positions.iter().filter(between).count(), usize::from(changes));
        }
    }
}

#[test]
fn length_and_area_of_a_circle_are_of_second_order() {
    let errors: Vec<[f64; 2]> = [16, 32, 64, 128]
        .into_iter()
        .map(|n| {
            let grid = Grid2::covering([-1.0; 2], [1.0; 2], 2.0 / f64::from(n), 0).unwrap();
            let center = DVec2::new(0.0131, -0.0207);
            let disc = |n| grid.position(grid.node_at(n)).distance(center) - 0.801;
            let contours = contours(&Samples::new(grid, (0..grid.node_count()).map(disc).collect()));
            let ends = contours.segments.iter().map(|s| s.map(|v| contours.positions[v as usize]));
            let length: f64 = ends.clone().map(|[a, b]| a.distance(b)).sum();
            let area: f64 = ends.map(|[a, b]| 0.5 * a.perp_dot(b)).sum();
            [(length - 2.0 * PI * 0.801).abs(), (area - PI * 0.801_f64.powi(2)).abs()]
        })
        .collect();
    for of in 0..2 {
        // Errors of single resolutions scatter by where the circle passes the nodes: the order over the whole ladder.
        let order = (errors[0][of] / errors[3][of]).log2() / 3.0;
        assert!((1.9..2.1).contains(&order), "{of}: {errors:?}");
    }
}

#[test]
fn bad_input_is_named() {
    let grid = Grid2::new([0.0; 2], 1.0, [2, 2]).unwrap();
    let mut values = vec![1.0; 9];
    values[5] = f64::NAN;
    let error = marching_squares(&Samples::new(grid, values), &MarchingSquares::default(), &Monitor::none());
    assert!(matches!(&error, Err(IsosurfaceError::NotANumber(at)) if at.node == [2, 1]), "{error:?}");
}
