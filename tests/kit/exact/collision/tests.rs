//! The parts of the oracle against each other; its answers to known motions stand in `tests/predicates/ccd_oracle.rs`.

use super::*;
use crate::entropy::{Entropy, stream};
use crate::generate::Movement;

/// Motions of every kind.
fn motions<const D: usize>(
    count: u64,
    motion: impl Fn(&Movement, Entropy<'_>) -> Motion<D>,
) -> Vec<Motion<D>> {
    let draw = |kind: &Movement, seed| motion(kind, Entropy::new(&stream(seed, 700)));
    Movement::ALL
        .iter()
        .flat_map(|kind| (0..count).map(|seed| draw(kind, seed)).collect::<Vec<_>>())
        .collect()
}

fn in_space(count: u64) -> Vec<Motion<3>> {
    let mut all = motions(count, |kind, mut entropy| {
        let [t0, t1] = kind.draw::<3, 4>(&mut entropy);
        Motion::vertex_face(&t0, &t1)
    });
    all.extend(motions(count, |kind, mut entropy| {
        let [t0, t1] = kind.draw::<3, 4>(&mut entropy);
        Motion::edge_edge(&t0, &t1)
    }));
    all
}

/// Signs of minors and enumerated weights say the same at rational times.
#[test]
fn minors_agree_with_weights() {
    let mut seen = [0_u32; 3];
    for motion in in_space(12) {
        let mut system = System::new(&motion);
        for t in [(0, 1), (1, 1), (1, 2), (1, 3), (3, 4)].map(Rational::from) {
            let expected = motion.touch_at(&t);
            assert_eq!(system.touch(&mut Time::Rational(t.clone())), expected, "{motion:?} {t}");
            // The squared distance is zero exactly at a contact.
            assert_eq!(motion.squared_distance_at(&t) == 0, expected != Touch::None, "{motion:?} {t}");
            seen[expected as usize] += 1;
        }
    }
    assert!(seen.iter().all(|&count| count > 20), "{seen:?}");
}

/// Looking at all roots of all minors and between them finds what the roots of the determinant give.
#[test]
fn all_minors_agree_with_the_determinant() {
    let mut compared = 0;
    for motion in in_space(3).into_iter().filter(|motion| motion.unit.denom().significant_bits() < 100) {
        let mut system = System::new(&motion);
        if system.determinant().is_zero() {
            continue;
        }
        let (few, all) = (motion.timeline(), motion.timeline_of_intervals(system));
        assert!(!all.lasting, "{motion:?}");
        assert_eq!((few.times.len(), few.on_boundary), (all.times.len(), all.on_boundary), "{motion:?}");
        compared += 1;
    }
    assert!(compared > 10, "{compared}");
}

#[test]
fn parts_of_a_motion_make_up_the_whole() {
    for motion in in_space(4).into_iter().filter(|motion| motion.unit.denom().significant_bits() < 100) {
        let halves = [motion.during(0.0, 0.5), motion.during(0.5, 1.0)].map(|half| half.contacts());
        assert_eq!(motion.contacts().any(), halves.iter().any(Contacts::any), "{motion:?}");
        let t = Rational::from((1, 4));
        let quarter = motion.during(0.0, 0.5).squared_distance_at(&Rational::from((1, 2)));
        assert_eq!(motion.squared_distance_at(&t), quarter, "{motion:?}");
        if let Some((low, high)) = motion.first_contact(&Rational::from((1, 64))) {
            // A rational time is a bracket of no width; rounded outward these are an f64 each.
            let (low, high) =
                ((low.to_f64() * 256.0).floor() / 256.0, (high.to_f64() * 256.0).ceil() / 256.0);
            assert!(motion.during(low, high).contacts().any(), "{motion:?}");
            assert!(low == 0.0 || !motion.during(0.0, low - 1.0 / 256.0).contacts().any(), "{motion:?}");
        }
    }
}

#[test]
fn distances_are_in_the_units_of_the_coordinates() {
    let tiny = f64::from_bits(1);
    let t0 = [[0.0, 0.0, 3.0 * tiny], [-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    let square = Rational::from_f64(3.0 * tiny).unwrap().square();
    assert_eq!(Motion::vertex_face(&t0, &t0).squared_distance_at(&Rational::from((1, 3))), square);
    let t1 = [[0.0, 0.0, 2.0], t0[1], t0[2], t0[3]];
    let flat = [[0.0, 0.0, 0.0], t0[1], t0[2], t0[3]];
    assert_eq!(
        Motion::vertex_face(&flat, &t1).squared_distance_at(&Rational::from((1, 3))),
        Rational::from((4, 9))
    );
}
