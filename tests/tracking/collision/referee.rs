//! Times of impact against the exact contacts of the motion, which no code under test takes part in.

use super::pairs::{Family, PAIRS, Pair, Query};
use rug::Rational;
use welter_kit::entropy::{Entropy, stream};
use welter_kit::exact::collision::Motion;
use welter_kit::exact::moving::rational;
use welter_kit::generate::Movement;

/// 2^-40, the default.
const WIDTH: f64 = 1.0 / (1u64 << 40) as f64;

#[derive(Debug, Default, PartialEq)]
struct Counts {
    queries: u32,
    contacts: u32,
    /// Contacts before which there is a part of the step.
    later: u32,
}

fn judge<const D: usize>(motion: &Motion<D>, impact: Option<[f64; 2]>, width: f64, counts: &mut Counts) {
    let context = || format!("{impact:?} {width:e} {motion:?}");
    let first = motion.first_contact(&Rational::from((1, 1u64 << 50)));
    counts.queries += 1;
    assert_eq!(impact.is_some(), first.is_some(), "{}", context());
    let (Some([lo, hi]), Some((earliest, latest))) = (impact, first) else { return };
    counts.contacts += 1;
    assert!(rational(hi) - rational(lo) <= width || hi == lo.next_up(), "{}", context());
    assert!(earliest <= hi && latest >= lo, "{earliest} {latest} {}", context());
    assert!(motion.during(lo, hi).contacts().any(), "no contact in {}", context());
    if lo > 0.0 {
        counts.later += 1;
        assert!(!motion.during(0.0, lo).contacts().any(), "contact before {}", context());
    }
}

/// Compares the time of impact of a query with the exact contacts; gives the bracket.
fn check(pair: Pair, query: &Query, width: f64, counts: &mut Counts) -> Option<[f64; 2]> {
    let impact = pair.impact(query, width).unwrap().map(|impact| impact.time);
    let [t0, t1] = query;
    match pair {
        Pair::VertexFace => judge(&Motion::vertex_face(t0, t1), impact, width, counts),
        Pair::EdgeEdge => judge(&Motion::edge_edge(t0, t1), impact, width, counts),
        Pair::VertexSegment => {
            let [a, b] = query.map(|t| [0, 1, 2].map(|i| [t[i][0], t[i][1]]));
            judge(&Motion::vertex_segment(&a, &b), impact, width, counts);
        }
    }
    impact
}

#[test]
fn impacts_on_small_grids() {
    let mut counts = Counts::default();
    for seed in 0..150 {
        for pair in PAIRS {
            check(pair, &Family::Grid.query(seed), [WIDTH, 0.0, 0.25][(seed % 3) as usize], &mut counts);
        }
    }
    println!("{counts:?}");
    assert!(counts.queries == 450 && counts.contacts > 150 && counts.later > 60, "{counts:?}");
}

/// Grids with points at rest, contacts at an end of the step, and motions in one plane that turns.
#[test]
fn impacts_of_flat_and_resting_motions() {
    for movement in [Movement::Grid1, Movement::Resting, Movement::Sheet, Movement::EndTouch] {
        let mut counts = Counts::default();
        for seed in 0..40 {
            let query = movement.draw::<3, 4>(&mut Entropy::new(&stream(seed, 700)));
            for pair in PAIRS {
                check(pair, &query, WIDTH, &mut counts);
            }
        }
        println!("{movement:?}: {counts:?}");
        assert!(counts.queries == 120 && counts.contacts > 20 && counts.later > 0, "{counts:?}");
    }
}

/// Something that goes from `x = -a` to `x = b` at a height of `above`, over a second primitive that is the graph of
/// `z = s x` with a slope from `k a` to `-k b`. Its height there, `(-a + (a+b) t) k (a - (a+b) t)`, is never positive,
/// and zero, twice, at `t = a / (a+b)`.
fn grazing(pair: Pair, [a, b, k]: [f64; 3], above: f64) -> Query {
    [(-a, k * a), (b, -k * b)].map(|(x, slope)| {
        let low = [-4.0, -4.0 * slope];
        let high = [4.0, 4.0 * slope];
        match pair {
            Pair::VertexFace => {
                [[x, 0.0, above], [low[0], -4.0, low[1]], [high[0], -4.0, high[1]], [0.0, 4.0, 0.0]]
            }
            Pair::EdgeEdge => {
                [[low[0], 0.0, low[1]], [high[0], 0.0, high[1]], [x, -1.0, above], [x, 1.0, above]]
            }
            Pair::VertexSegment => {
                [[x, above, 0.0], [low[0], low[1], 0.0], [high[0], high[1], 0.0], [0.0; 3]]
            }
        }
    })
}

#[test]
fn tangential_impacts() {
    let mut graze = Counts::default();
    let (mut pass, mut miss) = (Counts::default(), Counts::default());
    for pair in PAIRS {
        for (a, b) in [(1, 1), (1, 2), (2, 1), (3, 4), (1, 4), (4, 3)] {
            for k in [1.0, 3.0] {
                let shape = [f64::from(a), f64::from(b), k];
                let [lo, hi] = check(pair, &grazing(pair, shape, 0.0), WIDTH, &mut graze).unwrap();
                let time = Rational::from((a, a + b));
                assert!(lo < time && time <= hi, "{pair:?} {shape:?} {lo} {hi}");
                for power in [-4, -40, -1074] {
                    let above = 2f64.powi(power / 2) * 2f64.powi(power - power / 2);
                    check(pair, &grazing(pair, shape, above), WIDTH, &mut miss);
                    check(pair, &grazing(pair, shape, -above), WIDTH, &mut pass);
                }
            }
        }
    }
    println!("grazing {graze:?}, above {miss:?}, below {pass:?}");
    assert_eq!(graze, Counts { queries: 36, contacts: 36, later: 36 });
    assert_eq!(miss, Counts { queries: 108, contacts: 0, later: 0 });
    assert_eq!(pass, Counts { queries: 108, contacts: 108, later: 108 });
}
