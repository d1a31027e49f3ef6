//! Laws of attributes and masses under random operations.

use super::random::{Trial, pick, trial};
use glam::DVec3;
use welter_kit::mesher::Random;
use welter_kit::surface::{Named, closed_surfaces, non_manifold_surfaces, open_surfaces};
use welter_meshing::surface::{EdgeId, VertexId};
use welter_tracking::surface::{EventKind, Inherited, MassRule, MovingSurface, Plan, Rule};

/// 3.0, 1.75, -2.5: few digits, so that products with positions of few digits are exact.
const SLOPE: DVec3 = DVec3::new(3.0, 1.75, -2.5);

fn all_surfaces() -> Vec<Named> {
    [closed_surfaces(), non_manifold_surfaces(), open_surfaces()].concat()
}

/// Whether only the vertex goes that is meant to, so that no component vanishes.
fn keeps_vertices(surface: &MovingSurface, plan: &Plan) -> bool {
    let lost = surface.consequences(plan).lost_vertices;
    match plan.kind() {
        EventKind::Collapse { removed, .. } => lost == [removed],
        _ => lost.is_empty(),
    }
}

/// Random operations of some kinds that leave no component; returns how many there were.
fn change(
    surface: &mut MovingSurface,
    seed: u64,
    kinds: &[u64],
    steps: usize,
    mut after: impl FnMut(&MovingSurface),
) {
    let mut random = Random::new(seed);
    let mut done = 0;
    for _ in 0..steps {
        let kind = match surface.connectivity().triangle_count() {
            ..=12 => 0,
            200.. => 2,
            _ => kinds[random.below(kinds.len() as u64) as usize],
        };
        let Some(Trial { plan: Ok(plan), .. }) = trial(surface, &mut random, kind) else { continue };
        if keeps_vertices(surface, &plan) {
            surface.apply(plan);
            after(surface);
            done += 1;
        }
    }
    assert!(done > steps / 8, "{done} of {steps}");
}

#[test]
fn functions_linear_in_position_stay_so() {
    for (name, mesh) in all_surfaces() {
        let mut surface = MovingSurface::new(&mesh).unwrap();
        let heights = surface.positions().iter().map(|p| p.z).collect();
        let linear = surface.positions().iter().map(|p| p.dot(SLOPE)).collect();
        let places = surface.positions().to_vec();
        let attributes = surface.vertex_attributes_mut();
        let height = attributes.add("height", heights, Rule::Interpolate).unwrap();
        let linear = attributes.add("linear", linear, Rule::Interpolate).unwrap();
        let place = attributes.add("place", places, Rule::Interpolate).unwrap();
        let extent = mesh.positions().iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let mut operations = 0.0;
        change(&mut surface, 1, &[0, 1, 2, 3, 4], 1500, |surface| {
            // An operation rounds two products, a sum, and the like in the position; means never enlarge what is there.
            operations += 1.0;
            let bound = operations * 8.0 * f64::EPSILON * extent * SLOPE.abs().element_sum();
            for v in surface.connectivity().vertices() {
                let p = surface.position(v);
                let attributes = surface.vertex_attributes();
                let [h, l] = [height, linear].map(|a| attributes.values(a)[v.index()]);
                let place = attributes.values(place)[v.index()];
                assert!((h - p.z).abs() <= bound && (l - p.dot(SLOPE)).abs() <= bound, "{name}: {v:?}");
                assert!((place - p).abs().max_element() <= bound, "{name}: {v:?}");
            }
        });
    }
}

#[test]
fn linear_functions_at_midpoints_of_dyadic_points_are_exact() {
    for (name, mesh) in [non_manifold_surfaces(), open_surfaces()].concat() {
        let mut surface = MovingSurface::new(&mesh).unwrap();
        let linear = surface.positions().iter().map(|p| p.dot(SLOPE)).collect();
        let linear = surface.vertex_attributes_mut().add("linear", linear, Rule::Interpolate).unwrap();
        let mut random = Random::new(3);
        for _ in 0..100 {
            let edge = pick(&mut random, surface.connectivity().edges()).unwrap();
            let plan = surface.plan_split(edge, 0.5).unwrap();
            surface.apply(plan);
        }
        for v in surface.connectivity().vertices() {
            assert_eq!(
                surface.vertex_attributes().values(linear)[v.index()],
                surface.position(v).dot(SLOPE),
                "{name}"
            );
        }
    }
}

