//! VTK surfaces (`.vtp`) \[Schroeder06\]: triangles with numbers at their vertices and on them, as ParaView and VTK read them: [`write_vtp`].
//!
//! # What it promises
//! * Vertices and triangles in their order; every `f64` comes back bit for bit in the binary encodings, and as the same number in text.
//! * The same bytes for the same data. Nothing is written before indices, names and lengths are checked.
//!
//! # What it does not promise
//! Reading: these files go to other programs. Groups and colours of a surface, and compression, are not written.
//!
//! # Method
//! An XML element `PolyData` with one `Piece`; the arrays are those of `vtk`.

use std::io::{self, Write};

use super::view::{self, SurfaceData};
use super::vti::{array, check_all};
use super::vtk::{self, Array, Numbers, VtkEncoding};
use super::{DataArray, WriteError};

/// Writes a surface with arrays at its vertices and on its triangles as a VTP file. The first array of scalars is the one that programs show
/// at first.
///
/// `output` gets many small writes: wrap a file in a `BufWriter`.
///
/// # Errors
/// [`WriteError`]: indices do not fit the surface, arrays do not fit it, or the writer failed.
///
/// ```
/// use welter_meshing::{DVec3, io::{DataArray, VtkEncoding, write_vtp}, surface::TriangleSoup};
/// let soup = TriangleSoup {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y * 0.1],
///     triangles: vec![[0, 1, 2]],
///     ..TriangleSoup::default()
/// };
/// let mut file = Vec::new();
/// let heights = [0.0, 0.5, 0.25];
/// write_vtp(&mut file, &soup, &[DataArray::scalars("height", &heights)], &[], VtkEncoding::Ascii)?;
/// let text = String::from_utf8(file)?;
/// assert!(text.contains("0 0.5 0.25") && text.contains(r#"NumberOfPolys="1""#));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_vtp<S: SurfaceData + ?Sized>(
    mut output: impl Write,
    surface: &S,
    point_arrays: &[DataArray<'_>],
    triangle_arrays: &[DataArray<'_>],
    encoding: VtkEncoding,
) -> Result<(), WriteError> {
    view::check(surface)?;
    check_all(point_arrays, surface.positions().len())?;
    check_all(triangle_arrays, surface.triangle_count())?;
    write(&mut output, surface, point_arrays, triangle_arrays, encoding)?;
    output.flush()?;
    Ok(())
}

fn write<S: SurfaceData + ?Sized>(
    output: &mut impl Write,
    surface: &S,
    point_arrays: &[DataArray<'_>],
    triangle_arrays: &[DataArray<'_>],
    encoding: VtkEncoding,
) -> io::Result<()> {
    let (vertices, triangles) = (surface.positions().len(), surface.triangle_count());
    vtk::begin(output, "PolyData")?;
    writeln!(output, "  <PolyData>")?;
    writeln!(
        output,
        r#"    <Piece NumberOfPoints="{vertices}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{triangles}">"#
    )?;
    let [at_points, on_triangles] =
        [point_arrays, triangle_arrays].map(|arrays| arrays.iter().map(array).collect::<Vec<_>>());
    let position = |v: usize, numbers: &mut Vec<f64>| {
        numbers.extend_from_slice(&surface.positions()[v].to_array());
    };
    let corners = |t: usize, numbers: &mut Vec<i64>| numbers.extend(surface.triangle(t).map(i64::from));
    let end = |t: usize, numbers: &mut Vec<i64>| numbers.push(3 * (t as i64 + 1));
    let points = [Array::new("Points", 3, vertices, Numbers::Float64(Box::new(position)))];
    // Without a number of components: programs take lists, not vectors.
    let list = |name, count: usize, numbers| Array {
        name,
        components: None,
        places: triangles,
        count: (count * triangles) as u64,
        numbers,
    };
    let polygons = [
        list("connectivity", 3, Numbers::Int64(Box::new(corners))),
        list("offsets", 1, Numbers::Int64(Box::new(end))),
    ];
    let mut offset = 0;
    vtk::write_data(output, "PointData", &at_points, encoding, &mut offset)?;
    vtk::write_data(output, "CellData", &on_triangles, encoding, &mut offset)?;
    for (element, arrays) in [("Points", &points[..]), ("Polys", &polygons)] {
        writeln!(output, "      <{element}>")?;
        for array in arrays {
            array.write_element(output, encoding, &mut offset)?;
        }
        writeln!(output, "      </{element}>")?;
    }
    writeln!(output, "    </Piece>\n  </PolyData>")?;
    vtk::end(output, encoding, at_points.iter().chain(&on_triangles).chain(&points).chain(&polygons))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DVec3;
    use crate::surface::TriangleSoup;

    fn soup() -> TriangleSoup {
        TriangleSoup {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::new(0.1, 1.0, -0.0), DVec3::Z],
            triangles: vec![[0, 1, 2], [0, 3, 1]],
            ..TriangleSoup::default()
        }
    }

    #[test]
    fn appended_numbers_stand_at_their_offsets() {
        let mut file = Vec::new();
        let (heights, kinds) = ([1.0, 2.0, 3.0, 4.0], [7.0, 8.0]);
        let (points, triangles) = ([DataArray::scalars("h", &heights)], [DataArray::scalars("k", &kinds)]);
        write_vtp(&mut file, &soup(), &points, &triangles, VtkEncoding::Appended).unwrap();
        let text = String::from_utf8_lossy(&file).into_owned();
        let start = file.windows(2).position(|w| w == b"\n_").unwrap() + 2;
        let word = |at: usize| u64::from_le_bytes(file[start + at..][..8].try_into().unwrap());
        let offset = |name: &str| -> usize {
            let element = text.split("<DataArray").find(|e| e.contains(&format!("Name=\"{name}\""))).unwrap();
            element.split("offset=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
        };
        for (name, bytes) in [("h", 32), ("k", 16), ("Points", 96), ("connectivity", 48), ("offsets", 16)] {
            assert_eq!(word(offset(name)), bytes, "{name}");
        }
        assert_eq!(word(offset("Points") + 8 + 8 * 7), 1.0_f64.to_bits());
        assert_eq!(word(offset("Points") + 8 + 8 * 8), (-0.0_f64).to_bits());
        let corners: Vec<u64> = (1..=6).map(|k| word(offset("connectivity") + 8 * k)).collect();
        assert_eq!(corners, [0, 1, 2, 0, 3, 1]);
        assert_eq!((word(offset("offsets") + 8), word(offset("offsets") + 16)), (3, 6));
    }

    #[test]
    fn what_does_not_fit_is_refused_before_the_first_byte() {
        let mut wrong = soup();
        wrong.triangles.push([0, 1, 4]);
        let mut file = Vec::new();
        assert!(write_vtp(&mut file, &wrong, &[], &[], VtkEncoding::Ascii).is_err());
        let short = [1.0; 3];
        let array = [DataArray::scalars("h", &short)];
        assert!(write_vtp(&mut file, &soup(), &array, &[], VtkEncoding::Ascii).is_err());
        assert!(write_vtp(&mut file, &soup(), &[], &array, VtkEncoding::Ascii).is_err());
        assert!(file.is_empty());
    }
}
