//! The sides of several points to the plane of one triangle.
//!
//! The determinant of `orient3d` with the two edges of the triangle and the difference to the point as columns
//! instead of rows: its `2 x 2` minors are then the normal, which all points share. The bound of the filter holds
//! for it with the largest entry of each difference. Where that does not decide, `orient3d` does.

use super::P3;
use crate::polynomial::{self, Rounded};
use crate::{Sign, filter, orient3d};

/// `orient3d(plane[0], plane[1], plane[2], p)` for each `p`.
#[inline(always)]
pub(super) fn sides<const K: usize>(plane: &[P3; 3], points: &[P3; K]) -> [Sign; K] {
    let [o, a, b] = plane;
    points.map(|p| {
        let columns: [P3; 3] = core::array::from_fn(|k| [a[k] - o[k], b[k] - o[k], p[k] - o[k]]);
        let height = polynomial::orient3d::<Rounded>(&columns);
        if height.abs() > filter::orient3d(&columns) {
            // Positive where the normal points; there `orient3d` is negative.
            Sign::of_nonzero(-height)
        } else {
            undecided(plane, p)
        }
    })
}

#[cold]
#[inline(never)]
fn undecided(plane: &[P3; 3], p: P3) -> Sign {
    if plane.contains(&p) { Sign::Zero } else { orient3d(plane[0], plane[1], plane[2], p) }
}
