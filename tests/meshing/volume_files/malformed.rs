//! Malformed files: each gives an error that says where, what was expected and what was found.

use super::{FORMS, Form};
use welter_kit::generate::volumes::stacked_cells;
use welter_meshing::io::{
    Encoding, Limits, MshVersion, ReadError, VolumeData, VtkEncoding, read_medit, read_msh, read_vtu,
};

fn files() -> impl Iterator<Item = (Form, Vec<u8>, VolumeData)> {
    FORMS.into_iter().map(|form| {
        let (file, _) = form.write(&stacked_cells(), Some("body")).unwrap();
        let (mesh, _) = form.read(&file).unwrap();
        (form, file, mesh)
    })
}

#[test]
fn truncation_at_every_byte_is_an_error() {
    for (form, file, mesh) in files() {
        let mut whole = 0;
        for cut in 0..file.len() {
            match form.read(&file[..cut]) {
                Err(ReadError::Truncated { .. } | ReadError::Empty { .. } | ReadError::Unexpected { .. }) => {
                }
                // Version 4 is one, and is not supported.
                Err(ReadError::Unsupported { .. }) if file[..cut].ends_with(b"\n4") => {}
                Err(ReadError::Unsupported { .. }) if file[..cut].ends_with(b"\n4.") => {}
                Err(other) => panic!("{form:?} at {cut}: {other}"),
                // Only white space is missing, or whole sections of data.
                Ok((read, _)) => {
                    whole += 1;
                    let blank = file[cut..].trim_ascii().is_empty();
                    let sections =
                        matches!(form, Form::Msh(..)) && file[cut..].trim_ascii_start().starts_with(b"$");
                    assert!(blank || sections, "{form:?} at {cut}");
                    assert_eq!((&read.positions, &read.hexahedra), (&mesh.positions, &mesh.hexahedra));
                    assert!(mesh.point_fields.starts_with(&read.point_fields));
                    assert!(mesh.cell_fields.starts_with(&read.cell_fields));
                }
            }
        }
        // Two cuts around each line end: after the elements, and after each of the fields but the last.
        assert!(whole <= if matches!(form, Form::Msh(..)) { 15 } else { 1 }, "{form:?}: {whole}");
    }
}

#[test]
fn changed_bytes_never_panic_and_never_make_more_than_the_file_holds() {
    for (form, file, mesh) in files() {
        let mut unchanged = 0;
        for (turn, at) in (0..file.len()).step_by(3).enumerate() {
            let changes = [0, 0xff, b'9', b'-', b'<', b' ', b'\n', file[at] ^ 1, file[at] ^ 0x80];
            // Two of them at every third byte, by turns.
            for change in [changes[turn % 9], changes[(turn / 9 + 4) % 9]] {
                let mut changed = file.clone();
                changed[at] = change;
                if let Ok((read, _)) = form.read(&changed) {
                    let cells = read.cell_count();
                    assert!(read.positions.len() <= file.len() && cells <= file.len(), "{form:?} at {at}");
                    let fits = |field: &welter_meshing::io::DataField<'_>, places: usize| {
                        field.values.len() == places * field.components
                    };
                    assert!(read.point_fields.iter().all(|field| fits(field, read.positions.len())));
                    assert!(read.cell_fields.iter().all(|field| fits(field, cells)));
                    assert!(read.hexahedra.iter().flatten().all(|&v| (v as usize) < read.positions.len()));
                    unchanged += u32::from(change != file[at] && read == mesh);
                }
            }
        }
        // Of white space, comments and unread numbers there are some, but most of a file matters.
        assert!(unchanged < file.len() as u32 / 3, "{form:?}: {unchanged} of {}", 2 * file.len() / 3);
    }
}

/// What a reader says of a file.
fn message<T>(result: Result<T, ReadError>) -> String {
    result.err().map_or("no error".to_owned(), |error| error.to_string())
}

