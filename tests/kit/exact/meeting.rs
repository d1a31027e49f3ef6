//! The intersection of two convex sets given by few generators, exactly: [`meeting`], [`meeting_of_ray`].
//!
//! The common points of the hulls of `a_0 ..` and `b_0 ..` are the images of the weights
//! ```text
//! sum s_i a_i = sum t_j b_j,   sum s_i = 1,   sum t_j = 1,   s_i >= 0,   t_j >= 0.
//! ```
//! These weights form a polytope. Its vertices are the solutions with linearly independent columns and no zero weight,
//! found here by trying every set of at most `D + 2` columns. The intersection is the hull of the images of those
//! vertices; the weights that are positive at a vertex name the smallest face of either set that contains it. No
//! orientation sign and no case distinction takes part, so this is independent of predicates built from sign tables, and
//! degenerate sets (a triangle that is a segment or a point) need no care.
//!
//! A ray is a point plus non-negative multiples of a direction: a column that does not count in its sum of weights.

use super::{lift, linear};
use rug::Integer;

/// The intersection of two convex sets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Meeting {
    /// Points whose hull is the intersection. If both sets are simplices these are its corners, each once.
    pub corners: Vec<Corner>,
}

/// A corner of an intersection, with the faces it lies on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Corner {
    /// Homogeneous coordinates, without a common divisor, the last one positive.
    pub point: Vec<Integer>,
    /// Bit `i` is set if generator `i` of the first set has a positive weight: the smallest face that holds the point.
    pub face_a: u32,
    /// The same for the second set.
    pub face_b: u32,
}

impl Meeting {
    /// True if the sets have no common point.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }

    /// 0 for a point, 1 for a segment, 2 for an area; nothing for disjoint sets.
    #[must_use]
    pub fn dimension(&self) -> Option<usize> {
        let points: Vec<Vec<Integer>> = self.corners.iter().map(|corner| corner.point.clone()).collect();
        linear::affine_dimension(&points)
    }

    /// The smallest face of the first set that holds the whole intersection; 0 if it is empty.
    #[must_use]
    pub fn face_a(&self) -> u32 {
        self.corners.iter().fold(0, |face, corner| face | corner.face_a)
    }

    /// The smallest face of the second set that holds the whole intersection; 0 if it is empty.
    #[must_use]
    pub fn face_b(&self) -> u32 {
        self.corners.iter().fold(0, |face, corner| face | corner.face_b)
    }
}

/// The intersection of the hulls of two sets of points.
///
/// The faces of a [`Meeting`] are faces in the geometric sense if the points of each set are the vertices of a simplex.
#[must_use]
pub fn meeting<const D: usize>(a: &[[f64; D]], b: &[[f64; D]]) -> Meeting {
    let mut lifted = lift(&[a, b].concat());
    let second = lifted.split_off(a.len());
    enumerate::<D>(&points(lifted), &points(second))
}

/// The intersection of the hulls of two sets of points with integer coordinates; as [`meeting`].
#[must_use]
pub fn meeting_of_integers<const D: usize>(a: Vec<[Integer; D]>, b: Vec<[Integer; D]>) -> Meeting {
    enumerate::<D>(&points(a), &points(b))
}

/// The intersection of the ray from `origin` along the vector `direction` with the hull of `b`.
///
/// Of the first set, bit 0 is the origin and bit 1 the direction: `face_a() == 1` says that only the origin meets `b`.
#[must_use]
pub fn meeting_of_ray<const D: usize>(origin: [f64; D], direction: [f64; D], b: &[[f64; D]]) -> Meeting {
    let mut ray = points(lift(&[&[origin, direction], b].concat()));
    let second = ray.split_off(2);
    ray[1].counts = false;
    enumerate::<D>(&ray, &second)
}

/// The intersection of the ray from `origin` through another point with the hull of `b`; as [`meeting_of_ray`].
#[must_use]
pub fn meeting_of_ray_through<const D: usize>(
    origin: [f64; D],
    through: [f64; D],
    b: &[[f64; D]],
) -> Meeting {
    let mut ray = points(lift(&[&[origin, through], b].concat()));
    let second = ray.split_off(2);
    for axis in 0..D {
        let start = ray[0].coordinates[axis].clone();
        ray[1].coordinates[axis] -= start;
    }
    ray[1].counts = false;
    enumerate::<D>(&ray, &second)
}

/// A generator of a convex set: a point, or a direction if it does not count in the sum of weights.
struct Generator {
    coordinates: Vec<Integer>,
    counts: bool,
}

fn points<const D: usize>(lifted: Vec<[Integer; D]>) -> Vec<Generator> {
    lifted.into_iter().map(|p| Generator { coordinates: p.into(), counts: true }).collect()
}

