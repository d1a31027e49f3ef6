//! Whether the space between two facing sheets may be filled: walls come in place of the sheets.
//!
//! # The question
//! Sheets, turned over, and walls are together a closed oriented surface. The sheets face its inside, so if nothing of
//! the rest of the surface is in there, and it is not inside out, then replacing the sheets by the walls takes what was
//! outside of the surface to the inside, and nothing else.
//!
//! # What it promises
//! A filling is admitted only if
//! * no wall meets a sheet, another wall, or a triangle that stays, in more than what they share (exactly);
//! * no vertex of a triangle that stays lies between (exactly, in a space that covers it), and no triangle all of whose
//!   corners are those of sheets and walls;
//! * every part of the closed surface that hangs together by edges encloses more volume than rounding can feign. Walls
//!   that are put together the wrong way round would make a solid within a solid.

use super::parting::side;
use super::shape::{six_volumes, six_volumes_size};
use super::workpiece::Workpiece;
use glam::DVec3;
use std::f64::consts::PI;
use welter_meshing::spatial::{Box3, meet_in_more};
use welter_meshing::surface::{TriId, VertexId};
use welter_predicates::Sign;
use welter_predicates::intersection::tetrahedron_contains;

/// Roundings of six products of three lengths, and of the sums of a dozen of those, over the sum of their magnitudes; generously.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

impl Workpiece<'_> {
    /// See the module. `gone` are all triangles that go, `sheets` those that face the space between; `come` those that come,
    /// `walls` all walls.
    pub(crate) fn may_fill(
        &self,
        gone: &[TriId],
        sheets: &[TriId],
        come: &[[VertexId; 3]],
        walls: &[[VertexId; 3]],
    ) -> bool {
        let at = |v: VertexId| self.at(v);
        let turned = sheets.iter().map(|&t| {
            let [a, b, c] = self.surface.connectivity().corners(t);
            [a, c, b]
        });
        let mut closed: Vec<[VertexId; 3]> = walls.to_vec();
        closed.extend(turned);
        for (i, &s) in closed.iter().enumerate() {
            // Sheets do not meet each other.
            let pairs = closed[..i.min(walls.len())].iter().filter(|t| sorted(**t) != sorted(s));
            if pairs.into_iter().any(|&t| meet_in_more(at, s, t)) {
                return false;
            }
        }
        if !self.encloses_volume(closed.clone()) {
            return false;
        }
        let bounds: Vec<[DVec3; 3]> = closed.iter().map(|t| t.map(at)).collect();
        // Covered by the tetrahedra from one corner.
        let tip = bounds[0][0];
        let around = bounds.iter().flatten().fold(Box3::EMPTY, |all, &p| all.union(&Box3::of([p])));
        let is_corner = |v: VertexId| closed.iter().flatten().any(|&w| w == v);
        let between = |v: VertexId| {
            let p = at(v);
            around.contains(p)
                && !is_corner(v)
                && bounds.iter().any(|&[a, b, c]| tetrahedron_contains([a, b, c, tip], p))
        };
        let boxes: Vec<Box3> = come.iter().map(|t| Box3::of(t.map(at))).collect();
        self.all_triangles_near(&around, |t, own| {
            if gone.contains(&t) {
                return true;
            }
            let corners = self.surface.connectivity().corners(t);
            let meets = |(b, &new): (&Box3, &[VertexId; 3])| own.meets(b) && meet_in_more(at, corners, new);
            let partition = || corners.iter().all(|&v| is_corner(v)) && is_around(&bounds, corners.map(at));
            !(boxes.iter().zip(come).any(meets) || corners.iter().any(|&v| between(v)) || partition())
        })
    }

    /// Whether every part of a closed surface that hangs together by edges has its normals outside.
    fn encloses_volume(&self, mut closed: Vec<[VertexId; 3]>) -> bool {
        // Triangles on both sides of nothing.
        let mut i = 0;
        while i < closed.len() {
            match closed[i + 1..].iter().position(|&t| sorted(t) == sorted(closed[i])) {
                Some(k) => {
                    let other = closed.swap_remove(i + 1 + k);
                    let one = closed.swap_remove(i);
                    if is_turn(one, other) {
                        return false;
                    }
                }
                None => i += 1,
            }
        }
        while let Some(first) = closed.pop() {
            let mut part = vec![first];
            let mut next = 0;
            while let Some(&t) = part.get(next) {
                next += 1;
                let mut k = 0;
                while k < closed.len() {
                    let shared = closed[k].iter().filter(|v| t.contains(v)).count();
                    if shared >= 2 {
                        part.push(closed.swap_remove(k));
                    } else {
                        k += 1;
                    }
                }
            }
            let tip = self.at(first[0]);
            // Of lengths over the reference, so that nothing underflows.
            let scaled = |v: VertexId| (self.at(v) - tip) / self.length;
            let part: Vec<[DVec3; 3]> = part.iter().map(|t| t.map(scaled)).collect();
            let volume = six_volumes(&part, DVec3::ZERO);
            if volume.is_nan() || volume <= ROUNDINGS * six_volumes_size(&part) {
                return false;
            }
        }
        true
    }
}

