//! `tobj`, another reader of OBJ, agrees: the same faces with corners of the same bits.

use super::{ASCII, read, soup, written};
use proptest::prelude::*;
use welter_meshing::io::Format;
use welter_meshing::surface::TriangleSoup;

type Corner = [u64; 3];

/// Each triangle of each model by the bits of its corners, in the order of the file.
fn tobj_triangles(file: &[u8]) -> Vec<[Corner; 3]> {
    let options = tobj::LoadOptions { triangulate: true, single_index: true, ..tobj::LoadOptions::default() };
    let no_materials = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut &file[..], &options, no_materials).unwrap();
    let mut triangles = Vec::new();
    for model in models {
        let corner = |i: &u32| -> Corner {
            let at = 3 * *i as usize;
            [0, 1, 2].map(|k| model.mesh.positions[at + k].to_bits())
        };
        triangles.extend(
            model.mesh.indices.chunks_exact(3).map(|t| [corner(&t[0]), corner(&t[1]), corner(&t[2])]),
        );
    }
    triangles
}

pub(super) fn same_as_tobj(file: &[u8], soup: &TriangleSoup) {
    let corner = |i: u32| soup.positions[i as usize].to_array().map(f64::to_bits);
    let ours: Vec<_> = soup.triangles.iter().map(|t| t.map(corner)).collect();
    assert_eq!(ours, tobj_triangles(file));
}

proptest! {
    #[test]
    fn tobj_reads_the_same_triangles(soup in soup()) {
        let (file, _) = written(Format::Obj, &soup, &ASCII);
        same_as_tobj(&file, &soup);
    }

    /// Decimals of any length and exponent, relative indices, all kinds of corners.
    #[test]
    fn tobj_reads_the_same_numbers(
        numbers in prop::collection::vec("[-+]?[0-9]{1,25}(\\.[0-9]{0,25})?([eE][-+]?[0-9]{1,3})?", 9..30),
        faces in prop::collection::vec([0..9_i32, 0..9, 0..9], 0..20),
    ) {
        let mut file = String::from("vt 0 0\nvn 0 0 1\n");
        let vertices = numbers.len() as i32 / 3;
        for xyz in numbers.chunks_exact(3) {
            file += &format!("v {}\n", xyz.join(" \t"));
        }
        for (k, face) in faces.iter().enumerate() {
            let [a, b, c] = face.map(|i| i % vertices + 1);
            file += &match k % 4 {
                0 => format!("f {a} {b} {c}\n"),
                1 => format!("f {a}/1 {b}/1 {c}/1\n"),
                2 => format!("f {a}//1 {b}//1 {c}//1\n"),
                _ => format!("f {}/1/1 {}/-1/-1 {c}/1/1\n", a - vertices - 1, b - vertices - 1),
            };
        }
        same_as_tobj(file.as_bytes(), &read(Format::Obj, &file).unwrap());
    }
}
