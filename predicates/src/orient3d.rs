//! The orientation of four points of space.
//!
//! ```text
//!            d                > 0  d lies below the plane of a, b, c: seen from d they turn clockwise,
//!           /|\                    seen from the other side counterclockwise (the picture, where d is
//!          / | \                   behind the page, seen by the reader)
//!         c--|--b             = 0  on one plane
//!          \ | /              < 0  above
//!            a
//! ```
//!
//! The sign of the determinant with rows `a - d`, `b - d`, `c - d`, the convention of \[Shewchuk97\].

use crate::arithmetic::double_double;
use crate::polynomial::{self, Ring, Rounded};
use crate::stage::{Predicate, Stage, settle};
use crate::{NonFinite, Point, Sign, filter, finite, stats};

pub(crate) struct Orient3d;

impl Predicate<3, 4, 3> for Orient3d {
    const KIND: stats::Kind = stats::Kind::Orient3d;
    const DEGREE: i32 = 3;
    const DOUBLE_DOUBLE_ERROR: f64 = double_double::ORIENT3D;

    #[inline(always)]
    fn polynomial<K: Ring>(rows: &[[K::D1; 3]; 3]) -> K::Outcome {
        polynomial::orient3d::<K>(rows).into()
    }

    #[inline(always)]
    fn filter(rows: &[[f64; 3]; 3]) -> (f64, f64) {
        (polynomial::orient3d::<Rounded>(rows), filter::orient3d(rows))
    }
}

/// The orientation of four points of space: positive when `d` lies below the plane of `a`, `b`, `c`, where "below" is
/// the side from which they turn clockwise.
///
/// Exact for all finite coordinates; [`Sign::Zero`] if one is not finite.
///
/// ```
/// use welter_predicates::{Sign, orient3d};
/// let [a, b, c] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// assert_eq!(orient3d(a, b, c, [0.0, 0.0, -5e-324]), Sign::Positive);
/// ```
#[inline]
#[must_use]
pub fn orient3d(a: impl Point<3>, b: impl Point<3>, c: impl Point<3>, d: impl Point<3>) -> Sign {
    settle::<Orient3d, Sign, 3, 4, 3>(&[a.coords(), b.coords(), c.coords(), d.coords()]).0
}

/// A number with the sign of [`orient3d`]: the determinant, approximately.
///
/// The magnitude is that of six times the signed volume of the tetrahedron, with the relative error of the stage that settled the sign: small unless the
/// points are nearly degenerate. It is zero only if the determinant is (or a coordinate is not finite), and always
/// finite: beyond the range of `f64` it is the largest or the smallest magnitude.
///
/// ```
/// use welter_predicates::orient3d_value;
/// let [a, b, c] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// assert_eq!(orient3d_value(a, b, c, [0.0, 0.0, -5.0]), 5.0);
/// ```
#[inline]
#[must_use]
pub fn orient3d_value(a: impl Point<3>, b: impl Point<3>, c: impl Point<3>, d: impl Point<3>) -> f64 {
    settle::<Orient3d, f64, 3, 4, 3>(&[a.coords(), b.coords(), c.coords(), d.coords()]).0
}

/// [`orient3d`] for coordinates that may not be finite.
///
/// # Errors
/// [`NonFinite`] with the first coordinate that is infinite or not a number.
///
/// ```
/// use welter_predicates::{NonFinite, try_orient3d};
/// let [a, b, c] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// let error = try_orient3d(a, b, c, [0.0, f64::INFINITY, 0.0]);
/// assert_eq!(error, Err(NonFinite { argument: 3, coordinate: 1, value: f64::INFINITY }));
/// ```
#[inline]
pub fn try_orient3d(
    a: impl Point<3>,
    b: impl Point<3>,
    c: impl Point<3>,
    d: impl Point<3>,
) -> Result<Sign, NonFinite> {
    let points = [a.coords(), b.coords(), c.coords(), d.coords()];
    finite::check_finite(&points)?;
    Ok(settle::<Orient3d, Sign, 3, 4, 3>(&points).0)
}

/// [`orient3d`] with the stage that settled it.
#[inline]
#[must_use]
pub fn staged(a: impl Point<3>, b: impl Point<3>, c: impl Point<3>, d: impl Point<3>) -> (Sign, Stage) {
    settle::<Orient3d, Sign, 3, 4, 3>(&[a.coords(), b.coords(), c.coords(), d.coords()])
}
