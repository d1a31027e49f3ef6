//! Ages: the time since the release, through remeshing.

use super::{ball, every, once, rising, run, sheet, step};
use glam::DVec3;
use welter_fluids::smoke::{EmittedShape, SmokeParameters, SmokeSimulation};
use welter_meshing::Monitor;
use welter_meshing::surface::Topology;
use welter_tracking::improvement::{ImprovementParameters, SplitScheme};

/// Of one release all ages are the same, whatever was split and collapsed in between.
#[test]
fn ages_of_one_release_are_the_time_since_then() {
    for shape in [ball(DVec3::ZERO, 0.4, 0.12), sheet(10)] {
        let begins = 0.13;
        let mut emission = once(shape);
        emission.schedule.start = begins;
        let mut smoke = run(vec![emission], SmokeParameters::default());
        assert_eq!((smoke.at_start().len(), smoke.ages().len()), (0, 0));
        let mut operations = 0;
        for k in 1..=30 {
            let end = 0.02 * f64::from(k);
            let report = step(&mut smoke, &rising(1.0), end);
            operations += report.improvement.splits + report.improvement.collapses;
            let spread = smoke.ages().iter().map(|age| (age - (end - begins)).abs()).fold(0.0, f64::max);
            assert!(spread < 1e-13, "{spread} at {end}");
            assert_eq!(smoke.ages().is_empty(), end < begins);
        }
        assert!(operations > 10, "{operations}");
    }
}

/// Components that stay apart keep their own ages, each linear in time.
#[test]
fn each_release_has_its_own_age() {
    let shape = ball(DVec3::new(0.0, -0.2, 0.0), 0.3, 0.12);
    let mut smoke = run(vec![every(shape, 0.0, 0.17)], SmokeParameters::default());
    for k in 1..=10 {
        let end = 0.05 * f64::from(k);
        let _ = step(&mut smoke, &rising(1.0), end);
        let mesh = smoke.mesh();
        let topology = Topology::of(&mesh);
        let mut ages = Vec::new();
        for component in 0..topology.components().len() {
            let triangles = topology.component_triangles(component);
            let corners = triangles.iter().flat_map(|t| mesh.triangles()[t.index()]);
            let of_component: Vec<f64> = corners.map(|v| smoke.ages()[v.index()]).collect();
            let [least, most] =
                [f64::min, f64::max].map(|pick| of_component.iter().copied().reduce(pick).unwrap());
            assert!(most - least < 1e-13, "{least} to {most}");
            ages.push(most);
        }
        ages.sort_by(f64::total_cmp);
        ages.reverse();
        let expected: Vec<f64> = (0..9).map(|i| 0.17 * f64::from(i)).filter(|t| *t <= end).collect();
        assert_eq!(ages.len(), expected.len(), "at {end}");
        assert!(
            ages.iter().zip(expected).all(|(age, since)| (age - (end - since)).abs() < 1e-13),
            "{ages:?}"
        );
    }
}

/// Ages that vary over a surface: a resumed run may begin with any. Splits in the middle carry a linear function as one; with all
/// operations, which put vertices elsewhere than their sources, it stays linear within an edge length.
#[test]
fn remeshing_interpolates_ages() {
    let EmittedShape::Open(mesh) = sheet(8) else { unreachable!("a sheet is open") };
    let emissions = vec![once(sheet(8))];
    let start = run(emissions.clone(), SmokeParameters::default());
    let mut state = start.state();
    assert_eq!(state.mesh, mesh);
    state.ages = mesh.positions().iter().map(|p| 2.0 + p.x - 3.0 * p.z).collect();
    // Stretched along x; x comes back by the exact flow.
    let stretch = |p: DVec3, _: f64| DVec3::new(p.x, 0.0, 0.0);
    let gradient = 10.0_f64.sqrt();
    let exact = ImprovementParameters {
        smoothing: false,
        split_scheme: SplitScheme::Midpoint,
        collapse: false,
        flip: false,
        ..ImprovementParameters::default()
    };
    let edge = gradient * start.reference_length();
    for (name, remeshing, bound) in [("splits", exact, 1e-6), ("all", ImprovementParameters::default(), edge)]
    {
        let parameters = SmokeParameters { remeshing: Some(remeshing), ..SmokeParameters::default() };
        let mut smoke =
            SmokeSimulation::resume(emissions.clone(), parameters, state.clone(), &Monitor::none()).unwrap();
        let (mut splits, mut worst) = (0, 0.0_f64);
        for k in 1..=20 {
            let end = 0.05 * f64::from(k);
            splits += step(&mut smoke, &stretch, end).improvement.splits;
            let mesh = smoke.mesh();
            for (p, age) in mesh.positions().iter().zip(smoke.ages()) {
                let since = 2.0 + end + p.x * (-end).exp() - 3.0 * p.z;
                worst = worst.max((age - since).abs());
            }
        }
        println!("{name}: {splits} splits, ages within {worst:.2e} of linear");
        assert!(splits > 50 && worst < bound, "{splits}, {worst}");
        let [least, most] =
            [f64::min, f64::max].map(|pick| smoke.ages().iter().copied().reduce(pick).unwrap());
        assert!(least >= 1.0 && most <= 5.0, "{least} to {most}: means are between their sources");
    }
}
