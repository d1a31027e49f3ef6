//! A triangle cut along segments: [`triangulate`].
//!
//! # What it computes
//! A triangulation of points in a triangle that has given segments as edges.
//!
//! # What it promises
//! * Its triangles cover the triangle once, each oriented as it, and every segment is an edge; or there is none, if a point lies where it may not
//!   or segments cross. All of it holds for the points as they are given, exactly: decisions are made by predicates.
//! * The same points in the same order give the same triangulation.
//!
//! # Method
//! Coordinates are the weights of the second and the third corner, so the triangle is that of (0, 0), (1, 0) and (0, 1), and points
//! on its sides lie on them exactly. Points are inserted one by one into the triangle that holds them; edges that cross a segment are
//! flipped until none does \[Sloan93\]; then edges are flipped as long as that makes the worse of two triangles better
//! \[Lawson77\], in the metric of the triangle in space.
//!
//! # Complexity
//! O(n^2) for n points, of which there are few in a triangle.

mod constraints;
mod quality;

use std::collections::BTreeMap;

use welter_predicates::{Sign, orient2d};

/// Points of a triangle with what is asked of them.
#[derive(Debug)]
pub(super) struct Problem {
    /// The corners first: (0, 0), (1, 0), (0, 1).
    pub(super) points: Vec<[f64; 2]>,
    /// The points on each side, from corner `k` to the next, in order.
    pub(super) sides: [Vec<u32>; 3],
    /// The other points.
    pub(super) inside: Vec<u32>,
    pub(super) segments: Vec<[u32; 2]>,
    /// Scalar products of the edges from the first corner: first with itself, both, second with itself.
    pub(super) metric: [f64; 3],
}

/// The triangulation of a problem, if there is one.
pub(super) fn triangulate(problem: &Problem) -> Option<Vec<[u32; 3]>> {
    let mut mesh = Triangulation::new(&problem.points);
    for (k, side) in problem.sides.iter().enumerate() {
        let end = (k as u32 + 1) % 3;
        let mut before = k as u32;
        for &point in side {
            mesh.insert_on_side([before, end], point)?;
            before = point;
        }
    }
    problem.inside.iter().try_for_each(|&point| mesh.insert(point))?;
    let fixed = mesh.constrain(&problem.segments)?;
    mesh.improve(&fixed, problem.metric);
    Some(mesh.triangles)
}

/// Triangles that cover a triangle, all of positive orientation.
struct Triangulation<'p> {
    points: &'p [[f64; 2]],
    triangles: Vec<[u32; 3]>,
    /// The triangle on the left of each directed edge.
    left: BTreeMap<[u32; 2], u32>,
}

impl<'p> Triangulation<'p> {
    fn new(points: &'p [[f64; 2]]) -> Self {
        let mut mesh = Self { points, triangles: vec![], left: BTreeMap::new() };
        mesh.add([0, 1, 2]);
        mesh
    }

    fn side(&self, a: u32, b: u32, c: u32) -> Sign {
        let [a, b, c] = [a, b, c].map(|i| self.points[i as usize]);
        orient2d(a, b, c)
    }

    fn is_positive(&self, [a, b, c]: [u32; 3]) -> bool {
        self.side(a, b, c) == Sign::Positive
    }

    /// The corner opposite of a directed edge in the triangle on its left.
    fn apex(&self, [a, b]: [u32; 2]) -> Option<u32> {
        let corners = self.triangles[*self.left.get(&[a, b])? as usize];
        corners.into_iter().find(|&c| c != a && c != b)
    }

    fn put(&mut self, place: u32, corners: [u32; 3]) {
        let [a, b, c] = corners;
        self.triangles[place as usize] = corners;
        for edge in [[a, b], [b, c], [c, a]] {
            self.left.insert(edge, place);
        }
    }

    fn add(&mut self, corners: [u32; 3]) {
        let place = self.triangles.len() as u32;
        self.triangles.push(corners);
        self.put(place, corners);
    }

    /// Puts a point on the edge from `a` to `b`, if it lies so; into the triangle on its left.
    fn divide(&mut self, [a, b]: [u32; 2], point: u32) -> Option<()> {
        let place = *self.left.get(&[a, b])?;
        let c = self.apex([a, b])?;
        let parts = [[a, point, c], [point, b, c]];
        if !parts.iter().all(|&part| self.is_positive(part)) {
            return None;
        }
        self.left.remove(&[a, b]);
        self.put(place, parts[0]);
        self.add(parts[1]);
        Some(())
    }

