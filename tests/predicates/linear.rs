//! The linear solver: every stage against rational arithmetic, laws, and the share of the filter.

use welter_kit::entropy::{Entropy, stream};
use welter_kit::exact::rational;
use welter_kit::fuzz::{agrees, linear_systems};
use welter_kit::generate::{Kind, number, system};
use welter_predicates::Sign;
use welter_predicates::linear::{Solution, solvable, solve, staged};

/// What a solution says that must not change when names and units do.
#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Unique(Vec<Sign>),
    Inconsistent,
    Rank(usize),
}

fn shape<const N: usize>(solution: &Solution<N>) -> Shape {
    match solution {
        Solution::Unique(x) => Shape::Unique(x.iter().map(|&x| Sign::of(x)).collect()),
        Solution::Inconsistent => Shape::Inconsistent,
        Solution::Underdetermined { rank, .. } => Shape::Rank(*rank),
    }
}

#[test]
fn every_stage_agrees_with_rational_arithmetic() {
    for seed in 0..6000 {
        linear_systems(&stream(seed, 700));
    }
}

/// Systems of which many are singular: rank by rank, all occur.
#[test]
fn singular_systems_of_every_rank() {
    let mut ranks = [0; 6];
    let (mut unique, mut inconsistent) = (0, 0);
    for seed in 0..8000 {
        let mut entropy = stream(seed, 60).into_iter().map(|byte| f64::from(byte % 3) - 1.0);
        let mut next = || entropy.next().unwrap();
        let mut a = [[0.0; 6]; 6];
        a.as_flattened_mut().iter_mut().for_each(|x| *x = next());
        // All but some rows are sums or differences of these.
        let generators = 1 + usize::try_from(seed % 6).unwrap();
        for row in generators..6 {
            let (p, q, sign) = (row % generators, (2 * row + 1) % generators, next());
            a[row] = std::array::from_fn(|j| a[p][j] + sign * a[q][j]);
        }
        let mut b = [0.0; 6];
        if seed / 6 % 2 == 0 {
            // Consistent: the sum of all columns but one.
            b = a.map(|row| row[..5].iter().sum());
        } else {
            b.iter_mut().for_each(|x| *x = next());
        }
        let solution = solve(&a, &b);
        assert!(agrees(&solution, &rational::outcome(&rational::lifted(&a, &b), 6)), "{a:?} {b:?}");
        match solution {
            Solution::Unique(_) => unique += 1,
            Solution::Inconsistent => inconsistent += 1,
            Solution::Underdetermined { rank, .. } => ranks[rank] += 1,
        }
    }
    assert!(ranks[1..].iter().all(|&count| count > 100), "{ranks:?}");
    assert!(unique > 100 && inconsistent > 1000, "{unique} {inconsistent}");
}

#[test]
fn laws() {
    let mut shapes = [0; 3];
    for seed in 0..3000 {
        let bytes = stream(seed, 900);
        let mut entropy = Entropy::new(&bytes);
        let (a, b) = system::<5, 5>(&mut entropy);
        let expected = shape(&solve(&a, &b));
        shapes[match expected {
            Shape::Unique(_) => 0,
            Shape::Inconsistent => 1,
            Shape::Rank(_) => 2,
        }] += 1;
        let signs = [(); 5].map(|()| entropy.pick(&[Sign::Positive, Sign::Negative]));
        let any = solvable(&a, &b, signs);
        let same = |law: &str, a: [[f64; 5]; 5], b: [f64; 5]| {
            assert_eq!(shape(&solve(&a, &b)), expected, "{law}: {a:?} {b:?}");
            assert_eq!(solvable(&a, &b, signs), any, "{law}: {signs:?} {a:?} {b:?}");
        };
        // Equations in another order, and negated.
        let order = [3, 0, 4, 1, 2];
        same("rows permuted", order.map(|i| a[i]), order.map(|i| b[i]));
        same("rows negated", a.map(|row| row.map(|x| -x)), b.map(|x| -x));
        // Each equation times its own power of two, where that is exact.
        let mut scaled = (a, b);
        for i in 0..5 {
            let power = entropy.between(-1000, 1000);
            let by = |x: f64, power: i32| x * number::power_of_two(power);
            if a[i].iter().chain([&b[i]]).all(|&x| by(by(x, power), -power) == x) {
                scaled.0[i] = a[i].map(|x| by(x, power));
                scaled.1[i] = by(b[i], power);
            }
        }
        same("rows scaled", scaled.0, scaled.1);
        // Unknowns in another order: the signs and the questions go with them.
        let permuted = a.map(|row| order.map(|j| row[j]));
        let moved = match &expected {
            Shape::Unique(signs) => Shape::Unique(order.iter().map(|&j| signs[j]).collect()),
            other => other.clone(),
        };
        assert_eq!(shape(&solve(&permuted, &b)), moved, "columns permuted: {a:?} {b:?}");
        assert_eq!(solvable(&permuted, &b, order.map(|j| signs[j])), any, "columns permuted: {a:?} {b:?}");
        // Each unknown in a unit of its own.
        let mut columns = a;
        for j in 0..5 {
            let power = entropy.between(-1000, 1000);
            let by = |x: f64, power: i32| x * number::power_of_two(power);
            if a.iter().all(|row| by(by(row[j], power), -power) == row[j]) {
                columns.iter_mut().for_each(|row| row[j] = by(row[j], power));
            }
        }
        same("columns scaled", columns, b);
    }
    assert!(shapes.iter().all(|&count| count > 200), "{shapes:?}");
}

/// A filter that decides less than it should makes everything slow; one that decides more is wrong elsewhere.
#[test]
fn the_filter_settles_uniform_systems() {
    fn settled<const N: usize>(kind: Kind) -> [f64; 2] {
        const COUNT: u64 = 2000;
        let mut settled = [0.0; 2];
        for seed in 0..COUNT {
            let bytes = stream(seed, 1000);
            let mut entropy = Entropy::new(&bytes);
            let a: [[f64; N]; N] = kind.draw(&mut entropy);
            let [b]: [[f64; N]; 1] = kind.draw(&mut entropy);
            settled[0] += f64::from(u8::from(staged::by_filter(&a, &b).is_some()));
            settled[1] += f64::from(u8::from(staged::by_filtered_determinants(&a, &b).is_some()));
        }
        settled.map(|count| count / COUNT as f64)
    }
    for (shares, most) in [
        (settled::<5>(Kind::Uniform), 0.999),
        (settled::<6>(Kind::Uniform), 0.999),
        (settled::<6>(Kind::Scaled), 0.95),
    ] {
        assert!(shares[0] >= most, "{shares:?}");
    }
    assert!(settled::<6>(Kind::Uniform)[1] >= 0.999);
}
