//! The usual collision detection in rounded arithmetic, as a baseline: [`first_contact`].
//!
//! Four moving points are coplanar where a cubic in time is zero [Provot97]. Its roots in [0, 1] are found between the roots of
//! its derivative, by bisection with steps of Newton; at each, from the first, and at the end of the step, the
//! distance of the two elements is compared with a tolerance. It misses contacts, and finds some that are none.

use crate::narrow::Places;
use glam::DVec3;
use welter_tracking::collision::closest_points;

/// Weights and normal of the first contact.
pub(crate) fn first_contact(edges: bool, places: &Places, tolerance: f64) -> Option<([f64; 4], DVec3)> {
    let [from, to] = places;
    if clearly_apart(edges, places) {
        return None;
    }
    // The three vectors whose triple product tells coplanarity: at time 0, and their changes.
    let sides = |p: &[DVec3; 4]| [p[1] - p[0], p[2] - p[0], p[3] - p[0]];
    let (a, b) = (sides(from), sides(to));
    let d: [DVec3; 3] = std::array::from_fn(|i| b[i] - a[i]);
    let triple = |u: DVec3, v: DVec3, w: DVec3| u.dot(v.cross(w));
    let polynomial = [
        triple(a[0], a[1], a[2]),
        triple(d[0], a[1], a[2]) + triple(a[0], d[1], a[2]) + triple(a[0], a[1], d[2]),
        triple(d[0], d[1], a[2]) + triple(d[0], a[1], d[2]) + triple(a[0], d[1], d[2]),
        triple(d[0], d[1], d[2]),
    ];
    // Bernstein coefficients of one sign: no root.
    let [c0, c1, c2, c3] = polynomial;
    let bernstein = [c0, c0 + c1 / 3.0, c0 + (2.0 * c1 + c2) / 3.0, c0 + c1 + c2 + c3];
    if bernstein.iter().all(|&x| x > 0.0) || bernstein.iter().all(|&x| x < 0.0) {
        return None;
    }
    roots(polynomial).into_iter().flatten().find_map(|time| contact_at(edges, places, time, tolerance))
}

/// Whether boxes, or the normal at the beginning, tell that the elements do not meet: as most such codes ask first.
fn clearly_apart(edges: bool, [from, to]: &Places) -> bool {
    let second = if edges { 2 } else { 1 };
    let of = |i: std::ops::Range<usize>| {
        let both = from[i.clone()].iter().chain(&to[i]);
        both.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)))
    };
    let (a, b) = (of(0..second), of(second..4));
    if a.0.cmpgt(b.1).any() || b.0.cmpgt(a.1).any() {
        return true;
    }
    let normal = if edges {
        (from[1] - from[0]).cross(from[3] - from[2])
    } else {
        (from[2] - from[1]).cross(from[3] - from[1])
    };
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for p in [from, to] {
        for i in 0..second {
            for j in second..4 {
                let along = normal.dot(p[i] - p[j]);
                (low, high) = (low.min(along), high.max(along));
            }
        }
    }
    low > 0.0 || high < 0.0
}

/// Roots in [0, 1], ascending.
fn roots(polynomial: [f64; 4]) -> [Option<f64>; 3] {
    let [c0, c1, c2, c3] = polynomial;
    let value = |t: f64| ((c3 * t + c2) * t + c1) * t + c0;
    let slope = |t: f64| (3.0 * c3 * t + 2.0 * c2) * t + c1;
    // Extrema within the step.
    let (mut cuts, mut count) = ([0.0, 1.0, 1.0, 1.0], 1);
    let discriminant = c2 * c2 - 3.0 * c3 * c1;
    if discriminant > 0.0 {
        let q = -(c2 + discriminant.sqrt().copysign(c2));
        let (p, r) = (q / (3.0 * c3), c1 / q);
        for t in [p.min(r), p.max(r)] {
            if t > 0.0 && t < 1.0 {
                cuts[count] = t;
                count += 1;
            }
        }
    }
    cuts[count] = 1.0;
    let mut found = [None; 3];
    for i in 0..count {
        let (mut low, mut high) = (cuts[i], cuts[i + 1]);
        let (at_low, at_high) = (value(low), value(high));
        if (at_low > 0.0) == (at_high > 0.0) && at_low != 0.0 && at_high != 0.0 {
            continue;
        }
        let rises = at_high > at_low;
        let mut time = 0.5 * (low + high);
        for _ in 0..50 {
            let here = value(time);
            if (here > 0.0) == rises {
                high = time;
            } else {
                low = time;
            }
            let newton = time - here / slope(time);
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - time).abs() < 1e-12 {
                time = next;
                break;
            }
            time = next;
        }
        found[i] = Some(time);
    }
    found
}

/// The contact at a time, if the elements are within the tolerance then.
fn contact_at(edges: bool, [from, to]: &Places, time: f64, tolerance: f64) -> Option<([f64; 4], DVec3)> {
    let p: [DVec3; 4] = std::array::from_fn(|i| from[i].lerp(to[i], time));
    let (weights, distance) = if edges { between_edges(p) } else { in_triangle(p) };
    if distance > tolerance {
        return None;
    }
    let normal = if edges { (p[1] - p[0]).cross(p[3] - p[2]) } else { (p[2] - p[1]).cross(p[3] - p[1]) };
    let normal = normal.try_normalize()?;
    let sign = if edges { [1.0, 1.0, -1.0, -1.0] } else { [1.0, -1.0, -1.0, -1.0] };
    let relative: DVec3 = (0..4).map(|i| sign[i] * weights[i] * (to[i] - from[i])).sum();
    Some((weights, if normal.dot(relative) > 0.0 { -normal } else { normal }))
}

/// Barycentric coordinates where they are not negative, and otherwise the closest points.
fn in_triangle([v, a, b, c]: [DVec3; 4]) -> ([f64; 4], f64) {
    let (p, q, r) = (b - a, c - a, v - a);
    let (pp, pq, qq) = (p.dot(p), p.dot(q), q.dot(q));
    let determinant = pp * qq - pq * pq;
    let s = (qq * p.dot(r) - pq * q.dot(r)) / determinant;
    let t = (pp * q.dot(r) - pq * p.dot(r)) / determinant;
    if s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
        return ([1.0, 1.0 - s - t, s, t], (r - s * p - t * q).length());
    }
    closest(false, [v, a, b, c])
}

/// The same for two edges.
fn between_edges([a, b, c, d]: [DVec3; 4]) -> ([f64; 4], f64) {
    let (p, q, r) = (b - a, d - c, c - a);
    let (pp, pq, qq) = (p.dot(p), p.dot(q), q.dot(q));
    let determinant = pp * qq - pq * pq;
    let s = (qq * p.dot(r) - pq * q.dot(r)) / determinant;
    let t = (pq * p.dot(r) - pp * q.dot(r)) / determinant;
    if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
        return ([1.0 - s, s, 1.0 - t, t], (a + s * p - c - t * q).length());
    }
    closest(true, [a, b, c, d])
}

fn closest(edges: bool, places: [DVec3; 4]) -> ([f64; 4], f64) {
    let points = if edges { closest_points::edge_edge(places) } else { closest_points::vertex_face(places) };
    let points = points.expect("finite");
    (points.weights, points.distance[1])
}
