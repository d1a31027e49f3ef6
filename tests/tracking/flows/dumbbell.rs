//! Mean curvature of a dumbbell: two solvers of the kit against each other, and the flow against them.

use super::order;
use glam::{DVec2, DVec3};
use welter_kit::evolution::{DumbbellProfile, End, MeridianFlow, MeridianLevelSet, errors, half_plane};
use welter_meshing::shapes::{Dumbbell, dumbbell};
use welter_tracking::flows::MeanCurvature;
use welter_tracking::surface::MovingSurface;

/// The signed distance of the dumbbell without fillets, by its definition; wrong in magnitude near the ridge only.
fn union(p: DVec2) -> f64 {
    let shape = DumbbellProfile::default();
    let ball = (DVec2::new(p.x.abs(), p.y) - DVec2::new(shape.offset, 0.0)).length() - shape.radius;
    let handle = (p.x.abs() - shape.offset).max(p.y - shape.neck_radius);
    ball.min(handle)
}

fn level_set(cells: u32, time: f64) -> MeridianLevelSet {
    let mut set = MeridianLevelSet::new([1.0, 0.5], 0.5 / f64::from(cells), union);
    set.advance_to(time);
    set
}

fn line(count: usize, time: f64) -> MeridianFlow {
    let mut flow = MeridianFlow::new(DumbbellProfile::default().half_line(count), End::Symmetry);
    flow.advance_to(time);
    flow
}

#[test]
fn both_solvers_know_the_sphere() {
    let radius = (0.09_f64 - 4.0 * 0.01).sqrt();
    let arc = |count: u32| {
        let angle = |i: u32| std::f64::consts::FRAC_PI_2 * (1.0 - f64::from(i) / f64::from(count));
        let mut points: Vec<DVec2> =
            (0..count).map(|i| 0.3 * DVec2::new(angle(i).cos(), angle(i).sin())).collect();
        points[0].x = 0.0;
        points.push(DVec2::new(0.3, 0.0));
        points
    };
    let lines = [25, 50].map(|count| {
        let mut flow = MeridianFlow::new(arc(count), End::Symmetry);
        flow.advance_to(0.01);
        flow.points().iter().map(|p| (p.length() - radius).abs()).fold(0.0, f64::max)
    });
    let sets = [20, 40].map(|cells| {
        let mut set = MeridianLevelSet::new([0.5, 0.5], 0.5 / f64::from(cells), |p| p.length() - 0.3);
        set.advance_to(0.01);
        let places =
            (0..=20).map(|i| radius * DVec2::from_angle(std::f64::consts::FRAC_PI_2 * f64::from(i) / 20.0));
        places.map(|p| set.distance_near(p).abs()).fold(0.0, f64::max)
    });
    println!("sphere: lines {lines:?}, level sets {sets:?}");
    assert!(lines[1] < 0.3 * lines[0] && lines[1] < 1e-4, "{lines:?}");
    assert!(sets[1] < 0.35 * sets[0] && sets[1] < 3e-4, "{sets:?}");
}

/// Before the handle parts they agree to second order; afterwards too, but with less.
#[test]
fn the_two_solvers_agree() {
    for (time, least) in [(0.0125, 1.5), (0.025, 1.0)] {
        let sizes = [1.0, 0.5];
        let apart = [(100, 40), (200, 80)].map(|(count, cells)| {
            let (line, set) = (line(count, time), level_set(cells, time));
            assert_eq!(line.parted().is_some(), time > 0.022);
            line.points().iter().map(|&p| set.distance_near(p).abs()).fold(0.0, f64::max)
        });
        let order = order(&sizes, &apart);
        println!("dumbbell at {time}: line and level set apart by {apart:?}, order {order}");
        assert!(order > least && apart[1] < 2e-3, "{time}: {order}, {apart:?}");
    }
}

/// The third picture of the figure, at 0.0219, shows the handle as it parts.
#[test]
fn the_handle_parts_when_the_figure_shows_it() {
    let parted = [100, 200].map(|count| line(count, 0.025).parted().unwrap());
    println!("the handle parts at {parted:?}");
    assert!((0.0218..0.0220).contains(&parted[1]), "{parted:?}");
    assert!((parted[1] - parted[0]).abs() < 2e-4, "{parted:?}");
}

/// The flow, without remeshing, on the dumbbell of the shapes, until before its handle parts.
#[test]
fn the_flow_follows_the_line() {
    let shape = |edge_length: f64| Dumbbell {
        radius: 0.3,
        distance: 1.0,
        neck_radius: 0.2,
        fillet_radius: 0.1,
        edge_length,
    };
    let profile = DumbbellProfile { fillet_radius: 0.1, ..DumbbellProfile::default() };
    let mut exact = MeridianFlow::new(profile.half_line(300), End::Symmetry);
    exact.advance_to(0.0125);
    let edges = [0.04, 0.02];
    let found = edges.map(|edge_length| {
        let mut surface = MovingSurface::new(&dumbbell(&shape(edge_length)).unwrap()).unwrap();
        let steps = super::run(&mut surface, &MeanCurvature::default(), [0.0, 0.0125], 1.0);
        let errors = errors(&surface.to_mesh(), |p| exact.signed_distance(half_plane(p, DVec3::Z)));
        println!("dumbbell of edges {edge_length} at 0.0125: {steps} steps, {errors:?}");
        errors.l1
    });
    let order = order(&edges, &found);
    assert!(order > 1.4 && found[1] < 1e-3, "{order}: {found:?}");
}
