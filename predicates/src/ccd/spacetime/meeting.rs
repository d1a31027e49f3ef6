//! Whether two simplices of four-dimensional space with six corners in all meet: [`meet`].
//!
//! # Method
//! Six points `p_0 .. p_5` of R^4 have an affine dependency: numbers `c_i`, not all zero, with `sum c_i = 0`
//! and `sum c_i p_i = 0`. By Cramer's rule `c_i = (-1)^i orient4d(all but p_i)` is one, if these are not all
//! zero; the points then span R^4 and every other is a multiple of it.
//!
//! A common point of the simplices is `sum l_i p_i = sum m_j p_j` with non-negative weights that sum to 1 on
//! either side, so `(l, -m)` is a dependency. Conversely a dependency that is non-negative on the first simplex
//! and non-positive on the second gives a common point, divided by its sum over the first: if that sum were
//! zero, all its terms would be, so those of the second, of sum zero, too. Hence, where the points span R^4,
//! the simplices meet exactly if the `c_i` separate: none positive on one and none negative on the other, or
//! the reverse. The first pair that contradicts this ends the test.
//!
//! *Degenerate.* If all `c_i` are zero the points lie in a flat of at most three dimensions. Dropping a
//! coordinate is injective on a flat exactly if the dropped axis is not one of its directions; for one of the
//! four axes this is so, or the flat would be the whole space. It is found by a determinant of the kept
//! coordinates that is not zero, of as high an order as there is: the projected points then span as many
//! dimensions as the points themselves. An injective affine map takes common points to common points and has no
//! others. So the question is one of three dimensions, which [`crate::intersection`] decides for every
//! position: two triangles; or a segment and a tetrahedron, which meet if an end of the segment is in the
//! tetrahedron, or the segment meets one of its faces. (A point of the segment in the tetrahedron nearest to
//! one end is that end, or lies on the boundary, which is in the faces; a flat tetrahedron is the union of its
//! faces.)

use crate::intersection::{segment_intersects_triangle, tetrahedron_contains, triangles_intersect};
use crate::{Sign, orient2d, orient3d, orient4d};

type Events = [[f64; 4]; 6];

/// Whether the simplex of the first `split` points (2 or 3) meets that of the others. All are finite.
#[inline]
pub(super) fn meet(p: &Events, split: usize) -> bool {
    let mut common = Sign::Zero;
    for i in 0..6 {
        let rest: [usize; 5] = core::array::from_fn(|k| if k < i { k } else { k + 1 });
        let [a, b, c, d, e] = rest.map(|k| &p[k]);
        let orientation = orient4d(a, b, c, d, e);
        // The sign of c_i, or of -c_i in the second simplex.
        let weight = if (i % 2 == 1) == (i < split) { -orientation } else { orientation };
        if weight == -common && !weight.is_zero() {
            return false;
        }
        common = if common.is_zero() { weight } else { common };
    }
    !common.is_zero() || meet_in_flat(p, split)
}

/// The points without coordinate `axis`.
fn without(p: &Events, axis: usize) -> [[f64; 3]; 6] {
    p.map(|point| core::array::from_fn(|k| point[k + usize::from(k >= axis)]))
}

/// [`meet`] for points that do not span the space.
#[cold]
fn meet_in_flat(p: &Events, split: usize) -> bool {
    let [a, b, c, d, e, f] = without(p, injective_axis(p));
    if split == 3 {
        return triangles_intersect([a, b, c], [d, e, f]);
    }
    let tetrahedron = [c, d, e, f];
    tetrahedron_contains(tetrahedron, a)
        || tetrahedron_contains(tetrahedron, b)
        || [[c, d, e], [c, d, f], [c, e, f], [d, e, f]]
            .into_iter()
            .any(|face| segment_intersects_triangle([a, b], face))
}

/// A coordinate without which points that do not span the space are still different points of a flat of the
/// same dimension.
fn injective_axis(p: &Events) -> usize {
    // Space first: a flat scene is flat in space, while time tells the ends of the step apart.
    const AXES: [usize; 4] = [2, 1, 0, 3];
    for axis in AXES {
        let q = without(p, axis);
        if subsets::<4>().any(|[a, b, c, d]| !orient3d(q[a], q[b], q[c], q[d]).is_zero()) {
            return axis;
        }
    }
    for axis in AXES {
        for other in (0..4).filter(|&other| other != axis) {
            let kept = |i: usize| -> [f64; 2] {
                let mut rest = (0..4).filter(|&k| k != axis && k != other).map(|k| p[i][k]);
                core::array::from_fn(|_| rest.next().unwrap_or(0.0))
            };
            if subsets::<3>().any(|[a, b, c]| !orient2d(kept(a), kept(b), kept(c)).is_zero()) {
                return axis;
            }
        }
    }
    // On a line: any axis but the only coordinate in which the points differ, if there is just one.
    let differs = |k: usize| p.iter().any(|point| point[k] != p[0][k]);
    if (0..3).any(differs) && differs(3) || !differs(0) { 0 } else { 3 }
}

/// The subsets of `K` of six.
fn subsets<const K: usize>() -> impl Iterator<Item = [usize; K]> {
    (0_u32..1 << 6).filter(|set| set.count_ones() as usize == K).map(|set| {
        let mut rest = (0..6).filter(move |i| set >> i & 1 == 1);
        core::array::from_fn(|_| rest.next().unwrap_or(0))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flats_of_every_dimension_keep_their_points_apart() {
        // Points of a random flat of each dimension through the axes in `directions`, by integer weights.
        let axes: [[f64; 4]; 4] =
            core::array::from_fn(|i| core::array::from_fn(|k| f64::from(u8::from(i == k))));
        let skew = [[1.0, 2.0, -1.0, 0.0], [0.0, 1.0, 1.0, 1.0], [2.0, 0.0, 0.0, 1.0]];
        let weights = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 2.0],
            [0.0, 1.0, -1.0],
            [2.0, -1.0, 0.0],
            [1.0, 1.0, 1.0],
            [-2.0, 3.0, 1.0],
        ];
        let all: [[f64; 4]; 7] = [axes[0], axes[1], axes[2], axes[3], skew[0], skew[1], skew[2]];
        for set in 0_u32..1 << 7 {
            if set.count_ones() > 3 {
                continue;
            }
            let directions = (0..7).filter(|i| set >> i & 1 == 1).map(|i| all[i]);
            let mut p = [[5.0, -3.0, 2.0, 1.0]; 6];
            for (direction, j) in directions.zip(0..) {
                for (point, weight) in p.iter_mut().zip(weights) {
                    for k in 0..4 {
                        point[k] += weight[j] * direction[k];
                    }
                }
            }
            let q = without(&p, injective_axis(&p));
            for i in 0..6 {
                for j in 0..6 {
                    assert_eq!(p[i] == p[j], q[i] == q[j], "{p:?}");
                }
            }
        }
    }
}
