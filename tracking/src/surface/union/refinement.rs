//! Both sides, cut along the curves: [`Refinement`].

use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::surface::{TriId, VertexId};

use super::super::RadialConnectivity;
use super::UnionObstacle;
use super::error::Stop;
use super::overlay::Overlay;
use super::piercing::{Crossings, Cut};
use super::triangulation::{Problem, triangulate};
use crate::quadric::scale::Scale;

/// A triangle, or a part of one that was cut.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) corners: [VertexId; 3],
    /// The triangle of the overlay of which it is.
    pub(super) origin: TriId,
    /// Which part of it.
    pub(super) share: f64,
}

/// All pieces, by their origins, with their connectivity; piercings are vertices after those of the overlay.
#[derive(Debug)]
pub(super) struct Refinement {
    pub(super) pieces: Vec<Piece>,
    pub(super) connectivity: RadialConnectivity,
    pub(super) positions: Vec<DVec3>,
}

impl Refinement {
    pub(super) fn new(overlay: &Overlay, crossings: &Crossings) -> Result<Self, Stop> {
        let cuts: Vec<(TriId, &Cut)> = crossings.cuts.iter().map(|(&t, cut)| (t, cut)).collect();
        let parts: Vec<Option<Vec<Piece>>> =
            cuts.par_iter().map(|&(t, cut)| pieces_of(overlay, crossings, t, cut)).collect();
        let mut parts = parts.into_iter();
        let mut pieces = Vec::with_capacity(overlay.mesh.triangles().len());
        for origin in overlay.connectivity.triangles() {
            if crossings.cuts.contains_key(&origin) {
                let parts = parts.next().expect("the parts of each cut triangle, in their order");
                pieces.extend(parts.ok_or(Stop::Degenerate(UnionObstacle::Order))?);
            } else {
                let corners = overlay.connectivity.corners(origin);
                pieces.push(Piece { corners, origin, share: 1.0 });
            }
        }
        let mut positions = overlay.mesh.positions().to_vec();
        positions.extend(crossings.piercings.iter().map(|piercing| piercing.position));
        let corners = pieces.iter().map(|piece| piece.corners).collect();
        let connectivity = RadialConnectivity::canonical(positions.len(), corners);
        Ok(Self { pieces, connectivity, positions })
    }

    /// Whether a triangle is whole.
    pub(super) fn is_whole(piece: &Piece, crossings: &Crossings) -> bool {
        !crossings.cuts.contains_key(&piece.origin)
    }
}

/// The parts of a triangle; none if its points are in no order that allows them.
fn pieces_of(overlay: &Overlay, crossings: &Crossings, triangle: TriId, cut: &Cut) -> Option<Vec<Piece>> {
    let corners = overlay.connectivity.corners(triangle);
    let mut points = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    // The piercing of each further point.
    let mut numbers: Vec<u32> = Vec::new();
    let mut sides: [Vec<u32>; 3] = Default::default();
    for (k, edge) in overlay.edges(triangle).into_iter().enumerate() {
        let Some(list) = crossings.on_edge.get(&edge) else { continue };
        let forward = corners[k] < corners[(k + 1) % 3];
        let ordered: Vec<u32> = if forward { list.clone() } else { list.iter().rev().copied().collect() };
        for i in ordered {
            let fraction = crossings.piercings[i as usize].fraction;
            // Both are exact.
            let [to, from] = if forward { [fraction, 1.0 - fraction] } else { [1.0 - fraction, fraction] };
            sides[k].push(points.len() as u32);
            points.push([[to, 0.0], [from, to], [0.0, from]][k]);
            numbers.push(i);
        }
    }
    let mut inside = Vec::new();
    for &i in &cut.inside {
        inside.push(points.len() as u32);
        points.push(crossings.piercings[i as usize].weights);
        numbers.push(i);
    }
    let mut order: Vec<(u32, u32)> = numbers.iter().copied().zip(3..).collect();
    order.sort_unstable();
    let local = |i: u32| order.binary_search_by_key(&i, |&(number, _)| number).ok().map(|at| order[at].1);
    let segments =
        cut.segments.iter().map(|segment| Some([local(segment.ends[0])?, local(segment.ends[1])?]));
    let segments = segments.collect::<Option<Vec<_>>>()?;

    let [a, b, c] = overlay.mesh.corners(triangle);
    let longest = [b - a, c - a].map(|edge| edge.abs().max_element()).into_iter().fold(0.0, f64::max);
    let scale = Scale::of_length(longest, 1.0);
    let [u, v] = [scale.difference(b, a), scale.difference(c, a)];
    let problem = Problem { points, sides, inside, segments, metric: [u.dot(u), u.dot(v), v.dot(v)] };
    let first_new = overlay.mesh.positions().len();
    let vertex = |i: u32| match i.checked_sub(3) {
        None => corners[i as usize],
        Some(i) => VertexId::from_index(first_new + numbers[i as usize] as usize),
    };
    let share = |part: [u32; 3]| {
        let [p, q, r] = part.map(|i| problem.points[i as usize]);
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    let parts = triangulate(&problem)?;
    Some(
        parts
            .into_iter()
            .map(|part| Piece { corners: part.map(vertex), origin: triangle, share: share(part) })
            .collect(),
    )
}
