//! The five determinant predicates against their oracles.

use crate::entropy::Entropy;
use crate::exact;
use crate::generate::Kind;
use welter_predicates as wp;
use welter_predicates::Sign;

fn check<const D: usize, const N: usize>(
    name: &str,
    entropy: &mut Entropy<'_>,
    predicate: fn(&[[f64; D]; N]) -> Sign,
    oracle: fn(&[[f64; D]]) -> i32,
) {
    let (kind, points) = Kind::draw_any::<D, N>(entropy);
    let (sign, expected) = (predicate(&points), oracle(&points));
    assert_eq!(i32::from(sign as i8), expected, "{name} of {kind:?} {points:?}");
}

/// `orient2d`, `orient3d` or `orient4d` of points drawn from the bytes.
pub fn orientations(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    match entropy.below(3) {
        0 => check("orient2d", &mut entropy, |[a, b, c]| wp::orient2d(a, b, c), exact::orient),
        1 => check("orient3d", &mut entropy, |[a, b, c, d]| wp::orient3d(a, b, c, d), exact::orient),
        _ => check("orient4d", &mut entropy, |[a, b, c, d, e]| wp::orient4d(a, b, c, d, e), exact::orient),
    }
}

/// `incircle` or `insphere` of points drawn from the bytes.
pub fn in_spheres(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    match entropy.below(2) {
        0 => check("incircle", &mut entropy, |[a, b, c, d]| wp::incircle(a, b, c, d), exact::in_sphere),
        _ => check("insphere", &mut entropy, |[a, b, c, d, e]| wp::insphere(a, b, c, d, e), exact::in_sphere),
    }
}
