//! What is refused, with the reason, and leaves the surface as it was.

use super::{ball, bits, cuboid, together, unite};
use glam::DVec3;
use std::sync::atomic::AtomicBool;
use welter_meshing::Monitor;
use welter_meshing::surface::{ClosedOrientedMesh, TriId, TriMesh, TriangleSoup};
use welter_tracking::surface::{
    AppendError, MovingSurface, UnionError, UnionObstacle, UnionOutcome, UnionParameters,
};

/// A square of cells in a plane of height z.
fn sheet(z: f64) -> TriMesh {
    let at = |k: u32| f64::from(k) * 0.37 - 0.8;
    let positions = (0..5).flat_map(|j| (0..5).map(move |i| DVec3::new(at(i), at(j), z))).collect();
    let cell = |i: u32, j: u32| {
        let a = 5 * j + i;
        [[a, a + 1, a + 6], [a, a + 6, a + 5]]
    };
    let triangles = (0..4).flat_map(|j| (0..4).flat_map(move |i| cell(i, j))).collect();
    TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() }).unwrap()
}

#[test]
fn sheets_that_are_crossed_are_refused_and_others_stay() {
    let there = ball(DVec3::new(0.0, 0.0, 3.0), 0.7, 0.3);
    let mesh = together(&[&there, &sheet(0.0)]);
    let mut surface = MovingSurface::new(&mesh).unwrap();
    let before = bits(&surface);
    let refused = unite(&mut surface, &ball(DVec3::Z * 0.2, 0.5, 0.2));
    let first = there.triangles().len() as u32;
    assert!(
        matches!(refused, Err(UnionError::Sheet { triangle }) if triangle >= TriId(first)),
        "{refused:?}"
    );
    assert!(bits(&surface) == before);
    // Around the sheet: it is no smoke that could go.
    let around = ball(DVec3::new(0.02, 0.03, 0.01), 1.6, 0.5);
    let report = unite(&mut surface, &around).unwrap();
    assert_eq!(report.outcome, UnionOutcome::Beside);
    // And through the ball, which is closed.
    let report = unite(&mut surface, &ball(DVec3::new(0.1, 0.2, 3.3), 0.7, 0.3)).unwrap();
    assert_eq!((report.outcome, report.shifts), (UnionOutcome::Joined, 0));
    assert_eq!(surface.check(), Ok(()));
    let boundary = |surface: &MovingSurface| {
        let mesh = surface.connectivity();
        mesh.edges().filter(|&edge| mesh.is_boundary(edge)).count()
    };
    assert_eq!(boundary(&surface), 16);
}

#[test]
fn what_is_inside_out_or_crosses_itself_is_refused() {
    let one = ball(DVec3::ZERO, 1.0, 0.4);
    let other = ball(DVec3::new(0.9, 0.1, 0.2), 1.0, 0.4);
    let refused = |mesh: &TriMesh, shape: &TriMesh| {
        let mut surface = MovingSurface::new(mesh).unwrap();
        let before = bits(&surface);
        let error = unite(&mut surface, &ClosedOrientedMesh::new(shape.clone()).unwrap()).unwrap_err();
        assert!(bits(&surface) == before && surface.log().is_empty());
        error
    };
    let count = one.triangles().len() as u32;
    let reversed = |mesh: &ClosedOrientedMesh| mesh.clone().reversed().into_mesh();
    let error = refused(&reversed(&one), &other);
    assert!(matches!(error, UnionError::InsideOut { triangle } if triangle < TriId(count)), "{error:?}");
    let error = refused(&one, &reversed(&other));
    assert!(matches!(error, UnionError::InsideOut { triangle } if triangle >= TriId(count)), "{error:?}");
    // Wholly within, on either side.
    let small = ball(DVec3::X * 0.2, 0.3, 0.2);
    let error = refused(&reversed(&one), &small);
    assert!(matches!(error, UnionError::InsideOut { .. }), "{error:?}");
    let error = refused(&small, &reversed(&one));
    assert!(matches!(error, UnionError::InsideOut { .. }), "{error:?}");

    let both = together(&[&one, &other]);
    let far = ball(DVec3::X * 9.0, 1.0, 0.5);
    let error = refused(&both, &far);
    assert!(
        matches!(&error, UnionError::SelfIntersection { pairs } if pairs.iter().all(|p| p[0] < TriId(count))),
        "{error:?}"
    );
    let pairs = refused(&far, &both);
    assert!(matches!(&pairs, UnionError::SelfIntersection { pairs } if !pairs.is_empty()), "{pairs:?}");

    // Two triangles on the same corners, one each way.
    let flat = TriangleSoup {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        triangles: vec![[0, 1, 2], [0, 2, 1]],
        ..TriangleSoup::default()
    };
    let error = refused(&one, &TriMesh::new(flat).unwrap());
    assert!(matches!(error, UnionError::Append(AppendError::Defects(_))), "{error:?}");
}

