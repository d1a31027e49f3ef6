//! The size of arenas, and named cases of all stages.

use super::staged::{by_determinants, by_expansions, by_filter, by_integers, by_machine_integers};
use super::*;

/// Pseudorandom bits.
struct Bits(u64);

impl Bits {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }
}

fn lap(system: &System, use_determinants: bool, limbs: &mut [u64]) -> usize {
    let units = Units::of(system);
    let mut arena = Arena::new(limbs);
    if use_determinants {
        determinants::solve(system, &units, &mut arena);
    } else {
        elimination::solve(system, &units, &mut arena);
    }
    arena.high_water
}

#[test]
fn arenas_are_large_enough() {
    let mut bits = Bits(5);
    let mut limbs = [0; COORDINATE_LIMBS * LIMBS_PER_LIMB];
    let mut most = [0; 2];
    for round in 0..12 {
        let mut wide = || {
            let sign = if bits.next().is_multiple_of(2) { 1.0 } else { -1.0 };
            // Every other row depends on others in half of the rounds: then all bordered minors are formed.
            if bits.next() % 4 < round % 4 {
                f64::from_bits(1)
            } else {
                sign * f64::MAX / (1 + bits.next() % 7) as f64
            }
        };
        let a: [[f64; 6]; 6] = core::array::from_fn(|_| core::array::from_fn(|_| wide()));
        let b = core::array::from_fn(|_| wide());
        let mut system = System::new(&a, &b);
        if round % 3 == 0 {
            system.rows[5] = system.rows[0];
        }
        // The smallest unit in every row and column.
        for i in 0..6 {
            system.rows[i][i] = f64::from_bits(1);
        }
        system.rows[0][6] = f64::from_bits(1);
        assert!(Units::of(&system).bits > 2090);
        for (most, use_determinants) in most.iter_mut().zip([false, true]) {
            *most = lap(&system, use_determinants, &mut limbs).max(*most);
        }
    }
    // Half is left for what these did not reach.
    let most = most[0].max(most[1]);
    assert!(most > limbs.len() / 4 && most < limbs.len() / 2, "{most} of {}", limbs.len());
}

/// The outcome, after checking that all exact stages that have one agree.
fn agreed<const M: usize, const N: usize>(a: &[[f64; N]; M], b: &[f64; M]) -> Solution<N> {
    let shape = |solution: Solution<N>| match solution {
        Solution::Unique(x) => Solution::Unique(x.map(|x| Sign::of(x) as i8 as f64)),
        other => other,
    };
    let solution = solve(a, b);
    let others = [
        by_filter(a, b),
        by_machine_integers(a, b),
        by_expansions(a, b),
        by_integers(a, b),
        by_determinants(a, b),
    ];
    for (stage, other) in others.into_iter().enumerate().filter_map(|(i, s)| s.map(|s| (i, s))) {
        assert_eq!(shape(other), shape(solution), "stage {stage}: {a:?} {b:?}");
    }
    assert!(others[3].is_some() && others[4].is_some());
    solution
}

