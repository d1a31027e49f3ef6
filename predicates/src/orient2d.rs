//! The orientation of three points of the plane.
//!
//! ```text
//!         c                 > 0  counterclockwise: c lies left of the line from a to b
//!        / \                = 0  on one line
//!       /   \               < 0  clockwise: c lies right of it
//!      a --> b
//! ```

use crate::arithmetic::double_double;
use crate::polynomial::{self, Ring, Rounded};
use crate::stage::{Predicate, Stage, settle};
use crate::{NonFinite, Point, Sign, filter, finite, stats};

pub(crate) struct Orient2d;

impl Predicate<2, 3, 2> for Orient2d {
    const KIND: stats::Kind = stats::Kind::Orient2d;
    const DEGREE: i32 = 2;
    const DOUBLE_DOUBLE_ERROR: f64 = double_double::ORIENT2D;

    #[inline(always)]
    fn polynomial<K: Ring>(rows: &[[K::D1; 2]; 2]) -> K::Outcome {
        polynomial::orient2d::<K>(rows).into()
    }

    #[inline(always)]
    fn filter(rows: &[[f64; 2]; 2]) -> (f64, f64) {
        (polynomial::orient2d::<Rounded>(rows), filter::orient2d(rows))
    }
}

/// The orientation of three points of the plane: positive when `a`, `b`, `c` turn counterclockwise.
///
/// Exact for all finite coordinates; [`Sign::Zero`] if one is not finite.
///
/// ```
/// use welter_predicates::{Sign, orient2d};
/// assert_eq!(orient2d([0.0, 0.0], [1.0, 0.0], [0.0, 1.0]), Sign::Positive);
/// assert_eq!(orient2d([0.0, 0.0], [1e-300, 1e-300], [1e300, 1e300]), Sign::Zero);
/// ```
#[inline]
#[must_use]
pub fn orient2d(a: impl Point<2>, b: impl Point<2>, c: impl Point<2>) -> Sign {
    settle::<Orient2d, Sign, 2, 3, 2>(&[a.coords(), b.coords(), c.coords()]).0
}

/// A number with the sign of [`orient2d`]: the determinant, approximately.
///
/// The magnitude is that of twice the signed area of the triangle, with the relative error of the stage that settled the sign: small unless the
/// points are nearly degenerate. It is zero only if the determinant is (or a coordinate is not finite), and always
/// finite: beyond the range of `f64` it is the largest or the smallest magnitude.
///
/// ```
/// use welter_predicates::orient2d_value;
/// assert_eq!(orient2d_value([0.0, 0.0], [2.0, 0.0], [0.0, 3.0]), 6.0);
/// ```
#[inline]
#[must_use]
pub fn orient2d_value(a: impl Point<2>, b: impl Point<2>, c: impl Point<2>) -> f64 {
    settle::<Orient2d, f64, 2, 3, 2>(&[a.coords(), b.coords(), c.coords()]).0
}

/// [`orient2d`] for coordinates that may not be finite.
///
/// # Errors
/// [`NonFinite`] with the first coordinate that is infinite or not a number.
///
/// ```
/// use welter_predicates::{NonFinite, try_orient2d};
/// let error = try_orient2d([0.0, 0.0], [1.0, f64::INFINITY], [0.0, 1.0]);
/// assert_eq!(error, Err(NonFinite { argument: 1, coordinate: 1, value: f64::INFINITY }));
/// ```
#[inline]
pub fn try_orient2d(a: impl Point<2>, b: impl Point<2>, c: impl Point<2>) -> Result<Sign, NonFinite> {
    let points = [a.coords(), b.coords(), c.coords()];
    finite::check_finite(&points)?;
    Ok(settle::<Orient2d, Sign, 2, 3, 2>(&points).0)
}

/// [`orient2d`] with the stage that settled it.
#[inline]
#[must_use]
pub fn staged(a: impl Point<2>, b: impl Point<2>, c: impl Point<2>) -> (Sign, Stage) {
    settle::<Orient2d, Sign, 2, 3, 2>(&[a.coords(), b.coords(), c.coords()])
}
