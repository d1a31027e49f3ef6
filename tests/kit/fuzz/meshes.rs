//! Readers of mesh files on any bytes, and the list of self-intersections of small meshes.

use super::trickle::Trickle;
use crate::entropy::Entropy;
use crate::exact;
use crate::generate::Kind;
use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::io::{self, Encoding, Format, Limits, WriteOptions};
use welter_meshing::spatial::self_intersections;
use welter_meshing::surface::{TriMesh, TriangleSoup};
use welter_meshing::volumetric::plane::ClosedPolylines;

/// The OBJ reader, also of lines, which are joined to curves where that is possible.
pub fn read_obj(bytes: &[u8]) {
    read(Format::Obj, bytes);
    let Ok((found, _)) = io::read_obj_polylines(bytes, &Limits::default()) else { return };
    let segments = |lines: &[Vec<u32>]| lines.iter().map(|line| line.len() - 1).sum::<usize>();
    assert!(found.lines.iter().all(|line| line.len() > 1) && segments(&found.lines) <= bytes.len());
    if let Ok(curves) = ClosedPolylines::joined(&found.positions, &found.lines) {
        // Each segment of a line is one of the curves.
        assert_eq!(curves.len(), segments(&found.lines), "{found:?}");
        let mut pairs: Vec<[u32; 2]> =
            found.lines.iter().flat_map(|line| line.windows(2).map(|pair| [pair[0], pair[1]])).collect();
        let around = |corners: &Vec<u32>| {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(&a, &b)| [a, b]).collect::<Vec<_>>()
        };
        let mut joined: Vec<[u32; 2]> = curves.loops().iter().flat_map(around).collect();
        pairs.sort_unstable();
        joined.sort_unstable();
        assert_eq!(pairs, joined);
    }
}

/// The PLY reader, text and binary.
pub fn read_ply(bytes: &[u8]) {
    read(Format::Ply, bytes);
}

/// The STL reader, text and binary.
pub fn read_stl(bytes: &[u8]) {
    read(Format::Stl, bytes);
}

/// The OFF reader.
pub fn read_off(bytes: &[u8]) {
    read(Format::Off, bytes);
}

/// Reads any bytes: no panic, nothing larger than the file can hold, the same however the bytes arrive, and what was read
/// can be written and read again.
fn read(format: Format, bytes: &[u8]) {
    let whole = io::read(format, bytes, &Limits::default());
    let (trickled, pieces) = (
        Trickle { rest: bytes, step: 1 },
        io::read(format, Trickle { rest: bytes, step: 7 }, &Limits::default()),
    );
    let single = io::read(format, trickled, &Limits::default());
    for other in [single, pieces] {
        match (&whole, &other) {
            (Ok(soup), Ok(again)) => assert!(same(soup, again), "{soup:?} {again:?}"),
            (Err(error), Err(again)) => assert_eq!(error.to_string(), again.to_string()),
            _ => panic!("whole: {whole:?}, in pieces: {other:?}"),
        }
    }
    let Ok(soup) = whole else { return };
    assert!(
        soup.positions.len() <= bytes.len() && soup.triangles.len() <= bytes.len(),
        "more than the file holds"
    );
    assert!(soup.triangle_colors.is_empty() || soup.triangle_colors.len() == soup.triangles.len());
    for encoding in [Encoding::Ascii, Encoding::Binary] {
        let mut file = Vec::new();
        let Ok(report) = io::write(format, &mut file, &soup, &WriteOptions { encoding }) else { continue };
        let again = io::read(format, &file[..], &Limits::default());
        match again {
            Ok(again) if report.dropped.is_empty() => assert!(same(&soup, &again), "{soup:?} {again:?}"),
            Ok(again) => assert_eq!(soup.triangles.len(), again.triangles.len()),
            Err(error) => panic!("what was written as {encoding:?} cannot be read: {error}: {soup:?}"),
        }
    }
}

/// Equal bit for bit, so that NaN equals itself.
fn same(a: &TriangleSoup, b: &TriangleSoup) -> bool {
    let bits = |soup: &TriangleSoup| -> Vec<[u64; 3]> {
        soup.positions.iter().map(|p| p.to_array().map(f64::to_bits)).collect()
    };
    bits(a) == bits(b)
        && (&a.triangles, &a.groups, &a.triangle_colors) == (&b.triangles, &b.groups, &b.triangle_colors)
}

/// The list of self-intersections of a small mesh drawn from the bytes, against trying all pairs exactly.
pub fn self_intersecting(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    let (kind, positions) = Kind::draw_any::<3, 9>(&mut entropy);
    let count = entropy.below(8) + 1;
    let triangles: Vec<[u32; 3]> = (0..count)
        .map(|_| {
            let first = entropy.below(9);
            let second = (first + 1 + entropy.below(8)) % 9;
            let third = (0..9).map(|i| (second + i) % 9).filter(|&v| v != first && v != second);
            let third: Vec<u8> = third.collect();
            [first, second, entropy.pick(&third)].map(u32::from)
        })
        .collect();
    let soup = TriangleSoup {
        positions: positions.map(DVec3::from_array).to_vec(),
        triangles: triangles.clone(),
        ..TriangleSoup::default()
    };
    let mesh = TriMesh::new(soup).expect("finite positions and distinct indices");
    let found = self_intersections(&mesh, &Monitor::none()).expect("nobody cancels");
    let found: Vec<[u32; 2]> = found.into_iter().map(|pair| pair.map(|t| t.0)).collect();
    let expected = exact::self_intersections(&positions, &triangles);
    assert_eq!(found, expected, "{kind:?} {positions:?} {triangles:?}");
}
