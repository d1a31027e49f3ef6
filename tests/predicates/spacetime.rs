//! Space-time collision: against the enumeration of weights, its twin by elimination, laws, and watertightness.

use welter_kit::entropy::{Entropy, stream};
use welter_kit::exact::swept_meet;
use welter_kit::generate::number;
use welter_predicates::ccd::spacetime::{by_elimination, edge_edge, vertex_face, vertex_segment_2d};
use welter_predicates::intersection::{segments_intersect_3d, triangle_contains_3d};

type Places<const N: usize, const P: usize> = [[[f64; N]; P]; 2];

/// Where coordinates come from.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Family {
    /// Integers up to this magnitude.
    Grid(i32),
    Uniform,
    /// Whole range of exponents, each coordinate its own.
    Mixed,
}

/// Places at both ends of a step; of the grids a third are flattened.
fn draw<const N: usize, const P: usize>(family: Family, seed: u64) -> (Places<N, P>, [u32; P]) {
    let bytes = stream(seed, 500);
    let mut entropy = Entropy::new(&bytes);
    let mut places = [[[0.0; N]; P]; 2];
    for x in places.as_flattened_mut().as_flattened_mut() {
        *x = match family {
            Family::Grid(most) => f64::from(entropy.between(-most, most)),
            Family::Uniform => number::uniform(&mut entropy),
            Family::Mixed if entropy.below(4) == 0 => number::grid(&mut entropy),
            Family::Mixed => {
                number::uniform(&mut entropy) * number::power_of_two(entropy.between(-1000, 1000))
            }
        };
    }
    if matches!(family, Family::Grid(_)) && seed.is_multiple_of(3) {
        let axis = usize::from(entropy.byte()) % N;
        let both = entropy.below(2) == 0;
        for point in places.as_flattened_mut() {
            point[axis] = if both { 1.0 } else { point[(axis + 1) % N] };
        }
    }
    let start = u32::from(entropy.byte());
    let turn = usize::from(entropy.byte());
    let indices = std::array::from_fn(|i| start + [3_u32, 0, 2, 1][(i + turn) % P.max(4)]);
    (places, indices)
}

const FAMILIES: [(Family, u64); 5] = [
    (Family::Grid(1), 1500),
    (Family::Grid(2), 1500),
    (Family::Grid(4), 1500),
    (Family::Uniform, 500),
    (Family::Mixed, 60),
];

/// Compares on all families and prints and asserts the share of hits on grids.
fn compare<const N: usize, const P: usize>(
    ours: fn(Places<N, P>, [u32; P]) -> bool,
    twin: fn(Places<N, P>, [u32; P]) -> bool,
    oracle: fn(&Places<N, P>, &[u32; P]) -> bool,
) {
    for (family, count) in FAMILIES {
        let (mut hits, mut queries) = (0, 0);
        for seed in 0..count {
            let (places, indices) = draw(family, seed);
            let expected = oracle(&places, &indices);
            assert_eq!(ours(places, indices), expected, "{family:?} {places:?} {indices:?}");
            assert_eq!(twin(places, indices), expected, "{family:?} {places:?} {indices:?}");
            hits += u64::from(expected);
            queries += 1;
        }
        println!("{family:?}: {hits} of {queries} collide");
        assert!(hits > 0 && hits < queries, "{family:?}: {hits} of {queries}");
        // Many more against the twin alone.
        for seed in count..8 * count {
            let (places, indices) = draw(family, seed);
            assert_eq!(ours(places, indices), twin(places, indices), "{family:?} {places:?} {indices:?}");
        }
    }
}

#[test]
fn vertex_face_agrees_with_the_enumeration_of_weights() {
    compare::<3, 4>(
        |[t0, t1], i| vertex_face(t0, t1, i),
        |[t0, t1], i| by_elimination::vertex_face(t0, t1, i),
        |places, indices| swept_meet::<3, 4, 4>(places, indices, 1),
    );
}

