//! Merging, separation, and rings of three edges that are cut.

use super::{check, improve, mapped, together, tracker, volume};
use glam::DVec3;
use welter_meshing::shapes::{Box_, Sphere, box_, sphere};
use welter_meshing::surface::{Topology, TriMesh, TriangleSoup};
use welter_tracking::improvement::TopologyParameters;
use welter_tracking::tracker::{SurfaceTracker, TrackerParameters};

fn components(tracker: &SurfaceTracker) -> usize {
    let mesh = tracker.surface().to_mesh();
    Topology::of(&mesh).components().len()
}

fn euler(tracker: &SurfaceTracker) -> i64 {
    tracker.surface().connectivity().euler_characteristic()
}

fn manifold(tracker: &SurfaceTracker) -> bool {
    let mesh = tracker.surface().connectivity();
    mesh.edges().all(|e| mesh.edge_triangles(e) == 2) && mesh.vertices().all(|v| mesh.fans(v).len() == 1)
}

fn with_topology(length: f64) -> TrackerParameters {
    TrackerParameters { reference_length: Some(length), ..TrackerParameters::default() }
}

/// Two cubes whose faces are parallel at a small distance become one body without a gap, of the same volume up to that of
/// the gap.
#[test]
fn boxes_face_to_face_become_one() {
    let cube = box_(&Box_ { edge_length: 0.25, ..Box_::default() }).unwrap();
    let other = mapped(&cube, |p| p + DVec3::new(2.01, 0.0, 0.0));
    let mut both = tracker(&together(&cube, &other), with_topology(0.25));
    assert_eq!((components(&both), euler(&both)), (2, 4));
    let before = volume(&both);
    let mut merges = 0;
    for round in 0..12 {
        let [report] = &improve(&mut both, 1)[..] else { panic!("one") };
        merges += report.improvement.merges;
        println!("{round}: {:?} components {} euler {}", report.improvement, components(&both), euler(&both));
    }
    println!("{merges} merges, volume {before} -> {}", volume(&both));
    assert!(merges > 0);
    assert!(manifold(&both));
    assert_eq!(components(&both), 1);
    assert!((volume(&both) - before).abs() < 0.1);
}

/// A sheet of one triangle that is much smaller than edges are to be, with a corner so blunt that its boundary goes straight on.
#[test]
fn small_sheets_vanish_only_as_changes_of_topology() {
    let sheet = || {
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.02, 0.0], [2.0, 0.0, 0.0]].map(DVec3::from);
        let soup =
            TriangleSoup { positions: positions.to_vec(), triangles: vec![[0, 1, 2]], ..Default::default() };
        TriMesh::new(soup).unwrap()
    };
    let left = |enabled: bool| {
        let topology = TopologyParameters { enabled, ..TopologyParameters::default() };
        let mut one = tracker(&sheet(), TrackerParameters { topology, ..with_topology(8.0) });
        improve(&mut one, 3);
        one.surface().connectivity().triangle_count()
    };
    assert_eq!([true, false].map(left), [0, 1]);
}

/// Two tetrahedra that share one vertex.
#[test]
fn singular_vertices_part_only_as_changes_of_topology() {
    let corners = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]].map(DVec3::from);
    let mirrored = corners[1..].iter().map(|&p| -p);
    let positions: Vec<DVec3> = corners.iter().copied().chain(mirrored).collect();
    let one = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let other = one.map(|t| t.map(|v| if v == 0 { 0 } else { v + 3 })).map(|[a, b, c]| [a, c, b]);
    let soup = TriangleSoup { positions, triangles: [one, other].concat(), ..Default::default() };
    let mesh = TriMesh::new(soup).unwrap();
    let after = |enabled: bool| {
        let topology = TopologyParameters { enabled, ..TopologyParameters::default() };
        let mut both = tracker(&mesh, TrackerParameters { topology, ..with_topology(1.2) });
        assert_eq!(euler(&both), 3);
        improve(&mut both, 1);
        euler(&both)
    };
    assert_eq!([true, false].map(after), [4, 3]);
}

