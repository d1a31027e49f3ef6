//! A segment or a ray against a triangle in one plane: what every coplanar case comes down to.
//!
//! The common set of a line piece and a triangle is empty, a point or a segment, and its ends are exactly the
//! points where: the start or the end of the piece lies in the triangle; a vertex of the triangle lies in the
//! interior of the piece; or the interiors of an edge and of the piece cross. [`Carrier::clip`] collects these
//! and puts them in order along the piece.

use super::{P2, P3, SegmentFeature, TriangleFeature};
use crate::{Sign, orient2d};

/// `p` without coordinate `axis`; the others in the order that keeps orientation: the projection of a triangle
/// has the sign of that component of its normal.
#[inline]
pub(crate) fn project(p: P3, axis: usize) -> P2 {
    match axis {
        0 => [p[1], p[2]],
        1 => [p[2], p[0]],
        _ => [p[0], p[1]],
    }
}

/// An axis along which the triangle projects to a proper triangle, unless it is collinear.
pub(super) fn proper_axis(t: [P3; 3]) -> Option<usize> {
    (0..3).find(|&axis| {
        let [a, b, c] = t.map(|p| project(p, axis));
        !orient2d(a, b, c).is_zero()
    })
}

/// On which feature of the proper triangle `t` the point lies; `None` outside.
pub(super) fn locate(p: P2, t: [P2; 3]) -> Option<TriangleFeature> {
    let inside = orient2d(t[0], t[1], t[2]);
    let mut on = [false; 3];
    for i in 0..3 {
        let side = orient2d(t[i], t[(i + 1) % 3], p);
        if side == -inside {
            return None;
        }
        on[i] = side.is_zero();
    }
    Some(TriangleFeature::on_edges(on))
}

/// As [`locate`], for a point in the plane of a proper triangle of space.
pub(super) fn locate_in_plane(p: P3, t: [P3; 3]) -> Option<TriangleFeature> {
    let axis = proper_axis(t)?;
    locate(project(p, axis), t.map(|q| project(q, axis)))
}

/// Where a ray of the plane goes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Heading<const N: usize> {
    /// Through this point.
    Through([f64; N]),
    /// Along this vector.
    Vector([f64; N]),
}

/// A segment or a ray of the plane, proper.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carrier {
    start: P2,
    heading: Heading<2>,
    end: Option<P2>,
}

impl Carrier {
    pub(super) fn segment([p, q]: [P2; 2]) -> Self {
        Self { start: p, heading: Heading::Through(q), end: Some(q) }
    }

    pub(super) fn ray(start: P2, heading: Heading<2>) -> Self {
        Self { start, heading, end: None }
    }

    /// The side of the directed line on which `t` lies: positive on the left.
    pub(super) fn side(&self, t: P2) -> Sign {
        match self.heading {
            Heading::Through(q) => orient2d(self.start, q, t),
            Heading::Vector(d) => super::direction::side_of_direction(self.start, d, t),
        }
    }

    /// True when the first of two points of the line comes before the second.
    fn before(&self, s: P2, t: P2) -> bool {
        let forward = match self.heading {
            Heading::Through(q) => q > self.start,
            Heading::Vector(d) => d > [0.0; 2],
        };
        if forward { s < t } else { s > t }
    }

    /// True when this ray meets the segment from `p` to `q`, which is not collinear with it.
    pub(super) fn ray_meets_segment(&self, [p, q]: [P2; 2]) -> bool {
        let sides = [self.side(p), self.side(q)];
        match sides {
            [Sign::Zero, _] => !self.before(p, self.start),
            [_, Sign::Zero] => !self.before(q, self.start),
            [a, b] if a == b => false,
            [a, _] => orient2d(p, q, self.start) != a,
        }
    }

    /// The ends of the common set with the proper triangle `t`, in order along the carrier. For a ray,
    /// `Vertex(0)` is its origin.
    pub(super) fn clip(&self, t: [P2; 3]) -> Ends {
        let mut first: Option<TriangleFeature> = None;
        let mut middle = [None; 2];
        let mut count = 0;
        let mut last: Option<TriangleFeature> = None;
        let sides = t.map(|p| self.side(p));
        if sides == [Sign::Positive; 3] || sides == [Sign::Negative; 3] {
            return Ends::default();
        }
        if let Some(at) = locate(self.start, t) {
            first = Some(at);
        }
        if let Some(at) = self.end.and_then(|end| locate(end, t)) {
            last = Some(at);
        }
        let inside = orient2d(t[0], t[1], t[2]);
        let mut leaves = [false; 2];
        for i in 0..3 {
            let j = (i + 1) % 3;
            let found = if sides[i].is_zero() && self.holds_inside(t[i]) {
                Some((TriangleFeature::Vertex(i as u8), false))
            } else if sides[i] * sides[j] == Sign::Negative {
                let from = orient2d(t[i], t[j], self.start);
                let crosses =
                    from == -sides[i] && self.end.is_none_or(|end| orient2d(t[i], t[j], end) == sides[i]);
                crosses.then_some((TriangleFeature::Edge(i as u8), from == inside))
            } else {
                None
            };
            if let Some((at, leaving)) = found {
                middle[count] = Some(at);
                leaves[count] = leaving;
                count += 1;
            }
        }
        if let [Some(one), Some(two)] = middle {
            let in_order = match (one, two) {
                (TriangleFeature::Vertex(i), TriangleFeature::Vertex(j)) => {
                    self.before(t[usize::from(i)], t[usize::from(j)])
                }
                (TriangleFeature::Edge(_), _) => !leaves[0],
                _ => leaves[1],
            };
            if !in_order {
                middle.swap(0, 1);
            }
        }
        let mut ends = Ends::default();
        let inner = middle.map(|at| at.map(|at| (SegmentFeature::Interior, at)));
        let start = first.map(|at| (SegmentFeature::Vertex(0), at));
        let end = last.map(|at| (SegmentFeature::Vertex(1), at));
        for end in [start, inner[0], inner[1], end].into_iter().flatten() {
            ends.push(end);
        }
        ends
    }

    /// True when `p`, a point of the line, lies strictly after the start and strictly before the end.
    fn holds_inside(&self, p: P2) -> bool {
        self.before(self.start, p) && self.end.is_none_or(|end| self.before(p, end))
    }
}

/// None, one or two ends of a common set.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ends {
    ends: [Option<(SegmentFeature, TriangleFeature)>; 2],
}

impl Ends {
    fn push(&mut self, end: (SegmentFeature, TriangleFeature)) {
        let free = usize::from(self.ends[0].is_some());
        debug_assert!(self.ends[free].is_none(), "a line piece and a convex set share at most two ends");
        self.ends[free] = Some(end);
    }

    pub(super) fn len(&self) -> usize {
        self.ends.iter().flatten().count()
    }

    pub(super) fn get(&self) -> [Option<(SegmentFeature, TriangleFeature)>; 2] {
        self.ends
    }
}
