//! Malformed files, made by hand: each gives an error that says where, what was expected and what was found.

use super::{ASCII, BINARY, PAIRS, read, written};
use proptest::prelude::*;
use std::io::Read;
use welter_meshing::DVec3;
use welter_meshing::io::{self, Format, Limits, Place, ReadError, WriteError};
use welter_meshing::surface::{Group, TriangleSoup};

fn message(format: Format, file: impl AsRef<[u8]>) -> String {
    match read(format, file) {
        Ok(soup) => {
            format!("no error: {} vertices, {} triangles", soup.positions.len(), soup.triangles.len())
        }
        Err(error) => error.to_string(),
    }
}

/// Each file with its message.
fn check(format: Format, cases: &[(&str, &str)]) {
    for (file, expected) in cases {
        assert_eq!(message(format, file), *expected, "{format}: {file:?}");
    }
}

#[test]
fn obj_says_the_line() {
    const V: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let with_vertices = |rest: &str| format!("{V}{rest}");
    check(
        Format::Obj,
        &[
            ("", "the file is empty, expected OBJ text"),
            (" \n\t\r\n", "the file is empty, expected OBJ text"),
            ("# nothing\n\nv 0 zero 0\n", "line 3: expected the y coordinate of vertex 1, found `zero`"),
            ("v 0 0\n", "line 1: expected the z coordinate of vertex 1, found nothing"),
            ("v 1,5 0 0\n", "line 1: expected the x coordinate of vertex 1, found `1,5`"),
            ("v 0 0 0 2\n", "line 1: a vertex weight other than 1 (2) is not supported"),
            (
                "v 0 0 0 1 1\n",
                "line 1: expected a vertex of 3, 4 (weight), 6 or 7 (colour) numbers, found 5 numbers",
            ),
            ("v 0 0 0 1 1 red\n", "line 1: expected a number, found `red`"),
            ("vertex 0 0 0\n", "line 1: expected an OBJ statement such as `v`, `f` or `g`, found `vertex`"),
            ("v 0 0 0\rv 1 0 0\rv 0 x 0\r", "line 3: expected the y coordinate of vertex 3, found `x`"),
        ],
    );
    for (rest, expected) in [
        ("f 1 2 4\n", "line 4: vertex index 4 is out of range, the file has 3 vertices and counts from 1"),
        ("f 1 2 0\n", "line 4: vertex index 0 is out of range, the file has 3 vertices and counts from 1"),
        ("f 1 2 -4\n", "line 4: vertex index -4 is out of range, the file has 3 vertices and counts from 1"),
        (
            "f 1 2 99999999999\n",
            "line 4: vertex index 99999999999 is out of range, the file has 3 vertices and counts from 1",
        ),
        (
            "f 1 2 -9223372036854775808\n",
            "line 4: vertex index -9223372036854775808 is out of range, the file has 3 vertices and counts from 1",
        ),
        (
            "f 1 2 9223372036854775808\n",
            "line 4: expected a vertex index (v, v/vt, v//vn or v/vt/vn), found `9223372036854775808`",
        ),
        ("f 1 2\n", "line 4: expected a face of at least 3 vertices, found 2"),
        ("f\n", "line 4: expected a face of at least 3 vertices, found 0"),
        ("f 1 2 3.5\n", "line 4: expected a vertex index (v, v/vt, v//vn or v/vt/vn), found `3.5`"),
        ("f 1 2 3/1/1/1\n", "line 4: expected a vertex index (v, v/vt, v//vn or v/vt/vn), found `3/1/1/1`"),
        ("f 1 2 /3\n", "line 4: expected a vertex index (v, v/vt, v//vn or v/vt/vn), found `/3`"),
    ] {
        assert_eq!(message(Format::Obj, with_vertices(rest)), expected);
    }
    // relative references to missing normals and texture coordinates do no harm: they are not read
    assert_eq!(read(Format::Obj, with_vertices("vt 0 0\nf 1/-9 2/7 3//5\n")).unwrap().triangles, [[0, 1, 2]]);
}

fn ply(body: &str) -> String {
    format!("ply\nformat ascii 1.0\n{body}")
}

