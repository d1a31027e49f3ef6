//! Each stage against the last one, on inputs made for it, also where an earlier stage would have answered.

use super::*;
use crate::arithmetic::scaled::power_of_two;
use crate::incircle::Incircle;
use crate::insphere::Insphere;
use crate::moved_grid::{Crossings, Slopes};
use crate::orient2d::Orient2d;
use crate::orient3d::Orient3d;
use crate::orient4d::Orient4d;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: u64) -> i32 {
        (self.bits() % n) as i32
    }

    /// Sign and mantissa of `bits` bits, exponent within `-spread..=spread`.
    fn number(&mut self, bits: u32, spread: i32) -> f64 {
        let mantissa = (self.bits() >> (64 - bits)) as f64 - power_of_two(bits as i32 - 1);
        mantissa * power_of_two(self.below(2 * spread as u64 + 1) - spread - bits as i32)
    }
}

/// How often each stage answered, in the order of `Stage::ALL`.
#[derive(Default, Debug)]
struct Answered {
    lattice: usize,
    double_double: usize,
    expansion: usize,
    zeros: usize,
}

fn compare<Q, const N: usize, const P: usize, const R: usize>(points: &[[f64; N]; P], answered: &mut Answered)
where
    Q: Predicate<N, P, R>,
{
    let exact = by_integer::<Q, Sign, N, P, R>(points);
    let (value, error) = Q::filter(&rows(points));
    if value.abs() > error {
        assert_eq!(Sign::of(value), exact, "filter of {points:?}");
    }
    if let Some(sign) = by_lattice::<Q, Sign, N, P, R>(points) {
        assert_eq!(sign, exact, "lattice of {points:?}");
        answered.lattice += 1;
    }
    if let Some(sign) = by_double_double::<Q, Sign, N, P, R>(points) {
        assert_eq!(sign, exact, "double-double of {points:?}");
        answered.double_double += 1;
    }
    if let Some(sign) = by_expansion::<Q, Sign, N, P, R>(points) {
        assert_eq!(sign, exact, "expansion of {points:?}");
        answered.expansion += 1;
    }
    answered.zeros += usize::from(exact.is_zero());
    // The values of all exact stages agree to the precision of the weakest, and are never zero by underflow.
    let reference = by_integer::<Q, f64, N, P, R>(points);
    assert_eq!(Sign::of(reference), exact);
    assert!(reference.is_finite());
    let values = [by_lattice::<Q, f64, N, P, R>(points), by_expansion::<Q, f64, N, P, R>(points)];
    for value in values.into_iter().flatten() {
        let difference = (value / 2.0 - reference / 2.0).abs();
        assert!(difference <= reference.abs() * 1e-15 + f64::from_bits(1), "{value:e} {reference:e}");
    }
}

/// Points that are degenerate, in a way that all predicates share: sums of few signed powers and reflections.
fn inputs<const N: usize, const P: usize>(random: &mut Random, bits: u32, spread: i32) -> [[f64; N]; P] {
    let corner: [f64; N] = core::array::from_fn(|_| random.number(bits, spread));
    match random.below(4) {
        // In general position.
        0 => core::array::from_fn(|_| core::array::from_fn(|_| random.number(bits, spread))),
        // Corners of one box about the origin: cocircular, cospherical.
        1 => core::array::from_fn(|_| corner.map(|x| if random.bits() & 1 == 0 { x } else { -x })),
        // In one hyperplane along an axis.
        2 => core::array::from_fn(|_| {
            core::array::from_fn(|j| if j == 0 { corner[0] } else { random.number(bits, spread) })
        }),
        // Corners of one box, one of them an ulp off.
        _ => {
            let mut points: [[f64; N]; P] =
                core::array::from_fn(|_| corner.map(|x| if random.bits() & 1 == 0 { x } else { -x }));
            let (i, j) = (random.below(P as u64) as usize, random.below(N as u64) as usize);
            points[i][j] = points[i][j].next_up();
            points
        }
    }
}