#[test]
fn totals_are_kept() {
    for (name, mesh) in all_surfaces() {
        for seed in 0..3 {
            let mut surface = MovingSurface::new(&mesh).unwrap();
            surface.set_mass_rule(MassRule::Conserve);
            let [v, e, t] = {
                let mesh = surface.connectivity();
                [mesh.vertex_slots(), mesh.edge_slots(), mesh.triangle_slots()]
            };
            let values = |n: usize| (0..n).map(|i| 1.0 + i as f64 / 7.0).collect::<Vec<f64>>();
            let counts = |n: usize| (0..n as i64).map(|i| 1_000_000_007 - 3 * i).collect::<Vec<i64>>();
            let at_v = surface.vertex_attributes_mut().add("amount", values(v), Rule::Conserve).unwrap();
            let count_v = surface.vertex_attributes_mut().add("count", counts(v), Rule::Conserve).unwrap();
            let at_e = surface.edge_attributes_mut().add("amount", values(e), Rule::Conserve).unwrap();
            let count_e = surface.edge_attributes_mut().add("count", counts(e), Rule::Conserve).unwrap();
            let at_t = surface.triangle_attributes_mut().add("amount", values(t), Rule::Conserve).unwrap();
            let count_t = surface.triangle_attributes_mut().add("count", counts(t), Rule::Conserve).unwrap();
            let totals = |surface: &MovingSurface| {
                let mesh = surface.connectivity();
                let mass: f64 = mesh.vertices().map(|v| surface.masses()[v.index()]).sum();
                let v: f64 =
                    mesh.vertices().map(|v| surface.vertex_attributes().values(at_v)[v.index()]).sum();
                let e: f64 = mesh.edges().map(|e| surface.edge_attributes().values(at_e)[e.index()]).sum();
                let t: f64 =
                    mesh.triangles().map(|t| surface.triangle_attributes().values(at_t)[t.index()]).sum();
                let counts = [
                    mesh.vertices()
                        .map(|v| surface.vertex_attributes().values(count_v)[v.index()])
                        .sum::<i64>(),
                    mesh.edges().map(|e| surface.edge_attributes().values(count_e)[e.index()]).sum(),
                    mesh.triangles().map(|t| surface.triangle_attributes().values(count_t)[t.index()]).sum(),
                ];
                ([mass, v, e, t], counts)
            };
            let (before, counted) = totals(&surface);
            let mut operations = 0.0;
            change(&mut surface, seed, &[0, 1, 2, 3, 4], 1000, |surface| {
                operations += 1.0;
                let (now, counts) = totals(surface);
                assert_eq!(counts, counted, "{name}, seed {seed}: {:?}", surface.log().iter().last());
                // An operation rounds a few values, none above the total; the sums here round as many.
                for (now, before) in now.iter().zip(before) {
                    let bound = (8.0 * operations + 400.0) * f64::EPSILON * before;
                    assert!((now - before).abs() <= bound, "{name}, seed {seed}: {now} of {before}");
                }
            });
        }
    }
}

/// The difference of a function at the ends of an edge: shares along the edge itself, means beside it.
fn difference(sources: &[Inherited<f64>]) -> f64 {
    let along = sources.iter().any(|source| source.share > 0.0 && source.share < 1.0);
    sources.iter().map(|source| source.value * if along { source.share } else { source.interpolation }).sum()
}

#[test]
fn directed_values_of_edges_keep_their_signs() {
    for (name, mesh) in all_surfaces() {
        let mut surface = MovingSurface::new(&mesh).unwrap();
        let rise = |surface: &MovingSurface, e: EdgeId| {
            let [a, b] = surface.connectivity().ends(e).map(|v| surface.position(v).dot(SLOPE));
            b - a
        };
        let rises = surface.connectivity().edges().map(|e| rise(&surface, e)).collect();
        let along =
            surface.edge_attributes_mut().add_directed("rise", rises, Rule::custom(difference)).unwrap();
        let mut random = Random::new(11);
        for round in 0..3 {
            for _ in 0..40 {
                let edge = pick(&mut random, surface.connectivity().edges()).unwrap();
                let plan = surface.plan_split(edge, [0.25, 0.5, 0.75][random.below(3) as usize]).unwrap();
                surface.apply(plan);
            }
            if round > 0 {
                let _ = surface.compact();
            }
            for e in surface.connectivity().edges() {
                let error = surface.edge_attributes().values(along)[e.index()] - rise(&surface, e);
                assert!(error.abs() < 1e-12, "{name}: {e:?} is off by {error}");
            }
        }
        // Vertices that part take the values of their edges along.
        let singular: Vec<VertexId> =
            surface.connectivity().vertices().filter(|&v| surface.connectivity().fans(v).len() > 1).collect();
        assert_eq!(singular.len(), usize::from(name == "three tetrahedra at a vertex"));
        for v in singular {
            let plan = surface.plan_separation(v).unwrap().unwrap();
            assert_eq!(surface.apply(plan).vertices.len(), 2);
        }
        for e in surface.connectivity().edges() {
            let error = surface.edge_attributes().values(along)[e.index()] - rise(&surface, e);
            assert!(error.abs() < 1e-12, "{name}: {e:?} is off by {error}");
        }
    }
}

