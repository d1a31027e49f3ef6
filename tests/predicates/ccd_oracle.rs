//! Continuous collision against exact algebra: the oracle on motions with known answers, then the predicates against it.

use rug::Rational;
use welter_kit::entropy::{Entropy, stream};
use welter_kit::exact::collision::{Contacts, Count, Motion};
use welter_kit::fuzz::{check_edge_edge, check_vertex_face, check_vertex_segment};
use welter_kit::generate::Movement;

/// The environment variable that holds another number of queries of each kind.
const QUERIES: &str = "WELTER_QUERIES";

fn contacts(count: Count, on_boundary: bool, multiplicity_sum: Option<u32>) -> Contacts {
    Contacts { count, on_boundary, multiplicity_sum }
}

/// A face that turns about the y axis through the vertex's path and back.
fn swing(height: f64) -> Motion<3> {
    let t0 = [[-1.0, 0.0, height], [-4.0, -4.0, -4.0], [4.0, -4.0, 4.0], [0.0, 4.0, 0.0]];
    let t1 = [[1.0, 0.0, height], [-4.0, -4.0, 4.0], [4.0, -4.0, -4.0], [0.0, 4.0, 0.0]];
    Motion::vertex_face(&t0, &t1)
}

#[test]
fn roots_at_one_and_three_quarters() {
    assert_eq!(swing(-0.25).contacts(), contacts(Count::Finite(2), false, Some(2)));
    let (low, high) = swing(-0.25).first_contact(&Rational::from((1, 1000))).unwrap();
    assert!(low <= 0.25 && high >= 0.25 && Rational::from(&high - &low) <= Rational::from((1, 1000)));
    for (begin, end, any) in
        [(0.0, 0.24, false), (0.25, 0.25, true), (0.26, 0.74, false), (0.26, 0.75, true), (0.76, 1.0, false)]
    {
        assert_eq!(swing(-0.25).during(begin, end).contacts().any(), any, "from {begin} to {end}");
    }
    // The face is at rest for a moment in its own plane z = 0, one quarter above the vertex.
    assert_eq!(swing(-0.25).squared_distance_at(&Rational::from((1, 2))), Rational::from((1, 16)));
    assert_eq!(swing(-0.25).squared_distance_at(&Rational::from((3, 4))), 0);
}

#[test]
fn tangential_contact_and_none() {
    assert_eq!(swing(0.0).contacts(), contacts(Count::Finite(1), false, Some(2)));
    assert_eq!(swing(f64::from_bits(1)).contacts(), contacts(Count::Finite(0), false, Some(0)));
    assert_eq!(swing(-f64::from_bits(1)).contacts(), contacts(Count::Finite(2), false, Some(2)));
}