#[test]
fn ply_headers_say_the_line() {
    const XYZ: &str = "property float x\nproperty float y\nproperty float z\n";
    check(
        Format::Ply,
        &[
            ("", "the file is empty, expected a PLY header"),
            ("plyx\n", "line 1: expected `ply`, the first line of a PLY file, found `plyx`"),
            ("ply\nformat ascii 1.0\n", "line 2: the file ends here, expected `end_header`"),
            ("ply\nend_header\n", "line 2: expected a `format` line first, found `end_header`"),
            ("ply\nelement vertex 3\n", "line 2: expected `format` or `comment`, found `element`"),
            (
                "ply\nformat text 1.0\n",
                "line 2: expected `ascii`, `binary_little_endian` or `binary_big_endian`, found `text`",
            ),
            ("ply\nformat ascii 2.0\n", "line 2: expected version `1.0`, found `2.0`"),
        ],
    );
    for (body, expected) in [
        (
            "property float x\n".to_owned(),
            "line 3: expected `element`, `comment` or `end_header`, found `property`",
        ),
        (
            "element vertex -3\n".to_owned(),
            "line 3: expected the number of rows of element `vertex`, found `-3`",
        ),
        (
            "element vertex\n".to_owned(),
            "line 3: expected the number of rows of element `vertex`, found nothing",
        ),
        ("element vertex 3 4\n".to_owned(), "line 3: expected the end of the line, found `4`"),
        (
            "element vertex 1\nproperty half x\n".to_owned(),
            "line 4: expected `list` or a number type such as `float`, found `half`",
        ),
        (
            "element vertex 1\nproperty float\n".to_owned(),
            "line 4: expected the name of a property, found nothing",
        ),
        (
            "element face 1\nproperty list float int vertex_indices\n".to_owned(),
            "line 4: expected an integer type for a list's length, found `float`",
        ),
        (
            "element vertex 1\nproperty float x\nproperty float x\n".to_owned(),
            "line 5: expected a property of a new name in element `vertex`, found `x`",
        ),
        ("element a 1\nelement a 1\n".to_owned(), "line 4: expected an element of a new name, found `a`"),
        (
            "element vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n".to_owned(),
            "line 3: expected element `vertex` with scalar properties `x`, `y` and `z`, found none",
        ),
        (
            format!(
                "element vertex 1\n{XYZ}element face 1\nproperty list uchar float vertex_indices\nend_header\n0 0 0\n3 0 0 0\n"
            ),
            "line 7: expected element `face` with one list property `vertex_indices` (or `vertex_index`) of integers, found none",
        ),
        (format!("element vertex 99999999999\n{XYZ}end_header\n"), "line 3: more than 4294967295 vertices"),
    ] {
        assert_eq!(message(Format::Ply, ply(&body)), expected);
    }
}

#[test]
fn ply_text_says_the_line() {
    let header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                  element face 1\nproperty list uchar int vertex_indices\nproperty uchar red\n\
                  property uchar green\nproperty uchar blue\nend_header\n";
    for (body, expected) in [
        ("0 0 0\n1 0 0\n", "line 14: the file ends here, expected vertex 3 of the 3 declared"),
        (
            "0 0 0\n1 0\n0 1 0\n3 0 1 2 9 9 9\n",
            "line 14: expected `z` of vertex 2 of the 3 declared, found nothing",
        ),
        ("0 0 0\n1 0 0 7\n", "line 14: expected the end of vertex 2 of the 3 declared, found `7`"),
        ("0 0 0\n1 ? 0\n", "line 14: expected `y` of vertex 2 of the 3 declared, found `?`"),
        ("0 0 0\n1 0 0\n0 1 0\n", "line 15: the file ends here, expected face 1 of the 1 declared"),
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 3 9 9 9\n",
            "line 16: vertex index 3 is out of range, the file declares 3 vertices and counts from 0",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1 9 9 9\n",
            "line 16: vertex index -1 is out of range, the file declares 3 vertices and counts from 0",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1\n",
            "line 16: expected an integer, `vertex_indices` of face 1 of the 1 declared, found nothing",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2.0 9 9 9\n",
            "line 16: expected an integer, `vertex_indices` of face 1 of the 1 declared, found `2.0`",
        ),
        ("0 0 0\n1 0 0\n0 1 0\n2 0 1 9 9 9\n", "line 16: expected a face of at least 3 vertices, found 2"),
        (
            "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2 9 9 9\n",
            "line 16: expected the length of the list `vertex_indices` of face 1 of the 1 declared, found -3",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 9 256 9\n",
            "line 16: expected 0 to 255, `green` of face 1 of the 1 declared, found 256",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 9 9 9\n\n3 0 1 2\n",
            "line 18: the file goes on with `3 0 1 2` after the last face declared",
        ),
    ] {
        assert_eq!(message(Format::Ply, ply(&format!("{header}{body}"))), expected);
    }
}

