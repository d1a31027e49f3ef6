//! Which of two crossings with a line of the moved grid comes first: [`compare_crossings`].
//!
//! Along the last axis, with differences to a point `p` of the line, the plane of a triangle with the normal `n` is met at
//! `p[2] + V / n[2]`, `V` the determinant of its rows: affine in the line, with the slopes `-n[0] / n[2]` and
//! `-n[1] / n[2]`. So the crossings with two planes are compared by a polynomial of degree 5, and where
//! they are equal the slopes by polynomials of degree 4, that for the coordinate that moves more first. Planes
//! that agree in all three are the same.

use core::cmp::Ordering;

use super::line::check_line;
use super::node::by_size_of_move;
use super::{P2, P3};
use crate::arithmetic::double_double;
use crate::finite::check_finite;
use crate::intersection::{all_finite, project};
use crate::polynomial::{self, Ring, Rounded};
use crate::stage::{Predicate, settle};
use crate::{NonFinite, Point, Sign, filter, orient2d, stats};

/// Which of the crossings of a moved line with two triangles comes first along the axis; `Equal` only if the triangles lie
/// in one plane.
///
/// The triangles are ones that the line crosses; for others the answer is that of their planes, and `Equal` if one of these is
/// parallel to the axis.
///
/// ```
/// use core::cmp::Ordering;
/// use welter_predicates::moved_grid::compare_crossings;
/// let flat = [[-1.0, -1.0, 5.0], [2.0, -1.0, 5.0], [-1.0, 2.0, 5.0]];
/// let steep = [[-1.0, -1.0, 4.0], [2.0, -1.0, 7.0], [-1.0, 2.0, 4.0]]; // z = x + 5
/// let order = |x: f64| compare_crossings(2, [x, 0.0], flat, steep);
/// assert_eq!([-0.1, 0.0, 0.1].map(order), [Ordering::Greater, Ordering::Less, Ordering::Less]);
/// assert_eq!(compare_crossings(2, [0.0, 0.0], flat, flat), Ordering::Equal);
/// ```
#[inline]
#[must_use]
pub fn compare_crossings(
    axis: usize,
    line: [f64; 2],
    first: [impl Point<3>; 3],
    second: [impl Point<3>; 3],
) -> Ordering {
    compare(axis % 3, line, &first.map(Point::coords), &second.map(Point::coords))
}

/// As [`compare_crossings`], checked; arguments are counted `first[0]`, `first[1]`, `first[2]`, `second[0]`,
/// `second[1]`, `second[2]`, `line`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::moved_grid::try_compare_crossings;
/// let t = [[-1.0, -1.0, 5.0], [2.0, -1.0, 5.0], [-1.0, 2.0, 5.0]];
/// assert_eq!(try_compare_crossings(2, [0.0, f64::INFINITY], t, t).unwrap_err().argument, 6);
/// ```
#[inline]
pub fn try_compare_crossings(
    axis: usize,
    line: [f64; 2],
    first: [impl Point<3>; 3],
    second: [impl Point<3>; 3],
) -> Result<Ordering, NonFinite> {
    let (first, second) = (first.map(Point::coords), second.map(Point::coords));
    check_finite(&[first[0], first[1], first[2], second[0], second[1], second[2]])?;
    check_line(6, line)?;
    Ok(compare(axis % 3, line, &first, &second))
}

#[inline]
fn compare(axis: usize, line: P2, first: &[P3; 3], second: &[P3; 3]) -> Ordering {
    let turned = |p: P3| [p[(axis + 1) % 3], p[(axis + 2) % 3], p[axis]];
    let ([a, b, c], [d, e, f]) = (first.map(turned), second.map(turned));
    // Any point of the line will do; one near the triangles keeps the differences small.
    let p = [line[0], line[1], a[2]];
    let mut difference = settle::<Crossings, Sign, 3, 7, 6>(&[a, b, c, d, e, f, p]).0;
    if difference.is_zero() {
        difference = difference_of_slopes(axis, line, &[a, b, c, d, e, f]);
    }
    let normal = |[a, b, c]: [P3; 3]| orient2d(project(a, 2), project(b, 2), project(c, 2));
    match difference * normal([a, b, c]) * normal([d, e, f]) {
        Sign::Negative => Ordering::Less,
        Sign::Zero => Ordering::Equal,
        Sign::Positive => Ordering::Greater,
    }
}

#[cold]
#[inline(never)]
fn difference_of_slopes(axis: usize, line: P2, corners: &[P3; 6]) -> Sign {
    if !all_finite(corners) || !all_finite(&[line]) {
        return Sign::Zero;
    }
    for k in by_size_of_move(axis) {
        let sign = match k {
            0 => settle::<Slopes<0>, Sign, 3, 6, 5>(corners).0,
            _ => settle::<Slopes<1>, Sign, 3, 6, 5>(corners).0,
        };
        if !sign.is_zero() {
            return sign;
        }
    }
    Sign::Zero
}

/// The difference of the crossings of two planes with a line through the last point along the last axis.
pub(crate) struct Crossings;

impl Predicate<3, 7, 6> for Crossings {
    const KIND: stats::Kind = stats::Kind::Crossings;
    const DEGREE: i32 = 5;
    const DOUBLE_DOUBLE_ERROR: f64 = double_double::CROSSINGS;

    #[inline(always)]
    fn polynomial<K: Ring>(rows: &[[K::D1; 3]; 6]) -> K::Outcome {
        polynomial::crossings::<K>(rows).into()
    }

    #[inline(always)]
    fn filter(rows: &[[f64; 3]; 6]) -> (f64, f64) {
        (polynomial::crossings::<Rounded>(rows), filter::crossings(rows))
    }
}

/// The difference of the slopes of the last coordinate of two planes along coordinate `K`, 0 or 1.
pub(crate) struct Slopes<const K: usize>;

impl<const K: usize> Predicate<3, 6, 5> for Slopes<K> {
    const KIND: stats::Kind = stats::Kind::Crossings;
    const DEGREE: i32 = 4;
    const DOUBLE_DOUBLE_ERROR: f64 = double_double::SLOPES;

    #[inline(always)]
    fn polynomial<R: Ring>(rows: &[[R::D1; 3]; 5]) -> R::Outcome {
        polynomial::slopes::<R>(rows, K).into()
    }

    #[inline(always)]
    fn filter(rows: &[[f64; 3]; 5]) -> (f64, f64) {
        (polynomial::slopes::<Rounded>(rows, K), filter::slopes(rows, K))
    }
}
