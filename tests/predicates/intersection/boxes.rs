//! Point, segment and triangle against a closed box, by clipping.

use super::{Face, dimension, on_every_kind};
use proptest::prelude::*;
use rug::Integer;
use welter_kit::exact::{clip_to_box, lift, linear};
use welter_predicates::intersection::{
    BoxFeature, PointBox, SegmentBox, Side, TriangleBox, box_contains, point_in_box, segment_box,
    segment_intersects_box, triangle_box, triangle_intersects_box,
};

type P3 = [f64; 3];

/// A set of points in a box, as the smallest faces of the operand and of the box that hold it.
struct Clipped {
    /// The distinct corners or ends that the clipping left.
    points: Vec<Vec<Integer>>,
    operand: Vec<[Integer; 3]>,
    bounds: Vec<[Integer; 3]>,
}

impl Clipped {
    fn new(operand: &[P3], min: P3, max: P3) -> Self {
        let mut points = clip_to_box(operand, min, max);
        points.sort();
        points.dedup();
        let mut operand = lift(&[operand, &[min, max]].concat());
        let bounds = operand.split_off(operand.len() - 2);
        Self { points, operand, bounds }
    }

    /// The smallest feature of the box that holds these points.
    fn feature(&self, points: &[Vec<Integer>]) -> BoxFeature {
        BoxFeature(std::array::from_fn(|axis| {
            let all_at = |bound: usize| {
                points.iter().all(|p| p[axis] == Integer::from(&self.bounds[bound][axis] * &p[3]))
            };
            match (all_at(0), all_at(1)) {
                (true, _) => Side::Min,
                (_, true) => Side::Max,
                _ => Side::Between,
            }
        }))
    }

    /// The smallest face of the operand, a simplex, that holds these points.
    fn face(&self, points: &[Vec<Integer>]) -> u32 {
        let columns: Vec<Vec<Integer>> =
            self.operand.iter().map(|p| p.iter().cloned().chain([Integer::from(1)]).collect()).collect();
        let columns: Vec<&[Integer]> = columns.iter().map(Vec::as_slice).collect();
        let mut face = 0;
        for point in points {
            let (weights, _) = linear::solve(&columns, point).expect("the operand is a proper simplex");
            for (i, weight) in weights.iter().enumerate() {
                face |= u32::from(!weight.is_zero()) << i;
            }
        }
        face
    }
}

/// A box from two opposite corners.
fn sorted(p: P3, q: P3) -> (P3, P3) {
    ([0, 1, 2].map(|i| p[i].min(q[i])), [0, 1, 2].map(|i| p[i].max(q[i])))
}

fn is_flat(min: P3, max: P3) -> bool {
    (0..3).any(|i| min[i] == max[i])
}

#[test]
fn point_and_box() {
    on_every_kind::<3, 3>(1500, &["disjoint", "degenerate", "0", "1", "2", "3"], |[p, q, r]| {
        let (min, max) = sorted(q, r);
        let inside = (0..3).all(|i| min[i] <= p[i] && p[i] <= max[i]);
        let answer = point_in_box(p, min, max);
        prop_assert_eq!(box_contains(min, max, p), inside);
        let expected = match (inside, is_flat(min, max)) {
            (false, _) => PointBox::Disjoint,
            (true, true) => PointBox::Degenerate,
            _ => PointBox::On(BoxFeature([0, 1, 2].map(|i| {
                if p[i] == min[i] {
                    Side::Min
                } else if p[i] == max[i] {
                    Side::Max
                } else {
                    Side::Between
                }
            }))),
        };
        prop_assert_eq!(answer, expected);
        Ok(match answer {
            PointBox::Disjoint => "disjoint",
            PointBox::Degenerate => "degenerate",
            PointBox::On(feature) => ["0", "1", "2", "3"][feature.dimension()],
        })
    });
}