fn check<Q, const N: usize, const P: usize, const R: usize>(seed: u64)
where
    Q: Predicate<N, P, R>,
{
    let mut random = Random(seed);
    let mut answered = Answered::default();
    for (bits, spread, count) in [(53, 3, 300), (20, 0, 200), (53, 60, 300), (53, 1000 / Q::DEGREE, 200)] {
        for _ in 0..count {
            compare::<Q, N, P, R>(&inputs(&mut random, bits, spread), &mut answered);
        }
    }
    for _ in 0..100 {
        compare::<Q, N, P, R>(&inputs(&mut random, 53, 960), &mut answered);
    }
    // Every stage was asked often, and degenerate input was there.
    let Answered { lattice, double_double, expansion, zeros } = answered;
    assert!(lattice > 200 && double_double > 300 && expansion > 500 && zeros > 200, "{answered:?}");
}

#[test]
fn stages_agree() {
    check::<Orient2d, 2, 3, 2>(1);
    check::<Orient3d, 3, 4, 3>(2);
    check::<Orient4d, 4, 5, 4>(3);
    check::<Incircle, 2, 4, 3>(4);
    check::<Insphere, 3, 5, 4>(5);
    check::<Crossings, 3, 7, 6>(11);
    check::<Slopes<0>, 3, 6, 5>(12);
    check::<Slopes<1>, 3, 6, 5>(13);
}

/// How many of 1000 inputs each stage settles.
fn shares<Q, const N: usize, const P: usize, const R: usize>(
    mut input: impl FnMut() -> [[f64; N]; P],
) -> [usize; Stage::ALL.len()]
where
    Q: Predicate<N, P, R>,
{
    let mut shares = [0; Stage::ALL.len()];
    for _ in 0..1000 {
        shares[settle::<Q, Sign, N, P, R>(&input()).1 as usize] += 1;
    }
    shares
}

fn check_shares<Q, const N: usize, const P: usize, const R: usize>(seed: u64)
where
    Q: Predicate<N, P, R>,
{
    let mut random = Random(seed);
    let mut any = |bits: u32, spread: i32| -> [[f64; N]; P] {
        core::array::from_fn(|_| core::array::from_fn(|_| random.number(bits, spread)))
    };
    // Points in general position: the filter, but for one in a hundred thousand or fewer.
    assert_eq!(shares::<Q, N, P, R>(|| any(53, 0))[Stage::Filter as usize], 1000);
    // In one hyperplane and, for the lifted predicates, in one sphere or circle: corners of one box.
    let degenerate = |mut points: [[f64; N]; P]| {
        let corner = points[0];
        for (i, point) in points.iter_mut().enumerate() {
            *point = core::array::from_fn(|j| if i >> j & 1 == 1 { corner[j] } else { -corner[j] });
            point[N - 1] = corner[N - 1];
        }
        points
    };
    assert_eq!(shares::<Q, N, P, R>(|| degenerate(any(20, 0)))[Stage::Lattice as usize], 1000);
    assert!(shares::<Q, N, P, R>(|| degenerate(any(53, 1)))[Stage::Lattice as usize] > 950);
    // Exponents spread within +-100: little is left to an exact stage.
    let spread = shares::<Q, N, P, R>(|| any(53, 100));
    assert!(spread[Stage::Filter as usize] + spread[Stage::DoubleDouble as usize] > 900, "{spread:?}");
    // Degenerate and spread: expansions have the range for it.
    assert!(shares::<Q, N, P, R>(|| degenerate(any(53, 60)))[Stage::Expansion as usize] > 700);
    // The whole range: some input is left to the integers.
    assert!(shares::<Q, N, P, R>(|| degenerate(any(53, 960)))[Stage::Integer as usize] > 100);
}

#[test]
fn each_stage_settles_its_share() {
    check_shares::<Orient2d, 2, 3, 2>(6);
    check_shares::<Orient3d, 3, 4, 3>(7);
    check_shares::<Orient4d, 4, 5, 4>(8);
    check_shares::<Incircle, 2, 4, 3>(9);
    check_shares::<Insphere, 3, 5, 4>(10);
    check_shares::<Crossings, 3, 7, 6>(14);
    check_shares::<Slopes<0>, 3, 6, 5>(15);
    check_shares::<Slopes<1>, 3, 6, 5>(16);
}
