//! The point of a mesh that is closest to a given point: [`Bvh::closest_point`].
//!
//! # What it promises
//! * The least of the distances to all triangles, each computed by itself, with ties going to the lowest triangle: the hierarchy
//!   leaves out only triangles whose computed distance must be greater. So the answer is that of trying all triangles, bit for bit.
//! * The point is a rounded convex combination of the triangle's corners, inside of the triangle's box.
//! * With `R` the largest distance from the query to a point of the mesh's box, `h` the longest edge of a triangle and `a` the sine of
//!   the angle at its first corner (the edges there scaled to equal length), its computed distance errs by at most `2^-48 R`
//!   plus the smaller of `a h` and `2^-48 h / a^2`, hence never by more than 2^-15 of `h`.
//!
//! # What it does not promise
//! The feature is that of the computed point: near the border of two features it may be the neighbouring one.
//!
//! # Method
//! Everything is computed relative to the query and scaled by a power of two so that the scene has size one (`Local`). A
//! triangle's candidates are the closest point of each edge and the foot of the perpendicular, from the 2 by 2
//! normal equations of the edges at the first corner, if it lies inside \[Ericson05\]; the closest of the candidates wins. A degenerate
//! triangle has no foot. Norms are scaled by their largest component, so that small distances do not underflow.
//!
//! # Complexity
//! O(log n) in practice, O(n) at worst (the centre of a sphere).

use glam::DVec3;
use welter_predicates::intersection::TriangleFeature;

use super::frame::{Frame, Local};
use super::{Box3, Bvh};
use crate::surface::TriId;

/// The closest point of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPoint {
    /// Where it is.
    pub point: DVec3,
    /// Its distance, in the unit of the coordinates; infinite if it is larger than the largest number.
    pub distance: f64,
    /// The triangle on which it lies, the lowest of those at the same distance.
    pub triangle: TriId,
    /// On which vertex or edge of that triangle, or in its interior.
    pub feature: TriangleFeature,
}

impl Bvh<'_> {
    /// The closest point of the mesh to `query`; `None` for a mesh without triangles or a query that is not finite.
    ///
    /// ```
    /// use welter_meshing::{DVec3, shapes::{Box_, box_}, spatial::Bvh};
    /// let mesh = box_(&Box_::default())?; // [-1, 1]^3
    /// let closest = Bvh::new(&mesh).closest_point(DVec3::new(3.0, 0.3, 0.2)).expect("has triangles");
    /// assert!(closest.point.abs_diff_eq(DVec3::new(1.0, 0.3, 0.2), 1e-15));
    /// assert_eq!(closest.distance, 2.0);
    /// # Ok::<(), welter_meshing::shapes::ShapeError>(())
    /// ```
    #[must_use]
    pub fn closest_point(&self, query: DVec3) -> Option<ClosestPoint> {
        if !query.is_finite() {
            return None;
        }
        let frame = &self.tree().frame;
        let local = frame.about(query);
        let search = Bounds::new(frame, query);
        let mut best: Option<(f64, TriId, Candidate)> = None;
        let mut limit = f64::INFINITY;
        let nodes = &self.tree().bvh.nodes;
        let mut stack: Vec<(f64, u32)> = Vec::with_capacity(64);
        if !nodes.is_empty() {
            stack.push((0.0, 0));
        }
        while let Some((bound, index)) = stack.pop() {
            if bound > limit {
                continue;
            }
            let node = &nodes[index as usize];
            if !node.is_leaf() {
                let children = [node.first_index, node.first_index + 1];
                let [a, b] = children.map(|c| (search.lower_bound(nodes[c as usize].aabb()), c));
                let (near, far) = if b.0 < a.0 { (b, a) } else { (a, b) };
                stack.extend([far, near]);
                continue;
            }
            let triangle = TriId(self.tree().box_index(node));
            let candidate = closest_on_triangle(self.mesh().corners(triangle).map(|p| local.place(p)));
            let closer = best.as_ref().is_none_or(|&(distance, other, _)| {
                candidate.distance < distance || (candidate.distance == distance && triangle < other)
            });
            if closer {
                limit = search.limit(&local, candidate.distance);
                best = Some((candidate.distance, triangle, candidate));
            }
        }
        best.map(|(distance, triangle, candidate)| {
            let corners = self.mesh().corners(triangle);
            let around = Box3::of(corners);
            let point = match candidate.feature {
                TriangleFeature::Vertex(k) => corners[usize::from(k)],
                _ => local.point_at(candidate.place).clamp(around.min, around.max),
            };
            ClosestPoint { point, distance: local.length(distance), triangle, feature: candidate.feature }
        })
    }
}

/// Lower bounds of the distance from a query to the boxes of nodes, in the unit of the frame.
struct Bounds {
    query: DVec3,
    slack: f64,
}

impl Bounds {
    fn new(frame: &Frame, query: DVec3) -> Self {
        let query = frame.place(query);
        // The node's box, the query's place and the computed distances, each with a factor of four or more to spare.
        let slack = 8.0 * Frame::ERROR + query.abs().max_element() / (1u64 << 44) as f64;
        Self { query, slack }
    }

