//! What the XML files of VTK \[Schroeder06\] have in common: arrays of numbers in three encodings, and names as attributes.
//!
//! Binary blocks are little-endian, after their length in bytes as a 64-bit number; they stand in base64 in their element, or raw after the
//! underscore of `AppendedData`, which is shorter by a quarter but no strict XML.

mod array;
mod base64;

pub(super) use array::{Array, Numbers, Row};
pub(super) use base64::Decoder;

use std::io::{self, Write};

/// How the numbers of a VTK file are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum VtkEncoding {
    /// Raw bytes behind the XML: the shortest, and quickest to read.
    #[default]
    Appended,
    /// Base64 in the XML.
    Base64,
    /// Shortest decimals that give the same `f64` back.
    Ascii,
}

/// Begins a file of a type of data.
pub(super) fn begin(output: &mut impl Write, data: &str) -> io::Result<()> {
    writeln!(output, r#"<?xml version="1.0"?>"#)?;
    writeln!(
        output,
        r#"<VTKFile type="{data}" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#
    )
}

/// Ends a file: the numbers of its arrays if they are appended, in the order in which their elements were written.
pub(super) fn end<'a>(
    output: &mut impl Write,
    encoding: VtkEncoding,
    arrays: impl IntoIterator<Item = &'a Array<'a>>,
) -> io::Result<()> {
    if encoding == VtkEncoding::Appended {
        write!(output, "  <AppendedData encoding=\"raw\">\n_")?;
        for array in arrays {
            array.write_raw(output)?;
        }
        writeln!(output, "\n  </AppendedData>")?;
    }
    writeln!(output, "</VTKFile>")
}

/// Writes the element that holds the arrays of points or of cells. The first array of scalars is the one that programs show at first.
pub(super) fn write_data(
    output: &mut impl Write,
    element: &str,
    arrays: &[Array<'_>],
    encoding: VtkEncoding,
    offset: &mut u64,
) -> io::Result<()> {
    let shown = arrays.iter().find(|array| array.components == Some(1));
    let shown = shown.map_or(String::new(), |array| format!(r#" Scalars="{}""#, escaped(array.name)));
    writeln!(output, "      <{element}{shown}>")?;
    for array in arrays {
        array.write_element(output, encoding, offset)?;
    }
    writeln!(output, "      </{element}>")
}

/// A name as the value of an attribute.
pub(super) fn escaped(name: &str) -> String {
    let mut text = String::with_capacity(name.len());
    for c in name.chars() {
        match c {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            other => text.push(other),
        }
    }
    text
}
