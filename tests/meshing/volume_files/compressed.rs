//! VTU files with arrays compressed by zlib.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;
use welter_meshing::DVec3;
use welter_meshing::io::{DataField, Limits, ReadError, VolumeData, read_vtu};

/// Files that another implementation of zlib made: in blocks of 32 bytes, appended; in one block each, as base64.
const STORED: [&[u8]; 2] = [
    include_bytes!("../../kit/corpus/read_vtu_volume/vtk_zlib_appended"),
    include_bytes!("../../kit/corpus/read_vtu_volume/vtk_zlib_binary"),
];

fn read(file: &[u8]) -> Result<VolumeData, ReadError> {
    read_vtu(file, &Limits::default()).map(|(mesh, _)| mesh)
}

/// Bytes compressed in blocks, behind their header.
fn blocks(bytes: &[u8], size: usize, wide: bool, compression: Compression) -> Vec<u8> {
    let compressed: Vec<Vec<u8>> = bytes
        .chunks(size)
        .map(|block| {
            let mut encoder = ZlibEncoder::new(Vec::new(), compression);
            encoder.write_all(block).unwrap();
            encoder.finish().unwrap()
        })
        .collect();
    let sizes = compressed.iter().map(Vec::len);
    let mut out = Vec::new();
    for number in [compressed.len(), size, bytes.len() % size].into_iter().chain(sizes) {
        out.extend_from_slice(&(number as u64).to_le_bytes()[..if wide { 8 } else { 4 }]);
    }
    [out, compressed.concat()].concat()
}

/// A file of points alone, appended.
fn points_file(points: u64, appended: &[u8], wide: bool) -> Vec<u8> {
    let width = if wide { 64 } else { 32 };
    let mut file = format!(
        "<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt{width}\" compressor=\"vtkZLibDataCompressor\">\
         <UnstructuredGrid><Piece NumberOfPoints=\"{points}\" NumberOfCells=\"0\"><Points>\
         <DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></Points><Cells>\
         <DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\"/>\
         <DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\"/>\
         <DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\"/></Cells></Piece></UnstructuredGrid>\
         <AppendedData encoding=\"raw\">_"
    )
    .into_bytes();
    file.extend_from_slice(appended);
    file.extend_from_slice(b"</AppendedData></VTKFile>");
    file
}

fn bytes_of(positions: &[DVec3]) -> Vec<u8> {
    positions.iter().flat_map(|p| p.to_array()).flat_map(f64::to_le_bytes).collect()
}

#[test]
fn files_of_another_writer_are_read() {
    let position = |[x, y]: [f64; 2]| DVec3::new(x, y, 0.0);
    let expected = VolumeData {
        positions: [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.5]].map(position).to_vec(),
        quadrilaterals: vec![[0, 1, 2, 3]],
        triangles: vec![[1, 4, 2]],
        cell_fields: vec![DataField::new("tag", 1, vec![1_i32, -7])],
        ..VolumeData::default()
    };
    for file in STORED {
        assert_eq!(read(file).unwrap(), expected);
    }
}

#[test]
fn blocks_of_any_size_are_read() {
    let positions: Vec<DVec3> = (0..5000).map(|k| DVec3::new(f64::from(k), f64::from(k % 7), 0.5)).collect();
    let bytes = bytes_of(&positions);
    // Sizes that divide numbers, that divide the whole, and one beyond it.
    for size in [1000, 1001, 32768, bytes.len(), 1 << 20] {
        for (wide, level) in [(false, 0), (true, 1), (false, 9)] {
            let file = points_file(5000, &blocks(&bytes, size, wide, Compression::new(level)), wide);
            assert_eq!(read(&file).unwrap().positions, positions, "{size}, level {level}");
        }
    }
}

#[test]
fn what_is_cut_off_or_damaged_is_an_error() {
    for file in STORED {
        for end in 0..file.len() - 1 {
            assert!(read(&file[..end]).is_err(), "cut off at {end}");
        }
    }
    // Each bit of the compressed data and its checksum; headers with others are of other sizes.
    let positions: Vec<DVec3> = (0..20).map(|k| DVec3::splat(f64::from(k))).collect();
    let whole = blocks(&bytes_of(&positions), 100, false, Compression::best());
    assert_eq!(read(&points_file(20, &whole, false)).unwrap().positions, positions);
    for at in 0..whole.len() {
        for bit in 0..8 {
            let mut damaged = whole.clone();
            damaged[at] ^= 1 << bit;
            // Some bits mean nothing, as those that pad the last block.
            if let Ok(mesh) = read(&points_file(20, &damaged, false)) {
                assert_eq!(mesh.positions, positions, "byte {at}, bit {bit}");
            }
        }
    }
}

#[test]
fn headers_that_do_not_fit_are_named() {
    let bytes = bytes_of(&[DVec3::ONE; 10]);
    let header = |numbers: &[u32]| -> Vec<u8> { numbers.iter().flat_map(|n| n.to_le_bytes()).collect() };
    let said = |appended: &[u8]| read(&points_file(10, appended, false)).unwrap_err().to_string();
    for (numbers, expected) in [
        (&[1, 239, 0, 9][..], "expected 30 numbers of 8 bytes, found 239 bytes"),
        (&[0, 240, 0], "expected 30 numbers of 8 bytes, found 0 bytes"),
        (&[1, 0, 0, 9], "expected sizes of compressed blocks, found 1 blocks of 0 bytes, the last of 0"),
        (
            &[2, 120, 120, 9, 9],
            "expected sizes of compressed blocks, found 2 blocks of 120 bytes, the last of 120",
        ),
        (&[u32::MAX, u32::MAX, 0, 9], "expected 30 numbers of 8 bytes, found 18446744065119617025 bytes"),
        (&[1, 240, 0, 0], "expected a compressed block, found `one of no bytes`"),
    ] {
        let message = said(&header(numbers));
        assert!(message.ends_with(expected), "{message}");
    }
    let whole = blocks(&bytes, 240, false, Compression::default());
    let length = u32::try_from(whole.len() - 16).unwrap();
    let with = |size: u32, length: u32| [&header(&[1, size, 0, length])[..], &whole[16..], &[0; 9]].concat();
    for (appended, expected) in [
        (with(240, length + 1), "found one that ends before its size"),
        (with(240, length - 1), "found one that goes on beyond its size, or is too short"),
    ] {
        assert!(said(&appended).ends_with(expected), "{}", said(&appended));
    }
    // Blocks of another size than is said.
    for (size, expected) in [
        (230, "found one that goes on beyond its size, or is too short"),
        (250, "found one of more bytes than its header says"),
    ] {
        let other = blocks(&bytes_of(&[DVec3::ONE; 11])[..size], size, false, Compression::default());
        let length = u32::try_from(other.len() - 16).unwrap();
        let bytes = [&header(&[1, 240, 0, length])[..], &other[16..]].concat();
        assert!(said(&bytes).ends_with(expected), "{size}: {}", said(&bytes));
    }
}
