//! The header of a PLY file: its encoding, elements and properties.

use super::super::error::{Place, ReadError, shown};
use super::super::source::Source;
use super::super::tokens::Tokens;
use std::io::Read;

/// The encoding of what follows the header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// A number type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn of_name(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub(super) fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// What a property holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Scalar),
    List { count: Scalar, item: Scalar },
}

/// A property of each row of an element.
#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) at: Place,
}

/// A table: rows that have the same properties.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) rows: u64,
    pub(super) properties: Vec<Property>,
    pub(super) at: Place,
}

impl Element {
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.properties.iter().position(|p| p.name == name)
    }

    /// Bytes of a binary row, where that is the same for all.
    pub(super) fn stride(&self) -> Option<u64> {
        self.properties.iter().try_fold(0, |sum, p| match p.kind {
            Kind::Scalar(scalar) => Some(sum + scalar.size() as u64),
            Kind::List { .. } => None,
        })
    }
}

/// Everything before the data.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
}

pub(super) fn read(source: &mut Source<impl Read>) -> Result<Header, ReadError> {
    source.begin_text("a PLY header")?;
    match source.next_line()?.map(<[u8]>::trim_ascii) {
        Some(b"ply") => {}
        found => {
            let found = found.unwrap_or_default();
            return Err(ReadError::unexpected(Place::Line(1), "`ply`, the first line of a PLY file", found));
        }
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let at = source.next_line_place();
        let Some(line) = source.next_line()? else {
            let expected = "`end_header`".to_owned();
            return Err(ReadError::Truncated { at: source.line(), expected });
        };
        let mut tokens = Tokens::new(line);
        match tokens.next() {
            None | Some(b"comment" | b"obj_info") => {}
            Some(b"format") if encoding.is_none() && elements.is_empty() => {
                encoding = Some(format(tokens, at)?);
            }
            Some(b"element") if encoding.is_some() => {
                let element = element(tokens, at)?;
                if elements.iter().any(|e| e.name == element.name) {
                    let expected = "an element of a new name";
                    return Err(ReadError::unexpected(at, expected, element.name.as_bytes()));
                }
                elements.push(element);
            }
            Some(b"property") if !elements.is_empty() => {
                let property = property(tokens, at)?;
                let element = elements.last_mut().expect("checked in the guard");
                if element.find(&property.name).is_some() {
                    let expected = format!("a property of a new name in element `{}`", element.name);
                    return Err(ReadError::unexpected(at, expected, property.name.as_bytes()));
                }
                element.properties.push(property);
            }
            Some(b"end_header") => match encoding {
                Some(encoding) => return Ok(Header { encoding, elements }),
                None => return Err(ReadError::unexpected(at, "a `format` line first", b"end_header")),
            },
            Some(word) => {
                let expected = match (encoding, elements.is_empty()) {
                    (None, _) => "`format` or `comment`",
                    (_, true) => "`element`, `comment` or `end_header`",
                    _ => "`element`, `property`, `comment` or `end_header`",
                };
                return Err(ReadError::unexpected(at, expected, word));
            }
        }
    }
}

fn format(mut tokens: Tokens<'_>, at: Place) -> Result<Encoding, ReadError> {
    let encoding = match tokens.next().unwrap_or_default() {
        b"ascii" => Encoding::Ascii,
        b"binary_little_endian" => Encoding::LittleEndian,
        b"binary_big_endian" => Encoding::BigEndian,
        other => {
            let expected = "`ascii`, `binary_little_endian` or `binary_big_endian`";
            return Err(ReadError::unexpected(at, expected, other));
        }
    };
    match tokens.rest() {
        b"1.0" => Ok(encoding),
        other => Err(ReadError::unexpected(at, "version `1.0`", other)),
    }
}

/// One word, which is UTF-8 or taken as Latin-1.
fn word(tokens: &mut Tokens<'_>, what: &str, at: Place) -> Result<String, ReadError> {
    let token = tokens.next().ok_or_else(|| ReadError::unexpected(at, what, b""))?;
    Ok(super::super::tokens::name(token))
}

fn nothing_more(tokens: &Tokens<'_>, at: Place) -> Result<(), ReadError> {
    match tokens.rest() {
        b"" => Ok(()),
        rest => Err(ReadError::unexpected(at, "the end of the line", rest)),
    }
}

fn element(mut tokens: Tokens<'_>, at: Place) -> Result<Element, ReadError> {
    let name = word(&mut tokens, "the name of an element", at)?;
    let count = tokens.next().unwrap_or_default();
    let rows = std::str::from_utf8(count).ok().and_then(|t| t.parse().ok());
    let Some(rows) = rows else {
        let expected = format!("the number of rows of element `{name}`");
        return Err(ReadError::Unexpected { at, expected, found: shown(count) });
    };
    nothing_more(&tokens, at)?;
    Ok(Element { name, rows, properties: Vec::new(), at })
}

fn property(mut tokens: Tokens<'_>, at: Place) -> Result<Property, ReadError> {
    let scalar = |token: Option<&[u8]>, what: &str| {
        let token = token.unwrap_or_default();
        Scalar::of_name(token).ok_or_else(|| ReadError::unexpected(at, what, token))
    };
    let first = tokens.next();
    let kind = if first == Some(b"list") {
        let token = tokens.next();
        let count = scalar(token, "the type of a list's length")?;
        if !count.is_integer() {
            let expected = "an integer type for a list's length";
            return Err(ReadError::unexpected(at, expected, token.unwrap_or_default()));
        }
        Kind::List { count, item: scalar(tokens.next(), "the type of a list's items")? }
    } else {
        Kind::Scalar(scalar(first, "`list` or a number type such as `float`")?)
    };
    let name = word(&mut tokens, "the name of a property", at)?;
    nothing_more(&tokens, at)?;
    Ok(Property { name, kind, at })
}
