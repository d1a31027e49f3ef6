//! The static operations of the tracker: laws, named cases, accuracy.

mod accuracy;
mod attributes;
mod laws;
mod topology;

use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::spatial::self_intersections;
use welter_meshing::surface::measure::signed_volume;
use welter_meshing::surface::{TriMesh, TriangleSoup};
use welter_tracking::surface::MovingSurface;
use welter_tracking::tracker::{StepReport, SurfaceTracker, TrackerParameters};

/// A mesh with its positions changed.
pub(crate) fn mapped(mesh: &TriMesh, map: impl Fn(DVec3) -> DVec3) -> TriMesh {
    let soup = TriangleSoup {
        positions: mesh.positions().iter().map(|&p| map(p)).collect(),
        triangles: mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect(),
        ..TriangleSoup::default()
    };
    TriMesh::new(soup).unwrap()
}

/// Both, side by side.
pub(crate) fn together(a: &TriMesh, b: &TriMesh) -> TriMesh {
    let n = a.positions().len() as u32;
    let triangles = a.triangles().iter().map(|t| t.map(|v| v.0));
    let soup = TriangleSoup {
        positions: [a.positions(), b.positions()].concat(),
        triangles: triangles.chain(b.triangles().iter().map(|t| t.map(|v| v.0 + n))).collect(),
        ..TriangleSoup::default()
    };
    TriMesh::new(soup).unwrap()
}

pub(crate) fn tracker(mesh: &TriMesh, parameters: TrackerParameters) -> SurfaceTracker {
    SurfaceTracker::new(MovingSurface::new(mesh).unwrap(), parameters).unwrap()
}

/// Improves a surface some times; each time it is sound and embedded.
pub(crate) fn improve(tracker: &mut SurfaceTracker, times: usize) -> Vec<StepReport> {
    let step = |_| {
        let report = tracker.improve(&Monitor::none()).unwrap();
        check(tracker);
        report
    };
    (0..times).map(step).collect()
}

/// Asks independent code whether the surface is sound and embedded.
pub(crate) fn check(tracker: &SurfaceTracker) {
    tracker.surface().check().unwrap();
    let mesh = tracker.surface().to_mesh();
    assert_eq!(self_intersections(&mesh, &Monitor::none()), Ok(vec![]));
}

pub(crate) fn volume(tracker: &SurfaceTracker) -> f64 {
    signed_volume(&tracker.surface().to_mesh())
}

/// Shortest and longest edge over the reference length.
pub(crate) fn edge_lengths(tracker: &SurfaceTracker) -> [f64; 2] {
    let (surface, length) = (tracker.surface(), tracker.reference_length());
    let mesh = surface.connectivity();
    let lengths = mesh.edges().map(|e| {
        let [a, b] = mesh.ends(e).map(|v| surface.position(v));
        a.distance(b) / length
    });
    lengths.fold([f64::INFINITY, 0.0], |[low, high], x| [low.min(x), high.max(x)])
}
