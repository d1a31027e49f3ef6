//! [`SimplexRule`] and [`CubeRule`]: points and weights on reference shapes.

use thiserror::Error;

use super::gauss_jacobi;

/// Highest degree of a rule: 32 points in each direction, 32,768 on a tetrahedron.
pub const MAX_DEGREE: u32 = 63;

/// A rule of too high a degree was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("a quadrature rule of degree {degree}, more than {MAX_DEGREE}")]
pub struct DegreeError {
    /// The degree asked for.
    pub degree: u32,
}

/// A rule on a simplex of two, three or four corners, `N`: barycentric coordinates and weights. With another `N` its constructor does not compile.
///
/// ```
/// use welter_meshing::quadrature::TriangleRule;
/// let rule = TriangleRule::of_degree(2)?;
/// assert_eq!(rule.points().len(), 4);
/// // The mean of a product of two barycentric coordinates is 1/12.
/// let mean: f64 = rule.points().iter().map(|([a, b, _], w)| w * a * b).sum();
/// assert!((mean - 1.0 / 12.0).abs() < 1e-15);
/// # Ok::<(), welter_meshing::quadrature::DegreeError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SimplexRule<const N: usize> {
    points: Vec<([f64; N], f64)>,
}

/// A rule on a segment.
pub type SegmentRule = SimplexRule<2>;

/// A rule on a triangle.
pub type TriangleRule = SimplexRule<3>;

/// A rule on a tetrahedron.
pub type TetrahedronRule = SimplexRule<4>;

impl<const N: usize> SimplexRule<N> {
    /// The rule that integrates polynomials of total degree `degree` without error: `floor(degree / 2) + 1` points in each direction.
    ///
    /// # Errors
    /// [`DegreeError`] above [`MAX_DEGREE`].
    pub fn of_degree(degree: u32) -> Result<Self, DegreeError> {
        const { assert!(2 <= N && N <= 4, "a segment, a triangle or a tetrahedron") }
        let count = points_along(degree)?;
        let mut points = vec![([0.0; N], 1.0)];
        // What is left of 1 when the coordinates so far are taken away stands in the last place.
        points[0].0[N - 1] = 1.0;
        for axis in 0..N - 1 {
            let power = (N - 2 - axis) as u32;
            let along = gauss_jacobi(count, power);
            // The weight function (1 - s)^m has the integral 1 / (m + 1).
            let total = f64::from(power + 1);
            points = points
                .iter()
                .flat_map(|&(coordinates, weight)| {
                    along.iter().map(move |&(s, w)| {
                        let mut coordinates = coordinates;
                        let left = coordinates[N - 1];
                        coordinates[axis] = left * s;
                        coordinates[N - 1] = left * (1.0 - s);
                        (coordinates, weight * w * total)
                    })
                })
                .collect();
        }
        Ok(Self { points })
    }

    /// Barycentric coordinates and weights; the weights add up to 1.
    #[must_use]
    pub fn points(&self) -> &[([f64; N], f64)] {
        &self.points
    }
}

/// A rule on the unit cube: the product of Gauss-Legendre rules.
///
/// ```
/// use welter_meshing::quadrature::CubeRule;
/// let rule = CubeRule::of_degree(5)?; // three points along each axis
/// assert_eq!(rule.points().len(), 27);
/// let mean: f64 = rule.points().iter().map(|([x, y, z], w)| w * x.powi(5) * y.powi(4) * z).sum();
/// assert!((mean - 1.0 / 60.0).abs() < 1e-15);
/// # Ok::<(), welter_meshing::quadrature::DegreeError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct CubeRule {
    points: Vec<([f64; 3], f64)>,
}

impl CubeRule {
    /// The rule that integrates polynomials of degree `degree` in each coordinate without error.
    ///
    /// # Errors
    /// [`DegreeError`] above [`MAX_DEGREE`].
    pub fn of_degree(degree: u32) -> Result<Self, DegreeError> {
        let along = gauss_jacobi(points_along(degree)?, 0);
        let mut points = Vec::with_capacity(along.len().pow(3));
        for &(z, wz) in &along {
            for &(y, wy) in &along {
                points.extend(along.iter().map(|&(x, wx)| ([x, y, z], wx * wy * wz)));
            }
        }
        Ok(Self { points })
    }

    /// Coordinates from 0 to 1, and weights; the weights add up to 1.
    #[must_use]
    pub fn points(&self) -> &[([f64; 3], f64)] {
        &self.points
    }
}

/// A Gauss rule of `n` points has degree `2 n - 1`.
fn points_along(degree: u32) -> Result<u32, DegreeError> {
    if degree > MAX_DEGREE { Err(DegreeError { degree }) } else { Ok(degree / 2 + 1) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factorial(n: u32) -> f64 {
        (1..=n).map(f64::from).product()
    }

    /// The mean of a product of powers of barycentric coordinates over a simplex.
    fn mean<const N: usize>(powers: [u32; N]) -> f64 {
        let total: u32 = powers.iter().sum();
        let dimension = N as u32 - 1;
        powers.iter().map(|&p| factorial(p)).product::<f64>() * factorial(dimension)
            / factorial(total + dimension)
    }

    fn check<const N: usize>(degree: u32, powers: [u32; N]) {
        let rule = SimplexRule::<N>::of_degree(degree).unwrap();
        assert!(rule.points().iter().all(|(l, w)| *w > 0.0 && l.iter().all(|&l| l > 0.0 && l < 1.0)));
        let got: f64 = rule
            .points()
            .iter()
            .map(|(l, w)| w * l.iter().zip(powers).map(|(l, p)| l.powi(p as i32)).product::<f64>())
            .sum();
        let expected = mean(powers);
        assert!((got - expected).abs() <= 4e-14 * expected, "degree {degree}, {powers:?}: {got} {expected}");
    }

    #[test]
    fn polynomials_of_the_degree_are_integrated_without_error() {
        for degree in [0, 1, 2, 3, 6, 8, 9, 12] {
            for a in 0..=degree {
                check(degree, [a, degree - a]);
                for b in 0..=degree - a {
                    check(degree, [a, b, degree - a - b]);
                }
            }
        }
        for degree in [1, 4, 6, 12] {
            for a in 0..=degree {
                for b in 0..=degree - a {
                    let c = (degree - a - b) / 2;
                    check(degree, [a, b, c, degree - a - b - c]);
                }
            }
        }
        check(MAX_DEGREE, [20, 20, 23]);
        check(MAX_DEGREE, [63, 0, 0]);
    }

    #[test]
    fn the_degree_above_is_not_integrated() {
        // The rule is no better than it says: with 2 n points' worth of degree the error is that of the n-th polynomial's square.
        let rule = SegmentRule::of_degree(5).unwrap();
        let got: f64 = rule.points().iter().map(|([s, _], w)| w * s.powi(6)).sum();
        assert!((got - 1.0 / 7.0).abs() > 1e-5);
    }

    #[test]
    fn too_high_a_degree_is_refused() {
        assert_eq!(TriangleRule::of_degree(64), Err(DegreeError { degree: 64 }));
        assert_eq!(CubeRule::of_degree(u32::MAX), Err(DegreeError { degree: u32::MAX }));
    }
}
