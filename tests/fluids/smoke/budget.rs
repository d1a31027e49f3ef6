//! The triangle budget and its two policies.

use super::{ball, every, once, rising, run, step};
use glam::DVec3;
use welter_fluids::smoke::{OverBudget, Refusal, SmokeParameters};

/// The longest edge of a run at its end, over the reference length that it began with; and what it needed.
fn stretched(most_triangles: usize, over_budget: OverBudget) -> (f64, f64, u64) {
    let parameters = SmokeParameters { most_triangles, over_budget, ..SmokeParameters::default() };
    let mut smoke = run(vec![once(ball(DVec3::ZERO, 0.4, 0.1))], parameters);
    let length = smoke.reference_length();
    let mut refused = 0;
    for k in 1..=60 {
        let report = step(&mut smoke, &rising(1.0), 0.03 * f64::from(k));
        assert!(report.triangles <= most_triangles, "{} in step {k}", report.triangles);
        assert_eq!(report.triangles, smoke.mesh().triangles().len());
        refused += report.improvement.refused.budget;
    }
    let mesh = smoke.mesh();
    let longest = mesh.triangles().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let longest = longest
        .map(|ends| ends.map(|v| mesh.positions()[v.index()]))
        .map(|[p, q]| p.distance(q))
        .fold(0.0, f64::max);
    (longest / length, smoke.reference_length() / length, refused)
}

#[test]
fn the_budget_is_kept_by_either_policy() {
    let (free, same, refused) = stretched(1_000_000, OverBudget::default());
    assert_eq!((same, refused), (1.0, 0), "there is a budget to meet only if it is small");
    let (stopped, same, refused) = stretched(1500, OverBudget::StopSplitting);
    assert!(same == 1.0 && refused > 0, "{refused}");
    let (coarse, length, refused) = stretched(1500, OverBudget::default());
    assert!(length > 1.0 && refused > 0, "{length}, {refused}");
    // Steps of 1.25, each after a step that met the budget.
    let powers = length.ln() / 1.25_f64.ln();
    assert!((powers - powers.round()).abs() < 1e-12, "{length}");
    println!(
        "longest edges: {free:.2} free, {stopped:.2} stopped, {coarse:.2} at {length:.2} times the length"
    );
    assert!(stopped > 1.2 * free, "without splits edges are stretched: {stopped}, {free}");
}

#[test]
fn releases_beyond_the_budget_are_told_and_not_made() {
    let shape = ball(DVec3::ZERO, 0.3, 0.1);
    let triangles = shape.mesh().triangles().len();
    let parameters = SmokeParameters {
        most_triangles: 2 * triangles + triangles / 2,
        remeshing: None,
        over_budget: OverBudget::StopSplitting,
        ..SmokeParameters::default()
    };
    let mut smoke = run(vec![every(shape, 0.0, 0.25)], parameters);
    assert_eq!((smoke.at_start().len(), smoke.at_start()[0].refusal), (1, None));
    let up = |_: DVec3, _: f64| DVec3::Y;
    let report = step(&mut smoke, &up, 0.9);
    let told: Vec<_> = report.releases.iter().map(|r| (r.release.index, r.triangles, r.refusal)).collect();
    let full = Some(Refusal::Budget { present: 2 * triangles });
    assert_eq!(told, [(1, triangles, None), (2, triangles, full), (3, triangles, full)]);
    assert_eq!(report.triangles, 2 * triangles);
    assert_eq!(report.substeps, 4, "cut at each release");
}
