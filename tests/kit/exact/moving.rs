//! The distance of two primitives in linear motion, in rational numbers: [`Moving`].
//!
//! The primitives' difference is a convex polygon (segment, triangle, parallelogram) whose corners move
//! linearly. At a rational time its closest point to the origin is a corner, the foot of the perpendicular on
//! an edge, or that on its plane: all are tried. If that point is `p`, every point of the polygon is beyond
//! the plane through `p` across `p`, so `p` is a direction that proves how far away the polygon is, at that
//! time and for some time around it. [`Moving::stays_beyond`] puts such proofs together.

use rug::Rational;

type Vector = [Rational; 3];

/// The polygon of the differences of two primitives; its corners move linearly from time 0 to time 1.
#[derive(Clone, Debug)]
pub struct Moving {
    ends: [Vec<Vector>; 2],
}

/// Differences of vertices, in order around the polygon: vertex-face, edge-edge, vertex-segment.
pub const VERTEX_FACE: &[(usize, usize)] = &[(1, 0), (2, 0), (3, 0)];
/// As [`VERTEX_FACE`].
pub const EDGE_EDGE: &[(usize, usize)] = &[(0, 2), (1, 2), (1, 3), (0, 3)];
/// As [`VERTEX_FACE`].
pub const VERTEX_SEGMENT: &[(usize, usize)] = &[(1, 0), (2, 0)];

/// How many parts of time [`Moving::stays_beyond`] cuts in two before it gives up: a polygon that turns while it
/// grazes the distance would need millions.
const MOST_PARTS: usize = 300;

impl Moving {
    /// The motion of the differences `corners` of the vertices.
    #[must_use]
    pub fn new<const D: usize>(t0: &[[f64; D]], t1: &[[f64; D]], corners: &[(usize, usize)]) -> Self {
        let difference = |points: &[[f64; D]], (i, j): (usize, usize)| -> Vector {
            std::array::from_fn(|k| {
                if k < D { rational(points[i][k]) - rational(points[j][k]) } else { Rational::new() }
            })
        };
        Self { ends: [t0, t1].map(|points| corners.iter().map(|&c| difference(points, c)).collect()) }
    }

    /// The corners at a time.
    #[must_use]
    pub fn at(&self, time: &Rational) -> Vec<Vector> {
        let [from, to] = &self.ends;
        from.iter().zip(to).map(|(p, q)| along(p, &minus(q, p), time)).collect()
    }

    /// The square of the distance from the origin at a time.
    #[must_use]
    pub fn distance_squared(&self, time: &Rational) -> Rational {
        let p = closest(&self.at(time));
        dot(&p, &p)
    }

    /// The square of the largest speed of a corner.
    #[must_use]
    pub fn speed_squared(&self) -> Rational {
        let [from, to] = &self.ends;
        let speeds = from.iter().zip(to).map(|(p, q)| minus(q, p)).map(|v| dot(&v, &v));
        speeds.max().unwrap_or_default()
    }

    /// The square of the norm of the vector of the largest coordinates.
    #[must_use]
    pub fn size_squared(&self) -> Rational {
        let largest =
            |k: usize| self.ends.iter().flatten().map(|p| p[k].clone().abs()).max().unwrap_or_default();
        (0..3).map(largest).fold(Rational::new(), |sum, x| sum + x.square())
    }

    /// Proves that the polygon meets the origin at some time of `[from, to]`: it changes sides once, and the
    /// origin is on the inner side of all its edges throughout. False if this does not prove it.
    #[must_use]
    pub fn meets(&self, from: &Rational, to: &Rational) -> bool {
        let [p, q] = [self.at(from), self.at(to)];
        let corners = p.len();
        if corners == 2 {
            let side = |c: &[Vector]| cross(&c[0], &c[1])[2].clone();
            let between = [(&p[0], &p[1]), (&p[0], &q[1]), (&q[0], &p[1]), (&q[0], &q[1])];
            return opposite(&side(&p), &side(&q)) && between.iter().all(|(a, b)| dot(a, b) < 0);
        }
        let side = |c: &[Vector]| dot(&cross(&c[0], &c[1]), &c[corners - 1]);
        opposite(&side(&p), &side(&q))
            && (0..3).any(|k| {
                let products = (0..corners).flat_map(|i| {
                    let j = (i + 1) % corners;
                    let mixed = cross(&p[i], &q[j])[k].clone() + &cross(&q[i], &p[j])[k];
                    [cross(&p[i], &p[j])[k].clone(), mixed, cross(&q[i], &q[j])[k].clone()]
                });
                let signs: Vec<_> = products.map(|x| x.cmp0()).collect();
                signs[0].is_ne() && signs.iter().all(|&s| s == signs[0])
            })
    }

