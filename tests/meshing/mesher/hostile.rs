//! Hostile input: never a panic; a mesh that passes all checks, or an error that is true.

use std::collections::BTreeMap;

use glam::DVec3;
use welter_kit::mesher::check;
use welter_kit::mesher::hostile::{Soup, soup};
use welter_meshing::Monitor;
use welter_meshing::distance::grid_winding_numbers;
use welter_meshing::grid::Grid3;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh, TriangleSoup};
use welter_meshing::volumetric::{Resolution, VolumeError, VolumeMesh, VolumeParameters, mesh_volume};

fn count(otherwise: u64) -> u64 {
    std::env::var("WELTER_MESHER_SOUPS").ok().map_or(otherwise, |text| text.parse().unwrap())
}

fn parameters(spacing: f64) -> VolumeParameters {
    VolumeParameters {
        resolution: Resolution::Spacing(spacing),
        max_refinements: 0,
        ..VolumeParameters::default()
    }
}

/// What became of a surface: a mesh that passes the checks, or an error. Panics at an error that is not true.
fn outcome(surface: &ClosedOrientedMesh, spacing: f64, positive: bool, name: &str) -> String {
    let error = match mesh_volume(surface, &parameters(spacing), &Monitor::none()) {
        Ok(volume) => {
            let checked = check(surface, &volume).unwrap_or_else(|fault| panic!("{name}: {fault}"));
            return match (checked.odd.is_empty(), checked.forks) {
                (true, 0) => "meshed".into(),
                (true, _) => "meshed, with forks".into(),
                (false, _) => "meshed, too coarse for the characteristic".into(),
            };
        }
        Err(error) => error,
    };
    match error {
        VolumeError::Negative { place, winding } => {
            assert!(!positive, "{name}: no point is of negative depth, but {error}");
            if place.nodes == 0 {
                return "negative between nodes".into();
            }
            // Vertices that no triangle uses do not count.
            let used = || surface.triangles().iter().flatten().map(|v| surface.positions()[v.index()]);
            let around = |f: fn(DVec3, DVec3) -> DVec3| used().reduce(f).unwrap();
            let (low, high) = (around(DVec3::min), around(DVec3::max));
            let grid = Grid3::covering(low.to_array(), high.to_array(), spacing, 1).unwrap();
            let numbers = grid_winding_numbers(surface, &grid, &Monitor::none()).unwrap();
            let so_deep = (0..grid.node_count()).any(|node| {
                let p = grid.position(grid.node_at(node));
                numbers.numbers()[node] == winding && p.cmpge(place.min).all() && p.cmple(place.max).all()
            });
            assert!(so_deep, "{name}: {error}");
            "negative".into()
        }
        VolumeError::UnderResolved { what, .. } => format!("under-resolved: {what}"),
        VolumeError::TooManyCopies { copies, .. } => format!("too many copies: {copies}"),
        VolumeError::TooLarge { .. } => "too large".into(),
        VolumeError::Grid(_) => "no grid".into(),
        error => panic!("{name}: {error}"),
    }
}

fn report(kinds: &BTreeMap<String, Vec<u64>>) {
    for (kind, seeds) in kinds {
        println!("{:6} {kind}, seeds {:?}", seeds.len(), &seeds[..seeds.len().min(6)]);
    }
}

#[test]
fn soups_are_meshed_or_refused_with_reason() {
    let mut kinds: BTreeMap<String, Vec<u64>> = BTreeMap::new();
    for seed in 0..count(300) {
        let Soup { surface, spacing, positive } = soup(seed);
        let kind = outcome(&surface, spacing, positive, &format!("seed {seed}"));
        let kind = format!("{} {kind}", if positive { "positive:" } else { "any:" });
        kinds.entry(kind).or_default().push(seed);
    }
    report(&kinds);
    let positive = |meshed: bool| -> usize {
        let wanted = kinds
            .iter()
            .filter(|(kind, _)| kind.starts_with("positive") && (!meshed || kind.contains("meshed")));
        wanted.map(|(_, seeds)| seeds.len()).sum()
    };
    // The others have edges of so many triangles that the pieces that meet there bound no volume together.
    assert!(10 * positive(true) >= 9 * positive(false), "too few soups are meshed, see above");
}

#[test]
fn tiny_and_huge_coordinates_are_no_danger() {
    let mut kinds: BTreeMap<String, Vec<u64>> = BTreeMap::new();
    for seed in 0..count(40) {
        let Soup { surface, spacing, .. } = soup(seed);
        for (place, scale) in [1e-300, 1e-70, 1e-20, 1e20, 1e70, 1e150].into_iter().enumerate() {
            let scaled = with(&surface, |p| p * scale);
            let kind = outcome(&scaled, spacing * scale, false, &format!("seed {seed}, times {scale:e}"));
            kinds.entry(kind).or_default().push(10 * seed + place as u64);
        }
        // One vertex far away from all others.
        let mut positions = surface.positions().to_vec();
        positions[0] = DVec3::new(1e9, -1e9, 1e9);
        let far = closed(positions, indices(&surface));
        let kind = outcome(&far, spacing, false, &format!("seed {seed}, one vertex far away"));
        kinds.entry(kind).or_default().push(seed);
    }
    report(&kinds);
}

