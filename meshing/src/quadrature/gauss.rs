//! `gauss_jacobi`: nodes and weights on the unit segment.
//!
//! With `P` the Jacobi polynomial of degree `n` with parameters `(m, 0)` on [-1, 1], the nodes are its roots `x`, and after the map to the
//! unit segment
//! ```text
//!   integral over [0, 1] of (1 - s)^m f(s) ds  =  sum of f((1 + x) / 2) / ((1 - x^2) P'(x)^2),   deg f < 2 n
//! ```
//! `P` and `P'` by the three-term recurrence (Abramowitz and Stegun, 22.7.1 and 22.8.1, for the second parameter 0).

use std::f64::consts::PI;

/// Newton's method doubles the digits: from a guess between the roots' neighbours it needs about six steps. Twenty is a stop, not a tuning.
const MAX_STEPS: usize = 20;

/// The `n` nodes, ascending, and weights of the Gauss rule on [0, 1] with weight function `(1 - s)^m`, for `n` up to 32 and `m` up to 2: the guesses
/// are good for those. For larger `m` the roots move away from Chebyshev's points and Newton's method would miss some.
pub(super) fn gauss_jacobi(n: u32, m: u32) -> Vec<(f64, f64)> {
    let mut roots: Vec<f64> = Vec::with_capacity(n as usize);
    for k in 0..n {
        // Roots lie near Chebyshev's; from the middle between such a point and the last root, Newton's method goes up.
        let chebyshev = -libm::cos(PI * f64::from(2 * k + 1) / f64::from(2 * n));
        let mut x = roots.last().map_or(chebyshev, |last| 0.5 * (chebyshev + last));
        for _ in 0..MAX_STEPS {
            let (p, slope) = jacobi(n, m, x);
            // Without the roots found so far.
            let found: f64 = roots.iter().map(|root| 1.0 / (x - root)).sum();
            let step = p / (slope - found * p);
            x -= step;
            if step.abs() <= f64::EPSILON {
                break;
            }
        }
        roots.push(x);
    }
    roots
        .into_iter()
        .map(|x| {
            let (_, slope) = jacobi(n, m, x);
            (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// The Jacobi polynomial of degree `n` with parameters `(m, 0)`, and its derivative, inside of (-1, 1).
fn jacobi(n: u32, m: u32, x: f64) -> (f64, f64) {
    let m = f64::from(m);
    let (mut before, mut p) = (1.0, 0.5 * (m + (m + 2.0) * x));
    for k in 1..n {
        let k = f64::from(k);
        let s = 2.0 * k + m;
        let a1 = 2.0 * (k + 1.0) * (k + m + 1.0) * s;
        let a2 = (s + 1.0) * m * m;
        let a3 = s * (s + 1.0) * (s + 2.0);
        let a4 = 2.0 * (k + m) * k * (s + 2.0);
        (before, p) = (p, ((a2 + a3 * x) * p - a4 * before) / a1);
    }
    let k = f64::from(n);
    let s = 2.0 * k + m;
    let slope = (k * (m - s * x) * p + 2.0 * (k + m) * k * before) / (s * (1.0 - x * x));
    (p, slope)
}

#[cfg(test)]
mod tests {
    use super::super::MAX_DEGREE;
    use super::*;

    #[test]
    fn nodes_are_where_the_sign_changes_and_moments_are_exact() {
        for m in 0..=2 {
            for n in 1..=MAX_DEGREE / 2 + 1 {
                let rule = gauss_jacobi(n, m);
                let nodes = || rule.iter().map(|&(s, _)| s);
                assert!(nodes().all(|s| 0.0 < s && s < 1.0) && nodes().is_sorted_by(|a, b| a < b), "{n} {m}");
                // Every node is a root of its own: the polynomial has another sign on either side.
                for s in nodes() {
                    let [below, above] =
                        [-1.0, 1.0].map(|side| jacobi(n, m, 2.0 * (s + side * 1e-13) - 1.0).0);
                    assert!(below * above < 0.0, "{n} {m} {s}");
                }
                for power in [0, n, 2 * n - 1] {
                    let got: f64 = rule.iter().map(|(s, w)| w * s.powi(power as i32)).sum();
                    // The integral of (1 - s)^m s^p: m! / ((p + 1) ... (p + m + 1)).
                    let expected = (1..=m).fold(1.0 / f64::from(power + m + 1), |integral, i| {
                        integral * f64::from(i) / f64::from(power + i)
                    });
                    assert!((got - expected).abs() <= 4e-14 * expected, "{n} {m} {power}: {got} {expected}");
                }
            }
        }
    }
}
