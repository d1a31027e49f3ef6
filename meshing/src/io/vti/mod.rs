//! VTK image data (`.vti`) \[Schroeder06\]: numbers on a regular grid, as ParaView and VTK read them: [`write_vti`].
//!
//! # What it promises
//! * Every `f64` comes back bit for bit in the binary encodings, and as the same number in text (NaN without its payload).
//! * The extent, origin and spacing are those of the grid; x runs fastest, as in [`Samples`](crate::grid::Samples).
//! * The same bytes for the same data. Nothing is written before names and lengths are checked.
//!
//! # What it does not promise
//! * Reading: these files go to other programs. Compression: blocks would need a library of their own.
//! * That VTK understands negative infinity in text: version 9.7 takes it for positive infinity, so samples with infinities need one
//!   of the binary encodings.
//!
//! # Method
//! An XML element `ImageData` with one `Piece`; the arrays are those of `vtk`.

mod write;

pub(super) use write::array;

use std::io::Write;

use super::WriteError;
use super::data_field::check_name;
use super::vtk::VtkEncoding;
use crate::grid::Grid3;

/// A named array: one number, or a vector, for each node or vertex, or for each cell or triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DataArray<'a> {
    /// Its name, not empty and without control characters, other than those of the arrays beside it.
    pub name: &'a str,
    /// The numbers, x fastest, the components of a vector next to each other.
    pub values: &'a [f64],
    /// Numbers of each place: 1 for scalars, 3 for vectors.
    pub components: usize,
}

impl<'a> DataArray<'a> {
    /// An array of scalars.
    #[must_use]
    pub const fn scalars(name: &'a str, values: &'a [f64]) -> Self {
        Self { name, values, components: 1 }
    }
}

/// Writes arrays on a grid as a VTI file. The first point array is the one that programs show at first.
///
/// `output` gets many small writes: wrap a file in a `BufWriter`.
///
/// # Errors
/// [`WriteError::ArrayLength`], [`WriteError::ArrayName`], or the writer failed.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, grid::{Grid3, Samples}, io::{DataArray, VtkEncoding, write_vti}};
/// let grid = Grid3::new([0.0; 3], 0.5, [2, 1, 1])?;
/// let samples = Samples::of(&grid, &|p: DVec3| p.x - 0.25, &Monitor::none())?;
/// let mut file = Vec::new();
/// let array = DataArray::scalars("distance", samples.values());
/// write_vti(&mut file, &grid, &[array], &[], VtkEncoding::Ascii)?;
/// let text = String::from_utf8(file)?;
/// assert!(text.contains(r#"<ImageData WholeExtent="0 2 0 1 0 1" Origin="0 0 0" Spacing="0.5 0.5 0.5">"#));
/// assert!(text.contains("-0.25 0.25 0.75"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_vti(
    mut output: impl Write,
    grid: &Grid3,
    point_arrays: &[DataArray<'_>],
    cell_arrays: &[DataArray<'_>],
    encoding: VtkEncoding,
) -> Result<(), WriteError> {
    check_all(point_arrays, grid.node_count())?;
    check_all(cell_arrays, grid.cell_count())?;
    write::write(&mut output, grid, point_arrays, cell_arrays, encoding)?;
    output.flush()?;
    Ok(())
}

/// Names that differ, and as many numbers as there are places for.
pub(super) fn check_all(arrays: &[DataArray<'_>], places: usize) -> Result<(), WriteError> {
    for (k, array) in arrays.iter().enumerate() {
        check(array, places)?;
        if arrays[..k].iter().any(|before| before.name == array.name) {
            return Err(WriteError::ArrayName { name: array.name.to_owned(), why: "is given twice" });
        }
    }
    Ok(())
}

fn check(array: &DataArray<'_>, places: usize) -> Result<(), WriteError> {
    check_name(array.name)?;
    let wanted = places.checked_mul(array.components).filter(|&n| n > 0);
    if wanted != Some(array.values.len()) {
        let (values, components) = (array.values.len(), array.components);
        let name = array.name.to_owned();
        return Err(WriteError::ArrayLength { name, values, components, places });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_that_do_not_fit_are_refused_before_the_first_byte() {
        let grid = Grid3::new([0.0; 3], 1.0, [1, 1, 1]).unwrap();
        let write = |name: &str, values: usize, components: usize| {
            let (numbers, mut file) = (vec![0.0; values], Vec::new());
            let array = DataArray { name, values: &numbers, components };
            let result = write_vti(&mut file, &grid, &[array], &[], VtkEncoding::Appended);
            assert_eq!(result.is_err(), file.is_empty());
            result.map_err(|error| error.to_string())
        };
        assert!(write("a", 8, 1).is_ok() && write("v", 24, 3).is_ok());
        assert_eq!(
            write("a", 7, 1).unwrap_err(),
            "array \"a\" has 7 numbers, 1 for each of 8 places are needed"
        );
        assert!(write("a", 0, 0).is_err() && write("a", 8, usize::MAX).is_err());
        assert_eq!(write("", 8, 1).unwrap_err(), "the array name \"\" is empty");
        assert_eq!(write("a\n", 8, 1).unwrap_err(), "the array name \"a\\n\" has a control character");
        let one = [0.0; 8];
        let twice = [DataArray::scalars("a", &one); 2];
        assert!(write_vti(Vec::new(), &grid, &twice, &[], VtkEncoding::Ascii).is_err());
    }
}
