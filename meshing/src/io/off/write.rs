//! Writes OFF: positions in shortest decimals, colours as bytes after each face.

use super::super::text::Decimal;
use super::super::{Dropped, SurfaceData, WriteError, WriteReport};
use std::io::Write;

pub(in super::super) fn write<S: SurfaceData + ?Sized>(
    output: &mut impl Write,
    surface: &S,
) -> Result<WriteReport, WriteError> {
    writeln!(output, "OFF\n{} {} 0", surface.positions().len(), surface.triangle_count())?;
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
    let mut dropped = Vec::new();
    let count = surface.groups().len();
    if count > 0 {
        dropped.push(Dropped::Groups { count });
    }
    Ok(WriteReport { dropped })
}