    /// Proves that the polygon is farther than `distance` from the origin at all times of `[from, to]`: true
    /// if proven, false if it is not so at some time, nothing if neither was found.
    #[must_use]
    pub fn stays_beyond(&self, distance: &Rational, from: &Rational, to: &Rational) -> Option<bool> {
        let limit = Rational::from(distance.square_ref());
        let mut parts = vec![(from.clone(), to.clone())];
        let mut tried = 0;
        while let Some((a, b)) = parts.pop() {
            let middle = Rational::from(&a + &b) / 2;
            let ends = [self.at(&a), self.at(&b)];
            let mut proven = false;
            for time in [&middle, &a, &b] {
                let p = closest(&self.at(time));
                let norm = dot(&p, &p);
                if norm <= limit {
                    return Some(false);
                }
                // d . P_i > D |d| for all corners, at both ends and so between them.
                let beyond = |corner: &Vector| {
                    let away = dot(&p, corner);
                    away > 0 && away.square() > Rational::from(&limit * &norm)
                };
                if ends.iter().flatten().all(beyond) {
                    proven = true;
                    break;
                }
            }
            if !proven {
                tried += 1;
                if tried == MOST_PARTS {
                    return None;
                }
                parts.push((middle.clone(), b));
                parts.push((a, middle));
            }
        }
        Some(true)
    }
}

/// The number, exactly.
#[must_use]
pub fn rational(value: f64) -> Rational {
    Rational::from_f64(value).expect("an oracle speaks of finite numbers")
}

fn minus(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| Rational::from(&a[k] - &b[k]))
}

fn along(p: &Vector, v: &Vector, t: &Rational) -> Vector {
    std::array::from_fn(|k| Rational::from(&v[k] * t) + &p[k])
}

fn dot(a: &Vector, b: &Vector) -> Rational {
    (0..3).fold(Rational::new(), |sum, k| sum + Rational::from(&a[k] * &b[k]))
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        Rational::from(&a[i] * &b[j]) - Rational::from(&a[j] * &b[i])
    })
}

fn opposite(a: &Rational, b: &Rational) -> bool {
    a.cmp0().is_ne() && a.cmp0() == b.cmp0().reverse()
}

/// The point of a segment, triangle or parallelogram closest to the origin.
fn closest(corners: &[Vector]) -> Vector {
    let mut candidates = corners.to_vec();
    for (i, p) in corners.iter().enumerate() {
        let v = minus(&corners[(i + 1) % corners.len()], p);
        let length = dot(&v, &v);
        let t = -dot(p, &v);
        if t > 0 && t < length {
            candidates.push(along(p, &v, &(t / length)));
        }
    }
    candidates.extend(foot(corners));
    candidates.into_iter().min_by_key(|p| dot(p, p)).expect("a polygon has corners")
}

/// The foot of the perpendicular on the polygon's plane, if it lies in the polygon.
fn foot(corners: &[Vector]) -> Option<Vector> {
    let (p, last) = (&corners[0], corners.len() - 1);
    if last < 2 {
        return None;
    }
    let (a, b) = (minus(&corners[1], p), minus(&corners[last], p));
    let (aa, ab, bb) = (dot(&a, &a), dot(&a, &b), dot(&b, &b));
    let (pa, pb) = (dot(p, &a), dot(p, &b));
    let determinant = Rational::from(&aa * &bb) - Rational::from(ab.square_ref());
    if determinant == 0 {
        return None;
    }
    let s = (Rational::from(&ab * &pb) - Rational::from(&bb * &pa)) / &determinant;
    let t = (Rational::from(&ab * &pa) - Rational::from(&aa * &pb)) / &determinant;
    let inside = s >= 0 && t >= 0 && if last == 2 { Rational::from(&s + &t) <= 1 } else { s <= 1 && t <= 1 };
    inside.then(|| along(&along(p, &a, &s), &b, &t))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_of_a_vertex_above_a_face() {
        let face = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        let from = |v: [f64; 3], w: [f64; 3]| {
            Moving::new(&[v, face[0], face[1], face[2]], &[w, face[0], face[1], face[2]], VERTEX_FACE)
        };
        let sinking = from([1.0, 1.0, 5.0], [1.0, 1.0, 1.0]);
        assert_eq!(sinking.distance_squared(&Rational::from((1, 2))), 9);
        let beyond = |d: i32| sinking.stays_beyond(&Rational::from(d), &Rational::new(), &Rational::from(1));
        assert_eq!((beyond(0), beyond(1), beyond(2)), (Some(true), Some(false), Some(false)));
        let through = from([1.0, 1.0, 5.0], [1.0, 1.0, -5.0]);
        let meets = |a: (i32, i32), b: (i32, i32)| through.meets(&Rational::from(a), &Rational::from(b));
        assert!(
            meets((0, 1), (1, 1))
                && meets((2, 5), (3, 5))
                && !meets((3, 5), (1, 1))
                && !meets((0, 1), (2, 5))
        );
        // Beside an edge, and beside a corner.
        assert_eq!(from([1.0, -3.0, 4.0], [0.0; 3]).distance_squared(&Rational::new()), 25);
        assert_eq!(from([-1.0, -2.0, 2.0], [0.0; 3]).distance_squared(&Rational::new()), 9);
    }

    #[test]
    fn distances_of_edges() {
        let t0 = [[0.0, 0.0, 2.0], [4.0, 0.0, 2.0], [1.0, -1.0, 0.0], [1.0, 3.0, 0.0]];
        let moving = Moving::new(&t0, &t0, EDGE_EDGE);
        assert_eq!(moving.distance_squared(&Rational::new()), 4);
        assert_eq!(
            (moving.speed_squared(), moving.size_squared()),
            (Rational::new(), Rational::from(9 + 9 + 4))
        );
    }
}
