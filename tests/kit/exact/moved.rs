//! A grid moved by amounts so small that every sign is that of an infinitesimal move.
//!
//! The coordinates of a query are lifted to integers of at most `b` bits. What is asked about a moved point is the sign of an
//! affine function of the move `(c, e, d)`, or follows from several: its four coefficients are integers of some degree `n` in
//! differences of coordinates, sums of at most 72 products, hence below `2^(n (b + 1) + 7)`. The degree is 3 (a plane and a node)
//! or 5 (two planes met by one line: two sums of three minors of two rows, times determinants of three rows). With
//! `K = n (b + 1) + 9` the move is `c = 2^-K`, `e = 2^-2K`, `d = 2^-3K`: then each coefficient that is not zero, times its
//! part of the move, outweighs all that follow. All is multiplied by `2^3K`, so that the move is by whole numbers.

use super::clip::clip_to_box_of_integers;
use super::{determinant, lift};
use rug::{Integer, Rational};

type P3 = [f64; 3];
type Lifted = [Integer; 3];

/// Points that stay and points that move, in one unit, for questions of a degree.
fn moved(degree: u32, still: &[P3], grid: &[P3]) -> (Vec<Lifted>, Vec<Lifted>) {
    let mut still: Vec<Lifted> = lift(&[still, grid].concat());
    let bits = still.iter().flatten().map(Integer::significant_bits).max().expect("points");
    let k = degree * (bits + 1) + 9;
    still.iter_mut().flatten().for_each(|x| *x <<= 3 * k);
    let mut grid = still.split_off(still.len() - grid.len());
    for point in &mut grid {
        for (axis, x) in (0..).zip(point) {
            *x += Integer::from(1) << ((2 - axis) * k);
        }
    }
    (still, grid)
}

/// The sign of the orientation of three points and a moved one.
#[must_use]
pub fn moved_orient(plane: &[P3; 3], node: P3) -> i32 {
    let (mut points, node) = moved(3, plane, &[node]);
    points.extend(node);
    let rows: Vec<Vec<Integer>> =
        points.into_iter().map(|point| point.into_iter().chain([Integer::from(1)]).collect()).collect();
    determinant(&rows).cmp0() as i32
}

/// Whether a closed box, moved, meets the hull of some points (a point, segment or triangle, degenerate or not).
#[must_use]
pub fn moved_box_meets(min: P3, max: P3, points: &[P3]) -> bool {
    let (points, bounds) = moved(3, points, &[min, max]);
    !clip_to_box_of_integers(&points, &bounds[0], &bounds[1]).is_empty()
}

/// What a line of a moved grid meets, in units common to all coordinates along it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MovedLine {
    /// Of each triangle the coordinate at which the line meets it, if it does.
    pub crossings: Vec<Option<Rational>>,
    /// Of each triangle the coordinate at which the line meets its plane, unless that is parallel to it.
    pub planes: Vec<Option<Rational>>,
    /// Of each triangle the sign of the component of its normal along the line.
    pub normals: Vec<i32>,
    /// The coordinates of nodes on the line.
    pub nodes: Vec<Integer>,
}

impl MovedLine {
    /// The line along an axis whose other coordinates, in cyclic order, are `line`, with nodes at some coordinates.
    #[must_use]
    pub fn new(axis: usize, line: [f64; 2], triangles: &[[P3; 3]], nodes: &[f64]) -> Self {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let node = |along: f64| {
            let mut node = [along; 3];
            (node[u], node[v]) = (line[0], line[1]);
            node
        };
        let of_line: Vec<P3> = [0.0].iter().chain(nodes).map(|&along| node(along)).collect();
        let (corners, of_line) = moved(5, triangles.as_flattened(), &of_line);
        let triangles: Vec<&[Lifted]> = corners.chunks(3).collect();
        let normal = |t: &[Lifted], i: usize, j: usize| -> Integer {
            let edge = |end: usize, k: usize| Integer::from(&t[end][k] - &t[0][k]);
            edge(1, i) * edge(2, j) - edge(1, j) * edge(2, i)
        };
        Self {
            crossings: triangles.iter().map(|t| crossing(t, &of_line[0], axis)).collect(),
            planes: triangles
                .iter()
                .map(|t| {
                    let n = [normal(t, 1, 2), normal(t, 2, 0), normal(t, 0, 1)];
                    let from = |k: usize| Integer::from(&of_line[0][k] - &t[0][k]);
                    let below = &n[u] * from(u) + &n[v] * from(v);
                    (!n[axis].is_zero())
                        .then(|| Rational::from(&t[0][axis]) - Rational::from((below, n[axis].clone())))
                })
                .collect(),
            normals: triangles.iter().map(|t| normal(t, u, v).cmp0() as i32).collect(),
            nodes: of_line[1..].iter().map(|node| node[axis].clone()).collect(),
        }
    }
}

/// Where a line meets a closed triangle: what is left of it in a box of no width.
fn crossing(t: &[Lifted], on_line: &Lifted, axis: usize) -> Option<Rational> {
    let (mut min, mut max) = (on_line.clone(), on_line.clone());
    min[axis] = t.iter().map(|p| &p[axis]).min().expect("three corners").clone();
    max[axis] = t.iter().map(|p| &p[axis]).max().expect("three corners").clone();
    let left = clip_to_box_of_integers(t, &min, &max);
    let mut coordinates = left.into_iter().map(|p| Rational::from((p[axis].clone(), p[3].clone())));
    let first = coordinates.next()?;
    assert!(coordinates.all(|other| other == first), "a moved line lies in no plane through three points");
    Some(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    const T: [P3; 3] = [[0.0, 0.0, 5.0], [2.0, 0.0, 5.0], [0.0, 2.0, 5.0]];

    #[test]
    fn moves_take_ties_away_from_the_origin() {
        assert_eq!(moved_orient(&T, [0.0, 0.0, 5.0]), -1);
        assert_eq!(moved_orient(&T, [0.0, 0.0, 5.0f64.next_down()]), 1);
        // The plane x = y, then x = -y: x moves most.
        assert_eq!(moved_orient(&[[0.0; 3], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.0; 3]), -1);
        assert_eq!(moved_orient(&[[0.0; 3], [1.0, -1.0, 0.0], [0.0, 0.0, 1.0]], [0.0; 3]), 1);
        assert!(moved_box_meets([0.0, 0.0, 4.0], [1.0, 1.0, 5.0], &T));
        assert!(!moved_box_meets([0.0, 0.0, 5.0], [1.0, 1.0, 6.0], &T));
    }

    #[test]
    fn lines_through_corners_and_edges() {
        let at = |line: [f64; 2]| MovedLine::new(2, line, &[T], &[5.0]).crossings[0].is_some();
        assert!(at([0.0, 0.0]) && at([1.0, 0.0]) && at([0.0, 1.0]));
        assert!(!at([2.0, 0.0]) && !at([0.0, 2.0]) && !at([1.0, 1.0]));
        let line = MovedLine::new(2, [0.5; 2], &[T], &[5.0]);
        assert_eq!((&line.crossings, line.normals[0]), (&line.planes, 1));
        assert!(line.crossings[0].clone().unwrap() < line.nodes[0]);
        let beside = MovedLine::new(0, [0.5, 5.0], &[T], &[]);
        assert_eq!((&beside.crossings[0], &beside.planes[0], beside.normals[0]), (&None, &None, 0));
    }
}
