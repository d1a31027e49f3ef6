//! What is refused, with what is needed to ask again; and that nothing is lost then.

use super::Body;
use glam::DVec3;
use std::sync::atomic::AtomicBool;
use welter_kit::moving::{sheet, stack};
use welter_meshing::Monitor;
use welter_meshing::spatial::meet_in_more;
use welter_meshing::surface::{TriMesh, TriangleSoup, VertexId};
use welter_tracking::broad_phase::{BroadPhase, BroadPhaseError, Motion};
use welter_tracking::integration::{IntegrationError, IntegrationParameters, Tangle, accept, resolve};

/// A body is as it was: its positions, and boxes at rest.
fn check_unchanged(body: &Body, before: &Body) {
    assert_eq!(body.surface.positions(), before.surface.positions());
    let mesh = body.surface.connectivity();
    for distance in [0.0, 0.3] {
        let pairs = |b: &BroadPhase| {
            (b.vertex_triangle_pairs(mesh, distance).unwrap(), b.edge_edge_pairs(mesh, distance).unwrap())
        };
        assert_eq!(pairs(&body.broad_phase), pairs(&before.broad_phase));
    }
}

/// A tangle speaks for itself.
fn check_tangle(tangle: &Tangle) {
    let at = |places: [[DVec3; 3]; 2]| {
        let corners = tangle.corners;
        move |v: VertexId| {
            (0..2)
                .flat_map(|i| (0..3).map(move |k| (i, k)))
                .find(|&(i, k)| corners[i][k] == v)
                .map(|(i, k)| places[i][k])
                .unwrap()
        }
    };
    assert!(meet_in_more(at(tangle.after), tangle.corners[0], tangle.corners[1]));
}

#[test]
fn ends_that_are_not_finite_or_too_few_are_refused() {
    let mut body = Body::new(&stack(2, 2, 2.0, 0.1));
    let before = body.clone();
    let good = body.surface.positions().to_vec();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for axis in 0..3 {
            let mut ends = good.clone();
            ends[7][axis] = bad;
            for refused in [
                body.resolve(ends.clone(), &IntegrationParameters::default()).map(|_| ()),
                body.accept(&ends),
            ] {
                let Err(IntegrationError::BroadPhase(BroadPhaseError::End { vertex, .. })) = refused else {
                    panic!("{refused:?}");
                };
                assert_eq!(vertex, VertexId(7));
            }
            check_unchanged(&body, &before);
        }
    }
    for ends in [good[1..].to_vec(), [good.clone(), vec![DVec3::ZERO]].concat()] {
        let refused = body.resolve(ends.clone(), &IntegrationParameters::default());
        assert!(matches!(refused, Err(IntegrationError::BroadPhase(BroadPhaseError::Ends { .. }))));
        assert!(matches!(
            body.accept(&ends),
            Err(IntegrationError::BroadPhase(BroadPhaseError::Ends { .. }))
        ));
        check_unchanged(&body, &before);
    }
}

#[test]
fn parameters_and_lengths_out_of_range_are_refused() {
    let mut body = Body::new(&sheet(2, 2.0));
    let ends = body.surface.positions().to_vec();
    let parameters = IntegrationParameters { friction: f64::NAN, ..IntegrationParameters::default() };
    let refused = body.resolve(ends.clone(), &parameters);
    assert!(matches!(refused, Err(IntegrationError::Parameter { parameter: "friction", .. })));
    for length in [f64::NAN, f64::INFINITY, -1.0] {
        body.length = length;
        let refused = body.resolve(ends.clone(), &IntegrationParameters::default());
        assert!(matches!(refused, Err(IntegrationError::Parameter { parameter: "length", .. })));
    }
}

