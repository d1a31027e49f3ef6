//! Attributes, masses and the log.

use super::{ball, unite};
use glam::DVec3;
use welter_kit::surface::Replay;
use welter_meshing::Monitor;
use welter_meshing::surface::{ClosedOrientedMesh, EdgeId, TriId, VertexId};
use welter_tracking::surface::{EventKind, MassRule, MovingSurface, Rule, UnionOutcome, UnionParameters};

fn meshes() -> [ClosedOrientedMesh; 2] {
    [ball(DVec3::ZERO, 1.0, 0.3), ball(DVec3::new(0.9, 0.3, 0.2), 0.8, 0.25)]
}

/// Values of vertices are those of where they are if they are linear there; those of the shape are zero off the curves.
#[test]
fn vertices_keep_values_and_new_ones_on_curves_have_means() {
    let [mesh, shape] = meshes();
    let mut surface = MovingSurface::new(&mesh).unwrap();
    let count = surface.positions().len();
    let numbers: Vec<i64> = (1..=count as i64).collect();
    let number = surface.vertex_attributes_mut().add("number", numbers, Rule::Reset).unwrap();
    let linear = |p: DVec3| 5.0 + p.dot(DVec3::new(1.0, 2.0, -0.5));
    let values: Vec<f64> = mesh.positions().iter().map(|&p| linear(p)).collect();
    let value = surface.vertex_attributes_mut().add("value", values.clone(), Rule::Interpolate).unwrap();
    let place = surface.positions().to_vec();
    let place = surface.vertex_attributes_mut().add("place", place, Rule::Interpolate).unwrap();
    (0..count as u32).map(VertexId).for_each(|v| surface.set_mass(v, f64::from(v.0 + 2)).unwrap());
    surface.set_mass(VertexId(3), f64::INFINITY).unwrap();

    let report = unite(&mut surface, &shape).unwrap();
    assert_eq!((report.outcome, report.shifts), (UnionOutcome::Joined, 0));
    let old = surface.positions().len() - report.new_vertices;
    let attributes = surface.vertex_attributes();
    let mut before = 0;
    for v in 0..old {
        let id = attributes.values(number)[v];
        assert!(id > before, "in their order");
        before = id;
        let source = id as usize - 1;
        assert_eq!(surface.positions()[v], mesh.positions()[source]);
        assert_eq!(attributes.values(value)[v].to_bits(), values[source].to_bits());
        let mass = if source == 3 { f64::INFINITY } else { source as f64 + 2.0 };
        assert_eq!(surface.masses()[v], mass);
    }
    let mut on_curves = 0;
    for v in old..surface.positions().len() {
        let (p, place) = (surface.positions()[v], attributes.values(place)[v]);
        if shape.positions().contains(&p) {
            assert_eq!((attributes.values(value)[v], place, surface.masses()[v]), (0.0, DVec3::ZERO, 1.0));
        } else {
            on_curves += 1;
            assert!(place.distance(p) < 1e-14, "{place} at {p}");
            assert!((attributes.values(value)[v] - linear(p)).abs() < 1e-13);
            assert!(surface.masses()[v] >= 2.0 && surface.masses()[v].is_finite());
        }
    }
    assert_eq!(on_curves, report.segments, "closed curves have as many vertices as segments");
}

/// Sums are kept: what goes leaves its share. Integers exactly.
#[test]
fn amounts_are_kept() {
    let [mesh, shape] = meshes();
    let mut surface = MovingSurface::new(&mesh).unwrap();
    surface.set_mass_rule(MassRule::Conserve);
    let slots = {
        let mesh = surface.connectivity();
        [mesh.vertex_slots(), mesh.edge_slots(), mesh.triangle_slots()]
    };
    let [v, e, t] = slots;
    let amounts = |n: usize| (0..n).map(|i| 1.0 + i as f64 / 7.0).collect::<Vec<f64>>();
    let counts = |n: usize| (0..n as i64).map(|i| 1_000_003 - 3 * i).collect::<Vec<i64>>();
    let at_v = surface.vertex_attributes_mut().add("amount", amounts(v), Rule::Conserve).unwrap();
    let count_v = surface.vertex_attributes_mut().add("count", counts(v), Rule::Conserve).unwrap();
    let at_e = surface.edge_attributes_mut().add("amount", amounts(e), Rule::Conserve).unwrap();
    let count_e = surface.edge_attributes_mut().add("count", counts(e), Rule::Conserve).unwrap();
    let at_t = surface.triangle_attributes_mut().add("amount", amounts(t), Rule::Conserve).unwrap();
    let count_t = surface.triangle_attributes_mut().add("count", counts(t), Rule::Conserve).unwrap();
    let report = unite(&mut surface, &shape).unwrap();
    assert_eq!(surface.check(), Ok(()));
    let close = |values: &[f64], n: usize| {
        let (sum, expected) = (values.iter().sum::<f64>(), amounts(n).iter().sum::<f64>());
        assert!((sum / expected - 1.0).abs() < 1e-13, "{sum} of {expected}");
    };
    close(surface.vertex_attributes().values(at_v), v);
    close(surface.edge_attributes().values(at_e), e);
    close(surface.triangle_attributes().values(at_t), t);
    let same =
        |values: &[i64], n: usize| assert_eq!(values.iter().sum::<i64>(), counts(n).iter().sum::<i64>());
    same(surface.vertex_attributes().values(count_v), v);
    same(surface.edge_attributes().values(count_e), e);
    same(surface.triangle_attributes().values(count_t), t);
    // Each vertex of the shape brings a mass of one.
    let brought = surface.positions().iter().filter(|p| shape.positions().contains(p)).count();
    let mass: f64 = surface.masses().iter().sum();
    assert!((mass / (v + brought) as f64 - 1.0).abs() < 1e-13, "{mass}");
    assert!(surface.masses().iter().all(|&mass| mass > 1e-3));
    // What remains far from the curves has its amount.
    let kept = surface.connectivity().triangle_count() - report.new_triangles;
    let values = surface.triangle_attributes().values(at_t);
    let untouched = values[..kept].iter().filter(|value| amounts(t).contains(value)).count();
    assert_eq!(untouched, kept, "heirs are parts of cut triangles");
}

