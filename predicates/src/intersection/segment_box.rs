//! A point and a segment against a closed box given by its least and greatest corners.
//!
//! | case | the segment |
//! | --- | --- |
//! | `Disjoint` | has no common point with the box (always so for the empty box, `min > max` on some axis) |
//! | `Point(c)` | touches the box in one point, which lies on `c.a` of the segment and `c.b` of the box |
//! | `Overlap([c, d])` | shares with the box the segment from `c` to `d`, in its own direction |
//! | `Degenerate { a, b }` | meets the box, and the segment has length zero (`a`) or the box is flat (`b`) |
//!
//! Method: clipping by slabs. Along the segment the box is entered at the last of the planes it faces and left at
//! the first of the others. The order of two plane crossings along the segment is the sign of a `2 x 2`
//! determinant: `orient2d` of the segment and the corner of the two planes, in the projection on their axes.

use core::cmp::Ordering;

use super::hull::all_finite;
use super::{Contact, P3, SegmentFeature};
use crate::finite::check_finite;
use crate::{NonFinite, Point, Sign, orient2d};

/// Where a point of a box lies along one axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// On the face of the least coordinate.
    Min,
    /// Strictly between the two faces.
    Between,
    /// On the face of the greatest coordinate.
    Max,
}

/// The part of a box on which a point lies: its side along each axis. With no, one, two or three entries other
/// than `Between` it is the interior, a face, an edge or a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BoxFeature(pub [Side; 3]);

impl BoxFeature {
    /// The dimension: 3 for the interior, 2 for a face, 1 for an edge, 0 for a vertex.
    #[must_use]
    pub fn dimension(self) -> usize {
        self.0.iter().filter(|side| **side == Side::Between).count()
    }

    /// The smallest feature whose closure contains both: that of the open segment between their points.
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        Self(core::array::from_fn(|k| if self.0[k] == other.0[k] { self.0[k] } else { Side::Between }))
    }
}

/// How a point lies to a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PointBox {
    /// Outside.
    Disjoint,
    /// In the closed box, on this feature.
    On(BoxFeature),
    /// The box is flat (`min == max` on some axis), and the point lies in it.
    Degenerate,
}

/// How a segment and a box meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SegmentBox {
    /// No common point.
    Disjoint,
    /// One common point.
    Point(Contact<SegmentFeature, BoxFeature>),
    /// A common segment; its ends in the direction of the operand. It runs through the interior of the box
    /// exactly if the [`join`](BoxFeature::join) of the two box features has dimension 3.
    Overlap([Contact<SegmentFeature, BoxFeature>; 2]),
    /// They meet, and at least one is degenerate.
    Degenerate {
        /// The segment has length zero.
        a: bool,
        /// The box is flat: `min == max` on some axis.
        b: bool,
    },
}

/// How `p` lies to the closed box from `min` to `max`.
///
/// ```
/// use welter_predicates::intersection::{BoxFeature, PointBox, Side, point_in_box};
/// let on = point_in_box([0.5, 0.0, 1.0], [0.0; 3], [1.0; 3]);
/// assert_eq!(on, PointBox::On(BoxFeature([Side::Between, Side::Min, Side::Max])));
/// ```
pub fn point_in_box(p: impl Point<3>, min: impl Point<3>, max: impl Point<3>) -> PointBox {
    let (p, min, max) = (p.coords(), min.coords(), max.coords());
    if !all_finite(&[p, min, max]) || !contains(&p, &min, &max) {
        return PointBox::Disjoint;
    }
    if is_flat(&min, &max) { PointBox::Degenerate } else { PointBox::On(feature_of(&p, &min, &max)) }
}

/// True when `p` lies in the closed box: [`point_in_box`] is not `Disjoint`.
///
/// ```
/// use welter_predicates::intersection::box_contains;
/// assert!(box_contains([0.0; 3], [1.0; 3], [1.0, 0.0, 0.5]));
/// ```
pub fn box_contains(min: impl Point<3>, max: impl Point<3>, p: impl Point<3>) -> bool {
    point_in_box(p, min, max) != PointBox::Disjoint
}

