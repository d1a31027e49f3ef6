//! Systems of linear equations: [`system`].

use super::{Kind, number};
use crate::entropy::Entropy;

/// A matrix of rows and a right-hand side. Often singular or nearly so, square or not, consistent or not.
pub fn system<const M: usize, const N: usize>(entropy: &mut Entropy<'_>) -> ([[f64; N]; M], [f64; M]) {
    let (_, mut a) = Kind::draw_any::<N, M>(entropy);
    let family = entropy.pick(&[number::uniform as fn(&mut Entropy<'_>) -> f64, number::grid, number::mixed]);
    let mut b = [(); M].map(|()| family(entropy));
    let pick = |count: usize, entropy: &mut Entropy<'_>| usize::from(entropy.byte()) % count;
    for _ in 0..entropy.below(4) {
        match entropy.below(6) {
            // A row twice, perhaps with its right-hand side, perhaps up to the last bit.
            0 | 1 => {
                let (from, to) = (pick(M, entropy), pick(M, entropy));
                a[to] = a[from];
                if entropy.below(2) == 0 {
                    b[to] = b[from];
                }
                if entropy.below(3) == 0 {
                    let column = pick(N, entropy);
                    a[to][column] = number::nudge(a[to][column], i64::from(entropy.between(-2, 2)));
                }
            }
            // A column twice, or without numbers.
            2 => {
                let (from, to) = (pick(N, entropy), pick(N, entropy));
                a.iter_mut().for_each(|row| row[to] = row[from]);
            }
            3 => {
                let column = pick(N, entropy);
                a.iter_mut().for_each(|row| row[column] = 0.0);
            }
            // A right-hand side that is a combination of columns, unless rounding spoils it.
            4 => {
                let weights = [(); N].map(|()| f64::from(entropy.between(-2, 2)));
                b = a.map(|row| {
                    let sum: f64 = row.iter().zip(weights).map(|(x, w)| x * w).sum();
                    if sum.is_finite() { sum } else { 0.0 }
                });
            }
            _ => b = [0.0; M],
        }
    }
    (a, b)
}
