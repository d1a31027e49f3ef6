//! Closest points at rest against exact distances.

use super::pairs::{FAMILIES, PAIRS};
use rug::Rational;
use welter_kit::exact::moving::rational;

#[test]
fn bounds_hold_and_are_narrow() {
    for family in FAMILIES {
        let mut widest = 0.0_f64;
        for seed in 0..2000 {
            let points = family.query(seed)[0];
            for pair in PAIRS {
                let (weights, [lower, upper]) = pair.closest(points);
                let moving = pair.moving(&[points; 2]);
                let exact = moving.distance_squared(&Rational::new());
                let context = || format!("{pair:?} {points:?} {lower:e} {upper:e} {}", exact.to_f64());
                assert!(rational(lower).square() <= exact, "{}", context());
                assert!(!upper.is_finite() || exact <= rational(upper).square(), "{}", context());
                let sum = |part: &[f64]| part.iter().map(|&w| rational(w)).sum::<Rational>();
                assert_eq!(sum(&weights), 2, "{}", context());
                let size = moving.size_squared();
                if size > 0 && upper.is_finite() && upper > 1e-280 {
                    let width = (rational(upper) - rational(lower)).square() / size;
                    widest = widest.max(width.to_f64().sqrt());
                }
            }
        }
        println!("{family:?}: widest {:.2} * 2^-44", widest * 2f64.powi(44));
        assert!(widest <= 2f64.powi(-44), "{family:?}: {widest:e}");
    }
}
