//! The stages of an evaluation: [`Stage`], and the ladder that every predicate climbs.
//!
//! **Computes** the sign, or a value of the right sign, of a polynomial in coordinate differences, by the first of
//! five number types that is certain of it.
//!
//! **Promises** the exact sign for all finite coordinates, and zero for others.
//!
//! **Method.** Filter, lattice, double-double, expansion, integer, in this order, which is the order of their cost
//! where they answer: measured, the lattice (in two sizes, see [`crate::arithmetic::small`] and
//! [`crate::arithmetic::lattice`]) takes less than double-double numbers do. Each stage is a function that gives an
//! answer or `None`, and that the tests call for itself. All run the same text, [`crate::polynomial`].
//!
//! **Invariant.** A stage never answers wrongly; the last one always answers. `docs/accuracy.md` has the proofs.

use crate::arithmetic::double_double::{self, DoubleDoubles, Magnitude, Magnitudes, Scale};
use crate::arithmetic::expansion::{self, Expansion, Expansions};
use crate::arithmetic::fixed_point;
use crate::arithmetic::lattice::{self, Extent, Lattice, Words};
use crate::arithmetic::scaled::{Exact, power_of_two};
use crate::arithmetic::small::{self, Small};
use crate::polynomial::Ring;
use crate::{Sign, stats};

/// Which stage of the evaluation settled a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Stage {
    /// The determinant in rounded `f64` is larger than its error bound.
    Filter,
    /// Integers of a few machine words: all bits of all coordinates lie within 61 binary places.
    Lattice,
    /// Double-double arithmetic, about 106 bits: the determinant is larger than its error bound.
    DoubleDouble,
    /// Expansions, exact: sums of `f64` that do not overlap.
    Expansion,
    /// Integers of up to 2100 bits per coordinate: no exponent range to leave.
    Integer,
    /// None: a coordinate was infinite or not a number, and the sign is [`Sign::Zero`].
    NonFinite,
}

impl Stage {
    /// All stages, in the order in which they are tried.
    pub const ALL: [Self; 6] =
        [Self::Filter, Self::Lattice, Self::DoubleDouble, Self::Expansion, Self::Integer, Self::NonFinite];
}

/// A predicate: `P` points of `N` coordinates, reduced to `R = P - 1` rows of differences to the last point.
pub(crate) trait Predicate<const N: usize, const P: usize, const R: usize> {
    /// Under which name it is counted.
    const KIND: stats::Kind;
    /// Degree of the polynomial in the differences.
    const DEGREE: i32;
    /// Error coefficient of the polynomial in double-double arithmetic.
    const DOUBLE_DOUBLE_ERROR: f64;
    /// The polynomial.
    fn polynomial<K: Ring>(rows: &[[K::D1; N]; R]) -> K::Outcome;
    /// The polynomial in rounded arithmetic and a bound of its error that is not finite when the polynomial overflows.
    fn filter(rows: &[[f64; N]; R]) -> (f64, f64);
}

/// What is asked for: the sign alone, or a value of the right sign.
pub(crate) trait Answer: Copy {
    const ZERO: Self;
    /// From a rounded value, neither zero nor NaN nor infinite, whose sign is right.
    fn of_rounded(value: f64) -> Self;
    /// From an exact value in units of `2^exponent`.
    fn of_exact(value: &impl Exact, exponent: i32) -> Self;
}

impl Answer for Sign {
    const ZERO: Self = Sign::Zero;
    #[inline(always)]
    fn of_rounded(value: f64) -> Self {
        Sign::of_nonzero(value)
    }
    #[inline(always)]
    fn of_exact(value: &impl Exact, _: i32) -> Self {
        value.sign()
    }
}