/// With topology off nothing of that happens.
#[test]
fn switched_off_nothing_merges_or_parts() {
    let cube = box_(&Box_ { edge_length: 0.25, ..Box_::default() }).unwrap();
    let other = mapped(&cube, |p| p + DVec3::new(2.01, 0.0, 0.0));
    let topology = TopologyParameters { enabled: false, ..TopologyParameters::default() };
    let mut both = tracker(&together(&cube, &other), TrackerParameters { topology, ..with_topology(0.25) });
    improve(&mut both, 4);
    assert_eq!((components(&both), euler(&both)), (2, 4));
}

/// A thin sheet is not punctured. Its rim, thinner than the shortest edges, becomes sharp at once; then nothing more is lost.
#[test]
fn thin_sheets_survive() {
    let [min, max] = [DVec3::new(-1.0, -1.0, 0.0), DVec3::new(1.0, 1.0, 0.01)];
    let sheet = box_(&Box_ { min, max, edge_length: 0.2 }).unwrap();
    let mut sheet = tracker(&sheet, with_topology(0.2));
    let before = volume(&sheet);
    for report in improve(&mut sheet, 3) {
        assert_eq!((report.improvement.merges, report.improvement.separations), (0, 0));
    }
    let sharp = volume(&sheet);
    println!("volume {before} {sharp}");
    // Of the outermost row of triangles, a part of 1 - (1 - 0.2)^2, half is lost at most.
    assert!(sharp > 0.5 * before, "{before} {sharp}");
    improve(&mut sheet, 6);
    assert_eq!((components(&sheet), euler(&sheet)), (1, 2));
    assert!((volume(&sheet) / sharp - 1.0).abs() < 0.02, "{sharp} {}", volume(&sheet));
}

/// Two prisms with triangular ends that are joined by a ring of three short edges: the ring is cut, and both sides are
/// closed.
#[test]
fn a_ring_of_three_edges_is_cut_cleanly() {
    let ring = |radius: f64, z: f64| {
        (0..3).map(move |i| {
            let (sine, cosine) = (f64::from(i) * std::f64::consts::TAU / 3.0).sin_cos();
            DVec3::new(radius * cosine, radius * sine, z)
        })
    };
    let rings = [(1.0, -1.6), (1.0, -0.8), (0.1, 0.0), (1.0, 0.8), (1.0, 1.6)];
    let positions: Vec<DVec3> = rings.iter().flat_map(|&(radius, z)| ring(radius, z)).collect();
    let mut triangles = vec![[0, 2, 1], [12, 13, 14]];
    for layer in 0..4 {
        for i in 0..3 {
            let [a, b] = [3 * layer + i, 3 * layer + (i + 1) % 3];
            triangles.extend([[a, b, b + 3], [a, b + 3, a + 3]]);
        }
    }
    let mesh = TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() }).unwrap();
    let mut waist = tracker(&mesh, with_topology(0.8));
    assert_eq!((components(&waist), euler(&waist)), (1, 2));
    let before = volume(&waist);
    let reports = improve(&mut waist, 2);
    println!("{:?}", reports[0].improvement);
    assert_eq!(reports.iter().map(|r| r.improvement.separations).sum::<u64>(), 1);
    assert_eq!((components(&waist), euler(&waist)), (2, 4));
    assert!(manifold(&waist));
    // The volume changes by no more than the waist's surroundings.
    assert!((volume(&waist) - before).abs() < 0.05 * before, "{before} {}", volume(&waist));
    check(&waist);
}

/// Two spheres at a small distance get a neck.
#[test]
fn spheres_get_a_neck() {
    let one = sphere(&Sphere { edge_length: 0.15, ..Sphere::default() }).unwrap();
    let other = mapped(&one, |p| DVec3::new(2.004 - p.x, p.y, -p.z));
    let mut both = tracker(&together(&one, &other), with_topology(0.15));
    let before = volume(&both);
    for report in improve(&mut both, 6) {
        println!("{:?} {} {}", report.improvement, components(&both), euler(&both));
    }
    assert!(manifold(&both));
    assert!((volume(&both) / before - 1.0).abs() < 0.01);
    assert!(components(&both) < 3 && euler(&both) <= 4);
}
