//! What the formats allow and files in the wild hold: all of it is read, and what is not kept is named.

use super::{BINARY, read, written};
use std::fs::File;
use std::path::PathBuf;
use welter_meshing::DVec3;
use welter_meshing::io::{self, Format, Limits, Place};
use welter_meshing::surface::TriangleSoup;

fn ignored(format: Format, file: impl AsRef<[u8]>) -> Vec<(String, u64, Place)> {
    let (_, report) = io::read_reported(format, file.as_ref(), &Limits::default()).unwrap();
    report.ignored.into_iter().map(|i| (i.what, i.count, i.first)).collect()
}

fn group_list(soup: &TriangleSoup) -> Vec<(&str, std::ops::Range<u32>)> {
    soup.groups.iter().map(|g| (g.name.as_str(), g.triangles.clone())).collect()
}

#[test]
fn obj_keeps_groups_and_shared_vertices() {
    let file = "# comment\nmtllib a.mtl\no body\nv 0 0 0\nv 1 0 0 1.0\n v 0 1 0 1 0 0 # red\nv 9 9 9\nvn 0 0 1\nvt 0 0\n\
                s off\nf 1//1 2//1 3//1 # first\ng wing left\nusemtl m\n\tf 3/1/1 2/1/1 -1/1/1\ng\nf +1 2 4\ng wing left\n";
    let soup = read(Format::Obj, file).unwrap();
    assert_eq!(soup.positions.len(), 4);
    assert_eq!(soup.triangles, [[0, 1, 2], [2, 1, 3], [0, 1, 3]]);
    assert_eq!(group_list(&soup), [("body", 0..1), ("wing left", 1..2), ("wing left", 3..3)]);
    let names: Vec<_> = ignored(Format::Obj, file).into_iter().map(|(what, ..)| what).collect();
    assert_eq!(
        names,
        [
            "`mtllib` statements",
            "vertex colours",
            "`vn` statements",
            "`vt` statements",
            "`s` statements",
            "`usemtl` statements"
        ]
    );
}

#[test]
fn numbers_are_the_nearest_doubles_and_any_infinity_or_nan() {
    let file = "v 0.1 -1e-400 2.2250738585072012e-308\nv 1e400 -Infinity nan\nv 1.#INF -1.#IND00 -nan(ind)\n\
                v 9007199254740993 9007199254740992.99999999999999999 4.9406564584124654e-324\nv +1. .5 1E+2\n";
    let soup = read(Format::Obj, file).unwrap();
    assert_eq!(soup.positions[0].to_array(), [0.1, -0.0, f64::MIN_POSITIVE]);
    assert!(soup.positions[0].y.is_sign_negative());
    assert_eq!(soup.positions[1].x, f64::INFINITY);
    assert_eq!(soup.positions[1].y, f64::NEG_INFINITY);
    assert!(soup.positions[1].z.is_nan());
    assert_eq!(soup.positions[2].x, f64::INFINITY);
    assert!(soup.positions[2].y.is_nan() && soup.positions[2].z.is_nan());
    assert_eq!(soup.positions[3].to_array(), [9007199254740992.0, 9007199254740992.0, 5e-324]);
    assert_eq!(soup.positions[4].to_array(), [1.0, 0.5, 100.0]);
}

#[test]
fn non_finite_coordinates_survive_every_text_format() {
    let positions = vec![DVec3::new(f64::INFINITY, f64::NEG_INFINITY, f64::NAN), DVec3::X, DVec3::Y];
    let soup = TriangleSoup { positions, triangles: vec![[0, 1, 2]], ..TriangleSoup::default() };
    for (format, options) in super::PAIRS {
        let (file, _) = written(format, &soup, &options);
        let [x, y, z] = read(format, &file).unwrap().positions[0].to_array();
        assert!(x == f64::INFINITY && y == f64::NEG_INFINITY && z.is_nan(), "{format}");
    }
}

#[test]
fn a_nan_of_any_bits_is_one_nan() {
    let mut file =
        b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty double y\n\
                     property float z\nend_header\n"
            .to_vec();
    file.extend(0xffff_ffff_u32.to_le_bytes());
    file.extend(0xfff8_0000_0000_0007_u64.to_le_bytes());
    file.extend((-0.0_f32).to_le_bytes());
    let [x, y, z] = read(Format::Ply, file).unwrap().positions[0].to_array().map(f64::to_bits);
    assert_eq!([x, y, z], [f64::NAN.to_bits(), f64::NAN.to_bits(), (-0.0_f64).to_bits()]);
}

