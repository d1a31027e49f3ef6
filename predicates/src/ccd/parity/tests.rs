//! The stages against each other.

use super::super::corners::Corners;
use super::super::{EDGE_EDGE, VERTEX_FACE};
use super::integers::Given;
use super::query::{CUBE, PRISM, later};
use super::rounded::{parity_of_patch, parity_of_step};
use super::surface::{Face, Parity};

/// Pseudorandom numbers.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 11
    }

    /// In [-1, 1), with all bits.
    fn uniform(&mut self) -> f64 {
        self.bits() as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn integer(&mut self, size: u64) -> f64 {
        ((self.bits() >> 20) % (2 * size + 1)) as f64 - size as f64
    }

    fn query(&mut self, mut coordinate: impl FnMut(&mut Self) -> f64) -> [[[f64; 3]; 4]; 2] {
        core::array::from_fn(|_| core::array::from_fn(|_| core::array::from_fn(|_| coordinate(self))))
    }
}

/// How often a stage answered.
#[derive(Default, Debug)]
struct Answered {
    rounded: usize,
    few_bits: usize,
    machine_words: usize,
}

/// The answer in integers of any size, after comparison with all stages that answer.
fn compare<const C: usize>(
    given: &Given<C>,
    faces: &[Face],
    rounded: Option<Parity>,
    answered: &mut Answered,
) -> Parity {
    let exact = given.in_any_bits(faces);
    let [few_bits, machine_words] = [given.in_few_bits(faces), given.in_machine_words(faces)];
    for (answer, count) in [
        (rounded, &mut answered.rounded),
        (few_bits, &mut answered.few_bits),
        (machine_words, &mut answered.machine_words),
    ] {
        assert_eq!(answer.unwrap_or(exact), exact);
        *count += usize::from(answer.is_some());
    }
    exact
}

fn compare_steps(rounds: usize, mut input: impl FnMut() -> [[[f64; 3]; 4]; 2]) -> Answered {
    let mut answered = Answered::default();
    for _ in 0..rounds {
        let query = input();
        let points = query.as_flattened();
        let [a, b, c] = VERTEX_FACE;
        let given = Given::new(points, [a, b, c, later(a), later(b), later(c)], None);
        let rounded = parity_of_step(&Corners::new([&query[0], &query[1]], &VERTEX_FACE, None), &PRISM);
        compare(&given, &PRISM, rounded, &mut answered);
        let [a, b, c, d] = EDGE_EDGE;
        let given = Given::new(points, [a, b, c, d, later(a), later(b), later(c), later(d)], None);
        let rounded = parity_of_step(&Corners::new([&query[0], &query[1]], &EDGE_EDGE, None), &CUBE);
        compare(&given, &CUBE, rounded, &mut answered);
    }
    answered
}

#[test]
fn stages_agree_on_steps() {
    let mut random = Random(1);
    // Rounded arithmetic decides nearly everything in general position, and nothing that is degenerate.
    let answered = compare_steps(500, || random.query(Random::uniform));
    assert!(
        answered.rounded > 990 && answered.machine_words == 1000 && answered.few_bits == 0,
        "{answered:?}"
    );
    let answered = compare_steps(500, || random.query(|random| random.integer(2)));
    assert!(
        answered.rounded > 300 && answered.machine_words == 1000 && answered.few_bits == 1000,
        "{answered:?}"
    );
    // Nearly degenerate: a small grid, with displacements near the error bound of phi.
    let near = |random: &mut Random| random.integer(2) + random.uniform() / (1u64 << 49) as f64;
    let answered = compare_steps(500, || random.query(near));
    assert!(answered.rounded > 100 && answered.rounded < 900, "{answered:?}");
    // At both ends of the range of the rounded stage and beyond: it answers or not, but never wrongly.
    for power in [-1040, -200, -160, -140, 140, 160, 200, 1000] {
        let scale = |x: f64| x * crate::arithmetic::scaled::power_of_two(power / 2);
        let answered = compare_steps(50, || random.query(|random| scale(scale(random.integer(4)))));
        assert!((answered.rounded > 0) == (power.abs() < 150), "{power}: {answered:?}");
        assert_eq!(answered.machine_words, 100);
    }
}

#[test]
fn stages_agree_on_patches() {
    let mut random = Random(2);
    let face = [Face::Patch([0, 1, 2, 3])];
    let mut answered = Answered::default();
    let mut parities = [0; 3];
    for round in 0..2000 {
        let size = if round % 2 == 0 { 2 } else { 1 << 40 };
        let mut points: [[f64; 3]; 5] =
            core::array::from_fn(|_| core::array::from_fn(|_| random.integer(size)));
        if round % 3 == 0 {
            points.iter_mut().for_each(|p| p[2] = 3.0 * p[0] - p[1]);
        }
        let direction = core::array::from_fn(|_| random.integer(if round % 5 == 0 { 1 } else { size }));
        let given = Given::new(&points, [(0, 4), (1, 4), (2, 4), (3, 4)], Some(direction));
        let corners = core::array::from_fn(|i| core::array::from_fn(|k| points[i][k] - points[4][k]));
        let rounded = parity_of_patch(&corners, &direction, &face);
        parities[compare(&given, &face, rounded, &mut answered) as usize] += 1;
    }
    assert!(answered.rounded > 800 && answered.few_bits > 900, "{answered:?}");
    assert_eq!(answered.machine_words, 2000);
    assert!(parities.iter().all(|&count| count > 50), "{parities:?}");
}
