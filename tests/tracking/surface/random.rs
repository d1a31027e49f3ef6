//! Thousands of random operations, each compared with the plain list of triangles and with a replay of the log.

use welter_kit::mesher::Random;
use welter_kit::surface::{
    Named, PlainSurface, Replay, closed_surfaces, non_manifold_surfaces, open_surfaces, tube_between,
};
use welter_meshing::surface::{EdgeId, TriId, VertexId};
use welter_tracking::surface::{EventKind, HalfEdge, MovingSurface, Plan, RadialConnectivity, Refusal};

/// A random operation: the plan or why there is none, and what the plain surface says would come out.
pub(crate) struct Trial {
    pub(crate) plan: Result<Plan, Refusal>,
    pub(super) plain: PlainSurface,
}

pub(super) fn plain(surface: &RadialConnectivity) -> PlainSurface {
    PlainSurface::new(surface.triangles().map(|t| surface.corners(t).map(|v| v.0)))
}

pub(super) fn pick<T>(random: &mut Random, from: impl Iterator<Item = T>) -> Option<T> {
    let mut all: Vec<T> = from.collect();
    (!all.is_empty()).then(|| {
        let i = random.below(all.len() as u64) as usize;
        all.swap_remove(i)
    })
}

fn ids(corners: [VertexId; 3]) -> [u32; 3] {
    corners.map(|v| v.0)
}

/// The boundary of the two triangles of an edge, if it has two: `b c a d` for triangles `a b c` and `b a d`.
fn hole(mesh: &RadialConnectivity, edge: EdgeId) -> Option<([TriId; 2], [VertexId; 4])> {
    let around: Vec<HalfEdge> = mesh.around_edge(edge).collect();
    let &[h, o] = &around[..] else { return None };
    Some(([h.triangle(), o.triangle()], [mesh.head(h), mesh.apex(h), mesh.tail(h), mesh.apex(o)]))
}

/// An operation of a kind: 0 split, 1 flip, 2 collapse, 3 separation, 4 tube, 5 removal, 6 filling.
pub(crate) fn trial(surface: &MovingSurface, random: &mut Random, kind: u64) -> Option<Trial> {
    let mesh = surface.connectivity();
    let before = plain(mesh);
    let edge = pick(random, mesh.edges())?;
    let fraction = [0.25, 0.5, 0.75, random.unit().max(1e-3)][random.below(4) as usize];
    let [a, b] = mesh.ends(edge);
    match kind {
        0 => {
            let plan = surface.plan_split(edge, fraction);
            let Ok(EventKind::Split { vertex, .. }) = plan.as_ref().map(Plan::kind) else {
                panic!("{plan:?}")
            };
            Some(Trial { plan, plain: before.split([a.0, b.0], vertex.0) })
        }
        1 => {
            let forward = pick(random, mesh.around_edge(edge).filter(|&h| mesh.tail(h) == a))?;
            let backward = pick(random, mesh.around_edge(edge).filter(|&h| mesh.tail(h) == b))?;
            let corners = [a, b, mesh.apex(forward), mesh.apex(backward)].map(|v| v.0);
            Some(Trial { plan: surface.plan_flip([forward, backward]), plain: before.flip(corners) })
        }
        2 => {
            let [kept, removed] = if random.below(2) == 0 { [a, b] } else { [b, a] };
            let fraction = [0.0, 1.0, fraction][random.below(3) as usize];
            Some(Trial {
                plan: surface.plan_collapse(edge, kept, fraction),
                plain: before.collapse(kept.0, removed.0),
            })
        }
        3 => {
            let vertex = pick(random, mesh.vertices().filter(|&v| mesh.fans(v).len() > 1))?;
            let plan = surface.plan_separation(vertex).unwrap().expect("a singular vertex");
            let after = plan.changed().iter().fold(before.clone(), |list, &(t, corners)| {
                list.replace(&[ids(mesh.corners(t))], &[ids(corners)])
            });
            assert_eq!(before.fans(vertex.0).len(), mesh.fans(vertex).len());
            assert_eq!(after.fans(vertex.0).len(), 1);
            Some(Trial { plan: Ok(plan), plain: after })
        }
        4 => {
            let (first, one) = hole(mesh, edge)?;
            let (second, other) = hole(mesh, pick(random, mesh.edges())?)?;
            if first.iter().any(|t| second.contains(t)) {
                return None;
            }
            let add = tube_between(one, other, random.below(4) as usize);
            let distinct = |&[a, b, c]: &[VertexId; 3]| a != b && b != c && c != a;
            if !add.iter().all(distinct) {
                let remove = [first, second].concat();
                assert!(matches!(surface.plan_replacement(&remove, &add), Err(Refusal::Corners { .. })));
                return None;
            }
            let remove = [first, second].concat();
            let removed: Vec<_> = remove.iter().map(|&t| ids(mesh.corners(t))).collect();
            let added: Vec<_> = add.iter().map(|&corners| ids(corners)).collect();
            let plan = surface.plan_replacement(&remove, &add);
            Some(Trial { plan, plain: before.replace(&removed, &added) })
        }
        5 => {
            let t = pick(random, mesh.triangles())?;
            let plan = surface.plan_replacement(&[t], &[]);
            Some(Trial { plan, plain: before.replace(&[ids(mesh.corners(t))], &[]) })
        }
        _ => {
            // Fills the corner between two boundary edges, or proposes a triangle at random.
            let next = pick(random, mesh.edges())?;
            let [c, d] = mesh.ends(next);
            let third = if [a, b].contains(&c) { d } else { c };
            let corners = [b, a, third];
            if third == a || third == b {
                return None;
            }
            let plan = surface.plan_replacement(&[], &[corners]);
            Some(Trial { plan, plain: before.replace(&[], &[ids(corners)]) })
        }
    }
}

