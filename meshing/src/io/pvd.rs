//! Lists of VTK files over time (`.pvd`), as ParaView and VTK read them: [`write_pvd`].
//!
//! # What it promises
//! Files and times in the order given, every time as the shortest decimal that gives the same `f64` back; the same bytes for the same list.
//!
//! # What it does not promise
//! That the files exist, or that ParaView takes them: it takes VTK's own XML files (VTP, VTU, VTI) in such a list, and no others.

use std::io::Write;

use super::WriteError;
use super::text::Decimal;
use super::vtk::escaped;

/// A file and the time that it shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedFile<'a> {
    /// When.
    pub time: f64,
    /// The name of the file, relative to the list, with `/` between folders.
    pub file: &'a str,
}

/// Writes a list of files over time.
///
/// # Errors
/// [`WriteError::Time`] for a time that is not finite, or the writer failed.
///
/// ```
/// use welter_meshing::io::{TimedFile, write_pvd};
/// let files = [TimedFile { time: 0.0, file: "surface_0000.vtp" }, TimedFile { time: 0.1, file: "surface_0001.vtp" }];
/// let mut list = Vec::new();
/// write_pvd(&mut list, &files)?;
/// assert!(String::from_utf8(list)?.contains(r#"<DataSet timestep="0.1" part="0" file="surface_0001.vtp"/>"#));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_pvd(mut output: impl Write, files: &[TimedFile<'_>]) -> Result<(), WriteError> {
    if let Some(wrong) = files.iter().find(|file| !file.time.is_finite()) {
        return Err(WriteError::Time { file: wrong.file.to_owned(), time: wrong.time });
    }
    writeln!(output, r#"<?xml version="1.0"?>"#)?;
    writeln!(output, r#"<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">"#)?;
    writeln!(output, "  <Collection>")?;
    for TimedFile { time, file } in files {
        let (time, file) = (Decimal(*time), escaped(file));
        writeln!(output, r#"    <DataSet timestep="{time}" part="0" file="{file}"/>"#)?;
    }
    writeln!(output, "  </Collection>\n</VTKFile>")?;
    output.flush()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_that_are_none_are_refused_before_the_first_byte() {
        let mut list = Vec::new();
        let files = [TimedFile { time: 0.0, file: "a&b.vtp" }, TimedFile { time: f64::NAN, file: "b.vtp" }];
        assert!(matches!(write_pvd(&mut list, &files), Err(WriteError::Time { .. })));
        assert!(list.is_empty());
        write_pvd(&mut list, &files[..1]).unwrap();
        assert!(String::from_utf8(list).unwrap().contains("file=\"a&amp;b.vtp\""));
    }
}
