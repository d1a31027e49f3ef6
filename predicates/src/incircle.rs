//! The position of a point relative to the circle through three others.
//!
//! ```text
//!         _ c _               for a, b, c counterclockwise (orient2d > 0):
//!       /       \             > 0  d lies inside the circle
//!      a    d    |            = 0  on it
//!       \       /             < 0  outside
//!         - b -               for a, b, c clockwise the signs are opposite
//! ```
//!
//! For `a`, `b`, `c` on one line the circle is that line, and the two signs tell its sides apart.

use crate::arithmetic::double_double;
use crate::polynomial::{self, Ring, Rounded};
use crate::stage::{Predicate, Stage, settle};
use crate::{NonFinite, Point, Sign, filter, finite, stats};

pub(crate) struct Incircle;

impl Predicate<2, 4, 3> for Incircle {
    const KIND: stats::Kind = stats::Kind::Incircle;
    const DEGREE: i32 = 4;
    const DOUBLE_DOUBLE_ERROR: f64 = double_double::INCIRCLE;

    #[inline(always)]
    fn polynomial<K: Ring>(rows: &[[K::D1; 2]; 3]) -> K::Outcome {
        polynomial::incircle::<K>(rows).into()
    }

    #[inline(always)]
    fn filter(rows: &[[f64; 2]; 3]) -> (f64, f64) {
        (polynomial::incircle::<Rounded>(rows), filter::incircle(rows))
    }
}

/// Whether `d` lies inside the circle through `a`, `b`, `c`: positive inside when `orient2d(a, b, c)` is positive,
/// negative inside when it is negative.
///
/// Exact for all finite coordinates; [`Sign::Zero`] if one is not finite.
///
/// ```
/// use welter_predicates::{Sign, incircle};
/// let [a, b, c] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
/// assert_eq!(incircle(a, b, c, [0.5, 0.5]), Sign::Positive);
/// assert_eq!(incircle(a, b, c, [1.0, 1.0]), Sign::Zero);
/// ```
#[inline]
#[must_use]
pub fn incircle(a: impl Point<2>, b: impl Point<2>, c: impl Point<2>, d: impl Point<2>) -> Sign {
    settle::<Incircle, Sign, 2, 4, 3>(&[a.coords(), b.coords(), c.coords(), d.coords()]).0
}

/// A number with the sign of [`incircle`]: the determinant, approximately.
///
/// The magnitude is that of the power of `d` with respect to the circle, times minus twice the signed area of `a`, `b`, `c`, with the relative error of the stage that settled the sign: small unless the
/// points are nearly degenerate. It is zero only if the determinant is (or a coordinate is not finite), and always
/// finite: beyond the range of `f64` it is the largest or the smallest magnitude.
///
/// ```
/// use welter_predicates::incircle_value;
/// let [a, b, c] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
/// assert_eq!(incircle_value(a, b, c, [0.5, 0.5]), 0.5);
/// ```
#[inline]
#[must_use]
pub fn incircle_value(a: impl Point<2>, b: impl Point<2>, c: impl Point<2>, d: impl Point<2>) -> f64 {
    settle::<Incircle, f64, 2, 4, 3>(&[a.coords(), b.coords(), c.coords(), d.coords()]).0
}

/// [`incircle`] for coordinates that may not be finite.
///
/// # Errors
/// [`NonFinite`] with the first coordinate that is infinite or not a number.
///
/// ```
/// use welter_predicates::{NonFinite, try_incircle};
/// let [a, b, c] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
/// let error = try_incircle(a, b, c, [0.0, f64::INFINITY]);
/// assert_eq!(error, Err(NonFinite { argument: 3, coordinate: 1, value: f64::INFINITY }));
/// ```
#[inline]
pub fn try_incircle(
    a: impl Point<2>,
    b: impl Point<2>,
    c: impl Point<2>,
    d: impl Point<2>,
) -> Result<Sign, NonFinite> {
    let points = [a.coords(), b.coords(), c.coords(), d.coords()];
    finite::check_finite(&points)?;
    Ok(settle::<Incircle, Sign, 2, 4, 3>(&points).0)
}

/// [`incircle`] with the stage that settled it.
#[inline]
#[must_use]
pub fn staged(a: impl Point<2>, b: impl Point<2>, c: impl Point<2>, d: impl Point<2>) -> (Sign, Stage) {
    settle::<Incircle, Sign, 2, 4, 3>(&[a.coords(), b.coords(), c.coords(), d.coords()])
}