#[test]
fn off_says_the_line() {
    check(
        Format::Off,
        &[
            ("", "the file is empty, expected OFF text"),
            ("# only\n\n", "the file is empty, expected OFF text"),
            ("OOF\n", "line 1: expected `OFF`, the first word of an OFF file, found `OOF`"),
            ("4OFF\n", "line 1: `4OFF` is not supported"),
            ("nOFF\n3\n", "line 1: `nOFF` is not supported"),
            ("OFF BINARY\n", "line 1: binary OFF is not supported"),
            ("OFF\n", "line 1: the file ends here, expected the numbers of vertices and faces"),
            ("OFF\n3 many 0\n", "line 2: expected the number of faces, found `many`"),
            ("OFF\n3\n", "line 2: expected the number of faces, found nothing"),
            ("OFF\n3 1 0 0\n", "line 2: expected the end of the line, found `0`"),
            ("OFF\n5000000000 1 0\n", "line 2: more than 4294967295 vertices"),
            (
                "OFF\n1000000000 1 0\n0 0 0\n",
                "line 3: the file ends here, expected vertex 2 of the 1000000000 declared",
            ),
            ("OFF 1 0 0\n# here\n0 0\n", "line 3: expected the z coordinate of vertex 1, found nothing"),
            (
                "OFF\n1 1 0\n0 0 0\n2 0 0\n",
                "line 4: expected a face's number of vertices (at least 3), found `2`",
            ),
            (
                "OFF\n1 1 0\n0 0 0\n3 0 0 1\n",
                "line 4: vertex index 1 is out of range, the file declares 1 vertices and counts from 0",
            ),
            ("OFF\n1 1 0\n0 0 0\n3 0 0\n", "line 4: expected 3 vertex indices, found nothing"),
            (
                "OFF\n1 1 0\n0 0 0\n3 0 0 0 1 2\n",
                "line 4: expected a face colour of 3 or 4 numbers, or nothing, found `1 2`",
            ),
            (
                "OFF\n1 1 0\n0 0 0\n3 0 0 0 256 0 0\n",
                "line 4: expected a face colour of 3 or 4 numbers, or nothing, found `256 0 0`",
            ),
            (
                "OFF\n1 0 0\n0 0 0\n\n1 1 1\n",
                "line 5: the file goes on with `1 1 1` after the last vertex declared",
            ),
        ],
    );
}

#[test]
fn stl_text_says_the_line() {
    const FACET: &str =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    check(
        Format::Stl,
        &[
            ("", "the file is empty, expected STL (`solid` and text, or binary)"),
            (" \n", "the file is empty, expected STL (`solid` and text, or binary)"),
            ("hello world", "line 1: expected STL (`solid` and text, or binary), found `hello`"),
            ("solid a\n", "line 1: the file ends here, expected `facet` or `endsolid`"),
            ("solid a\nfacets\n", "line 2: expected `facet` or `endsolid`, found `facets`"),
            ("solid a\nfacet normal 0 0\nouter loop\n", "line 3: expected a facet normal, found `outer`"),
            ("solid a\nendsolid\nfacet\n", "line 3: expected `solid`, found `facet`"),
            (
                "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 zero\n",
                "line 5: expected a vertex coordinate, found `zero`",
            ),
            (
                "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n",
                "line 7: expected `endloop`, found `vertex`",
            ),
        ],
    );
    assert_eq!(
        message(Format::Stl, format!("solid a\n{FACET}")),
        "line 8: the file ends here, expected `facet` or `endsolid`"
    );
}