#[test]
fn edges_that_swing_and_edges_in_one_plane() {
    let t0 = [[-4.0, 0.0, -4.0], [4.0, 0.0, 4.0], [-1.0, -1.0, -0.25], [-1.0, 1.0, -0.25]];
    let t1 = [[-4.0, 0.0, 4.0], [4.0, 0.0, -4.0], [1.0, -1.0, -0.25], [1.0, 1.0, -0.25]];
    assert_eq!(Motion::edge_edge(&t0, &t1).contacts(), contacts(Count::Finite(2), false, Some(2)));
    // The turning edge and one end of the other stay in the plane y = 0, and do not touch.
    let t0 = [[-1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [0.0, 0.0, 0.25], [0.0, 1.0, 0.25]];
    let t1 = [[-1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 0.25], [0.0, 1.0, 0.25]];
    assert!(!Motion::edge_edge(&t0, &t1).contacts().any());
    // With its end pulled down to the axis of the turn it touches all the time, and in the middle the edge is a point.
    let on_axis = [t0, t1].map(|t| [t[0], t[1], [0.0; 3], t[3]]);
    assert_eq!(Motion::edge_edge(&on_axis[0], &on_axis[1]).contacts(), contacts(Count::Infinite, true, None));
}

#[test]
fn one_transversal_root() {
    let t0 = [[-2.0, -1.0, 1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [-2.0, 2.0, 1.0]];
    let t1 = [[2.0, -1.0, 0.0], [2.0, 0.0, 2.0], [2.0, -1.0, -2.0], [-1.0, 0.0, -1.0]];
    let motion = Motion::edge_edge(&t0, &t1);
    assert_eq!(motion.contacts(), contacts(Count::Finite(1), false, Some(1)));
    let (low, high) = motion.first_contact(&Rational::from((1, 1 << 20))).unwrap();
    assert!((low.to_f64() - 0.32088).abs() < 1e-5 && (high.to_f64() - 0.32088).abs() < 1e-5, "{low} {high}");
}

#[test]
fn collinear_sliding() {
    let t0 = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    let to = |x: f64| Motion::edge_edge(&t0, &[[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], t0[2], t0[3]]);
    assert_eq!(to(1.5).contacts(), contacts(Count::Infinite, true, None));
    assert_eq!(to(1.0).contacts(), contacts(Count::Finite(1), true, None));
    assert_eq!(to(1.0 - f64::EPSILON).contacts(), contacts(Count::Finite(0), false, None));
    let third = Rational::from((2, 3));
    assert_eq!(to(1.5).first_contact(&Rational::from(1)), Some((third.clone(), third)));
    assert_eq!(to(0.5).squared_distance_at(&Rational::from((1, 2))), Rational::from((9, 16)));
}

#[test]
fn sliding_in_the_plane_of_a_face() {
    let face = [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [0.0, 4.0, 1.0]];
    let step = |from: [f64; 2], to: [f64; 2]| {
        let [t0, t1] = [from, to].map(|[x, y]| [[x, y, 1.0], face[0], face[1], face[2]]);
        Motion::vertex_face(&t0, &t1).contacts()
    };
    assert_eq!(step([-1.0, 1.0], [5.0, 1.0]), contacts(Count::Infinite, true, None));
    assert_eq!(step([-1.0, 1.0], [1.0, -1.0]), contacts(Count::Finite(1), true, None));
    assert_eq!(step([-1.0, 0.5], [1.0, -1.5]), contacts(Count::Finite(0), false, None));
    assert_eq!(step([1.0, 1.0], [1.0, 1.0]), contacts(Count::Infinite, true, None));
    assert_eq!(step([3.0, 3.0], [3.0, 3.0]), contacts(Count::Finite(0), false, None));
}

#[test]
fn contact_on_the_boundary_of_the_domain() {
    let face = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
    let fall = |x: f64, y: f64, z0: f64, z1: f64| {
        let [t0, t1] = [z0, z1].map(|z| [[x, y, z], face[0], face[1], face[2]]);
        Motion::vertex_face(&t0, &t1).contacts()
    };
    assert_eq!(fall(0.0, 0.0, 1.0, -1.0), contacts(Count::Finite(1), false, Some(1)));
    assert_eq!(fall(0.0, 0.0, 1.0, 0.0), contacts(Count::Finite(1), true, Some(0)));
    assert_eq!(fall(0.0, -4.0, 1.0, -1.0), contacts(Count::Finite(1), true, Some(0)));
    assert_eq!(fall(0.0, 4.0, 1.0, -2.0), contacts(Count::Finite(1), true, Some(0)));
    assert_eq!(fall(0.0, 4.5, 1.0, -2.0), contacts(Count::Finite(0), false, Some(0)));
}

/// The corners of the face, seen from the vertex, are the rows of `(4 I - J) diag(4 t - 1, 4 t - 2, 4 t - 3)` with `J`
/// all ones. Multiplied from the left by (2, 1, 1), (1, 2, 1), (1, 1, 2) the first factor gives four times the first,
/// second, third unit vector: at 1/4, 1/2, 3/4 the vertex is inside the face with these weights.
#[test]
fn three_contacts() {
    let place = |t: f64| {
        let [x, y, z] = [1.0, 2.0, 3.0].map(|root| 4.0 * t - root);
        [[0.0; 3], [3.0 * x, -y, -z], [-x, 3.0 * y, -z], [-x, -y, 3.0 * z]]
    };
    let motion = Motion::vertex_face(&place(0.0), &place(1.0));
    assert_eq!(motion.contacts(), contacts(Count::Finite(3), false, Some(3)));
    for (begin, end, count) in [(0.0, 0.5, 2), (0.25, 0.75, 3), (0.375, 0.625, 1), (0.76, 1.0, 0)] {
        assert_eq!(motion.during(begin, end).contacts().count, Count::Finite(count), "from {begin} to {end}");
    }
}

#[test]
fn vertex_and_segment_of_the_plane() {
    let s = [[-1.0, 0.0], [1.0, 0.0]];
    let step = |from, to| Motion::vertex_segment(&[from, s[0], s[1]], &[to, s[0], s[1]]).contacts();
    assert_eq!(step([0.0, 1.0], [0.0, -1.0]), contacts(Count::Finite(1), false, Some(1)));
    assert_eq!(step([1.0, 1.0], [1.0, -1.0]), contacts(Count::Finite(1), true, Some(0)));
    assert_eq!(
        step([1.0f64.next_up(), 1.0], [1.0f64.next_up(), -1.0]),
        contacts(Count::Finite(0), false, Some(0))
    );
    assert_eq!(step([-2.0, 0.0], [2.0, 0.0]), contacts(Count::Infinite, true, None));
    assert_eq!(step([-2.0, 0.0], [-1.0, 0.0]), contacts(Count::Finite(1), true, None));
}

/// A run says so many times how far it is.
const PROGRESS: u64 = 20;

/// Outcomes of queries: no contact, one, two, three, more (as only motions in a plane have them), infinitely many.
type Tally = [u64; 6];

/// Compares the predicates with the oracle on `count` motions, the kinds by turns, and returns the outcomes.
fn compare<const D: usize, const N: usize>(
    name: &str,
    kinds: &[Movement],
    count: u64,
    check: fn([[[f64; D]; N]; 2]) -> Count,
) -> Tally {
    let count = std::env::var(QUERIES).map_or(count, |text| text.parse().unwrap());
    let mut tally = Tally::default();
    for seed in 0..count {
        if seed > 0 && seed % count.div_ceil(PROGRESS) == 0 {
            println!("{name}: {seed} queries so far: {tally:?}");
        }
        let kind = kinds[usize::try_from(seed).unwrap() % kinds.len()];
        let query = kind.draw(&mut Entropy::new(&stream(seed, 400)));
        match check(query) {
            Count::Finite(times) => tally[usize::try_from(times.min(4)).unwrap()] += 1,
            Count::Infinite => tally[5] += 1,
        }
    }
    println!(
        "{name}: {count} queries without difference; 0, 1, 2, 3, more, infinitely many times: {tally:?}"
    );
    tally
}

/// Queries of either kind on the grids, and those of the plane.
const ON_GRIDS: u64 = 20_000;

#[test]
fn vertex_face_on_grids() {
    let tally = compare("vertex-face on grids", &Movement::GRIDS, ON_GRIDS, check_vertex_face);
    assert!([0, 1, 2, 3, 5].iter().all(|&i| tally[i] > 0), "{tally:?}");
}

#[test]
fn edge_edge_on_grids() {
    let tally = compare("edge-edge on grids", &Movement::GRIDS, ON_GRIDS, check_edge_edge);
    assert!([0, 1, 2, 3, 5].iter().all(|&i| tally[i] > 0), "{tally:?}");
}

#[test]
fn vertex_segment_on_grids() {
    let tally = compare("vertex-segment on grids", &Movement::GRIDS, ON_GRIDS, check_vertex_segment);
    // A quadratic has no third root.
    assert!(tally[3] == 0 && [0, 1, 2, 5].iter().all(|&i| tally[i] > 0), "{tally:?}");
}

/// Queries of each pair of primitives of mixed exponents: one takes up to a second.
const MIXED: u64 = 60;

#[test]
fn vertex_face_of_mixed_exponents() {
    let kinds = &Movement::MIXED_EXPONENTS;
    let tally = compare("vertex-face, mixed exponents", kinds, MIXED, check_vertex_face);
    assert!([0, 1, 5].iter().all(|&i| tally[i] > 0), "{tally:?}");
}

#[test]
fn edge_edge_of_mixed_exponents() {
    let kinds = &Movement::MIXED_EXPONENTS;
    let tally = compare("edge-edge, mixed exponents", kinds, MIXED, check_edge_edge);
    assert!([0, 1, 5].iter().all(|&i| tally[i] > 0), "{tally:?}");
}

#[test]
fn vertex_segment_of_mixed_exponents() {
    let kinds = &Movement::MIXED_EXPONENTS;
    let tally = compare("vertex-segment, mixed exponents", kinds, MIXED, check_vertex_segment);
    assert!([0, 1, 5].iter().all(|&i| tally[i] > 0), "{tally:?}");
}

/// Queries of each pair of primitives of the kinds that are neither plain grids nor of mixed exponents.
const OTHERS: u64 = 2_000;

#[test]
fn touching_resting_and_nearly_degenerate_motions() {
    let kinds = [Movement::Resting, Movement::Sheet, Movement::EndTouch, Movement::Ulps];
    for tally in [
        compare("vertex-face, others", &kinds, OTHERS, check_vertex_face),
        compare("edge-edge, others", &kinds, OTHERS, check_edge_edge),
        compare("vertex-segment, others", &kinds, OTHERS, check_vertex_segment),
    ] {
        assert!([0, 1, 2, 5].iter().all(|&i| tally[i] > 0), "{tally:?}");
    }
}
