//! [`gauss_jacobi`]: nodes and weights on the unit segment.
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

/// The `n` nodes, ascending, and weights of the Gauss rule on [0, 1] with weight function `(1 - s)^m`.
///
/// ```
/// use welter_meshing::quadrature::gauss_jacobi;
/// let [(s, w)] = gauss_jacobi(1, 0)[..] else { panic!() };
/// assert_eq!((s, w), (0.5, 1.0)); // the midpoint rule
/// let of_cubic: f64 = gauss_jacobi(2, 0).iter().map(|(s, w)| w * s * s * s).sum();
/// assert!((of_cubic - 0.25).abs() < 1e-15);
/// ```
#[must_use]
pub fn gauss_jacobi(n: u32, m: u32) -> Vec<(f64, f64)> {
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
