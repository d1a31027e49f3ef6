//! Which pairs of triangles of a mesh intersect, by trying all: [`self_intersections`].

use super::{lift, linear, meeting, orient};
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

/// Whether there is such a pair. What is seen at once is passed over: triangles whose boxes are apart; and those of which one has all
/// corners that are not shared strictly on one side of the plane of the other, so that it meets that plane in what is shared alone.
#[must_use]
pub fn intersects_itself(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> bool {
    let place = |v: u32| positions[v as usize];
    let reach = |t: [u32; 3], axis: usize| {
        let along = t.map(|v| place(v)[axis]);
        [along.into_iter().fold(f64::INFINITY, f64::min), along.into_iter().fold(f64::NEG_INFINITY, f64::max)]
    };
    let boxes: Vec<[[f64; 2]; 3]> = triangles.iter().map(|&t| [0, 1, 2].map(|axis| reach(t, axis))).collect();
    let apart = |i: usize, j: usize| {
        (0..3).any(|axis| boxes[i][axis][1] < boxes[j][axis][0] || boxes[j][axis][1] < boxes[i][axis][0])
    };
    let beside = |one: [u32; 3], other: [u32; 3]| {
        let [a, b, c] = other.map(place);
        let free = one.iter().filter(|v| !other.contains(v));
        let sides: Vec<i32> = free.map(|&v| orient(&[a, b, c, place(v)])).collect();
        !sides.is_empty() && sides.iter().all(|&side| side != 0 && side == sides[0])
    };
    let meet = |a: [u32; 3], b: [u32; 3]| !beside(a, b) && !beside(b, a) && intersect(positions, a, b);
    (0..triangles.len()).any(|j| (0..j).any(|i| !apart(i, j) && meet(triangles[i], triangles[j])))
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
        let found = |a, b| {
            let found = !self_intersections(&positions, &[a, b]).is_empty();
            assert_eq!(intersects_itself(&positions, &[a, b]), found);
            found
        };
        // Along an edge, folded over each other, at a vertex, through a vertex, the same, and the same reversed.
        assert!(!found([0, 1, 2], [1, 3, 2]));
        assert!(found([0, 1, 2], [1, 2, 4]));
        assert!(!found([0, 1, 4], [4, 2, 3]));
        assert!(found([0, 1, 2], [0, 1, 3]));
        assert!(found([0, 1, 2], [0, 1, 2]) && found([0, 1, 2], [2, 1, 0]));
        // Degenerate: a segment through a triangle that it touches at one vertex, and one outside.
        let flat = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, 0.0], [-1.0, -1.0, 0.0]];
        assert!(!self_intersections(&flat, &[[0, 1, 2], [0, 3, 4]]).is_empty());
        assert!(intersects_itself(&flat, &[[0, 1, 2], [0, 3, 4]]));
        let flat = [flat[0], flat[1], flat[2], [-2.0, -2.0, 0.0], [-1.0, -1.0, 0.0]];
        assert!(self_intersections(&flat, &[[0, 1, 2], [0, 3, 4]]).is_empty());
    }
}
