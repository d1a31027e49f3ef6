//! Tests of `welter_meshing::cut_cells`: geometry against the whole surface, quadrature against closed forms.

use glam::DVec3;
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::Monitor;
use welter_meshing::cut_cells::{
    BOUNDARY_DEGREE, CellKind, CutCells, DIVERGENCE_DEGREE, LUMPED_MASS_DEGREE, MASS_DEGREE,
};
use welter_meshing::field::ScalarField;
use welter_meshing::grid::{Grid3, Samples};
use welter_meshing::isosurface::{MarchingCubes, marching_cubes, marching_cubes_open};
use welter_meshing::quadrature::{CubeRule, TetrahedronRule, TriangleRule};
use welter_meshing::surface::measure::{area, signed_volume};

fn cut(samples: &Samples<3>) -> CutCells {
    CutCells::new(samples, &MarchingCubes::default(), &Monitor::none()).expect("numbers")
}

fn sampled(field: &impl ScalarField, n: u32) -> Samples<3> {
    let grid = Grid3::covering([-1.0; 3], [1.0; 3], 2.0 / f64::from(n), 0).expect("exact");
    Samples::of(&grid, field, &Monitor::none()).expect("nobody stops")
}

/// Samples of few values, so that every case, ambiguous ones too, is there.
fn drawn(seed: u64, cells: [u32; 3]) -> Samples<3> {
    let grid = Grid3::new([-1.0, 0.5, 2.0], 0.25, cells).expect("exact");
    let choices = stream(seed, grid.node_count());
    let mut entropy = Entropy::new(&choices);
    Samples::new(grid, (0..grid.node_count()).map(|_| entropy.pick(&[-1.0, 0.3, -0.4, 1.0, 0.0])).collect())
}

fn inputs() -> Vec<Samples<3>> {
    let bumps = |p: DVec3| (3.0 * p.x).sin() * (2.0 * p.y).cos() + 0.7 * (4.0 * p.z + p.x).sin() - 0.1;
    vec![
        sampled(&|p: DVec3| p.distance(DVec3::new(0.1, 0.2, -0.05)) - 0.7, 12),
        sampled(&bumps, 15),
        drawn(1, [7, 6, 5]),
        drawn(2, [66, 2, 3]),
    ]
}

#[test]
fn volumes_and_areas_add_up_to_those_of_the_surface() {
    for samples in inputs() {
        let cells = cut(&samples);
        let (parameters, nobody) = (MarchingCubes::default(), Monitor::none());
        let closed = marching_cubes(&samples, &parameters, &nobody).unwrap();
        let open = marching_cubes_open(&samples, &parameters, &nobody).unwrap();
        assert_eq!(cells.positions(), open.positions());
        let (volume, surface) = (signed_volume(&closed), area(&open));
        assert!((cells.volume() - volume).abs() <= 1e-14 * volume, "{} {volume}", cells.volume());
        assert!((cells.area() - surface).abs() <= 1e-14 * surface, "{} {surface}", cells.area());
        assert!(cells.iter().all(|cell| cell.volume() > 0.0 && cell.area() > 0.0));
    }
}

#[test]
fn areas_scale_with_the_grid_down_to_the_smallest_spacing() {
    let rule = TriangleRule::of_degree(2).unwrap();
    let measures = |scale: f64, margin: f64| {
        let grid = Grid3::new([0.0; 3], scale, [2; 3]).unwrap();
        let values = (0..27).map(|n| if n % 5 == 0 { -1e-9 } else { 1.0 + f64::from(n) }).collect();
        let parameters = MarchingCubes { margin, ..MarchingCubes::default() };
        let cells = CutCells::new(&Samples::new(grid, values), &parameters, &Monitor::none()).unwrap();
        let of = |area: f64| area / scale / scale;
        let weights: f64 =
            cells.iter().flat_map(|cell| cell.surface_points(&rule)).map(|q| of(q.weight())).sum();
        let faces: Vec<f64> = cells.iter().flat_map(|c| (0..6).map(move |f| of(c.face_area(f)))).collect();
        (of(cells.area()), weights, faces, cells.volume() / scale / scale / scale)
    };
    for margin in [2f64.powi(-20), 2f64.powi(-40)] {
        let expected = measures(1.0, margin);
        for scale in [2f64.powi(-249), 2f64.powi(-205), 2f64.powi(-200), 2f64.powi(249)] {
            assert_eq!(measures(scale, margin), expected, "{scale:e}");
        }
    }
}

