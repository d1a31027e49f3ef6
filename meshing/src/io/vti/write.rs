//! Writes VTI: the XML, and the numbers in or after it.

use std::io::{self, Write};

use super::DataArray;
use crate::grid::Grid3;
use crate::io::text::Decimal;
use crate::io::vtk::{self, Array, Numbers, VtkEncoding};

pub(super) fn write(
    output: &mut impl Write,
    grid: &Grid3,
    point_arrays: &[DataArray<'_>],
    cell_arrays: &[DataArray<'_>],
    encoding: VtkEncoding,
) -> io::Result<()> {
    let extent = grid.cells().map(|n| format!("0 {n}")).join(" ");
    let origin = grid.origin().map(|c| Decimal(c).to_string()).join(" ");
    let spacing = [grid.spacing(); 3].map(|h| Decimal(h).to_string()).join(" ");
    vtk::begin(output, "ImageData")?;
    writeln!(output, r#"  <ImageData WholeExtent="{extent}" Origin="{origin}" Spacing="{spacing}">"#)?;
    writeln!(output, r#"    <Piece Extent="{extent}">"#)?;
    let [points, cells] =
        [point_arrays, cell_arrays].map(|arrays| arrays.iter().map(array).collect::<Vec<_>>());
    let mut offset = 0;
    vtk::write_data(output, "PointData", &points, encoding, &mut offset)?;
    vtk::write_data(output, "CellData", &cells, encoding, &mut offset)?;
    writeln!(output, "    </Piece>\n  </ImageData>")?;
    vtk::end(output, encoding, points.iter().chain(&cells))
}

/// An array as VTK files hold it.
pub(in crate::io) fn array<'a>(array: &DataArray<'a>) -> Array<'a> {
    let DataArray { name, values, components } = *array;
    let row = move |place: usize, numbers: &mut Vec<f64>| {
        numbers.extend_from_slice(&values[place * components..][..components]);
    };
    Array::new(name, components, values.len() / components, Numbers::Float64(Box::new(row)))
}