/// As [`point_in_box`], checked; arguments are counted `p`, `min`, `max`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_point_in_box;
/// assert!(try_point_in_box([0.0; 3], [0.0; 3], [f64::INFINITY; 3]).is_err());
/// ```
pub fn try_point_in_box(
    p: impl Point<3>,
    min: impl Point<3>,
    max: impl Point<3>,
) -> Result<PointBox, NonFinite> {
    check_finite(&[p.coords(), min.coords(), max.coords()])?;
    Ok(point_in_box(p, min, max))
}

/// How the segment `s` meets the closed box from `min` to `max`.
///
/// ```
/// use welter_predicates::intersection::{BoxFeature, SegmentBox, SegmentFeature, Side, segment_box};
/// let (min, max) = ([0.0; 3], [2.0; 3]);
/// let SegmentBox::Overlap([enter, end]) = segment_box([[-1.0, 1.0, 1.0], [1.0; 3]], min, max) else { panic!() };
/// assert_eq!(enter.b, BoxFeature([Side::Min, Side::Between, Side::Between]));
/// assert_eq!((end.a, end.b.dimension()), (SegmentFeature::Vertex(1), 3));
/// let SegmentBox::Point(touch) = segment_box([[-1.0, 1.0, 0.0], [1.0, -1.0, 0.0]], min, max) else { panic!() };
/// assert_eq!((touch.a, touch.b.dimension()), (SegmentFeature::Interior, 0));
/// ```
pub fn segment_box(s: [impl Point<3>; 2], min: impl Point<3>, max: impl Point<3>) -> SegmentBox {
    case(s.map(Point::coords), min.coords(), max.coords())
}

/// True when the closed segment meets the closed box: [`segment_box`] is not `Disjoint`.
///
/// ```
/// use welter_predicates::intersection::segment_intersects_box;
/// assert!(segment_intersects_box([[-1.0, 0.5, 0.5], [2.0, 0.5, 0.5]], [0.0; 3], [1.0; 3]));
/// assert!(!segment_intersects_box([[-1.0, 0.5, 0.5], [0.5, 2.1, 0.5]], [0.0; 3], [1.0; 3]));
/// ```
pub fn segment_intersects_box(s: [impl Point<3>; 2], min: impl Point<3>, max: impl Point<3>) -> bool {
    Clip::new(s.map(Point::coords), min.coords(), max.coords()).is_some()
}

/// As [`segment_box`], checked; arguments are counted `s[0]`, `s[1]`, `min`, `max`.
///
/// # Errors
/// [`NonFinite`] for the first coordinate that is infinite or NaN.
///
/// ```
/// use welter_predicates::intersection::try_segment_box;
/// let error = try_segment_box([[0.0; 3], [f64::NAN; 3]], [0.0; 3], [1.0; 3]).unwrap_err();
/// assert_eq!(error.argument, 1);
/// ```
pub fn try_segment_box(
    s: [impl Point<3>; 2],
    min: impl Point<3>,
    max: impl Point<3>,
) -> Result<SegmentBox, NonFinite> {
    let (s, min, max) = (s.map(Point::coords), min.coords(), max.coords());
    check_finite(&[s[0], s[1], min, max])?;
    Ok(case(s, min, max))
}

pub(super) fn contains(p: &P3, min: &P3, max: &P3) -> bool {
    (0..3).all(|k| min[k] <= p[k] && p[k] <= max[k])
}

pub(super) fn is_flat(min: &P3, max: &P3) -> bool {
    (0..3).any(|k| min[k] == max[k])
}

/// The feature of a point of the box.
fn feature_of(p: &P3, min: &P3, max: &P3) -> BoxFeature {
    BoxFeature(core::array::from_fn(|k| {
        if p[k] == min[k] {
            Side::Min
        } else if p[k] == max[k] {
            Side::Max
        } else {
            Side::Between
        }
    }))
}

/// A point of the segment: an end, or where it crosses a plane `x[axis] = value`.
#[derive(Clone, Copy, Debug)]
enum At {
    Start,
    Plane(usize, f64),
    End,
}

