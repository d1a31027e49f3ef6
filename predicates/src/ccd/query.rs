//! The queries: vertex against face, edge against edge, and vertex against segment in the plane.

use super::decide::{Ask, Motion};
use super::separation::Corners;
use super::stage::Stage;
use crate::Point;
use crate::arithmetic::arena::Arena;
use crate::arithmetic::fixed_point::{COORDINATE_LIMBS, Unit};
use crate::intersection::{segments_intersect_3d, triangle_contains_3d};

/// The times of a closed time step at which two primitives touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ContactTimes {
    /// So many single times.
    Finite(u8),
    /// Throughout an interval of time, or several.
    Infinite,
}

impl ContactTimes {
    /// True when there is a contact.
    #[must_use]
    pub fn any(self) -> bool {
        self != Self::Finite(0)
    }
}

/// Corners of the polygon that holds the origin when a vertex touches a face: differences of the points v, f0, f1, f2.
const VERTEX_FACE: [(usize, usize); 3] = [(1, 0), (2, 0), (3, 0)];

/// The same for the points ea0, ea1, eb0, eb1, in order around the parallelogram.
const EDGE_EDGE: [(usize, usize); 4] = [(0, 2), (1, 2), (1, 3), (0, 3)];

/// The same for the points v, s0, s1 of the plane.
const VERTEX_SEGMENT: [(usize, usize); 2] = [(1, 0), (2, 0)];

/// Whether the moving vertex touches the moving triangle at a time of the closed step.
///
/// `t0` and `t1` are the places of `v, f0, f1, f2` at its beginning and at its end. False when a coordinate is not finite.
///
/// ```
/// use welter_predicates::ccd::vertex_face;
/// let rest = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
/// let step = |z0, z1| vertex_face([[0.0, 0.0, z0], rest[0], rest[1], rest[2]], [[0.0, 0.0, z1], rest[0], rest[1], rest[2]]);
/// assert!(step(1.0, -1.0));
/// assert!(step(1.0, 0.0));
/// assert!(!step(1.0, 5e-324));
/// ```
#[inline]
#[must_use]
pub fn vertex_face(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4]) -> bool {
    staged_vertex_face(t0, t1).0
}

/// [`vertex_face`] with the stage that settled it.
#[inline]
#[must_use]
pub fn staged_vertex_face(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4]) -> (bool, Stage) {
    let at = |[v, f0, f1, f2]: [[f64; 3]; 4]| triangle_contains_3d([f0, f1, f2], v);
    settle(&t0.map(Point::coords), &t1.map(Point::coords), &VERTEX_FACE, at)
}

/// Whether the moving vertex touches the moving triangle at a time of the closed `interval` of the step.
///
/// `t0` and `t1` as for [`vertex_face`]; the interval is `[from, to]` with `0 <= from <= to <= 1`, its ends are exact numbers
/// of which the vertices' places at these times need not be rounded. False when a coordinate is not finite, or
/// when the interval is not of that kind.
///
/// ```
/// use welter_predicates::ccd::vertex_face_during;
/// let face = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
/// let v = |z| [[0.0, 0.0, z], face[0], face[1], face[2]];
/// // Contact at 1/4.
/// assert!(vertex_face_during(v(1.0), v(-3.0), [0.0, 0.25]));
/// assert!(!vertex_face_during(v(1.0), v(-3.0), [0.0, 0.25 - f64::EPSILON]));
/// assert!(!vertex_face_during(v(1.0), v(-3.0), [0.25 + f64::EPSILON, 1.0]));
/// ```
#[must_use]
pub fn vertex_face_during(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4], interval: [f64; 2]) -> bool {
    settle_during(&t0.map(Point::coords), &t1.map(Point::coords), &VERTEX_FACE, interval)
}

/// At how many times of the closed step the moving vertex touches the moving triangle; arguments as for [`vertex_face`].
///
/// ```
/// use welter_predicates::ccd::{ContactTimes, vertex_face_times};
/// // The triangle swings through the vertex's path and back: contact at 1/4 and at 3/4.
/// let t0 = [[-1.0, 0.0, -0.25], [-4.0, -4.0, -4.0], [4.0, -4.0, 4.0], [0.0, 4.0, 0.0]];
/// let t1 = [[1.0, 0.0, -0.25], [-4.0, -4.0, 4.0], [4.0, -4.0, -4.0], [0.0, 4.0, 0.0]];
/// assert_eq!(vertex_face_times(t0, t1), ContactTimes::Finite(2));
/// ```
#[must_use]
pub fn vertex_face_times(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4]) -> ContactTimes {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    if never(&t0, &t1, &VERTEX_FACE) || !all_finite(&t0, &t1) {
        return ContactTimes::Finite(0);
    }
    decide([&t0, &t1], &VERTEX_FACE, STEP, Ask::Count)
}