#[test]
fn edge_edge_agrees_with_the_enumeration_of_weights() {
    compare::<3, 4>(
        |[t0, t1], i| edge_edge(t0, t1, i),
        |[t0, t1], i| by_elimination::edge_edge(t0, t1, i),
        |places, indices| swept_meet::<3, 4, 4>(places, indices, 2),
    );
}

#[test]
fn vertex_segment_agrees_with_the_enumeration_of_weights() {
    compare::<2, 3>(
        |[t0, t1], i| vertex_segment_2d(t0, t1, i),
        |[t0, t1], i| by_elimination::vertex_segment_2d(t0, t1, i),
        |places, indices| swept_meet::<2, 3, 3>(places, indices, 1),
    );
}

/// Axes, units, names, and the direction of time together with that of the indices.
#[test]
fn laws() {
    let mut hits = [0; 2];
    for seed in 0..6000 {
        let (places, indices) = draw::<3, 4>([Family::Grid(2), Family::Uniform][(seed % 2) as usize], seed);
        let ask = |edges: bool, [t0, t1]: Places<3, 4>, i: [u32; 4]| {
            if edges { edge_edge(t0, t1, i) } else { vertex_face(t0, t1, i) }
        };
        for edges in [false, true] {
            let expected = ask(edges, places, indices);
            hits[usize::from(edges)] += u32::from(expected);
            let same = |law: &str, other: Places<3, 4>, i: [u32; 4]| {
                assert_eq!(ask(edges, other, i), expected, "{law}: edges {edges} {places:?} {indices:?}");
            };
            let points = |f: &dyn Fn([f64; 3]) -> [f64; 3]| places.map(|t| t.map(f));
            same("axes permuted", points(&|[x, y, z]| [y, z, x]), indices);
            same("axes swapped", points(&|[x, y, z]| [y, x, z]), indices);
            same("negated", points(&|p| p.map(|x| -x)), indices);
            same("one axis negated", points(&|[x, y, z]| [x, -y, z]), indices);
            for power in [-900, -40, 7, 1000] {
                same("scaled", points(&|p| p.map(|x| x * number::power_of_two(power))), indices);
            }
            let [t0, t1] = places;
            same("time and indices reversed", [t1, t0], indices.map(|i| u32::MAX - i));
            let orders: &[[usize; 4]] = if edges {
                &[[1, 0, 2, 3], [0, 1, 3, 2], [2, 3, 0, 1]]
            } else {
                &[[0, 2, 3, 1], [0, 2, 1, 3]]
            };
            for order in orders {
                same("renamed", places.map(|t| order.map(|i| t[i])), order.map(|i| indices[i]));
            }
            same("indices shifted", places, indices.map(|i| 10 * i + 5));
        }
    }
    assert!(hits.iter().all(|&count| count > 300), "{hits:?}");
}

/// Reversal of time alone takes other diagonals: some answers change, and they are not all one way.
#[test]
fn reversing_time_alone_may_change_the_answer() {
    let mut changed = [0; 2];
    for seed in 0..4000 {
        let ([t0, t1], indices) = draw::<3, 4>(Family::Uniform, seed);
        let (forward, backward) = (vertex_face(t0, t1, indices), vertex_face(t1, t0, indices));
        if forward != backward {
            changed[usize::from(forward)] += 1;
        }
    }
    assert!(changed.iter().all(|&count| count > 0), "{changed:?}");
}

#[test]
fn contact_at_the_ends_of_the_step_is_seen() {
    let mut hits = 0;
    for seed in 0..6000 {
        let ([t0, t1], indices) = draw::<3, 4>(Family::Grid(2), seed);
        for [p, q, r, s] in [t0, t1] {
            if triangle_contains_3d([q, r, s], p) {
                assert!(vertex_face(t0, t1, indices), "{t0:?} {t1:?} {indices:?}");
                hits += 1;
            }
            if segments_intersect_3d([p, q], [r, s]) {
                assert!(edge_edge(t0, t1, indices), "{t0:?} {t1:?} {indices:?}");
                hits += 1;
            }
        }
    }
    assert!(hits > 200, "{hits}");
}

