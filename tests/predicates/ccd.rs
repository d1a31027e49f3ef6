//! Continuous collision: named cases, laws, and the public queries with known answers.

use std::path::Path;
use welter_predicates::ccd::ContactTimes::{Finite, Infinite};
use welter_predicates::ccd::{
    ContactTimes, edge_edge, edge_edge_times, vertex_face, vertex_face_times, vertex_segment_2d,
    vertex_segment_2d_times,
};

pub(crate) type Query = [[[f64; 3]; 4]; 2];

/// A vertex and a face, or two edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pair {
    VertexFace,
    EdgeEdge,
}

fn times(pair: Pair, [t0, t1]: Query) -> ContactTimes {
    let (any, times) = match pair {
        Pair::VertexFace => (vertex_face(t0, t1), vertex_face_times(t0, t1)),
        Pair::EdgeEdge => (edge_edge(t0, t1), edge_edge_times(t0, t1)),
    };
    assert_eq!(any, times.any(), "{pair:?} {t0:?} {t1:?}");
    times
}

/// The same question in other names, order, units and direction of time, each with the law that says so.
pub(crate) fn equivalents(pair: Pair, query: Query) -> Vec<(&'static str, Query)> {
    let [t0, t1] = query;
    let points = |f: &dyn Fn([f64; 3]) -> [f64; 3]| query.map(|t| t.map(f));
    let order = |order: [usize; 4]| query.map(|t| order.map(|i| t[i]));
    let mut all = vec![
        ("time reversed", [t1, t0]),
        ("negated", points(&|p| p.map(|x| -x))),
        ("one axis negated", points(&|[x, y, z]| [x, -y, z])),
    ];
    for axes in [[1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]] {
        all.push(("axes permuted", points(&|p| axes.map(|k| p[k]))));
    }
    all.extend(match pair {
        Pair::VertexFace => {
            vec![("face turned", order([0, 2, 3, 1])), ("face mirrored", order([0, 2, 1, 3]))]
        }
        Pair::EdgeEdge => vec![
            ("first edge reversed", order([1, 0, 2, 3])),
            ("second edge reversed", order([0, 1, 3, 2])),
            ("edges swapped", order([2, 3, 0, 1])),
        ],
    });
    let powers = [-1060, -1000, -500, -250, 7, 250, 500, 1000];
    all.extend(powers.into_iter().filter_map(|power| Some(("scaled", scaled(query, power)?))));
    all
}

/// The query times `2^power`, if that is exact.
pub(crate) fn scaled(query: Query, power: i32) -> Option<Query> {
    let scale = |x: f64| x * 2f64.powi(power / 2) * 2f64.powi(power - power / 2);
    let unscale = |x: f64| x * 2f64.powi(-power / 2) * 2f64.powi(power / 2 - power);
    let exact = query.iter().flatten().flatten().all(|&x| unscale(scale(x)) == x);
    exact.then(|| query.map(|t| t.map(|p| p.map(scale))))
}

/// The answer, after checking that it does not depend on names, order, units or the direction of time.
fn lawful(pair: Pair, query: Query) -> ContactTimes {
    let expected = times(pair, query);
    for (law, other) in equivalents(pair, query) {
        assert_eq!(times(pair, other), expected, "{law}: {pair:?} {query:?}");
    }
    expected
}

#[test]
fn vertex_face_swings_through_twice() {
    let t0 = [[-1.0, 0.0, -0.25], [-4.0, -4.0, -4.0], [4.0, -4.0, 4.0], [0.0, 4.0, 0.0]];
    let t1 = [[1.0, 0.0, -0.25], [-4.0, -4.0, 4.0], [4.0, -4.0, -4.0], [0.0, 4.0, 0.0]];
    assert_eq!(lawful(Pair::VertexFace, [t0, t1]), Finite(2));
}

#[test]
fn vertex_face_tangential_double_root() {
    let t0 = [[-1.0, 0.0, 0.0], [-4.0, -4.0, -4.0], [4.0, -4.0, 4.0], [0.0, 4.0, 0.0]];
    let t1 = [[1.0, 0.0, 0.0], [-4.0, -4.0, 4.0], [4.0, -4.0, -4.0], [0.0, 4.0, 0.0]];
    assert_eq!(lawful(Pair::VertexFace, [t0, t1]), Finite(1));
}