fn sorted(mut triangle: [VertexId; 3]) -> [VertexId; 3] {
    triangle.sort_unstable();
    triangle
}

/// Whether two triangles of the same corners have the same orientation.
fn is_turn([a, b, c]: [VertexId; 3], other: [VertexId; 3]) -> bool {
    [[a, b, c], [b, c, a], [c, a, b]].contains(&other)
}

/// Where in a triangle it is looked; where edges are split in the middle, other edges come to lie over its centroid.
const INNER: [f64; 3] = [0.47, 0.31, 0.22];

/// Whether a closed surface winds around a triangle that does not cross it, by solid angles \[Oosterom83\] around an inner point. On which
/// side of a plane that lies is taken from the corners, exactly, where they all lie on one: it may be nearer to the surface than
/// rounding tells. What is in doubt counts as within.
fn is_around(closed: &[[DVec3; 3]], triangle: [DVec3; 3]) -> bool {
    let inner = triangle.iter().zip(INNER).fold(DVec3::ZERO, |sum, (&p, weight)| sum + weight * p);
    let half_angle = |&plane: &[DVec3; 3]| {
        let [a, b, c] = plane.map(|p| (p - inner).normalize_or_zero());
        let sides = triangle.map(|p| side(plane, p));
        let (before, behind) = (sides.contains(&Sign::Positive), sides.contains(&Sign::Negative));
        let numerator = a.dot(b.cross(c));
        let numerator = match (before, behind) {
            // In the plane it is beside the triangle.
            (false, false) => return 0.0,
            (true, false) => -numerator.abs(),
            (false, true) => numerator.abs(),
            (true, true) => numerator,
        };
        libm::atan2(numerator, 1.0 + a.dot(b) + b.dot(c) + c.dot(a))
    };
    let turns = closed.iter().map(half_angle).sum::<f64>() / (2.0 * PI);
    // A closed surface winds a whole number of times.
    turns.abs() > 0.25
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron one edge of which is split in the middle, as nearly as numbers are. The triangle that had the whole edge then lies a
    /// rounding within or outside.
    #[test]
    fn triangles_a_rounding_from_a_wall_are_told_to_be_within_or_outside() {
        let mut state = 1_u64;
        let mut coordinate = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut point = || DVec3::new(coordinate(), coordinate(), coordinate());
        let mut counts = [0, 0];
        for _ in 0..1000 {
            let [mut a, mut b, d, e] = std::array::from_fn(|_| point());
            if side([a, b, d], e) == Sign::Positive {
                std::mem::swap(&mut a, &mut b);
            }
            let m = 0.5 * (a + b);
            let closed = [[a, m, d], [m, b, d], [b, m, e], [m, a, e], [d, b, e], [a, d, e]];
            let within = match side([a, b, d], m) {
                Sign::Positive => true,
                Sign::Negative => false,
                Sign::Zero => continue,
            };
            counts[usize::from(within)] += 1;
            assert_eq!(is_around(&closed, [a, b, d]), within, "{closed:?}");
        }
        assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
    }
}