/// Whether the moving edges touch at a time of the closed step.
///
/// `t0` and `t1` are the places of `ea0, ea1, eb0, eb1` at its beginning and at its end. False when a coordinate is not
/// finite.
///
/// ```
/// use welter_predicates::ccd::edge_edge;
/// // One edge slides along its own line onto the other, at rest.
/// let t0 = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
/// let t1 = [[1.5, 0.0, 0.0], [2.5, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
/// assert!(edge_edge(t0, t1));
/// ```
#[inline]
#[must_use]
pub fn edge_edge(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4]) -> bool {
    staged_edge_edge(t0, t1).0
}

/// [`edge_edge`] with the stage that settled it.
#[inline]
#[must_use]
pub fn staged_edge_edge(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4]) -> (bool, Stage) {
    let at = |[ea0, ea1, eb0, eb1]: [[f64; 3]; 4]| segments_intersect_3d([ea0, ea1], [eb0, eb1]);
    settle(&t0.map(Point::coords), &t1.map(Point::coords), &EDGE_EDGE, at)
}

/// Whether the moving edges touch at a time of the closed `interval` of the step; `t0` and `t1` as for [`edge_edge`],
/// `interval` as for [`vertex_face_during`].
///
/// ```
/// use welter_predicates::ccd::edge_edge_during;
/// // One edge slides along its own line onto the other, at rest, from 2/3 on.
/// let t0 = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
/// let t1 = [[1.5, 0.0, 0.0], [2.5, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
/// assert!(!edge_edge_during(t0, t1, [0.0, 2.0 / 3.0])); // rounded down
/// assert!(edge_edge_during(t0, t1, [0.0, 2.0 / 3.0 + f64::EPSILON]));
/// ```
#[must_use]
pub fn edge_edge_during(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4], interval: [f64; 2]) -> bool {
    settle_during(&t0.map(Point::coords), &t1.map(Point::coords), &EDGE_EDGE, interval)
}

/// At how many times of the closed step the moving edges touch; arguments as for [`edge_edge`].
///
/// ```
/// use welter_predicates::ccd::{ContactTimes, edge_edge_times};
/// let t0 = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
/// let t1 = [[1.5, 0.0, 0.0], [2.5, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
/// assert_eq!(edge_edge_times(t0, t1), ContactTimes::Infinite);
/// ```
#[must_use]
pub fn edge_edge_times(t0: [impl Point<3>; 4], t1: [impl Point<3>; 4]) -> ContactTimes {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    if never(&t0, &t1, &EDGE_EDGE) || !all_finite(&t0, &t1) {
        return ContactTimes::Finite(0);
    }
    decide([&t0, &t1], &EDGE_EDGE, STEP, Ask::Count)
}

/// Whether the moving vertex touches the moving segment of the plane at a time of the closed step.
///
/// `t0` and `t1` are the places of `v, s0, s1` at its beginning and at its end. False when a coordinate is not finite.
///
/// ```
/// use welter_predicates::ccd::vertex_segment_2d;
/// let s = [[-1.0, 0.0], [1.0, 0.0]];
/// assert!(vertex_segment_2d([[0.0, 1.0], s[0], s[1]], [[0.0, -1.0], s[0], s[1]]));
/// assert!(!vertex_segment_2d([[2.0, 1.0], s[0], s[1]], [[2.0, -1.0], s[0], s[1]]));
/// ```
#[inline]
#[must_use]
pub fn vertex_segment_2d(t0: [impl Point<2>; 3], t1: [impl Point<2>; 3]) -> bool {
    staged_vertex_segment_2d(t0, t1).0
}

/// [`vertex_segment_2d`] with the stage that settled it.
#[inline]
#[must_use]
pub fn staged_vertex_segment_2d(t0: [impl Point<2>; 3], t1: [impl Point<2>; 3]) -> (bool, Stage) {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    if boxes_apart(&t0, &t1, &VERTEX_SEGMENT) {
        return (false, Stage::Boxes);
    }
    if !all_finite(&t0, &t1) {
        return (false, Stage::NonFinite);
    }
    (decide([&t0, &t1], &VERTEX_SEGMENT, STEP, Ask::Any).any(), Stage::Exact)
}

