//! Which pairs of triangles of a mesh intersect, by trying all: [`self_intersections`].

use super::{lift, linear, meeting};
use rug::Integer;

/// All pairs `i < j` of triangles that have a common point outside the vertex or edge that they share by index, in order.
/// Two triangles with the same three vertices always count.
#[must_use]
pub fn self_intersections(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    for j in 0..triangles.len() {
        for i in 0..j {
            if intersect(positions, triangles[i], triangles[j]) {
                pairs.push([i, j].map(|t| u32::try_from(t).expect("few triangles")));
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

fn intersect(positions: &[[f64; 3]], a: [u32; 3], b: [u32; 3]) -> bool {
    let corners = |t: [u32; 3]| t.map(|v| positions[v as usize]);
    let shared: Vec<usize> = (0..3).filter(|&i| b.contains(&a[i])).collect();
    if shared.len() == 3 {
        return true;
    }
    let (p, q) = (corners(a), corners(b));
    // Homogeneous coordinates in the unit in which `meeting` gives its corners.
    let lifted = lift(&[p, q].concat());
    let shared: Vec<Vec<Integer>> =
        shared.iter().map(|&i| lifted[i].iter().cloned().chain([Integer::from(1)]).collect()).collect();
    meeting(&p, &q).corners.iter().any(|corner| !hull_contains(&shared, &corner.point))
}

/// True if a point is in the hull of at most two points: some of them carry it with positive weights.
fn hull_contains(points: &[Vec<Integer>], point: &[Integer]) -> bool {
    (1_u32..1 << points.len()).any(|support| {
        let chosen: Vec<&[Integer]> =
            (0..points.len()).filter(|i| support >> i & 1 == 1).map(|i| points[i].as_slice()).collect();
        linear::solve(&chosen, point)
            .is_some_and(|(weights, denominator)| weights.iter().all(|w| w.cmp0() == denominator.cmp0()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_shared_does_not_count() {
        let positions = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [4.0, 4.0, 0.0], [1.0, 1.0, 0.0]];
        let found = |a, b| !self_intersections(&positions, &[a, b]).is_empty();
        // Along an edge, folded over each other, at a vertex, through a vertex, the same, and the same reversed.
        assert!(!found([0, 1, 2], [1, 3, 2]));
        assert!(found([0, 1, 2], [1, 2, 4]));
        assert!(!found([0, 1, 4], [4, 2, 3]));
        assert!(found([0, 1, 2], [0, 1, 3]));
        assert!(found([0, 1, 2], [0, 1, 2]) && found([0, 1, 2], [2, 1, 0]));
        // Degenerate: a segment through a triangle that it touches at one vertex, and one outside.
        let flat = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, 0.0], [-1.0, -1.0, 0.0]];
        assert!(!self_intersections(&flat, &[[0, 1, 2], [0, 3, 4]]).is_empty());
        let flat = [flat[0], flat[1], flat[2], [-2.0, -2.0, 0.0], [-1.0, -1.0, 0.0]];
        assert!(self_intersections(&flat, &[[0, 1, 2], [0, 3, 4]]).is_empty());
    }
}
