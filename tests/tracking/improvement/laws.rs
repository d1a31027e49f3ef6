//! What holds for every surface and every choice of parameters.

use super::{check, edge_lengths, improve, mapped, together, tracker, volume};
use glam::DVec3;
use welter_kit::mesher::Random;
use welter_kit::surface::{closed_surfaces, open_surfaces};
use welter_meshing::shapes::{Box_, Sphere, Torus, box_, sphere, torus};
use welter_meshing::surface::{Topology, TriMesh, TriangleSoup};
use welter_tracking::improvement::{
    CurvatureAdaption, ImprovementParameters, SplitScheme, TopologyParameters,
};
use welter_tracking::tracker::TrackerParameters;

fn unit_sphere(edge_length: f64) -> TriMesh {
    sphere(&Sphere { edge_length, ..Sphere::default() }).unwrap().into_mesh()
}

fn without_topology(length: f64) -> TrackerParameters {
    let topology = TopologyParameters { enabled: false, ..TopologyParameters::default() };
    TrackerParameters { reference_length: Some(length), topology, ..TrackerParameters::default() }
}

#[test]
fn stretched_surfaces_get_edges_within_the_limits() {
    for factors in
        [DVec3::new(4.0, 1.0, 1.0), DVec3::new(1.0, 1.0, 0.3), DVec3::splat(3.0), DVec3::splat(0.4)]
    {
        let mesh = mapped(&unit_sphere(0.2), |p| p * factors);
        let mut tracker = tracker(&mesh, without_topology(0.2));
        let before = volume(&tracker);
        improve(&mut tracker, 5);
        let ([shortest, longest], after) = (edge_lengths(&tracker), volume(&tracker));
        println!("{factors}: edges {shortest:.3} to {longest:.3}, volume {before:.4} -> {after:.4}");
        // A collapse may be refused since it would make an edge that is too long.
        assert!(shortest > 0.3 && longest < 1.6, "{factors}: {shortest} {longest}");
        // A coarser sphere is a smaller one; 6 % is the volume of the caps that chords of the coarsest cut off.
        assert!((after / before - 1.0).abs() < 0.06, "{factors}: {before} {after}");
    }
}

/// Random shapes, lengths and options. With topology off the number of components, the Euler characteristic and the number of
/// boundary edges' loops stay; everything stays sound and embedded.
#[test]
fn anything_stays_embedded_and_keeps_its_topology() {
    let mut random = Random::new(6);
    let mut changes = 0;
    let mut shapes: Vec<TriMesh> = closed_surfaces().into_iter().map(|(_, mesh)| mesh).collect();
    shapes.push(together(&unit_sphere(0.4), &mapped(&unit_sphere(0.3), |p| 0.8 * p)));
    shapes.push(torus(&Torus { edge_length: 0.3, ..Torus::default() }).unwrap().into_mesh());
    for round in 0..60 {
        let shape = &shapes[random.below(shapes.len() as u64) as usize];
        let stretch = DVec3::from_array([(); 3].map(|()| random.between(-1.5, 1.5).exp2()));
        let twist = random.between(-1.0, 1.0);
        let mesh = mapped(shape, |p| {
            let (sine, cosine) = (twist * p.z).sin_cos();
            stretch * DVec3::new(cosine * p.x - sine * p.y, sine * p.x + cosine * p.y, p.z)
        });
        let split_scheme = [
            SplitScheme::Midpoint,
            SplitScheme::Butterfly,
            SplitScheme::ModifiedButterfly,
            SplitScheme::Quadric,
            SplitScheme::Fitted,
        ][random.below(5) as usize];
        let curvature = (random.below(2) == 0).then(CurvatureAdaption::default);
        let improvement = ImprovementParameters {
            split_scheme,
            curvature,
            keeps_volume: random.below(2) == 0,
            smoothing: random.below(2) == 0,
            max_edge_rel: random.between(1.2, 2.0),
            small_angle: random.between(0.0, 30.0),
            large_angle: random.between(100.0, 180.0),
            ..ImprovementParameters::default()
        };
        let parameters = TrackerParameters { improvement, ..without_topology(random.between(0.15, 0.8)) };
        let Ok(surface) = welter_tracking::surface::MovingSurface::new(&mesh) else { panic!("{round}") };
        // A twist may have made it meet itself.
        let Ok(mut tracker) = welter_tracking::tracker::SurfaceTracker::new(surface, parameters) else {
            continue;
        };
        let topology = |tracker: &welter_tracking::tracker::SurfaceTracker| {
            let mesh = tracker.surface().to_mesh();
            let topology = Topology::of(&mesh);
            (topology.components().len(), tracker.surface().connectivity().euler_characteristic())
        };
        let before = topology(&tracker);
        for report in improve(&mut tracker, 3) {
            let done = report.improvement;
            changes += done.splits + done.flips + done.collapses;
            assert_eq!((done.merges, done.separations, done.cancelled), (0, 0, 0), "{round}");
            assert_eq!(topology(&tracker), before, "{round}");
        }
    }
    println!("{changes} changes");
    assert!(changes > 10_000, "{changes}");
}