/// Whether the moving vertex touches the moving segment at a time of the closed `interval` of the step; `t0` and `t1` as for
/// [`vertex_segment_2d`], `interval` as for [`vertex_face_during`].
///
/// ```
/// use welter_predicates::ccd::vertex_segment_2d_during;
/// let s = [[-1.0, 0.0], [1.0, 0.0]];
/// let (t0, t1) = ([[0.0, 1.0], s[0], s[1]], [[0.0, -1.0], s[0], s[1]]);
/// assert!(vertex_segment_2d_during(t0, t1, [0.5, 0.5]));
/// assert!(!vertex_segment_2d_during(t0, t1, [0.0, 0.4]));
/// ```
#[must_use]
pub fn vertex_segment_2d_during(t0: [impl Point<2>; 3], t1: [impl Point<2>; 3], interval: [f64; 2]) -> bool {
    settle_during(&t0.map(Point::coords), &t1.map(Point::coords), &VERTEX_SEGMENT, interval)
}

/// At how many times of the closed step the moving vertex touches the moving segment; arguments as for
/// [`vertex_segment_2d`].
///
/// ```
/// use welter_predicates::ccd::{ContactTimes, vertex_segment_2d_times};
/// let s = [[-1.0, 0.0], [1.0, 0.0]];
/// let times = vertex_segment_2d_times([[-2.0, 0.0], s[0], s[1]], [[-1.0, 0.0], s[0], s[1]]);
/// assert_eq!(times, ContactTimes::Finite(1));
/// ```
#[must_use]
pub fn vertex_segment_2d_times(t0: [impl Point<2>; 3], t1: [impl Point<2>; 3]) -> ContactTimes {
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    if boxes_apart(&t0, &t1, &VERTEX_SEGMENT) || !all_finite(&t0, &t1) {
        return ContactTimes::Finite(0);
    }
    decide([&t0, &t1], &VERTEX_SEGMENT, STEP, Ask::Count)
}

/// Climbs the stages of a query in space; `at` tells whether the primitives touch at one time.
#[inline(always)]
fn settle<const K: usize>(
    t0: &[[f64; 3]; 4],
    t1: &[[f64; 3]; 4],
    corners: &[(usize, usize); K],
    at: impl Fn([[f64; 3]; 4]) -> bool,
) -> (bool, Stage) {
    if boxes_apart(t0, t1, corners) {
        return (false, Stage::Boxes);
    }
    let differences = Corners::new(t0, t1, corners);
    if differences.separated() {
        return (false, Stage::Direction);
    }
    if let Some(contact) = differences.crosses() {
        return (contact, Stage::Subdivision);
    }
    if !all_finite(t0, t1) {
        return (false, Stage::NonFinite);
    }
    if at(*t0) || at(*t1) {
        return (true, Stage::Ends);
    }
    (decide([t0, t1], corners, STEP, Ask::Any).any(), Stage::Exact)
}

/// Whether there is a contact within the interval.
fn settle_during<const N: usize, const P: usize>(
    t0: &[[f64; N]; P],
    t1: &[[f64; N]; P],
    corners: &[(usize, usize)],
    interval: [f64; 2],
) -> bool {
    let [from, to] = interval;
    let is_part = (0.0..=to).contains(&from) && to <= 1.0;
    is_part
        && !boxes_apart(t0, t1, corners)
        && all_finite(t0, t1)
        && decide([t0, t1], corners, interval, Ask::Any).any()
}

/// Limbs of an arena for one decision, per limb of a coordinate: twice the largest use, which is that of three roots or of
/// a motion in a plane, as a test measures it with coordinates of 33 limbs.
const LIMBS_PER_LIMB: usize = 2300;

/// The whole time step.
const STEP: [f64; 2] = [0.0, 1.0];

/// Limbs of a time in [0, 1], in units of at least 2^-1074.
const TIME_LIMBS: usize = 17;

/// Coordinates of up to this many bits, that is most, are decided with a small arena.
const FEW_LIMBS: usize = 3;

/// True when a filter separates the primitives throughout the step.
#[inline]
fn never<const K: usize>(t0: &[[f64; 3]; 4], t1: &[[f64; 3]; 4], corners: &[(usize, usize); K]) -> bool {
    boxes_apart(t0, t1, corners) || Corners::new(t0, t1, corners).separated()
}

fn all_finite<const N: usize, const P: usize>(t0: &[[f64; N]; P], t1: &[[f64; N]; P]) -> bool {
    t0.as_flattened().iter().chain(t1.as_flattened()).all(|x| x.is_finite())
}

