//! Reads the nodes and elements of version 2.2.

use std::io::Read;

use super::ids::{Numbering, Places};
use super::input::Input;
use super::read::Reader;
use super::types::ElementType;
use crate::io::error::{Place, ReadError};

/// The number of a node or element, which is not negative.
fn number<R: Read>(input: &mut Input<R>, expected: impl Fn() -> String) -> Result<u64, ReadError> {
    let number = input.int(&expected)?;
    let at = input.place();
    u64::try_from(number).map_err(|_| ReadError::Unexpected {
        at,
        expected: expected(),
        found: number.to_string(),
    })
}

pub(super) fn nodes<R: Read>(input: &mut Input<R>, reader: &mut Reader) -> Result<Numbering, ReadError> {
    let count = input.text_count(|| "the number of nodes".to_owned())?;
    reader.builder.check_vertices(count, input.line_place())?;
    let mut numbers = Numbering::default();
    for row in 1..=count {
        numbers.push(number(input, || format!("the number of node {row} of the {count} declared"))?);
        let mut position = [0.0; 3];
        for (coordinate, name) in position.iter_mut().zip(["x", "y", "z"]) {
            *coordinate =
                input.double(|| format!("the {name} coordinate of node {row} of the {count} declared"))?;
        }
        reader.node(position, input.place())?;
    }
    Ok(numbers)
}

pub(super) fn elements<R: Read>(
    input: &mut Input<R>,
    reader: &mut Reader,
    nodes: &Places,
) -> Result<Numbering, ReadError> {
    let count = input.text_count(|| "the number of elements".to_owned())?;
    reader.builder.check_cells(count, input.line_place())?;
    let mut numbers = Numbering::default();
    while (numbers.len() as u64) < count {
        if input.binary {
            block(input, reader, nodes, &mut numbers, count)?;
        } else {
            row(input, reader, nodes, &mut numbers, count)?;
        }
    }
    Ok(numbers)
}

fn element_type(kind: i32, at: Place) -> Result<ElementType, ReadError> {
    let unknown = || ReadError::Unsupported { at, what: format!("element type {kind}") };
    ElementType::of_number(i64::from(kind)).ok_or_else(unknown)
}

/// A line: number, type, tags with their number before them, nodes.
fn row<R: Read>(
    input: &mut Input<R>,
    reader: &mut Reader,
    nodes: &Places,
    numbers: &mut Numbering,
    count: u64,
) -> Result<(), ReadError> {
    let row = numbers.len() + 1;
    let expected = |what: &str| format!("{what} of element {row} of the {count} declared");
    numbers.push(number(input, || expected("the number"))?);
    let kind = input.int(|| expected("the type"))?;
    let kind = element_type(kind, input.place())?;
    let tag_count = number(input, || expected("the number of tags"))?;
    body(input, reader, nodes, kind, tag_count, &expected)
}

/// Tags and nodes of an element.
fn body<R: Read>(
    input: &mut Input<R>,
    reader: &mut Reader,
    nodes: &Places,
    kind: ElementType,
    tag_count: u64,
    expected: &dyn Fn(&str) -> String,
) -> Result<(), ReadError> {
    let mut tags = [0; 2];
    for k in 0..tag_count {
        let tag = input.int(|| expected("a tag"))?;
        match tags.get_mut(k as usize) {
            Some(known) => *known = tag,
            None if k == 2 => reader.builder.ignore("further tags of elements", input.place()),
            None => {}
        }
    }
    let mut corners = [0; 8];
    for k in 0..kind.nodes() {
        let node = number(input, || expected("a node"))?;
        if let Some(corner) = corners.get_mut(k) {
            *corner = node;
        }
    }
    reader.element(kind, &corners, tags, nodes, input.place())
}

/// Elements of one type behind their type, number and number of tags.
fn block<R: Read>(
    input: &mut Input<R>,
    reader: &mut Reader,
    nodes: &Places,
    numbers: &mut Numbering,
    count: u64,
) -> Result<(), ReadError> {
    let kind = input.int(|| "the type of elements".to_owned())?;
    let kind = element_type(kind, input.place())?;
    let left = count - numbers.len() as u64;
    let length = number(input, || "the number of elements of a type".to_owned())?;
    if length == 0 || length > left {
        let expected = format!("1 to {left} elements of a type");
        return Err(ReadError::Unexpected { at: input.place(), expected, found: length.to_string() });
    }
    let tag_count = number(input, || "the number of tags".to_owned())?;
    for _ in 0..length {
        let row = numbers.len() + 1;
        let expected = |what: &str| format!("{what} of element {row} of the {count} declared");
        numbers.push(number(input, || expected("the number"))?);
        body(input, reader, nodes, kind, tag_count, &expected)?;
    }
    Ok(())
}
