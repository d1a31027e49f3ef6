//! The orientation of five points of four-dimensional space.
//!
//! The sign of the determinant with rows `a - e`, `b - e`, `c - e`, `d - e`:
//!
//! ```text
//!     a, b, c, d on the axes x, y, z, w at 1, and       > 0
//!     e = (0, 0, 0, 0)
//!
//!     all five on one hyperplane                        = 0
//!     e on the other side of the four, or two swapped   < 0
//! ```
//!
//! With time as the fourth coordinate it is the orientation of events in space-time.

use crate::arithmetic::double_double;
use crate::polynomial::{self, Ring, Rounded};
use crate::stage::{Predicate, Stage, settle};
use crate::{NonFinite, Point, Sign, filter, finite, stats};

pub(crate) struct Orient4d;

impl Predicate<4, 5, 4> for Orient4d {
    const KIND: stats::Kind = stats::Kind::Orient4d;
    const DEGREE: i32 = 4;
    const DOUBLE_DOUBLE_ERROR: f64 = double_double::ORIENT4D;

    #[inline(always)]
    fn polynomial<K: Ring>(rows: &[[K::D1; 4]; 4]) -> K::Outcome {
        polynomial::orient4d::<K>(rows).into()
    }

    #[inline(always)]
    fn filter(rows: &[[f64; 4]; 4]) -> (f64, f64) {
        (polynomial::orient4d::<Rounded>(rows), filter::orient4d(rows))
    }
}

/// The orientation of five points of four-dimensional space: the sign of the determinant with rows `a - e`, `b - e`,
/// `c - e`, `d - e`.
///
/// Exact for all finite coordinates; [`Sign::Zero`] if one is not finite.
///
/// ```
/// use welter_predicates::{Sign, orient4d};
/// let [a, b, c, d] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
/// assert_eq!(orient4d(a, b, c, d, [0.0; 4]), Sign::Positive);
/// assert_eq!(orient4d(a, b, c, d, [0.25; 4]), Sign::Zero);
/// ```
#[inline]
#[must_use]
pub fn orient4d(
    a: impl Point<4>,
    b: impl Point<4>,
    c: impl Point<4>,
    d: impl Point<4>,
    e: impl Point<4>,
) -> Sign {
    settle::<Orient4d, Sign, 4, 5, 4>(&[a.coords(), b.coords(), c.coords(), d.coords(), e.coords()]).0
}

/// A number with the sign of [`orient4d`]: the determinant, approximately.
///
/// The magnitude is that of 24 times the signed volume of the simplex, with the relative error of the stage that settled the sign: small unless the
/// points are nearly degenerate. It is zero only if the determinant is (or a coordinate is not finite), and always
/// finite: beyond the range of `f64` it is the largest or the smallest magnitude.
///
/// ```
/// use welter_predicates::orient4d_value;
/// let [a, b, c, d] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
/// assert_eq!(orient4d_value(a, b, c, d, [0.0; 4]), 1.0);
/// ```
#[inline]
#[must_use]
pub fn orient4d_value(
    a: impl Point<4>,
    b: impl Point<4>,
    c: impl Point<4>,
    d: impl Point<4>,
    e: impl Point<4>,
) -> f64 {
    settle::<Orient4d, f64, 4, 5, 4>(&[a.coords(), b.coords(), c.coords(), d.coords(), e.coords()]).0
}

/// [`orient4d`] for coordinates that may not be finite.
///
/// # Errors
/// [`NonFinite`] with the first coordinate that is infinite or not a number.
///
/// ```
/// use welter_predicates::{NonFinite, try_orient4d};
/// let [a, b, c, d] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
/// let error = try_orient4d(a, b, c, d, [0.0, 0.0, 0.0, f64::INFINITY]);
/// assert_eq!(error, Err(NonFinite { argument: 4, coordinate: 3, value: f64::INFINITY }));
/// ```
#[inline]
pub fn try_orient4d(
    a: impl Point<4>,
    b: impl Point<4>,
    c: impl Point<4>,
    d: impl Point<4>,
    e: impl Point<4>,
) -> Result<Sign, NonFinite> {
    let points = [a.coords(), b.coords(), c.coords(), d.coords(), e.coords()];
    finite::check_finite(&points)?;
    Ok(settle::<Orient4d, Sign, 4, 5, 4>(&points).0)
}

/// [`orient4d`] with the stage that settled it.
#[inline]
#[must_use]
pub fn staged(
    a: impl Point<4>,
    b: impl Point<4>,
    c: impl Point<4>,
    d: impl Point<4>,
    e: impl Point<4>,
) -> (Sign, Stage) {
    settle::<Orient4d, Sign, 4, 5, 4>(&[a.coords(), b.coords(), c.coords(), d.coords(), e.coords()])
}
