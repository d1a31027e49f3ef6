//! All attributes of one kind of element: [`AttributeSet`].

use super::column::Column;
use super::transfer::Transfer;
use super::{AttributeValue, Rule};
use glam::DVec3;
use std::marker::PhantomData;
use thiserror::Error;
use welter_meshing::surface::EdgeId;

/// Names one attribute: of values `T`, at elements `Id`.
#[derive(Debug, PartialEq, Eq)]
pub struct Attribute<T, Id>(usize, PhantomData<(T, Id)>);

impl<T, Id> Clone for Attribute<T, Id> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T, Id> Copy for Attribute<T, Id> {}

/// Why an attribute is refused.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum AttributeError {
    /// The name is taken.
    #[error("there is an attribute named \"{name}\" already")]
    Name {
        /// The name.
        name: String,
    },
    /// There is not one value for each id.
    #[error("attribute \"{name}\" has {values} values for {ids} ids")]
    Length {
        /// The name.
        name: String,
        /// How many values were given.
        values: usize,
        /// How many ids there are, in use or free.
        ids: usize,
    },
    /// Integers have no means.
    #[error("attribute \"{name}\" holds integers, which cannot be interpolated")]
    Mean {
        /// The name.
        name: String,
    },
}

/// The arrays, by type.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    pub(super) scalars: Vec<Column<f64>>,
    pub(super) vectors: Vec<Column<DVec3>>,
    pub(super) integers: Vec<Column<i64>>,
}

/// The attributes of the vertices, the edges or the triangles of a surface.
#[derive(Clone, Debug)]
pub struct AttributeSet<Id> {
    columns: Columns,
    slots: usize,
    elements: PhantomData<Id>,
}

impl<Id> AttributeSet<Id> {
    pub(crate) fn new(slots: usize) -> Self {
        Self { columns: Columns::default(), slots, elements: PhantomData }
    }

    /// Adds an attribute: one value for each id, in use or free.
    ///
    /// # Errors
    /// [`AttributeError`] if the name is taken, the number of values is wrong, or integers are to be interpolated.
    pub fn add<T: AttributeValue>(
        &mut self,
        name: &str,
        values: Vec<T>,
        rule: Rule<T>,
    ) -> Result<Attribute<T, Id>, AttributeError> {
        self.add_column(Column { name: name.to_owned(), values, rule, directed: false })
    }

    fn add_column<T: AttributeValue>(
        &mut self,
        column: Column<T>,
    ) -> Result<Attribute<T, Id>, AttributeError> {
        let name = column.name.clone();
        if self.names().any(|other| other == name) {
            return Err(AttributeError::Name { name });
        }
        if column.values.len() != self.slots {
            return Err(AttributeError::Length { name, values: column.values.len(), ids: self.slots });
        }
        if !T::HAS_MEANS && matches!(column.rule, Rule::Interpolate) {
            return Err(AttributeError::Mean { name });
        }
        let columns = T::columns_mut(&mut self.columns);
        columns.push(column);
        Ok(Attribute(columns.len() - 1, PhantomData))
    }

    /// The names of all attributes: scalars, then vectors, then integers, each in the order in which they were added.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let Columns { scalars, vectors, integers } = &self.columns;
        let scalars = scalars.iter().map(|column| column.name.as_str());
        let vectors = vectors.iter().map(|column| column.name.as_str());
        scalars.chain(vectors).chain(integers.iter().map(|column| column.name.as_str()))
    }

    /// The attribute of a name and type, if there is one.
    #[must_use]
    pub fn find<T: AttributeValue>(&self, name: &str) -> Option<Attribute<T, Id>> {
        let at = T::columns(&self.columns).iter().position(|column| column.name == name);
        at.map(|i| Attribute(i, PhantomData))
    }

    /// The values of an attribute, by id; those of free ids are without meaning.
    ///
    /// # Panics
    /// If the attribute is one of another surface.
    #[must_use]
    pub fn values<T: AttributeValue>(&self, attribute: Attribute<T, Id>) -> &[T] {
        &T::columns(&self.columns)[attribute.0].values
    }

    /// The values of an attribute, to be changed.
    ///
    /// # Panics
    /// If the attribute is one of another surface.
    #[must_use]
    pub fn values_mut<T: AttributeValue>(&mut self, attribute: Attribute<T, Id>) -> &mut [T] {
        &mut T::columns_mut(&mut self.columns)[attribute.0].values
    }

    /// Whether there is no attribute.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.names().next().is_none()
    }

    /// For how many ids there are values, if all attributes agree and there is one.
    pub(crate) fn slots(&self) -> Option<usize> {
        let Columns { scalars, vectors, integers } = &self.columns;
        let mut lengths = scalars.iter().map(|column| column.values.len());
        lengths
            .next()
            .or_else(|| vectors.first().map(|column| column.values.len()))
            .or_else(|| integers.first().map(|column| column.values.len()))
    }

    pub(crate) fn transfer(&mut self, transfer: &Transfer, slots: usize) {
        self.slots = slots;
        self.columns.scalars.iter_mut().for_each(|column| column.transfer(transfer, slots));
        self.columns.vectors.iter_mut().for_each(|column| column.transfer(transfer, slots));
        self.columns.integers.iter_mut().for_each(|column| column.transfer(transfer, slots));
    }

    /// Gives each new id the value of an old one; old ids ascend.
    pub(crate) fn gather(&mut self, old: impl ExactSizeIterator<Item = usize> + Clone) {
        self.slots = old.len();
        self.columns.scalars.iter_mut().for_each(|column| column.gather(old.clone()));
        self.columns.vectors.iter_mut().for_each(|column| column.gather(old.clone()));
        self.columns.integers.iter_mut().for_each(|column| column.gather(old.clone()));
    }
}

impl AttributeSet<EdgeId> {
    /// Gives each new edge the value of an old one; with true, of the opposite direction.
    pub(crate) fn renumber(&mut self, old: &[(EdgeId, bool)]) {
        self.slots = old.len();
        self.columns.scalars.iter_mut().for_each(|column| column.renumber(old));
        self.columns.vectors.iter_mut().for_each(|column| column.renumber(old));
        self.columns.integers.iter_mut().for_each(|column| column.renumber(old));
    }

    /// Adds an attribute whose sign depends on the direction in which an edge is passed; values count from the first
    /// of [`RadialConnectivity::ends`](crate::surface::RadialConnectivity::ends) to the second.
    ///
    /// # Errors
    /// As [`AttributeSet::add`].
    pub fn add_directed<T: AttributeValue>(
        &mut self,
        name: &str,
        values: Vec<T>,
        rule: Rule<T>,
    ) -> Result<Attribute<T, EdgeId>, AttributeError> {
        self.add_column(Column { name: name.to_owned(), values, rule, directed: true })
    }
}