#[test]
fn vtu_says_the_byte() {
    let read = |file: &str| message(read_vtu(file.as_bytes(), &Limits::default()));
    let grid = |inside: &str| {
        read(&format!(
            "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>{inside}</UnstructuredGrid></VTKFile>"
        ))
    };
    for (file, expected) in [
        ("", "the file is empty, expected VTU, an XML file of VTK"),
        ("  ", "the file is empty, expected VTU, an XML file of VTK"),
        ("x", "byte 0: expected a tag, found `x`"),
        ("<a>", "byte 0: expected `<VTKFile>`, the first tag of a VTU file, found `<a>`"),
        (
            "<VTKFile type=\"ImageData\">",
            "byte 0: expected `UnstructuredGrid` as `type` of the file, found `ImageData`",
        ),
        ("<VTKFile type=\"UnstructuredGrid\">", "byte 33: the file ends here, expected `</VTKFile>`"),
        (
            "<VTKFile type=\"UnstructuredGrid\"></VTKFile>",
            "byte 43: the file ends here, expected a `<Piece>`",
        ),
        (
            "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\">",
            "byte 0: compression by `vtkLZ4DataCompressor` is not supported",
        ),
        (
            "<VTKFile type=\"UnstructuredGrid\" byte_order=\"Middle\">",
            "byte 0: expected `LittleEndian` or `BigEndian` as `byte_order`, found `Middle`",
        ),
        ("<VTKFile type=\"UnstructuredGrid\"></a>", "byte 33: expected `</VTKFile>`, found `</a>`"),
    ] {
        assert_eq!(read(file), expected, "{file}");
    }
    for (inside, expected) in [
        ("<Piece NumberOfPoints=\"1\"/>", "byte 51: expected attribute `NumberOfCells`, found nothing"),
        (
            "<Piece NumberOfPoints=\"-1\"/>",
            "byte 51: expected a count as attribute `NumberOfPoints` of `Piece`, found `-1`",
        ),
        (
            "<Piece NumberOfPoints=\"1\" NumberOfCells=\"0\"/>",
            "byte 51: expected an array of points, found nothing",
        ),
        (
            "<Piece NumberOfPoints=\"9999999999\" NumberOfCells=\"0\"/>",
            "byte 51: more than 4294967295 vertices",
        ),
        (
            "<Piece NumberOfPoints=\"0\" NumberOfCells=\"1\"/>",
            "byte 51: expected an array `connectivity`, found nothing",
        ),
        (
            "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/><Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/>",
            "byte 96: a second piece is not supported",
        ),
    ] {
        assert_eq!(grid(inside), expected, "{inside}");
    }
}

#[test]
fn vtu_cells_say_the_byte() {
    const POINT: &str =
        "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">0 0 0</DataArray></Points>";
    let cells = |connectivity: &str, offsets: &str, types: &str| {
        let array = |name: &str, numbers: &str| {
            let kind = if name == "types" { "UInt8" } else { "Int32" };
            format!("<DataArray Name=\"{name}\" type=\"{kind}\">{numbers}</DataArray>")
        };
        let arrays =
            array("connectivity", connectivity) + &array("offsets", offsets) + &array("types", types);
        format!(
            "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"1\" NumberOfCells=\"1\">{POINT}\
             <Cells>{arrays}</Cells></Piece></UnstructuredGrid></VTKFile>"
        )
    };
    let read = |file: &str| message(read_vtu(file.as_bytes(), &Limits::default()));
    assert_eq!(read(&cells("0 0 0", "3", "5")), "no error");
    let (corners, ends) = ("<DataArray Name=\"connectivity\"", "<DataArray Name=\"offsets\"");
    for (file, place, expected) in [
        (
            cells("0 0 1", "3", "5"),
            corners,
            "vertex index 1 is out of range, the file declares 1 vertices and counts from 0",
        ),
        (
            cells("0 0 -1", "3", "5"),
            corners,
            "vertex index -1 is out of range, the file declares 1 vertices and counts from 0",
        ),
        (cells("0 0 0", "4", "5"), ends, "expected the offset of cell 0 from 0 to 3, found 4"),
        (cells("0 0 0", "-1", "5"), ends, "expected the offset of cell 0 from 0 to 3, found -1"),
        (cells("0 0 0", "2", "5"), ends, "expected 3 corners of cell 0, a triangle, found 2"),
        (cells("0 0 0 0", "3", "5"), corners, "expected 3 corners, as many as the cells have, found 4"),
        (cells("0 0 0", "3 4", "5"), "4</", "expected no more than 1 numbers, found `4`"),
        (cells("0 0 0", "", "5"), ends, "expected an array of 1 numbers, found 0 numbers"),
        (cells("0 0 0", "3", "x"), "x</", "expected a number of its type, found `x`"),
        (cells("0 0 0", "3", "256"), "256", "expected a number of its type, found `256`"),
    ] {
        assert_eq!(read(&file), format!("byte {}: {expected}", file.find(place).unwrap()));
    }
}

