//! The sides of several points to the plane of one triangle.
//!
//! The determinant of `orient3d` with the two edges of the triangle and the difference to the point as columns
//! instead of rows: its `2 x 2` minors are then the normal, which all points share. The bound of the filter holds
//! for it with the largest entry of each difference. Where that does not decide, `orient3d` does.

use super::P3;
use crate::polynomial::{self, Rounded};
use crate::{Sign, Stage, filter, orient3d, stats};

/// `orient3d(plane[0], plane[1], plane[2], p)` for each `p`.
#[inline(always)]
pub(crate) fn sides<const K: usize>(plane: &[P3; 3], points: &[P3; K]) -> [Sign; K] {
    let [o, a, b] = plane;
    points.map(|p| {
        let columns: [P3; 3] = core::array::from_fn(|k| [a[k] - o[k], b[k] - o[k], p[k] - o[k]]);
        let height = polynomial::orient3d::<Rounded>(&columns);
        if height.abs() > filter::orient3d(&columns) {
            stats::count(stats::Kind::Orient3d, Stage::Filter);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intersection::oracle::Sequence;

    /// Points in the plane but for rounding, at all magnitudes.
    #[test]
    fn sides_are_orientations() {
        let mut random = Sequence(31);
        let mut nonzero = 0;
        for round in 0..20000 {
            let scale = 2f64.powi(round % 600 * 3 - 900);
            let mut unit = || random.next() as f64 * 2f64.powi(-31);
            let mut corner = || -> P3 { core::array::from_fn(|_| unit() * scale) };
            let plane = [corner(), corner(), corner()];
            let (s, t) = (unit(), unit());
            let near: P3 = core::array::from_fn(|k| {
                let [o, a, b] = plane.map(|p| p[k]);
                o + s * (a - o) + t * (b - o)
            });
            let points = [near, plane[1]];
            let expected = points.map(|p| orient3d(plane[0], plane[1], plane[2], p));
            assert_eq!(sides(&plane, &points), expected, "{plane:?} {near:?}");
            nonzero += usize::from(!expected[0].is_zero());
        }
        assert!(nonzero > 15000, "{nonzero}");
    }
}
