//! Redistancing and extrapolation: orders of convergence against closed forms, laws, and hard values.

use super::on_threads;
use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::distance::{
    Degree, ExtrapolationError, ExtrapolationParameters, RedistanceError, RedistanceParameters,
    RedistanceReport, extrapolate, redistance,
};
use welter_meshing::grid::{Grid, Grid2, Grid3, Samples};

fn sampled<const D: usize>(grid: Grid<D>, f: impl Fn([f64; D]) -> f64) -> Samples<D> {
    Samples::new(grid, (0..grid.node_count()).map(|n| f(grid.node(grid.node_at(n)))).collect())
}

fn square(cells: u32) -> Grid2 {
    Grid2::new([-1.0; 2], 2.0 / f64::from(cells), [cells; 2]).unwrap()
}

fn cube(cells: u32) -> Grid3 {
    Grid3::new([-1.0; 3], 2.0 / f64::from(cells), [cells; 3]).unwrap()
}

fn redistanced<const D: usize>(level_set: &Samples<D>) -> (Samples<D>, RedistanceReport) {
    redistance(level_set, &RedistanceParameters::default(), &Monitor::none()).unwrap()
}

fn length<const D: usize>(p: [f64; D]) -> f64 {
    p.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A level set whose zero contour is the circle or sphere of radius 0.6, of uneven steepness.
fn distorted<const D: usize>(p: [f64; D]) -> f64 {
    let r = length(p);
    (r * r - 0.36) * (1.5 + (3.0 * p[0]).sin() * (2.0 * p[1] + 1.0).cos())
}

/// The largest error of the distance next to the contour, and of all nodes not within 0.2 of the centre.
fn errors<const D: usize>(grid: Grid<D>) -> [f64; 2] {
    let (found, report) = redistanced(&sampled(grid, distorted));
    assert!(report.converged && report.beside_contour > 0);
    let (mut beside, mut all) = (0.0_f64, 0.0_f64);
    for (node, &value) in found.values().iter().enumerate() {
        let r = length(grid.node(grid.node_at(node)));
        let error = (value - (r - 0.6)).abs();
        if (r - 0.6).abs() < 0.5 * grid.spacing() {
            beside = beside.max(error);
        }
        if r > 0.2 {
            all = all.max(error);
        }
    }
    [beside, all]
}

fn order(coarse: f64, fine: f64, ratio: f64) -> f64 {
    (coarse / fine).ln() / ratio.ln()
}

#[test]
fn the_contour_stays_to_second_order_and_distances_converge() {
    let [coarse, fine] = [square(32), square(128)].map(errors);
    let orders = [order(coarse[0], fine[0], 4.0), order(coarse[1], fine[1], 4.0)];
    println!("plane: {coarse:.6?} {fine:.6?} orders {orders:.2?}");
    assert!(orders[0] >= 1.9 && orders[1] >= 0.9, "{orders:?}");
    let [coarse, fine] = [cube(16), cube(32)].map(errors);
    let orders = [order(coarse[0], fine[0], 2.0), order(coarse[1], fine[1], 2.0)];
    println!("space: {coarse:.6?} {fine:.6?} orders {orders:.2?}");
    assert!(orders[0] >= 1.9 && orders[1] >= 0.9, "{orders:?}");
}

#[test]
fn planes_along_the_axes_are_exact() {
    // Any steepness that is linear along edges: the contour is a plane of the grid's subdivision.
    let grid = Grid3::new([-1.0; 3], 0.125, [16, 15, 14]).unwrap();
    for axis in 0..3 {
        let (found, _) = redistanced(&sampled(grid, |p| 100.0 * (p[axis] - 0.3)));
        for (node, &value) in found.values().iter().enumerate() {
            let exact = grid.node(grid.node_at(node))[axis] - 0.3;
            assert!((value - exact).abs() < 1e-14, "{value}, not {exact}");
        }
    }
    // A slanting plane next to itself, away from the border.
    let normal = DVec3::new(2.0, -3.0, 6.0) / 7.0;
    let (found, _) = redistanced(&sampled(grid, |p| 5.0 * (normal.dot(DVec3::from_array(p)) + 0.1)));
    for (node, &value) in found.values().iter().enumerate() {
        let p = grid.position(grid.node_at(node));
        let exact = normal.dot(p) + 0.1;
        if exact.abs() < 0.09 && p.abs().max_element() < 0.6 {
            assert!((value - exact).abs() < 1e-14, "{value}, not {exact}");
        }
    }
}

#[test]
fn laws_of_sign_scale_axes_and_threads() {
    let f = |p: [f64; 3]| distorted(p) + 0.2 * p[2];
    let grid = cube(16);
    let level_set = sampled(grid, f);
    let (expected, report) = redistanced(&level_set);
    let (negated, _) = redistanced(&sampled(grid, |p| -f(p)));
    assert!(negated.values().iter().zip(expected.values()).all(|(a, b)| (a + b).abs() < 1e-13));
    let (steeper, _) = redistanced(&sampled(grid, |p| 4096.0 * f(p)));
    assert_eq!(steeper, expected);
    let (turned, _) = redistanced(&sampled(grid, |[x, y, z]| f([y, z, x])));
    for (node, value) in expected.values().iter().enumerate() {
        let [i, j, k] = grid.node_at(node);
        assert!((turned.at([k, i, j]) - value).abs() < 1e-12);
        assert_eq!(*value < 0.0, level_set.values()[node] < 0.0);
    }
    for threads in [1, 3] {
        assert_eq!(on_threads(threads, || redistanced(&level_set)), (expected.clone(), report));
    }
    // What is a distance already is hardly changed by a second time; the first node to move is one beside the contour.
    let (again, _) = redistanced(&expected);
    let moved = again.values().iter().zip(expected.values()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(moved < 0.2 * grid.spacing(), "{moved}");
}

#[test]
fn hard_values() {
    let grid = square(8);
    let all = |value: f64| sampled(grid, |_| value);
    for value in [3.0, f64::INFINITY, -2.0, f64::NEG_INFINITY] {
        let (found, report) = redistanced(&all(value));
        assert!(report.converged && report.beside_contour == 0);
        assert!(found.values().iter().all(|&d| d == f64::INFINITY.copysign(value)));
    }
    let (found, _) = redistanced(&all(0.0));
    assert!(found.values().iter().all(|&d| d == 0.0));
    // Infinite and huge values on both sides; a single zero.
    for big in [f64::INFINITY, f64::MAX, 5e-324] {
        let (found, _) = redistanced(&sampled(grid, |p| if p[0] < 0.1 { -big } else { big }));
        for (node, &value) in found.values().iter().enumerate() {
            assert!((value - (grid.position(grid.node_at(node)).x - 0.125)).abs() < 1e-15);
        }
    }
    let (found, _) = redistanced(&sampled(grid, |p| if p == [0.0; 2] { 0.0 } else { 1.0 }));
    assert_eq!([found.at([4, 4]), found.at([4, 6]), found.at([8, 4])], [0.0, 0.5, 1.0]);
    let nan = sampled(grid, |p| if p[1] > 0.9 { f64::NAN } else { p[0] });
    let refused = redistance(&nan, &RedistanceParameters::default(), &Monitor::none());
    assert!(matches!(refused, Err(RedistanceError::NotANumber(_))));
    for parameters in [
        RedistanceParameters { max_sweeps: 0, ..Default::default() },
        RedistanceParameters { tolerance_rel: f64::NAN, ..Default::default() },
    ] {
        let refused = redistance(&all(1.0), &parameters, &Monitor::none());
        assert!(matches!(refused, Err(RedistanceError::Parameter { .. })));
    }
    let few = RedistanceParameters { max_sweeps: 3, ..Default::default() };
    let (_, report) = redistance(&sampled(grid, distorted), &few, &Monitor::none()).unwrap();
    assert!(!report.converged && report.sweeps == 3);
}

#[test]
fn sweeps_agree_with_relaxation_of_all_nodes_at_once() {
    let grid = square(16);
    let level_set = sampled(grid, |p| (p[0] - 0.3 * p[1]).sin().max(p[1] - 0.4) + 0.1);
    let (found, report) = redistanced(&level_set);
    // Jacobi iteration of the same equations, from the same values beside the contour.
    let beside = |n: usize| {
        let [i, j] = grid.node_at(n).map(|i| i as i32);
        [[1, 0], [-1, 0], [0, 1], [0, -1]].iter().any(|[a, b]| {
            let at = [i + a, j + b];
            at.iter().all(|&i| (0..=16).contains(&i))
                && (level_set.at(at.map(|i| i as u32)) < 0.0) != (level_set.values()[n] < 0.0)
        })
    };
    let h = grid.spacing();
    let mut values: Vec<f64> = (0..grid.node_count())
        .map(|n| if beside(n) { found.values()[n].abs() } else { f64::INFINITY })
        .collect();
    assert_eq!(report.beside_contour, values.iter().filter(|v| v.is_finite()).count());
    for _ in 0..60 {
        let old = values.clone();
        for n in (0..values.len()).filter(|&n| !beside(n)) {
            let [i, j] = grid.node_at(n).map(|i| i as i32);
            let at = |i: i32, j: i32| {
                let inside = (0..=16).contains(&i) && (0..=16).contains(&j);
                if inside { old[grid.node_index([i as u32, j as u32])] } else { f64::INFINITY }
            };
            let a = at(i - 1, j).min(at(i + 1, j));
            let b = at(i, j - 1).min(at(i, j + 1));
            let both = 0.5 * (a + b + (2.0 * h * h - (a - b) * (a - b)).sqrt());
            values[n] = if (a - b).abs() < h { both } else { a.min(b) + h };
        }
    }
    for (a, b) in values.iter().zip(found.values()) {
        assert!((a - b.abs()).abs() < 1e-12, "{a} {b}");
    }
}

fn quantity<const D: usize>(p: [f64; D]) -> f64 {
    (2.0 * p[0] + p[1]).sin() + p[D - 1] * p[0]
}

/// The largest error outside of a circle or sphere: of what the equations say within 0.3, and of the smooth quantity itself
/// within three spacings.
fn extrapolation_errors<const D: usize>(grid: Grid<D>, degree: Degree) -> [f64; 2] {
    let phi = sampled(grid, |p| length(p) - 0.5);
    let known = sampled(grid, |p| if length(p) <= 0.5 { quantity(p) } else { f64::NAN });
    let parameters = ExtrapolationParameters { degree, band: 0.3 };
    let (found, report) = extrapolate(&known, &phi, &parameters, &Monitor::none()).unwrap();
    assert_eq!(report.unreached, 0);
    let (mut far, mut near) = (0.0_f64, 0.0_f64);
    for (node, &value) in found.values().iter().enumerate() {
        let p = grid.node(grid.node_at(node));
        let outside = length(p) - 0.5;
        if outside <= 0.0 || outside > 0.3 {
            continue;
        }
        let foot = p.map(|x| x * 0.5 / length(p));
        let step = 1e-5;
        let [ahead, behind] = [1.0 + step, 1.0 - step].map(|s| quantity(foot.map(|x| x * s)));
        let slope = if degree == Degree::Linear { (ahead - behind) / step } else { 0.0 };
        far = far.max((value - (quantity(foot) + outside * slope)).abs());
        if outside <= 3.0 * grid.spacing() {
            near = near.max((value - quantity(p)).abs());
        }
    }
    [far, near]
}

#[test]
fn extrapolations_converge() {
    // The upwind scheme is of first order over a length; what linear adds is the second order next to the surface.
    for (degree, least) in [(Degree::Constant, [0.85, 0.9]), (Degree::Linear, [0.85, 1.7])] {
        let plane = [square(32), square(128)].map(|grid| extrapolation_errors(grid, degree));
        let space = [cube(32), cube(64)].map(|grid| extrapolation_errors(grid, degree));
        let orders =
            [0, 1].map(|i| [order(plane[0][i], plane[1][i], 4.0), order(space[0][i], space[1][i], 2.0)]);
        println!("{degree:?}: {plane:.6?} {space:.6?} orders {orders:.2?}");
        for (orders, least) in orders.into_iter().zip(least) {
            assert!(orders.iter().all(|&order| order >= least), "{degree:?}: {orders:?}");
        }
    }
}

#[test]
fn what_no_extrapolation_can_take() {
    let grid = square(4);
    let q = sampled(grid, |p| 1.0 / (p[0] + 1.0));
    let everywhere = ExtrapolationParameters::default();
    let refused = extrapolate(&q, &sampled(grid, |p| p[0]), &everywhere, &Monitor::none());
    assert!(matches!(refused, Err(ExtrapolationError::Quantity { ref node, .. }) if node == &[0, 0]));
    let refused = extrapolate(&q, &sampled(square(8), |p| p[0]), &everywhere, &Monitor::none());
    assert_eq!(refused, Err(ExtrapolationError::Grids));
    let nan = sampled(grid, |p| if p[0] > 0.9 { f64::NAN } else { p[0] });
    let refused = extrapolate(&q, &nan, &everywhere, &Monitor::none());
    assert!(matches!(refused, Err(ExtrapolationError::LevelSet(_))));
    let band = ExtrapolationParameters { band: -1.0, ..everywhere };
    assert!(matches!(extrapolate(&q, &q, &band, &Monitor::none()), Err(ExtrapolationError::Band { .. })));
    // Nothing inside to start from, and infinite values: nodes keep what they have.
    let ones = sampled(grid, |p| p[1]);
    let (found, report) = extrapolate(&ones, &sampled(grid, |_| 2.0), &everywhere, &Monitor::none()).unwrap();
    assert_eq!((found, report.extrapolated, report.unreached), (ones.clone(), 0, 25));
    let steep = sampled(grid, |p| if p[0] > 0.4 { f64::INFINITY } else { p[0] + 0.75 });
    let (found, report) = extrapolate(&ones, &steep, &everywhere, &Monitor::none()).unwrap();
    assert_eq!((report.extrapolated, report.unreached), (10, 10));
    assert_eq!(found, ones); // It changes along the contours only.
}

#[test]
fn extrapolation_of_the_largest_numbers_stays_finite() {
    // Differences of the quantity overflow, and weights underflow: infinity times zero.
    let grid = Grid2::new([0.0; 2], 1.0, [4; 2]).unwrap();
    let phi = sampled(grid, |[x, y]| match (x < 1.0, y < 1.0) {
        (true, _) => -5e-324,
        (_, true) => -1e10,
        _ => 5e-324 * (x + y),
    });
    let huge = sampled(grid, |[x, y]| if x < 1.0 { f64::MAX } else { -f64::MAX * (0.5 + 0.1 * y) });
    // Far outside the linear continuation is beyond the largest number.
    let strip = sampled(grid, |[x, _]| x - 1.0);
    let steep = sampled(grid, |[x, y]| (x - 0.5) * 1e308 * if y > 2.0 { -1.0 } else { 1.0 });
    for (phi, quantity) in [(&phi, &huge), (&strip, &steep), (&strip, &huge)] {
        for degree in [Degree::Constant, Degree::Linear] {
            let parameters = ExtrapolationParameters { degree, ..ExtrapolationParameters::default() };
            let (all, report) = extrapolate(quantity, phi, &parameters, &Monitor::none()).unwrap();
            assert!(report.extrapolated > 0);
            assert!(all.values().iter().all(|v| v.is_finite()), "{degree:?}: {:?}", all.values());
        }
    }
    let linear = ExtrapolationParameters { degree: Degree::Linear, ..ExtrapolationParameters::default() };
    let (all, _) = extrapolate(&steep, &strip, &linear, &Monitor::none()).unwrap();
    assert_eq!(all.at([4, 0]), f64::MAX);
    assert_eq!(all.at([4, 4]), -f64::MAX);
}
