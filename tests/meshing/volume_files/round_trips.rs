//! What is written comes back bit for bit, but for what the report names.

use super::{FORMS, Form, text};
use welter_kit::entropy::{Entropy, stream};
use welter_kit::generate::volumes::{stacked_cells, volume_data};
use welter_meshing::DVec3;
use welter_meshing::io::{
    CellGroup, DataField, Dropped, Encoding, FieldLoss, FieldValues, MeditOptions, MshOptions, VolumeData,
    VolumeView, VtkEncoding, WriteError, write_medit, write_msh, write_vtu,
};

/// A field as f64.
fn real(field: &DataField<'static>) -> DataField<'static> {
    let values = match &field.values {
        FieldValues::Int32(values) => values.iter().map(|&v| f64::from(v)).collect::<Vec<_>>().into(),
        FieldValues::Int64(values) => values.iter().map(|&v| v as f64).collect::<Vec<_>>().into(),
        FieldValues::UInt8(values) => values.iter().map(|&v| f64::from(v)).collect::<Vec<_>>().into(),
        other => other.clone(),
    };
    DataField { values, ..field.clone() }
}

/// What MSH keeps of fields, with what it loses.
fn kept_by_msh(fields: &[DataField<'static>], lost: &mut Vec<Dropped>) -> Vec<DataField<'static>> {
    let mut kept = Vec::new();
    for field in fields {
        let loss = match &field.values {
            _ if field.name.contains('"') => Some(FieldLoss::Name),
            _ if field.components == 2 => Some(FieldLoss::Everything),
            FieldValues::Float64(_) => None,
            // An integer is exact as f64 where it survives the way there and back.
            FieldValues::Int64(values)
                if values
                    .iter()
                    .any(|&v| v as f64 as i128 != i128::from(v) || v.unsigned_abs() > 1 << 53) =>
            {
                Some(FieldLoss::Precision)
            }
            _ => Some(FieldLoss::Type),
        };
        if !matches!(loss, Some(FieldLoss::Name | FieldLoss::Everything)) {
            kept.push(real(field));
        }
        lost.extend(loss.map(|loss| Dropped::Field { name: field.name.to_string(), loss }));
    }
    kept
}

/// What MSH keeps of groups of the field `body`, whose names are all different, with what it loses.
fn groups_kept_by_msh(groups: &[CellGroup], lost: &mut Vec<Dropped>) -> Vec<CellGroup> {
    let (mut kept, mut changed) = (Vec::new(), 0);
    for group in groups.iter().filter(|group| !group.name.is_empty()) {
        let mut name = group.name.replace('"', "'").replace(['\n', '\t'], " ");
        while name.len() > 127 {
            name.pop();
        }
        changed += usize::from(name != group.name);
        kept.push(CellGroup { name, field: "gmsh:physical".to_owned(), ..group.clone() });
    }
    lost.extend((changed > 0).then_some(Dropped::GroupNames { count: changed }));
    let count = groups.len() - kept.len();
    lost.extend((count > 0).then_some(Dropped::NamesOfTags { count }));
    kept
}

/// What a form keeps of a mesh whose field `body` is its tags, and what the report must name.
fn kept(form: Form, mesh: &VolumeData) -> (VolumeData, Vec<Dropped>) {
    let (mut kept, mut lost) = (mesh.clone(), Vec::new());
    let body = mesh.cell_fields.last().unwrap();
    let FieldValues::Int32(tags) = &body.values else { panic!("tags are integers") };
    let tagged = tags.iter().any(|&tag| tag != 0);
    let (others, _) = mesh.cell_fields.split_at(mesh.cell_fields.len() - 1);
    let renamed = Dropped::Field { name: "body".to_owned(), loss: FieldLoss::Renamed };
    let as_tags = |name: &'static str| tagged.then(|| DataField::new(name, 1, tags.to_vec()));
    match form {
        Form::Vtu(_) => {
            let with_control = |group: &&mut CellGroup| group.name.contains(char::is_control);
            let mut count = 0;
            for group in kept.groups.iter_mut().filter(with_control) {
                group.name = group.name.replace(['\n', '\t'], " ");
                count += 1;
            }
            lost.extend((count > 0).then_some(Dropped::GroupNames { count }));
        }
        Form::Msh(..) => {
            kept.point_fields = kept_by_msh(&mesh.point_fields, &mut lost);
            kept.cell_fields = as_tags("gmsh:physical").into_iter().collect();
            kept.cell_fields.extend(kept_by_msh(others, &mut lost));
            lost.push(renamed);
            kept.groups = groups_kept_by_msh(&mesh.groups, &mut lost);
        }
        Form::Medit => {
            kept.point_fields.clear();
            kept.groups.clear();
            kept.cell_fields = as_tags("medit:ref").into_iter().collect();
            let all = mesh.point_fields.iter().chain(others);
            lost.extend(
                all.map(|f| Dropped::Field { name: f.name.to_string(), loss: FieldLoss::Everything }),
            );
            lost.push(renamed);
            lost.extend(
                (!mesh.groups.is_empty()).then_some(Dropped::NamesOfTags { count: mesh.groups.len() }),
            );
        }
    }
    (kept, lost)
}

fn check(form: Form, mesh: &VolumeData) {
    let (file, report) = form.write(mesh, Some("body")).unwrap();
    let (back, read_report) = form.read(&file).unwrap_or_else(|error| panic!("{form:?}: {error}: {mesh:?}"));
    let (kept, lost) = kept(form, mesh);
    assert_eq!(text(&back), text(&kept), "{form:?}");
    assert_eq!(report.dropped, lost, "{form:?}");
    assert_eq!(read_report.ignored, [], "{form:?}");
    // What was read is written the same.
    let tags = back.cell_fields.first().map(|field| field.name.to_string());
    let tags = tags.filter(|name| matches!(name.as_str(), "gmsh:physical" | "medit:ref"));
    let (again, report) = form.write(&back, tags.as_deref()).unwrap();
    if matches!(form, Form::Msh(..)) && tags.is_none() && !back.groups.is_empty() {
        // No cell has a tag, so there is no field of them to which names could belong.
        assert_eq!(report.dropped, [Dropped::NamesOfTags { count: back.groups.len() }], "{form:?}");
        return;
    }
    assert!(
        again == file || form == Form::Vtu(VtkEncoding::Ascii) && text(&back).contains("NaN"),
        "{form:?}"
    );
    assert_eq!(report.dropped, [], "{form:?}");
}

#[test]
fn meshes_come_back_bit_for_bit() {
    for seed in 0..150 {
        let bytes = stream(seed, 6000);
        for any in [false, true] {
            let mesh = volume_data(&mut Entropy::new(&bytes), any);
            FORMS.into_iter().for_each(|form| check(form, &mesh));
        }
    }
    let mut mesh = stacked_cells();
    mesh.cell_fields.rotate_left(1); // the tags are to be last
    FORMS.into_iter().for_each(|form| check(form, &mesh));
    let mut empty = VolumeData::default();
    empty.cell_fields.push(DataField::new("body", 1, Vec::<i32>::new()));
    FORMS.into_iter().for_each(|form| check(form, &empty));
}

#[test]
fn nan_keeps_its_bits_in_binary() {
    let odd =
        [f64::from_bits(0x7ff8_dead_beef_0001), f64::from_bits(0xfff4_0000_0000_0001), f64::NEG_INFINITY];
    let mesh = VolumeData {
        positions: vec![DVec3::from_array(odd)],
        point_fields: vec![DataField::new("a", 3, odd.to_vec())],
        ..VolumeData::default()
    };
    for form in FORMS {
        let binary = matches!(
            form,
            Form::Vtu(VtkEncoding::Appended | VtkEncoding::Base64) | Form::Msh(_, Encoding::Binary)
        );
        if binary {
            let (back, _) = form.read(&form.write(&mesh, None).unwrap().0).unwrap();
            let FieldValues::Float64(values) = &back.point_fields[0].values else { panic!("{form:?}") };
            assert_eq!(back.positions[0].to_array().map(f64::to_bits), odd.map(f64::to_bits), "{form:?}");
            assert_eq!(
                values.iter().map(|v| v.to_bits()).collect::<Vec<_>>(),
                odd.map(f64::to_bits),
                "{form:?}"
            );
        }
    }
}

#[test]
fn many_cells_go_through_every_buffer() {
    let side = 21_u32;
    let node = |i: u32, j: u32, k: u32| i + (side + 1) * (j + (side + 1) * k);
    let mut mesh = VolumeData::default();
    for v in 0..(side + 1).pow(3) {
        let [i, j, k] = [v % (side + 1), v / (side + 1) % (side + 1), v / (side + 1).pow(2)];
        mesh.positions.push(DVec3::new(f64::from(i), f64::from(j), f64::from(k)) / 3.0);
    }
    for c in 0..side.pow(3) {
        let [i, j, k] = [c % side, c / side % side, c / side.pow(2)];
        mesh.hexahedra.push(std::array::from_fn(|n| {
            node(i + (n as u32 & 1), j + (n as u32 >> 1 & 1), k + (n as u32 >> 2))
        }));
    }
    let cells = mesh.hexahedra.len();
    mesh.cell_fields.push(DataField::new("body", 1, (0..cells as i32).map(|c| c / 1000).collect::<Vec<_>>()));
    FORMS.into_iter().for_each(|form| check(form, &mesh));
}

#[test]
fn meshes_that_do_not_fit_are_refused_before_the_first_byte() {
    let mut outside = stacked_cells();
    outside.tetrahedra[1][2] = 19;
    let mut short = stacked_cells();
    short.cell_fields[1] = DataField::new("quality", 1, vec![0.5; 9]);
    let mut twice = stacked_cells();
    twice.point_fields[1].name = "temperature".into();
    for (mesh, message) in [
        (outside, "tetrahedron 1 names vertex 19, there are 19 vertices"),
        (short, "array \"quality\" has 9 numbers, 1 for each of 10 places are needed"),
        (twice, "the array name \"temperature\" is given twice"),
    ] {
        for form in FORMS {
            assert_eq!(form.write(&mesh, None).unwrap_err().to_string(), message, "{form:?}");
        }
    }
    let mut mesh = stacked_cells();
    for form in FORMS.into_iter().filter(|form| !matches!(form, Form::Vtu(_))) {
        for name in ["none", "quality", "direction"] {
            let error = form.write(&mesh, Some(name)).unwrap_err();
            assert!(matches!(error, WriteError::NoTags { .. }), "{form:?} {name}");
        }
    }
    mesh.cell_fields[0] = DataField::new("body", 1, vec![0, 1, 2, 3, 4, 5, 6, 7, -8, 9]);
    for form in FORMS.into_iter().filter(|form| matches!(form, Form::Msh(..))) {
        let error = form.write(&mesh, Some("body")).unwrap_err();
        assert_eq!(error.to_string(), "cell 8 has the tag -8, beyond 0 to 2147483646");
    }
}

/// A writer that takes some bytes and then fails.
struct Full(usize);

impl std::io::Write for Full {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let taken = bytes.len().min(self.0);
        self.0 -= taken;
        if taken == 0 { Err(std::io::ErrorKind::StorageFull.into()) } else { Ok(taken) }
    }
    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_wherever_it_happens() {
    let mesh = stacked_cells();
    mesh.with_view(|view: &VolumeView<'_>| {
        for room in (0..1500).step_by(7) {
            for encoding in [VtkEncoding::Appended, VtkEncoding::Base64, VtkEncoding::Ascii] {
                assert!(matches!(write_vtu(Full(room), view, encoding), Err(WriteError::Io(_))));
            }
            assert!(matches!(write_msh(Full(room), view, &MshOptions::default()), Err(WriteError::Io(_))));
        }
        for room in (0..500).step_by(3) {
            assert!(matches!(
                write_medit(Full(room), view, &MeditOptions::default()),
                Err(WriteError::Io(_))
            ));
        }
    });
}
