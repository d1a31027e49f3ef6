//! Reads the entities, nodes and elements of version 4.1.

use std::io::Read;

use super::ids::{Numbering, Places};
use super::input::Input;
use super::read::Reader;
use super::types::ElementType;
use crate::io::error::ReadError;

/// The physical tags of entities; the first of each is kept.
pub(super) fn entities<R: Read>(input: &mut Input<R>, reader: &mut Reader) -> Result<(), ReadError> {
    let mut counts = [0; 4];
    for count in &mut counts {
        *count = input.size(|| "the number of entities of a dimension".to_owned())?;
    }
    for (dimension, count) in (0..).zip(counts) {
        for row in 1..=count {
            let expected = |what: &str| {
                format!("{what} of entity {row} of the {count} declared of dimension {dimension}")
            };
            let number = input.int(|| expected("the number"))?;
            for _ in 0..if dimension == 0 { 3 } else { 6 } {
                input.double(|| expected("the extent"))?;
            }
            let tag_count = input.size(|| expected("the number of physical tags"))?;
            for k in 0..tag_count {
                let tag = input.int(|| expected("a physical tag"))?;
                match k {
                    0 => _ = reader.entities.insert((dimension, number), tag),
                    1 => reader.builder.ignore("further physical tags of entities", input.place()),
                    _ => {}
                }
            }
            if dimension > 0 {
                let sides = input.size(|| expected("the number of bounding entities"))?;
                for _ in 0..sides {
                    input.int(|| expected("a bounding entity"))?;
                }
            }
        }
    }
    Ok(())
}

/// The head of the nodes or elements: how many blocks, and how many in all.
fn head<R: Read>(input: &mut Input<R>, what: &str) -> Result<(u64, u64), ReadError> {
    let blocks = input.size(|| format!("the number of blocks of {what}"))?;
    let total = input.size(|| format!("the number of {what}"))?;
    for end in ["smallest", "largest"] {
        input.size(|| format!("the {end} number of {what}"))?;
    }
    Ok((blocks, total))
}

/// The length of a block, of which `left` are still to come.
fn length<R: Read>(input: &mut Input<R>, what: &str, left: u64) -> Result<u64, ReadError> {
    let length = input.size(|| format!("the number of {what} of a block"))?;
    if length <= left {
        return Ok(length);
    }
    let expected = format!("at most {left} {what} of a block");
    Err(ReadError::Unexpected { at: input.place(), expected, found: length.to_string() })
}

/// All that were declared are there.
fn complete<R: Read>(input: &Input<R>, what: &str, total: u64, read: usize) -> Result<(), ReadError> {
    if total == read as u64 {
        return Ok(());
    }
    let (expected, found) = (format!("{total} {what} in blocks"), read.to_string());
    Err(ReadError::Unexpected { at: input.place(), expected, found })
}

pub(super) fn nodes<R: Read>(input: &mut Input<R>, reader: &mut Reader) -> Result<Numbering, ReadError> {
    let (blocks, total) = head(input, "nodes")?;
    reader.builder.check_vertices(total, input.place())?;
    let mut numbers = Numbering::default();
    for _ in 0..blocks {
        let dimension = input.int(|| "the dimension of an entity".to_owned())?;
        input.int(|| "the number of an entity".to_owned())?;
        let parametric = input.int(|| "whether nodes have parameters".to_owned())?;
        let length = length(input, "nodes", total - numbers.len() as u64)?;
        let first = numbers.len();
        for row in 1..=length {
            let row = first as u64 + row;
            numbers.push(input.size(|| format!("the number of node {row} of the {total} declared"))?);
        }
        let parameters = if parametric == 0 { 0 } else { dimension.clamp(0, 3) };
        for row in 1..=length {
            let row = first as u64 + row;
            let mut position = [0.0; 3];
            for (coordinate, name) in position.iter_mut().zip(["x", "y", "z"]) {
                *coordinate = input
                    .double(|| format!("the {name} coordinate of node {row} of the {total} declared"))?;
            }
            for _ in 0..parameters {
                input.double(|| format!("a parameter of node {row} of the {total} declared"))?;
            }
            reader.node(position, input.place())?;
        }
    }
    complete(input, "nodes", total, numbers.len())?;
    Ok(numbers)
}

pub(super) fn elements<R: Read>(
    input: &mut Input<R>,
    reader: &mut Reader,
    nodes: &Places,
) -> Result<Numbering, ReadError> {
    let (blocks, total) = head(input, "elements")?;
    reader.builder.check_cells(total, input.place())?;
    let mut numbers = Numbering::default();
    for _ in 0..blocks {
        let dimension = input.int(|| "the dimension of an entity".to_owned())?;
        let entity = input.int(|| "the number of an entity".to_owned())?;
        let kind = input.int(|| "the type of elements".to_owned())?;
        let at = input.place();
        let kind = ElementType::of_number(i64::from(kind))
            .ok_or_else(|| ReadError::Unsupported { at, what: format!("element type {kind}") })?;
        let tags = [reader.entities.get(&(dimension, entity)).copied().unwrap_or(0), entity];
        let length = length(input, "elements", total - numbers.len() as u64)?;
        for _ in 0..length {
            let row = numbers.len() + 1;
            numbers.push(input.size(|| format!("the number of element {row} of the {total} declared"))?);
            let mut corners = [0; 8];
            for k in 0..kind.nodes() {
                let node = input.size(|| format!("a node of element {row} of the {total} declared"))?;
                if let Some(corner) = corners.get_mut(k) {
                    *corner = node;
                }
            }
            reader.element(kind, &corners, tags, nodes, input.place())?;
        }
    }
    complete(input, "elements", total, numbers.len())?;
    Ok(numbers)
}
