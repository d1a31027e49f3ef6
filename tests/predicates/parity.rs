//! Crossing parity: named cases, laws, and agreement with the complete decision and with rational arithmetic.

mod closed;
mod patch;
mod roots;

use crate::ccd::{Pair, Query, equivalents, scaled};
use welter_predicates::ccd::parity::RootParity::{Even, Odd, OnBoundary};
use welter_predicates::ccd::parity::{RootParity, edge_edge, vertex_face, vertex_segment_2d};

const PAIRS: [Pair; 2] = [Pair::VertexFace, Pair::EdgeEdge];

fn parity(pair: Pair, [t0, t1]: Query) -> RootParity {
    match pair {
        Pair::VertexFace => vertex_face(t0, t1),
        Pair::EdgeEdge => edge_edge(t0, t1),
    }
}

/// By what the environment variable `WELTER_CASES` multiplies the number of random queries: 1 in a run of the
/// tests; a million queries of each kind, that is 50 in release mode, have been run once.
fn factor() -> usize {
    std::env::var("WELTER_CASES").ok().and_then(|value| value.parse().ok()).unwrap_or(1)
}

/// Pseudorandom numbers.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 11
    }

    /// Below `n`.
    fn below(&mut self, n: u64) -> u64 {
        (self.bits() >> 20) % n
    }

    /// An integer of magnitude at most `size`.
    fn integer(&mut self, size: u64) -> f64 {
        self.below(2 * size + 1) as f64 - size as f64
    }

    /// Sign, a mantissa of few or of all bits, and an exponent in -1000..=1000.
    fn mixed(&mut self) -> f64 {
        let few = self.below(2) == 0;
        let mantissa = if few { self.integer(3) } else { self.bits() as f64 - 2f64.powi(52) };
        let power = self.below(2001) as i32 - 1000 - 53;
        mantissa * 2f64.powi(power / 2) * 2f64.powi(power - power / 2)
    }

    /// In [-1, 1).
    fn uniform(&mut self) -> f64 {
        self.bits() as f64 * 2f64.powi(-52) - 1.0
    }

    fn points<const P: usize>(&mut self, mut coordinate: impl FnMut(&mut Self) -> f64) -> [[f64; 3]; P] {
        std::array::from_fn(|_| std::array::from_fn(|_| coordinate(self)))
    }
}

/// Points of an integer grid, a third of them in a plane or on a line.
fn on_grid<const P: usize>(random: &mut Random, size: u64) -> [[f64; 3]; P] {
    let mut points = random.points(|random| random.integer(size));
    match random.below(6) {
        0 => points.iter_mut().for_each(|p| p[2] = p[0] - p[1]),
        1 => points.iter_mut().for_each(|p| *p = [p[0], 2.0 * p[0], -p[0]]),
        _ => {}
    }
    points
}

/// Points whose exponents vary over most of the range, a third of them in a plane or on a line.
fn mixed<const P: usize>(random: &mut Random) -> [[f64; 3]; P] {
    let exponents: [f64; 3] = std::array::from_fn(|_| random.mixed());
    let kind = random.below(3);
    let mut points: [[f64; 3]; P] = random.points(|random| match kind {
        // Everything its own exponent.
        0 => random.mixed(),
        // A coarse grid with rare values of another order.
        1 => {
            let small = if random.below(8) == 0 { random.mixed() } else { 0.0 };
            random.integer(2) + small
        }
        _ => random.integer(3),
    });
    if kind == 2 {
        // Another unit in each coordinate.
        points.iter_mut().flat_map(|p| p.iter_mut().zip(exponents)).for_each(|(x, e)| *x *= e);
    }
    match random.below(6) {
        0 => points.iter_mut().for_each(|p| p[2] = p[1]),
        1 => points.iter_mut().for_each(|p| *p = [p[0], 2.0 * p[0], -p[0]]),
        _ => {}
    }
    points.iter_mut().flatten().for_each(|x| *x = if x.is_finite() { *x } else { 1.0 });
    points
}

fn halves<const P: usize>(points: [[f64; 3]; P]) -> Query {
    std::array::from_fn(|t| std::array::from_fn(|i| points[4 * t + i]))
}

/// The answer, after checking that it does not depend on names, order, units or the direction of time.
fn lawful(pair: Pair, query: Query) -> RootParity {
    let expected = parity(pair, query);
    for (law, other) in equivalents(pair, query) {
        assert_eq!(parity(pair, other), expected, "{law}: {pair:?} {query:?}");
    }
    expected
}

