//! Eigenvalues and eigenvectors of symmetric 3 x 3 matrices: [`SymmetricMatrix`].
//!
//! Method: cyclic Jacobi rotations \[Golub13, section 8.5\]. The matrix is first scaled by a power of two so that its largest
//! entry is in [1/2, 1). Each rotation, by at most 45 degrees, makes one entry beside the diagonal zero; with angles
//! so bounded the sweeps converge for every matrix \[Forsythe60\], quadratically at the end. Entries below 2^-56 are
//! taken for zero; that changes eigenvalues by less than their roundings. Three or four sweeps in general.
//!
//! Error: eigenvalues within a few roundings of the largest in magnitude, eigenvectors orthonormal within a few
//! roundings, whatever the eigenvalues, equal ones among them (the matrix is only ever rotated).

use glam::DVec3;

/// A symmetric 3 x 3 matrix: its diagonal and the entries yz, xz, xy beside it.
///
/// ```
/// use glam::DVec3;
/// use welter_tracking::quadric::SymmetricMatrix;
///
/// let mut matrix = SymmetricMatrix::ZERO;
/// matrix.add_square(DVec3::new(0.0, 3.0, 4.0), 1.0);
/// let found = matrix.eigen();
/// assert!((found.values[0] - 25.0).abs() < 1e-13);
/// assert!((found.vectors[0].abs() - DVec3::new(0.0, 0.6, 0.8)).length() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetricMatrix {
    /// xx, yy, zz.
    pub diagonal: DVec3,
    /// yz, xz, xy: entry `k` is in neither the row nor the column `k`.
    pub beside: DVec3,
}

/// Eigenvalues, descending, each with its vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigen {
    /// Descending.
    pub values: [f64; 3],
    /// Orthonormal, of either sign.
    pub vectors: [DVec3; 3],
}

/// After scaling to one, what is smaller counts as zero.
const NEGLIGIBLE: f64 = 1.0 / (1_u64 << 56) as f64;

/// A bound that is never reached for finite matrices: convergence is quadratic.
const MAX_SWEEPS: usize = 24;

impl SymmetricMatrix {
    /// Zero.
    pub const ZERO: Self = Self { diagonal: DVec3::ZERO, beside: DVec3::ZERO };

    /// Adds `weight v v^T`.
    #[inline]
    pub fn add_square(&mut self, v: DVec3, weight: f64) {
        let weighted = weight * v;
        self.diagonal += weighted * v;
        self.beside += DVec3::new(weighted.y * v.z, weighted.z * v.x, weighted.x * v.y);
    }

    /// The matrix times a vector.
    #[must_use]
    pub fn times(&self, v: DVec3) -> DVec3 {
        let b = self.beside;
        self.diagonal * v + DVec3::new(b.z * v.y + b.y * v.z, b.z * v.x + b.x * v.z, b.y * v.x + b.x * v.y)
    }

    /// Eigenvalues and eigenvectors. Those of a matrix with infinite entries or NaN mean nothing.
    ///
    /// Times a power of two, the matrix has the same vectors, and the values times that power, bit for bit (as long as
    /// they are in the range of normal numbers).
    #[must_use]
    pub fn eigen(&self) -> Eigen {
        let largest = self.diagonal.abs().max(self.beside.abs()).max_element();
        let (_, exponent) = libm::frexp(largest);
        let scaled = |v: DVec3| DVec3::from_array(v.to_array().map(|c| libm::scalbn(c, -exponent)));
        let mut found = Self { diagonal: scaled(self.diagonal), beside: scaled(self.beside) }.eigen_scaled();
        found.values = found.values.map(|value| libm::scalbn(value, exponent));
        found
    }

    /// Eigenvalues and eigenvectors of a matrix whose largest entry is about one.
    pub(crate) fn eigen_scaled(&self) -> Eigen {
        let mut d = self.diagonal.to_array();
        let mut b = self.beside.to_array();
        let mut v = [DVec3::X, DVec3::Y, DVec3::Z];
        for _ in 0..MAX_SWEEPS {
            if b.iter().all(|entry| entry.abs() < NEGLIGIBLE) {
                break;
            }
            rotate::<1, 2, 0>(&mut d, &mut b, &mut v);
            rotate::<0, 2, 1>(&mut d, &mut b, &mut v);
            rotate::<0, 1, 2>(&mut d, &mut b, &mut v);
        }
        let mut swap_if_ascending = |i: usize, j: usize| {
            if d[i] < d[j] {
                d.swap(i, j);
                v.swap(i, j);
            }
        };
        swap_if_ascending(0, 1);
        swap_if_ascending(1, 2);
        swap_if_ascending(0, 1);
        Eigen { values: d, vectors: v }
    }
}

/// Makes the entry in row `P` and column `Q`, which is `b[R]`, zero by a rotation in their plane.
#[inline]
fn rotate<const P: usize, const Q: usize, const R: usize>(
    d: &mut [f64; 3],
    b: &mut [f64; 3],
    v: &mut [DVec3; 3],
) {
    let entry = b[R];
    if entry.abs() < NEGLIGIBLE {
        return;
    }
    // tan(2 angle) = 2 entry / gap; the smaller of the two tangents.
    let gap = d[Q] - d[P];
    let doubled = 2.0 * entry;
    let root = (gap * gap + doubled * doubled).sqrt();
    let tangent = if gap < 0.0 { doubled / (gap - root) } else { doubled / (gap + root) };
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    let sine = tangent * cosine;
    d[P] -= tangent * entry;
    d[Q] += tangent * entry;
    b[R] = 0.0;
    // b[Q] is the entry in row P beside R, b[P] that in row Q.
    (b[Q], b[P]) = (cosine * b[Q] - sine * b[P], sine * b[Q] + cosine * b[P]);
    (v[P], v[Q]) = (cosine * v[P] - sine * v[Q], sine * v[P] + cosine * v[Q]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_SQRT_2;

    fn matrix(diagonal: [f64; 3], beside: [f64; 3]) -> SymmetricMatrix {
        SymmetricMatrix { diagonal: DVec3::from_array(diagonal), beside: DVec3::from_array(beside) }
    }

    #[test]
    fn known_matrices() {
        let diagonal = matrix([1.0, 3.0, 2.0], [0.0; 3]).eigen();
        assert_eq!(diagonal.values, [3.0, 2.0, 1.0]);
        assert_eq!(diagonal.vectors, [DVec3::Y, DVec3::Z, DVec3::X]);

        let swap = matrix([0.0, 0.0, 5.0], [0.0, 0.0, 1.0]).eigen();
        assert!((swap.values[1] - 1.0).abs() < 1e-15 && (swap.values[2] + 1.0).abs() < 1e-15);
        assert!((swap.vectors[1].x.abs() - FRAC_1_SQRT_2).abs() < 1e-15);

        // All ones: 3, and 0 twice.
        let ones = matrix([1.0; 3], [1.0; 3]).eigen();
        assert!((ones.values[0] - 3.0).abs() < 2e-15 && ones.values[1].abs() < 1e-15);
        assert!((ones.vectors[0].abs() - DVec3::splat(3f64.sqrt().recip())).length() < 1e-15);

        assert_eq!(SymmetricMatrix::ZERO.eigen().values, [0.0; 3]);
        assert_eq!(SymmetricMatrix::ZERO.eigen().vectors, [DVec3::X, DVec3::Y, DVec3::Z]);
    }

    #[test]
    fn what_is_not_finite_ends() {
        let _ = matrix([f64::NAN, 1.0, f64::INFINITY], [1.0, f64::NAN, f64::NEG_INFINITY]).eigen();
    }
}
