//! Root parity against the complete decision: contacts counted by time, with their multiplicity from rational
//! arithmetic.

use super::{PAIRS, Random, factor, halves, mixed, on_grid, parity};
use crate::ccd::{Pair, Query, for_each_public_query};
use rug::Rational;
use welter_predicates::ccd::parity::{RootParity, vertex_segment_2d};
use welter_predicates::ccd::{self, ContactTimes};
use welter_predicates::intersection::{segments_intersect_3d, triangle_contains_3d};

/// What the complete decision says of a contact on the boundary of the domain: with the primitives at the
/// beginning or the end, or of a vertex with an edge, taken as a pair of edges.
fn touches_boundary(pair: Pair, [t0, t1]: Query) -> bool {
    let edge_edge = |points: [usize; 4]| ccd::edge_edge(points.map(|i| t0[i]), points.map(|i| t1[i]));
    match pair {
        Pair::VertexFace => {
            let rests = |t: [[f64; 3]; 4]| triangle_contains_3d([t[1], t[2], t[3]], t[0]);
            rests(t0) || rests(t1) || [[1, 2], [2, 3], [3, 1]].iter().any(|&[i, j]| edge_edge([0, 0, i, j]))
        }
        Pair::EdgeEdge => {
            let rests = |t: [[f64; 3]; 4]| segments_intersect_3d([t[0], t[1]], [t[2], t[3]]);
            rests(t0)
                || rests(t1)
                || [[0, 0, 2, 3], [1, 1, 2, 3], [0, 1, 2, 2], [0, 1, 3, 3]].into_iter().any(edge_edge)
        }
    }
}

type Vector = [Rational; 3];

fn subtract(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| Rational::from(&a[k] - &b[k]))
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        Rational::from(&a[i] * &b[j]) - Rational::from(&a[j] * &b[i])
    })
}

fn dot(a: &Vector, b: &Vector) -> Rational {
    (0..3).map(|k| Rational::from(&a[k] * &b[k])).sum()
}

/// The corners of the polygon that holds the origin at a contact.
fn polygon(pair: Pair, p: &[Vector; 4]) -> Vec<Vector> {
    let differences: &[[usize; 2]] = match pair {
        Pair::VertexFace => &[[1, 0], [2, 0], [3, 0]],
        Pair::EdgeEdge => &[[0, 2], [1, 2], [1, 3], [0, 3]],
    };
    differences.iter().map(|&[i, j]| subtract(&p[i], &p[j])).collect()
}

fn at(query: &Query, time: &Rational) -> [Vector; 4] {
    std::array::from_fn(|i| {
        std::array::from_fn(|k| {
            let [from, to] = [0, 1].map(|t| Rational::from_f64(query[t][i][k]).unwrap());
            Rational::from(&to - &from) * time + from
        })
    })
}

/// The volume as a polynomial of time, from its values at 0, 1, 2, 3.
fn volume(pair: Pair, query: &Query) -> [Rational; 4] {
    let value = |time: u32| {
        let corners = polygon(pair, &at(query, &Rational::from(time)));
        dot(&cross(&corners[0], &corners[1]), corners.last().unwrap())
    };
    let [a, b, c, d] = [0, 1, 2, 3].map(value);
    // Newton's differences, and the powers of t in t (t-1) / 2 and t (t-1) (t-2) / 6.
    let first = Rational::from(&b - &a);
    let second = Rational::from(&c - &b) - &first;
    let third = Rational::from(&d - &c) - Rational::from(&c - &b) - &second;
    let (half, sixth) = (second / 2u32, third / 6u32);
    [a, first - &half + Rational::from(&sixth * 2u32), half - Rational::from(&sixth * 3u32), sixth]
}

