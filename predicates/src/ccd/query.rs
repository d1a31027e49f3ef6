//! The queries: vertex against face, edge against edge, and vertex against segment in the plane.

use super::decide::Ask;
use super::exact::decide;
use super::settle::{Query, Step, culled};
use super::stage::Stage;
use super::{EDGE_EDGE, STEP, VERTEX_FACE, VERTEX_SEGMENT};
use crate::Point;
use crate::intersection::{segments_intersect_3d, triangle_contains_3d};

/// The times of a closed time step at which two primitives touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ContactTimes {
    /// So many single times: at most three, but for motion within a plane, which may have a few more.
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
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    match culled(&t0, &t1, &VERTEX_FACE) {
        Some(stage) => (false, stage),
        None => settle_vertex_face([t0, t1].map(copied), STEP),
    }
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
    let step = [t0.map(Point::coords), t1.map(Point::coords)];
    is_part_of_step(interval)
        && culled(&step[0], &step[1], &VERTEX_FACE).is_none()
        && settle_vertex_face(step, interval).0
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
    let step = [t0.map(Point::coords), t1.map(Point::coords)];
    match culled(&step[0], &step[1], &VERTEX_FACE) {
        Some(_) => ContactTimes::Finite(0),
        None => of_vertex_face(&step).contact_times(),
    }
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
    let (t0, t1) = (t0.map(Point::coords), t1.map(Point::coords));
    match culled(&t0, &t1, &EDGE_EDGE) {
        Some(stage) => (false, stage),
        None => settle_edge_edge([t0, t1].map(copied), STEP),
    }
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
    let step = [t0.map(Point::coords), t1.map(Point::coords)];
    is_part_of_step(interval)
        && culled(&step[0], &step[1], &EDGE_EDGE).is_none()
        && settle_edge_edge(step, interval).0
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
    let step = [t0.map(Point::coords), t1.map(Point::coords)];
    match culled(&step[0], &step[1], &EDGE_EDGE) {
        Some(_) => ContactTimes::Finite(0),
        None => of_edge_edge(&step).contact_times(),
    }
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
    let plane = [t0.map(Point::coords), t1.map(Point::coords)];
    let step = plane.map(lifted);
    match culled(&step[0], &step[1], &EDGE_EDGE) {
        Some(stage) => (false, stage),
        None => of_vertex_segment(&plane, &step).settle(STEP),
    }
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
    let plane = [t0.map(Point::coords), t1.map(Point::coords)];
    let step = plane.map(lifted);
    is_part_of_step(interval)
        && culled(&step[0], &step[1], &EDGE_EDGE).is_none()
        && of_vertex_segment(&plane, &step).settle(interval).0
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
    let plane = [t0.map(Point::coords), t1.map(Point::coords)];
    let step = plane.map(lifted);
    match culled(&step[0], &step[1], &EDGE_EDGE) {
        Some(_) => ContactTimes::Finite(0),
        None => of_vertex_segment(&plane, &step).contact_times(),
    }
}

/// A fresh array, made where the fast path is left: passing the first one on would keep the coordinates of the fast path in
/// memory instead of registers.
#[inline(always)]
pub(super) fn copied(places: [[f64; 3]; 4]) -> [[f64; 3]; 4] {
    core::array::from_fn(|i| core::array::from_fn(|k| places[i][k]))
}

/// What [`culled`] leaves of a query.
#[inline(never)]
pub(super) fn settle_vertex_face(step: Step, interval: [f64; 2]) -> (bool, Stage) {
    of_vertex_face(&step).settle(interval)
}

/// What [`culled`] leaves of a query.
#[inline(never)]
pub(super) fn settle_edge_edge(step: Step, interval: [f64; 2]) -> (bool, Stage) {
    of_edge_edge(&step).settle(interval)
}

/// What answers an exact question about a step.
trait Exactly: Fn([f64; 2], Ask, Option<[usize; 2]>) -> ContactTimes {}
impl<F: Fn([f64; 2], Ask, Option<[usize; 2]>) -> ContactTimes> Exactly for F {}

#[inline(always)]
fn of_vertex_face(step: &Step) -> Query<'_, 3, impl Exactly> {
    Query {
        step,
        corners: &VERTEX_FACE,
        touch: |[v, f0, f1, f2]| triangle_contains_3d([f0, f1, f2], v),
        exact: |interval, ask, axes| decide_in(step, axes, &VERTEX_FACE, interval, ask),
    }
}

#[inline(always)]
fn of_edge_edge(step: &Step) -> Query<'_, 4, impl Exactly> {
    Query {
        step,
        corners: &EDGE_EDGE,
        touch: |[ea0, ea1, eb0, eb1]| segments_intersect_3d([ea0, ea1], [eb0, eb1]),
        exact: |interval, ask, axes| decide_in(step, axes, &EDGE_EDGE, interval, ask),
    }
}

/// The vertex as an edge across the plane, so that the stages of two edges serve; but the exact one is of the plane.
#[inline(always)]
fn of_vertex_segment<'s>(plane: &'s [[[f64; 2]; 3]; 2], lifted: &'s Step) -> Query<'s, 4, impl Exactly> {
    Query {
        step: lifted,
        corners: &EDGE_EDGE,
        touch: |[ea0, ea1, eb0, eb1]| segments_intersect_3d([ea0, ea1], [eb0, eb1]),
        exact: |interval, ask, _| decide([&plane[0], &plane[1]], &VERTEX_SEGMENT, interval, ask),
    }
}

/// The exact decision in space, or in the plane of two axes.
fn decide_in(
    step: &Step,
    axes: Option<[usize; 2]>,
    corners: &[(usize, usize)],
    interval: [f64; 2],
    ask: Ask,
) -> ContactTimes {
    let Some(axes) = axes else { return decide([&step[0], &step[1]], corners, interval, ask) };
    let [p, q] = step.map(|places: [[f64; 3]; 4]| places.map(|point| axes.map(|k| point[k])));
    decide([&p, &q], corners, interval, ask)
}

#[inline(always)]
fn lifted([v, s0, s1]: [[f64; 2]; 3]) -> [[f64; 3]; 4] {
    let at = |[x, y]: [f64; 2], z: f64| [x, y, z];
    [at(v, -1.0), at(v, 1.0), at(s0, 0.0), at(s1, 0.0)]
}

fn is_part_of_step([from, to]: [f64; 2]) -> bool {
    0.0 <= from && from <= to && to <= 1.0
}
