//! Groups of cells as field data: an array `FIELD:NAME` for each name, of tags and dimensions by turns.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::io::{self, Read, Write};

use super::elements::{ArrayReader, Body, DataArrayElement, skip_element};
use super::numbers::Scalar;
use super::piece::each_child;
use super::xml::Tag;
use crate::io::error::{Place, ReadError};
use crate::io::source::Source;
use crate::io::volume_builder::VolumeBuilder;
use crate::io::vtk::escaped;
use crate::io::{CellGroup, Dropped, VolumeView};

/// What stands between the name of a field and that of a group.
const SEPARATOR: char = ':';

/// The groups as arrays can hold them.
pub(super) struct GroupArrays<'a> {
    /// Name, and tags with dimensions.
    arrays: Vec<(String, Vec<[i32; 2]>)>,
    changed: usize,
    lost: Vec<&'a CellGroup>,
}

impl<'a> GroupArrays<'a> {
    pub(super) fn of(mesh: &VolumeView<'a>) -> Self {
        let mut found = Self { arrays: Vec::new(), changed: 0, lost: Vec::new() };
        let fields = || mesh.cell_fields.iter().map(|field| &*field.name);
        let mut places = std::collections::BTreeMap::new();
        for group in mesh.groups {
            let name = as_attribute(&group.name);
            let array = format!("{}{SEPARATOR}{name}", group.field);
            // There must be such a field, and none by which the name would be read in another way.
            if field_of(&array, fields()) != Some(&group.field) {
                found.lost.push(group);
                continue;
            }
            found.changed += usize::from(name != group.name);
            let place = *places.entry(array.clone()).or_insert_with(|| {
                found.arrays.push((array, Vec::new()));
                found.arrays.len() - 1
            });
            found.arrays[place].1.push([group.tag, group.dimension as i32]);
        }
        found
    }

    /// What of the names is not in the file, or not as it was.
    pub(super) fn dropped(&self) -> Vec<Dropped> {
        let (changed, lost) = (self.changed, self.lost.len());
        let changed = (changed > 0).then_some(Dropped::GroupNames { count: changed });
        changed.into_iter().chain((lost > 0).then_some(Dropped::NamesOfTags { count: lost })).collect()
    }

    /// Writes the arrays, as text in place whatever the encoding of others.
    pub(super) fn write(&self, output: &mut impl Write) -> io::Result<()> {
        if self.arrays.is_empty() {
            return Ok(());
        }
        writeln!(output, "    <FieldData>")?;
        for (name, pairs) in &self.arrays {
            let (name, numbers) = (escaped(name), pairs.as_flattened());
            let count = numbers.len();
            write!(
                output,
                r#"      <DataArray type="Int32" Name="{name}" NumberOfTuples="{count}" format="ascii">"#
            )?;
            for (k, number) in numbers.iter().enumerate() {
                write!(output, "{}{number}", if k > 0 { " " } else { "" })?;
            }
            writeln!(output, "</DataArray>")?;
        }
        writeln!(output, "    </FieldData>")
    }
}

/// A name as an attribute can hold it, where line ends become spaces and other control characters cannot stand.
fn as_attribute(name: &str) -> Cow<'_, str> {
    if name.contains(char::is_control) { name.replace(char::is_control, " ").into() } else { name.into() }
}

/// The field with the longest name of which groups have arrays of such a name.
fn field_of<'a>(array: &str, fields: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let fits = |field: &&str| array.strip_prefix(*field).is_some_and(|rest| rest.starts_with(SEPARATOR));
    fields.filter(fits).max_by_key(|field| field.len())
}

/// Field data as found in a file.
#[derive(Default)]
pub(super) struct FieldData(Vec<DataArrayElement>);

