//! The symbolically perturbed predicates against a displacement by an actual small number.
//!
//! The documented displacement is carried out with `e = 2^-K` in integers of thousands of bits; the plain determinant of
//! the displaced points then has the sign that the perturbed predicate must give, if `K` is large enough: the terms of
//! the polynomial in `e` have coefficients below `2^(K/2)` here and are fewer than that.

use rug::Integer;
use welter_kit::entropy::{Entropy, stream};
use welter_kit::exact::{self, determinant};
use welter_kit::fuzz;
use welter_kit::generate::number::grid;
use welter_predicates::Sign;
use welter_predicates::sos::{incircle_sos, orient2d_sos, orient3d_sos};

/// The sign of the determinant of rows `x.. (w) 1` of displaced points, with `e = 2^-k`.
fn displaced<const D: usize, const N: usize>(
    points: &[[f64; D]; N],
    ids: &[u64; N],
    lifted: bool,
    k: u32,
) -> i32 {
    let rank = |i: usize| ids.iter().filter(|&&id| id < ids[i]).count();
    let coordinate_power = |i: usize, axis: usize| 1_u32 << (N + D * rank(i) + axis);
    let unit = k << (N + D * (N - 1) + D - 1);
    // A number plus e^power, in units of 2^-unit.
    let displace = |value: Integer, power: u32| (value << unit) + (Integer::from(1) << (unit - k * power));
    let whole = |c: f64| Integer::from_f64(c).expect("an integer");
    let rows: Vec<Vec<Integer>> = (0..N)
        .map(|i| {
            let mut row: Vec<Integer> =
                (0..D).map(|axis| displace(whole(points[i][axis]), coordinate_power(i, axis))).collect();
            if lifted {
                let square = points[i].iter().map(|&c| whole(c * c)).sum();
                row.push(displace(square, 1 << rank(i)));
            }
            row.push(Integer::from(1));
            row
        })
        .collect();
    determinant(&rows).cmp0() as i32
}

/// Draws points of a small grid, often coincident, and ids in any order.
fn draw<const D: usize, const N: usize>(seed: u64, values: &[f64]) -> ([[f64; D]; N], [u64; N]) {
    let bytes = stream(seed, 200);
    let mut entropy = Entropy::new(&bytes);
    let mut points = [(); N].map(|()| [(); D].map(|()| entropy.pick(values)));
    if entropy.below(3) == 0 {
        points[N - 1] = points[usize::from(entropy.byte()) % N];
    }
    if entropy.below(4) == 0 {
        points = [(); N].map(|()| [(); D].map(|()| grid(&mut entropy)));
    }
    let mut ids: [u64; N] = std::array::from_fn(|i| 10 + 3 * i as u64);
    for i in 0..N {
        ids.swap(i, usize::from(entropy.byte()) % N);
    }
    (points, ids)
}

fn agrees<const D: usize, const N: usize>(
    cases: u64,
    k: u32,
    lifted: bool,
    perturbed: fn([[f64; D]; N], [u64; N]) -> Sign,
    plain: fn(&[[f64; D]]) -> i32,
) {
    let mut degenerate = 0;
    for seed in 0..cases {
        let (points, ids) = draw::<D, N>(seed, if D == 2 { &[0.0, 1.0, 2.0] } else { &[0.0, 1.0] });
        let expected = displaced(&points, &ids, lifted, k);
        assert_eq!(i32::from(perturbed(points, ids) as i8), expected, "{points:?} {ids:?}");
        degenerate += u64::from(plain(&points) == 0);
    }
    assert!(degenerate * 5 > cases, "only {degenerate} of {cases} needed the displacement");
}

#[test]
fn orient2d_is_that_of_displaced_points() {
    agrees::<2, 3>(2000, 40, false, orient2d_sos, exact::orient);
}

#[test]
fn incircle_is_that_of_displaced_points() {
    agrees::<2, 4>(400, 40, true, incircle_sos, exact::in_sphere);
}

#[test]
fn orient3d_is_that_of_displaced_points() {
    agrees::<3, 4>(12, 24, false, orient3d_sos, exact::orient);
}

#[test]
fn laws_hold_on_every_kind_of_input() {
    // Never zero, the plain sign where there is one, odd under exchanges, a matter of the order of ids alone.
    for seed in 1_000_000..1_002_000 {
        fuzz::perturbed(&stream(seed, 500));
    }
}
