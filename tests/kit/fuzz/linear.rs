//! The linear solver against elimination in rational numbers.

use crate::entropy::Entropy;
use crate::exact::rational::{self, Outcome};
use crate::generate::system;
use rug::Rational;
use welter_predicates::Sign;
use welter_predicates::linear::{RELATIVE_ERROR, Solution, solvable, solve, staged};

/// Systems of several shapes drawn from the bytes.
pub fn linear_systems(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    let entropy = &mut entropy;
    match entropy.below(12) {
        0 => check::<1, 1>(entropy),
        1 => check::<2, 2>(entropy),
        2 => check::<3, 3>(entropy),
        3 => check::<4, 4>(entropy),
        4 | 5 => check::<5, 5>(entropy),
        6 | 7 => check::<6, 6>(entropy),
        8 => check::<6, 4>(entropy),
        9 => check::<4, 6>(entropy),
        10 => check::<2, 5>(entropy),
        _ => check::<5, 2>(entropy),
    }
}

/// Draws a system and checks every stage, and whether a solution of drawn signs exists.
fn check<const M: usize, const N: usize>(entropy: &mut Entropy<'_>) {
    let (a, b) = system::<M, N>(entropy);
    let rows = rational::lifted(&a, &b);
    let expected = rational::outcome(&rows, N);
    let stages = [
        Some(solve(&a, &b)),
        staged::by_filter(&a, &b),
        staged::by_machine_integers(&a, &b),
        staged::by_expansions(&a, &b),
        staged::by_integers(&a, &b),
        staged::by_determinants(&a, &b),
    ];
    assert!(stages[4].is_some() && stages[5].is_some());
    for (stage, solution) in stages.iter().enumerate() {
        if let Some(solution) = solution {
            assert!(agrees(solution, &expected), "stage {stage}: {solution:?} {expected:?} {a:?} {b:?}");
        }
    }
    let signs = [(); N].map(|()| entropy.pick(&[Sign::Positive, Sign::Positive, Sign::Negative, Sign::Zero]));
    let oriented: Vec<Vec<Rational>> = rows
        .iter()
        .map(|row| {
            let factors = signs.iter().map(|&sign| sign as i8).chain([1]);
            row.iter().zip(factors).map(|(x, factor)| Rational::from(x * factor)).collect()
        })
        .collect();
    let expected = rational::solvable(&oriented, N);
    assert_eq!(solvable(&a, &b, signs), expected, "{signs:?} {a:?} {b:?}");
    assert_eq!(staged::solvable_by_determinants(&a, &b, signs), expected, "{signs:?} {a:?} {b:?}");
}

/// Whether an outcome is the exact one, and components are within their bound.
#[must_use]
pub fn agrees<const N: usize>(solution: &Solution<N>, exact: &Outcome) -> bool {
    match (solution, exact) {
        (Solution::Unique(x), Outcome::Unique(exact)) => {
            x.iter().zip(exact).all(|(&x, exact)| component_agrees(x, exact))
        }
        (Solution::Inconsistent, Outcome::Inconsistent) => true,
        (Solution::Underdetermined { rank, free }, Outcome::Underdetermined(exact_rank, exact_free)) => {
            rank == exact_rank && free[..] == exact_free[..]
        }
        _ => false,
    }
}

fn component_agrees(x: f64, exact: &Rational) -> bool {
    let value = Rational::from_f64(x).expect("components are finite");
    if value.cmp0() != exact.cmp0() {
        return false;
    }
    let (magnitude, size) = (Rational::from(value.abs_ref()), Rational::from(exact.abs_ref()));
    if x.abs() == f64::MAX && size > magnitude {
        return true;
    }
    let bound = Rational::from_f64(RELATIVE_ERROR).expect("finite") * &size
        + Rational::from_f64(f64::from_bits(1)).expect("finite");
    Rational::from(&value - exact).abs() <= bound
}
