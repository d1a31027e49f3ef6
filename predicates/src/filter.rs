//! Error bounds of the first stage: the determinant in rounded `f64`.
//!
//! Notation: u = 2^-53 bounds the relative rounding error of a sum, difference or product, relative to the
//! rounded or to the exact result, whichever is the better; eta = 2^-1075 bounds the absolute error of a product
//! that underflows (sums and differences do not err there). mx, my, ... are the largest magnitudes of the rounded
//! differences in a column, m the largest of all.
//!
//! **Bound.** For a rounded number write X for a bound of its magnitude, e for one of its distance to the exact
//! number, both in units of the product of its columns' maxima, and c for the number of eta that underflow adds,
//! in units of max(1, m)^(degree - 2). A difference has X = 1, e = u, c = 0. Then
//!
//! ```text
//! product  X = X1 X2 (1 + u)     e = X1 e2 + X2 e1 + e1 e2 + u X1 X2     c = X1 c2 + X2 c1 + c1 c2 + 1
//! sum      X = (X1 + X2)(1 + u)  e = e1 + e2 + u (X1 + X2)               c = c1 + c2
//! ```
//!
//! (For c the bound X is the one at u = 0, doubled at the end.) Following the polynomials of
//! [`crate::polynomial`] step by step this gives, as the tests recompute with the same text,
//!
//! ```text
//! orient2d 8u   orient3d 46u   orient4d 280u   incircle 128u   insphere 1104u   crossings 1104u   slopes 280u
//! ```
//!
//! to first order, times the product of the maxima. These are larger than bounds by the permanent \[Shewchuk97\], by a factor of
//! two or three for points without special position, and cost half as much.
//!
//! **Overflow.** A filter forms the product of the maxima times a constant that makes it at least as large as
//! every intermediate result of the determinant: if any of these overflows, so does the bound, and a comparison
//! with infinity or NaN settles nothing. A coordinate that is not finite makes the determinant or the bound so.
//!
//! **Underflow.** [`UNDERFLOW`] is far larger than any sum of eta that can arise, and a normal number.

/// u, half the distance from 1 to the next number.
pub(crate) const U: f64 = f64::EPSILON / 2.0;

/// What underflow may add: at least c * eta for every predicate, c < 2^13.
const UNDERFLOW: f64 = f64::from_bits((1023 - 1000) << 52); // 2^-1000

/// First-order error coefficients plus one, in units of u: the one covers the higher orders and the rounding of
/// the bound itself.
const ORIENT2D: f64 = 9.0;
const ORIENT3D: f64 = 47.0;
const ORIENT4D: f64 = 281.0;
const INCIRCLE: f64 = 129.0;
const INSPHERE: f64 = 1105.0;
const CROSSINGS: f64 = 1105.0;
const SLOPES: f64 = 281.0;

/// Powers of two not below the magnitude of any intermediate result, in units of the product of the maxima.
const SIZE_2D: f64 = 4.0;
const SIZE_3D: f64 = 8.0;
const SIZE_4D: f64 = 32.0;
const SIZE_CIRCLE: f64 = 16.0;
const SIZE_SPHERE: f64 = 128.0;
const SIZE_CROSSINGS: f64 = 128.0;
const SIZE_SLOPES: f64 = 32.0;

/// The larger of two magnitudes: one instruction, unlike `f64::max`. Of a NaN and a number it gives either.
#[inline(always)]
fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The largest magnitude in each column.
#[inline(always)]
fn column_maxima<const N: usize, const R: usize>(rows: &[[f64; N]; R]) -> [f64; N] {
    core::array::from_fn(|j| {
        let mut largest = rows[0][j].abs();
        for row in &rows[1..] {
            largest = max(largest, row[j].abs());
        }
        largest
    })
}

/// The sum of the magnitudes in each column: not below the maximum, and quicker where there are few columns
/// (measured on orient3d: the compiler makes branches of the maxima there, which random input mispredicts).
#[inline(always)]
fn column_sums<const N: usize, const R: usize>(rows: &[[f64; N]; R]) -> [f64; N] {
    core::array::from_fn(|j| {
        let mut sum = rows[0][j].abs();
        for row in &rows[1..] {
            sum += row[j].abs();
        }
        sum
    })
}

