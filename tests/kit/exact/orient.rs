//! Orientation and in-sphere signs from the homogeneous determinants, in any dimension.
//!
//! ```text
//! orient(p_0 .. p_D)        = sign det [ p_i, 1 ]              (D+1 rows)
//! in_sphere(p_0 .. p_D, q)  = sign det [ p_i, |p_i|^2, 1 ]     (D+2 rows, q the last)
//! ```
//! Subtracting the last row from the others gives the determinants of differences that the predicates document; in the
//! second, `|a|^2 - |q|^2` differs from `|a - q|^2` by a multiple of the other columns.

use super::{determinant, lift};
use rug::Integer;

/// The sign of the orientation of `D + 1` points of `D` dimensions.
#[must_use]
pub fn orient<const D: usize>(points: &[[f64; D]]) -> i32 {
    assert_eq!(points.len(), D + 1);
    let rows: Vec<Vec<Integer>> =
        lift(points).into_iter().map(|point| point.into_iter().chain([Integer::from(1)]).collect()).collect();
    sign(&determinant(&rows))
}

/// The side of the last point of the sphere through the `D + 1` before it: positive inside if those are positively
/// oriented.
#[must_use]
pub fn in_sphere<const D: usize>(points: &[[f64; D]]) -> i32 {
    assert_eq!(points.len(), D + 2);
    let rows: Vec<Vec<Integer>> = lift(points)
        .into_iter()
        .map(|point| {
            let square = point.iter().fold(Integer::new(), |sum, c| sum + c.clone().square());
            point.into_iter().chain([square, Integer::from(1)]).collect()
        })
        .collect();
    sign(&determinant(&rows))
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