#[test]
fn edge_edge_swings_through_twice() {
    let t0 = [[-4.0, 0.0, -4.0], [4.0, 0.0, 4.0], [-1.0, -1.0, -0.25], [-1.0, 1.0, -0.25]];
    let t1 = [[-4.0, 0.0, 4.0], [4.0, 0.0, -4.0], [1.0, -1.0, -0.25], [1.0, 1.0, -0.25]];
    assert_eq!(lawful(Pair::EdgeEdge, [t0, t1]), Finite(2));
}

#[test]
fn edge_edge_flat_patch_without_contact() {
    let t0 = [[-1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [0.0, 0.0, 0.25], [0.0, 1.0, 0.25]];
    let t1 = [[-1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 0.25], [0.0, 1.0, 0.25]];
    assert_eq!(lawful(Pair::EdgeEdge, [t0, t1]), Finite(0));
}

#[test]
fn edge_edge_single_transversal_root() {
    let t0 = [[-2.0, -1.0, 1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [-2.0, 2.0, 1.0]];
    let t1 = [[2.0, -1.0, 0.0], [2.0, 0.0, 2.0], [2.0, -1.0, -2.0], [-1.0, 0.0, -1.0]];
    assert_eq!(lawful(Pair::EdgeEdge, [t0, t1]), Finite(1));
}

#[test]
fn edge_edge_collinear_sliding() {
    let t0 = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    let t1 = [[1.5, 0.0, 0.0], [2.5, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    assert_eq!(lawful(Pair::EdgeEdge, [t0, t1]), Infinite);
    // It stops where the ends meet, or just before.
    let touch = [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    assert_eq!(lawful(Pair::EdgeEdge, [t0, touch]), Finite(1));
    let before = [[1.0 - f64::EPSILON, 0.0, 0.0], [2.0 - f64::EPSILON, 0.0, 0.0], touch[2], touch[3]];
    assert_eq!(lawful(Pair::EdgeEdge, [t0, before]), Finite(0));
}

#[test]
fn vertex_slides_across_a_resting_face_in_its_plane() {
    let face = [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [0.0, 4.0, 1.0]];
    let step =
        |from: [f64; 2], to: [f64; 2]| [from, to].map(|[x, y]| [[x, y, 1.0], face[0], face[1], face[2]]);
    assert_eq!(lawful(Pair::VertexFace, step([-1.0, 1.0], [5.0, 1.0])), Infinite);
    // Past one corner only, and past it at a distance.
    assert_eq!(lawful(Pair::VertexFace, step([-1.0, 1.0], [1.0, -1.0])), Finite(1));
    assert_eq!(lawful(Pair::VertexFace, step([-1.0, 0.5], [1.0, -1.5])), Finite(0));
    // At rest: on it, and beside it.
    assert_eq!(lawful(Pair::VertexFace, step([1.0, 1.0], [1.0, 1.0])), Infinite);
    assert_eq!(lawful(Pair::VertexFace, step([3.0, 3.0], [3.0, 3.0])), Finite(0));
}

#[test]
fn degenerate_primitives() {
    // A face that is a point all the time, met by the vertex in the middle of the step.
    let p = [1.0, 2.0, 3.0];
    let q = [[0.0, 1.0, 2.0], [2.0, 3.0, 4.0]];
    assert_eq!(lawful(Pair::VertexFace, q.map(|v| [v, p, p, p])), Finite(1));
    assert_eq!(lawful(Pair::EdgeEdge, q.map(|v| [v, v, p, p])), Finite(1));
    assert_eq!(lawful(Pair::VertexFace, q.map(|v| [[v[0], v[1], 0.0], p, p, p])), Finite(0));
    // A face that collapses to a segment at the moment when the vertex passes through it.
    let t0 = [[1.0, 0.0, -1.0], [0.0, -1.0, 0.0], [2.0, -1.0, 0.0], [1.0, 1.0, 0.0]];
    let t1 = [[1.0, 0.0, 1.0], [0.0, 1.0, 0.0], [2.0, 1.0, 0.0], [1.0, -1.0, 0.0]];
    assert_eq!(lawful(Pair::VertexFace, [t0, t1]), Finite(1));
    // An edge that turns inside out about its middle.
    let t0 = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, -2.0, 0.0]];
    let t1 = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(lawful(Pair::EdgeEdge, [t0, t1]), Infinite);
}

#[test]
fn three_contacts() {
    // Motions whose volume has three roots in the step, all of them inside, are rare: about one in thousands.
    let mut found = 0;
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((state >> 33) % 9) as f64 - 4.0
    };
    for _ in 0..20_000 {
        let query: Query = std::array::from_fn(|_| std::array::from_fn(|_| std::array::from_fn(|_| next())));
        for pair in [Pair::VertexFace, Pair::EdgeEdge] {
            found += u32::from(times(pair, query) == Finite(3));
        }
    }
    assert!(found > 0, "random motions contain some with three contacts");
}

#[test]
fn laws_on_small_grids() {
    let mut state = 7u64;
    let mut next = |range: u64| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) % range
    };
    let mut counts = [0u32; 6];
    for round in 0..3_000 {
        let size = [1, 2, 4][round % 3];
        let flat = next(3) == 0;
        let mut query: Query = std::array::from_fn(|_| {
            std::array::from_fn(|_| std::array::from_fn(|_| next(2 * size + 1) as f64 - size as f64))
        });
        if flat {
            query.as_flattened_mut().iter_mut().for_each(|p| p[2] = p[0] - p[1]);
        }
        for pair in [Pair::VertexFace, Pair::EdgeEdge] {
            match lawful(pair, query) {
                Infinite => counts[5] += 1,
                Finite(n) => counts[usize::from(n.min(4))] += 1,
            }
        }
    }
    assert!(counts[0] > 100 && counts[1] > 100 && counts[2] > 100 && counts[5] > 100, "{counts:?}");
}

