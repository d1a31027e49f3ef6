//! A ray and a bilinear patch against the equations of the patch, solved in rational numbers and square roots
//! of these.

use super::{Random, factor, mixed, on_grid};
use welter_kit::exact;
use welter_predicates::ccd::parity::PatchParity::{Even, Odd, OnPatch};
use welter_predicates::ccd::parity::{PatchParity, ray_bilinear_patch};

/// All names of the corners that leave the patch as it is.
const SYMMETRIES: [[usize; 4]; 8] = [
    [0, 1, 2, 3],
    [1, 0, 3, 2],
    [2, 3, 0, 1],
    [3, 2, 1, 0],
    [0, 2, 1, 3],
    [2, 0, 3, 1],
    [1, 3, 0, 2],
    [3, 1, 2, 0],
];

fn lawful(origin: [f64; 3], direction: [f64; 3], patch: [[f64; 3]; 4]) -> PatchParity {
    let expected = ray_bilinear_patch(origin, direction, patch);
    for names in SYMMETRIES {
        let renamed = names.map(|i| patch[i]);
        assert_eq!(
            ray_bilinear_patch(origin, direction, renamed),
            expected,
            "{origin:?} {direction:?} {patch:?}"
        );
    }
    expected
}

fn compare(
    seed: u64,
    rounds: usize,
    power: u32,
    mut input: impl FnMut(&mut Random) -> [[f64; 3]; 6],
) -> [u32; 3] {
    let mut random = Random(seed);
    let mut counts = [0; 3];
    for _ in 0..rounds {
        let [origin, direction, a, b, c, d] = input(&mut random);
        let parity = lawful(origin, direction, [a, b, c, d]);
        assert_eq!(
            parity,
            exact::ray_bilinear_patch(origin, direction, [a, b, c, d], power),
            "{origin:?} {direction:?} {:?}",
            [a, b, c, d]
        );
        counts[parity as usize] += 1;
    }
    counts
}

/// Some corners, and the end of the ray, in the places of others.
fn with_coincidences(random: &mut Random, mut points: [[f64; 3]; 6]) -> [[f64; 3]; 6] {
    if random.below(4) == 0 {
        points[2 + random.below(4) as usize] = points[2 + random.below(4) as usize];
    }
    match random.below(6) {
        // Along a coordinate, or nowhere.
        0 => points[1] = std::array::from_fn(|k| if k as u64 == random.below(4) { 1.0 } else { 0.0 }),
        // Through a corner.
        1 => points[1] = std::array::from_fn(|k| points[2][k] - points[0][k]),
        _ => {}
    }
    points
}

/// Queries of each kind, times [`factor`].
const ROUNDS: usize = 20_000;

fn compare_all(rounds: usize) {
    for size in [1, 2, 4] {
        // All minors are integers below 2^12, so 2^-40 is as good as infinitesimal.
        let counts = compare(size, rounds, 40, |random| {
            let points = on_grid(random, size);
            with_coincidences(random, points)
        });
        println!("grid {size}: OnPatch, Odd, Even {counts:?}");
        assert!(counts.iter().all(|&count| count as usize > rounds / 100));
    }
    let counts = compare(4, rounds, 400, |random| random.points(Random::uniform));
    println!("uniform: {counts:?}");
    assert!(counts[1] as usize > rounds / 100);
    // Numbers are multiples of 2^-1074 below 2^1024: minors of three are 2^-3222 or more, or zero.
    let counts = compare(5, rounds / 50, 6500, |random| {
        let points = mixed(random);
        if random.below(2) == 0 { with_coincidences(random, points) } else { points }
    });
    println!("mixed exponents: {counts:?}");
}

#[test]
fn agrees_with_the_solved_equations() {
    compare_all(ROUNDS * factor());
}