impl FieldData {
    /// Reads the field data that `tag` opens: arrays of integers that may be groups.
    pub(super) fn read<R: Read>(
        &mut self,
        source: &mut Source<R>,
        tag: &Tag,
        arrays: ArrayReader,
        builder: &mut VolumeBuilder,
    ) -> Result<(), ReadError> {
        each_child(source, tag, |source, child| {
            let scalar = Scalar::of_name(child.attribute("type").unwrap_or_default());
            let may_be_real = scalar.is_none_or(|scalar| matches!(scalar, Scalar::Float32 | Scalar::Float64));
            if may_be_real || !child.attribute("Name").unwrap_or_default().contains(SEPARATOR) {
                ignore(builder, child.at);
                return skip_element(source, child);
            }
            self.0.extend(arrays.element(source, child, None)?);
            Ok(())
        })
    }

    /// The arrays whose numbers are appended, each with its offset.
    pub(super) fn appended(&mut self) -> Vec<(u64, &mut DataArrayElement)> {
        let appended = self.0.iter_mut().filter_map(|array| match array.body {
            Body::Appended(offset) => Some((offset, array)),
            Body::Read(_) => None,
        });
        appended.collect()
    }

    /// The groups among the arrays, of those fields on cells; the others are passed over.
    pub(super) fn into_groups(self, fields: &[DataArrayElement], builder: &mut VolumeBuilder) {
        let mut known = BTreeSet::new();
        for array in self.0 {
            let field = field_of(&array.name, fields.iter().map(|field| &*field.name));
            let Some((field, pairs)) = field.zip(pairs(&array)) else {
                ignore(builder, array.at);
                continue;
            };
            let name = &array.name[field.len() + SEPARATOR.len_utf8()..];
            for (tag, dimension) in pairs {
                if known.insert((field, dimension, tag)) {
                    let (name, field) = (name.to_owned(), field.to_owned());
                    builder.data.groups.push(CellGroup { name, field, dimension, tag });
                } else {
                    builder.ignore("further names of a tag", array.at);
                }
            }
        }
    }
}

fn ignore(builder: &mut VolumeBuilder, at: Place) {
    builder.ignore("field data", at);
}

/// The tags and dimensions of an array; none if it has other numbers.
fn pairs(array: &DataArrayElement) -> Option<Vec<(i32, usize)>> {
    let Body::Read(values) = &array.body else { return None };
    let numbers: Vec<i64> = (0..values.len()).map(|k| values.integer(k)).collect::<Option<_>>()?;
    let (pairs, rest) = numbers.as_chunks::<2>();
    let pair = |&[tag, dimension]: &[i64; 2]| {
        let dimension = [2, 3].into_iter().find(|&known| known as i64 == dimension)?;
        Some((i32::try_from(tag).ok()?, dimension))
    };
    if rest.is_empty() { pairs.iter().map(pair).collect() } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DVec3;
    use crate::io::DataField;

    #[test]
    fn names_that_arrays_cannot_have_are_told() {
        let fields = ["a", "a:b"].map(|name| DataField::new(name, 1, Vec::<i32>::new()));
        let group = |field: &str, name: &str, tag| CellGroup {
            name: name.to_owned(),
            field: field.to_owned(),
            dimension: 2,
            tag,
        };
        let groups = [
            group("a", "x:y", 1),
            group("a:b", "x\ny", 2),
            group("a", "x:y", 3),
            group("a", "b:c", 4), // would be read as `c` of the other field
            group("none", "x", 5),
            group("a", "", 6),
        ];
        let position = |_: usize| DVec3::ZERO;
        let view = VolumeView { cell_fields: &fields, groups: &groups, ..VolumeView::new(0, &position) };
        let found = GroupArrays::of(&view);
        let array = |name: &str, tags: &[i32]| (name.to_owned(), tags.iter().map(|&tag| [tag, 2]).collect());
        assert_eq!(found.arrays, [array("a:x:y", &[1, 3]), array("a:b:x y", &[2]), array("a:", &[6])]);
        assert_eq!(found.dropped(), [Dropped::GroupNames { count: 1 }, Dropped::NamesOfTags { count: 2 }]);
    }
}
