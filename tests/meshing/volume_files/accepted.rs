//! Files as other programs write them: other number types and orders, gaps, cells and sections that are passed over.

use welter_meshing::DVec3;
use welter_meshing::io::{
    DataField, FieldValues, Limits, ReadReport, VolumeData, read_medit, read_msh, read_vtu,
};

fn ignored(report: &ReadReport) -> Vec<(&str, u64)> {
    report.ignored.iter().map(|ignored| (ignored.what.as_str(), ignored.count)).collect()
}

fn field<'a>(fields: &'a [DataField<'static>], name: &str) -> &'a FieldValues<'static> {
    &fields.iter().find(|field| field.name == name).unwrap().values
}

#[test]
fn vtu_of_every_cell_type_and_number_type() {
    let file = br#"<?xml version="1.0"?>
<!-- by hand -->
<VTKFile type='UnstructuredGrid' version='0.1' byte_order='LittleEndian'>
  <UnstructuredGrid>
    <FieldData><DataArray type="String" Name="note" NumberOfTuples="1" format="ascii">1 2 3</DataArray></FieldData>
    <Piece NumberOfPoints="8" NumberOfCells="5">
      <Cells>
        <DataArray type="UInt8" Name="types" format="ascii">5 11 13 8 1</DataArray>
        <DataArray type="Int64" Name="connectivity" format="ascii" RangeMin="0" RangeMax="7">
          0 1 2   0 1 2 3 4 5 6 7   0 1 2 3 4 5   0 1 2 3   7
          <InformationKey name="L2" location="vtkDataArray" length="1"><Value index="0">7</Value></InformationKey>
        </DataArray>
        <DataArray type="UInt32" Name="offsets" format="ascii">3 11 17 21 22</DataArray>
      </Cells>
      <CellData>
        <DataArray type="Int16" Name="a" format="ascii">1 2 3 4 5</DataArray>
        <DataArray type="UInt64" Name="b" NumberOfComponents="2" format="ascii">1 2 3 4 5 6 7 8 9 10</DataArray>
      </CellData>
      <PointData Scalars="c">
        <DataArray type="Float32" Name="c" format="ascii">0 1 2 3 4 5 6 0.1</DataArray>
      </PointData>
      <Points>
        <DataArray type="Float32" NumberOfComponents="3" format="binary">
          YAAAAA==AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAAAAAAAAAAAAAAAIA/AACA
          PwAAAAAAAIA/AAAAAAAAgD8AAIA/AACAPwAAgD8AAIA/
        </DataArray>
      </Points>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
"#;
    let (mesh, report) = read_vtu(&file[..], &Limits::default()).unwrap();
    assert_eq!(mesh.positions[7], DVec3::ONE);
    assert_eq!(mesh.positions[5], DVec3::new(1.0, 0.0, 1.0));
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    // A voxel has our order; a pixel goes around in ours.
    assert_eq!(mesh.hexahedra, [[0, 1, 2, 3, 4, 5, 6, 7]]);
    assert_eq!(mesh.quadrilaterals, [[0, 1, 3, 2]]);
    assert_eq!(field(&mesh.cell_fields, "a"), &FieldValues::from(vec![2, 4, 1]));
    assert_eq!(field(&mesh.cell_fields, "b"), &FieldValues::from(vec![3_i64, 4, 7, 8, 1, 2]));
    let FieldValues::Float64(c) = field(&mesh.point_fields, "c") else { panic!("real numbers") };
    assert_eq!(c[7], 0.1);
    assert_eq!(ignored(&report), [("field data", 1), ("wedges", 1), ("point cells", 1)]);
}

#[test]
fn vtu_big_endian_and_appended_base64() {
    let read = |byte_order: &str, encoding: &str, appended: &[u8]| {
        let mut file = format!(
            "<VTKFile type=\"UnstructuredGrid\" byte_order=\"{byte_order}\" header_type=\"UInt32\"><UnstructuredGrid>\
             <Piece NumberOfPoints=\"1\" NumberOfCells=\"0\">\
             <PointData><DataArray type=\"Int16\" Name=\"a\" format=\"appended\" offset=\"0\"/></PointData>\
             <Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"appended\" offset=\"8\"/></Points>\
             </Piece></UnstructuredGrid><AppendedData encoding=\"{encoding}\">  _"
        )
        .into_bytes();
        file.extend(appended);
        file.extend(b"</AppendedData></VTKFile>");
        read_vtu(&file[..], &Limits::default()).unwrap().0
    };
    let mut raw = vec![0, 0, 0, 2, 1, 2, 9, 9, 0, 0, 0, 12];
    raw.extend([1.0_f32, 2.0, -0.5].map(f32::to_be_bytes).as_flattened());
    let expected = VolumeData {
        positions: vec![DVec3::new(1.0, 2.0, -0.5)],
        point_fields: vec![DataField::new("a", 1, vec![258])],
        ..VolumeData::default()
    };
    assert_eq!(read("BigEndian", "raw", &raw), expected);
    // AgAAAAIB: length 2, bytes 2 and 1; the second block begins at the eighth character.
    assert_eq!(read("LittleEndian", "base64", b"AgAAAAIBDAAAAAAAgD8AAABAAAAAvw=="), expected);
}

