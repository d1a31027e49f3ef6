//! What a value becomes: [`Rule`], and the types of values that there are.

use glam::DVec3;
use std::fmt;
use std::sync::Arc;

use super::column::Column;
use super::set::Columns;

/// A source of an element's new value: an element as it was before the change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inherited<T> {
    /// The source's value before the change. Of a directed attribute the sign is that along the new edge.
    pub value: T,
    /// Whether the source is the element itself.
    pub is_self: bool,
    /// Weight as a mean: those of an element's sources sum to one, or are all zero where nothing suggests a mean.
    pub interpolation: f64,
    /// Which part of the source's value comes here: the shares that a source gives away or keeps sum to one.
    pub share: f64,
}

/// How a value passes through splits, flips, collapses and the like.
#[derive(Clone)]
pub enum Rule<T> {
    /// The mean of the sources. Not for integers.
    Interpolate,
    /// The value of the source with the largest weight as a mean, of equal ones the first; old elements that do not
    /// merge keep theirs.
    Copy,
    /// Shares of the sources' values: the sum over all elements is kept, of integers exactly, else to rounding.
    /// An element that is removed leaves its value to its surviving neighbours; a component that is removed as
    /// a whole takes its sum along.
    Conserve,
    /// Old elements keep their value; new ones begin with zero.
    Reset,
    /// The value of a function of the sources, of which there may be none. It must be deterministic.
    Custom(CustomRule<T>),
}

/// A function from the sources of an element to its value.
pub type CustomRule<T> = Arc<dyn Fn(&[Inherited<T>]) -> T + Send + Sync>;

impl<T> Rule<T> {
    /// The rule that a function gives.
    pub fn custom(rule: impl Fn(&[Inherited<T>]) -> T + Send + Sync + 'static) -> Self {
        Self::Custom(Arc::new(rule))
    }
}

impl<T> fmt::Debug for Rule<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Interpolate => "Interpolate",
            Self::Copy => "Copy",
            Self::Conserve => "Conserve",
            Self::Reset => "Reset",
            Self::Custom(_) => "Custom",
        })
    }
}

/// Types of attributes: `f64`, [`DVec3`] and `i64`.
pub trait AttributeValue: Sealed + Copy + Default + PartialEq + fmt::Debug + Send + Sync + 'static {
    /// Whether a mean of two values is a value.
    const HAS_MEANS: bool;
}

impl AttributeValue for f64 {
    const HAS_MEANS: bool = true;
}

impl AttributeValue for DVec3 {
    const HAS_MEANS: bool = true;
}

impl AttributeValue for i64 {
    const HAS_MEANS: bool = false;
}

/// What the arithmetic of rules needs; the types are those above.
pub trait Sealed: Sized {
    #[doc(hidden)]
    fn plus(self, other: Self) -> Self;
    #[doc(hidden)]
    fn negated(self) -> Self;
    #[doc(hidden)]
    fn times(self, weight: f64) -> Self;
    /// The part between two places of the value laid out from 0 to 1; `last` reaches to its end.
    #[doc(hidden)]
    fn part(self, from: f64, share: f64, last: bool) -> Self;
    #[doc(hidden)]
    fn columns(columns: &Columns) -> &Vec<Column<Self>>;
    #[doc(hidden)]
    fn columns_mut(columns: &mut Columns) -> &mut Vec<Column<Self>>;
}

impl Sealed for f64 {
    fn plus(self, other: Self) -> Self {
        self + other
    }
    fn negated(self) -> Self {
        -self
    }
    fn times(self, weight: f64) -> Self {
        self * weight
    }
    fn part(self, _: f64, share: f64, _: bool) -> Self {
        self * share
    }
    fn columns(columns: &Columns) -> &Vec<Column<Self>> {
        &columns.scalars
    }
    fn columns_mut(columns: &mut Columns) -> &mut Vec<Column<Self>> {
        &mut columns.scalars
    }
}

impl Sealed for DVec3 {
    fn plus(self, other: Self) -> Self {
        self + other
    }
    fn negated(self) -> Self {
        -self
    }
    fn times(self, weight: f64) -> Self {
        self * weight
    }
    fn part(self, _: f64, share: f64, _: bool) -> Self {
        self * share
    }
    fn columns(columns: &Columns) -> &Vec<Column<Self>> {
        &columns.vectors
    }
    fn columns_mut(columns: &mut Columns) -> &mut Vec<Column<Self>> {
        &mut columns.vectors
    }
}

impl Sealed for i64 {
    fn plus(self, other: Self) -> Self {
        self.wrapping_add(other)
    }
    fn negated(self) -> Self {
        self.wrapping_neg()
    }
    fn times(self, weight: f64) -> Self {
        (self as f64 * weight).round() as i64
    }
    // The parts of one value meet at the same rounded places, so they sum to it exactly.
    fn part(self, from: f64, share: f64, last: bool) -> Self {
        let place = |at: f64| (self as f64 * at).floor() as i64;
        let end = if last { self } else { place(from + share) };
        end.wrapping_sub(place(from))
    }
    fn columns(columns: &Columns) -> &Vec<Column<Self>> {
        &columns.integers
    }
    fn columns_mut(columns: &mut Columns) -> &mut Vec<Column<Self>> {
        &mut columns.integers
    }
}