const SWINGING_FACE: [[[f64; 3]; 3]; 2] = [
    [[-4.0, -4.0, -4.0], [4.0, -4.0, 4.0], [0.0, 4.0, 0.0]],
    [[-4.0, -4.0, 4.0], [4.0, -4.0, -4.0], [0.0, 4.0, 0.0]],
];

fn against_swinging_face(z: f64) -> Query {
    let [[a, b, c], [d, e, f]] = SWINGING_FACE;
    [[[-1.0, 0.0, z], a, b, c], [[1.0, 0.0, z], d, e, f]]
}

const SWINGING_EDGES: Query = [
    [[-4.0, 0.0, -4.0], [4.0, 0.0, 4.0], [-1.0, -1.0, -0.25], [-1.0, 1.0, -0.25]],
    [[-4.0, 0.0, 4.0], [4.0, 0.0, -4.0], [1.0, -1.0, -0.25], [1.0, 1.0, -0.25]],
];

const FLAT_PATCH: Query = [
    [[-1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [0.0, 0.0, 0.25], [0.0, 1.0, 0.25]],
    [[-1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 0.25], [0.0, 1.0, 0.25]],
];

const SINGLE_ROOT: Query = [
    [[-2.0, -1.0, 1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [-2.0, 2.0, 1.0]],
    [[2.0, -1.0, 0.0], [2.0, 0.0, 2.0], [2.0, -1.0, -2.0], [-1.0, 0.0, -1.0]],
];

const SLIDING: Query = [
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]],
    [[1.5, 0.0, 0.0], [2.5, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]],
];

#[test]
fn two_contacts_are_even() {
    assert_eq!(lawful(Pair::VertexFace, against_swinging_face(-0.25)), Even);
    assert_eq!(lawful(Pair::EdgeEdge, SWINGING_EDGES), Even);
}

#[test]
fn a_tangential_contact_is_even() {
    assert_eq!(lawful(Pair::VertexFace, against_swinging_face(0.0)), Even);
}

#[test]
fn a_flat_patch_beside_the_origin_is_no_contact() {
    assert_eq!(lawful(Pair::EdgeEdge, FLAT_PATCH), Even);
    // With an end of the resting edge where the other one turns about, and inside of what it sweeps.
    let at = |z: f64| FLAT_PATCH.map(|t| [t[0], t[1], [0.0, 0.0, z], [0.0, 1.0, z]]);
    assert_eq!(lawful(Pair::EdgeEdge, at(0.0)), OnBoundary);
    let beside = FLAT_PATCH.map(|t| [t[0], t[1], [0.75, 0.0, 0.25], [0.75, 1.0, 0.25]]);
    assert_eq!(lawful(Pair::EdgeEdge, beside), OnBoundary);
}

#[test]
fn a_single_root_is_odd_along_all_axes() {
    assert_eq!(lawful(Pair::EdgeEdge, SINGLE_ROOT), Odd);
}

