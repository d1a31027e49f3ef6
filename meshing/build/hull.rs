//! The facets of the convex hull of a few points with integer coordinates, by trying all planes.

pub(crate) type Point = [i32; 3];

/// Six times the signed volume of a tetrahedron: positive if `b, c, d` turn counterclockwise seen from the side away from `a`.
pub(crate) fn volume(a: Point, b: Point, c: Point, d: Point) -> i32 {
    let [u, v, w] = [b, c, d].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
    u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
}

/// The facets of the hull as polygons of point numbers, counterclockwise seen from outside. No point may lie within the hull of others.
pub(crate) fn facets(points: &[Point]) -> Vec<Vec<usize>> {
    let n = points.len();
    let mut facets: Vec<Vec<usize>> = Vec::new();
    for a in 0..n {
        for b in 0..n {
            for c in b + 1..n {
                if let Some(facet) = facet_through(points, [a, b, c]) {
                    facets.push(facet);
                }
            }
        }
    }
    facets.sort_unstable();
    facets.dedup();
    facets
}

/// The facet in the plane of three points whose side from `a` to `b` is a side of the facet, if `a` is its lowest point.
fn facet_through(points: &[Point], [a, b, c]: [usize; 3]) -> Option<Vec<usize>> {
    let side = |p: usize| volume(points[a], points[b], points[c], points[p]);
    let all = || 0..points.len();
    let above = all().filter(|&p| side(p) > 0).count();
    let below = all().filter(|&p| side(p) < 0).count();
    if a == b || a == c || (above > 0) == (below > 0) {
        return None;
    }
    // `b` and `c` in the order that has everything else behind the plane; then a point that is behind serves as an eye from
    // which turns are seen, the wrong way round.
    let eye = points[all().find(|&p| side(p) != 0)?];
    let on: Vec<usize> = all().filter(|&p| side(p) == 0).collect();
    if on.iter().min() != Some(&a) {
        return None;
    }
    let left = |from: usize, to: usize, p: usize| volume(eye, points[from], points[to], points[p]) > 0;
    let mut polygon = vec![a];
    while polygon.len() < on.len() {
        let last = *polygon.last()?;
        let next =
            on.iter().find(|&&q| q != last && on.iter().all(|&p| p == q || p == last || left(last, q, p)))?;
        polygon.push(*next);
    }
    Some(polygon)
}