impl Answer for f64 {
    const ZERO: Self = 0.0;
    #[inline(always)]
    fn of_rounded(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn of_exact(value: &impl Exact, exponent: i32) -> Self {
        value.scaled().times_power_of_two(exponent).to_f64()
    }
}

/// Differences of the first points to the last one, rounded.
#[inline(always)]
fn rows<const N: usize, const P: usize, const R: usize>(points: &[[f64; N]; P]) -> [[f64; N]; R] {
    core::array::from_fn(|i| core::array::from_fn(|j| points[i][j] - points[P - 1][j]))
}

/// Climbs the stages until one settles the answer.
#[inline(always)]
pub(crate) fn settle<Q, A, const N: usize, const P: usize, const R: usize>(
    points: &[[f64; N]; P],
) -> (A, Stage)
where
    Q: Predicate<N, P, R>,
    A: Answer,
{
    let (value, error) = Q::filter(&rows(points));
    if value.abs() > error {
        stats::count(Q::KIND, Stage::Filter);
        return (A::of_rounded(value), Stage::Filter);
    }
    // A fresh array, made on this path only: passing `points` on would keep the coordinates of the fast path
    // in memory instead of registers.
    let copy = core::array::from_fn(|i| core::array::from_fn(|j| points[i][j]));
    settle_exactly::<Q, A, N, P, R>(&copy)
}

/// The stages after the filter.
#[cold]
#[inline(never)]
fn settle_exactly<Q, A, const N: usize, const P: usize, const R: usize>(points: &[[f64; N]; P]) -> (A, Stage)
where
    Q: Predicate<N, P, R>,
    A: Answer,
{
    let (answer, stage) = if let Some(answer) = by_lattice::<Q, A, N, P, R>(points) {
        (answer, Stage::Lattice)
    } else if !points.as_flattened().iter().all(|x| x.is_finite()) {
        (A::ZERO, Stage::NonFinite)
    } else if let Some(answer) = by_double_double::<Q, A, N, P, R>(points) {
        (answer, Stage::DoubleDouble)
    } else if let Some(answer) = by_expansion::<Q, A, N, P, R>(points) {
        (answer, Stage::Expansion)
    } else {
        (by_integer::<Q, A, N, P, R>(points), Stage::Integer)
    };
    stats::count(Q::KIND, stage);
    (answer, stage)
}

/// Exact in machine words, for coordinates of one lattice.
#[inline(always)]
fn by_lattice<Q, A, const N: usize, const P: usize, const R: usize>(points: &[[f64; N]; P]) -> Option<A>
where
    Q: Predicate<N, P, R>,
    A: Answer,
{
    let extent = Extent::of(points)?;
    if extent.is_tiny() {
        by_raised_lattice::<Q, A, N, P, R>(points)
    } else {
        on_lattice::<Q, A, N, P, R>(points, extent, 0)
    }
}

/// [`by_lattice`] for coordinates near the lower end of the exponent range.
#[cold]
#[inline(never)]
fn by_raised_lattice<Q, A, const N: usize, const P: usize, const R: usize>(
    points: &[[f64; N]; P],
) -> Option<A>
where
    Q: Predicate<N, P, R>,
    A: Answer,
{
    let raised = points.map(|point| point.map(|x| x * power_of_two(lattice::RAISE)));
    on_lattice::<Q, A, N, P, R>(&raised, Extent::of(&raised)?, -lattice::RAISE)
}

/// The answer for coordinates times `2^exponent`.
#[inline(always)]
fn on_lattice<Q, A, const N: usize, const P: usize, const R: usize>(
    points: &[[f64; N]; P],
    extent: Extent,
    exponent: i32,
) -> Option<A>
where
    Q: Predicate<N, P, R>,
    A: Answer,
{
    if let Some((unit, rows)) = small::rows(points, extent, Q::DEGREE) {
        let value = Q::polynomial::<Small>(&rows);
        return Some(A::of_exact(&value, Q::DEGREE * (unit + exponent)));
    }
    let lattice = Lattice::of(points, extent)?;
    let value = Q::polynomial::<Words>(&lattice.rows());
    Some(A::of_exact(&value, Q::DEGREE * (lattice.exponent + exponent)))
}

/// In double-double arithmetic, for values above their error bound.
#[inline(never)]
fn by_double_double<Q, A, const N: usize, const P: usize, const R: usize>(points: &[[f64; N]; P]) -> Option<A>
where
    Q: Predicate<N, P, R>,
    A: Answer,
{
    let scale = Scale::of(points, Q::DEGREE);
    let rows = double_double::differences(&scale.apply(points));
    let value = Q::polynomial::<DoubleDoubles>(&rows);
    let magnitudes = rows.map(|row| row.map(|d| Magnitude(d.high.abs())));
    let magnitude = Q::polynomial::<Magnitudes>(&magnitudes).0;
    let error = double_double::error_bound(Q::DOUBLE_DOUBLE_ERROR, magnitude, Q::DEGREE);
    (value.high.abs() > error).then(|| A::of_exact(&value, -Q::DEGREE * scale.exponent))
}

/// Exact in expansions, for coordinates whose products stay in the range of `f64`.
#[inline(never)]
fn by_expansion<Q, A, const N: usize, const P: usize, const R: usize>(points: &[[f64; N]; P]) -> Option<A>
where
    Q: Predicate<N, P, R>,
    A: Answer,
{
    let scale = Scale::of(points, Q::DEGREE);
    if !expansion::in_range(points, scale.exponent, Q::DEGREE) {
        return None;
    }
    let scaled = scale.apply(points);
    let row = |i: usize| core::array::from_fn(|j| Expansion::of_difference(scaled[i][j], scaled[P - 1][j]));
    let value = Q::polynomial::<Expansions>(&core::array::from_fn(row));
    (!value.is_overfull()).then(|| A::of_exact(&value, -Q::DEGREE * scale.exponent))
}

/// Exact in integers of any size that finite coordinates can need.
#[inline(never)]
fn by_integer<Q, A, const N: usize, const P: usize, const R: usize>(points: &[[f64; N]; P]) -> A
where
    Q: Predicate<N, P, R>,
    A: Answer,
{
    let (unit, rows) = fixed_point::differences(points);
    let value = Q::polynomial::<fixed_point::Integers>(&rows);
    A::of_exact(&value, Q::DEGREE * unit)
}

#[cfg(test)]
mod tests;