#[test]
fn no_contact_with_what_is_not_finite() {
    let at = |z| [[0.0, 0.0, z], [-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
    assert!(vertex_face(at(1.0), at(-1.0), [0, 1, 2, 3]));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..12 {
            let mut t0 = at(1.0);
            t0.as_flattened_mut()[place] = bad;
            for (t0, t1) in [(t0, at(-1.0)), (at(-1.0), t0)] {
                assert!(!vertex_face(t0, t1, [0, 1, 2, 3]) && !edge_edge(t0, t1, [0, 1, 2, 3]));
                assert!(!by_elimination::vertex_face(t0, t1, [0, 1, 2, 3]));
                assert!(!by_elimination::edge_edge(t0, t1, [0, 1, 2, 3]));
            }
            if place < 6 {
                let mut s0 = [[0.0, 1.0], [-1.0, 0.0], [1.0, 0.0]];
                s0.as_flattened_mut()[place] = bad;
                let s1 = [[0.0, -1.0], [-1.0, 0.0], [1.0, 0.0]];
                assert!(!vertex_segment_2d(s0, s1, [0, 1, 2]) && !vertex_segment_2d(s1, s0, [0, 1, 2]));
                assert!(!by_elimination::vertex_segment_2d(s0, s1, [0, 1, 2]));
            }
        }
    }
}

/// The corners of an octahedron, and its faces.
const OCTAHEDRON: [[f64; 3]; 6] =
    [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0], [-4.0, 0.0, 0.0], [0.0, -4.0, 0.0], [0.0, 0.0, -4.0]];
const FACES: [[usize; 3]; 8] =
    [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];

/// How many faces report the vertex, going either way.
fn reports(surface: [[[f64; 3]; 6]; 2], path: [[f64; 3]; 2], names: [u32; 6]) -> [usize; 2] {
    let mut count = [0; 2];
    for face in FACES {
        let at = |t: usize| [path[t], surface[t][face[0]], surface[t][face[1]], surface[t][face[2]]];
        let indices = [99, names[face[0]], names[face[1]], names[face[2]]];
        count[0] += usize::from(vertex_face(at(0), at(1), indices));
        count[1] += usize::from(vertex_face(at(1), at(0), indices));
    }
    count
}

/// A vertex that starts strictly inside a closed surface and ends strictly outside passes through some face; on
/// grids often through edges and corners only.
#[test]
fn no_crack_in_a_moving_surface() {
    let mut through = [0; 9];
    for seed in 0..20_000_u64 {
        let bytes = stream(seed, 300);
        let mut entropy = Entropy::new(&bytes);
        let grid = seed % 4 != 0;
        let mut number = |most: i32| {
            let whole = f64::from(entropy.between(-most, most));
            if grid { whole } else { whole * f64::from(entropy.between(1, 30_000)) / 30_001.0 }
        };
        // Inside: the sum of magnitudes is below 4. Outside: beyond all corners at the end.
        let start = [number(1), number(1), number(1)];
        let mut last: [[f64; 3]; 6] = [[0.0; 3]; 6];
        last.as_flattened_mut().iter_mut().for_each(|x| *x = number(4));
        let mut end = [number(4), number(4), number(4)];
        end[(seed % 3) as usize] = if seed % 2 == 0 { 5.0 } else { -5.0 };
        let turn = usize::from(entropy.byte()) % 6;
        let names = std::array::from_fn(|i| [4_u32, 1, 5, 0, 3, 2][(i + turn) % 6]);
        let found = reports([OCTAHEDRON, last], [start, end], names);
        assert!(found[0] > 0 && found[1] > 0, "{start:?} {end:?} {last:?} {names:?}");
        through[found[0]] += 1;
    }
    println!("faces that report: {through:?}");
    assert!(through[2..].iter().sum::<i32>() > 2000, "{through:?}");
}

