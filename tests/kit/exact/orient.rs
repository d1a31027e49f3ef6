//! Orientation and in-sphere signs from the homogeneous determinants, in any dimension.
//!
//! ```text
//! orient(p_0 .. p_D)        = sign det [ p_i, 1 ]              (D+1 rows)
//! in_sphere(p_0 .. p_D, q)  = sign det [ p_i, |p_i|^2, 1 ]     (D+2 rows, q the last)
//! ```
//! Subtracting the last row from the others gives the determinants of differences that the predicates document; in the
//! second, `|a|^2 - |q|^2` differs from `|a - q|^2` by a multiple of the other columns.

use super::{determinant, lift};
use rug::{Integer, Rational};

/// The sign of the orientation of `D + 1` points of `D` dimensions.
#[must_use]
pub fn orient<const D: usize>(points: &[[f64; D]]) -> i32 {
    sign(&determinant(&orient_rows(lift(points))))
}

/// The determinant whose sign [`orient`] gives, of coordinates that are multiples of `2^-10`, rounded once.
#[must_use]
pub fn orient_value<const D: usize>(points: &[[f64; D]]) -> f64 {
    let degree = u32::try_from(D).expect("few dimensions");
    Rational::from((determinant(&orient_rows(fixed(points))), Integer::from(1) << (10 * degree))).to_f64()
}

/// The side of the last point of the sphere through the `D + 1` before it: positive inside if those are positively
/// oriented.
#[must_use]
pub fn in_sphere<const D: usize>(points: &[[f64; D]]) -> i32 {
    sign(&determinant(&in_sphere_rows(lift(points))))
}

/// The determinant whose sign [`in_sphere`] gives, of coordinates that are multiples of `2^-10`, rounded once.
#[must_use]
pub fn in_sphere_value<const D: usize>(points: &[[f64; D]]) -> f64 {
    let degree = u32::try_from(D + 2).expect("few dimensions");
    Rational::from((determinant(&in_sphere_rows(fixed(points))), Integer::from(1) << (10 * degree))).to_f64()
}

fn orient_rows<const D: usize>(points: Vec<[Integer; D]>) -> Vec<Vec<Integer>> {
    assert_eq!(points.len(), D + 1);
    points.into_iter().map(|point| point.into_iter().chain([Integer::from(1)]).collect()).collect()
}

fn in_sphere_rows<const D: usize>(points: Vec<[Integer; D]>) -> Vec<Vec<Integer>> {
    assert_eq!(points.len(), D + 2);
    let row = |point: [Integer; D]| {
        let square = point.iter().fold(Integer::new(), |sum, c| sum + c.clone().square());
        point.into_iter().chain([square, Integer::from(1)]).collect()
    };
    points.into_iter().map(row).collect()
}

/// Coordinates in units of `2^-10`.
fn fixed<const D: usize>(points: &[[f64; D]]) -> Vec<[Integer; D]> {
    let whole = |c: f64| {
        assert!((c * 1024.0).fract() == 0.0, "{c} is not a multiple of 2^-10");
        Integer::from_f64(c * 1024.0).expect("finite")
    };
    points.iter().map(|point| point.map(whole)).collect()
}

fn sign(value: &Integer) -> i32 {
    value.cmp0() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counterclockwise_is_positive() {
        assert_eq!(orient(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), 1);
        assert_eq!(orient(&[[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]), -1);
        assert_eq!(orient(&[[0.0, 0.0], [3.0, 3.0], [-1.0, -1.0]]), 0);
    }

    fn unit<const D: usize>(axis: usize) -> [f64; D] {
        std::array::from_fn(|i| if i == axis { 1.0 } else { 0.0 })
    }

    #[test]
    fn space_and_space_time() {
        // det [e_0; e_1; e_2] = 1 with the origin last.
        assert_eq!(orient::<3>(&[unit(0), unit(1), unit(2), [0.0; 3]]), 1);
        assert_eq!(orient::<4>(&[unit(0), unit(1), unit(2), unit(3), [0.0; 4]]), 1);
        assert_eq!(orient::<4>(&[unit(1), unit(0), unit(2), unit(3), [0.0; 4]]), -1);
    }

    #[test]
    fn inside_is_positive_for_positive_orientation() {
        let circle = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];
        let with = |q: [f64; 2]| in_sphere(&[circle[0], circle[1], circle[2], q]);
        assert_eq!((orient(&circle), with([0.0, 0.0]), with([0.0, -1.0]), with([2.0, 0.0])), (1, 1, 0, -1));
        let sphere = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]];
        assert_eq!(orient(&sphere), 1);
        let with = |q: [f64; 3]| in_sphere(&[sphere[0], sphere[1], sphere[2], sphere[3], q]);
        assert_eq!((with([0.0, 0.0, 0.0]), with([0.0, -1.0, 0.0]), with([0.0, 0.0, -1.5])), (1, 0, -1));
    }
}
