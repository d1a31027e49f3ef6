//! Reads PLY: one pass over the elements in the order of the header.

use super::super::builder::Builder;
use super::super::error::{Place, ReadError};
use super::super::source::Source;
use super::super::{Limits, ReadReport};
use super::body::{Body, What};
use super::header::{self, Element, Kind, Scalar};
use crate::surface::TriangleSoup;
use glam::DVec3;
use std::io::Read;

pub(in super::super) fn read(
    input: impl Read,
    limits: &Limits,
) -> Result<(TriangleSoup, ReadReport), ReadError> {
    let mut source = Source::new(input);
    let header = header::read(&mut source)?;
    let mut builder = Builder::new(limits);
    let vertices = declared(&header.elements, &mut builder)?;
    let mut body = Body::new(&mut source, header.encoding);
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => read_vertices(&mut body, element, &mut builder)?,
            "face" => read_faces(&mut body, element, vertices, &mut builder)?,
            "tristrips" => read_strips(&mut body, element, vertices, &mut builder)?,
            name => {
                builder.ignore(format!("element `{name}`"), element.at);
                body.skip_element(element)?;
            }
        }
    }
    body.expect_end(&header.elements)?;
    Ok(builder.finish())
}

/// Checks the declared counts against the limits; the number of vertices.
fn declared(elements: &[Element], builder: &mut Builder) -> Result<u64, ReadError> {
    let mut vertices = 0;
    for element in elements {
        match element.name.as_str() {
            "vertex" => {
                vertices = element.rows;
                builder.declare(vertices, 0, element.at)?;
            }
            "face" => builder.declare(0, element.rows, element.at)?,
            _ => {}
        }
    }
    Ok(vertices)
}

/// What a property is to the reader.
#[derive(Clone, Copy)]
enum Use {
    /// Coordinate 0, 1 or 2.
    Coordinate(usize, Scalar),
    /// The list of a face's vertices.
    Corners {
        count: Scalar,
        item: Scalar,
    },
    /// Red, green or blue.
    Color(usize, Scalar),
    Pass(Kind),
}

/// Pairs each property with its use and notes those that have none.
fn uses(element: &Element, builder: &mut Builder, choose: impl Fn(&str, Kind) -> Option<Use>) -> Vec<Use> {
    let mut uses = Vec::with_capacity(element.properties.len());
    for property in &element.properties {
        uses.push(choose(&property.name, property.kind).unwrap_or_else(|| {
            builder.ignore(format!("{} property `{}`", element.name, property.name), property.at);
            Use::Pass(property.kind)
        }));
    }
    uses
}

fn missing(element: &Element, what: &str) -> ReadError {
    ReadError::Unexpected {
        at: element.at,
        expected: format!("element `{}` with {what}", element.name),
        found: "none".to_owned(),
    }
}

fn read_vertices<R: Read>(
    body: &mut Body<'_, R>,
    element: &Element,
    builder: &mut Builder,
) -> Result<(), ReadError> {
    let axis = |name: &str| ["x", "y", "z"].iter().position(|axis| *axis == name);
    let uses = uses(element, builder, |name, kind| match (axis(name), kind) {
        (Some(axis), Kind::Scalar(scalar)) => Some(Use::Coordinate(axis, scalar)),
        _ => None,
    });
    if uses.iter().filter(|u| matches!(u, Use::Coordinate(..))).count() < 3 {
        return Err(missing(element, "scalar properties `x`, `y` and `z`"));
    }
    for row in 0..element.rows {
        let mut what = What { element, row, property: usize::MAX };
        body.begin_row(what)?;
        let mut position = [0.0; 3];
        for (property, role) in uses.iter().enumerate() {
            what.property = property;
            match *role {
                Use::Coordinate(axis, scalar) => position[axis] = body.float(scalar, what)?,
                Use::Pass(kind) => body.skip(kind, what)?,
                Use::Corners { .. } | Use::Color(..) => unreachable!("vertices have coordinates only"),
            }
        }
        body.end_row(what)?;
        builder.vertex(DVec3::from_array(position), body.place())?;
    }
    Ok(())
}