#[test]
fn a_vertex_passes_through_a_corner_and_through_an_edge() {
    let moved = |by: [f64; 3]| OCTAHEDRON.map(|p| std::array::from_fn(|k| p[k] + by[k]));
    for by in [[0.0; 3], [1.0, 2.0, -3.0], [0.0, 2f64.powi(-40), 2f64.powi(40)]] {
        let to = |p: [f64; 3]| std::array::from_fn(|k| p[k] + by[k]);
        let surface = [OCTAHEDRON, moved(by)];
        for turn in 0..6_u32 {
            let names = std::array::from_fn(|i| (i as u32 + turn) % 6);
            // Relative to the surface along an axis through a corner of four faces, and across an edge of two.
            let [corner, _] = reports(surface, [[0.0; 3], to([8.0, 0.0, 0.0])], names);
            let [edge, _] = reports(surface, [[0.0; 3], to([8.0, 8.0, 0.0])], names);
            let [face, _] = reports(surface, [[0.0; 3], to([8.0, 8.0, 8.0])], names);
            assert_eq!((corner, edge, face), (4, 2, 1), "{by:?} {names:?}");
        }
    }
}

/// The same in the plane, for a polygon of four segments.
#[test]
fn no_crack_in_a_moving_polygon() {
    let square = [[3.0, 0.0], [0.0, 3.0], [-3.0, 0.0], [0.0, -3.0]];
    let mut several = 0;
    for seed in 0..20_000_u64 {
        let bytes = stream(seed, 200);
        let mut entropy = Entropy::new(&bytes);
        let mut number = |most: i32| f64::from(entropy.between(-most, most));
        let start = [number(1), number(1)];
        let last: [[f64; 2]; 4] = std::array::from_fn(|_| [number(3), number(3)]);
        let end = if seed % 2 == 0 { [number(3), 4.0] } else { [-4.0, number(3)] };
        let names: [u32; 4] = std::array::from_fn(|i| [2_u32, 0, 3, 1][(i + seed as usize) % 4]);
        let mut found = [0; 2];
        for i in 0..4 {
            let j = (i + 1) % 4;
            let (t0, t1) = ([start, square[i], square[j]], [end, last[i], last[j]]);
            let indices = [9, names[i], names[j]];
            found[0] += i32::from(vertex_segment_2d(t0, t1, indices));
            found[1] += i32::from(vertex_segment_2d(t1, t0, indices));
        }
        assert!(found[0] > 0 && found[1] > 0, "{start:?} {end:?} {last:?} {names:?}");
        several += i32::from(found[0] > 1);
    }
    assert!(several > 1000, "{several}");
}

/// Where the answer is not that of the straight motion, it depends on the choice of the diagonals: the kink of a swept edge makes the
/// difference, and with the other diagonal of an edge there is none.
#[test]
fn public_queries_differ_by_kinks_only() {
    let mut differences = 0;
    crate::ccd::for_each_public_query(|file, number, pair, [t0, t1], truth| {
        let contact = |indices| match pair {
            crate::ccd::Pair::VertexFace => vertex_face(t0, t1, indices),
            crate::ccd::Pair::EdgeEdge => edge_edge(t0, t1, indices),
        };
        if contact([0, 1, 2, 3]) != truth {
            differences += 1;
            let names = [[1, 0, 2, 3], [0, 1, 3, 2], [1, 0, 3, 2], [0, 3, 2, 1], [0, 2, 1, 3]];
            let agrees = names.into_iter().any(|indices| contact(indices) == truth);
            assert!(
                agrees,
                "{} query {number}: {pair:?}, contact {truth} under no diagonals",
                file.display()
            );
        }
    });
    println!("{differences} queries differ");
}