/// Error bound of [`crate::polynomial::orient2d`].
#[inline(always)]
pub(crate) fn orient2d(rows: &[[f64; 2]; 2]) -> f64 {
    let [mx, my] = column_sums(rows);
    ((SIZE_2D * mx) * my) * (ORIENT2D * U / SIZE_2D) + UNDERFLOW
}

/// Error bound of [`crate::polynomial::orient3d`].
#[inline(always)]
pub(crate) fn orient3d(rows: &[[f64; 3]; 3]) -> f64 {
    let [mx, my, mz] = column_sums(rows);
    ((SIZE_3D * mx) * my) * mz * (ORIENT3D * U / SIZE_3D) + (UNDERFLOW * mz + UNDERFLOW)
}

/// Error bound of [`crate::polynomial::orient4d`].
#[inline(always)]
pub(crate) fn orient4d(rows: &[[f64; 4]; 4]) -> f64 {
    let [mx, my, mz, mw] = column_maxima(rows);
    let (xy, zw) = ((SIZE_4D * mx) * my, (SIZE_4D * mz) * mw);
    xy * zw * (ORIENT4D * U / (SIZE_4D * SIZE_4D)) + (UNDERFLOW * xy + UNDERFLOW * zw + UNDERFLOW)
}

/// Error bound of [`crate::polynomial::incircle`].
#[inline(always)]
pub(crate) fn incircle(rows: &[[f64; 2]; 3]) -> f64 {
    let [mx, my] = column_maxima(rows);
    let m = max(mx, my);
    let lift = (2.0 * m) * (2.0 * m);
    ((SIZE_CIRCLE / 4.0 * mx) * my) * lift * (INCIRCLE * U / SIZE_CIRCLE) + (UNDERFLOW * lift + UNDERFLOW)
}

/// Error bound of [`crate::polynomial::insphere`].
#[inline(always)]
pub(crate) fn insphere(rows: &[[f64; 3]; 4]) -> f64 {
    let [mx, my, mz] = column_maxima(rows);
    let m = max(max(mx, my), mz);
    let lift = (2.0 * m) * (2.0 * m);
    let underflow = UNDERFLOW * lift * m + UNDERFLOW;
    ((SIZE_SPHERE / 4.0 * mx) * my) * mz * lift * (INSPHERE * U / SIZE_SPHERE) + underflow
}

/// Error bound of [`crate::polynomial::crossings`].
#[inline(always)]
pub(crate) fn crossings(rows: &[[f64; 3]; 6]) -> f64 {
    let [mx, my, mz] = column_maxima(rows);
    let m = max(max(mx, my), mz);
    let xy = (SIZE_CROSSINGS * mx) * my;
    let underflow = UNDERFLOW * m * m * m + UNDERFLOW;
    xy * mz * xy * (CROSSINGS * U / (SIZE_CROSSINGS * SIZE_CROSSINGS)) + underflow
}