#[test]
fn vtu_groups_among_other_field_data() {
    let array =
        |kind: &str, name: &str, rest: &str| format!("<DataArray type=\"{kind}\" Name=\"{name}\" {rest}");
    let field_data = [
        array("Int32", "tag:in &amp; out", "format=\"appended\" offset=\"0\"/>"),
        array("UInt8", "gmsh:physical:a:b", "format=\"ascii\">7 3 9 2 7 3</DataArray>"),
        // Of no field on cells, of real numbers, of other dimensions, not in pairs, without a name of a field, text.
        array("Int32", "other:a", "format=\"ascii\">1 2</DataArray>"),
        array("Float64", "tag:b", "format=\"ascii\">1 2</DataArray>"),
        array("Int32", "tag:c", "format=\"ascii\">2 1</DataArray>"),
        array("Int32", "tag:d", "format=\"ascii\">2</DataArray>"),
        array("Int32", "tags", "format=\"ascii\">5 2</DataArray>"),
        array("String", "tag:e", "format=\"ascii\">97 0</DataArray>"),
    ];
    let fields =
        ["tag", "gmsh:physical", "gmsh"].map(|name| array("Int32", name, "format=\"ascii\"></DataArray>"));
    let mut file = format!(
        "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><FieldData>{}</FieldData>\
         <Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"><CellData>{}</CellData><Points>\
         <DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\"></DataArray></Points></Piece>\
         </UnstructuredGrid><AppendedData encoding=\"raw\">_",
        field_data.concat(),
        fields.concat()
    )
    .into_bytes();
    file.extend([8, 7 + 256, 2].map(u32::to_le_bytes).as_flattened());
    file.extend(b"</AppendedData></VTKFile>");
    let (mesh, report) = read_vtu(&file[..], &Limits::default()).unwrap();
    let groups: Vec<_> = mesh.groups.iter().map(|g| (&*g.name, &*g.field, g.dimension, g.tag)).collect();
    assert_eq!(
        groups,
        [("in & out", "tag", 2, 263), ("a:b", "gmsh:physical", 3, 7), ("a:b", "gmsh:physical", 2, 9)]
    );
    assert_eq!(ignored(&report), [("field data", 6), ("further names of a tag", 1)]);
}