#[test]
fn binary_files_say_the_byte() {
    let soup = TriangleSoup {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        triangles: vec![[0, 1, 2], [2, 1, 0]],
        ..TriangleSoup::default()
    };
    let (stl, _) = written(Format::Stl, &soup, &BINARY);
    assert_eq!(
        message(Format::Stl, &stl[..150]),
        "byte 150: the file ends here, expected triangle 2 of the 2 declared"
    );
    assert_eq!(
        message(Format::Stl, &stl[..60]),
        "byte 60: the file ends here, expected the 84 bytes of a binary STL header"
    );
    let more = [&stl[..], b"\n\0tail"].concat();
    assert_eq!(
        message(Format::Stl, more),
        "byte 186: the file goes on with `tail` after the last of the 2 triangles declared"
    );
    let (ply, _) = written(Format::Ply, &soup, &BINARY);
    let body = ply.len() - 3 * 24 - 2 * 13;
    let cut = body + 30;
    assert_eq!(
        message(Format::Ply, &ply[..cut]),
        format!("byte {cut}: the file ends here, expected `x` of vertex 2 of the 3 declared")
    );
    let mut wrong = ply.clone();
    let index = body + 72 + 13 + 5;
    wrong[index] = 7;
    assert_eq!(
        message(Format::Ply, &wrong),
        format!(
            "byte {index}: vertex index 7 is out of range, the file declares 3 vertices and counts from 0"
        )
    );
    wrong[body + 72] = 2;
    let face = body + 72;
    assert_eq!(
        message(Format::Ply, &wrong),
        format!("byte {face}: expected a face of at least 3 vertices, found 2")
    );
    let more = [&ply[..], b"\n!"].concat();
    let end = ply.len() + 1;
    assert_eq!(
        message(Format::Ply, more),
        format!("byte {end}: the file goes on with `!` after the last face declared")
    );
}

#[test]
fn other_encodings_are_named() {
    let wide = |text: &str, bom: bool, big: bool| -> Vec<u8> {
        let units = bom.then_some(0xfeff).into_iter().chain(text.encode_utf16());
        units.flat_map(|u| if big { u.to_be_bytes() } else { u.to_le_bytes() }).collect()
    };
    for (format, text) in [
        (Format::Obj, "v 0 0 0\n"),
        (Format::Ply, "ply\nformat ascii 1.0\n"),
        (Format::Off, "OFF\n"),
        (Format::Stl, "solid a\n"),
    ] {
        for (bom, big) in [(true, true), (true, false), (false, true), (false, false)] {
            let error = read(format, wide(text, bom, big)).unwrap_err();
            assert!(matches!(error, ReadError::Encoding { found: "UTF-16 text", .. }), "{format}: {error}");
            assert!(
                error.place().is_none()
                    && error.to_string().starts_with("the file is UTF-16 text, expected ")
            );
        }
        for magic in [&b"\x1f\x8b\x08\0abcdefgh"[..], b"PK\x03\x04abcdefgh"] {
            assert!(matches!(read(format, magic), Err(ReadError::Encoding { .. })));
        }
    }
    // a UTF-8 mark is no part of the text
    let file = "\u{feff}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    assert_eq!(read(Format::Obj, file).unwrap().triangles.len(), 1);
    let file = "\u{feff}solid a\nendsolid a\n";
    assert_eq!(read(Format::Stl, file).unwrap().groups.len(), 1);
}

#[test]
fn declared_counts_cost_nothing() {
    // A reader that allocated for 10^9 vertices and faces would need 36 GB.
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let file = format!(
            "ply\nformat {format} 1.0\nelement vertex 1000000000\nproperty double x\nproperty double y\nproperty double z\n\
             element face 1000000000\nproperty list uint int vertex_indices\nend_header\n"
        );
        let error = read(Format::Ply, file).unwrap_err();
        assert!(matches!(error, ReadError::Truncated { .. }), "{error}");
    }
    // a list of 2^32 - 1 corners in a file of few bytes, and one of other items to be passed over
    for name in ["vertex_indices", "other"] {
        let tail = if name == "other" { "property list uchar int vertex_indices\n" } else { "" };
        let mut file = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
             element face 1\nproperty list uint int {name}\n{tail}end_header\n"
        )
        .into_bytes();
        file.extend([0; 12]);
        file.extend([0xff; 4]);
        file.extend([0; 64]);
        let (size, error) = (file.len() as u64, read(Format::Ply, file).unwrap_err());
        assert_eq!(error.place(), Some(Place::Byte(size)), "{error}");
    }
    let mut stl = vec![0; 80];
    stl.extend([0xff; 4]);
    assert!(matches!(read(Format::Stl, &stl), Err(ReadError::Truncated { at: Place::Byte(84), .. })));
    // an element without properties has no bytes, whatever its count
    let file = ply("element nothing 18446744073709551615\nend_header\n");
    assert_eq!(read(Format::Ply, file).unwrap(), TriangleSoup::default());
}

