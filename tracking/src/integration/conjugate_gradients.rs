//! Large symmetric systems that may be singular: [`solve`].
//!
//! # What it computes
//! For a symmetric positive semidefinite `A`, given as a function, and a `b` in its range, an approximate solution of `A x = b`.
//! Repeated on what it leaves of `b`, it converges.
//!
//! # Method
//! Conjugate gradients \[Hestenes52\] on the system scaled to a diagonal of 1. They stay in the range of `A`, so a singular
//! system is no harder than others. Directions that nearly depend on others, as those of many contacts of a few vertices do,
//! come last; as the number of iterations is bounded, they are left where they would cost much and be fulfilled only by motions
//! much larger than others. All of it is linear in `b`, which is scaled by a power of two, so that squares do not underflow.
//! Sums are made in order.

/// Norm of the residual relative to that of the right side at which iterations stop: 2^-20.
const RESIDUAL: f64 = 1.0 / (1 << 20) as f64;

/// Some times the root of the condition 2^12, which separates motions that count from those that do not.
const MOST_ITERATIONS: usize = 384;

/// Curvature relative to the diagonal below which a direction counts as one that depends on others: 2^-24, as in the
/// dense case. What rounding leaves out of the range of `A` is such a direction.
const DEPENDENT: f64 = 1.0 / (1 << 24) as f64;

/// Solves approximately, with the product `times(x, A x)`.
pub(super) fn solve(diagonal: &[f64], b: &[f64], times: impl Fn(&[f64], &mut [f64])) -> Vec<f64> {
    let n = b.len();
    let scale: Vec<f64> = diagonal.iter().map(|&d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 }).collect();
    let largest = b.iter().zip(&scale).map(|(b, s)| (b * s).abs()).fold(0.0, f64::max);
    let exponent = libm::frexp(largest).1;
    let dot = |p: &[f64], q: &[f64]| p.iter().zip(q).map(|(x, y)| x * y).sum::<f64>();
    let mut residual: Vec<f64> = b.iter().zip(&scale).map(|(b, s)| libm::scalbn(b * s, -exponent)).collect();
    let mut direction = residual.clone();
    let mut x = vec![0.0; n];
    let (mut unscaled, mut product) = (vec![0.0; n], vec![0.0; n]);
    let mut square = dot(&residual, &residual);
    let enough = RESIDUAL * RESIDUAL * square;
    for _ in 0..MOST_ITERATIONS {
        if square <= enough {
            break;
        }
        for i in 0..n {
            unscaled[i] = scale[i] * direction[i];
        }
        times(&unscaled, &mut product);
        product.iter_mut().zip(&scale).for_each(|(p, s)| *p *= s);
        let curvature = dot(&direction, &product);
        if curvature <= DEPENDENT * dot(&direction, &direction) {
            break;
        }
        let step = square / curvature;
        for i in 0..n {
            x[i] += step * direction[i];
            residual[i] -= step * product[i];
        }
        let next = dot(&residual, &residual);
        let turn = next / square;
        for i in 0..n {
            direction[i] = residual[i] + turn * direction[i];
        }
        square = next;
    }
    x.iter().zip(&scale).map(|(x, s)| libm::scalbn(x * s, exponent)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `C C^T` for the differences of neighbours on a ring: its rows sum to zero.
    fn ring(x: &[f64], product: &mut [f64]) {
        let n = x.len();
        for i in 0..n {
            product[i] = 2.0 * x[i] - x[(i + 1) % n] - x[(i + n - 1) % n];
        }
    }

    fn right_side(n: usize) -> Vec<f64> {
        let mut b = vec![0.0; n];
        (b[1], b[n / 2], b[n - 1]) = (3.0, -1.0, -2.0);
        b
    }

    #[test]
    fn singular_systems_with_a_solution_are_solved_by_repetition_at_every_scale() {
        for n in [5, 40, 300] {
            let solved = |exponent: i32| {
                let mut left: Vec<f64> = right_side(n).iter().map(|&b| libm::scalbn(b, exponent)).collect();
                let (mut x, mut product) = (vec![0.0; n], vec![0.0; n]);
                for _ in 0..4 {
                    let more = solve(&vec![2.0; n], &left, ring);
                    x.iter_mut().zip(&more).for_each(|(x, more)| *x += more);
                    ring(&more, &mut product);
                    left.iter_mut().zip(&product).for_each(|(l, p)| *l -= p);
                }
                (x, left.iter().fold(0.0, |m: f64, l| m.max(l.abs())))
            };
            let (x, left) = solved(0);
            assert!(left < 1e-9, "{n} {left}");
            let (small, _) = solved(-900);
            assert!(x.iter().zip(&small).all(|(&x, &y)| libm::scalbn(x, -900) == y));
        }
    }

    #[test]
    fn nothing_is_left_of_nothing() {
        assert_eq!(solve(&[2.0; 40], &[0.0; 40], ring), vec![0.0; 40]);
        assert_eq!(solve(&[], &[], ring), [0.0; 0]);
    }
}
