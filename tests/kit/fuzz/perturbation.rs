//! Laws of the symbolically perturbed predicates.

use crate::entropy::Entropy;
use crate::exact;
use crate::generate::Kind;
use welter_predicates::Sign;
use welter_predicates::sos;

/// `orient2d_sos`, `orient3d_sos`, `incircle_sos` or `insphere_sos` of points and ids drawn from the bytes.
pub fn perturbed(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    match entropy.below(4) {
        0 => laws::<2, 3>(&mut entropy, sos::orient2d_sos, exact::orient),
        1 => laws::<3, 4>(&mut entropy, sos::orient3d_sos, exact::orient),
        2 => laws::<2, 4>(&mut entropy, sos::incircle_sos, exact::in_sphere),
        _ => laws::<3, 5>(&mut entropy, sos::insphere_sos, exact::in_sphere),
    }
}

fn laws<const D: usize, const N: usize>(
    entropy: &mut Entropy<'_>,
    predicate: fn([[f64; D]; N], [u64; N]) -> Sign,
    oracle: fn(&[[f64; D]]) -> i32,
) {
    let (kind, mut points) = Kind::draw_any::<D, N>(entropy);
    // Distinct ids in any order: a random start and positive steps, then exchanges.
    let mut next = entropy.word() >> 8;
    let mut ids = [(); N].map(|()| {
        next += 1 + u64::from(entropy.byte());
        next
    });
    for i in 0..N {
        ids.swap(i, usize::from(entropy.byte()) % N);
    }
    let context = format!("{kind:?} {points:?} {ids:?}");

    let sign = predicate(points, ids);
    assert_ne!(sign, Sign::Zero, "{context}");
    let plain = oracle(&points);
    assert!(
        plain == 0 || plain == i32::from(sign as i8),
        "{sign:?} but the plain sign is {plain}: {context}"
    );

    // Only the order of the ids counts.
    let ranks = ids.map(|id| ids.iter().filter(|&&other| other < id).count() as u64);
    assert_eq!(predicate(points, ranks), sign, "{context}");

    // Odd under an exchange of two points together with their ids.
    let (i, j) = (usize::from(entropy.byte()) % N, usize::from(entropy.byte()) % N);
    points.swap(i, j);
    ids.swap(i, j);
    assert_eq!(predicate(points, ids), if i == j { sign } else { -sign }, "{context}, exchanged {i} and {j}");
}