    /// The distance to a box, up to a part of the slack. NaN, which no limit excludes, where the query is too far to tell.
    fn lower_bound(&self, b: &obvhs::aabb::Aabb) -> f64 {
        let (min, max) = (b.min.as_dvec3(), b.max.as_dvec3());
        norm((min - self.query).max(self.query - max).max(DVec3::ZERO))
    }

    /// Nodes with a greater lower bound hold no triangle at the computed distance or less.
    fn limit(&self, local: &Local, distance: f64) -> f64 {
        const ROUNDING: f64 = 1.0 / (1u64 << 40) as f64;
        local.length_in_frame(distance) * (1.0 + ROUNDING) + self.slack
    }
}

/// A point of a triangle relative to the query.
#[derive(Clone, Copy)]
struct Candidate {
    distance: f64,
    place: DVec3,
    feature: TriangleFeature,
}

impl Candidate {
    fn new(place: DVec3, feature: TriangleFeature) -> Self {
        Self { distance: norm(place), place, feature }
    }
}

/// The computed distance of the origin to a triangle placed relative to the query: that which [`Bvh::closest_point`] compares,
/// bit for bit. Candidates that are clearly farther than another are not computed.
pub(crate) fn triangle_distance(t: [DVec3; 3]) -> f64 {
    let sides = clear_sides(t);
    if sides == [Some(true); 3] {
        return foot(t).unwrap_or_else(|| closest_on_triangle(t)).distance;
    }
    // The likeliest edge first.
    let first = sides.iter().position(|&side| side == Some(false)).unwrap_or(0);
    let mut least = closest_on_edge(t, first as u8).distance;
    for k in [(first + 1) % 3, (first + 2) % 3] {
        if !line_is_farther(t[k], t[(k + 1) % 3], least) {
            least = least.min(closest_on_edge(t, k as u8).distance);
        }
    }
    if sides.contains(&Some(false)) { least } else { foot(t).map_or(least, |foot| foot.distance.min(least)) }
}

/// Products of squares below this may have lost digits to underflow.
const SMALL: f64 = f64::MIN_POSITIVE * (1u64 << 60) as f64;

/// Whether the line through two points is farther from the origin than a distance by a part of 2^-21 at least, which is far above
/// roundings.
fn line_is_farther(a: DVec3, b: DVec3, distance: f64) -> bool {
    const CLEAR: f64 = 1.0 + 1.0 / (1 << 20) as f64;
    let along = b - a;
    let limit = distance * distance * along.length_squared() * CLEAR;
    // The cross product errs by 2^-51 of the first of these.
    let rounding = a.length_squared() * along.length_squared() / (1u64 << 50) as f64;
    limit > SMALL && a.cross(along).length_squared() > limit + rounding
}

/// For each edge whether the foot of the perpendicular from the origin is clearly on its inner side, or clearly not; `None` where it is
/// close or cannot be told, as for slivers.
///
/// Clearly means by a part `m` of 2^-13 of the largest distance `r` to a corner. If that holds inside of all edges, they are farther than
/// the foot by `(m r)^2 / 2 r` at least, 2^-27 r; the foot's distance errs by less than 2^-33 r, since the triangle
/// is no sliver. If it holds outside of an edge the computed foot is not inside.
fn clear_sides([a, b, c]: [DVec3; 3]) -> [Option<bool>; 3] {
    /// Square of the sine of the angle at the first corner.
    const SLIVER: f64 = 1.0 / (1 << 14) as f64;
    const CLEAR: f64 = 1.0 / (1 << 26) as f64;
    let (u, v) = (b - a, c - a);
    let normal = u.cross(v);
    let square = normal.length_squared();
    let far = a.length_squared().max(b.length_squared()).max(c.length_squared());
    let stout = square > SLIVER * u.length_squared() * v.length_squared();
    [(a, u), (b, c - b), (c, a - c)].map(|(start, along)| {
        let unit = square * along.length_squared() * far;
        let inward = along.cross(-start).dot(normal);
        let clear = stout && unit > SMALL && inward * inward > CLEAR * unit;
        clear.then_some(inward > 0.0)
    })
}

/// The point of a triangle, relative to the query, that is closest to the origin.
fn closest_on_triangle(t: [DVec3; 3]) -> Candidate {
    let edges = [0, 1, 2].map(|k| closest_on_edge(t, k));
    let best = edges.into_iter().fold(edges[0], |a, b| if b.distance < a.distance { b } else { a });
    match foot(t) {
        Some(foot) if foot.distance < best.distance => foot,
        _ => best,
    }
}