#[test]
fn every_cell_is_of_the_kind_that_its_corners_say() {
    for samples in inputs() {
        let cells = cut(&samples);
        let grid = samples.grid();
        let mut cuts = 0;
        let mut inside = Vec::new();
        for number in 0..grid.cell_count() {
            let cell @ [i, j, k] = grid.cell_at(number);
            let below = |c: u32| samples.at([i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)]) < 0.0;
            let negative = (0..8).filter(|&c| below(c)).count();
            match cells.kind(cell) {
                CellKind::Inside => {
                    assert_eq!(negative, 8);
                    inside.push(cell);
                }
                CellKind::Outside => assert_eq!(negative, 0),
                CellKind::Cut(cut) => {
                    assert!((0..8).all(|c| cut.case().is_negative(c) == below(u32::from(c))));
                    assert_eq!(cut.index(), cell);
                    assert_eq!(cells.get(cuts).index(), cell);
                    cuts += 1;
                }
            }
        }
        assert_eq!(cells.len(), cuts);
        let runs: Vec<_> =
            cells.inside_runs().flat_map(|([j, k], run)| run.map(move |i| [i, j, k])).collect();
        assert_eq!(runs, inside);
        assert_eq!(cells.inside_count(), inside.len() as u64);
    }
}

#[test]
fn the_boundary_of_every_polyhedron_is_closed_and_neighbours_share_their_faces() {
    for samples in inputs() {
        let cells = cut(&samples);
        let rule = TriangleRule::of_degree(1).unwrap();
        for cell in cells.iter() {
            // The normals of a closed surface add up to zero.
            let faces: DVec3 =
                (0..6).flat_map(|f| cell.face_points(f, &rule)).map(|q| q.weighted_normal).sum();
            let sum = faces + cell.area_vector();
            assert!(sum.length() < 1e-15 * samples.grid().spacing().powi(2) * 100.0, "{sum}");
            for axis in 0..3 {
                let mut next = cell.index();
                next[axis] += 1;
                if next[axis] == samples.grid().cells()[axis] {
                    continue;
                }
                let ours = cell.face_area(2 * axis + 1);
                let theirs = match cells.kind(next) {
                    CellKind::Inside => samples.grid().spacing().powi(2),
                    CellKind::Outside => 0.0,
                    CellKind::Cut(other) => other.face_area(2 * axis),
                };
                assert!((ours - theirs).abs() < 1e-16, "{ours} {theirs}");
            }
        }
    }
}

/// The integral of a monomial over the positive simplex `x + y + z <= s`.
fn over_simplex(powers: [u32; 3], s: f64) -> f64 {
    let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
    let total: u32 = powers.iter().sum();
    powers.iter().map(|&p| factorial(p)).product::<f64>() / factorial(total + 3) * s.powi(total as i32 + 3)
}

#[test]
fn quadrature_over_many_cells_of_a_simplex_is_exact() {
    // Linear samples: the surface is the plane itself. Cells inside, and cut in a dozen ways.
    let s = 0.9375 + 1.0 / 64.0;
    let grid = Grid3::new([0.0; 3], 0.125, [9; 3]).unwrap();
    let samples = Samples::of(&grid, &move |p: DVec3| p.x + p.y + p.z - s, &Monitor::none()).unwrap();
    let cells = cut(&samples);
    for degree in [1, LUMPED_MASS_DEGREE, DIVERGENCE_DEGREE, MASS_DEGREE] {
        let (tetrahedra, cubes) =
            (TetrahedronRule::of_degree(degree).unwrap(), CubeRule::of_degree(degree).unwrap());
        for powers in [
            [degree, 0, 0],
            [0, degree - degree / 2, degree / 2],
            [degree / 3, degree - degree / 3 * 2, degree / 3],
        ] {
            let monomial = |p: DVec3| (0..3).map(|axis| p[axis].powi(powers[axis] as i32)).product::<f64>();
            let in_cut = cells.iter().flat_map(|cell| cell.volume_points(&tetrahedra));
            let inside = cells.inside_runs().flat_map(|([j, k], run)| run.map(move |i| [i, j, k]));
            let in_whole = inside.flat_map(|index| cells.cell_points(index, &cubes));
            let integral: f64 = in_cut.chain(in_whole).map(|q| q.weight * monomial(q.point)).sum();
            let expected = over_simplex(powers, s);
            assert!((integral - expected).abs() <= 1e-13 * expected, "{powers:?}: {integral} {expected}");
        }
    }
}

