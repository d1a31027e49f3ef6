//! Exact solution of small systems of linear equations: `A x = b` with up to six equations and six unknowns.
//!
//! ```
//! use welter_predicates::linear::{Solution, solve};
//!
//! let Solution::Unique([x, y]) = solve(&[[2.0, 1.0], [1.0, 3.0]], &[3.0, 1.5]) else { panic!("regular") };
//! assert!((x - 1.5).abs() < 1e-15 && y == 0.0);
//! assert_eq!(solve(&[[1e300, 1e-300], [1e300, 1e-300]], &[1.0, 1.0 + f64::EPSILON]), Solution::Inconsistent);
//! ```
//!
//! # Promises
//! * Which of the three outcomes of [`Solution`] holds is exact for all finite coefficients: subnormal, 1e308,
//!   mixtures of both.
//! * Every component of a unique solution has the exact sign: it is zero only if the exact component is. It is
//!   within [`RELATIVE_ERROR`] of the exact component; beyond the range of `f64` it is the largest finite
//!   number or the smallest subnormal one of its sign, and a subnormal component may besides be off by the
//!   smallest subnormal number.
//! * [`solvable`] decides exactly whether there is a solution of prescribed signs.
//! * Outcomes do not depend on the order of equations, nor on factors of two of equations.
//! * Total, without allocation. A coefficient that is not finite gives [`Solution::Inconsistent`];
//!   [`try_solve`] names it.
//!
//! # Non-promises
//! * Which of many solutions: an underdetermined system is described, not solved.
//! * The last bit of a component.
//!
//! # Method
//! \[Brochu12\] solves the systems of collision detection by fraction-free elimination \[Bareiss68\] on
//! expansions, and leaves open a filter that makes it as fast as determinants. Here, in this order ([`staged`]
//! has each by itself):
//!
//! 1. `filter`: an inverse in rounded arithmetic and a proven bound of the distance to the solution;
//! 2. elimination in 128-bit integers, for coefficients of few bits;
//! 3. elimination in integers of any size. Elimination in expansions, where these do not overflow, is slower:
//!    see `docs/adr/0006-linear-systems.md`.
//!
//! `determinants` answers the same by Cramer's rule and bordered minors; tests compare the two.

mod determinants;
mod domain;
mod elimination;
mod filter;
mod signs;
pub mod staged;
mod system;

use crate::arithmetic::arena::Arena;
use crate::arithmetic::fixed_point::COORDINATE_LIMBS;
use crate::finite::check_finite;
use crate::{NonFinite, Sign};
use domain::Machine;
use system::{System, Units};

/// The most equations, and the most unknowns, of a system.
pub const MOST: usize = 6;

/// Bound of the error of a component, relative to it: 2^-20. Elimination gives 2^-50.
pub const RELATIVE_ERROR: f64 = filter::RELATIVE_ERROR;

/// The outcome of a system of linear equations in `N` unknowns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solution<const N: usize> {
    /// Exactly one solution, with the exact sign of every component; see the [module](self) for the errors of
    /// magnitudes.
    Unique([f64; N]),
    /// No solution.
    Inconsistent,
    /// Infinitely many solutions.
    Underdetermined {
        /// The rank of the matrix.
        rank: usize,
        /// The columns that depend on those before them, `N - rank` of them: the unknowns that can be chosen
        /// freely.
        free: [bool; N],
    },
}

impl<const N: usize> Solution<N> {
    /// The signs of a unique solution.
    ///
    /// ```
    /// use welter_predicates::{Sign, linear::solve};
    /// assert_eq!(solve(&[[-3.0]], &[1.0]).signs(), Some([Sign::Negative]));
    /// assert_eq!(solve(&[[0.0]], &[1.0]).signs(), None);
    /// ```
    #[must_use]
    pub fn signs(&self) -> Option<[Sign; N]> {
        if let Self::Unique(x) = self { Some(x.map(Sign::of)) } else { None }
    }
}

/// [`Solution`] of up to [`MOST`] unknowns.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Outcome {
    /// Components beyond the number of unknowns are zero.
    Unique([f64; MOST]),
    Inconsistent,
    /// `free` and `dependency` are sets of columns; those of `dependency` depend on each other.
    Underdetermined {
        rank: usize,
        free: u32,
        dependency: u32,
    },
}

impl<const N: usize> From<Outcome> for Solution<N> {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Unique(x) => Self::Unique(core::array::from_fn(|i| x[i])),
            Outcome::Inconsistent => Self::Inconsistent,
            Outcome::Underdetermined { rank, free, .. } => {
                Self::Underdetermined { rank, free: core::array::from_fn(|i| free >> i & 1 == 1) }
            }
        }
    }
}

