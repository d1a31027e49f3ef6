//! Writes PLY: positions as `double`, triangles as `list uchar int`, colours as bytes a face.

use super::super::text::Decimal;
use super::super::{Dropped, Encoding, SurfaceData, WriteError, WriteReport};
use std::io::Write;

pub(in super::super) fn write<S: SurfaceData + ?Sized>(
    output: &mut impl Write,
    surface: &S,
    encoding: Encoding,
) -> Result<WriteReport, WriteError> {
    let colors = surface.triangle_colors();
    let vertices = surface.positions().len();
    let format = match encoding {
        Encoding::Ascii => "ascii",
        Encoding::Binary => "binary_little_endian",
    };
    // `int` is what every reader takes; `uint` only where it has to be.
    let index = if vertices <= i32::MAX as usize { "int" } else { "uint" };
    writeln!(output, "ply\nformat {format} 1.0\ncomment written by welter\nelement vertex {vertices}")?;
    writeln!(output, "property double x\nproperty double y\nproperty double z")?;
    writeln!(
        output,
        "element face {}\nproperty list uchar {index} vertex_indices",
        surface.triangle_count()
    )?;
    if !colors.is_empty() {
        writeln!(output, "property uchar red\nproperty uchar green\nproperty uchar blue")?;
    }
    writeln!(output, "end_header")?;
    match encoding {
        Encoding::Ascii => write_ascii(output, surface)?,
        Encoding::Binary => write_binary(output, surface)?,
    }
    let mut dropped = Vec::new();
    let count = surface.groups().len();
    if count > 0 {
        dropped.push(Dropped::Groups { count });
    }
    Ok(WriteReport { dropped })
}

fn write_ascii<S: SurfaceData + ?Sized>(output: &mut impl Write, surface: &S) -> Result<(), WriteError> {
    for p in surface.positions() {
        writeln!(output, "{} {} {}", Decimal(p.x), Decimal(p.y), Decimal(p.z))?;
    }
    for k in 0..surface.triangle_count() {
        let [a, b, c] = surface.triangle(k);
        match surface.triangle_colors().get(k) {
            None => writeln!(output, "3 {a} {b} {c}")?,
            Some([red, green, blue]) => writeln!(output, "3 {a} {b} {c} {red} {green} {blue}")?,
        }
    }
    Ok(())
}

fn write_binary<S: SurfaceData + ?Sized>(output: &mut impl Write, surface: &S) -> Result<(), WriteError> {
    for p in surface.positions() {
        let mut bytes = [0; 24];
        for (k, coordinate) in p.to_array().into_iter().enumerate() {
            bytes[8 * k..8 * k + 8].copy_from_slice(&coordinate.to_le_bytes());
        }
        output.write_all(&bytes)?;
    }
    for k in 0..surface.triangle_count() {
        let mut bytes = [3; 16];
        for (corner, index) in surface.triangle(k).into_iter().enumerate() {
            bytes[1 + 4 * corner..5 + 4 * corner].copy_from_slice(&index.to_le_bytes());
        }
        let length = match surface.triangle_colors().get(k) {
            None => 13,
            Some(color) => {
                bytes[13..].copy_from_slice(color);
                16
            }
        };
        output.write_all(&bytes[..length])?;
    }
    Ok(())
}