#[test]
fn the_divergence_theorem_holds_in_every_cell() {
    // Volume and surface quadrature are different rules on different shapes: they must agree on each polyhedron.
    let (tetrahedra, triangles) = (
        TetrahedronRule::of_degree(BOUNDARY_DEGREE - 1).unwrap(),
        TriangleRule::of_degree(BOUNDARY_DEGREE).unwrap(),
    );
    for samples in inputs() {
        let cells = cut(&samples);
        for (n, cell) in cells.iter().enumerate().filter(|(n, _)| n % 3 == 0) {
            let origin = samples.grid().position(cell.index());
            let [a, b, c] = [[9, 0, 0], [3, 3, 3], [2, 5, 1], [1, 0, 8]][n / 3 % 4];
            let field = |p: DVec3| {
                let p = (p - origin) / samples.grid().spacing();
                DVec3::new(p.x.powi(a) * p.y.powi(b) * p.z.powi(c), 0.0, 0.0)
            };
            let divergence = |p: DVec3| {
                let p = (p - origin) / samples.grid().spacing();
                f64::from(a) * p.x.powi(a - 1) * p.y.powi(b) * p.z.powi(c) / samples.grid().spacing()
            };
            let volume: f64 = cell.volume_points(&tetrahedra).map(|q| q.weight * divergence(q.point)).sum();
            let faces = (0..6).flat_map(|f| cell.face_points(f, &triangles));
            let flux: f64 = faces
                .chain(cell.surface_points(&triangles))
                .map(|q| q.weighted_normal.dot(field(q.point)))
                .sum();
            let size = samples.grid().spacing().powi(2);
            assert!((volume - flux).abs() < 1e-13 * size, "{:?}: {volume} {flux}", cell.case());
        }
    }
}

/// The quadratic B-spline centred at zero with knots at -1.5, -0.5, 0.5, 1.5.
fn spline(x: f64) -> f64 {
    let x = x.abs();
    if x < 0.5 { 0.75 - x * x } else { 0.5 * (1.5 - x).max(0.0).powi(2) }
}

#[test]
fn products_of_quadratic_splines_are_integrated_without_error() {
    // Splines centred in cells, so that knots are nodes; a plane that cuts one layer of cells at a third of their height.
    let grid = Grid3::new([0.0; 3], 1.0, [4, 4, 4]).unwrap();
    let height = 1.0 + 1.0 / 3.0;
    let samples = Samples::of(&grid, &move |p: DVec3| p.z - height, &Monitor::none()).unwrap();
    let cells = cut(&samples);
    let (tetrahedra, cubes) =
        (TetrahedronRule::of_degree(MASS_DEGREE).unwrap(), CubeRule::of_degree(4).unwrap());
    let at = |node: [f64; 3], p: DVec3| spline(p.x - node[0]) * spline(p.y - node[1]) * spline(p.z - node[2]);
    let points = || {
        let inside = cells.inside_runs().flat_map(|([j, k], run)| run.map(move |i| [i, j, k]));
        let whole = inside.flat_map(|index| cells.cell_points(index, &cubes));
        cells.iter().flat_map(|cell| cell.volume_points(&tetrahedra)).chain(whole)
    };
    // Along an axis the product of a spline and one `d` cells on, over all of it: 11/20, 13/60, 1/120.
    let whole = [11.0 / 20.0, 13.0 / 60.0, 1.0 / 120.0];
    for (dx, dy) in [(0, 0), (1, 0), (1, 1)] {
        let (a, b) = ([1.5, 1.5, 0.5], [1.5 + f64::from(dx), 1.5 + f64::from(dy), 1.5]);
        let integral: f64 = points().map(|q| q.weight * at(a, q.point) * at(b, q.point)).sum();
        // Along z, splines at 0.5 and 1.5 from the wall at 0 up to the plane, by Simpson's rule, refined: of degree 4 on each part.
        let boole = |from: f64, to: f64| {
            let f = |t: f64| spline(t - 0.5) * spline(t - 1.5);
            let h = (to - from) / 4.0;
            let at = |i: f64| f(from + i * h);
            2.0 * h / 45.0
                * (7.0 * at(0.0) + 32.0 * at(1.0) + 12.0 * at(2.0) + 32.0 * at(3.0) + 7.0 * at(4.0))
        };
        let along_z = boole(0.0, 1.0) + boole(1.0, height);
        let expected = whole[dx as usize] * whole[dy as usize] * along_z;
        // The splines at 1.5 + 1 reach over the far wall at 4 no more than the near one: nothing is cut off along x and y.
        assert!((integral - expected).abs() < 1e-14, "{dx} {dy}: {integral} {expected}");
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let samples = drawn(9, [40, 12, 11]);
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let cells = pool.install(|| cut(&samples));
        cells.iter().flat_map(|cell| cell.tetrahedra()).collect::<Vec<_>>()
    };
    assert_eq!(run(1), run(3));
}