/// A PLY file with every number type, other elements, lists among the vertices and any order of properties.
fn rich_ply(format: &str) -> Vec<u8> {
    let header = format!(
        "ply\r\nformat {format} 1.0\r\ncomment made by hand\r\nobj_info none\r\nelement camera 1\r\nproperty double a\r\n\
         property list ushort float b\r\nelement vertex 4\r\nproperty uchar red\r\nproperty float z\r\nproperty double x\r\n\
         property list int8 uint16 tags\r\nproperty short y\r\nelement face 2\r\nproperty float quality\r\n\
         property list uint ushort vertex_index\r\nproperty float blue\r\nproperty float red\r\nproperty float green\r\n\
         element edge 1\r\nproperty int vertex1\r\nproperty uint vertex2\r\nproperty char c\r\nend_header\r\n"
    );
    let mut file = header.into_bytes();
    if format == "ascii" {
        file.extend(b"0.5 2 1 2\r\n1 0.5 0.1 2 7 8 -3\n255 0 1 0 0\n0 0 1 1 9 1\n0 0 0 0 1\n");
        file.extend(b"0 4 0 1 2 3 0 1 0.5\n 0.25 3 2 1 0 1 0 0 \n0 1 -2\n\n");
        return file;
    }
    let big = format == "binary_big_endian";
    let mut put = |bytes: &[u8]| {
        if big {
            file.extend(bytes.iter().rev());
        } else {
            file.extend(bytes);
        }
    };
    let camera: [&[u8]; 4] =
        [&0.5_f64.to_le_bytes(), &2_u16.to_le_bytes(), &1_f32.to_le_bytes(), &2_f32.to_le_bytes()];
    camera.into_iter().for_each(&mut put);
    for (red, z, x, tags, y) in [
        (1_u8, 0.5_f32, 0.1_f64, &[7_u16, 8][..], -3_i16),
        (255, 0.0, 1.0, &[], 0),
        (0, 0.0, 1.0, &[9], 1),
        (0, 0.0, 0.0, &[], 1),
    ] {
        put(&[red]);
        put(&z.to_le_bytes());
        put(&x.to_le_bytes());
        put(&[tags.len() as u8]);
        tags.iter().for_each(|t| put(&t.to_le_bytes()));
        put(&y.to_le_bytes());
    }
    for (quality, corners, rgb) in
        [(0_f32, &[0_u16, 1, 2, 3][..], [0_f32, 1.0, 0.5]), (0.25, &[2, 1, 0], [1.0, 0.0, 0.0])]
    {
        put(&quality.to_le_bytes());
        put(&(corners.len() as u32).to_le_bytes());
        corners.iter().for_each(|t| put(&t.to_le_bytes()));
        rgb.iter().for_each(|t| put(&t.to_le_bytes()));
    }
    put(&0_i32.to_le_bytes());
    put(&1_u32.to_le_bytes());
    put(&[0xfe]);
    file
}

#[test]
fn ply_of_every_type_reads_the_same_in_every_encoding() {
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let file = rich_ply(format);
        let soup = read(Format::Ply, &file).unwrap_or_else(|e| panic!("{format}: {e}"));
        let first = DVec3::new(0.1, -3.0, 0.5);
        assert_eq!(soup.positions, [first, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y], "{format}");
        assert_eq!(soup.triangles[2], [2, 1, 0]);
        assert_eq!(soup.triangle_colors, [[255, 128, 0], [255, 128, 0], [0, 0, 255]]);
        let ignored = ignored(Format::Ply, &file);
        let names: Vec<_> = ignored.iter().map(|(what, ..)| what.as_str()).collect();
        assert_eq!(
            names,
            [
                "element `camera`",
                "vertex property `red`",
                "vertex property `tags`",
                "face property `quality`",
                "element `edge`"
            ]
        );
        assert_eq!(ignored[1].2, Place::Line(9));
    }
}

#[test]
fn ply_header_lines_may_end_in_carriage_returns() {
    // the first byte of the body is a line feed: part of the number, not of the header
    let mut file =
        b"ply\rformat binary_little_endian 1.0\relement vertex 1\rproperty uchar x\rproperty uchar y\r\
                     property uchar z\rend_header\r"
            .to_vec();
    file.extend(b"\n\r\n");
    assert_eq!(read(Format::Ply, file).unwrap().positions, [DVec3::new(10.0, 13.0, 10.0)]);
}