#[test]
fn segment_and_box() {
    on_every_kind::<3, 4>(2000, &["disjoint", "degenerate", "point", "overlap"], |[s0, s1, q, r]| {
        let (s, (min, max)) = ([s0, s1], sorted(q, r));
        let clipped = Clipped::new(&s, min, max);
        let points = &clipped.points;
        prop_assert_eq!(segment_intersects_box(s, min, max), !points.is_empty());
        let faces = |p: &Vec<Integer>| {
            let one = std::slice::from_ref(p);
            (clipped.face(one), clipped.feature(one))
        };
        let proper = dimension(&s) == 1 && !is_flat(min, max);
        Ok(match segment_box(s, min, max) {
            SegmentBox::Disjoint => {
                prop_assert!(points.is_empty());
                "disjoint"
            }
            SegmentBox::Degenerate { a, b } => {
                prop_assert!(!points.is_empty() && !proper);
                prop_assert_eq!((a, b), (dimension(&s) == 0, is_flat(min, max)));
                "degenerate"
            }
            SegmentBox::Point(contact) => {
                prop_assert!(proper && points.len() == 1, "{points:?}");
                prop_assert_eq!((contact.a.bits(), contact.b), faces(&points[0]));
                "point"
            }
            SegmentBox::Overlap(ends) => {
                prop_assert!(proper && points.len() == 2, "{points:?}");
                // In the direction of the segment.
                let along = |p: &Vec<Integer>| {
                    let s = &clipped.operand;
                    (0..3).map(|i| Integer::from(&s[1][i] - &s[0][i]) * &p[i]).sum::<Integer>()
                };
                let forwards = along(&points[0]) * &points[1][3] < along(&points[1]) * &points[0][3];
                let order = if forwards { [0, 1] } else { [1, 0] };
                for (end, i) in ends.iter().zip(order) {
                    prop_assert_eq!((end.a.bits(), end.b), faces(&points[i]));
                }
                prop_assert_eq!(ends[0].b.join(ends[1].b), clipped.feature(points));
                "overlap"
            }
        })
    });
}

#[test]
fn triangle_and_box() {
    let wanted = ["disjoint", "degenerate", "touching", "crossing", "inside"];
    on_every_kind::<3, 5>(2000, &wanted, |[t0, t1, t2, q, r]| {
        let (t, (min, max)) = ([t0, t1, t2], sorted(q, r));
        let clipped = Clipped::new(&t, min, max);
        let points = &clipped.points;
        prop_assert_eq!(triangle_intersects_box(t, min, max), !points.is_empty());
        let proper = dimension(&t) == 2 && !is_flat(min, max);
        let answer = triangle_box(t, min, max);
        if points.is_empty() {
            prop_assert_eq!(answer, TriangleBox::Disjoint);
            return Ok("disjoint");
        }
        let within = t.iter().all(|p| (0..3).all(|i| min[i] <= p[i] && p[i] <= max[i]));
        let feature = clipped.feature(points);
        Ok(match answer {
            TriangleBox::Disjoint => {
                prop_assert!(false, "they meet at {points:?}");
                "disjoint"
            }
            TriangleBox::Degenerate { a, b } => {
                prop_assert_eq!((a, b), (dimension(&t) < 2, is_flat(min, max)));
                prop_assert!(!proper);
                "degenerate"
            }
            TriangleBox::Touching(contact) => {
                prop_assert!(proper);
                prop_assert_eq!((contact.a.bits(), contact.b), (clipped.face(points), feature));
                prop_assert!(feature.dimension() < 3);
                "touching"
            }
            TriangleBox::Crossing => {
                prop_assert_eq!((proper, within, feature.dimension()), (true, false, 3));
                "crossing"
            }
            TriangleBox::Inside => {
                prop_assert_eq!((proper, within, feature.dimension()), (true, true, 3));
                "inside"
            }
        })
    });
}

#[test]
fn an_empty_box_is_disjoint_from_everything() {
    let (min, max) = ([0.0, 0.0, 1.0], [1.0, 1.0, -1.0]);
    assert_eq!(point_in_box([0.5, 0.5, 0.0], min, max), PointBox::Disjoint);
    assert_eq!(segment_box([[0.5, 0.5, -2.0], [0.5, 0.5, 2.0]], min, max), SegmentBox::Disjoint);
    let t = [[0.0, 0.0, -2.0], [1.0, 1.0, 2.0], [0.0, 1.0, 2.0]];
    assert_eq!(triangle_box(t, min, max), TriangleBox::Disjoint);
    assert!(!triangle_intersects_box(t, min, max));
}