#[test]
fn vtu_arrays_say_the_byte() {
    const DOUBLES: &str = "type=\"Float64\" NumberOfComponents=\"3\"";
    for (array, place, expected) in [
        ("type=\"Half\">".to_owned(), "<DataArray", "expected a number type of VTK as `type`, found `Half`"),
        ("type=\"Float32\">1".to_owned(), "<DataArray", "expected points of 3 components, found 1"),
        (
            "type=\"Int8\" NumberOfComponents=\"3\">1 2 3".to_owned(),
            "<DataArray",
            "expected points of type `Float64` or `Float32`, found `integers`",
        ),
        (
            "type=\"Float64\" NumberOfComponents=\"0\">".to_owned(),
            "<DataArray",
            "expected a number of components, found 0",
        ),
        (
            format!("{DOUBLES} format=\"appended\">"),
            "<DataArray",
            "expected the offset of an appended array, found nothing",
        ),
        (
            format!("{DOUBLES} format=\"appended\" offset=\"0\">"),
            "<DataArray",
            "expected appended data behind the XML, found nothing",
        ),
        // In each the first characters are the length in bytes: 20, then 24.
        (
            format!("{DOUBLES} format=\"binary\">FAAAAA=="),
            "=</DataArray",
            "expected 3 numbers of 8 bytes, found 20 bytes",
        ),
        (format!("{DOUBLES} format=\"binary\">GAAA!"), "!</", "expected a character of base64, found `!`"),
        (
            format!("{DOUBLES} format=\"binary\">GAAAAA=="),
            "</Points>",
            "expected 24 bytes more before the end of the array, found nothing",
        ),
    ] {
        let file = format!(
            "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"1\" NumberOfCells=\"0\"><Points>\
             <DataArray {array}</DataArray></Points></Piece></UnstructuredGrid></VTKFile>"
        );
        let error = message(read_vtu(file.as_bytes(), &Limits::default()));
        assert_eq!(error, format!("byte {}: {expected}", file.find(place).unwrap()), "{array}");
    }
}

#[test]
fn msh_says_the_line() {
    let read = |file: &str| message(read_msh(file.as_bytes(), &Limits::default()));
    for (file, expected) in [
        ("", "the file is empty, expected an MSH file of Gmsh"),
        ("\n \n", "the file is empty, expected an MSH file of Gmsh"),
        ("solid", "line 1: expected the beginning of a section such as `$Nodes`, found `solid`"),
        ("$Nodes\n", "line 1: expected section `MeshFormat` first, found `Nodes`"),
        ("$MeshFormat\n4.0 0 8\n", "line 2: version `4.0` is not supported"),
        ("$MeshFormat\n5 0 8\n", "line 2: expected version 2.2 or 4.1, found `5`"),
        ("$MeshFormat\n2.2 2 8\n", "line 2: expected 0 for text or 1 for binary, found `2`"),
        ("$MeshFormat\n2.2 0 4\n", "line 2: expected numbers of 8 bytes, found `4`"),
        ("$MeshFormat\n2.2 0 8 9\n", "line 2: expected the end of the line, found `9`"),
        ("$MeshFormat\n2.2 1 8\nxxxx", "byte 20: expected the number 1 in four bytes, found `xxxx`"),
        ("$MeshFormat\n2.2 0 8\n$End\n", "line 3: expected `$EndMeshFormat`, found `$End`"),
        ("$MeshFormat\n2.2 0 8\n", "line 2: the file ends here, expected `$EndMeshFormat`"),
        ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "line 3: the file ends here, expected section `$Nodes`"),
        ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Odd\n1\n", "line 5: the file ends here, expected `$EndOdd`"),
        (
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Elements\n",
            "line 4: expected `$Nodes` first, found `$Elements`",
        ),
    ] {
        assert_eq!(read(file), expected, "{file}");
    }
    let two = |rest: &str| {
        read(&format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n5 1 0 0\n$EndNodes\n{rest}"))
    };
    for (rest, expected) in [
        ("", "line 8: the file ends here, expected section `$Elements`"),
        ("$Nodes\n", "line 9: expected one section `$Nodes`, found `$Nodes`"),
        ("$Elements\n-1\n", "line 10: expected the number of elements, found -1"),
        ("$Elements\n1\n", "line 10: the file ends here, expected the number of element 1 of the 1 declared"),
        (
            "$Elements\n1\n1 2 2 0 1 1 5 2\n",
            "line 11: expected the number of a node as corner of a triangle, found 2",
        ),
        ("$Elements\n1\n1 77 2 0 1 1 5 2\n", "line 11: element type 77 is not supported"),
        ("$Elements\n1\n1 2 2 0 x\n", "line 11: expected a tag of element 1 of the 1 declared, found `x`"),
        (
            "$Elements\n1\n1 2 2 0 99999999999\n",
            "line 11: expected a tag of element 1 of the 1 declared of 32 bits, found 99999999999",
        ),
        ("$Elements\n4294967296\n", "line 10: more than 4294967295 cells"),
        ("$Elements\n0\n$EndElements\n", "no error"),
    ] {
        assert_eq!(two(rest), expected, "{rest}");
    }
    let data = |body: &str| two(&format!("$Elements\n0\n$EndElements\n$NodeData\n{body}$EndNodeData\n"));
    for (body, expected) in [
        ("1\n\"a\"\n0\n3\n0\n1\n2\n1 0.5\n5 0.25\n", "no error"),
        ("1\n\"a\"\n0\n3\n0\n2\n2\n", "line 18: expected 1, 3 or 9 components, found `others`"),
        ("1\n\"a\"\n0\n2\n0\n1\n", "line 16: expected at least 3 integers of `$NodeData`, found 2"),
        (
            "1\n\"a\"\n0\n3\n0\n1\n1\n2 0.5\n",
            "line 12: expected the numbers of nodes or elements of the mesh, each once, found 2",
        ),
        (
            "1\n\"a\"\n0\n3\n0\n1\n2\n1 0.5\n1 0.5\n",
            "line 12: expected the numbers of nodes or elements of the mesh, each once, found 1 twice",
        ),
    ] {
        assert_eq!(data(body), expected, "{body}");
    }
    let four = |rest: &str| read(&format!("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n{rest}"));
    for (rest, expected) in [
        ("$Nodes\n1 2 1 2\n3 1 0 3\n", "line 6: expected at most 2 nodes of a block, found 3"),
        ("$Nodes\n1 2 1 2\n3 1 0 1\n1\n0 0 0\n", "line 8: expected 2 nodes in blocks, found 1"),
        (
            "$Nodes\n1 2 1 2\n3 1 0 2\n1\n1\n0 0 0\n0 0 0\n$EndNodes\n",
            "line 4: expected nodes with numbers of their own, found 1 twice",
        ),
        (
            "$Entities\n0 0 0 1\n1 0 0\n",
            "line 6: the file ends here, expected the extent of entity 1 of the 1 declared of dimension 3",
        ),
    ] {
        assert_eq!(four(rest), expected, "{rest}");
    }
}