fn indices(mesh: &TriMesh) -> Vec<[u32; 3]> {
    mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect()
}

fn closed(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> ClosedOrientedMesh {
    let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
    ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap()
}

fn with(mesh: &TriMesh, place: impl Fn(DVec3) -> DVec3) -> ClosedOrientedMesh {
    closed(mesh.positions().iter().map(|&p| place(p)).collect(), indices(mesh))
}

fn cube(min: f64, max: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let at = |c: usize| DVec3::from_array([0, 1, 2].map(|axis| if c >> axis & 1 == 1 { max } else { min }));
    let sides = welter_meshing::volumetric::QUADRILATERALS.map(|q| q.map(|c| c as u32));
    let triangles = sides.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    ((0..8).map(at).collect(), triangles)
}

fn mesh(surface: &ClosedOrientedMesh, spacing: f64) -> VolumeMesh {
    let volume = mesh_volume(surface, &parameters(spacing), &Monitor::none()).unwrap();
    check(surface, &volume).unwrap();
    volume
}

#[test]
fn up_to_128_copies_are_meshed_and_more_refused() {
    let (positions, triangles) = cube(0.0, 1.0);
    for copies in [1u32, 2, 3, 17, 64, 127, 128, 129, 130] {
        let (mut p, mut t) = (Vec::new(), Vec::new());
        for copy in 0..copies {
            p.extend(&positions);
            t.extend(triangles.iter().map(|t| t.map(|v| v + 8 * copy)));
        }
        let surface = closed(p, t.clone());
        // The same vertices for all copies: edges with many triangles.
        let shared = closed(positions.clone(), t.iter().map(|t| t.map(|v| v % 8)).collect());
        for surface in [surface, shared] {
            if copies > 128 {
                let error = mesh_volume(&surface, &parameters(0.5), &Monitor::none()).unwrap_err();
                assert!(
                    matches!(error, VolumeError::TooManyCopies { copies: c, .. } if 128 < c && c <= copies),
                    "{error}"
                );
                continue;
            }
            let volume = mesh(&surface, 0.5);
            let alone = mesh(&closed(positions.clone(), triangles.clone()), 0.5);
            assert_eq!(volume.mesh.len(), copies as usize * alone.mesh.len());
            assert_eq!(volume.mesh.nodes().len(), copies as usize * alone.mesh.nodes().len());
        }
    }
}

#[test]
fn one_cell_is_enough() {
    let (positions, triangles) = cube(0.25, 0.75);
    let surface = closed(positions, triangles);
    assert_eq!(mesh(&surface, 1.0).mesh.len(), 1);
    assert_eq!(mesh(&surface, 1e6).mesh.len(), 1);
}

#[test]
fn surfaces_inside_out_are_refused() {
    let (positions, triangles) = cube(0.0, 1.0);
    let surface = closed(positions, triangles.iter().map(|&[a, b, c]| [a, c, b]).collect());
    for spacing in [0.25, 0.3, 0.9] {
        assert_eq!(outcome(&surface, spacing, false, "inside out"), "negative");
    }
}

#[test]
fn shells_within_shells_keep_their_chambers() {
    let ball = |radius: f64, shift: f64| {
        let sphere = sphere(&Sphere { radius, ..Sphere::default() }).unwrap();
        with(&sphere, |p| p + DVec3::splat(shift))
    };
    let turned = |mesh: ClosedOrientedMesh| {
        closed(mesh.positions().to_vec(), indices(&mesh).iter().map(|&[a, b, c]| [a, c, b]).collect())
    };
    let (mut p, mut t) = (Vec::new(), Vec::new());
    for part in
        [ball(1.0, 0.0), turned(ball(0.7, 0.01)), ball(0.4, 0.0), ball(1.0, 0.125), turned(ball(0.7, 0.13))]
    {
        let shift = p.len() as u32;
        p.extend(part.positions());
        t.extend(indices(&part).iter().map(|t| t.map(|v| v + shift)));
    }
    let surface = closed(p, t);
    let volume = mesh(&surface, 0.1);
    let complex = welter_kit::mesher::Complex::of_mesh(&volume.mesh);
    let mut characteristics = complex.characteristics;
    characteristics.sort_unstable();
    // Two shells, each of two spheres, and a ball: the chambers are told apart although the shells overlap.
    assert_eq!(characteristics, [1, 2, 2]);
}

#[test]
fn double_sheets_have_no_volume() {
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE];
    for sheet in [vec![[0, 1, 2], [1, 0, 2]], vec![[0, 1, 2], [1, 3, 2], [1, 0, 2], [3, 1, 2]]] {
        let surface = closed(positions.clone(), sheet);
        println!("{}", outcome(&surface, 0.25, true, "double sheet"));
    }
}