/// The root of multiplicity 2 or 3 of a cubic that is not zero, and that multiplicity.
fn multiple_root([d, c, b, a]: &[Rational; 4]) -> Option<(Rational, u32)> {
    let zero = |x: &Rational| x.cmp0().is_eq();
    if zero(a) {
        let discriminant = c.clone().square() - Rational::from(b * d) * 4u32;
        return (!zero(b) && zero(&discriminant)).then(|| (-(c.clone() / b) / 2u32, 2));
    }
    // With x = t + b / 3a: x^3 + p x + q.
    let shift = Rational::from(b / a) / 3u32;
    let c_a = Rational::from(c / a);
    let p = Rational::from(&c_a) - shift.clone().square() * 3u32;
    let q = shift.clone().square() * &shift * 2u32 - Rational::from(&c_a * &shift) + Rational::from(d / a);
    if zero(&p) && zero(&q) {
        return Some((-shift, 3));
    }
    let discriminant = p.clone().square() * &p * 4u32 + q.clone().square() * 27u32;
    // The double root of x^3 + p x + q is -3q / 2p.
    zero(&discriminant).then(|| (q * -3i32 / p / 2u32 - shift, 2))
}

/// Whether a convex polygon in a plane through the origin, which is not on its boundary, holds it: never
/// without an area.
fn holds_origin(corners: &[Vector]) -> bool {
    let area = cross(&subtract(&corners[1], &corners[0]), &subtract(corners.last().unwrap(), &corners[0]));
    let has_area = area.iter().any(|x| x.cmp0().is_ne());
    has_area
        && (0..corners.len()).all(|i| {
            let normal = cross(&corners[i], &corners[(i + 1) % corners.len()]);
            dot(&normal, &area).cmp0().is_ge()
        })
}

/// The parity of `count` contacts inside the domain, each as often as its time is a root of the volume.
fn with_multiplicity(pair: Pair, query: &Query, count: u32) -> u32 {
    let volume = volume(pair, query);
    assert!(volume.iter().any(|c| c.cmp0().is_ne()), "a contact in one plane reaches the boundary");
    let Some((time, multiplicity)) = multiple_root(&volume) else { return count };
    let value = volume.iter().rev().fold(Rational::new(), |sum, c| sum * &time + c);
    assert!(value.cmp0().is_eq(), "the multiple root is a root");
    if time <= 0 || time >= 1 || !holds_origin(&polygon(pair, &at(query, &time))) {
        return count;
    }
    count - 1 + multiplicity
}

fn expected(pair: Pair, query: Query) -> RootParity {
    let [t0, t1] = query;
    let times = match pair {
        Pair::VertexFace => ccd::vertex_face_times(t0, t1),
        Pair::EdgeEdge => ccd::edge_edge_times(t0, t1),
    };
    if !times.any() {
        return RootParity::Even;
    }
    if touches_boundary(pair, query) {
        return RootParity::OnBoundary;
    }
    match times {
        ContactTimes::Infinite => {
            panic!("contact during an interval, not at the boundary: {pair:?} {query:?}")
        }
        ContactTimes::Finite(n) if with_multiplicity(pair, &query, n.into()) % 2 == 1 => RootParity::Odd,
        ContactTimes::Finite(_) => RootParity::Even,
    }
}

/// Compares so many queries of each kind; returns how often each answer was given.
fn compare(seed: u64, rounds: usize, mut input: impl FnMut(&mut Random) -> Query) -> [[u32; 3]; 2] {
    let mut random = Random(seed);
    let mut counts = [[0; 3]; 2];
    for _ in 0..rounds {
        let query = input(&mut random);
        for pair in PAIRS {
            let parity = parity(pair, query);
            assert_eq!(parity, expected(pair, query), "{pair:?} {query:?}");
            counts[pair as usize][parity as usize] += 1;
        }
    }
    counts
}

/// Queries of each kind, times [`factor`].
const ROUNDS: usize = 20_000;

/// Fewer, because the complete decision takes up to a fraction of a second for these.
const MIXED: usize = 200;

fn compare_grid(size: u64, rounds: usize) {
    let counts = compare(size, rounds, |random| halves(on_grid::<8>(random, size)));
    println!("grid {size}: OnBoundary, Odd, Even of vertex-face and edge-edge {counts:?}");
    assert!(counts.iter().flatten().all(|&count| count > 100));
}

fn compare_uniform(rounds: usize) {
    let counts = compare(6, rounds, |random| halves(random.points::<8>(Random::uniform)));
    println!("uniform: {counts:?}");
    assert!(counts.iter().all(|count| count[1] as usize > rounds / 100 && count[2] > 100));
}

