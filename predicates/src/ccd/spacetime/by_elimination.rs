//! The same questions asked of the linear solver: is there a common point, as weights of the corners of two
//! simplices?
//!
//! With one column for each corner, its coordinates in space-time and a 1, and another 1 in the first simplex
//! \[Brochu12\]:
//!
//! ```text
//! sum w_i x_i = 0      in every coordinate of space-time
//! sum w_i     = 0      over all corners
//! sum w_i     = 1      over those of the first simplex
//! w_i >= 0  in the first simplex,  w_i <= 0  in the second
//! ```
//!
//! The twin of the functions of [`super`], without their culling: the same answers by other means, slower.

use super::super::settle::all_finite;
use super::pieces;
use crate::linear::solvable;
use crate::{Point, Sign};

/// [`super::vertex_face`] by elimination.
///
/// ```
/// use welter_predicates::ccd::spacetime::by_elimination::vertex_face;
/// let at = |z| [[0.0, 0.0, z], [-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
/// assert!(vertex_face(at(1.0), at(0.0), [0, 1, 2, 3]));
/// ```
#[must_use]
pub fn vertex_face(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4], indices: [u32; 4]) -> bool {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    all_finite(&t0, &t1)
        && pieces::vertex_face(&t0, &t1, indices).iter().any(|points| meet::<4, 6, 6>(points, 2))
}

/// [`super::edge_edge`] by elimination.
///
/// ```
/// use welter_predicates::ccd::spacetime::by_elimination::edge_edge;
/// let across = |z| [[-1.0, 0.0, z], [1.0, 0.0, z], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
/// assert!(edge_edge(across(1.0), across(-1.0), [0, 1, 2, 3]));
/// ```
#[must_use]
pub fn edge_edge(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4], indices: [u32; 4]) -> bool {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    all_finite(&t0, &t1)
        && pieces::edge_edge(&t0, &t1, indices).iter().any(|points| meet::<4, 6, 6>(points, 3))
}

/// [`super::vertex_segment_2d`] by elimination.
///
/// ```
/// use welter_predicates::ccd::spacetime::by_elimination::vertex_segment_2d;
/// let at = |y| [[0.0, y], [-1.0, 0.0], [1.0, 0.0]];
/// assert!(vertex_segment_2d(at(1.0), at(-1.0), [0, 1, 2]));
/// ```
#[must_use]
pub fn vertex_segment_2d(t0: [impl Point<2>; 3], t1: [impl Point<2>; 3], indices: [u32; 3]) -> bool {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    all_finite(&t0, &t1)
        && pieces::vertex_segment(&t0, &t1, indices).iter().any(|points| meet::<3, 5, 5>(points, 2))
}

/// Whether the simplex of the first `split` of `K` points meets that of the others, by `E = D + 2` equations.
fn meet<const D: usize, const K: usize, const E: usize>(points: &[[f64; D]; K], split: usize) -> bool {
    const { assert!(E == D + 2) };
    let entry = |row: usize, column: usize| match row {
        row if row < D => points[column][row],
        row if row == D => 1.0,
        _ => f64::from(u8::from(column < split)),
    };
    let matrix: [[f64; K]; E] = core::array::from_fn(|row| core::array::from_fn(|column| entry(row, column)));
    let right = core::array::from_fn(|row| f64::from(u8::from(row == D + 1)));
    let signs = core::array::from_fn(|column| if column < split { Sign::Positive } else { Sign::Negative });
    solvable(&matrix, &right, signs)
}