#[test]
fn copies_resets_and_functions() {
    let (_, mesh) = closed_surfaces().swap_remove(2);
    let mut surface = MovingSurface::new(&mesh).unwrap();
    let slots = surface.connectivity().vertex_slots();
    let attributes = surface.vertex_attributes_mut();
    let label = attributes.add("label", (0..slots as i64).map(|i| i + 10).collect(), Rule::Copy).unwrap();
    let age = attributes.add("age", vec![5.0; slots], Rule::Reset).unwrap();
    let oldest = |sources: &[Inherited<f64>]| sources.iter().map(|source| source.value).fold(0.0, f64::max);
    let most = attributes.add("most", (0..slots).map(|i| i as f64).collect(), Rule::custom(oldest)).unwrap();

    let edge = surface.connectivity().edges().next().unwrap();
    let [a, b] = surface.connectivity().ends(edge);
    let near_b = surface.plan_split(edge, 0.75).unwrap();
    let m = surface.apply(near_b).vertices[0];
    let at = |surface: &MovingSurface, v: VertexId| {
        let attributes = surface.vertex_attributes();
        (
            attributes.values(label)[v.index()],
            attributes.values(age)[v.index()],
            attributes.values(most)[v.index()],
        )
    };
    assert_eq!(at(&surface, m), (i64::from(b.0) + 10, 0.0, f64::from(a.0.max(b.0))));

    let edge = surface.connectivity().edge_between(a, m).unwrap();
    let onto_m = surface.plan_collapse(edge, a, 1.0).unwrap();
    let place = surface.position(m);
    surface.apply(onto_m);
    assert_eq!(at(&surface, a), (i64::from(b.0) + 10, 5.0, f64::from(a.0.max(b.0))));
    assert_eq!(surface.position(a), place);
}

#[test]
fn compaction_takes_values_along() {
    let (_, mesh) = closed_surfaces().swap_remove(3);
    let mut surface = MovingSurface::new(&mesh).unwrap();
    change(&mut surface, 9, &[0, 1, 2], 600, |_| {});
    let ids = |n: usize| (0..n as i64).collect::<Vec<_>>();
    let [v, e, t] = {
        let mesh = surface.connectivity();
        [mesh.vertex_slots(), mesh.edge_slots(), mesh.triangle_slots()]
    };
    let at_v = surface.vertex_attributes_mut().add("id", ids(v), Rule::Copy).unwrap();
    let at_e = surface.edge_attributes_mut().add("id", ids(e), Rule::Copy).unwrap();
    let at_t = surface.triangle_attributes_mut().add("id", ids(t), Rule::Copy).unwrap();
    let old = surface.clone();
    let numbers = surface.compact();
    assert!(numbers.vertices.len() < v && numbers.edges.len() < e && numbers.triangles.len() < t);
    assert!(numbers.vertices.is_sorted() && numbers.triangles.is_sorted());
    assert_eq!(surface.log().iter().last().map(|event| event.kind), Some(EventKind::Compact));
    let expect = |ids: Vec<u32>| ids.into_iter().map(i64::from).collect::<Vec<_>>();
    assert_eq!(
        surface.vertex_attributes().values(at_v),
        expect(numbers.vertices.iter().map(|v| v.0).collect())
    );
    assert_eq!(surface.edge_attributes().values(at_e), expect(numbers.edges.iter().map(|e| e.0).collect()));
    assert_eq!(
        surface.triangle_attributes().values(at_t),
        expect(numbers.triangles.iter().map(|t| t.0).collect())
    );
    for (new, &before) in (0..).map(VertexId).zip(&numbers.vertices) {
        assert_eq!(surface.position(new), old.position(before));
    }
    for (new, &before) in (0..).map(EdgeId).zip(&numbers.edges) {
        let mut ends = surface.connectivity().ends(new).map(|v| numbers.vertices[v.index()]);
        let mut expected = old.connectivity().ends(before);
        ends.sort_unstable();
        expected.sort_unstable();
        assert_eq!(ends, expected);
    }
    assert_eq!(surface.check(), Ok(()));
}
