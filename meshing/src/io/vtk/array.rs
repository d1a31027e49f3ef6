//! An array of a VTK file on its way to a writer: [`Array`]. Its numbers are asked for place by place, so that none are kept.

use std::fmt::Display;
use std::io::{self, Write};

use super::base64::Base64;
use super::{VtkEncoding, escaped};
use crate::io::text::Decimal;

/// Numbers of text a line: what is still easy to look at.
const NUMBERS_A_LINE: usize = 12;
/// Numbers gathered before they are encoded: enough that the cost of a write vanishes.
const GATHERED: usize = 4096;

/// Appends the numbers of a place: a point, a cell.
pub(in crate::io) type Row<'a, T> = Box<dyn Fn(usize, &mut Vec<T>) + 'a>;

/// Where numbers come from, by type.
pub(in crate::io) enum Numbers<'a> {
    Float64(Row<'a, f64>),
    Int32(Row<'a, i32>),
    Int64(Row<'a, i64>),
    UInt8(Row<'a, u8>),
}

/// A named array.
pub(in crate::io) struct Array<'a> {
    pub(in crate::io) name: &'a str,
    /// Numbers of each place, where the element says so.
    pub(in crate::io) components: Option<usize>,
    /// Number of places.
    pub(in crate::io) places: usize,
    /// Number of numbers of all places.
    pub(in crate::io) count: u64,
    pub(in crate::io) numbers: Numbers<'a>,
}

/// A number as VTK knows it.
trait Number: Copy {
    const SIZE: usize;
    fn bytes(self, bytes: &mut Vec<u8>);
    fn text(self) -> impl Display;
}

macro_rules! number {
    ($type:ty, $text:expr) => {
        impl Number for $type {
            const SIZE: usize = size_of::<$type>();
            #[inline]
            fn bytes(self, bytes: &mut Vec<u8>) {
                bytes.extend_from_slice(&self.to_le_bytes());
            }
            #[inline]
            fn text(self) -> impl Display {
                $text(self)
            }
        }
    };
}
number!(f64, Decimal);
number!(i32, std::convert::identity);
number!(i64, std::convert::identity);
number!(u8, std::convert::identity);

/// Calls a generic function on the numbers, whatever their type.
macro_rules! with_numbers {
    ($numbers:expr, $row:ident => $call:expr) => {
        match $numbers {
            Numbers::Float64($row) => $call,
            Numbers::Int32($row) => $call,
            Numbers::Int64($row) => $call,
            Numbers::UInt8($row) => $call,
        }
    };
}

impl<'a> Array<'a> {
    /// An array with as many numbers for each place.
    pub(in crate::io) fn new(name: &'a str, components: usize, places: usize, numbers: Numbers<'a>) -> Self {
        let count = components as u64 * places as u64;
        Self { name, components: Some(components), places, count, numbers }
    }

    /// Length of its numbers in bytes.
    fn length(&self) -> u64 {
        self.count * with_numbers!(&self.numbers, row => size(row)) as u64
    }

    /// Writes its element, with its numbers unless they are appended; `offset` moves on by their bytes.
    pub(in crate::io) fn write_element(
        &self,
        output: &mut impl Write,
        encoding: VtkEncoding,
        offset: &mut u64,
    ) -> io::Result<()> {
        let kind = match self.numbers {
            Numbers::Float64(_) => "Float64",
            Numbers::Int32(_) => "Int32",
            Numbers::Int64(_) => "Int64",
            Numbers::UInt8(_) => "UInt8",
        };
        write!(output, r#"        <DataArray type="{kind}" Name="{}""#, escaped(self.name))?;
        if let Some(components) = self.components {
            write!(output, r#" NumberOfComponents="{components}""#)?;
        }
        match encoding {
            VtkEncoding::Appended => {
                writeln!(output, r#" format="appended" offset="{offset}"/>"#)?;
                *offset += size_of::<u64>() as u64 + self.length();
                return Ok(());
            }
            VtkEncoding::Base64 => {
                writeln!(output, r#" format="binary">"#)?;
                let mut base64 = Base64::new(output);
                self.each_bytes(&mut |bytes| base64.push(bytes))?;
                base64.finish()?;
                writeln!(output)?;
            }
            VtkEncoding::Ascii => {
                writeln!(output, r#" format="ascii">"#)?;
                with_numbers!(&self.numbers, row => write_text(output, row, self.places))?;
            }
        }
        writeln!(output, "        </DataArray>")
    }

    /// Writes its length and its numbers.
    pub(super) fn write_raw(&self, output: &mut impl Write) -> io::Result<()> {
        self.each_bytes(&mut |bytes| output.write_all(bytes))
    }

    /// The length in bytes that stands before a binary block, and its numbers, piece by piece.
    fn each_bytes(&self, sink: &mut dyn FnMut(&[u8]) -> io::Result<()>) -> io::Result<()> {
        sink(&self.length().to_le_bytes())?;
        with_numbers!(&self.numbers, row => each_bytes(row, self.places, sink))
    }
}

fn size<T: Number>(_: &Row<'_, T>) -> usize {
    T::SIZE
}

/// The numbers of all places, some at a time.
fn each_piece<T>(
    row: &Row<'_, T>,
    places: usize,
    mut sink: impl FnMut(&[T]) -> io::Result<()>,
) -> io::Result<()> {
    let mut numbers = Vec::new();
    for place in 0..places {
        row(place, &mut numbers);
        if numbers.len() >= GATHERED {
            sink(&numbers)?;
            numbers.clear();
        }
    }
    sink(&numbers)
}

fn each_bytes<T: Number>(
    row: &Row<'_, T>,
    places: usize,
    sink: &mut dyn FnMut(&[u8]) -> io::Result<()>,
) -> io::Result<()> {
    let mut bytes = Vec::new();
    each_piece(row, places, |numbers| {
        bytes.clear();
        numbers.iter().for_each(|number| number.bytes(&mut bytes));
        sink(&bytes)
    })
}

fn write_text<T: Number>(output: &mut impl Write, row: &Row<'_, T>, places: usize) -> io::Result<()> {
    let mut on_line = 0;
    each_piece(row, places, |numbers| {
        for number in numbers {
            if on_line == NUMBERS_A_LINE {
                writeln!(output)?;
                on_line = 0;
            }
            write!(output, "{}{}", if on_line > 0 { " " } else { "" }, number.text())?;
            on_line += 1;
        }
        Ok(())
    })?;
    if on_line > 0 { writeln!(output) } else { Ok(()) }
}