fn enumerate<const D: usize>(a: &[Generator], b: &[Generator]) -> Meeting {
    let (in_a, count) = ((1_u32 << a.len()) - 1, a.len() + b.len());
    // One column a generator: coordinates (negated for the second set), then its part in either sum of weights.
    let column = |g: &Generator, second: bool| -> Vec<Integer> {
        let coordinates = g.coordinates.iter().map(|c| if second { Integer::from(-c) } else { c.clone() });
        let sums = [g.counts && !second, g.counts && second].map(Integer::from);
        coordinates.chain(sums).collect()
    };
    let columns: Vec<Vec<Integer>> =
        a.iter().map(|g| column(g, false)).chain(b.iter().map(|g| column(g, true))).collect();
    let target: Vec<Integer> = (0..D + 2).map(|row| Integer::from(row >= D)).collect();

    let mut corners = Vec::new();
    for support in 1_u32..1 << count {
        if support.count_ones() as usize > D + 2 || support & in_a == 0 || support & !in_a == 0 {
            continue;
        }
        let chosen: Vec<usize> = (0..count).filter(|&i| support >> i & 1 == 1).collect();
        let subset: Vec<&[Integer]> = chosen.iter().map(|&i| columns[i].as_slice()).collect();
        let Some((weights, denominator)) = linear::solve(&subset, &target) else { continue };
        if weights.iter().any(|w| w.cmp0() != denominator.cmp0()) {
            continue; // a weight that is zero or negative
        }
        let mut image = vec![Integer::new(); D];
        for (&i, weight) in chosen.iter().zip(&weights).filter(|&(&i, _)| i < a.len()) {
            for (sum, c) in image.iter_mut().zip(&a[i].coordinates) {
                *sum += Integer::from(weight * c);
            }
        }
        image.push(denominator);
        let (face_a, face_b) = (support & in_a, support >> a.len());
        corners.push(Corner { point: linear::primitive(image), face_a, face_b });
    }
    Meeting { corners }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn case(a: &[[f64; 3]], b: &[[f64; 3]]) -> (Option<usize>, u32, u32) {
        let found = meeting(a, b);
        (found.dimension(), found.face_a(), found.face_b())
    }

    #[test]
    fn segments_of_the_plane() {
        let across = |c: [f64; 2], d: [f64; 2]| {
            let found = meeting(&[[0.0, 0.0], [4.0, 0.0]], &[c, d]);
            (found.dimension(), found.face_a(), found.face_b())
        };
        assert_eq!(across([1.0, -1.0], [2.0, 1.0]), (Some(0), 0b11, 0b11));
        assert_eq!(across([1.0, 0.0], [2.0, 1.0]), (Some(0), 0b11, 0b01));
        assert_eq!(across([5.0, 5.0], [4.0, 0.0]), (Some(0), 0b10, 0b10));
        assert_eq!(across([1.0, 0.0], [2.0, 0.0]), (Some(1), 0b11, 0b11));
        assert_eq!(across([5.0, 0.0], [6.0, 0.0]), (None, 0, 0));
        assert_eq!(across([5.0, -1.0], [5.0, 1.0]), (None, 0, 0));
        // A point.
        assert_eq!(across([1.0, 0.0], [1.0, 0.0]).0, Some(0));
    }

    #[test]
    fn triangles_of_space() {
        let through = [[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]];
        assert_eq!(case(&TRIANGLE, &through), (Some(1), 0b111, 0b111));
        let standing = [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]];
        assert_eq!(case(&TRIANGLE, &standing), (Some(0), 0b111, 0b001));
        let on_edge = [[1.0, 0.0, 0.0], [1.0, -1.0, 1.0], [2.0, -1.0, 1.0]];
        assert_eq!(case(&TRIANGLE, &on_edge), (Some(0), 0b011, 0b001));
        let flat = [[1.0, 1.0, 0.0], [9.0, 1.0, 0.0], [9.0, 2.0, 0.0]];
        assert_eq!(case(&TRIANGLE, &flat), (Some(2), 0b111, 0b111));
        assert_eq!(case(&TRIANGLE, &TRIANGLE), (Some(2), 0b111, 0b111));
        let above = TRIANGLE.map(|p| [p[0], p[1], f64::from_bits(1)]);
        assert_eq!(case(&TRIANGLE, &above), (None, 0, 0));
    }

    #[test]
    fn points_in_simplices() {
        let tetrahedron = [TRIANGLE[0], TRIANGLE[1], TRIANGLE[2], [0.0, 0.0, 4.0]];
        assert_eq!(case(&[[1.0, 1.0, 1.0]], &tetrahedron), (Some(0), 1, 0b1111));
        assert_eq!(case(&[[1.0, 1.0, 2.0]], &tetrahedron), (Some(0), 1, 0b1110));
        assert_eq!(case(&[[0.0, 0.0, 4.0]], &tetrahedron), (Some(0), 1, 0b1000));
        assert_eq!(case(&[[1.0, 1.0, 2.0f64.next_up()]], &tetrahedron), (None, 0, 0));
    }

    #[test]
    fn rays() {
        let hit = |origin, direction| {
            let found = meeting_of_ray(origin, direction, &TRIANGLE);
            (found.dimension(), found.face_a(), found.face_b())
        };
        assert_eq!(hit([1.0, 1.0, 5.0], [0.0, 0.0, -1.0]), (Some(0), 0b11, 0b111));
        assert_eq!(hit([1.0, 1.0, 5.0], [0.0, 0.0, 1.0]), (None, 0, 0));
        assert_eq!(hit([1.0, 1.0, 0.0], [0.0, 0.0, 1.0]), (Some(0), 0b01, 0b111));
        assert_eq!(hit([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]), (Some(1), 0b11, 0b011));
        assert_eq!(hit([1.0, 1.0, 0.0], [0.0, 0.0, 0.0]), (Some(0), 0b01, 0b111));
    }
}
