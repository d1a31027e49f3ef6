//! Three sweeps of impulses with either test of a pair, and the static check: [`sweeps`].

use crate::cubic;
use glam::DVec3;
use welter_meshing::surface::VertexId;
use welter_predicates::ccd;
use welter_tracking::broad_phase::{BroadPhase, Motion};
use welter_tracking::collision::{TimeOfImpactParameters, time_of_impact};
use welter_tracking::surface::MovingSurface;

/// Four places at the beginning and at the end: of a vertex and a triangle, or of the ends of two edges.
pub(crate) type Places = [[DVec3; 4]; 2];

/// Signed weights of the four vertices, and the normal.
pub(crate) type Touch = ([f64; 4], DVec3);

/// A test of a pair.
pub(crate) trait Narrow: Sync {
    fn touches(&self, edges: bool, places: &Places) -> bool;
    fn touch(&self, edges: bool, places: &Places) -> Option<Touch>;
}

/// By the exact predicates; contacts with a proven time.
pub(crate) struct Exact;

impl Narrow for Exact {
    fn touches(&self, edges: bool, [from, to]: &Places) -> bool {
        if edges { ccd::edge_edge(*from, *to) } else { ccd::vertex_face(*from, *to) }
    }

    fn touch(&self, edges: bool, [from, to]: &Places) -> Option<Touch> {
        let parameters = TimeOfImpactParameters::default();
        let impact = if edges {
            time_of_impact::edge_edge(*from, *to, &parameters)
        } else {
            time_of_impact::vertex_face(*from, *to, &parameters)
        };
        let impact = impact.expect("finite")?;
        Some((signed(edges, impact.weights), DVec3::from_array(impact.normal)))
    }
}

/// By roots of the cubic of coplanarity, within a tolerance.
pub(crate) struct Cubic {
    tolerance: f64,
}

impl Cubic {
    /// The tolerance is relative to a length: 1e-6, the order that cloth codes use.
    pub(crate) fn of(length: f64) -> Self {
        Self { tolerance: 1e-6 * length }
    }
}

impl Narrow for Cubic {
    fn touches(&self, edges: bool, places: &Places) -> bool {
        self.touch(edges, places).is_some()
    }

    fn touch(&self, edges: bool, places: &Places) -> Option<Touch> {
        let (weights, normal) = cubic::first_contact(edges, places, self.tolerance)?;
        Some((signed(edges, weights), normal))
    }
}

fn signed(edges: bool, [a, b, c, d]: [f64; 4]) -> [f64; 4] {
    if edges { [a, b, -c, -d] } else { [a, -b, -c, -d] }
}

/// Pairs that touched in the first sweep, and impulses of all three.
pub(crate) fn sweeps(
    surface: &MovingSurface,
    broad_phase: &mut BroadPhase,
    predicted: &[DVec3],
    narrow: &impl Narrow,
) -> [usize; 2] {
    let mesh = surface.connectivity();
    let mut ends = predicted.to_vec();
    let (mut first, mut impulses) = (None, 0);
    for _ in 0..3 {
        broad_phase.refresh(surface, Motion::To(&ends)).expect("finite");
        let face = |v, t| {
            let [a, b, c] = mesh.corners(t);
            [v, a, b, c]
        };
        let edges = |e, f| {
            let ([a, b], [c, d]) = (mesh.ends(e), mesh.ends(f));
            [a, b, c, d]
        };
        let places = |four: [VertexId; 4], ends: &[DVec3]| {
            [four.map(|v| surface.position(v)), four.map(|v| ends[v.index()])]
        };
        let with_faces = broad_phase
            .vertex_triangle_pairs_that(mesh, 0.0, |v, t| narrow.touches(false, &places(face(v, t), &ends)))
            .expect("zero");
        let with_edges = broad_phase
            .edge_edge_pairs_that(mesh, 0.0, |e, f| {
                narrow.touches(true, &places(edges(e.min(f), e.max(f)), &ends))
            })
            .expect("zero");
        first.get_or_insert(with_faces.len() + with_edges.len());
        let pairs = with_faces.iter().map(|&(v, t)| (false, face(v, t)));
        for (is_edges, four) in pairs.chain(with_edges.iter().map(|&[e, f]| (true, edges(e, f)))) {
            let Some((weights, normal)) = narrow.touch(is_edges, &places(four, &ends)) else { continue };
            let displacement = |i: usize| ends[four[i].index()] - surface.position(four[i]);
            let relative: DVec3 = (0..4).map(|i| weights[i] * displacement(i)).sum();
            let approach = -normal.dot(relative);
            if approach > 0.0 {
                let squares: f64 = weights.iter().map(|w| w * w).sum();
                for (v, w) in four.iter().zip(weights) {
                    ends[v.index()] += (w * approach / squares) * normal;
                }
                impulses += 1;
            }
        }
    }
    broad_phase.refresh(surface, Motion::At(&ends)).expect("finite");
    std::hint::black_box(crate::static_check(surface, broad_phase, &ends));
    [first.unwrap_or(0), impulses]
}