/// The part of a segment within a box.
#[derive(Clone, Copy, Debug)]
struct Clip {
    s: [P3; 2],
    min: P3,
    max: P3,
    enter: At,
    leave: At,
}

impl Clip {
    /// `None` when that part is empty or a coordinate is not finite.
    fn new(s: [P3; 2], min: P3, max: P3) -> Option<Self> {
        if !all_finite(&[s[0], s[1], min, max]) {
            return None;
        }
        for k in 0..3 {
            let below = s[0][k] < min[k] && s[1][k] < min[k];
            let above = s[0][k] > max[k] && s[1][k] > max[k];
            if below || above || min[k] > max[k] {
                return None;
            }
        }
        let mut clip = Self { s, min, max, enter: At::Start, leave: At::End };
        for k in 0..3 {
            let (near, far) = if s[0][k] <= s[1][k] { (min[k], max[k]) } else { (max[k], min[k]) };
            // A plane cuts a piece off where the start, or the end, lies strictly outside it.
            let start_out = s[0][k] < min[k] || s[0][k] > max[k];
            let end_out = s[1][k] < min[k] || s[1][k] > max[k];
            if start_out && clip.order(clip.enter, At::Plane(k, near)) == Ordering::Less {
                clip.enter = At::Plane(k, near);
            }
            if end_out && clip.order(clip.leave, At::Plane(k, far)) == Ordering::Greater {
                clip.leave = At::Plane(k, far);
            }
        }
        (clip.order(clip.enter, clip.leave) != Ordering::Greater).then_some(clip)
    }

    /// The order along the segment; planes are crossed, not parallel.
    fn order(&self, one: At, two: At) -> Ordering {
        let [p, q] = &self.s;
        match (one, two) {
            (At::Start, At::Start) | (At::End, At::End) => Ordering::Equal,
            (At::Start, At::End) => {
                if p == q {
                    Ordering::Equal
                } else {
                    Ordering::Less
                }
            }
            (At::Plane(k, value), At::Plane(m, other)) if k != m => {
                let turn = orient2d([p[k], p[m]], [q[k], q[m]], [value, other]);
                let scale = Sign::of_difference(q[k], p[k]) * Sign::of_difference(q[m], p[m]);
                (-turn * scale).cmp(&Sign::Zero)
            }
            (At::Plane(k, value), _) => {
                let other = match two {
                    At::Start => p[k],
                    At::End => q[k],
                    At::Plane(_, other) => other,
                };
                let along = Sign::of_difference(q[k], p[k]);
                (Sign::of_difference(value, other) * along).cmp(&Sign::Zero)
            }
            (_, At::Plane(..)) | (At::End, At::Start) => self.order(two, one).reverse(),
        }
    }

    fn equal(&self, one: At, two: At) -> bool {
        self.order(one, two) == Ordering::Equal
    }

    fn contact(&self, at: At) -> Contact<SegmentFeature, BoxFeature> {
        let [p, q] = &self.s;
        let on_segment = if self.equal(at, At::Start) {
            SegmentFeature::Vertex(0)
        } else if self.equal(at, At::End) {
            SegmentFeature::Vertex(1)
        } else {
            SegmentFeature::Interior
        };
        let on_plane = |k: usize, value: f64| {
            if p[k] == q[k] { p[k] == value } else { self.equal(at, At::Plane(k, value)) }
        };
        let sides = core::array::from_fn(|k| {
            if on_plane(k, self.min[k]) {
                Side::Min
            } else if on_plane(k, self.max[k]) {
                Side::Max
            } else {
                Side::Between
            }
        });
        Contact::new(on_segment, BoxFeature(sides))
    }
}

pub(super) fn case(s: [P3; 2], min: P3, max: P3) -> SegmentBox {
    let Some(clip) = Clip::new(s, min, max) else { return SegmentBox::Disjoint };
    let (a, b) = (s[0] == s[1], is_flat(&min, &max));
    if a || b {
        return SegmentBox::Degenerate { a, b };
    }
    let enter = clip.contact(clip.enter);
    if clip.equal(clip.enter, clip.leave) {
        SegmentBox::Point(enter)
    } else {
        SegmentBox::Overlap([enter, clip.contact(clip.leave)])
    }
}