/// The volume is 8 - 48 t + 90 t^2 - 54 t^3, with the roots 1/3 and, twice, 2/3, when the edges are parallel.
#[test]
fn a_double_root_without_a_contact_does_not_count() {
    let t0 = [[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [0.0, 0.0, -1.0], [-1.0, 1.0, 1.0]];
    let t1 = [[-1.0, 0.0, -1.0], [0.0, 1.0, -1.0], [0.0, -1.0, 1.0], [1.0, -1.0, 0.0]];
    assert_eq!(lawful(Pair::EdgeEdge, [t0, t1]), Odd);
}

#[test]
fn collinear_sliding_is_on_the_boundary() {
    assert_eq!(lawful(Pair::EdgeEdge, SLIDING), OnBoundary);
    let [t0, mut t1] = SLIDING;
    (t1[0][0], t1[1][0]) = (1.0, 2.0);
    assert_eq!(lawful(Pair::EdgeEdge, [t0, t1]), OnBoundary);
    (t1[0][0], t1[1][0]) = (1.0 - f64::EPSILON, 2.0 - f64::EPSILON);
    assert_eq!(lawful(Pair::EdgeEdge, [t0, t1]), Even);
}

/// Products of degree 6 would overflow from 2^171 on, and underflow below 2^-179.
#[test]
fn magnitudes_beyond_the_range_of_degree_six() {
    for power in [250, 1000, -1000] {
        let ask = |pair, query| parity(pair, scaled(query, power).unwrap());
        assert_eq!(ask(Pair::VertexFace, against_swinging_face(-0.25)), Even);
        assert_eq!(ask(Pair::VertexFace, against_swinging_face(0.0)), Even);
        assert_eq!(ask(Pair::EdgeEdge, SWINGING_EDGES), Even);
        assert_eq!(ask(Pair::EdgeEdge, FLAT_PATCH), Even);
        assert_eq!(ask(Pair::EdgeEdge, SINGLE_ROOT), Odd);
        assert_eq!(ask(Pair::EdgeEdge, SLIDING), OnBoundary);
    }
}

#[test]
fn rounded_differences_would_be_wrong() {
    // The vertex is next to the triangle's edge, by less than the difference's last place.
    let tiny = 2f64.powi(-60);
    let step = |x: f64| {
        let face = [[1.0, -4.0, 0.0], [1.0, 4.0, 0.0], [8.0, 0.0, 0.0]];
        [[[x, 0.0, 1.0], face[0], face[1], face[2]], [[x, 0.0, -1.0], face[0], face[1], face[2]]]
            .map(|t| t.map(|[x, y, z]| [x, y, z]))
    };
    assert_eq!(lawful(Pair::VertexFace, step(1.0)), OnBoundary);
    assert_eq!(lawful(Pair::VertexFace, step(1f64.next_up())), Odd);
    assert_eq!(lawful(Pair::VertexFace, step(1f64.next_down())), Even);
    // The same about an origin at distance 1: 1 + tiny is not an f64.
    let shifted = |x: f64| {
        let face = [[0.0, -4.0, 0.0], [0.0, 4.0, 0.0], [8.0, 0.0, 0.0]];
        let end = [[1.0, -4.0, 0.0], [1.0, 4.0, 0.0], [8.0, 0.0, 0.0]];
        [[[x, 0.0, 1.0], face[0], face[1], face[2]], [[x + 1.0, 0.0, -1.0], end[0], end[1], end[2]]]
    };
    assert_eq!(lawful(Pair::VertexFace, shifted(tiny)), Odd);
    assert_eq!(lawful(Pair::VertexFace, shifted(-tiny)), Even);
    assert_eq!(lawful(Pair::VertexFace, shifted(0.0)), OnBoundary);
}

#[test]
fn degenerate_primitives() {
    let p = [1.0, 2.0, 3.0];
    let q = [[0.0, 1.0, 2.0], [2.0, 3.0, 4.0]];
    assert_eq!(lawful(Pair::VertexFace, q.map(|v| [v, p, p, p])), OnBoundary);
    assert_eq!(lawful(Pair::EdgeEdge, q.map(|v| [v, v, p, p])), OnBoundary);
    assert_eq!(lawful(Pair::VertexFace, q.map(|v| [[v[0], v[1], 0.0], p, p, p])), Even);
    // A face that collapses to a segment at the moment when the vertex passes through it.
    let t0 = [[1.0, 0.0, -1.0], [0.0, -1.0, 0.0], [2.0, -1.0, 0.0], [1.0, 1.0, 0.0]];
    let t1 = [[1.0, 0.0, 1.0], [0.0, 1.0, 0.0], [2.0, 1.0, 0.0], [1.0, -1.0, 0.0]];
    assert_eq!(lawful(Pair::VertexFace, [t0, t1]), OnBoundary);
    // Everything in one place.
    assert_eq!(lawful(Pair::VertexFace, [[p; 4]; 2]), OnBoundary);
    assert_eq!(lawful(Pair::EdgeEdge, [[[0.0; 3]; 4]; 2]), OnBoundary);
}

#[test]
fn laws_on_small_grids() {
    let mut random = Random(7);
    let mut counts = [0u32; 3];
    for round in 0..3_000 {
        let query = halves(on_grid::<8>(&mut random, [1, 2, 4][round % 3]));
        for pair in PAIRS {
            counts[lawful(pair, query) as usize] += 1;
        }
    }
    assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
}

#[test]
fn even_for_what_is_not_finite() {
    let [[a, b, c], _] = SWINGING_FACE;
    let through = [[[0.0, 0.0, 9.0], a, b, c], [[0.0, 0.0, -9.0], a, b, c]];
    assert_eq!(parity(Pair::VertexFace, through), Odd);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..24 {
            for (pair, mut query) in [(Pair::VertexFace, through), (Pair::EdgeEdge, SINGLE_ROOT)] {
                query.as_flattened_mut().as_flattened_mut()[place] = bad;
                assert_eq!(parity(pair, query), Even, "{pair:?} {query:?}");
            }
        }
        for place in 0..12 {
            let mut t = [[[0.0, 1.0], [-1.0, 0.0], [1.0, 0.0]], [[0.0, -1.0], [-1.0, 0.0], [1.0, 0.0]]];
            assert_eq!(vertex_segment_2d(t[0], t[1]), Odd);
            t.as_flattened_mut().as_flattened_mut()[place] = bad;
            assert_eq!(vertex_segment_2d(t[0], t[1]), Even);
        }
    }
}