/// The decision of [`super::decide`] within an interval, in an arena of the size that the coordinates ask for. All are finite.
#[cold]
fn decide<const N: usize>(
    points: [&[[f64; N]]; 2],
    corners: &[(usize, usize)],
    interval: [f64; 2],
    ask: Ask,
) -> ContactTimes {
    let coordinates = points.into_iter().flat_map(|p| p.as_flattened().iter().copied());
    let [from, to] = interval;
    let time_limbs = if interval == STEP { 0 } else { Unit::limbs([from, to, 1.0].into_iter()) };
    let limbs = Unit::limbs(coordinates) + time_limbs;
    if limbs <= FEW_LIMBS {
        decide_within::<N, { FEW_LIMBS * LIMBS_PER_LIMB }>(points, corners, interval, ask)
    } else if limbs <= COORDINATE_LIMBS {
        decide_within::<N, { COORDINATE_LIMBS * LIMBS_PER_LIMB }>(points, corners, interval, ask)
    } else {
        decide_within::<N, { (COORDINATE_LIMBS + TIME_LIMBS) * LIMBS_PER_LIMB }>(
            points, corners, interval, ask,
        )
    }
}

#[inline(never)]
fn decide_within<const N: usize, const LIMBS: usize>(
    points: [&[[f64; N]]; 2],
    corners: &[(usize, usize)],
    interval: [f64; 2],
    ask: Ask,
) -> ContactTimes {
    let mut limbs = [0; LIMBS];
    let mut arena = Arena::new(&mut limbs);
    Motion::new(points, corners, interval, &mut arena).contact_times(ask, &mut arena)
}

/// True when, along some axis, all corners are strictly on one side of the origin at both ends of the step, and so
/// throughout. Compares coordinates; nothing is rounded.
#[inline]
fn boxes_apart<const N: usize>(t0: &[[f64; N]], t1: &[[f64; N]], corners: &[(usize, usize)]) -> bool {
    (0..N).any(|k| {
        let all = |apart: fn(f64, f64) -> bool| {
            corners.iter().all(|&(i, j)| apart(t0[i][k], t0[j][k]) && apart(t1[i][k], t1[j][k]))
        };
        all(|x, y| x < y) || all(|x, y| x > y)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pseudorandom bits.
    struct Bits(u64);

    impl Bits {
        fn next(&mut self) -> u64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            self.0 >> 33
        }

        /// As wide as coordinates can be: the largest magnitudes, some of them sharing a set with the smallest.
        fn wide(&mut self) -> f64 {
            let value = match self.next() % 8 {
                0 => f64::from_bits(self.next()),
                1 => f64::from_bits(1),
                n => f64::MAX / n as f64,
            };
            if self.next().is_multiple_of(2) { value } else { -value }
        }

        /// Grid coordinates with all degeneracies, near the largest magnitude.
        fn coarse(&mut self) -> f64 {
            (self.next() % 9) as f64 * 2f64.powi(1019) - 2f64.powi(1021)
        }
    }

    fn high_water(
        t0: &[[f64; 3]; 4],
        t1: &[[f64; 3]; 4],
        corners: &[(usize, usize)],
        limbs: &mut [u64],
    ) -> usize {
        let mut arena = Arena::new(limbs);
        Motion::new([t0, t1], corners, STEP, &mut arena).contact_times(Ask::Count, &mut arena);
        arena.high_water
    }

    #[test]
    fn arenas_are_large_enough() {
        let mut bits = Bits(11);
        let mut limbs = [0; COORDINATE_LIMBS * LIMBS_PER_LIMB];
        let mut most = 0;
        for round in 0..16 {
            let mut points: [[[f64; 3]; 4]; 2] = core::array::from_fn(|_| {
                core::array::from_fn(|_| {
                    core::array::from_fn(|_| if round % 3 == 0 { bits.wide() } else { bits.coarse() })
                })
            });
            // One coordinate of the smallest unit makes all integers as long as they can be.
            points[0][0][0] = f64::from_bits(1);
            if round % 2 == 0 {
                points.as_flattened_mut().iter_mut().for_each(|p| p[2] = p[1]);
            }
            let corners: &[(usize, usize)] = if round % 4 < 2 { &VERTEX_FACE } else { &EDGE_EDGE };
            most = most.max(high_water(&points[0], &points[1], corners, &mut limbs));
        }
        // Half is left for what these did not reach.
        assert!(most > limbs.len() / 8 && most < limbs.len() / 2, "{most} of {}", limbs.len());
    }
}