fn read_faces<R: Read>(
    body: &mut Body<'_, R>,
    element: &Element,
    vertices: u64,
    builder: &mut Builder,
) -> Result<(), ReadError> {
    let colored = ["red", "green", "blue"].iter().all(|name| {
        let kind = element.find(name).map(|k| element.properties[k].kind);
        matches!(kind, Some(Kind::Scalar(Scalar::U8 | Scalar::F32 | Scalar::F64)))
    });
    let uses = uses(element, builder, |name, kind| match (name, kind) {
        ("vertex_indices" | "vertex_index", Kind::List { count, item }) if item.is_integer() => {
            Some(Use::Corners { count, item })
        }
        ("red", Kind::Scalar(scalar)) if colored => Some(Use::Color(0, scalar)),
        ("green", Kind::Scalar(scalar)) if colored => Some(Use::Color(1, scalar)),
        ("blue", Kind::Scalar(scalar)) if colored => Some(Use::Color(2, scalar)),
        _ => None,
    });
    if uses.iter().filter(|u| matches!(u, Use::Corners { .. })).count() != 1 {
        return Err(missing(element, "one list property `vertex_indices` (or `vertex_index`) of integers"));
    }
    let mut corners = Vec::new();
    for row in 0..element.rows {
        let mut what = What { element, row, property: usize::MAX };
        body.begin_row(what)?;
        let mut color = [0; 3];
        let mut at = body.place();
        for (property, role) in uses.iter().enumerate() {
            what.property = property;
            match *role {
                Use::Corners { count, item } => {
                    let length = body.length(count, what)?;
                    at = body.place();
                    if length < 3 {
                        return Err(few_corners(at, length));
                    }
                    corners.clear();
                    for _ in 0..length {
                        let index = body.integer(item, what)?;
                        corners.push(in_range(index, vertices, body.place())?);
                    }
                }
                Use::Color(channel, scalar) => color[channel] = read_color(body, scalar, what)?,
                Use::Pass(kind) => body.skip(kind, what)?,
                Use::Coordinate(..) => unreachable!("faces have no coordinates"),
            }
        }
        body.end_row(what)?;
        builder.polygon(&corners, at)?;
        if colored {
            builder.color(color);
        }
    }
    Ok(())
}

fn few_corners(at: Place, length: u64) -> ReadError {
    let expected = "a face of at least 3 vertices".to_owned();
    ReadError::Unexpected { at, expected, found: length.to_string() }
}

#[inline]
fn in_range(index: i64, vertices: u64, at: Place) -> Result<u32, ReadError> {
    match u32::try_from(index) {
        Ok(index) if u64::from(index) < vertices => Ok(index),
        _ => Err(ReadError::IndexOutOfRange { at, index, vertices, base: 0, declared: true }),
    }
}

fn read_color<R: Read>(body: &mut Body<'_, R>, scalar: Scalar, what: What<'_>) -> Result<u8, ReadError> {
    if scalar != Scalar::U8 {
        return Ok((body.float(scalar, what)?.clamp(0.0, 1.0) * 255.0).round() as u8);
    }
    let value = body.integer(scalar, what)?;
    u8::try_from(value).map_err(|_| ReadError::Unexpected {
        at: body.place(),
        expected: format!("0 to 255, {what}"),
        found: value.to_string(),
    })
}

/// Strips: each vertex after the second makes a triangle with the two before it, of alternating order.
fn read_strips<R: Read>(
    body: &mut Body<'_, R>,
    element: &Element,
    vertices: u64,
    builder: &mut Builder,
) -> Result<(), ReadError> {
    let uses = uses(element, builder, |name, kind| match (name, kind) {
        ("vertex_indices" | "vertex_index", Kind::List { count, item }) if item.is_integer() => {
            Some(Use::Corners { count, item })
        }
        _ => None,
    });
    if uses.iter().filter(|u| matches!(u, Use::Corners { .. })).count() != 1 {
        return Err(missing(element, "one list property `vertex_indices` of integers"));
    }
    for row in 0..element.rows {
        let mut what = What { element, row, property: usize::MAX };
        body.begin_row(what)?;
        for (property, role) in uses.iter().enumerate() {
            what.property = property;
            match *role {
                Use::Corners { count, item } => {
                    let (mut a, mut b, mut taken) = (0, 0, 0_u64);
                    for _ in 0..body.length(count, what)? {
                        let index = body.integer(item, what)?;
                        if index == -1 {
                            taken = 0;
                            continue;
                        }
                        let c = in_range(index, vertices, body.place())?;
                        if taken >= 2 {
                            let corners = if taken.is_multiple_of(2) { [a, b, c] } else { [b, a, c] };
                            builder.triangle(corners, body.place())?;
                        }
                        (a, b, taken) = (b, c, taken + 1);
                    }
                }
                Use::Pass(kind) => body.skip(kind, what)?,
                Use::Coordinate(..) | Use::Color(..) => unreachable!("strips have corners only"),
            }
        }
        body.end_row(what)?;
    }
    Ok(())
}
