//! On which side of a plane or, in the projection along an axis, of a line a moved point lies.

use super::{P2, P3};
use crate::finite::check_finite;
use crate::intersection::{all_finite, project, sides};
use crate::polynomial::{self, Rounded};
use crate::{NonFinite, Point, Sign, Stage, filter, orient2d, orient3d, stats};

/// [`orient3d`] of a plane through `a`, `b`, `c` and a moved node: where the unmoved node lies on the plane, the sign
/// is that of the side to which the move takes it.
///
/// [`Sign::Zero`] only if `a`, `b`, `c` are collinear or a coordinate is not finite.
///
/// ```
/// use welter_predicates::{Sign, moved_grid::orient3d_moved};
/// let [a, b, c] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// // Just above the plane z = 0, hence negative, as of (0, 0, 1).
/// assert_eq!(orient3d_moved(a, b, c, [0.0; 3]), Sign::Negative);
/// assert_eq!(orient3d_moved(a, b, c, [0.0, 0.0, -5e-324]), Sign::Positive);
/// ```
#[inline]
#[must_use]
pub fn orient3d_moved(a: impl Point<3>, b: impl Point<3>, c: impl Point<3>, node: impl Point<3>) -> Sign {
    side_of_plane(&[a.coords(), b.coords(), c.coords()], node.coords())
}

/// As [`orient3d_moved`], checked; arguments are counted `a`, `b`, `c`, `node`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::moved_grid::try_orient3d_moved;
/// let [a, b, c] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// assert_eq!(try_orient3d_moved(a, b, c, [0.0, 0.0, f64::NAN]).unwrap_err().argument, 3);
/// ```
#[inline]
pub fn try_orient3d_moved(
    a: impl Point<3>,
    b: impl Point<3>,
    c: impl Point<3>,
    node: impl Point<3>,
) -> Result<Sign, NonFinite> {
    let [a, b, c, node] = [a.coords(), b.coords(), c.coords(), node.coords()];
    check_finite(&[a, b, c, node])?;
    Ok(side_of_plane(&[a, b, c], node))
}

/// [`orient3d_moved`] of a triangle.
#[inline(always)]
pub(super) fn side_of_plane(t: &[P3; 3], node: P3) -> Sign {
    let plain = orient3d(t[0], t[1], t[2], node);
    if plain.is_zero() { side_to_which_the_node_moves(&copied(t), node) } else { plain }
}

/// [`orient3d_moved`] of a triangle and several nodes.
#[inline(always)]
pub(super) fn sides_of_plane<const K: usize>(t: &[P3; 3], nodes: &[P3; K]) -> [Sign; K] {
    let mut sides = sides(t, nodes);
    for (side, &node) in sides.iter_mut().zip(nodes) {
        if side.is_zero() {
            *side = side_to_which_the_node_moves(&copied(t), node);
        }
    }
    sides
}

/// A fresh array, to be made on the slow path only: passing the points on would keep those of the fast path in memory instead of
/// registers.
#[inline(always)]
pub(super) fn copied<const P: usize>(points: &[P3; P]) -> [P3; P] {
    core::array::from_fn(|i| core::array::from_fn(|j| points[i][j]))
}

/// The determinant is `-n . (node - a)`, with the normal `n = (b - a) x (c - a)`.
#[cold]
#[inline(never)]
fn side_to_which_the_node_moves(t: &[P3; 3], node: P3) -> Sign {
    if !all_finite(t) || !all_finite(&[node]) {
        return Sign::Zero;
    }
    let normal = (0..3).map(|k| orient2d(project(t[0], k), project(t[1], k), project(t[2], k)));
    -normal.fold(Sign::Zero, first)
}

/// [`orient2d`] of the line from `u` to `v` and the moved point `p`, all in the projection along `axis`: [`Sign::Zero`] only if
/// `u` and `v` are equal or a coordinate is not finite.
#[inline(always)]
pub(super) fn side_of_line(axis: usize, u: P2, v: P2, p: P2) -> Sign {
    let plain = orient2d(u, v, p);
    if plain.is_zero() { side_to_which_the_point_moves(axis, u, v, p) } else { plain }
}

/// The sides of a moved point to several lines as far as rounded arithmetic tells them: whether each is
/// certain, whether one is certainly positive, whether one is certainly negative. Without a branch for each line.
#[inline(always)]
pub(super) fn rounded_sides<const E: usize>(lines: &[[P2; 3]; E]) -> [bool; 3] {
    let (mut certain, mut positive, mut negative) = (true, false, false);
    for [u, v, p] in lines {
        let rows = [[u[0] - p[0], u[1] - p[1]], [v[0] - p[0], v[1] - p[1]]];
        let (value, error) = (polynomial::orient2d::<Rounded>(&rows), filter::orient2d(&rows));
        // Neither if the bound is not finite.
        let (above, below) = (value > error, value < -error);
        certain &= above | below;
        positive |= above;
        negative |= below;
        if above | below {
            stats::count(stats::Kind::Orient2d, Stage::Filter);
        }
    }
    [certain, positive, negative]
}

/// The determinant is `(v - u) x (p - u)`.
#[cold]
#[inline(never)]
fn side_to_which_the_point_moves(axis: usize, u: P2, v: P2, p: P2) -> Sign {
    if !all_finite(&[u, v, p]) {
        return Sign::Zero;
    }
    let derivatives = [Sign::of_difference(u[1], v[1]), Sign::of_difference(v[0], u[0])];
    let [larger, smaller] = by_size_of_move(axis);
    first(derivatives[larger], derivatives[smaller])
}

/// The two coordinates of the projection along `axis`, that which moves more first.
pub(super) const fn by_size_of_move(axis: usize) -> [usize; 2] {
    // (y, z), (z, x), (x, y)
    if axis == 1 { [1, 0] } else { [0, 1] }
}

/// The first sign that is not zero.
#[inline(always)]
pub(super) fn first(one: Sign, other: Sign) -> Sign {
    if one.is_zero() { other } else { one }
}