/// Error bound of [`crate::polynomial::slopes`], of coordinate `k` of the first two.
#[inline(always)]
pub(crate) fn slopes(rows: &[[f64; 3]; 5], k: usize) -> f64 {
    let maxima = column_maxima(rows);
    let m = max(max(maxima[0], maxima[1]), maxima[2]);
    let (along, other) = ((SIZE_SLOPES * maxima[0]) * maxima[1], (SIZE_SLOPES * maxima[1 - k]) * maxima[2]);
    let underflow = UNDERFLOW * m * m + UNDERFLOW;
    along * other * (SLOPES * U / (SIZE_SLOPES * SIZE_SLOPES)) + underflow
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::polynomial::{self, Additive, Ring, SixthDegree, Times};

    /// A polynomial in u with natural coefficients.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub(crate) struct Poly([u128; 40]);

    impl Poly {
        fn u() -> Self {
            let mut p = [0; 40];
            p[1] = 1;
            Self(p)
        }
        fn add(self, other: Self) -> Self {
            Self(core::array::from_fn(|i| self.0[i] + other.0[i]))
        }
        fn mul(self, other: Self) -> Self {
            let mut p = [0; 40];
            for (i, a) in self.0.iter().enumerate() {
                for (j, b) in other.0.iter().enumerate().filter(|&(_, b)| a * b != 0) {
                    p[i + j] += a * b;
                }
            }
            Self(p)
        }
    }

    /// Magnitude, error and underflow count of a rounded number, as the module's head defines them.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Bound {
        size: Poly,
        error: Poly,
        underflows: u128,
    }

    pub(crate) struct Bounds;

    impl Ring for Bounds {
        type D1 = Bound;
        type D2 = Bound;
        type D3 = Bound;
        type D4 = Bound;
        type D5 = Bound;
        type Outcome = Bound;
    }

    impl SixthDegree for Bounds {
        type D6 = Bound;
    }

    impl Additive for Bound {
        fn plus(&self, other: &Self) -> Self {
            let exact = self.size.add(other.size);
            let rounding = exact.mul(Poly::u());
            Self {
                size: exact.add(rounding),
                error: self.error.add(other.error).add(rounding),
                underflows: self.underflows + other.underflows,
            }
        }
        fn minus(&self, other: &Self) -> Self {
            self.plus(other)
        }
    }

    impl Times<Bound> for Bound {
        type Product = Bound;
        fn times(&self, other: &Self) -> Self {
            let exact = self.size.mul(other.size);
            let rounding = exact.mul(Poly::u());
            let inherited = self.size.mul(other.error).add(self.error.mul(other.size));
            let (s, o) = (self.size.0[0], other.size.0[0]);
            Self {
                size: exact.add(rounding),
                error: inherited.add(self.error.mul(other.error)).add(rounding),
                underflows: s * other.underflows
                    + self.underflows * o
                    + self.underflows * other.underflows
                    + 1,
            }
        }
    }

    /// A number without error, of magnitude 1.
    pub(crate) const EXACT: Bound = Bound { error: Poly([0; 40]), ..DIFFERENCE };

    pub(crate) const DIFFERENCE: Bound = Bound {
        size: Poly({
            let mut p = [0; 40];
            p[0] = 1;
            p
        }),
        error: Poly({
            let mut p = [0; 40];
            p[1] = 1;
            p
        }),
        underflows: 0,
    };

    /// The constant covers the error, the sizes cover the magnitude, the underflow term covers the count.
    pub(crate) fn check(bound: Bound, first_order: u128, constant: f64, size: f64) {
        assert_eq!(bound.error.0[0], 0);
        assert_eq!(bound.error.0[1], first_order);
        // Orders from the second on: below u/4 even if each were multiplied by u^2 only.
        assert!(bound.error.0[2..].iter().sum::<u128>() < 1 << 51);
        // At most 16 roundings in the bound: a factor of at least 1 - 16u, which takes less than a quarter.
        assert!(constant >= first_order as f64 + 0.5 && constant * 16.0 * U < 0.25);
        // The size to zeroth order leaves a tenth for the powers of 1 + u.
        assert!(bound.size.0[0] as f64 * 1.1 <= size);
        assert!(bound.size.0[1..].iter().sum::<u128>() < 1 << 40);
        // Doubled for the powers of 1 + u in the count, against 2^-1000 = 2^75 eta.
        assert!(2 * bound.underflows < 1 << 13);
    }

    #[test]
    fn constants_cover_the_errors_of_the_same_text() {
        check(polynomial::orient2d::<Bounds>(&[[DIFFERENCE; 2]; 2]), 8, ORIENT2D, SIZE_2D);
        check(polynomial::orient3d::<Bounds>(&[[DIFFERENCE; 3]; 3]), 46, ORIENT3D, SIZE_3D);
        check(polynomial::orient4d::<Bounds>(&[[DIFFERENCE; 4]; 4]), 280, ORIENT4D, SIZE_4D);
        check(polynomial::incircle::<Bounds>(&[[DIFFERENCE; 2]; 3]), 128, INCIRCLE, SIZE_CIRCLE);
        check(polynomial::insphere::<Bounds>(&[[DIFFERENCE; 3]; 4]), 1104, INSPHERE, SIZE_SPHERE);
        check(polynomial::crossings::<Bounds>(&[[DIFFERENCE; 3]; 6]), 1104, CROSSINGS, SIZE_CROSSINGS);
        for k in 0..2 {
            check(polynomial::slopes::<Bounds>(&[[DIFFERENCE; 3]; 5], k), 280, SLOPES, SIZE_SLOPES);
        }
    }
}
