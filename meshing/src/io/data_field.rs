//! Named numbers on the vertices or on the cells of a volumetric mesh, borrowed or owned: [`DataField`], [`FieldValues`].

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::WriteError;

/// The numbers of a field, in one of the types that files keep.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FieldValues<'a> {
    /// Real numbers.
    Float64(Cow<'a, [f64]>),
    /// Integers of 32 bits.
    Int32(Cow<'a, [i32]>),
    /// Integers of 64 bits.
    Int64(Cow<'a, [i64]>),
    /// Bytes.
    UInt8(Cow<'a, [u8]>),
}

/// Calls a generic function on the values, whatever their type.
macro_rules! with_values {
    ($values:expr, $slice:ident => $call:expr) => {
        match $values {
            $crate::io::FieldValues::Float64($slice) => $call,
            $crate::io::FieldValues::Int32($slice) => $call,
            $crate::io::FieldValues::Int64($slice) => $call,
            $crate::io::FieldValues::UInt8($slice) => $call,
        }
    };
}

impl FieldValues<'_> {
    /// Number of numbers, of all components.
    #[must_use]
    pub fn len(&self) -> usize {
        with_values!(self, values => values.len())
    }

    /// Whether there is no number.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A number as a real one, the nearest where an integer has no equal.
    pub(super) fn float(&self, index: usize) -> f64 {
        match self {
            Self::Float64(values) => values[index],
            Self::Int32(values) => f64::from(values[index]),
            Self::Int64(values) => values[index] as f64,
            Self::UInt8(values) => f64::from(values[index]),
        }
    }

    /// An integer; none where the numbers are real.
    pub(super) fn integer(&self, index: usize) -> Option<i64> {
        match self {
            Self::Float64(_) => None,
            Self::Int32(values) => Some(i64::from(values[index])),
            Self::Int64(values) => Some(values[index]),
            Self::UInt8(values) => Some(i64::from(values[index])),
        }
    }

    /// Whether the numbers are integers.
    pub(super) fn is_integer(&self) -> bool {
        !matches!(self, Self::Float64(_))
    }

    /// What its numbers are, in a word: `float64`, `int32`, `int64`, `uint8`.
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Float64(_) => "float64",
            Self::Int32(_) => "int32",
            Self::Int64(_) => "int64",
            Self::UInt8(_) => "uint8",
        }
    }

    /// The smallest of the types `Int32` and `Int64` that holds all numbers.
    pub(super) fn of_integers(numbers: Vec<i64>) -> FieldValues<'static> {
        match numbers.iter().map(|&number| i32::try_from(number)).collect::<Result<Vec<_>, _>>() {
            Ok(small) => FieldValues::from(small),
            Err(_) => FieldValues::from(numbers),
        }
    }

    /// The values of places, `components` each, where place `k` goes to `destinations[k]`, or nowhere.
    pub(super) fn rearranged(&self, components: usize, destinations: &[Option<u32>]) -> FieldValues<'static> {
        with_values!(self, values => rearranged(values, components, destinations).into())
    }
}

fn rearranged<T: Copy + Default>(values: &[T], components: usize, destinations: &[Option<u32>]) -> Vec<T> {
    let kept = destinations.iter().flatten().count();
    let mut moved = vec![T::default(); kept * components];
    for (place, destination) in values.chunks_exact(components).zip(destinations) {
        if let Some(destination) = destination {
            moved[*destination as usize * components..][..components].copy_from_slice(place);
        }
    }
    moved
}

macro_rules! from_numbers {
    ($type:ty, $variant:ident) => {
        impl From<Vec<$type>> for FieldValues<'static> {
            fn from(values: Vec<$type>) -> Self {
                Self::$variant(Cow::Owned(values))
            }
        }
        impl<'a> From<&'a [$type]> for FieldValues<'a> {
            fn from(values: &'a [$type]) -> Self {
                Self::$variant(Cow::Borrowed(values))
            }
        }
        impl<'a> From<&'a Vec<$type>> for FieldValues<'a> {
            fn from(values: &'a Vec<$type>) -> Self {
                Self::$variant(Cow::Borrowed(values))
            }
        }
    };
}
from_numbers!(f64, Float64);
from_numbers!(i32, Int32);
from_numbers!(i64, Int64);
from_numbers!(u8, UInt8);