/// How often each kind of operation was done, and refused.
fn run(name: &str, mut surface: MovingSurface, kinds: &[u64], steps: usize, seed: u64) -> [[usize; 2]; 7] {
    let mut random = Random::new(seed);
    let mut counts = [[0; 2]; 7];
    let mut replay = Replay::of(surface.connectivity());
    for step in 0..steps {
        let kind = match surface.connectivity().triangle_count() {
            0 => break,
            // Neither nothing is to be left nor too much for the plain list.
            1..=12 => 0,
            200.. => 2,
            _ => kinds[random.below(kinds.len() as u64) as usize],
        };
        let Some(Trial { plan, plain: expected }) = trial(&surface, &mut random, kind) else { continue };
        let place = format!("{name}, seed {seed}, step {step}, kind {kind}");
        let before = plain(surface.connectivity());
        match plan {
            Ok(plan) => {
                counts[kind as usize][0] += 1;
                assert!(expected.is_admissible(), "{place}");
                let told = surface.consequences(&plan);
                let events = surface.log().len();
                surface.apply(plan);
                assert_eq!(plain(surface.connectivity()), expected, "{place}");
                assert_eq!(
                    surface.connectivity().euler_characteristic(),
                    expected.euler_characteristic(),
                    "{place}"
                );
                replay.apply(&surface.log().get(events).unwrap());
                assert_eq!(replay, Replay::of(surface.connectivity()), "{place}");
                agree(&told, &before, &expected, &place);
            }
            Err(refusal) => {
                counts[kind as usize][1] += 1;
                assert!(!expected.is_admissible(), "{place}: {refusal}");
            }
        }
        if step % 8 == 0 {
            assert_eq!(surface.check(), Ok(()), "{place}");
        }
        if step % 512 == 511 {
            let _ = surface.take_log();
            surface.compact();
            let fresh = RadialConnectivity::new(&surface.to_mesh()).unwrap();
            assert_eq!(surface.connectivity(), &fresh, "{place}");
            replay = Replay::of(surface.connectivity());
        }
    }
    counts
}

