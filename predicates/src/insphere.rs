//! The position of a point relative to the sphere through four others.
//!
//! ```text
//!         _ - _               for orient3d(a, b, c, d) > 0:
//!       d       c             > 0  e lies inside the sphere
//!      |    e    |            = 0  on it
//!       a       /             < 0  outside
//!         - b -               for orient3d(a, b, c, d) < 0 the signs are opposite
//! ```

use crate::arithmetic::double_double;
use crate::polynomial::{self, Ring, Rounded};
use crate::stage::{Predicate, Stage, settle};
use crate::{NonFinite, Point, Sign, filter, finite, stats};

pub(crate) struct Insphere;

impl Predicate<3, 5, 4> for Insphere {
    const KIND: stats::Kind = stats::Kind::Insphere;
    const DEGREE: i32 = 5;
    const DOUBLE_DOUBLE_ERROR: f64 = double_double::INSPHERE;

    #[inline(always)]
    fn polynomial<K: Ring>(rows: &[[K::D1; 3]; 4]) -> K::Outcome {
        polynomial::insphere::<K>(rows).into()
    }

    #[inline(always)]
    fn filter(rows: &[[f64; 3]; 4]) -> (f64, f64) {
        (polynomial::insphere::<Rounded>(rows), filter::insphere(rows))
    }
}

/// Whether `e` lies inside the sphere through `a`, `b`, `c`, `d`: positive inside when `orient3d(a, b, c, d)` is
/// positive, negative inside when it is negative.
///
/// Exact for all finite coordinates; [`Sign::Zero`] if one is not finite.
///
/// ```
/// use welter_predicates::{Sign, insphere};
/// let [a, b, c, d] = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(insphere(a, b, c, d, [0.5, 0.5, 0.5]), Sign::Positive);
/// assert_eq!(insphere(a, b, c, d, [1.0, 1.0, 1.0]), Sign::Zero);
/// ```
#[inline]
#[must_use]
pub fn insphere(
    a: impl Point<3>,
    b: impl Point<3>,
    c: impl Point<3>,
    d: impl Point<3>,
    e: impl Point<3>,
) -> Sign {
    settle::<Insphere, Sign, 3, 5, 4>(&[a.coords(), b.coords(), c.coords(), d.coords(), e.coords()]).0
}

/// A number with the sign of [`insphere`]: the determinant, approximately.
///
/// The magnitude is that of the power of `e` with respect to the sphere, times minus six times the signed volume of `a`, `b`, `c`, `d`, with the relative error of the stage that settled the sign: small unless the
/// points are nearly degenerate. It is zero only if the determinant is (or a coordinate is not finite), and always
/// finite: beyond the range of `f64` it is the largest or the smallest magnitude.
///
/// ```
/// use welter_predicates::insphere_value;
/// let [a, b, c, d] = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(insphere_value(a, b, c, d, [0.5, 0.5, 0.5]), 0.75);
/// ```
#[inline]
#[must_use]
pub fn insphere_value(
    a: impl Point<3>,
    b: impl Point<3>,
    c: impl Point<3>,
    d: impl Point<3>,
    e: impl Point<3>,
) -> f64 {
    settle::<Insphere, f64, 3, 5, 4>(&[a.coords(), b.coords(), c.coords(), d.coords(), e.coords()]).0
}

/// [`insphere`] for coordinates that may not be finite.
///
/// # Errors
/// [`NonFinite`] with the first coordinate that is infinite or not a number.
///
/// ```
/// use welter_predicates::{NonFinite, try_insphere};
/// let [a, b, c, d] = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
/// let error = try_insphere(a, b, c, d, [0.0, 0.0, f64::INFINITY]);
/// assert_eq!(error, Err(NonFinite { argument: 4, coordinate: 2, value: f64::INFINITY }));
/// ```
#[inline]
pub fn try_insphere(
    a: impl Point<3>,
    b: impl Point<3>,
    c: impl Point<3>,
    d: impl Point<3>,
    e: impl Point<3>,
) -> Result<Sign, NonFinite> {
    let points = [a.coords(), b.coords(), c.coords(), d.coords(), e.coords()];
    finite::check_finite(&points)?;
    Ok(settle::<Insphere, Sign, 3, 5, 4>(&points).0)
}

/// [`insphere`] with the stage that settled it.
#[inline]
#[must_use]
pub fn staged(
    a: impl Point<3>,
    b: impl Point<3>,
    c: impl Point<3>,
    d: impl Point<3>,
    e: impl Point<3>,
) -> (Sign, Stage) {
    settle::<Insphere, Sign, 3, 5, 4>(&[a.coords(), b.coords(), c.coords(), d.coords(), e.coords()])
}