/// A directed value along a part of an edge has the sign of the whole.
#[test]
fn directed_values_keep_their_sign() {
    let [mesh, shape] = meshes();
    let mut surface = MovingSurface::new(&mesh).unwrap();
    let connectivity = surface.connectivity();
    let slope = DVec3::new(0.3, -1.0, 0.7);
    let drops: Vec<f64> = connectivity
        .edges()
        .map(|e| connectivity.ends(e).map(|v| surface.position(v).dot(slope)))
        .map(|[a, b]| b - a)
        .collect();
    let drop = surface.edge_attributes_mut().add_directed("drop", drops, Rule::Interpolate).unwrap();
    let report = unite(&mut surface, &shape).unwrap();
    let old = surface.positions().len() - report.new_vertices;
    let mesh = surface.connectivity();
    let mut signs = [0; 2];
    for e in mesh.edges() {
        let ends = mesh.ends(e);
        let value = surface.edge_attributes().values(drop)[e.index()];
        let [a, b] = ends.map(|v| surface.position(v).dot(slope));
        if ends[1].index() < old {
            assert_eq!(value, b - a);
        } else if value != 0.0 {
            assert!(value * (b - a) > 0.0 && value.abs() >= (b - a).abs(), "{value} and {}", b - a);
            signs[usize::from(value > 0.0)] += 1;
        }
    }
    assert!(signs[0] > 10 && signs[1] > 10, "{signs:?}");
}

/// The log tells all that came and went.
#[test]
fn the_log_tells_the_whole_history() {
    let [mesh, shape] = meshes();
    let mut surface = MovingSurface::new(&mesh).unwrap();
    for e in surface.connectivity().edges().collect::<Vec<_>>().into_iter().step_by(40) {
        let [kept, _] = surface.connectivity().ends(e);
        if let Ok(plan) = surface.plan_collapse(e, kept, 0.5) {
            surface.apply(plan);
        }
    }
    let _ = surface.compact();
    let _ = surface.take_log();
    let mut replay = Replay::of(surface.connectivity());
    let _ = unite(&mut surface, &shape).unwrap();
    let log = surface.take_log();
    let kinds: Vec<EventKind> = log.iter().map(|event| event.kind).collect();
    assert_eq!(kinds, [EventKind::Compact, EventKind::Unite, EventKind::Compact]);
    log.iter().for_each(|event| replay.apply(&event));
    let replay = replay.compacted();
    assert_eq!(replay, Replay::of(surface.connectivity()));
}

/// Edges and triangles that are not cut keep their values.
#[test]
fn edges_and_triangles_off_the_curves_keep_values() {
    let [mesh, shape] = meshes();
    let mut surface = MovingSurface::new(&mesh).unwrap();
    let before = surface.clone();
    let corners = |surface: &MovingSurface, t: TriId| {
        surface.connectivity().corners(t).map(|v| surface.position(v).to_array().map(f64::to_bits))
    };
    let ends = |surface: &MovingSurface, e: EdgeId| {
        surface.connectivity().ends(e).map(|v| surface.position(v).to_array().map(f64::to_bits))
    };
    let ids = |n: usize| (0..n as i64).collect::<Vec<i64>>();
    let [e, t] = [before.connectivity().edge_slots(), before.connectivity().triangle_slots()];
    let edge = surface.edge_attributes_mut().add("id", ids(e), Rule::Copy).unwrap();
    let triangle = surface.triangle_attributes_mut().add("id", ids(t), Rule::Copy).unwrap();
    let report = unite(&mut surface, &shape).unwrap();
    let kept = surface.connectivity().triangle_count() - report.new_triangles;
    for t in (0..kept).map(TriId::from_index) {
        let source = TriId(surface.triangle_attributes().values(triangle)[t.index()] as u32);
        assert_eq!(corners(&surface, t), corners(&before, source));
    }
    let old = surface.positions().len() - report.new_vertices;
    for e in surface.connectivity().edges() {
        if surface.connectivity().ends(e)[1].index() < old {
            let source = EdgeId(surface.edge_attributes().values(edge)[e.index()] as u32);
            assert_eq!(ends(&surface, e), ends(&before, source));
        }
    }
    // A cut triangle and its parts.
    let part = surface.triangle_attributes().values(triangle)[kept];
    assert!((0..t as i64).contains(&part));
    let parameters = UnionParameters::default();
    let again = surface.unite(&ball(DVec3::X * 9.0, 0.5, 0.3), &parameters, &Monitor::none());
    assert_eq!(again.unwrap().outcome, UnionOutcome::Beside);
    assert_eq!(surface.check(), Ok(()));
}