#[test]
fn powers_of_two_scale_the_result_bit_for_bit() {
    let mesh = mapped(&unit_sphere(0.25), |p| p * DVec3::new(2.0, 1.0, 0.7));
    let result = |scale: f64| {
        let parameters = TrackerParameters {
            reference_length: Some(0.2 * scale),
            improvement: ImprovementParameters {
                curvature: Some(CurvatureAdaption::default()),
                ..ImprovementParameters::default()
            },
            ..TrackerParameters::default()
        };
        let mut tracker = tracker(&mapped(&mesh, |p| scale * p), parameters);
        improve(&mut tracker, 2);
        tracker.surface().to_mesh()
    };
    let one = result(1.0);
    assert!(one.triangles().len() > 500, "{}", one.triangles().len());
    for exponent in [-200, -3, 7, 200] {
        let scale = 2f64.powi(exponent);
        let other = result(scale);
        assert_eq!(one.triangles(), other.triangles(), "{exponent}");
        let scaled: Vec<DVec3> = one.positions().iter().map(|&p| scale * p).collect();
        assert_eq!(scaled, other.positions(), "{exponent}");
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let mesh = mapped(&unit_sphere(0.2), |p| p * DVec3::new(2.0, 1.0, 0.7));
    let result = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut tracker = tracker(&mesh, without_topology(0.15));
            improve(&mut tracker, 2);
            tracker.surface().to_mesh()
        })
    };
    let one = result(1);
    for threads in [2, 5] {
        assert_eq!(one, result(threads));
    }
}

/// Flat faces, sharp edges and corners are kept exactly, whatever the length.
#[test]
fn a_box_stays_a_box() {
    let cube = box_(&Box_ { edge_length: 0.25, ..Box_::default() }).unwrap();
    for length in [0.12, 0.3, 0.8] {
        let mut tracker = tracker(&cube, without_topology(length));
        improve(&mut tracker, 4);
        let surface = tracker.surface();
        let on_face = |p: &DVec3| (p.abs().max_element() - 1.0).abs() < 1e-12;
        let off: Vec<&DVec3> = surface.positions().iter().filter(|p| !on_face(p)).collect();
        assert!(off.is_empty(), "{length}: {off:?}");
        let corners = surface.positions().iter().filter(|p| p.abs() == DVec3::ONE).count();
        assert_eq!(corners, 8, "{length}");
        assert!((volume(&tracker) - 8.0).abs() < 1e-10, "{length}: {}", volume(&tracker));
        println!(
            "{length}: {} triangles, edges {:?}",
            surface.connectivity().triangle_count(),
            edge_lengths(&tracker)
        );
    }
}