#[test]
fn names_of_groups_say_their_line() {
    let read = |body: &str| {
        let head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n";
        message(read_msh(
            format!("{head}{body}$Nodes\n0\n$EndNodes\n$Elements\n0\n$EndElements\n").as_bytes(),
            &Limits::default(),
        ))
    };
    for (body, expected) in [
        ("1\n2 7 \"a\"\n$EndPhysicalNames\n", "no error"),
        ("x\n", "line 5: expected the number of names of physical groups, found `x`"),
        (
            "1\n4 7 \"a\"\n",
            "line 6: expected the dimension, from 0 to 3, of name 1 of the 1 declared, found 4",
        ),
        ("1\n-2 7 \"a\"\n", "line 6: expected the dimension of name 1 of the 1 declared, found -2"),
        ("1\n2 \"a\"\n", "line 6: expected the physical tag of name 1 of the 1 declared, found `\\\"a\\\"`"),
        ("1\n2 7 a\n", "line 6: expected the quoted text of name 1 of the 1 declared, found `a`"),
        ("1\n2 7 \"\n", "line 6: expected the quoted text of name 1 of the 1 declared, found `\\\"`"),
        ("2\n2 7 \"a\"\n", "line 7: expected the dimension of name 2 of the 2 declared, found `$Nodes`"),
        ("0\n2 7 \"a\"\n", "line 6: expected `$EndPhysicalNames`, found `2 7 \\\"a\\\"`"),
        (
            "0\n$EndPhysicalNames\n$PhysicalNames\n",
            "line 7: expected one section `$PhysicalNames`, found `$PhysicalNames`",
        ),
    ] {
        assert_eq!(read(body), expected, "{body}");
    }
}