    /// Puts a point on an edge of a side.
    fn insert_on_side(&mut self, edge: [u32; 2], point: u32) -> Option<()> {
        self.divide(edge, point)
    }

    /// Puts a point strictly inside.
    fn insert(&mut self, point: u32) -> Option<()> {
        for place in 0..self.triangles.len() {
            let [a, b, c] = self.triangles[place];
            let edges = [[a, b], [b, c], [c, a]];
            let sides = edges.map(|[a, b]| self.side(a, b, point));
            if sides.contains(&Sign::Negative) {
                continue;
            }
            return match sides.iter().filter(|&&side| side == Sign::Zero).count() {
                0 => {
                    self.put(place as u32, [a, b, point]);
                    self.add([b, c, point]);
                    self.add([c, a, point]);
                    Some(())
                }
                1 => {
                    let on = sides.iter().position(|&side| side == Sign::Zero)?;
                    let [a, b] = edges[on];
                    // A point on a side of the whole is not inside.
                    self.left.get(&[b, a])?;
                    self.divide([a, b], point)?;
                    self.divide([b, a], point)
                }
                _ => None,
            };
        }
        None
    }

    /// Replaces the common edge of two triangles by that between their apexes, if that gives two of positive orientation.
    fn flip(&mut self, [a, b]: [u32; 2]) -> Option<[u32; 2]> {
        let (c, d) = (self.apex([a, b])?, self.apex([b, a])?);
        let new = [[a, d, c], [d, b, c]];
        if !new.iter().all(|&corners| self.is_positive(corners)) {
            return None;
        }
        let places = [self.left.remove(&[a, b])?, self.left.remove(&[b, a])?];
        self.put(places[0], new[0]);
        self.put(places[1], new[1]);
        Some([c, d])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a lattice of 2^-k in general position enough, without segments.
    fn problem(points: &[[f64; 2]], segments: &[[u32; 2]]) -> Problem {
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let mut sides: [Vec<u32>; 3] = Default::default();
        let mut inside = Vec::new();
        for (i, &[u, v]) in (3_u32..).zip(points) {
            match () {
                () if v == 0.0 => sides[0].push(i),
                () if u + v == 1.0 => sides[1].push(i),
                () if u == 0.0 => sides[2].push(i),
                () => inside.push(i),
            }
        }
        let points: Vec<[f64; 2]> = corners.iter().chain(points).copied().collect();
        let place = |i: &u32| points[*i as usize];
        sides[0].sort_by(|a, b| place(a)[0].total_cmp(&place(b)[0]));
        sides[1].sort_by(|a, b| place(a)[1].total_cmp(&place(b)[1]));
        sides[2].sort_by(|a, b| place(b)[1].total_cmp(&place(a)[1]));
        Problem {
            points: points.clone(),
            sides,
            inside,
            segments: segments.to_vec(),
            metric: [1.0, 0.5, 1.0],
        }
    }

    /// Twice the area, exact for lattice points.
    fn area(problem: &Problem, corners: [u32; 3]) -> f64 {
        let [p, q, r] = corners.map(|i| problem.points[i as usize]);
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    }

    /// Covers the triangle once, uses every point, and has every segment.
    fn check(problem: &Problem, triangles: &[[u32; 3]]) {
        let areas: Vec<f64> = triangles.iter().map(|&corners| area(problem, corners)).collect();
        assert!(areas.iter().all(|&area| area > 0.0), "{areas:?}");
        assert_eq!(areas.iter().sum::<f64>(), 1.0);
        let mut edges: Vec<[u32; 2]> =
            triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        edges.sort_unstable();
        assert!(edges.windows(2).all(|pair| pair[0] != pair[1]), "a directed edge twice");
        for &[a, b] in &problem.segments {
            assert!(edges.binary_search(&[a, b]).is_ok() || edges.binary_search(&[b, a]).is_ok());
        }
        for point in 0..problem.points.len() as u32 {
            assert!(triangles.iter().any(|corners| corners.contains(&point)), "{point}");
        }
        // Edges of one triangle are those of the sides.
        let on_side = |[a, b]: [u32; 2]| {
            let [p, q] = [a, b].map(|i| problem.points[i as usize]);
            let on = |f: fn([f64; 2]) -> f64| f(p) == 0.0 && f(q) == 0.0;
            on(|p| p[0]) || on(|p| p[1]) || on(|p| p[0] + p[1] - 1.0)
        };
        for &[a, b] in &edges {
            assert!(edges.binary_search(&[b, a]).is_ok() || on_side([a, b]));
        }
    }

    /// Pseudo-random numbers below a bound.
    struct Numbers(u64);

    impl Numbers {
        fn below(&mut self, bound: u64) -> u64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 33) % bound
        }
    }

    /// Segments that are edges of one triangulation become those of another, whose points come in another order.
    #[test]
    fn random_points_and_segments() {
        let mut forced = 0;
        for seed in 0..60 {
            let mut numbers = Numbers(seed);
            let count = 4 + seed as usize % 40;
            let mut points = Vec::new();
            while points.len() < count {
                let [u, v] = [numbers.below(65) as f64 / 64.0, numbers.below(65) as f64 / 64.0];
                let corner = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].contains(&[u, v]);
                if u + v <= 1.0 && !corner && !points.contains(&[u, v]) {
                    points.push([u, v]);
                }
            }
            let mut first = problem(&points, &[]);
            first.metric = [1.0, 0.99, 1.0];
            let triangles = triangulate(&first).unwrap();
            check(&first, &triangles);
            let plain = triangulate(&problem(&points, &[])).unwrap();
            let has = |[a, b]: [u32; 2]| plain.iter().any(|t| t.contains(&a) && t.contains(&b));
            let edges = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
            let segments: Vec<[u32; 2]> = edges.filter(|_| numbers.below(3) == 0).collect();
            let second = problem(&points, &segments);
            let again = triangulate(&second).unwrap();
            check(&second, &again);
            forced += segments.iter().filter(|&&segment| !has(segment)).count();
        }
        assert!(forced > 100, "{forced} segments were not edges anyway");
    }

    #[test]
    fn what_is_not_in_order_is_refused() {
        let inside = [[0.25, 0.25], [0.5, 0.25], [0.25, 0.5], [0.375, 0.375]];
        assert!(triangulate(&problem(&inside, &[[3, 4], [3, 5]])).is_some());
        // Segments that cross, through a point, to itself; points at one place, outside.
        assert!(triangulate(&problem(&inside[..3], &[[4, 5], [3, 1]])).is_some());
        assert!(
            triangulate(&problem(&[[0.25, 0.25], [0.5, 0.125], [0.125, 0.5]], &[[4, 5], [0, 3]])).is_some()
        );
        assert!(
            triangulate(&problem(&[[0.375, 0.375], [0.5, 0.125], [0.125, 0.5]], &[[4, 5], [0, 3]])).is_none()
        );
        assert!(triangulate(&problem(&inside, &[[4, 5]])).is_none());
        assert!(triangulate(&problem(&inside, &[[4, 4]])).is_none());
        assert!(triangulate(&problem(&[[0.25, 0.25], [0.25, 0.25]], &[])).is_none());
        assert!(triangulate(&problem(&[[0.75, 0.75]], &[])).is_none());
        assert!(triangulate(&problem(&[[f64::NAN, 0.75]], &[])).is_none());
        assert!(triangulate(&problem(&[[0.5, 0.0], [0.5, 0.0]], &[])).is_none());
    }

    /// A fan of points on one side, and its edges along a line: flips cannot go through but in order.
    #[test]
    fn long_segments_cross_many_edges() {
        let mut points: Vec<[f64; 2]> = Vec::new();
        for k in 1..100_u32 {
            let at = f64::from(k) / 256.0;
            let off = f64::from(k * 37 % 64 + 1) / 1024.0;
            points.push([at, 0.25 + if k % 2 == 0 { off } else { -off }]);
        }
        points.push([1.0 / 1024.0, 0.25]);
        points.push([0.5, 0.25]);
        let segment = [102, 103];
        let problem = problem(&points, &[segment]);
        check(&problem, &triangulate(&problem).unwrap());
    }
}
