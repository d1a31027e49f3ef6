//! Which pieces are part of the union: [`selected`].
//!
//! # Method
//! The union has at each point the larger of the winding numbers of both sides there \[Zhou16\]. A piece with its own side's number `a` above it, and so
//! `a + 1` below, in a place where the other side has the number `w`, parts `max(a, w)` from `max(a + 1, w)`: it stays iff `a >= w`, and keeps
//! its orientation. So two triangles that cross cut each other iff both have the same number above them; else one stays or goes on both
//! sides of the other.
//!
//! The number `w` is the same for all pieces that are joined without crossing a curve. At a curve it is that above or below the
//! triangle of the other side, exactly; pieces that are joined to no curve are asked for the winding number about a vertex.

use std::collections::BTreeMap;

use welter_meshing::spatial::Box3;
use welter_meshing::surface::{TriId, VertexId};

use super::super::HalfEdge;
use super::error::Stop;
use super::overlay::Overlay;
use super::patches::Patches;
use super::piercing::Crossings;
use super::refinement::Refinement;
use super::walls::{Side, Walls};
use super::{UnionError, UnionObstacle};

/// Of the pairs that meet, those that cut each other.
pub(super) fn cutting(walls: &Walls, meeting: &[[TriId; 2]]) -> Result<Vec<[TriId; 2]>, Stop> {
    let mut cutting = Vec::new();
    for &pair in meeting {
        let mut numbers = [0; 2];
        for (number, triangle) in numbers.iter_mut().zip(pair) {
            *number = walls.above(triangle).ok_or(Stop::Degenerate(UnionObstacle::Parts))?;
            if *number < 0 {
                return Err(UnionError::InsideOut { triangle }.into());
            }
        }
        if numbers[0] == numbers[1] {
            cutting.push(pair);
        }
    }
    Ok(cutting)
}

/// By piece, whether it stays.
pub(super) fn selected(
    overlay: &Overlay,
    crossings: &Crossings,
    refinement: &Refinement,
    walls: &Walls,
    sides: &[Side<'_>; 2],
) -> Result<Vec<bool>, Stop> {
    let mesh = &refinement.connectivity;
    let first_new = overlay.mesh.positions().len();
    let ways = ways(crossings, walls, first_new)?;
    let on_curve = |edge| {
        let [a, b] = mesh.ends(edge);
        b.index().min(a.index()) >= first_new && ways.curves.binary_search(&[a.min(b), a.max(b)]).is_ok()
    };
    let parts = Patches::new(mesh, |edge| mesh.edge_triangles(edge) == 2 && !on_curve(edge));

    let mut numbers: Vec<Option<i32>> = vec![None; parts.count()];
    let mut boxes = vec![Box3::EMPTY; parts.count()];
    let mut vertices: Vec<Option<VertexId>> = vec![None; parts.count()];
    for (t, piece) in (0_u32..).map(TriId).zip(&refinement.pieces) {
        let part = parts.of(t);
        boxes[part] = boxes[part].union(&Box3::of(piece.corners.map(|v| refinement.positions[v.index()])));
        vertices[part] = vertices[part].or(piece.corners.into_iter().find(|v| v.index() < first_new));
        if !crossings.cuts.contains_key(&piece.origin) {
            continue;
        }
        for h in (0..3).map(|k| HalfEdge::of(t, k)) {
            let Some(&number) = ways.numbers.get(&(piece.origin, [mesh.tail(h), mesh.head(h)])) else {
                continue;
            };
            if numbers[part].replace(number).is_some_and(|other| other != number) {
                return Err(Stop::Degenerate(UnionObstacle::Parts));
            }
        }
    }
    let mut stays = vec![true; parts.count()];
    for part in 0..parts.count() {
        let origin = refinement.pieces[parts.first(part).index()].origin;
        let side = overlay.side(origin);
        let number = match numbers[part] {
            Some(number) => number,
            None if !boxes[part].meets(&overlay.boxes[1 - side]) => 0,
            None => {
                let vertex = vertices[part].ok_or(Stop::Degenerate(UnionObstacle::Parts))?;
                sides[1 - side]
                    .winding(overlay.position(vertex))
                    .ok_or(Stop::Degenerate(UnionObstacle::Parts))?
            }
        };
        // A sheet has no inside: it stays where it is, also within the shape.
        if number == 0 || overlay.open[origin.index()] {
            continue;
        }
        let own = walls.above(origin).ok_or(Stop::Degenerate(UnionObstacle::Parts))?;
        if number < 0 || own < 0 {
            return Err(UnionError::InsideOut { triangle: origin }.into());
        }
        stays[part] = own >= number;
    }
    Ok((0..refinement.pieces.len()).map(|i| stays[parts.of(TriId::from_index(i))]).collect())
}

/// The ways along the curves.
struct Ways {
    /// By the triangle that is cut and the ends of a way: the number of the other side on the left of it.
    numbers: BTreeMap<(TriId, [VertexId; 2]), i32>,
    /// The ends of all segments, the smaller first; ascending.
    curves: Vec<[VertexId; 2]>,
}

fn ways(crossings: &Crossings, walls: &Walls, first_new: usize) -> Result<Ways, Stop> {
    let mut numbers = BTreeMap::new();
    let mut curves = Vec::new();
    for (&triangle, cut) in &crossings.cuts {
        for segment in &cut.segments {
            let above = walls.above(segment.other).ok_or(Stop::Degenerate(UnionObstacle::Parts))?;
            let [a, b] = segment.ends.map(|i| VertexId::from_index(first_new + i as usize));
            curves.push([a.min(b), a.max(b)]);
            for (way, is_above) in [([a, b], segment.left_above), ([b, a], !segment.left_above)] {
                let number = if is_above { above } else { above + 1 };
                if numbers.insert((triangle, way), number).is_some() {
                    return Err(Stop::Degenerate(UnionObstacle::Parts));
                }
            }
        }
    }
    curves.sort_unstable();
    curves.dedup();
    Ok(Ways { numbers, curves })
}