/// A named field: one number, or a vector, for each vertex or for each cell.
///
/// ```
/// use welter_meshing::io::{DataField, FieldValues};
/// let speeds = vec![0.5, 1.5];
/// let field = DataField::new("speed", 1, &speeds);
/// assert_eq!(field.values, FieldValues::from(vec![0.5, 1.5]));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DataField<'a> {
    /// Its name, not empty and without control characters, other than those of the fields beside it.
    pub name: Cow<'a, str>,
    /// Numbers of each vertex or cell: 1 for scalars, 3 for vectors.
    pub components: usize,
    /// The numbers, the components of a vector next to each other.
    pub values: FieldValues<'a>,
}

impl<'a> DataField<'a> {
    /// A field of a name, with `components` numbers for each vertex or cell.
    pub fn new(name: impl Into<Cow<'a, str>>, components: usize, values: impl Into<FieldValues<'a>>) -> Self {
        Self { name: name.into(), components, values: values.into() }
    }
}

impl DataField<'_> {
    /// The smallest and the largest of one component, of those that are finite, each as the nearest real number; none where none is.
    ///
    /// ```
    /// use welter_meshing::io::DataField;
    /// let field = DataField::new("velocity", 2, vec![0.5, f64::NAN, -1.5, f64::INFINITY]);
    /// assert_eq!(field.range(0), Some([-1.5, 0.5]));
    /// assert_eq!((field.range(1), field.range(2)), (None, None));
    /// ```
    #[must_use]
    pub fn range(&self, component: usize) -> Option<[f64; 2]> {
        if component >= self.components {
            return None;
        }
        let numbers = (component..self.values.len()).step_by(self.components).map(|at| self.values.float(at));
        numbers.filter(|number| number.is_finite()).fold(None, |range: Option<[f64; 2]>, number| {
            Some(range.map_or([number; 2], |[low, high]| [low.min(number), high.max(number)]))
        })
    }
}

/// A name as VTK takes it.
pub(super) fn check_name(name: &str) -> Result<(), WriteError> {
    let refused = |why| Err(WriteError::ArrayName { name: name.to_owned(), why });
    if name.is_empty() {
        return refused("is empty");
    }
    if name.chars().any(char::is_control) {
        return refused("has a control character");
    }
    Ok(())
}

/// Fields fit the places that they belong to, and have names of their own.
pub(super) fn check_fields(fields: &[DataField<'_>], places: usize) -> Result<(), WriteError> {
    let mut names = BTreeSet::new();
    for DataField { name, components, values } in fields {
        check_name(name)?;
        if !names.insert(name.as_ref()) {
            return Err(WriteError::ArrayName { name: name.to_string(), why: "is given twice" });
        }
        if *components == 0 || places.checked_mul(*components) != Some(values.len()) {
            let (name, values) = (name.to_string(), values.len());
            return Err(WriteError::ArrayLength { name, values, components: *components, places });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_rearranged_with_their_components() {
        let values = FieldValues::from(vec![1, 2, 3, 4, 5, 6]);
        assert_eq!(values.rearranged(2, &[Some(1), None, Some(0)]), FieldValues::from(vec![5, 6, 1, 2]));
        assert_eq!(FieldValues::of_integers(vec![-1, 7]), FieldValues::from(vec![-1_i32, 7]));
        assert_eq!(FieldValues::of_integers(vec![1 << 40]), FieldValues::from(vec![1_i64 << 40]));
    }

    #[test]
    fn fields_that_do_not_fit_are_refused() {
        let refused = |fields: &[DataField<'_>]| check_fields(fields, 2).unwrap_err().to_string();
        let field = |name| DataField::new(name, 1, vec![0.0, 1.0]);
        assert!(check_fields(&[field("a"), field("b")], 2).is_ok());
        assert_eq!(refused(&[field("a"), field("a")]), "the array name \"a\" is given twice");
        assert_eq!(refused(&[field("")]), "the array name \"\" is empty");
        let none = DataField::new("a", 0, Vec::<u8>::new());
        assert_eq!(refused(&[none]), "array \"a\" has 0 numbers, 0 for each of 2 places are needed");
    }
}