/// Open surfaces are remeshed up to the boundary, which stays where it is.
#[test]
fn a_sheet_is_remeshed_with_its_boundary() {
    let (_, grid) = open_surfaces().into_iter().find(|(name, _)| *name == "grid").unwrap();
    let places = (0..7).flat_map(|y| (0..7).map(move |x| DVec3::new(f64::from(x), f64::from(y), 0.0)));
    let soup = TriangleSoup {
        positions: places.collect(),
        triangles: grid.triangles().iter().map(|t| t.map(|v| v.0)).collect(),
        ..TriangleSoup::default()
    };
    let sheet = TriMesh::new(soup).unwrap();
    let corners = sheet
        .positions()
        .iter()
        .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], &p| [low.min(p), high.max(p)]);
    let area = |mesh: &TriMesh| welter_meshing::surface::measure::area(mesh);
    let before = area(&sheet);
    for part in [0.05, 0.4] {
        let length = part * (corners[1] - corners[0]).max_element();
        let mut tracker = tracker(&sheet, without_topology(length));
        improve(&mut tracker, 4);
        let after = tracker.surface().to_mesh();
        let boundary = Topology::of(&after).boundary_loops().iter().map(|l| l.edges.len()).sum::<usize>();
        println!(
            "{part}: {} triangles, {boundary} edges on the boundary, edges {:?}",
            after.triangles().len(),
            edge_lengths(&tracker)
        );
        assert!((area(&after) / before - 1.0).abs() < 1e-12, "{part}");
        let [shortest, longest] = edge_lengths(&tracker);
        assert!(longest < 1.5 + 1e-9 && shortest > 0.3, "{part}: {shortest} {longest}");
    }
}

/// Edges with more than two triangles are split, and stay balanced.
#[test]
fn edges_with_many_triangles_are_split() {
    // Two tetrahedra with a common edge, along z.
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let positions = vec![
        at(0.0, 0.0, -1.0),
        at(0.0, 0.0, 1.0),
        at(1.0, -0.6, 0.0),
        at(1.0, 0.6, 0.0),
        at(-1.0, 0.6, 0.0),
        at(-1.0, -0.6, 0.0),
    ];
    let tetrahedron = |a: u32, b: u32, c: u32, d: u32| [[a, c, b], [a, b, d], [b, c, d], [c, a, d]];
    let triangles = [tetrahedron(0, 2, 3, 1), tetrahedron(0, 4, 5, 1)].concat();
    let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
    let mesh = TriMesh::new(soup).unwrap();
    let mut tracker = tracker(&mesh, without_topology(0.3));
    check(&tracker);
    let on_edge = |tracker: &welter_tracking::tracker::SurfaceTracker| {
        let mesh = tracker.surface().connectivity();
        mesh.edges().filter(|&e| mesh.edge_triangles(e) == 4).count()
    };
    assert_eq!(on_edge(&tracker), 1);
    let before = volume(&tracker);
    improve(&mut tracker, 3);
    println!("{} edges with four triangles, edges {:?}", on_edge(&tracker), edge_lengths(&tracker));
    assert!(on_edge(&tracker) >= 4, "{}", on_edge(&tracker));
    assert!((volume(&tracker) / before - 1.0).abs() < 1e-12);
    assert!(edge_lengths(&tracker)[1] <= 1.5 + 1e-9);
}

#[test]
fn immovable_vertices_stay() {
    let mut surface = welter_tracking::surface::MovingSurface::new(&unit_sphere(0.2)).unwrap();
    let fixed: Vec<DVec3> = surface.positions().iter().copied().filter(|p| p.z > 0.5).collect();
    for v in surface.connectivity().vertices().collect::<Vec<_>>() {
        if surface.position(v).z > 0.5 {
            surface.set_mass(v, f64::INFINITY).unwrap();
        }
    }
    for length in [0.1, 0.5] {
        let mut tracker =
            welter_tracking::tracker::SurfaceTracker::new(surface.clone(), without_topology(length)).unwrap();
        let reports = improve(&mut tracker, 3);
        let positions = tracker.surface().positions();
        assert!(fixed.iter().all(|p| positions.contains(p)), "{length}");
        assert!(reports[0].improvement.splits + reports[0].improvement.collapses > 100, "{length}");
    }
}
