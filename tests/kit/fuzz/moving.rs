//! Steps of the surface tracker on a few triangles, against the rational check for self-intersections.

use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::surface::{TriMesh, TriangleSoup};
use welter_tracking::flows::{Flow, FlowError, Prediction};
use welter_tracking::improvement::{ImprovementParameters, SplitScheme, TopologyParameters};
use welter_tracking::integration::{IntegrationError, IntegrationParameters};
use welter_tracking::surface::MovingSurface;
use welter_tracking::tracker::{SurfaceTracker, TrackerError, TrackerParameters};

use crate::entropy::Entropy;
use crate::exact::self_intersections;

/// Corners on a lattice, and triangles of them.
type Piece = (&'static [[i32; 3]], &'static [[u32; 3]]);

/// Pieces of a surface: closed ones, and sheets that are open.
const PIECES: [Piece; 4] = [
    (&[[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]], &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]),
    (
        &[[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
        &[[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]],
    ),
    (&[[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], &[[0, 1, 2], [0, 2, 3]]),
    (&[[0, 0, 0], [2, 1, 0], [1, 2, 1]], &[[0, 1, 2]]),
];

/// Units of the lattice, from the smallest numbers to large ones.
const UNITS: [f64; 6] = [1.0, 0.1, 1024.0, 1e-300, 1e300, 5e-324];

/// Moves by so many units, or by what is no position.
const WAYS: [f64; 10] = [0.0, 0.0, 1.0, -1.0, 0.5, -2.0, 1e-9, 3.0, 1e15, f64::NAN];

/// Ends that the bytes name.
struct Drawn(Vec<DVec3>);

impl Flow for Drawn {
    fn advance(&self, surface: &MovingSurface, _: f64, dt: f64) -> Result<Prediction, FlowError> {
        let way = |v: usize| self.0.get(v % self.0.len().max(1)).copied().unwrap_or(DVec3::ZERO);
        let ends = surface.positions().iter().enumerate().map(|(v, &p)| p + way(v)).collect();
        Ok(Prediction { ends, dt })
    }
}

/// A surface of a few triangles is moved; it never intersects itself, whatever the ends.
pub fn moving_surfaces(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    let entropy = &mut entropy;
    let unit = entropy.pick(&UNITS);
    let mut soup = TriangleSoup::default();
    for _ in 0..=entropy.below(3) {
        let (corners, triangles) = entropy.pick(&PIECES);
        let first = soup.positions.len() as u32;
        let shift = [(); 3].map(|()| entropy.between(-3, 3));
        soup.positions.extend(
            corners
                .iter()
                .map(|c| DVec3::from_array(std::array::from_fn(|k| f64::from(c[k] + shift[k]) * unit))),
        );
        soup.triangles.extend(triangles.iter().map(|t| t.map(|v| first + v)));
    }
    let Ok(mesh) = TriMesh::new(soup) else { return };
    let Ok(surface) = MovingSurface::new(&mesh) else { return };
    let scheme = entropy.pick(&[SplitScheme::Butterfly, SplitScheme::Fitted, SplitScheme::Midpoint]);
    let flags = entropy.byte();
    let parameters = TrackerParameters {
        improvement: ImprovementParameters {
            split_scheme: scheme,
            keeps_volume: flags & 1 != 0,
            smoothing: flags & 2 != 0,
            split: flags & 4 != 0,
            flip: flags & 8 != 0,
            collapse: flags & 16 != 0,
            most_triangles: 32,
            ..ImprovementParameters::default()
        },
        topology: TopologyParameters { enabled: flags & 32 != 0, merge_distance_rel: 0.3 },
        integration: IntegrationParameters { sweeps: u32::from(flags >> 6), ..Default::default() },
        reference_length: (entropy.byte() & 1 != 0).then_some(unit),
    };
    let mut tracker = match SurfaceTracker::new(surface, parameters) {
        Ok(tracker) => tracker,
        Err(TrackerError::Integration(IntegrationError::Intersection { .. })) => {
            assert!(crosses_itself(&mesh), "an embedded surface is refused");
            return;
        }
        // A unit that is no length of a mesh.
        Err(TrackerError::Parameter(_)) => return,
        Err(error) => panic!("{error}"),
    };
    assert!(!crosses_itself(&mesh), "accepted at the beginning");
    for _ in 0..2 {
        let count = 1 + entropy.below(12);
        let way = |entropy: &mut Entropy<'_>| [(); 3].map(|()| entropy.pick(&WAYS) * unit);
        let flow = Drawn((0..count).map(|_| DVec3::from_array(way(entropy))).collect());
        let before = tracker.surface().positions().to_vec();
        match tracker.step(&flow, 1.0, &Monitor::none()) {
            Ok(_) => assert!(!crosses_itself(&tracker.surface().to_mesh()), "after a step"),
            Err(TrackerError::Integration(_) | TrackerError::Position(_) | TrackerError::Flow(_)) => {
                assert_eq!(tracker.surface().positions(), before, "a step that fails changes nothing");
            }
            Err(error) => panic!("{error}"),
        }
    }
}

fn crosses_itself(mesh: &TriMesh) -> bool {
    let positions: Vec<[f64; 3]> = mesh.positions().iter().map(|p| p.to_array()).collect();
    let triangles: Vec<[u32; 3]> = mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect();
    !self_intersections(&positions, &triangles).is_empty()
}
