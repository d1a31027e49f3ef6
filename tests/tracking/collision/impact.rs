//! Times of impact against exact checks: never late, wide as asked, and with a response that holds its bounds.

use super::pairs::{FAMILIES, Family, PAIRS, Pair, Query};
use rug::Rational;
use welter_kit::exact::moving::{Moving, rational};
use welter_tracking::collision::time_of_impact::MOST_DECISIONS;

/// 2^-40, the default.
const WIDTH: f64 = 1.0 / (1u64 << 40) as f64;

/// What of an impact was found.
#[derive(Debug, Default)]
struct Counts {
    queries: u32,
    contacts: u32,
    /// Brackets that one exact decision confirmed.
    quick: u32,
    /// Brackets whose contact-free part was proven in rational numbers.
    free: u32,
    /// Brackets in which a contact was proven in rational numbers: transversal ones, inside of the primitives.
    met: u32,
    most_decisions: u32,
}

/// The bracket holds the first contact, and the response its bounds.
fn check(pair: Pair, query: &Query, width: f64, counts: &mut Counts) {
    let context = || format!("{pair:?} {query:?} {width:e}");
    let found = pair.impact(query, width).unwrap();
    counts.queries += 1;
    assert_eq!(found.is_some(), pair.touches(query), "{}", context());
    let Some(impact) = found else { return };
    counts.contacts += 1;
    counts.quick += u32::from(impact.decisions <= 1);
    counts.most_decisions = counts.most_decisions.max(impact.decisions);
    assert!(impact.decisions <= MOST_DECISIONS, "{}", context());
    let [lo, hi] = impact.time;
    assert!((0.0..=1.0).contains(&lo) && lo <= hi && hi <= 1.0, "{lo} {hi} {}", context());
    assert!(rational(hi) - rational(lo) <= width || hi == lo.next_up(), "{lo} {hi} {}", context());

    // By the predicate: contact in the bracket and none before it.
    assert!(pair.touches_during(query, [lo, hi]), "{}", context());
    assert_eq!(pair.touches_during(query, [0.0, lo]), hi == 0.0, "{}", context());
    // By rational numbers: a proof that there is no contact before.
    let moving = pair.moving(query);
    if hi > 0.0 {
        let free = moving.stays_beyond(&Rational::new(), &Rational::new(), &rational(lo));
        assert_ne!(free, Some(false), "{}", context());
        counts.free += u32::from(free == Some(true));
    }
    counts.met += u32::from(moving.meets(&rational(lo), &rational(hi)));
    // And they are about to touch: their distance is at most what they can cover.
    let way = moving.speed_squared() * (rational(hi) - rational(lo)).square();
    assert!(moving.distance_squared(&rational(lo)) <= way, "{}", context());
    check_response(pair, query, &moving, &impact, &context);
}

fn check_response(
    pair: Pair,
    query: &Query,
    moving: &Moving,
    impact: &super::pairs::Impact,
    context: &dyn Fn() -> String,
) {
    let [lo, hi] = impact.time;
    let weights: Vec<Rational> = impact.weights.iter().map(|&w| rational(w)).collect();
    assert!(weights.iter().all(|w| *w >= 0), "{:?} {}", impact.weights, context());
    let (first, second) = weights.split_at(pair.first());
    for primitive in [first, second] {
        assert_eq!(primitive.iter().sum::<Rational>(), 1, "{:?} {}", impact.weights, context());
    }
    let length: f64 = impact.normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!((length - 1.0).abs() < 1e-15, "{:?} {}", impact.normal, context());

    // Distance of the points at lo and hi, in units of the size: at most once and twice the way, plus 2^-44.
    let size = moving.size_squared();
    if size == 0 {
        return;
    }
    let in_sizes = |squared: Rational| (squared / &size).to_f64().sqrt();
    let way = in_sizes(moving.speed_squared() * (rational(hi) - rational(lo)).square());
    for (time, ways) in [(lo, 1.0), (hi, 2.0)] {
        let apart = in_sizes(squared(&gap(pair, query, &weights, &rational(time))));
        let bound = (ways * way + 2f64.powi(-44)) * (1.0 + 1e-12);
        assert!(apart <= bound, "{apart:e} > {bound:e} {}", context());
    }
    // They come together: the relative velocity is against the normal, or as good as across it.
    if hi > 0.0 {
        let [at_0, at_1] = [0, 1].map(|t| gap(pair, query, &weights, &Rational::from(t)));
        let along = |k: usize| Rational::from(&at_1[k] - &at_0[k]) * rational(impact.normal[k]);
        let speed = (0..impact.normal.len()).map(along).fold(Rational::new(), |sum, x| sum + x);
        let leaves = speed > 0 && in_sizes(speed.square()) > 1e-5;
        assert!(!leaves, "{:?} {}", impact.normal, context());
    }
}

/// The vector from the point of the second primitive with these weights to that of the first.
fn gap(pair: Pair, query: &Query, weights: &[Rational], time: &Rational) -> Vec<Rational> {
    let dimensions = if pair == Pair::VertexSegment { 2 } else { 3 };
    let coordinate = |k: usize| {
        let term = |(i, weight): (usize, &Rational)| {
            let [p, q] = [0, 1].map(|t| rational(query[t][i][k]));
            let place = Rational::from(&q - &p) * time + p;
            if i < pair.first() { place * weight } else { -place * weight }
        };
        weights.iter().enumerate().map(term).fold(Rational::new(), |sum, x| sum + x)
    };
    (0..dimensions).map(coordinate).collect()
}

fn squared(vector: &[Rational]) -> Rational {
    vector.iter().fold(Rational::new(), |sum, x| sum + Rational::from(x.square_ref()))
}

fn run(family: Family, count: u64, widths: &[f64]) -> Counts {
    let mut counts = Counts::default();
    for seed in 0..count {
        let query = family.query(seed);
        for pair in PAIRS {
            for &width in widths {
                check(pair, &query, width, &mut counts);
            }
        }
    }
    println!("{family:?}: {counts:?}");
    counts
}

#[test]
fn random_impacts_take_one_exact_decision() {
    let counts = run(Family::Random, 400, &[WIDTH]);
    assert!(counts.contacts > 100, "{counts:?}");
    // Almost all: the rest are slow or tangential.
    assert!(counts.quick * 100 >= counts.contacts * 97, "{counts:?}");
    // Free of contact before, and in contact then, by rational numbers alone.
    assert_eq!([counts.free, counts.met], [counts.contacts; 2], "{counts:?}");
}

#[test]
fn brackets_on_small_grids() {
    let counts = run(Family::Grid, 300, &[WIDTH]);
    assert!(counts.contacts > 300 && counts.free > 200 && counts.met > 50, "{counts:?}");
}

#[test]
fn brackets_at_every_scale() {
    let counts = run(Family::Any, 60, &[WIDTH]);
    assert!(counts.contacts > 30, "{counts:?}");
}

#[test]
fn brackets_of_fast_and_thin_primitives() {
    for family in [Family::Fast, Family::Thin] {
        let counts = run(family, 100, &[WIDTH]);
        assert!(counts.contacts > 10, "{counts:?}");
    }
}

#[test]
fn brackets_of_every_width() {
    for family in FAMILIES {
        let counts = run(family, 12, &[0.0, f64::from_bits(1), 1e-18, 1e-15, 0.1, 1.0]);
        assert!(counts.contacts > 0, "{counts:?}");
    }
}