#[test]
fn a_surface_that_intersects_itself_is_refused_with_its_pairs() {
    // The second sheet stands across the first.
    let flat = sheet(2, 2.0);
    let mut soup = TriangleSoup {
        positions: flat.positions().to_vec(),
        triangles: flat.triangles().iter().map(|t| t.map(|v| v.0)).collect(),
        ..TriangleSoup::default()
    };
    soup.positions.extend(flat.positions().iter().map(|p| DVec3::new(p.x + 0.3, 0.7, p.y - 0.8)));
    soup.triangles.extend(flat.triangles().iter().map(|t| t.map(|v| v.0 + 9)));
    let mesh = TriMesh::new(soup).unwrap();
    let expected = welter_meshing::spatial::self_intersections(&mesh, &Monitor::none()).unwrap();
    assert!(expected.len() > 2);
    let mut body = Body::new(&mesh);
    let before = body.clone();
    let still = body.surface.positions().to_vec();
    // Apart again at the end.
    let apart: Vec<DVec3> =
        still.iter().enumerate().map(|(i, &p)| if i < 9 { p } else { p + DVec3::Z * 9.0 }).collect();
    for ends in [still.clone(), apart] {
        match body.resolve(ends, &IntegrationParameters::default()) {
            Err(IntegrationError::NotEmbedded { pairs, first }) => {
                assert_eq!((&pairs, first.triangles), (&expected, expected[0]));
                check_tangle(&first);
            }
            other => panic!("{other:?}"),
        }
        check_unchanged(&body, &before);
    }
    // Unchecked, it ends all the same, and the check of the ends finds it.
    let unchecked = IntegrationParameters { check_start: false, ..IntegrationParameters::default() };
    let resolved = body.resolve(still.iter().map(|&p| p + DVec3::X * p.z).collect(), &unchecked).unwrap();
    match body.accept(&resolved.ends) {
        Err(IntegrationError::Intersection { pairs, first }) => {
            assert!(!pairs.is_empty());
            check_tangle(&first);
        }
        other => panic!("{other:?}"),
    }
    check_unchanged(&body, &before);
}

#[test]
fn ends_at_which_the_surface_intersects_itself_are_not_accepted() {
    let mut body = Body::new(&stack(2, 2, 2.0, 0.1));
    let before = body.clone();
    let mut ends = body.surface.positions().to_vec();
    ends[4].z += 0.5;
    match body.accept(&ends) {
        Err(IntegrationError::Intersection { pairs, first }) => {
            assert!(!pairs.is_empty() && pairs.is_sorted());
            assert_ne!(first.before, first.after);
            check_tangle(&first);
        }
        other => panic!("{other:?}"),
    }
    check_unchanged(&body, &before);
}

#[test]
fn a_cancelled_step_changes_nothing() {
    let mut body = Body::new(&stack(2, 2, 2.0, 0.1));
    let before = body.clone();
    let ends: Vec<DVec3> = body.surface.positions().iter().map(|&p| -p).collect();
    let stop = AtomicBool::new(true);
    let monitor = Monitor::new(None, Some(&stop));
    let Body { surface, broad_phase, length } = &mut body;
    let parameters = IntegrationParameters::default();
    let refused = resolve(surface, broad_phase, ends.clone(), *length, &parameters, &monitor);
    assert!(matches!(refused, Err(IntegrationError::Cancelled(_))));
    let still = surface.positions().to_vec();
    assert!(matches!(accept(surface, broad_phase, &still, &monitor), Err(IntegrationError::Cancelled(_))));
    check_unchanged(&body, &before);
}

#[test]
fn a_broad_phase_that_has_not_followed_is_refused() {
    let mut body = Body::new(&sheet(3, 3.0));
    let edge = body.surface.connectivity().edges().nth(5).unwrap();
    let plan = body.surface.plan_split(edge, 0.5).unwrap();
    body.surface.apply(plan);
    let ends = body.surface.positions().to_vec();
    let unchecked = IntegrationParameters { check_start: false, ..IntegrationParameters::default() };
    let not_followed =
        |error| matches!(error, IntegrationError::BroadPhase(BroadPhaseError::NotFollowed { .. }));
    assert!(not_followed(body.resolve(ends.clone(), &unchecked).unwrap_err()));
    assert!(not_followed(body.accept(&ends).unwrap_err()));
}

#[test]
fn ends_at_the_limits_of_the_range_do_no_harm() {
    for size in [1.0, 1e-300, 1e300] {
        let mut body = Body::new(&sheet(2, 2.0));
        let p: Vec<DVec3> = body.surface.positions().iter().map(|&p| size * (p - DVec3::ONE)).collect();
        (0..p.len()).for_each(|v| body.surface.set_position(VertexId(v as u32), p[v]).unwrap());
        body.broad_phase.refresh(&body.surface, Motion::Rest).unwrap();
        body.length = size;
        for far in [f64::MAX, f64::MIN_POSITIVE, 1e160] {
            let ends = p.iter().enumerate().map(|(i, &p)| {
                if i.is_multiple_of(2) { DVec3::splat(far) * DVec3::new(1.0, -1.0, 0.5) } else { -p }
            });
            let resolved = body.step(ends.collect(), &IntegrationParameters::default());
            assert!(body.is_embedded() && resolved.fraction > 0.0, "{size:e} {far:e}");
        }
    }
}

#[test]
fn nothing_moves_on_an_empty_surface() {
    let mut body = Body::new(&TriMesh::new(TriangleSoup::default()).unwrap());
    let resolved = body.step(Vec::new(), &IntegrationParameters::default());
    assert_eq!((resolved.ends.len(), resolved.fraction), (0, 1.0));
}
