//! Integration: safety against independent checks, laws, momentum, and what each stage is for.

mod fuzz;
mod laws;
mod momentum;
mod refusals;
mod stages;

use glam::DVec3;
use welter_kit::moving::{Scene, mean_edge_length};
use welter_meshing::Monitor;
use welter_meshing::spatial::self_intersections;
use welter_tracking::broad_phase::{BroadPhase, Motion};
use welter_tracking::integration::{IntegrationError, IntegrationParameters, Resolved, accept, resolve};
use welter_tracking::surface::MovingSurface;

/// Every stage switched off but the last resort.
fn no_stages() -> IntegrationParameters {
    IntegrationParameters {
        proximity_rel: 0.0,
        sweeps: 0,
        zone_rounds: 0,
        rigid_rounds: 0,
        most_halvings: 0,
        ..IntegrationParameters::default()
    }
}

/// A surface with its broad phase and reference length.
#[derive(Clone)]
struct Body {
    surface: MovingSurface,
    broad_phase: BroadPhase,
    length: f64,
}

impl Body {
    fn new(mesh: &welter_meshing::surface::TriMesh) -> Self {
        let surface = MovingSurface::new(mesh).unwrap();
        let broad_phase = BroadPhase::new(&surface, Motion::Rest).unwrap();
        Self { surface, broad_phase, length: mean_edge_length(mesh) }
    }

    fn of(scene: &Scene) -> Self {
        let body = Self::new(&scene.mesh);
        assert!(body.is_embedded(), "{}", scene.name);
        body
    }

    fn resolve(
        &mut self,
        ends: Vec<DVec3>,
        parameters: &IntegrationParameters,
    ) -> Result<Resolved, IntegrationError> {
        resolve(&self.surface, &mut self.broad_phase, ends, self.length, parameters, &Monitor::none())
    }

    fn accept(&mut self, ends: &[DVec3]) -> Result<(), IntegrationError> {
        accept(&mut self.surface, &mut self.broad_phase, ends, &Monitor::none())
    }

    /// A whole step.
    fn step(&mut self, ends: Vec<DVec3>, parameters: &IntegrationParameters) -> Resolved {
        let resolved = self.resolve(ends, parameters).unwrap();
        self.accept(&resolved.ends).unwrap();
        resolved
    }

    /// By other code than the one under test.
    fn is_embedded(&self) -> bool {
        self_intersections(&self.surface.to_mesh(), &Monitor::none()).unwrap().is_empty()
    }
}