#[test]
fn limits_hold_in_every_format() {
    let soup = TriangleSoup {
        positions: (0..9).map(|k| DVec3::new(f64::from(k), 1.0, 0.5)).collect(),
        triangles: (0..7).map(|k| [k, k + 1, k + 2]).collect(),
        ..TriangleSoup::default()
    };
    for (format, options) in PAIRS {
        let (file, _) = written(format, &soup, &options);
        let with = |max_vertices, max_triangles| {
            io::read(format, &file[..], &Limits { max_vertices, max_triangles, ..Limits::default() })
                .map(|soup| soup.positions.len())
        };
        assert_eq!(with(9, 7).unwrap(), 9);
        assert!(matches!(with(8, 7), Err(ReadError::OverLimit { what: "vertices", limit: 8, .. })));
        assert!(matches!(with(9, 6), Err(ReadError::OverLimit { what: "triangles", limit: 6, .. })));
    }
    let quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let limits = Limits { max_triangles: 1, ..Limits::default() };
    let error = io::read(Format::Obj, quad.as_bytes(), &limits).unwrap_err();
    assert_eq!(error.to_string(), "line 5: more than 1 triangles");
}

#[test]
fn endless_lines_and_failing_readers_are_errors() {
    for format in [Format::Obj, Format::Ply, Format::Off, Format::Stl] {
        let head = if format == Format::Stl { "solid " } else { "" };
        let endless = head.as_bytes().chain(std::io::repeat(b'a'));
        let error = io::read(format, endless, &Limits::default()).unwrap_err();
        assert!(matches!(error, ReadError::LineTooLong { at: Place::Line(1), .. }), "{format}: {error}");
    }
    struct Failing;
    impl Read for Failing {
        fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
            Err(std::io::Error::other("the disk is gone"))
        }
    }
    for format in Format::ALL {
        let error = io::read(format, b"v 0 0".chain(Failing), &Limits::default()).unwrap_err();
        assert_eq!(error.to_string(), "byte 5: cannot read on: the disk is gone");
    }
}

/// What every soup from a reader keeps, whatever the file.
fn assert_consistent(soup: &TriangleSoup) {
    let n = soup.positions.len();
    assert!(soup.triangles.iter().flatten().all(|&i| (i as usize) < n));
    assert!(soup.triangle_colors.is_empty() || soup.triangle_colors.len() == soup.triangles.len());
    let mut done = 0;
    for group in &soup.groups {
        assert!(done <= group.triangles.start && group.triangles.start <= group.triangles.end);
        done = group.triangles.end;
    }
    assert!(done as usize <= soup.triangles.len());
}

fn small() -> TriangleSoup {
    TriangleSoup {
        positions: vec![DVec3::ZERO, DVec3::new(1.5, -2e-7, 0.0), DVec3::Y, DVec3::Z],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        groups: vec![Group { name: "one".to_owned(), triangles: 0..1 }],
        triangle_colors: vec![[255, 128, 0], [7, 0, 99]],
    }
}

#[test]
fn truncation_at_every_byte_is_an_error_or_a_smaller_surface() {
    for (format, options) in PAIRS {
        let (file, _) = written(format, &small(), &options);
        let whole = read(format, &file).unwrap();
        for length in 0..file.len() {
            let result = read(format, &file[..length]);
            if options == BINARY {
                let error = result.expect_err("a binary file without its end");
                if let Some(Place::Byte(byte)) = error.place() {
                    assert_eq!(byte, length as u64, "{format}: {error}");
                }
            } else if let Ok(soup) = result {
                // In text a line or a digit may be missing unnoticed: the formats have no end mark, except STL.
                assert_consistent(&soup);
                let triangles = match format {
                    Format::Obj => soup.triangles.len(),
                    // each solid of this file holds one triangle and ends in `endsolid`
                    Format::Stl => String::from_utf8_lossy(&file[..length]).matches("endsolid").count(),
                    _ => whole.triangles.len(),
                };
                assert_eq!(soup.triangles.len(), triangles, "{format} {length}");
            }
        }
    }
}

#[test]
fn corruption_of_any_byte_is_an_error_or_a_surface() {
    const VALUES: &[u8] = b"\0\x01\x07\x7f\x80\xc3\xff\n\r\t #\\/-+.,019aevfgnx";
    for (format, options) in PAIRS {
        let (file, _) = written(format, &small(), &options);
        for k in 0..file.len() {
            for &value in VALUES {
                let mut file = file.clone();
                file[k] = value;
                if let Ok(soup) = read(format, &file) {
                    assert_consistent(&soup);
                }
            }
        }
    }
}

