//! Tests of `welter_meshing::io`: round trips bit for bit, malformed input with its place, truncation and corruption at
//! every byte, real files.

mod accepted;
mod malformed;
mod peer;
mod polygons;
mod vti;

use proptest::prelude::*;
use welter_meshing::DVec3;
use welter_meshing::io::{
    self, Dropped, Encoding, Format, Limits, ReadError, WriteError, WriteOptions, WriteReport,
};
use welter_meshing::surface::{Group, TriangleSoup};

const ASCII: WriteOptions = WriteOptions { encoding: Encoding::Ascii };
const BINARY: WriteOptions = WriteOptions { encoding: Encoding::Binary };

/// Every format with every encoding it has.
const PAIRS: [(Format, WriteOptions); 6] = [
    (Format::Obj, ASCII),
    (Format::Off, ASCII),
    (Format::Ply, ASCII),
    (Format::Ply, BINARY),
    (Format::Stl, ASCII),
    (Format::Stl, BINARY),
];

fn read(format: Format, file: impl AsRef<[u8]>) -> Result<TriangleSoup, ReadError> {
    io::read(format, file.as_ref(), &Limits::default())
}

fn written(format: Format, soup: &TriangleSoup, options: &WriteOptions) -> (Vec<u8>, WriteReport) {
    let mut file = Vec::new();
    let report = io::write(format, &mut file, soup, options).expect("the soup can be written");
    (file, report)
}

fn bits(positions: &[DVec3]) -> Vec<[u64; 3]> {
    positions.iter().map(|p| p.to_array().map(f64::to_bits)).collect()
}

/// A coordinate of any finite bits, or one of the corner cases.
fn coordinate() -> impl Strategy<Value = f64> {
    let special = [
        0.0,
        -0.0,
        5e-324,
        -2.225073858507201e-308,
        f64::MIN_POSITIVE,
        1e308,
        f64::MAX,
        f64::MIN,
        0.1,
        1e-5,
        1e16,
    ];
    prop_oneof![
        any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite()),
        prop::sample::select(special.to_vec()),
        -1e3..1e3_f64,
    ]
}

/// Any soup that a TriMesh could be made of, with groups and colours.
fn soup() -> impl Strategy<Value = TriangleSoup> {
    let position = [coordinate(), coordinate(), coordinate()].prop_map(DVec3::from_array);
    (
        prop::collection::vec(position, 3..40),
        prop::collection::vec(any::<[u32; 3]>(), 0..60),
        any::<bool>(),
        any::<[u8; 6]>(),
    )
        .prop_map(|(positions, seeds, colored, cuts)| {
            let n = positions.len() as u32;
            let triangles: Vec<_> = seeds.iter().map(|t| t.map(|i| i % n)).collect();
            let count = triangles.len() as u32;
            let mut cuts = cuts.map(|c| u32::from(c) % (count + 1));
            cuts.sort_unstable();
            let names = ["wing", "a name of words", "Ärmel #3"];
            let groups = (0..3)
                .map(|k| Group { name: names[k].to_owned(), triangles: cuts[2 * k]..cuts[2 * k + 1] })
                .collect();
            let color = |t: &[u32; 3]| t.map(|i| (i * 37 % 256) as u8);
            let triangle_colors = if colored { triangles.iter().map(color).collect() } else { Vec::new() };
            TriangleSoup { positions, triangles, groups, triangle_colors }
        })
}

/// What a format keeps of a soup, and what its report must name.
fn kept(format: Format, soup: &TriangleSoup) -> (TriangleSoup, bool, bool) {
    let groups = matches!(format, Format::Obj);
    let colors = matches!(format, Format::Ply | Format::Off);
    let mut kept = soup.clone();
    if !groups {
        kept.groups.clear();
    }
    if !colors {
        kept.triangle_colors.clear();
    }
    (kept, groups, colors)
}

proptest! {
    #[test]
    fn indexed_formats_give_the_same_bits_back(soup in soup()) {
        for (format, options) in PAIRS.into_iter().filter(|(format, _)| *format != Format::Stl) {
            let (file, report) = written(format, &soup, &options);
            let (kept, groups, colors) = kept(format, &soup);
            let back = read(format, &file).unwrap();
            prop_assert_eq!(bits(&back.positions), bits(&kept.positions));
            prop_assert_eq!(&back, &kept);
            let lost = |d: &Dropped| matches!(d, Dropped::Groups { .. });
            prop_assert_eq!(report.dropped.iter().any(lost), !groups && !soup.groups.is_empty());
            let lost = |d: &Dropped| matches!(d, Dropped::TriangleColors { .. });
            prop_assert_eq!(report.dropped.iter().any(lost), !colors && !soup.triangle_colors.is_empty());
            prop_assert_eq!(written(format, &back, &options).0, written(format, &kept, &options).0);
        }
    }

    #[test]
    fn stl_text_gives_the_same_corners_back(soup in soup()) {
        let (file, report) = written(Format::Stl, &soup, &ASCII);
        let back = read(Format::Stl, &file).unwrap();
        let corners = |s: &TriangleSoup| -> Vec<_> {
            // + 0.0: welding takes -0 and 0 for one
            s.triangles.iter().map(|t| t.map(|i| (s.positions[i as usize] + DVec3::ZERO).to_array().map(f64::to_bits))).collect()
        };
        prop_assert_eq!(corners(&back), corners(&soup));
        prop_assert_eq!(&back.groups, &soup.groups);
        let exact = back.positions.len() == soup.positions.len() && back.triangles == soup.triangles;
        prop_assert_eq!(exact, report.dropped.iter().all(|d| matches!(d, Dropped::TriangleColors { .. })));
        // what was read from STL comes back as it is
        let (again, report) = written(Format::Stl, &back, &ASCII);
        prop_assert_eq!(&read(Format::Stl, &again).unwrap(), &back);
        prop_assert!(report.dropped.is_empty());
    }

    #[test]
    fn stl_binary_gives_corners_in_single_precision(soup in soup()) {
        let mut file = Vec::new();
        let beyond = soup.positions.iter().any(|p| !p.as_vec3().is_finite());
        match io::write(Format::Stl, &mut file, &soup, &BINARY) {
            Err(WriteError::BeyondSinglePrecision { .. }) => prop_assert!(beyond && file.is_empty()),
            Err(other) => prop_assert!(false, "{other}"),
            Ok(report) => {
                prop_assert!(!beyond);
                let back = read(Format::Stl, &file).unwrap();
                for (t, u) in soup.triangles.iter().zip(&back.triangles) {
                    for (i, j) in t.iter().zip(u) {
                        prop_assert_eq!(soup.positions[*i as usize].as_vec3().as_dvec3(), back.positions[*j as usize]);
                    }
                }
                prop_assert_eq!(back.triangles.len(), soup.triangles.len());
                let moved = soup.positions.iter().filter(|p| p.as_vec3().as_dvec3() != **p).count();
                let told = report.dropped.contains(&Dropped::CoordinatePrecision { vertices: moved });
                prop_assert_eq!(told, moved > 0);
            }
        }
    }
}
