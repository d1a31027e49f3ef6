//! Reads data on nodes and elements, and gives it to the vertices and cells to which its numbers belong.

use std::collections::BTreeSet;
use std::io::Read;

use super::data::COMPONENTS;
use super::ids::{Numbering, Places};
use super::input::Input;
use crate::io::DataField;
use crate::io::error::{Place, ReadError};
use crate::io::volume_builder::VolumeBuilder;

/// Data with values at less than one in so many places is passed over: filled up, it would take memory out of proportion.
const SPARSEST: usize = 16;

/// A section of data.
pub(super) struct Data {
    at: Place,
    name: String,
    components: usize,
    /// Numbers of nodes or elements, in the order of the values.
    numbers: Numbering,
    values: Vec<f64>,
}

/// Reads a section up to its end; none if it has no name to know it by.
pub(super) fn read<R: Read>(
    input: &mut Input<R>,
    section: &str,
    builder: &mut VolumeBuilder,
) -> Result<Option<Data>, ReadError> {
    let at = input.line_place();
    let strings = input.text_count(|| format!("the number of strings of `${section}`"))?;
    let mut name = String::new();
    for k in 0..strings {
        let line = input.text_line(|| format!("a string of `${section}`"))?;
        if k == 0 {
            let inside = line.strip_prefix('"').and_then(|line| line.strip_suffix('"'));
            inside.unwrap_or(&line).clone_into(&mut name);
        }
    }
    let reals = input.text_count(|| format!("the number of real numbers of `${section}`"))?;
    for _ in 0..reals {
        input.words().float(|| format!("a real number of `${section}`"))?;
    }
    let integers = input.text_count(|| format!("the number of integers of `${section}`"))?;
    if integers < 3 {
        let expected = format!("at least 3 integers of `${section}`");
        return Err(ReadError::Unexpected { at: input.line_place(), expected, found: integers.to_string() });
    }
    input.words().integer(|| format!("the time step of `${section}`"))?;
    let components = input.words().count(|| format!("the number of components of `${section}`"))?;
    let components = usize::try_from(components).ok().filter(|components| COMPONENTS.contains(components));
    let components = components
        .ok_or_else(|| ReadError::unexpected(input.line_place(), "1, 3 or 9 components", b"others"))?;
    let count = input.words().count(|| format!("the number of values of `${section}`"))?;
    for _ in 3..integers {
        input.words().integer(|| format!("an integer of `${section}`"))?;
    }
    if !input.words().rest_of_line().is_empty() {
        let rest = input.words().rest_of_line().to_vec();
        return Err(ReadError::unexpected(input.line_place(), "the end of the line", &rest));
    }
    let mut data = Data { at, name, components, numbers: Numbering::default(), values: Vec::new() };
    for row in 1..=count {
        let expected = |what: &str| format!("{what} of value {row} of the {count} declared of `${section}`");
        let number = input.int(|| expected("the node or element"))?;
        // A negative number belongs to nothing.
        data.numbers.push(u64::try_from(number).unwrap_or(u64::MAX));
        for _ in 0..components {
            data.values.push(input.double(|| expected("a number"))?);
        }
    }
    if data.name.is_empty() || data.name.chars().any(char::is_control) {
        builder.ignore("data without a name", at);
        return Ok(None);
    }
    Ok(Some(data))
}

impl Data {
    /// The field: to each place its value, where `place` says to which place a number belongs.
    fn into_field(
        self,
        places: usize,
        plain: bool,
        place: impl Fn(u64) -> Option<Target>,
        builder: &mut VolumeBuilder,
    ) -> Result<Option<DataField<'static>>, ReadError> {
        let Self { at, name, components, numbers, values } = self;
        if plain && numbers.is_plain() && numbers.len() == places {
            return Ok(Some(DataField::new(name, components, values)));
        }
        if numbers.len() < places / SPARSEST {
            builder.ignore("data at few places", at);
            return Ok(None);
        }
        let mut filled = vec![f64::NAN; places * components];
        let mut has_value = vec![false; places];
        for (row, value) in values.chunks_exact(components).enumerate() {
            let number = numbers.number(row);
            match place(number) {
                Some(Target::Place(place)) if !has_value[place] => {
                    filled[place * components..][..components].copy_from_slice(value);
                    has_value[place] = true;
                }
                Some(Target::PassedOver) => {}
                other => {
                    let found = if other.is_some() { format!("{number} twice") } else { number.to_string() };
                    let expected = "the numbers of nodes or elements of the mesh, each once".to_owned();
                    return Err(ReadError::Unexpected { at, expected, found });
                }
            }
        }
        if has_value.contains(&false) {
            builder.ignore("no value at some places, which is read as NaN", at);
        }
        Ok(Some(DataField::new(name, components, filled)))
    }
}

/// Where a value goes.
enum Target {
    Place(usize),
    /// To an element that is not held.
    PassedOver,
}

/// Data whose name was not given before.
fn named_once(data: Vec<Data>, taken: &[DataField<'_>], builder: &mut VolumeBuilder) -> Vec<Data> {
    let mut names: BTreeSet<String> = taken.iter().map(|field| field.name.to_string()).collect();
    let mut kept = Vec::new();
    for data in data {
        if names.insert(data.name.clone()) {
            kept.push(data);
        } else {
            builder.ignore("data of a name given before", data.at);
        }
    }
    kept
}

pub(super) fn add_point_fields(
    builder: &mut VolumeBuilder,
    data: Vec<Data>,
    nodes: &Places,
) -> Result<(), ReadError> {
    for data in named_once(data, &[], builder) {
        let place = |number| nodes.place(number).map(Target::Place);
        let field = data.into_field(builder.vertices(), nodes.is_plain(), place, builder)?;
        builder.data.point_fields.extend(field);
    }
    Ok(())
}

pub(super) fn add_cell_fields(
    builder: &mut VolumeBuilder,
    data: Vec<Data>,
    elements: Numbering,
) -> Result<(), ReadError> {
    let taken = std::mem::take(&mut builder.data.cell_fields);
    let data = named_once(data, &taken, builder);
    builder.data.cell_fields = taken;
    let Some(first) = data.first() else { return Ok(()) };
    let at = first.at;
    let elements = elements.into_places().map_err(|twice| ReadError::Unexpected {
        at,
        expected: "elements with numbers of their own, as there is data".to_owned(),
        found: format!("{twice} twice"),
    })?;
    let held = builder.numbers();
    let in_order = held.iter().enumerate().all(|(place, &number)| number == Some(place as u32));
    for data in data {
        let place = |number| {
            let element = elements.place(number)?;
            Some(held[element].map_or(Target::PassedOver, |cell| Target::Place(cell as usize)))
        };
        let cells = builder.data.cell_count();
        let field = data.into_field(cells, in_order && elements.is_plain(), place, builder)?;
        builder.data.cell_fields.extend(field);
    }
    Ok(())
}
