//! The stages of [`solve`](super::solve) one by one, and Cramer's rule as their twin: for tests and
//! measurements.
//!
//! Each gives the same outcome as [`solve`](super::solve), or `None` where it cannot tell; magnitudes of
//! components may differ within their bound. Which stages there are may change from version to version.

use super::domain::{Expansions, Machine};
use super::system::{System, Units};
use super::{Outcome, Solution, all_finite, determinants, elimination, filter, in_integers, oriented, signs};
use crate::Sign;

/// The filter: rounded arithmetic with a proven bound. Only for as many equations as unknowns, and a solution
/// without zeros.
///
/// ```
/// use welter_predicates::linear::{Solution, staged::by_filter};
/// assert_eq!(by_filter(&[[2.0]], &[1.0]), Some(Solution::Unique([0.5])));
/// assert_eq!(by_filter(&[[2.0]], &[0.0]), None);
/// ```
#[inline]
#[must_use]
pub fn by_filter<const M: usize, const N: usize>(a: &[[f64; N]; M], b: &[f64; M]) -> Option<Solution<N>> {
    /// The arrays as square ones, if they are.
    macro_rules! square {
        ($($n:literal)*) => {
            match (M, N) {
                $(($n, $n) => {
                    let a: &[[f64; $n]; $n] = a.as_flattened().as_chunks().0.try_into().ok()?;
                    let x = filter::solve(a, b[..].try_into().ok()?)?;
                    Some(Solution::Unique(x[..].try_into().ok()?))
                })*
                _ => None,
            }
        };
    }
    square!(1 2 3 4 5 6)
}

/// Fraction-free elimination in 128-bit integers, for coefficients of few bits.
///
/// ```
/// use welter_predicates::linear::{Solution, staged::by_machine_integers};
/// assert_eq!(by_machine_integers(&[[2.0]], &[1.0]), Some(Solution::Unique([0.5])));
/// assert_eq!(by_machine_integers(&[[2.0]], &[1e-30]), Some(Solution::Unique([5e-31])));
/// ```
#[must_use]
pub fn by_machine_integers<const M: usize, const N: usize>(
    a: &[[f64; N]; M],
    b: &[f64; M],
) -> Option<Solution<N>> {
    let (system, units) = prepared(a, b)?;
    elimination::solve(&system, &units, &mut Machine::new(units.bits)?).map(Into::into)
}

/// Fraction-free elimination on expansions \[Brochu12\], for coefficients of up to about 90 bits in a common
/// unit.
///
/// ```
/// use welter_predicates::linear::{Solution, staged::by_expansions};
/// assert_eq!(by_expansions(&[[2.0]], &[1.0]), Some(Solution::Unique([0.5])));
/// assert_eq!(by_expansions(&[[1.0, 1e-300], [1.0, 1.0]], &[1.0, 1.0]), None);
/// ```
#[must_use]
pub fn by_expansions<const M: usize, const N: usize>(a: &[[f64; N]; M], b: &[f64; M]) -> Option<Solution<N>> {
    let (system, units) = prepared(a, b)?;
    elimination::solve(&system, &units, &mut Expansions::new(units.bits)?).map(Into::into)
}

/// Fraction-free elimination in integers of any size: `None` only when a coefficient is not finite.
///
/// ```
/// use welter_predicates::linear::{Solution, staged::by_integers};
/// assert_eq!(by_integers(&[[1e300, 1e-300]], &[0.0]), Some(Solution::Underdetermined { rank: 1, free: [false, true] }));
/// ```
#[must_use]
pub fn by_integers<const M: usize, const N: usize>(a: &[[f64; N]; M], b: &[f64; M]) -> Option<Solution<N>> {
    let (system, units) = prepared(a, b)?;
    in_integers(&units, |arena| elimination::solve(&system, &units, arena)).map(Into::into)
}

/// Cramer's rule in rounded arithmetic, with permanents as bounds. Signs are exact, magnitudes have no stated
/// bound.
///
/// ```
/// use welter_predicates::linear::{Solution, staged::by_filtered_determinants};
/// assert_eq!(by_filtered_determinants(&[[2.0]], &[1.0]), Some(Solution::Unique([0.5])));
/// ```
#[inline]
#[must_use]
pub fn by_filtered_determinants<const N: usize>(a: &[[f64; N]; N], b: &[f64; N]) -> Option<Solution<N>> {
    determinants::filtered(a, b).map(Solution::Unique)
}

/// Cramer's rule and bordered minors in integers of any size: `None` only when a coefficient is not finite.
///
/// ```
/// use welter_predicates::linear::{Solution, staged::by_determinants};
/// assert_eq!(by_determinants(&[[1e300, 1e-300]], &[0.0]), Some(Solution::Underdetermined { rank: 1, free: [false, true] }));
/// ```
#[must_use]
pub fn by_determinants<const M: usize, const N: usize>(
    a: &[[f64; N]; M],
    b: &[f64; M],
) -> Option<Solution<N>> {
    let (system, units) = prepared(a, b)?;
    Some(in_integers(&units, |arena| determinants::solve(&system, &units, arena)).into())
}

/// [`solvable`](super::solvable) by determinants.
///
/// ```
/// use welter_predicates::{Sign::Positive, linear::staged::solvable_by_determinants};
/// assert!(solvable_by_determinants(&[[1.0, -1.0]], &[0.0], [Positive; 2]));
/// ```
#[must_use]
pub fn solvable_by_determinants<const M: usize, const N: usize>(
    a: &[[f64; N]; M],
    b: &[f64; M],
    signs: [Sign; N],
) -> bool {
    let settle = |system: &System| -> Outcome {
        let units = Units::of(system);
        in_integers(&units, |arena| determinants::solve(system, &units, arena))
    };
    all_finite(a, b) && signs::nonnegative(&oriented(a, b, signs), settle)
}

fn prepared<const M: usize, const N: usize>(a: &[[f64; N]; M], b: &[f64; M]) -> Option<(System, Units)> {
    all_finite(a, b).then(|| {
        let system = System::new(a, b);
        (system, Units::of(&system))
    })
}
