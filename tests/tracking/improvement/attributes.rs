//! Attributes through remeshing: linear functions and conserved amounts.

use super::{improve, mapped};
use glam::DVec3;
use welter_meshing::shapes::{Sphere, sphere};
use welter_tracking::improvement::ImprovementParameters;
use welter_tracking::surface::{MovingSurface, Rule};
use welter_tracking::tracker::{SurfaceTracker, TrackerParameters};

/// A linear function of position is carried by splits and collapses at the middle without error where the surface is not
/// curved; off the middle it errs by the distance that vertices were put from the edge, at most an eighth of the square of the
/// longest edge over the radius for each of the times that a vertex was made anew.
#[test]
fn a_linear_function_stays_within_the_bound_of_discretisation() {
    let slope = DVec3::new(0.3, -0.5, 0.7);
    for (length, stretch) in [(0.1, 1.0), (0.5, 1.0), (0.15, 2.0)] {
        let mesh = sphere(&Sphere { edge_length: 0.2, ..Sphere::default() }).unwrap();
        let mesh = mapped(&mesh, |p| stretch * p);
        let mut surface = MovingSurface::new(&mesh).unwrap();
        let values = surface.positions().iter().map(|&p| slope.dot(p) + 0.25).collect();
        let linear = surface.vertex_attributes_mut().add("linear", values, Rule::Interpolate).unwrap();
        let amounts: Vec<f64> = (0..surface.positions().len()).map(|i| 1.0 + (i % 7) as f64).collect();
        let total: f64 = amounts.iter().sum();
        let amount = surface.vertex_attributes_mut().add("amount", amounts, Rule::Conserve).unwrap();
        // Vertices are not moved along the surface, since values do not move along with them there.
        let improvement = ImprovementParameters { smoothing: false, ..ImprovementParameters::default() };
        let parameters =
            TrackerParameters { improvement, reference_length: Some(length), ..TrackerParameters::default() };
        let mut tracker = SurfaceTracker::new(surface, parameters).unwrap();
        let changes: u64 = improve(&mut tracker, 3)
            .iter()
            .map(|r| r.improvement.splits + r.improvement.collapses + r.improvement.flips)
            .sum();
        let surface = tracker.surface();
        let values = surface.vertex_attributes().values(linear);
        let error = surface
            .connectivity()
            .vertices()
            .map(|v| (values[v.index()] - slope.dot(surface.position(v)) - 0.25).abs());
        let error = error.fold(0.0, f64::max);
        let edge: f64 = (1.5 * length).max(0.2 * stretch * 1.3);
        let sagitta = edge * edge / (8.0 * stretch);
        let amounts = surface.vertex_attributes().values(amount);
        let after: f64 = surface.connectivity().vertices().map(|v| amounts[v.index()]).sum();
        println!(
            "{length} {stretch}: {changes} changes, error {error:.2e}, sagitta {sagitta:.2e}, total {total} {after}"
        );
        assert!(changes > 100);
        assert!(error <= 2.0 * sagitta * slope.length(), "{error} {sagitta}");
        assert!((after / total - 1.0).abs() < 1e-13);
    }
}