#[test]
fn named_cases() {
    // Hilbert's matrix times a common multiple; the solution of the first column is the first unit vector.
    let hilbert: [[f64; 6]; 6] =
        core::array::from_fn(|i| core::array::from_fn(|j| 27720.0 / (i + j + 1) as f64));
    let first = hilbert.map(|row| row[0]);
    assert_eq!(agreed(&hilbert, &first), Solution::Unique([1.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
    // All zero.
    assert_eq!(agreed(&[[0.0; 3]; 2], &[0.0; 2]), Solution::Underdetermined { rank: 0, free: [true; 3] });
    assert_eq!(agreed(&[[0.0; 3]; 2], &[0.0, f64::from_bits(1)]), Solution::Inconsistent);
    // No unknowns, no equations.
    assert_eq!(agreed(&[[]; 2], &[0.0; 2]), Solution::Unique([]));
    assert_eq!(agreed(&[[]; 2], &[0.0, 1.0]), Solution::Inconsistent);
    assert_eq!(agreed(&[[1.0; 0]; 0], &[]), Solution::Unique([]));
    // More equations than unknowns: consistent, and not by one bit.
    let tall = [[1.0, 2.0], [3.0, 5.0], [4.0, 7.0]];
    assert_eq!(agreed(&tall, &[5.0, 13.0, 18.0]), Solution::Unique([1.0, 2.0]));
    assert_eq!(agreed(&tall, &[5.0, 13.0, 18.0f64.next_up()]), Solution::Inconsistent);
    // The first column free.
    let free = [true, false, false];
    let zero_first = [[0.0, 1.0, 2.0], [0.0, 3.0, 4.0], [0.0, 4.0, 6.0]];
    assert_eq!(agreed(&zero_first, &[1.0, 1.0, 2.0]), Solution::Underdetermined { rank: 2, free });
    // Singular by one bit, or not.
    let x = 0.1;
    assert_eq!(
        agreed(&[[x, 3.0 * x], [x, 3.0 * x]], &[1.0, 1.0]),
        Solution::Underdetermined { rank: 1, free: [false, true] }
    );
    assert_eq!(agreed(&[[1.0, 1.0], [1.0, 1.0f64.next_up()]], &[1.0, 1.0]), Solution::Unique([1.0, 0.0]));
}

#[test]
fn components_beyond_the_range_of_numbers() {
    let tiny = f64::from_bits(1);
    assert_eq!(agreed(&[[tiny]], &[f64::MAX]), Solution::Unique([f64::MAX]));
    assert_eq!(agreed(&[[-f64::MAX]], &[tiny]), Solution::Unique([-tiny]));
    assert_eq!(agreed(&[[2.0]], &[tiny]), Solution::Unique([tiny]));
    assert_eq!(
        agreed(&[[f64::MAX, tiny], [tiny, f64::MAX]], &[f64::MAX, tiny]).signs().map(|s| s[0]),
        Some(Sign::Positive)
    );
}

#[test]
fn not_finite() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(solve(&[[1.0, 0.0], [0.0, bad]], &[1.0, 1.0]), Solution::Inconsistent);
        assert_eq!(solve(&[[1.0, 0.0], [0.0, 1.0]], &[bad, 1.0]), Solution::Inconsistent);
        assert!(!solvable(&[[1.0, 0.0], [0.0, 1.0]], &[bad, 1.0], [Sign::Positive; 2]));
        assert_eq!(by_integers(&[[bad]], &[1.0]), None);
        assert_eq!(by_determinants(&[[bad]], &[1.0]), None);
        let error = try_solve(&[[1.0, 0.0], [0.0, 1.0]], &[1.0, bad]);
        assert_eq!(error, Err(NonFinite { argument: 1, coordinate: 1, value: bad }));
    }
}

#[test]
fn columns_are_removed_until_signs_tell() {
    use Sign::{Negative, Positive, Zero};
    // x + y - z = 1: many solutions, some of all signs but one pattern.
    let plane = [[1.0, 1.0, -1.0]];
    assert!(solvable(&plane, &[1.0], [Positive, Positive, Positive]));
    assert!(solvable(&plane, &[1.0], [Negative, Negative, Negative]));
    assert!(!solvable(&plane, &[1.0], [Negative, Negative, Positive]));
    assert!(solvable(&plane, &[1.0], [Zero, Positive, Zero]));
    assert!(!solvable(&plane, &[1.0], [Zero, Zero, Positive]));
    assert!(solvable(&plane, &[0.0], [Zero, Zero, Zero]));
    // The only solution, 0, has all signs.
    assert!(solvable(&[[1.0, 2.0], [3.0, 4.0]], &[0.0, 0.0], [Negative, Positive]));
}

extern crate std;