#[test]
fn ply_strips_alternate_and_restart() {
    let file = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
                element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n\
                9 0 1 2 3 -1 2 3 4 -1\n";
    assert_eq!(read(Format::Ply, file).unwrap().triangles, [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
}

#[test]
fn ply_faces_may_come_first() {
    let file = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n\
                property float x\nproperty float y\nproperty float z\nend_header\n3 2 1 0\n0 0 0\n1 0 0\n0 1 0\n";
    assert_eq!(read(Format::Ply, file).unwrap().triangles, [[2, 1, 0]]);
}

#[test]
fn off_variants_are_read() {
    const BODY: &str = "0 0 0\n1 0 0\n\n# between\n1 1 0 # after\n0 1 0\n";
    for head in ["OFF\n4 2 0\n", "OFF 4 2 0\n", "OFF4 2 0\n", "# x\n\nOFF # y\n# z\n 4 2\n", "COFF\n4 2 5\n"]
    {
        let soup = read(Format::Off, format!("{head}{BODY}3 0 1 2\n3 0 2 3\n"))
            .unwrap_or_else(|e| panic!("{head}: {e}"));
        assert_eq!(soup.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert!(soup.triangle_colors.is_empty());
    }
    let colored = format!("OFF\n4 2 0\n{BODY}3 0 1 2 255 0 7\n3 0 2 3 0.5 0 1.0 0.5\n");
    assert_eq!(read(Format::Off, &colored).unwrap().triangle_colors, [[255, 0, 7], [128, 0, 255]]);
    let mixed = format!("OFF\n4 2 0\n{BODY}3 0 1 2 255 0 7\n3 0 2 3\n");
    assert!(read(Format::Off, &mixed).unwrap().triangle_colors.is_empty());
    assert_eq!(ignored(Format::Off, &mixed)[0].0, "colours of some faces only");
    let quad = format!("OFF\n4 1 0\n{BODY}4 0 1 2 3 9 9 9\n");
    assert_eq!(read(Format::Off, &quad).unwrap().triangle_colors, [[9; 3]; 2]);
    let normals =
        "CNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 255\n1 0 0 0 0 1 255 0 0 255\n0 1 0 0 0 1 255 0 0 255\n3 0 1 2\n";
    assert_eq!(ignored(Format::Off, normals), [("vertex attributes".to_owned(), 3, Place::Line(3))]);
}

#[test]
fn binary_stl_is_known_by_its_content() {
    let soup = TriangleSoup {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        triangles: vec![[0, 1, 2]],
        ..TriangleSoup::default()
    };
    let (plain, _) = written(Format::Stl, &soup, &BINARY);
    for header in
        ["solid part of a facet with a vertex", "solid\n", "SOLID", "  solid x\nfacet normal", "", "COLOR="]
    {
        for fill in [0, b' '] {
            let mut file = plain.clone();
            file[..80].fill(fill);
            file[..header.len()].copy_from_slice(header.as_bytes());
            let back = read(Format::Stl, &file).unwrap_or_else(|e| panic!("{header:?}: {e}"));
            assert_eq!(back, soup, "{header:?}");
        }
    }
    let mut colored = plain;
    colored[132] = 9;
    assert_eq!(ignored(Format::Stl, &colored), [("attribute bytes".to_owned(), 1, Place::Byte(84))]);
}

#[test]
fn group_names_that_are_no_line_are_reported() {
    use welter_meshing::io::Dropped;
    use welter_meshing::surface::Group;
    let group = |name: &str, triangles| Group { name: name.to_owned(), triangles };
    let soup = TriangleSoup {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        triangles: vec![[0, 1, 2]; 6],
        groups: vec![
            group("a\nb", 0..1),
            group(" ", 1..2),
            group("", 2..3),
            group("end\\", 3..4),
            group("c d", 5..6),
        ],
        triangle_colors: vec![],
    };
    for format in [Format::Obj, Format::Stl] {
        let (file, report) = written(format, &soup, &super::ASCII);
        assert_eq!(
            report.dropped,
            [Dropped::Groups { count: 2 }, Dropped::GroupNames { count: 2 }],
            "{format}"
        );
        let back = read(format, &file).unwrap();
        assert_eq!(group_list(&back), [("a b", 0..1), ("end", 3..4), ("c d", 5..6)], "{format}");
    }
}

fn meshes() -> Option<Vec<PathBuf>> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/meshes");
    let mut files: Vec<_> = std::fs::read_dir(folder).ok()?.filter_map(|f| Some(f.ok()?.path())).collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "obj"));
    files.sort();
    Some(files)
}

#[test]
fn real_meshes_survive_every_format() {
    let Some(files) = meshes() else {
        println!("skipped: ../shared/data/meshes is not there");
        return;
    };
    let counts = [
        ("comb", 9816),
        ("manifold_generic_twin_right", 11656),
        ("manifold_offset1", 4418),
        ("manifold_self_intersectA", 17160),
        ("openscad_nonmanifold_crash", 1442),
        ("simpleBridge_39comp", 32014),
        ("spot", 5856),
    ];
    assert_eq!(files.len(), counts.len());
    for (path, (name, triangles)) in files.into_iter().zip(counts) {
        assert_eq!(path.file_stem().unwrap(), name);
        let soup = io::read(Format::Obj, File::open(&path).unwrap(), &Limits::default()).unwrap();
        assert_eq!(soup.triangles.len(), triangles, "{name}");
        for (format, options) in super::PAIRS.into_iter().filter(|(format, _)| *format != Format::Stl) {
            let (file, report) = written(format, &soup, &options);
            assert!(report.dropped.iter().all(|d| matches!(d, io::Dropped::Groups { .. })));
            let back = read(format, &file).unwrap();
            assert_eq!(super::bits(&back.positions), super::bits(&soup.positions), "{name} {format}");
            assert_eq!(back.triangles, soup.triangles, "{name} {format}");
        }
        super::peer::same_as_tobj(&std::fs::read(&path).unwrap(), &soup);
    }
}