#[test]
fn vertex_against_segment_in_the_plane() {
    let s = [[-1.0, 0.0], [1.0, 0.0]];
    let step = |from: [f64; 2], to: [f64; 2]| {
        let (t0, t1) = ([from, s[0], s[1]], [to, s[0], s[1]]);
        let times = vertex_segment_2d_times(t0, t1);
        assert_eq!(vertex_segment_2d(t0, t1), times.any());
        assert_eq!(vertex_segment_2d_times(t1, t0), times);
        times
    };
    assert_eq!(step([0.0, 1.0], [0.0, -1.0]), Finite(1));
    assert_eq!(step([1.0, 1.0], [1.0, -1.0]), Finite(1));
    assert_eq!(step([1.0 + f64::EPSILON, 1.0], [1.0 + f64::EPSILON, -1.0]), Finite(0));
    assert_eq!(step([-2.0, 0.0], [2.0, 0.0]), Infinite);
    assert_eq!(step([0.0, 1.0], [0.0, f64::from_bits(1)]), Finite(0));
    // A segment that swings through the vertex and back.
    let (t0, t1) = ([[0.5, 0.5], [-4.0, -4.0], [4.0, 4.0]], [[0.5, 0.5], [4.0, -4.0], [-4.0, 4.0]]);
    assert_eq!(vertex_segment_2d_times(t0, t1), Finite(1));
}

#[test]
fn no_contact_with_what_is_not_finite() {
    let face = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..12 {
            let mut t0 = [[0.0, 0.0, 1.0], face[0], face[1], face[2]];
            let t1 = [[0.0, 0.0, -1.0], face[0], face[1], face[2]];
            t0.as_flattened_mut()[place] = bad;
            assert_eq!(times(Pair::VertexFace, [t0, t1]), Finite(0));
            assert_eq!(times(Pair::EdgeEdge, [t1, t0]), Finite(0));
        }
    }
}