#[test]
fn msh_with_gaps_and_mixed_elements() {
    let file = b"$Comments\nby hand\n$EndComments\n$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
        $PhysicalNames\n6\n3 6 \"steel\"\n2 4   \"a \"b\" c \" \n1 1 \"edge\"\n3 6 \"iron\"\n2 0 \"no tag\"\n3 9 \"\"\n\
        $EndPhysicalNames\n\
        $Nodes\n5\n10 0 0 0\n3 1 0 0\n7 0 1 0\n100 0 0 1\n1 9 9 9\n$EndNodes\n\
        $Elements\n4\n5 15 2 0 1 10\n9 2 2 4 8 10 3 7\n2 4 3 6 8 77 10 3 7 100\n3 1 2 0 1 10 3\n$EndElements\n\
        $NodeData\n2\n\"t\"\n\"scheme\"\n1\n0.5\n4\n0\n1\n3\n0\n100 1\n10 2\n3 3\n$EndNodeData\n\
        $NodeData\n1\n\"t\"\n1\n1.5\n3\n1\n1\n1\n100 1\n$EndNodeData\n\
        $ElementData\n1\n\"v\"\n0\n3\n0\n3\n3\n5 1 1 1\n2 2 2 3\n9 4 5 6\n$EndElementData\n";
    let (mesh, report) = read_msh(&file[..], &Limits::default()).unwrap();
    assert_eq!((&mesh.tetrahedra[..], &mesh.triangles[..]), (&[[0, 1, 2, 3]][..], &[[0, 1, 2]][..]));
    assert_eq!(field(&mesh.cell_fields, "gmsh:physical"), &FieldValues::from(vec![6, 4]));
    assert_eq!(field(&mesh.cell_fields, "gmsh:geometrical"), &FieldValues::from(vec![8, 8]));
    let groups: Vec<_> = mesh.groups.iter().map(|g| (&*g.name, &*g.field, g.dimension, g.tag)).collect();
    let physical = "gmsh:physical";
    assert_eq!(groups, [("steel", physical, 3, 6), ("a \"b\" c ", physical, 2, 4), ("", physical, 3, 9)]);
    assert_eq!(field(&mesh.cell_fields, "v"), &FieldValues::from(vec![2.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
    let FieldValues::Float64(t) = field(&mesh.point_fields, "t") else { panic!("real numbers") };
    assert_eq!(t[..2], [2.0, 3.0]);
    assert!(t[2].is_nan() && t[3] == 1.0 && t[4].is_nan());
    assert_eq!(
        ignored(&report),
        [
            ("names of points and curves", 1),
            ("further names of a tag", 1),
            ("names of tags that cells cannot have", 1),
            ("point elements", 1),
            ("further tags of elements", 1),
            ("line elements", 1),
            ("data of a name given before", 1),
            ("no value at some places, which is read as NaN", 1)
        ]
    );
}

#[test]
fn msh_four_with_parameters_and_big_endian() {
    let text = b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 1 0\n1 0 0 0 0\n4 0 0 0 1 1 0 2 9 8 1 1\n$EndEntities\n\
        $Nodes\n2 3 1 3\n0 1 0 1\n2\n0 0 0\n2 4 1 2\n1\n3\n1 0 0 0.5 0.5\n0 1 0 0.25 0.5\n$EndNodes\n\
        $Elements\n2 2 1 2\n0 1 15 1\n1 2\n2 4 2 1\n2 2 1 3\n$EndElements\n$Periodic\n0\n$EndPeriodic\n";
    let (mesh, report) = read_msh(&text[..], &Limits::default()).unwrap();
    assert_eq!(mesh.positions, [DVec3::ZERO, DVec3::X, DVec3::Y]);
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert_eq!(field(&mesh.cell_fields, "gmsh:physical"), &FieldValues::from(vec![9]));
    assert_eq!(
        ignored(&report),
        [("further physical tags of entities", 1), ("point elements", 1), ("`$Periodic`", 1)]
    );

    // The same mesh in big-endian binary with counts of four bytes.
    let mut file = b"$MeshFormat\n4.1 1 4\n\0\0\0\x01\n$EndMeshFormat\n$Periodic\n\x01\n$\xff$End\n$EndPeriodic\n$Nodes\n".to_vec();
    let mut numbers = |numbers: &[i32]| file.extend(numbers.iter().flat_map(|number| number.to_be_bytes()));
    numbers(&[1, 3, 1, 3, 2, 4, 0, 3, 2, 1, 3]);
    file.extend(mesh.positions.iter().flat_map(|p| p.to_array()).flat_map(f64::to_be_bytes));
    file.extend(b"\n$EndNodes\n$Elements\n");
    let mut numbers = |numbers: &[i32]| file.extend(numbers.iter().flat_map(|number| number.to_be_bytes()));
    numbers(&[1, 1, 1, 1, 2, 4, 2, 1, 1, 2, 1, 3]);
    file.extend(b"\n$EndElements\n");
    let (again, _) = read_msh(&file[..], &Limits::default()).unwrap();
    assert_eq!((&again.positions, &again.triangles), (&mesh.positions, &mesh.triangles));
}

#[test]
fn sparse_data_is_not_filled_up() {
    let mut file = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n64\n");
    (1..=64).for_each(|k| file += &format!("{k} {k} 0 0\n"));
    file += "$EndNodes\n$Elements\n0\n$EndElements\n";
    let data = |name: &str, count: u32| {
        let rows: String = (1..=count).map(|k| format!("{k} 0.5\n")).collect();
        format!("$NodeData\n1\n\"{name}\"\n0\n3\n0\n1\n{count}\n{rows}$EndNodeData\n")
    };
    file += &(data("few", 3) + &data("enough", 4));
    let (mesh, report) = read_msh(file.as_bytes(), &Limits::default()).unwrap();
    assert_eq!(mesh.point_fields.len(), 1);
    assert_eq!(mesh.point_fields[0].name, "enough");
    assert_eq!(
        ignored(&report),
        [("data at few places", 1), ("no value at some places, which is read as NaN", 1)]
    );
}

#[test]
fn medit_with_comments_other_sections_and_two_dimensions() {
    let file = b"# by hand\nMeshVersionFormatted 1 Dimension\n2\nHexaedra 0\nTriangles 1 # one\n1 2\n3 4\n\
        Edges\n2\n1 2 0\n2 3 0\nOdd 1\n0.5 nan\nVertices 3 0 0 0\n1 0 0 0 1 7\nEnd\n";
    let (mesh, report) = read_medit(&file[..], &Limits::default()).unwrap();
    assert_eq!(mesh.positions, [DVec3::ZERO, DVec3::X, DVec3::Y]);
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert_eq!(mesh.point_fields, [DataField::new("medit:ref", 1, vec![0, 0, 7])]);
    assert_eq!(mesh.cell_fields, [DataField::new("medit:ref", 1, vec![4])]);
    assert_eq!(ignored(&report), [("`Edges`", 1), ("sections of other kinds", 1)]);
}
