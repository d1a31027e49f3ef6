//! Laws: scaling changes nothing, names and axes and the direction of time nothing but the last bits.

use super::pairs::{Family, PAIRS, Pair, Query};
use welter_predicates::ccd::ContactTimes;

const WIDTH: f64 = 1.0 / (1u64 << 40) as f64;

fn each(query: &Query, f: impl Fn(f64) -> f64) -> Query {
    query.map(|t| t.map(|p| p.map(&f)))
}

#[test]
fn scaling_by_a_power_of_two_changes_no_bit() {
    let mut impacts = 0;
    for family in [Family::Random, Family::Grid, Family::Thin] {
        for seed in 0..300 {
            let query = family.query(seed);
            for power in [-1060, -1000, -301, 1, 300, 900, 1021] {
                let scale = |x: f64| x * 2f64.powi(power / 2) * 2f64.powi(power - power / 2);
                let unscale = |x: f64| x * 2f64.powi(-power / 2) * 2f64.powi(power / 2 - power);
                let scaled = each(&query, scale);
                if each(&scaled, unscale) != query {
                    continue;
                }
                for pair in PAIRS {
                    let found = pair.impact(&query, WIDTH);
                    assert_eq!(pair.impact(&scaled, WIDTH), found, "{pair:?} {query:?} {power}");
                    impacts += u32::from(found.unwrap().is_some());
                    // Distances scale, the rest is the same.
                    let distance = 0.125;
                    let [plain, scaled] = [
                        pair.approach(&query, distance).unwrap(),
                        pair.approach(&scaled, scale(distance)).unwrap(),
                    ];
                    let rest = |a: super::pairs::Approach| (a.time, a.weights, a.normal, a.steps);
                    assert_eq!(plain.map(rest), scaled.map(rest), "{pair:?} {query:?} {power}");
                }
            }
        }
    }
    assert!(impacts > 1000, "{impacts}");
}

/// The brackets of the same query under other names hold the same time.
#[test]
fn brackets_overlap_under_renaming() {
    let mut impacts = 0;
    for family in [Family::Random, Family::Grid, Family::Any, Family::Thin] {
        let count = if family == Family::Any { 10 } else { 100 };
        for seed in 0..count {
            let query = family.query(seed);
            let axes = |order: [usize; 3]| query.map(|t| t.map(|p| order.map(|k| p[k])));
            let names = |order: [usize; 4]| query.map(|t| order.map(|i| t[i]));
            let mirrored = query.map(|t| t.map(|[x, y, z]| [-x, y, z]));
            let space = [axes([1, 2, 0]), axes([1, 0, 2]), mirrored];
            for pair in PAIRS {
                let others: Vec<Query> = match pair {
                    Pair::VertexFace => {
                        [names([0, 2, 3, 1]), names([0, 2, 1, 3])].into_iter().chain(space).collect()
                    }
                    Pair::EdgeEdge => [names([1, 0, 2, 3]), names([2, 3, 0, 1]), names([3, 2, 0, 1])]
                        .into_iter()
                        .chain(space)
                        .collect(),
                    Pair::VertexSegment => vec![names([0, 2, 1, 3]), axes([1, 0, 2]), mirrored],
                };
                let found = pair.impact(&query, WIDTH).unwrap();
                for other in others {
                    let same = pair.impact(&other, WIDTH).unwrap();
                    assert_eq!(found.is_some(), same.is_some(), "{pair:?} {query:?} {other:?}");
                    if let (Some(a), Some(b)) = (&found, same) {
                        // Half open brackets with a common time.
                        let meet = a.time[0].max(b.time[0]) < a.time[1].min(b.time[1]);
                        let at_zero = a.time == [0.0; 2] && b.time == [0.0; 2];
                        assert!(meet || at_zero, "{:?} {:?} {pair:?} {query:?} {other:?}", a.time, b.time);
                        impacts += 1;
                    }
                }
            }
        }
    }
    assert!(impacts > 500, "{impacts}");
}

#[test]
fn time_reversed_the_first_contact_is_the_last() {
    let (mut single, mut several) = (0, 0);
    for family in [Family::Random, Family::Grid, Family::Fast] {
        for seed in 0..600 {
            let query = family.query(seed);
            let reversed = [query[1], query[0]];
            for pair in PAIRS {
                let Some(first) = pair.impact(&query, WIDTH).unwrap() else { continue };
                let last = pair.impact(&reversed, WIDTH).unwrap().unwrap();
                // Rounded outward by the width of the bracket.
                let from = (1.0 - last.time[1]) - WIDTH;
                let to = (1.0 - last.time[0]) + WIDTH;
                let context = || format!("{:?} {:?} {pair:?} {query:?}", first.time, last.time);
                if pair.times(&query) == ContactTimes::Finite(1) {
                    single += 1;
                    assert!(from <= first.time[1] && first.time[0] <= to, "{}", context());
                } else {
                    several += 1;
                    assert!(first.time[0] <= to, "{}", context());
                }
            }
        }
    }
    assert!(single > 100 && several > 50, "{single} {several}");
}