/// The widest integers: exponents over the whole range in one query, in space and flattened.
#[test]
fn exponents_over_the_whole_range() {
    let mut state = 3u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        state >> 11
    };
    for round in 0..4 {
        let mut query: Query = std::array::from_fn(|_| {
            std::array::from_fn(|_| {
                std::array::from_fn(|_| {
                    loop {
                        let value = f64::from_bits(next() << 11 | next() >> 42);
                        if value.is_finite() {
                            break value;
                        }
                    }
                })
            })
        });
        if round % 2 == 0 {
            query.as_flattened_mut().iter_mut().for_each(|p| p[2] = p[1]);
        }
        for pair in [Pair::VertexFace, Pair::EdgeEdge] {
            let expected = times(pair, query);
            let [t0, t1] = query;
            assert_eq!(times(pair, [t1, t0]), expected);
        }
    }
}

/// Numerator and denominator of a row as the `f64` that they are.
fn coordinate(numerator: &str, denominator: &str) -> f64 {
    let [n, d] = [numerator, denominator].map(|s| s.trim().parse::<rug::Integer>().unwrap());
    let exact = rug::Rational::from((n, d));
    let rounded = exact.to_f64();
    assert_eq!(rug::Rational::from_f64(rounded), Some(exact), "{numerator}/{denominator} is an f64");
    rounded
}

/// Calls `f` with file, number, query and known answer of every public query.
pub(crate) fn for_each_public_query(mut f: impl FnMut(&Path, usize, Pair, Query, bool)) {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/ccd-queries"));
    if !root.is_dir() {
        println!("skipped: {} is not there", root.display());
        return;
    }
    let mut queries = 0;
    for set in
        std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir())
    {
        for (pair, folder) in [(Pair::VertexFace, "vertex-face"), (Pair::EdgeEdge, "edge-edge")] {
            let file = set.join(folder).join("data_0_0.csv");
            let text = std::fs::read_to_string(&file).unwrap();
            let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
            for (number, rows) in rows.chunks_exact(8).enumerate() {
                let point = |i: usize| -> [f64; 3] {
                    std::array::from_fn(|k| coordinate(rows[i][2 * k], rows[i][2 * k + 1]))
                };
                let query: Query = std::array::from_fn(|t| std::array::from_fn(|i| point(4 * t + i)));
                f(&file, number, pair, query, rows[0][6].trim() == "1");
                queries += 1;
            }
        }
    }
    println!("{queries} queries");
    assert!(queries > 0);
}

/// Parts of a step whose only contact is at 1/4, with ends of every size.
#[test]
fn contact_within_a_part_of_the_step() {
    use welter_predicates::ccd::{edge_edge_during, vertex_face_during, vertex_segment_2d_during};
    let face = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
    let v = |z| [[0.0, 0.0, z], face[0], face[1], face[2]];
    let e = |z| [[-1.0, 0.0, z], [1.0, 0.0, z], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    let s = |y| [[0.0, y], [-1.0, 0.0], [1.0, 0.0]];
    let tiny = f64::from_bits(1);
    let times = [
        0.0,
        tiny,
        2f64.powi(-1000),
        0.25f64.next_down(),
        0.25,
        0.25f64.next_up(),
        1.0 - 2f64.powi(-53),
        1.0,
    ];
    for (i, &from) in times.iter().enumerate() {
        for (j, &to) in times.iter().enumerate() {
            for size in [1.0, tiny, 2f64.powi(1000)] {
                let expected = i <= j && from <= 0.25 && 0.25 <= to;
                let interval = [from, to];
                assert_eq!(
                    vertex_face_during(v(size), v(-3.0 * size), interval),
                    expected,
                    "{interval:?} {size}"
                );
                assert_eq!(
                    edge_edge_during(e(size), e(-3.0 * size), interval),
                    expected,
                    "{interval:?} {size}"
                );
                assert_eq!(vertex_segment_2d_during(s(size), s(-3.0 * size), interval), expected);
            }
        }
    }
    for bad in [[-0.5, 1.0], [0.0, 1.5], [f64::NAN, 1.0], [0.0, f64::NAN], [1.0, 0.0]] {
        assert!(!vertex_face_during(v(1.0), v(-3.0), bad));
    }
}

#[test]
fn public_queries_have_their_known_answers() {
    for_each_public_query(|file, number, pair, query, truth| {
        assert_eq!(times(pair, query).any(), truth, "{} query {number}", file.display());
    });
}
