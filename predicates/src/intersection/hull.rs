//! Convex hulls of at most three points: what a segment or a triangle is when it degenerates.
//!
//! Collinear points are met in lexicographic order of their coordinates, which along any line is monotone; the
//! hull of three collinear points is therefore the segment from the least to the greatest.

use super::planar::{self, proper_axis};
use super::segment_segment::{proper_2d, proper_3d};
use super::segment_triangle::proper_segment_triangle;
use super::triangle_triangle::proper_triangles;
use super::{P2, P3, SegmentSegment, SegmentTriangle, TriangleTriangle};
use crate::{orient2d, orient3d};

/// True when every coordinate is finite: what the unchecked entry points ask first.
#[inline]
pub(crate) fn all_finite<const N: usize>(points: &[[f64; N]]) -> bool {
    // Without a branch for each coordinate.
    points.as_flattened().iter().fold(true, |finite, x| finite & (x.abs() <= f64::MAX))
}

/// True when the bounding boxes of two sets of points are disjoint.
#[inline]
pub(super) fn boxes_disjoint<const N: usize>(a: &[[f64; N]], b: &[[f64; N]]) -> bool {
    let mut apart = false;
    for k in 0..N {
        let (mut a_min, mut a_max) = (a[0][k], a[0][k]);
        for p in &a[1..] {
            a_min = if p[k] < a_min { p[k] } else { a_min };
            a_max = if p[k] > a_max { p[k] } else { a_max };
        }
        let (mut b_min, mut b_max) = (b[0][k], b[0][k]);
        for p in &b[1..] {
            b_min = if p[k] < b_min { p[k] } else { b_min };
            b_max = if p[k] > b_max { p[k] } else { b_max };
        }
        apart |= a_max < b_min || b_max < a_min;
    }
    apart
}

/// True when `p` lies on the closed segment from `a` to `b`, given that the three are collinear.
pub(super) fn between<const N: usize>(p: [f64; N], a: [f64; N], b: [f64; N]) -> bool {
    if a <= b { a <= p && p <= b } else { b <= p && p <= a }
}

/// A point, a proper segment or a proper triangle of the plane.
#[derive(Clone, Copy, Debug)]
pub(super) enum Hull2 {
    Point(P2),
    Segment([P2; 2]),
    Triangle([P2; 3]),
}

impl Hull2 {
    pub(super) fn of_segment([p, q]: [P2; 2]) -> Self {
        if p == q { Self::Point(p) } else { Self::Segment([p, q]) }
    }

    pub(super) fn of_triangle(t: [P2; 3]) -> Self {
        if orient2d(t[0], t[1], t[2]).is_zero() { Self::of_segment(extremes(t)) } else { Self::Triangle(t) }
    }

    pub(super) fn is_segment(&self) -> bool {
        matches!(self, Self::Segment(_))
    }

    pub(super) fn contains(&self, p: P2) -> bool {
        match *self {
            Self::Point(q) => p == q,
            Self::Segment([a, b]) => orient2d(a, b, p).is_zero() && between(p, a, b),
            Self::Triangle(t) => planar::locate(p, t).is_some(),
        }
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        match (*self, *other) {
            (Self::Point(p), hull) | (hull, Self::Point(p)) => hull.contains(p),
            (Self::Segment(a), Self::Segment(b)) => proper_2d(a, b) != SegmentSegment::Disjoint,
            (Self::Segment(s), Self::Triangle(t)) | (Self::Triangle(t), Self::Segment(s)) => {
                planar::Carrier::segment(s).clip(t).len() > 0
            }
            (Self::Triangle(a), Self::Triangle(b)) => {
                (0..3).any(|i| planar::Carrier::segment([a[i], a[(i + 1) % 3]]).clip(b).len() > 0)
                    || planar::locate(b[0], a).is_some()
            }
        }
    }
}

/// A point, a proper segment or a proper triangle of space.
#[derive(Clone, Copy, Debug)]
pub(super) enum Hull3 {
    Point(P3),
    Segment([P3; 2]),
    Triangle([P3; 3]),
}

impl Hull3 {
    pub(super) fn of_segment([p, q]: [P3; 2]) -> Self {
        if p == q { Self::Point(p) } else { Self::Segment([p, q]) }
    }

    pub(super) fn of_triangle(t: [P3; 3]) -> Self {
        if proper_axis(t).is_some() { Self::Triangle(t) } else { Self::of_segment(extremes(t)) }
    }

    pub(super) fn is_segment(&self) -> bool {
        matches!(self, Self::Segment(_))
    }

    pub(super) fn is_triangle(&self) -> bool {
        matches!(self, Self::Triangle(_))
    }

    pub(super) fn contains(&self, p: P3) -> bool {
        match *self {
            Self::Point(q) => p == q,
            Self::Segment([a, b]) => proper_axis([a, b, p]).is_none() && between(p, a, b),
            Self::Triangle(t) => {
                orient3d(t[0], t[1], t[2], p).is_zero() && planar::locate_in_plane(p, t).is_some()
            }
        }
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        match (*self, *other) {
            (Self::Point(p), hull) | (hull, Self::Point(p)) => hull.contains(p),
            (Self::Segment(a), Self::Segment(b)) => proper_3d(a, b) != SegmentSegment::Disjoint,
            (Self::Segment(s), Self::Triangle(t)) | (Self::Triangle(t), Self::Segment(s)) => {
                proper_segment_triangle(s, t) != SegmentTriangle::Disjoint
            }
            (Self::Triangle(a), Self::Triangle(b)) => proper_triangles(a, b) != TriangleTriangle::Disjoint,
        }
    }
}

/// The least and the greatest of three points in lexicographic order.
fn extremes<const N: usize>([a, b, c]: [[f64; N]; 3]) -> [[f64; N]; 2] {
    let (low, high) = if a <= b { (a, b) } else { (b, a) };
    [if c < low { c } else { low }, if c > high { c } else { high }]
}