/// What was told beforehand is what the plain surfaces before and after differ in.
fn agree(
    told: &welter_tracking::surface::Consequences,
    before: &PlainSurface,
    after: &PlainSurface,
    place: &str,
) {
    let (before_edges, after_edges) = (before.edges(), after.edges());
    let expected = |condition: fn(usize, usize) -> bool| -> Vec<[u32; 2]> {
        let were = |edge: &[u32; 2]| before_edges.get(edge).copied().unwrap_or(0);
        after_edges.iter().filter(|&(edge, &are)| condition(were(edge), are)).map(|(&edge, _)| edge).collect()
    };
    let ids = |edges: &[[VertexId; 2]]| edges.iter().map(|edge| edge.map(|v| v.0)).collect::<Vec<_>>();
    assert_eq!(ids(&told.opened_edges), expected(|were, are| were != 1 && are == 1), "{place}");
    assert_eq!(ids(&told.closed_edges), expected(|were, are| were == 1 && are == 2), "{place}");
    assert_eq!(ids(&told.joined_edges), expected(|were, are| are > were && are > 2), "{place}");
    let (were, are) = (before.singular(), after.singular());
    let singular: Vec<(u32, usize)> = told.singular_vertices.iter().map(|&(v, fans)| (v.0, fans)).collect();
    let more = are.iter().filter(|&(v, fans)| fans > were.get(v).unwrap_or(&1));
    assert_eq!(singular, more.map(|(&v, &fans)| (v, fans)).collect::<Vec<_>>(), "{place}");
    let vertices = |surface: &PlainSurface| {
        surface.triangles().iter().flatten().copied().collect::<std::collections::BTreeSet<u32>>()
    };
    let lost: Vec<u32> = told.lost_vertices.iter().map(|v| v.0).collect();
    assert_eq!(lost, vertices(before).difference(&vertices(after)).copied().collect::<Vec<_>>(), "{place}");
}

fn run_all(surfaces: Vec<Named>, kinds: &[u64], least: [[usize; 2]; 7]) {
    let mut total = [[0; 2]; 7];
    for (name, mesh) in surfaces {
        for seed in 0..3 {
            let counts = run(name, MovingSurface::new(&mesh).unwrap(), kinds, 2000, seed);
            for (sum, count) in total.iter_mut().flatten().zip(counts.iter().flatten()) {
                *sum += count;
            }
        }
    }
    println!("done and refused, by kind: {total:?}");
    assert!(total.iter().flatten().zip(least.iter().flatten()).all(|(sum, least)| sum >= least), "{total:?}");
}

#[test]
fn closed_surfaces_agree_with_their_plain_twins() {
    // What is closed stays so, hence nothing is ever unbalanced: only doubled triangles are refused.
    let least = [[1000, 0], [1000, 5], [1000, 10], [100, 0], [100, 5], [0; 2], [0; 2]];
    run_all(closed_surfaces(), &[0, 1, 1, 2, 2, 3, 4], least);
}

#[test]
fn surfaces_with_edges_of_many_triangles_agree_with_their_plain_twins() {
    let least = [[1000, 0], [1000, 5], [1000, 10], [100, 0], [100, 5], [0; 2], [0; 2]];
    run_all(non_manifold_surfaces(), &[0, 1, 1, 2, 2, 3, 4], least);
}

#[test]
fn open_surfaces_agree_with_their_plain_twins() {
    let least = [[1000, 0], [500, 10], [1000, 10], [10, 0], [10, 10], [100, 0], [10, 100]];
    run_all(open_surfaces(), &[0, 1, 2, 2, 3, 4, 5, 6, 6], least);
}

#[test]
fn the_same_calls_give_the_same_bits() {
    let run = || {
        let (_, mesh) = closed_surfaces().pop().unwrap();
        let mut surface = MovingSurface::new(&mesh).unwrap();
        let mut random = Random::new(5);
        for step in 0..600 {
            let kind = random.below(5);
            if let Some(Trial { plan: Ok(plan), .. }) = trial(&surface, &mut random, kind) {
                surface.apply(plan);
            }
            if step == 300 {
                surface.compact();
            }
        }
        surface
    };
    let one = run();
    let other = std::thread::spawn(run).join().unwrap();
    assert_eq!(one.connectivity(), other.connectivity());
    assert_eq!(one.log(), other.log());
    let bits = |surface: &MovingSurface| -> Vec<[u64; 3]> {
        surface.positions().iter().map(|p| p.to_array().map(f64::to_bits)).collect()
    };
    assert_eq!(bits(&one), bits(&other));
    assert!(one.log().len() > 200);
}