#[test]
fn medit_says_the_line() {
    const HEAD: &str = "MeshVersionFormatted 2\nDimension 3\n";
    let read = |file: &str| message(read_medit(file.as_bytes(), &Limits::default()));
    for (file, expected) in [
        ("", "the file is empty, expected MEDIT text"),
        ("# nothing\n", "the file is empty, expected MEDIT text"),
        ("Mesh\n", "line 1: expected `MeshVersionFormatted`, the first word of a MEDIT file, found `Mesh`"),
        ("MeshVersionFormatted x\n", "line 1: expected a version of the format, found `x`"),
        (
            "MeshVersionFormatted 2\nDimension 4\n",
            "line 2: expected dimension 2 or 3, before the vertices, found 4",
        ),
    ] {
        assert_eq!(read(file), expected, "{file}");
    }
    for (rest, expected) in [
        ("", "line 2: the file ends here, expected `End`"),
        ("End\nx\n", "line 4: the file goes on with `x` after the last keyword, `End`"),
        ("7\n", "line 3: expected a keyword such as `Vertices` or `End`, found `7`"),
        (
            "Vertices\n1\n0 0 0\nEnd\n",
            "line 6: expected the reference of vertex 1 of the 1 declared, found `End`",
        ),
        (
            "Vertices\n1\n0 ? 0 0\nEnd\n",
            "line 5: expected the y coordinate of vertex 1 of the 1 declared, found `?`",
        ),
        ("Vertices\n5000000000\n", "line 4: more than 4294967295 vertices"),
        ("Vertices\n0\nVertices\n", "line 5: expected one section of vertices, found `Vertices`"),
        (
            "Vertices\n1\n0 0 0 0\nTriangles 1\n1 1 2 0\nEnd\n",
            "line 7: vertex index 2 is out of range, the file has 1 vertices and counts from 1",
        ),
        (
            "Triangles 1\n1 1 0 0\nEnd\n",
            "line 4: vertex index 0 is out of range, the file has 0 vertices and counts from 1",
        ),
        ("Triangles 1\n1 1\nEnd\n", "line 5: expected corner 3 of triangle 1 of the 1 declared, found `End`"),
    ] {
        assert_eq!(read(&format!("{HEAD}{rest}")), expected, "{rest}");
    }
}

#[test]
fn counts_without_data_take_no_memory() {
    // Each would take tens of gigabytes if counts were believed; they fail where the data ends.
    let huge = u64::from(u32::MAX);
    let vtu = format!(
        "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"{huge}\" NumberOfCells=\"{huge}\"><Points>\
         <DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></Points></Piece></UnstructuredGrid>\
         <AppendedData encoding=\"raw\">_"
    );
    let mut vtu = vtu.into_bytes();
    let header = (huge * 24).to_le_bytes();
    vtu.splice(8..8, b" header_type=\"UInt64\"".iter().copied());
    vtu.extend(header);
    assert!(matches!(read_vtu(&vtu[..], &Limits::default()), Err(ReadError::Truncated { .. })));
    let msh = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{huge}\n1 0 0 0\n");
    assert!(matches!(read_msh(msh.as_bytes(), &Limits::default()), Err(ReadError::Truncated { .. })));
    let mut msh = b"$MeshFormat\n4.1 1 8\n\x01\0\0\0\n$EndMeshFormat\n$Nodes\n".to_vec();
    for number in [1, huge, 1, huge] {
        msh.extend(number.to_le_bytes());
    }
    msh.extend([3_i32, 1, 0].map(i32::to_le_bytes).as_flattened());
    msh.extend(huge.to_le_bytes());
    assert!(matches!(read_msh(&msh[..], &Limits::default()), Err(ReadError::Truncated { .. })));
    let medit = format!("MeshVersionFormatted 2\nDimension 3\nTriangles {huge}\n1 2 3 0\n");
    assert!(matches!(read_medit(medit.as_bytes(), &Limits::default()), Err(ReadError::Truncated { .. })));
}

#[test]
fn limits_are_kept() {
    let limits = Limits { max_vertices: 18, ..Limits::default() };
    let few = Limits { max_cells: 9, ..Limits::default() };
    for (form, file, _) in files() {
        for (limits, what) in [(limits, "18 vertices"), (few, "9 cells")] {
            let result = match form {
                Form::Vtu(_) => read_vtu(&file[..], &limits),
                Form::Msh(..) => read_msh(&file[..], &limits),
                Form::Medit => read_medit(&file[..], &limits),
            };
            let error = result.unwrap_err();
            assert!(matches!(error, ReadError::OverLimit { .. }), "{form:?}: {error}");
            assert!(error.to_string().ends_with(what), "{form:?}: {error}");
        }
    }
}

#[test]
fn forms_are_told_apart() {
    let mesh = stacked_cells();
    let (vtu, _) = Form::Vtu(VtkEncoding::Ascii).write(&mesh, None).unwrap();
    let (msh, _) = Form::Msh(MshVersion::V2, Encoding::Ascii).write(&mesh, None).unwrap();
    assert!(
        read_msh(&vtu[..], &Limits::default()).is_err() && read_vtu(&msh[..], &Limits::default()).is_err()
    );
    for file in [&vtu, &msh] {
        assert!(read_medit(&file[..], &Limits::default()).is_err());
    }
}
