//! Writes OBJ: positions in shortest decimals, groups as `g`.

use super::super::text::{Decimal, lost_names, one_line};
use super::super::view::runs;
use super::super::{Dropped, SurfaceData, WriteError, WriteReport};
use std::io::Write;

pub(in super::super) fn write<S: SurfaceData + ?Sized>(
    output: &mut impl Write,
    surface: &S,
) -> Result<WriteReport, WriteError> {
    if surface.positions().is_empty() {
        // An empty file would be refused as such when read.
        writeln!(output, "# no vertices")?;
    }
    for p in surface.positions() {
        writeln!(output, "v {} {} {}", Decimal(p.x), Decimal(p.y), Decimal(p.z))?;
    }
    let mut grouped = false;
    for (name, run) in runs(surface) {
        let name = one_line(name);
        if !name.is_empty() {
            writeln!(output, "g {name}")?;
        } else if grouped {
            writeln!(output, "g")?;
        }
        grouped = !name.is_empty();
        for [a, b, c] in run.map(|k| surface.triangle(k).map(|i| u64::from(i) + 1)) {
            writeln!(output, "f {a} {b} {c}")?;
        }
    }
    let mut dropped = lost_names(surface.groups());
    let count = surface.triangle_colors().len();
    if count > 0 {
        dropped.push(Dropped::TriangleColors { count });
    }
    Ok(WriteReport { dropped })
}
