//! Writes VTI: the XML, and the numbers in or after it.

use std::io::{self, Write};

use super::base64::Base64;
use super::{DataArray, VtiEncoding};
use crate::grid::Grid3;
use crate::io::text::Decimal;

/// Numbers of text a line: what is still easy to look at.
const NUMBERS_A_LINE: usize = 12;

pub(super) fn write(
    output: &mut impl Write,
    grid: &Grid3,
    point_arrays: &[DataArray<'_>],
    cell_arrays: &[DataArray<'_>],
    encoding: VtiEncoding,
) -> io::Result<()> {
    let extent = grid.cells().map(|n| format!("0 {n}")).join(" ");
    let origin = grid.origin().map(|c| Decimal(c).to_string()).join(" ");
    let spacing = [grid.spacing(); 3].map(|h| Decimal(h).to_string()).join(" ");
    writeln!(output, r#"<?xml version="1.0"?>"#)?;
    writeln!(
        output,
        r#"<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#
    )?;
    writeln!(output, r#"  <ImageData WholeExtent="{extent}" Origin="{origin}" Spacing="{spacing}">"#)?;
    writeln!(output, r#"    <Piece Extent="{extent}">"#)?;
    let mut offset = 0;
    for (element, arrays) in [("PointData", point_arrays), ("CellData", cell_arrays)] {
        let shown = arrays.iter().find(|array| array.components == 1);
        let shown = shown.map_or(String::new(), |array| format!(r#" Scalars="{}""#, escaped(array.name)));
        writeln!(output, "      <{element}{shown}>")?;
        for array in arrays {
            write_array(output, array, encoding, &mut offset)?;
        }
        writeln!(output, "      </{element}>")?;
    }
    writeln!(output, "    </Piece>\n  </ImageData>")?;
    if encoding == VtiEncoding::Appended {
        write!(output, "  <AppendedData encoding=\"raw\">\n_")?;
        for array in point_arrays.iter().chain(cell_arrays) {
            output.write_all(&header(array))?;
            for value in array.values {
                output.write_all(&value.to_le_bytes())?;
            }
        }
        writeln!(output, "\n  </AppendedData>")?;
    }
    writeln!(output, "</VTKFile>")
}

/// The element of an array, with its numbers unless they are appended; `offset` moves on by their bytes.
fn write_array(
    output: &mut impl Write,
    array: &DataArray<'_>,
    encoding: VtiEncoding,
    offset: &mut u64,
) -> io::Result<()> {
    let (name, components) = (escaped(array.name), array.components);
    write!(
        output,
        r#"        <DataArray type="Float64" Name="{name}" NumberOfComponents="{components}" format="#
    )?;
    match encoding {
        VtiEncoding::Appended => {
            writeln!(output, r#""appended" offset="{offset}"/>"#)?;
            *offset += (size_of::<u64>() + size_of_val(array.values)) as u64;
            return Ok(());
        }
        VtiEncoding::Base64 => {
            writeln!(output, r#""binary">"#)?;
            let mut base64 = Base64::new(output);
            base64.push(&header(array))?;
            for value in array.values {
                base64.push(&value.to_le_bytes())?;
            }
            base64.finish()?;
            writeln!(output)?;
        }
        VtiEncoding::Ascii => {
            writeln!(output, r#""ascii">"#)?;
            for line in array.values.chunks(NUMBERS_A_LINE) {
                for (k, &value) in line.iter().enumerate() {
                    write!(output, "{}{}", if k > 0 { " " } else { "" }, Decimal(value))?;
                }
                writeln!(output)?;
            }
        }
    }
    writeln!(output, "        </DataArray>")
}

/// The length in bytes that stands before a binary block.
fn header(array: &DataArray<'_>) -> [u8; 8] {
    (size_of_val(array.values) as u64).to_le_bytes()
}

/// A name as the value of an attribute.
fn escaped(name: &str) -> String {
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