/// The closest point of edge `k`; bit for bit the same for the other triangle at the edge, which is a tie then.
fn closest_on_edge(t: [DVec3; 3], k: u8) -> Candidate {
    let next = (k + 1) % 3;
    let mut ends = [(t[usize::from(k)], k), (t[usize::from(next)], next)];
    if ends[1].0.to_array() < ends[0].0.to_array() {
        ends.swap(0, 1);
    }
    let [(a, at_a), (b, at_b)] = ends;
    let along = b - a;
    let length = along.abs().max_element();
    let unit = along / length;
    let parameter = -a.dot(unit) / unit.length_squared() / length;
    if parameter >= 1.0 {
        Candidate::new(b, TriangleFeature::Vertex(at_b))
    } else if parameter > 0.0 {
        Candidate::new(a + along * parameter, TriangleFeature::Edge(k))
    } else {
        Candidate::new(a, TriangleFeature::Vertex(at_a)) // Also for an edge of no length, whose parameter is NaN.
    }
}

/// The foot of the perpendicular from the origin, if it lies inside of the triangle.
fn foot([a, b, c]: [DVec3; 3]) -> Option<Candidate> {
    let (u, v) = (b - a, c - a);
    let (u_size, v_size) = (u.abs().max_element(), v.abs().max_element());
    let (u, v) = (u / u_size, v / v_size);
    let determinant = u.cross(v).length_squared();
    let (uu, uv, vv) = (u.length_squared(), u.dot(v), v.length_squared());
    let (ru, rv) = (-a.dot(u), -a.dot(v));
    let s = (vv * ru - uv * rv) / determinant / u_size;
    let t = (uu * rv - uv * ru) / determinant / v_size;
    let inside = s > 0.0 && t > 0.0 && s + t < 1.0;
    inside.then(|| Candidate::new(a + u * (s * u_size) + v * (t * v_size), TriangleFeature::Interior))
}

/// The length of a vector, without underflow.
fn norm(v: DVec3) -> f64 {
    let size = v.abs().max_element();
    if size == 0.0 || size.is_infinite() { size } else { size * (v / size).length() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::{TriMesh, TriangleSoup};

    /// Small triangles scattered in the unit cube, the same ones on every machine.
    fn scattered(count: u32, size: f64) -> TriMesh {
        let mut state = 1u32;
        let mut unit = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        let mut positions = Vec::new();
        for _ in 0..count {
            let mut point = || DVec3::new(unit(), unit(), unit());
            let corner = point();
            positions.extend([corner, corner + size * point(), corner + size * point()]);
        }
        let triangles = (0..count).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        TriMesh::new(TriangleSoup { positions, triangles, ..Default::default() }).expect("a valid mesh")
    }

    #[test]
    fn the_distance_alone_is_that_of_the_closest_point() {
        let (mut clear, mut count) = (0, 0);
        for (size, flat) in
            [(1.0, 1.0), (0.1, 1.0), (1e-3, 1.0), (0.5, 0.01), (0.3, 1e-5), (0.1, 0.0), (1e-70, 1.0)]
        {
            let mesh = scattered(400, size);
            for k in 0..400 {
                let corners = mesh.corners(TriId(k));
                // Some from straight above corners and points of edges, where candidates tie.
                let [a, b, c] = corners.map(|p| DVec3::new(p.x, p.y, 0.5 + flat * (p.z - 0.5)));
                let normal = (b - a).cross(c - a).normalize_or_zero();
                let queries = [
                    DVec3::new(0.3, 0.4, 0.6),
                    a + normal,
                    b + 0.1 * normal,
                    0.5 * (a + c) - 0.3 * normal,
                    (a + b + c) / 3.0 + normal,
                    0.25 * a + 0.75 * b + size * (b - a),
                    a,
                    DVec3::ZERO,
                ];
                for query in queries {
                    let t = [a, b, c].map(|p| p - query);
                    count += 1;
                    clear += u32::from(!clear_sides(t).contains(&None));
                    assert_eq!(triangle_distance(t), closest_on_triangle(t).distance, "{t:?}");
                }
            }
        }
        assert!(clear * 10 > count * 3 && clear < count, "{clear} of {count}: sides are believed too rarely");
    }

    #[test]
    fn the_hierarchy_leaves_out_nothing_that_matters() {
        for (count, size) in [(1, 1.0), (60, 0.5), (2000, 0.02)] {
            let mesh = scattered(count, size);
            let bvh = Bvh::new(&mesh);
            for k in 0..200 {
                // From inside of the cube to far away.
                let query = DVec3::new((0.7 * f64::from(k)).sin(), (1.1 * f64::from(k)).cos(), 0.3)
                    * 10f64.powi(k / 10 - 2);
                let local = bvh.tree().frame.about(query);
                let of = |t: u32| closest_on_triangle(mesh.corners(TriId(t)).map(|p| local.place(p)));
                let (distance, lowest) =
                    (0..count).map(|t| (of(t).distance, t)).min_by(|a, b| a.partial_cmp(b).unwrap()).unwrap();
                let found = bvh.closest_point(query).unwrap();
                assert_eq!(
                    (found.triangle, found.distance),
                    (TriId(lowest), local.length(distance)),
                    "{query}"
                );
            }
        }
    }
}
