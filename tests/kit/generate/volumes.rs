//! Volumetric meshes as files hold them, of any shape: [`volume_data`]; and one that is a body: [`stacked_cells`].

use crate::entropy::Entropy;
use glam::DVec3;
use welter_meshing::io::{CellGroup, DataField, FieldValues, VolumeData};

/// A number of any bits, or one of the corner cases; finite unless `any`.
fn number(entropy: &mut Entropy<'_>, any: bool) -> f64 {
    let special = [0.0, -0.0, 5e-324, f64::MIN_POSITIVE, f64::MAX, f64::MIN, 0.1, 1e-5, 1e16, 1e300];
    let infinite = [f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    match entropy.below(4) {
        0 => entropy.pick(&special),
        1 if any => entropy.pick(&infinite),
        2 => f64::from(entropy.between(-1000, 1000)) / 7.0,
        _ => Some(f64::from_bits(entropy.word())).filter(|x| any || x.is_finite()).unwrap_or(0.5),
    }
}

fn corners<const N: usize>(entropy: &mut Entropy<'_>, vertices: u8) -> Vec<[u32; N]> {
    let count = if vertices == 0 { 0 } else { entropy.below(5) };
    (0..count).map(|_| std::array::from_fn(|_| u32::from(entropy.below(vertices)))).collect()
}

fn fields(entropy: &mut Entropy<'_>, places: usize, any: bool) -> Vec<DataField<'static>> {
    let names = ["speed", "a name of words", "Ärmel <a & 'b'>", "in \"quotes\"", "x"];
    let count = entropy.below(4);
    let draw = |k: u8| {
        let components = usize::from(entropy.pick(&[1_u8, 3, 1, 2, 9]));
        let length = places * components;
        let values: FieldValues<'static> = match entropy.below(4) {
            0 => (0..length).map(|_| entropy.word() as i32).collect::<Vec<_>>().into(),
            1 => (0..length).map(|_| entropy.word() as i64 >> entropy.below(64)).collect::<Vec<_>>().into(),
            2 => (0..length).map(|_| entropy.byte()).collect::<Vec<_>>().into(),
            _ => (0..length).map(|_| number(entropy, any)).collect::<Vec<_>>().into(),
        };
        DataField::new(names[usize::from(k)], components, values)
    };
    (0..count).map(draw).collect()
}

/// Groups of some of the tags of `body`, and of some that no cell has. Names are all different, also without what formats cannot hold.
fn groups(entropy: &mut Entropy<'_>) -> Vec<CellGroup> {
    let long = "ö, ".repeat(70);
    let names =
        ["x", "two  words ", "Ärmel <a & 'b'>", "in \"quotes\"", "line\nend\t", &long, "", "]]>\\0 #$End"];
    let mut groups = Vec::new();
    for (name, k) in names.into_iter().zip(0..) {
        if entropy.below(3) == 0 {
            // All different: three dimensions and tags, and then others.
            let (dimension, tag) = (2 + k % 2, 1 + k as i32 / 2 * if k > 5 { 70_000_000 } else { 1 });
            groups.push(CellGroup { name: name.to_owned(), field: "body".to_owned(), dimension, tag });
        }
    }
    groups
}

/// A mesh of any cells, fields and groups; with infinities and NaN if `any`. Cells have a field `body` of the numbers from 0 to 3, to
/// which the groups belong.
#[must_use]
pub fn volume_data(entropy: &mut Entropy<'_>, any: bool) -> VolumeData {
    let vertices = entropy.below(12);
    let positions =
        (0..vertices).map(|_| DVec3::from_array(std::array::from_fn(|_| number(entropy, any)))).collect();
    let mut data = VolumeData {
        positions,
        hexahedra: corners(entropy, vertices),
        tetrahedra: corners(entropy, vertices),
        quadrilaterals: corners(entropy, vertices),
        triangles: corners(entropy, vertices),
        ..VolumeData::default()
    };
    let cells = data.cell_count();
    data.point_fields = fields(entropy, usize::from(vertices), any);
    data.cell_fields = fields(entropy, cells, any);
    let bodies: Vec<i32> = (0..cells).map(|_| i32::from(entropy.below(4))).collect();
    data.cell_fields.push(DataField::new("body", 1, bodies));
    data.groups = groups(entropy);
    data
}

/// Four hexahedra side by side, two tetrahedra on top, and some of the surface; every cell of positive size, every kind of field, and
/// names for some of its tags.
/// The coordinates are no short binary fractions.
#[must_use]
pub fn stacked_cells() -> VolumeData {
    let mut positions = Vec::new();
    for k in 0..2 {
        for j in 0..3 {
            for i in 0..3 {
                positions.push(
                    DVec3::new(0.1, 0.7, -0.3)
                        + DVec3::new(0.1, 0.3, 0.7) * DVec3::new(f64::from(i), f64::from(j), f64::from(k)),
                );
            }
        }
    }
    positions.push(DVec3::new(0.15, 0.8, 1.7));
    let node = |i: u32, j: u32, k: u32| i + 3 * j + 9 * k;
    let cell = |n: u32| {
        std::array::from_fn(|c| node(n % 2 + (c as u32 & 1), n / 2 + (c as u32 >> 1 & 1), c as u32 >> 2))
    };
    let (vertices, cells) = (positions.len(), 10);
    let group = |name: &str, dimension, tag| CellGroup {
        name: name.to_owned(),
        field: "body".to_owned(),
        dimension,
        tag,
    };
    VolumeData {
        positions,
        hexahedra: (0..4).map(cell).collect(),
        tetrahedra: vec![[9, 10, 12, 18], [10, 13, 12, 18]],
        quadrilaterals: vec![[0, 3, 4, 1], [1, 4, 5, 2]],
        triangles: vec![[9, 10, 18], [10, 13, 18]],
        point_fields: vec![
            DataField::new(
                "temperature",
                1,
                (0..vertices).map(|v| 0.1 * v as f64 - 1.0 / 3.0).collect::<Vec<_>>(),
            ),
            DataField::new(
                "velocity",
                3,
                (0..3 * vertices).map(|v| 1.0 / (v as f64 + 1.0)).collect::<Vec<_>>(),
            ),
            DataField::new("number", 1, (0..vertices as i64).map(|v| v << 33).collect::<Vec<_>>()),
        ],
        cell_fields: vec![
            DataField::new("body", 1, vec![1, 1, 2, 2, 3, 3, 5, 6, 6, 1]),
            DataField::new("quality", 1, (0..cells).map(|c| f64::from(c) / 7.0).collect::<Vec<_>>()),
            DataField::new("flag", 1, (0..cells as u8).map(|c| 200 + c).collect::<Vec<_>>()),
            DataField::new("direction", 3, (0..3 * cells).map(|c| f64::from(c) / 11.0).collect::<Vec<_>>()),
        ],
        groups: vec![group("steel", 3, 1), group("Ärmel, <links>", 3, 3), group("in 'let' #2", 2, 6)],
    }
}
