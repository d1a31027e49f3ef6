//! A ray and a bilinear patch against the equations of the patch.

use crate::entropy::Entropy;
use crate::exact;
use crate::generate::{Kind, number};
use welter_predicates::ccd::parity::ray_bilinear_patch;

/// Kinds on which both sides are quick.
const QUICK: [Kind; 5] = [Kind::Grid, Kind::FlatGrid, Kind::Grid, Kind::Dyadic, Kind::Uniform];

/// A ray and a patch drawn from the bytes.
pub fn patch_parity(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    let entropy = &mut entropy;
    // With exponents of the whole range one comparison takes tens of milliseconds: one in sixteen.
    let kind = if entropy.below(16) == 15 { entropy.pick(&Kind::ALL) } else { entropy.pick(&QUICK) };
    let mut points = kind.draw::<3, 6>(entropy);
    coincide(&mut points, entropy);
    neighbours(&mut points, entropy);
    let [origin, direction, a, b, c, d] = points;
    let parity = ray_bilinear_patch(origin, direction, [a, b, c, d]);
    let expected = exact::ray_bilinear_patch(origin, direction, [a, b, c, d], exact::infinitesimal(&points));
    assert_eq!(parity, expected, "{origin:?} {direction:?} {:?}", [a, b, c, d]);
}

/// Puts corners or the origin in the places of others, and points the ray along an axis, at a corner or nowhere.
fn coincide(points: &mut [[f64; 3]; 6], entropy: &mut Entropy<'_>) {
    let corner = |entropy: &mut Entropy<'_>| 2 + usize::from(entropy.below(4));
    match entropy.below(8) {
        0 => points[corner(entropy)] = points[corner(entropy)],
        1 => points[0] = points[corner(entropy)],
        // The middle of a side or of a diagonal.
        2 => {
            let (p, q) = (points[corner(entropy)], points[corner(entropy)]);
            points[0] = std::array::from_fn(|k| p[k] / 2.0 + q[k] / 2.0);
        }
        _ => {}
    }
    match entropy.below(6) {
        0 => {
            let axis = usize::from(entropy.below(4));
            points[1] = std::array::from_fn(|k| f64::from(u8::from(k == axis)));
        }
        1 => {
            let p = points[corner(entropy)];
            let towards: [f64; 3] = std::array::from_fn(|k| p[k] - points[0][k]);
            // The largest numbers have no difference.
            if towards.iter().all(|x| x.is_finite()) {
                points[1] = towards;
            }
        }
        _ => {}
    }
}

/// Moves a few coordinates by a few ulp. Zeros stay: their neighbours belong to the kinds of all exponents.
fn neighbours(points: &mut [[f64; 3]; 6], entropy: &mut Entropy<'_>) {
    for _ in 0..entropy.pick(&[0, 0, 1, 4]) {
        let x = &mut points.as_flattened_mut()[usize::from(entropy.below(18))];
        if *x != 0.0 {
            *x = number::nudge(*x, i64::from(entropy.between(-2, 2)));
        }
    }
}