/// Solves `a x = b`; row `i` of `a` and `b[i]` are one equation. More than [`MOST`] of either do not compile.
///
/// ```
/// use welter_predicates::linear::{Solution, solve};
/// // Three planes through a line.
/// let planes = [[1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 2.0]];
/// let line = Solution::Underdetermined { rank: 2, free: [false, false, true] };
/// assert_eq!(solve(&planes, &[1.0, 2.0, 3.0]), line);
/// assert_eq!(solve(&planes, &[1.0, 2.0, 4.0]), Solution::Inconsistent);
/// ```
#[inline]
#[must_use]
pub fn solve<const M: usize, const N: usize>(a: &[[f64; N]; M], b: &[f64; M]) -> Solution<N> {
    if let Some(solution) = staged::by_filter(a, b) {
        return solution;
    }
    if all_finite(a, b) { settle(&System::new(a, b)).into() } else { Solution::Inconsistent }
}

/// [`solve`] for coefficients that may not be finite.
///
/// # Errors
/// [`NonFinite`] with the first coefficient that is infinite or not a number: `argument` 0 is `a`, whose
/// coefficients are counted row by row; 1 is `b`.
///
/// ```
/// use welter_predicates::{NonFinite, linear::try_solve};
/// let error = try_solve(&[[1.0, 2.0], [3.0, f64::INFINITY]], &[0.0, 0.0]);
/// assert_eq!(error, Err(NonFinite { argument: 0, coordinate: 3, value: f64::INFINITY }));
/// ```
pub fn try_solve<const M: usize, const N: usize>(
    a: &[[f64; N]; M],
    b: &[f64; M],
) -> Result<Solution<N>, NonFinite> {
    let whole = |error: NonFinite| NonFinite {
        argument: 0,
        coordinate: error.argument * N + error.coordinate,
        ..error
    };
    check_finite(a).map_err(whole)?;
    check_finite(&[*b]).map_err(|error| NonFinite { argument: 1, ..error })?;
    Ok(solve(a, b))
}

/// Whether `a x = b` has a solution of given signs: `x_i >= 0` for `Positive`, `x_i <= 0` for `Negative`, `x_i
/// = 0` for `Zero`.
///
/// Exact also where there are infinitely many solutions; false when a coefficient is not finite. With
/// barycentric weights as unknowns this asks whether two simplices have a common point \[Brochu12\].
///
/// ```
/// use welter_predicates::{Sign::Positive, linear::solvable};
/// // Is the origin between these points of a line?
/// let between = |p: f64, q: f64| solvable(&[[p, q], [1.0, 1.0]], &[0.0, 1.0], [Positive; 2]);
/// assert!(between(-1.0, 1e-320) && between(0.0, 5.0) && between(0.0, 0.0) && !between(1.0, 2.0));
/// ```
#[inline]
#[must_use]
pub fn solvable<const M: usize, const N: usize>(a: &[[f64; N]; M], b: &[f64; M], signs: [Sign; N]) -> bool {
    if let Some(Solution::Unique(x)) = staged::by_filter(a, b) {
        return x.iter().zip(signs).all(|(&x, sign)| Sign::of(x) == sign);
    }
    all_finite(a, b) && signs::nonnegative(&oriented(a, b, signs), settle)
}

/// The system for the magnitudes of unknowns of these signs.
fn oriented<const M: usize, const N: usize>(a: &[[f64; N]; M], b: &[f64; M], signs: [Sign; N]) -> System {
    let mut system = System::new(a, b);
    let mut kept = 0;
    for (column, sign) in signs.into_iter().enumerate() {
        kept |= u32::from(!sign.is_zero()) << column;
        if sign == Sign::Negative {
            system.rows.iter_mut().for_each(|row| row[column] = -row[column]);
        }
    }
    system.with_columns(kept)
}

fn all_finite<const M: usize, const N: usize>(a: &[[f64; N]; M], b: &[f64; M]) -> bool {
    a.as_flattened().iter().chain(b).all(|x| x.is_finite())
}

/// The exact outcome of finite coefficients.
#[cold]
fn settle(system: &System) -> Outcome {
    let units = Units::of(system);
    if let Some(outcome) =
        Machine::new(units.bits).and_then(|mut d| elimination::solve(system, &units, &mut d))
    {
        return outcome;
    }
    in_integers(&units, |arena| elimination::solve(system, &units, arena)).unwrap_or(Outcome::Inconsistent)
}

/// Limbs of an arena for one outcome, per limb of a coefficient: twice the largest use, as a test measures it.
const LIMBS_PER_LIMB: usize = 1000;

/// Coefficients of up to this many bits, that is most, are decided with a small arena.
const FEW_LIMBS: usize = 3;

/// Runs `f` with an arena of the size that the coefficients ask for.
fn in_integers<T>(units: &Units, f: impl FnOnce(&mut Arena<'_>) -> T) -> T {
    /// Not inlined, so that the stack holds the array only while it is used.
    #[inline(never)]
    fn within<const LIMBS: usize, T>(f: impl FnOnce(&mut Arena<'_>) -> T) -> T {
        f(&mut Arena::new(&mut [0; LIMBS]))
    }
    // A sign bit, as it were: a number of exactly `bits` bits is loaded with a limb to spare.
    if units.bits < FEW_LIMBS as i32 * 64 {
        within::<{ FEW_LIMBS * LIMBS_PER_LIMB }, T>(f)
    } else {
        within::<{ COORDINATE_LIMBS * LIMBS_PER_LIMB }, T>(f)
    }
}

#[cfg(test)]
mod tests;