fn compare_mixed(rounds: usize) {
    let counts = compare(5, rounds, |random| halves(mixed::<8>(random)));
    println!("mixed exponents: {counts:?}");
    assert!(counts.iter().all(|count| count[0] > 0 && count[2] > 0));
}

#[test]
fn agrees_with_the_complete_decision_on_grid_1() {
    compare_grid(1, ROUNDS * factor());
}

#[test]
fn agrees_with_the_complete_decision_on_grid_2() {
    compare_grid(2, ROUNDS * factor());
}

#[test]
fn agrees_with_the_complete_decision_on_grid_4() {
    compare_grid(4, ROUNDS * factor());
}

#[test]
fn agrees_with_the_complete_decision_on_uniform_input() {
    compare_uniform(ROUNDS / 10 * factor());
}

#[test]
fn agrees_with_the_complete_decision_on_mixed_exponents() {
    compare_mixed(MIXED * factor());
}

/// Where the answer is not that of the complete decision, the contacts are even in number.
#[test]
fn public_queries_differ_by_even_contacts_only() {
    let mut even = [0; 2];
    for_each_public_query(|file, number, pair, query, truth| {
        let parity = parity(pair, query);
        assert_eq!(parity, expected(pair, query), "{} query {number}", file.display());
        assert!(truth || !parity.certain());
        even[pair as usize] += usize::from(truth && !parity.certain());
    });
    println!("vertex-face and edge-edge queries whose contacts are even in number: {even:?}");
}

/// In the plane the count of contacts and of crossings is compared at roots of the quadratic `f`.
fn compare_planar(seed: u64, rounds: usize, size: u64) -> [u32; 3] {
    let mut random = Random(seed);
    let mut counts = [0; 3];
    for _ in 0..rounds {
        let mut point = || std::array::from_fn(|_| random.integer(size));
        let [t0, t1]: [[[f64; 2]; 3]; 2] = std::array::from_fn(|_| std::array::from_fn(|_| point()));
        let times = ccd::vertex_segment_2d_times(t0, t1);
        let with_end = |i: usize| ccd::vertex_segment_2d([t0[0], t0[i], t0[i]], [t1[0], t1[i], t1[i]]);
        let still = |t: [[f64; 2]; 3]| ccd::vertex_segment_2d(t, t);
        let expected = if still(t0) || still(t1) || with_end(1) || with_end(2) {
            RootParity::OnBoundary
        } else {
            // Of two equal roots one contact is seen: the quadratic's discriminant tells.
            let corner = |t: [[f64; 2]; 3], i: usize| [t[i][0] - t[0][0], t[i][1] - t[0][1]];
            let det = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
            let ([p, q], [r, s]) = ([corner(t0, 1), corner(t0, 2)], [corner(t1, 1), corner(t1, 2)]);
            let middle = det(p, s) + det(r, q);
            let double = middle * middle == 4.0 * det(p, q) * det(r, s);
            match times {
                ContactTimes::Finite(1) if !double => RootParity::Odd,
                ContactTimes::Finite(0..=2) => RootParity::Even,
                _ => panic!("{t0:?} {t1:?}"),
            }
        };
        let parity = vertex_segment_2d(t0, t1);
        assert_eq!(parity, expected, "{t0:?} {t1:?}");
        assert_eq!(vertex_segment_2d(t1, t0), parity);
        for swap in [
            |[x, y]: [f64; 2]| [y, x],
            |[x, y]: [f64; 2]| [-y, x],
            |p: [f64; 2]| p.map(|x| x * 2f64.powi(1000)),
        ] {
            assert_eq!(vertex_segment_2d(t0.map(swap), t1.map(swap)), parity, "{t0:?} {t1:?}");
        }
        counts[parity as usize] += 1;
    }
    counts
}

#[test]
fn agrees_with_the_complete_decision_in_the_plane() {
    for size in [1, 2, 4, 1000] {
        let counts = compare_planar(size, ROUNDS * factor(), size);
        println!("plane, grid {size}: {counts:?}");
        assert!(counts[1] > 100 && counts[2] > 100);
    }
}