/// The saddle z = x y.
const SADDLE: [[f64; 3]; 4] = [[-1.0, -1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [1.0, 1.0, 1.0]];

#[test]
fn rays_and_a_saddle() {
    let ask = |origin, direction| lawful(origin, direction, SADDLE);
    for scale in [1.0, 2f64.powi(1000), 2f64.powi(-1000), f64::from_bits(1)] {
        let up = [0.0, 0.0, scale];
        assert_eq!(ask([0.5, 0.5, 0.25f64.next_down()], up), Odd);
        assert_eq!(ask([0.5, 0.5, 0.25], up), OnPatch);
        assert_eq!(ask([0.5, 0.5, 0.25f64.next_up()], up), Even);
    }
    // Along a ruling: the ray is (x, e^2 l, e^3 l) with l > 0, and meets z = x y at x = e. From the ruling's end.
    assert_eq!(ask([-2.0, 0.0, 0.0], [1.0, 0.0, 0.0]), Odd);
    assert_eq!(ask([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]), OnPatch);
    // Through the saddle from one side to the same one: it crosses twice.
    assert_eq!(ask([2.0, 2.0, 0.25], [-1.0, -1.0, 0.0]), Even);
    // It touches in one point.
    assert_eq!(ask([1.5, 1.5, 0.0], [-1.0, -1.0, 0.0]), Even);
    // It leaves from between the two places.
    assert_eq!(ask([0.0, 0.0, 0.25], [1.0, 1.0, 0.0]), Odd);
    // Through a corner, from both sides, and from the corner.
    assert_eq!(ask([1.0, 1.0, 1.0], [1.0, 0.0, 0.0]), OnPatch);
    assert_eq!(ask([1.0, 1.0, 0.0], [0.0, 0.0, 1.0]), Even);
    assert_eq!(ask([-1.0, -1.0, 0.0], [0.0, 0.0, 1.0]), Odd);
}

#[test]
fn flat_and_shrunk_patches() {
    let square = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let up = [0.0, 0.0, 1.0];
    assert_eq!(lawful([0.0, 0.0, -1.0], up, square), Odd);
    assert_eq!(lawful([0.0, 0.0, 0.0], up, square), OnPatch);
    assert_eq!(lawful([2.0, 0.0, 0.0], [-1.0, 0.0, 0.0], square), Even);
    assert_eq!(lawful([0.0, 0.0, -1.0], [0.0; 3], square), Even);
    // Edges cross: two triangles that meet in the origin.
    let bow = [square[0], square[1], square[3], square[2]];
    assert_eq!(lawful([0.0, 0.5, 0.0], up, bow), OnPatch);
    assert_eq!(lawful([0.5, 0.0, 0.0], up, bow), Even);
    assert_eq!(lawful([0.5, 0.0, -1.0], up, bow), Even);
    assert_eq!(lawful([0.25, 0.5, -1.0], up, bow), Odd);
    // Folded: beyond the corner c of the boundary the surface lies in two layers.
    let [a, b, c, d] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, 0.0]];
    assert_eq!(lawful([1.125, 1.125, 0.0], up, [a, b, c, d]), OnPatch);
    assert_eq!(lawful([1.125, 1.125, -1.0], up, [a, b, c, d]), Even);
    assert_eq!(lawful([1.5, 1.5, 0.0], up, [a, b, c, d]), Even);
    // A segment and a point.
    assert_eq!(lawful([1.0, 0.0, 0.0], up, [a, b, a, b]), OnPatch);
    assert_eq!(lawful([1.0, 0.0, -1.0], up, [a, b, a, b]), Even);
    assert_eq!(lawful([5.0, 0.0, 0.0], up, [a, b, a, b]), Even);
    assert_eq!(lawful(d, up, [d; 4]), OnPatch);
    assert_eq!(lawful(a, d, [d; 4]), Even);
}

#[test]
fn even_for_what_is_not_finite() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..18 {
            let mut points = [[0.5, 0.5, 0.0], [0.0, 0.0, 1.0], SADDLE[0], SADDLE[1], SADDLE[2], SADDLE[3]];
            points.as_flattened_mut()[place] = bad;
            let [origin, direction, a, b, c, d] = points;
            assert_eq!(ray_bilinear_patch(origin, direction, [a, b, c, d]), Even, "{points:?}");
        }
    }
}