#[test]
fn limits_hold() {
    let mesh = ball(DVec3::ZERO, 1.0, 0.4);
    let shape = ball(DVec3::new(0.9, 0.1, 0.2), 1.0, 0.4);
    let mut surface = MovingSurface::new(&mesh).unwrap();
    let before = bits(&surface);
    let with = |most_triangles, shifts| UnionParameters { most_triangles, shifts };
    let mut free = surface.clone();
    let report = free.unite(&shape, &with(10_000, 0), &Monitor::none()).unwrap();
    let count = free.connectivity().triangle_count();
    assert_eq!(count, mesh.triangles().len() - report.removed_triangles + report.new_triangles);
    let refused = surface.unite(&shape, &with(count - 1, 0), &Monitor::none());
    assert_eq!(refused, Err(UnionError::Budget { triangles: count, most: count - 1 }));
    let refused = surface.unite(&shape, &with(count, 11), &Monitor::none());
    assert_eq!(refused, Err(UnionError::Shifts { shifts: 11, most: 10 }));
    let refused = surface.unite(&mesh, &with(10_000, 0), &Monitor::none());
    let obstacle = UnionObstacle::GeneralPosition;
    assert_eq!(refused, Err(UnionError::Degenerate { shifts: 0, obstacle }));
    let stop = AtomicBool::new(true);
    let refused = surface.unite(&shape, &with(count, 0), &Monitor::new(None, Some(&stop)));
    assert!(matches!(refused, Err(UnionError::Cancelled(_))), "{refused:?}");
    assert!(bits(&surface) == before && surface.log().is_empty());
    assert!(surface.unite(&shape, &with(count, 0), &Monitor::none()).is_ok());
}

/// Where coordinates are as coarse as edges are long, shifts are lost in roundings; at the ends of the range nothing overflows.
#[test]
fn far_away_and_at_the_ends_of_the_range_there_is_an_answer() {
    for (scale, offset) in
        [(1.0, 1e15), (1e-300, 0.0), (1e-310, 0.0), (1e300, 0.0), (8e307, 0.0), (1e154, 0.0)]
    {
        let place = |p: DVec3| p * scale + DVec3::splat(offset);
        let first = cuboid([0.0; 3], [1.0; 3], 0.5);
        for at in [DVec3::ZERO, DVec3::new(0.5, 0.25, 0.25), DVec3::new(0.31, 0.17, 0.23)] {
            let [mesh, shape] = [DVec3::ZERO, at].map(|at| {
                let mut soup = first.to_soup();
                soup.positions.iter_mut().for_each(|p| *p = place(*p + at));
                TriMesh::new(soup).unwrap()
            });
            let mut surface = MovingSurface::new(&mesh).unwrap();
            let before = bits(&surface);
            match unite(&mut surface, &ClosedOrientedMesh::new(shape).unwrap()) {
                Ok(report) => {
                    assert_ne!(report.outcome, UnionOutcome::Within);
                    super::check(&surface);
                    println!("{scale:e}, {offset:e}, {at}: {report:?}");
                }
                Err(error) => {
                    println!("{scale:e}, {offset:e}, {at}: {error}");
                    assert!(bits(&surface) == before);
                    assert!(offset > 0.0 || !(1e-300..=1e300).contains(&scale), "{scale:e}: {error}");
                }
            }
        }
    }
}
