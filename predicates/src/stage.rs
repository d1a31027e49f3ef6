//! The stages of an evaluation: [`Stage`], and the ladder that every predicate climbs.

use crate::arithmetic::fixed_point;
use crate::arithmetic::scaled::Scaled;
use crate::polynomial::Ring;
use crate::{Sign, stats};

/// Which stage of the evaluation settled a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Stage {
    /// The determinant in rounded `f64` is larger than its error bound.
    Filter,
    /// Integers of up to 2100 bits per coordinate: no exponent range to leave.
    Integer,
    /// None: a coordinate was infinite or not a number, and the sign is [`Sign::Zero`].
    NonFinite,
}

impl Stage {
    /// All stages, in the order in which they are tried.
    pub const ALL: [Self; 3] = [Self::Filter, Self::Integer, Self::NonFinite];
}

/// A predicate: `P` points of `N` coordinates, reduced to `R = P - 1` rows of differences to the last point.
pub(crate) trait Predicate<const N: usize, const P: usize, const R: usize> {
    /// Under which name it is counted.
    const KIND: stats::Kind;
    /// Degree of the polynomial in the differences.
    const DEGREE: i32;
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
    /// From an exact value `mantissa * 2^exponent`.
    fn of_scaled(value: Scaled) -> Self;
}

impl Answer for Sign {
    const ZERO: Self = Sign::Zero;
    #[inline(always)]
    fn of_rounded(value: f64) -> Self {
        Sign::of_nonzero(value)
    }
    #[inline(always)]
    fn of_scaled(value: Scaled) -> Self {
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
    fn of_scaled(value: Scaled) -> Self {
        value.to_f64()
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
    settle_exactly::<Q, A, N, P, R>(points)
}

/// The stages after the filter.
#[cold]
#[inline(never)]
fn settle_exactly<Q, A, const N: usize, const P: usize, const R: usize>(points: &[[f64; N]; P]) -> (A, Stage)
where
    Q: Predicate<N, P, R>,
    A: Answer,
{
    if !points.as_flattened().iter().all(|x| x.is_finite()) {
        stats::count(Q::KIND, Stage::NonFinite);
        return (A::ZERO, Stage::NonFinite);
    }
    let (unit, rows) = fixed_point::differences(points);
    let value = Q::polynomial::<fixed_point::Integers>(&rows);
    stats::count(Q::KIND, Stage::Integer);
    (A::of_scaled(value.times_power_of_two(Q::DEGREE * unit)), Stage::Integer)
}