/// Words that files are made of, wrong ones among them.
fn words() -> impl Strategy<Value = String> {
    let vocabulary = [
        "v",
        "f",
        "g",
        "o",
        "l",
        "vn",
        "#",
        "\\",
        "\n",
        "\n",
        "\n",
        "\r\n",
        "\r",
        "ply\n",
        "format ascii 1.0\n",
        "format binary_big_endian 1.0\n",
        "element vertex 3\n",
        "element face 2\n",
        "element tristrips 1\n",
        "element x 2\n",
        "property float x\n",
        "property double y\n",
        "property int z\n",
        "property list uchar int vertex_indices\n",
        "property uchar red\n",
        "property list int short w\n",
        "end_header\n",
        "OFF\n",
        "COFF",
        "3 1 0\n",
        "solid a\n",
        "solid",
        "facet normal",
        "outer loop",
        "vertex",
        "endloop",
        "endfacet",
        "endsolid",
        "0 0 0\n",
        "1 0 0\n",
        "0 1 0\n",
        "3 0 1 2\n",
        "4 0 1 2 0\n",
        "-1",
        "0",
        "1",
        "2",
        "3",
        "7",
        "1e999",
        "nan",
        "inf",
        "-0",
        "1/2/3",
        "1//1",
        "\0\0\0\0",
        "\u{1}\0\0\0",
        "\u{3}",
        "é",
    ];
    prop::collection::vec(prop::sample::select(vocabulary.to_vec()), 0..60).prop_map(|words| {
        let mut text = String::new();
        for word in words {
            text += word;
            if !word.ends_with('\n') {
                text.push(' ');
            }
        }
        text
    })
}

proptest! {
    #[test]
    fn any_bytes_are_an_error_or_a_surface(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        for format in Format::ALL {
            if let Ok(soup) = read(format, &bytes) {
                assert_consistent(&soup);
            }
        }
    }

    #[test]
    fn any_words_are_an_error_or_a_surface(words in words(), head in 0..6_usize) {
        let head = ["", "ply\nformat ascii 1.0\n", "ply\nformat binary_little_endian 1.0\n", "OFF\n", "solid a\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"][head];
        let file = format!("{head}{words}");
        for format in Format::ALL {
            if let Ok(soup) = read(format, &file) {
                assert_consistent(&soup);
            }
        }
    }

    /// A reader that gives few bytes at a time makes no difference.
    #[test]
    fn the_size_of_reads_makes_no_difference(words in words(), size in 1..9_usize) {
        struct Dribble<'a>(&'a [u8], usize);
        impl Read for Dribble<'_> {
            fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
                let size = self.1.min(buffer.len()).min(self.0.len());
                self.0.read(&mut buffer[..size])
            }
        }
        for format in Format::ALL {
            let whole = read(format, &words).map_err(|e| e.to_string());
            let parts = io::read(format, Dribble(words.as_bytes(), size), &Limits::default()).map_err(|e| e.to_string());
            prop_assert_eq!(format!("{whole:?}"), format!("{parts:?}"));
        }
    }
}

#[test]
fn what_cannot_be_written_is_refused_before_the_first_byte() {
    let good = small();
    let refused = |soup: &TriangleSoup| {
        let mut errors = Vec::new();
        for (format, options) in PAIRS {
            let mut file = Vec::new();
            errors.push(io::write(format, &mut file, soup, &options).unwrap_err());
            assert!(file.is_empty());
        }
        errors
    };
    let mut bad = good.clone();
    bad.triangles[1][2] = 4;
    assert!(
        refused(&bad)
            .iter()
            .all(|e| matches!(e, WriteError::IndexOutOfRange { triangle: 1, index: 4, vertices: 4 }))
    );
    let mut bad = good.clone();
    bad.triangle_colors.pop();
    assert!(refused(&bad).iter().all(|e| matches!(e, WriteError::Colors { colors: 1, triangles: 2 })));
    for groups in [&[(0, 3)][..], &[(1, 2), (0, 1)], &[(1, 1), (0, 2)]] {
        let mut bad = good.clone();
        bad.groups =
            groups.iter().map(|&(from, to)| Group { name: "g".to_owned(), triangles: from..to }).collect();
        assert!(refused(&bad).iter().all(|e| matches!(e, WriteError::Group { .. })));
    }
    let mut bad = good;
    bad.positions[3].y = -1e39;
    let error = io::write(Format::Stl, &mut Vec::new(), &bad, &BINARY).unwrap_err();
    assert!(matches!(error, WriteError::BeyondSinglePrecision { vertex: 3, .. }));
    assert!(io::write(Format::Stl, &mut Vec::new(), &bad, &ASCII).is_ok());
}
