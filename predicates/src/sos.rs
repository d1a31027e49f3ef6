//! Symbolic perturbation: orientations that are never zero.
//!
//! **Computes** the sign of `orient2d`, `orient3d`, `incircle` or `insphere` after an infinitely small
//! displacement of all points. The displacement of a point depends on its id and on nothing else, so that all
//! answers speak of one and the same displaced set: an algorithm that uses them sees points in general position.
//!
//! **Promises**, for finite coordinates and distinct ids: never `Zero`; the sign of the plain predicate where that
//! is not zero; odd under every exchange of two points together with their ids; consistency, as above. Only the
//! order of the ids counts, not their values. Triangulations built from `incircle_sos` and `orient2d_sos`, or
//! from `insphere_sos` and `orient3d_sos`, are the regular triangulation of the displaced lifted points: unique
//! and valid even for points on one grid, sphere, plane or line. All distinct points are vertices of it; of points
//! that coincide inside the hull, the one with the greatest id is.
//!
//! **Does not promise** anything about equal ids: then the answer is the plain predicate's, which is zero where
//! they name the same point. When a coordinate is infinite or NaN the answer is `Zero`.
//!
//! **Method** \[Edelsbrunner90\]. Each predicate is the determinant of a matrix with a row `x, y(, z)(, w), 1` for
//! each point, where `w` is the sum of the squares of the coordinates. With points ranked by id, the entry for
//! the `k`-th coordinate of the `i`-th point is increased by `e^(2^(N + d i + k))`, in `d` dimensions, and its `w`,
//! which counts as independent of the coordinates, by `e^(2^i)`: of any set of these, the product is larger than
//! that of another set if its exponent, read in binary, is smaller. `N` exceeds every rank, so that every `w` is
//! displaced by more than every coordinate. The determinant is then a polynomial in `e` whose terms are the
//! partial matchings of rows and columns; the coefficient of a matching is the minor of the rows and columns it
//! leaves over, with a sign. The answer is the sign of the first coefficient that is not zero, in ascending order
//! of exponents. The full matchings have coefficients 1 and -1, so there is one.
//!
//! The first coefficients of `incircle_sos` after the plain determinant are thus `orient2d` of three of the four
//! points, and those of `insphere_sos` are `orient3d` of four of the five.
//!
//! **Complexity**: that of the plain predicate where it is not zero. Else minors of its matrix, few unless the
//! points are degenerate in several ways at once: of at most 13, 73, 73 and 501 for the four predicates.

mod expansion;
#[cfg(test)]
mod tests;

use crate::{Point, Sign, incircle, insphere, orient2d, orient3d};
use expansion::Expansion;

/// [`orient2d`] of displaced points; `ids[i]` names `points[i]`.
///
/// ```
/// use welter_predicates::{Sign, sos::orient2d_sos};
/// let [a, b, c] = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
/// let sign = orient2d_sos([a, b, c], [7, 8, 9]);
/// assert_ne!(sign, Sign::Zero);
/// assert_eq!(orient2d_sos([b, a, c], [8, 7, 9]), -sign);
/// assert_eq!(orient2d_sos([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [7, 8, 9]), Sign::Positive);
/// ```
pub fn orient2d_sos(points: [impl Point<2>; 3], ids: [u64; 3]) -> Sign {
    let points = points.map(Point::coords);
    let [a, b, c] = points;
    decide(orient2d(a, b, c), points, ids, false)
}

/// [`orient3d`] of displaced points; `ids[i]` names `points[i]`.
///
/// ```
/// use welter_predicates::{Sign, sos::orient3d_sos};
/// let square = [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [1.0, 1.0, 5.0], [0.0, 1.0, 5.0]];
/// assert_ne!(orient3d_sos(square, [0, 1, 2, 3]), Sign::Zero);
/// assert_ne!(orient3d_sos([[0.5; 3]; 4], [0, 1, 2, 3]), Sign::Zero);
/// ```
pub fn orient3d_sos(points: [impl Point<3>; 4], ids: [u64; 4]) -> Sign {
    let points = points.map(Point::coords);
    let [a, b, c, d] = points;
    decide(orient3d(a, b, c, d), points, ids, false)
}

/// [`incircle`] of displaced points; `ids[i]` names `points[i]`.
///
/// ```
/// use welter_predicates::{Sign, sos::incircle_sos};
/// let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
/// assert_ne!(incircle_sos(square, [0, 1, 2, 3]), Sign::Zero);
/// ```
pub fn incircle_sos(points: [impl Point<2>; 4], ids: [u64; 4]) -> Sign {
    let points = points.map(Point::coords);
    let [a, b, c, d] = points;
    decide(incircle(a, b, c, d), points, ids, true)
}

/// [`insphere`] of displaced points; `ids[i]` names `points[i]`.
///
/// ```
/// use welter_predicates::{Sign, sos::insphere_sos};
/// let face = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_ne!(insphere_sos(face, [4, 2, 0, 1, 3]), Sign::Zero);
/// ```
pub fn insphere_sos(points: [impl Point<3>; 5], ids: [u64; 5]) -> Sign {
    let points = points.map(Point::coords);
    let [a, b, c, d, e] = points;
    decide(insphere(a, b, c, d, e), points, ids, true)
}

#[inline]
fn decide<const N: usize, const P: usize>(
    plain: Sign,
    points: [[f64; N]; P],
    ids: [u64; P],
    lifted: bool,
) -> Sign {
    if plain.is_zero() { Expansion::new(points, ids, lifted).sign() } else { plain }
}
