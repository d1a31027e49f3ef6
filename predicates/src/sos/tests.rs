//! Symbolic perturbation against the whole polynomial, and what it promises to triangulations.

extern crate std;

use std::collections::BTreeMap;
use std::vec::Vec;

use super::*;

/// The determinant as a polynomial: coefficient by exponent, by the sum over all permutations.
fn polynomial<const P: usize>(points: &[Vec<i128>; P], ids: [u64; P], lifted: bool) -> BTreeMap<u32, i128> {
    let n = points[0].len();
    let rank = |i: usize| ids.iter().filter(|id| **id < ids[i]).count();
    // Value and exponent of each entry; the column of ones comes last and is not displaced.
    let entry = |i: usize, k: usize| -> (i128, Option<u32>) {
        let shift = if lifted { P } else { 0 };
        if k < n {
            (points[i][k], Some(1 << (shift + n * rank(i) + k)))
        } else if lifted && k == n {
            (points[i].iter().map(|x| x * x).sum(), Some(1 << rank(i)))
        } else {
            (1, None)
        }
    };
    let mut total = BTreeMap::new();
    for (permutation, sign) in permutations(P) {
        let mut product: BTreeMap<u32, i128> = [(0, sign)].into();
        for (i, &k) in permutation.iter().enumerate() {
            let (value, exponent) = entry(i, k);
            let mut next = BTreeMap::new();
            for (power, coefficient) in product {
                *next.entry(power).or_insert(0) += coefficient * value;
                if let Some(exponent) = exponent {
                    *next.entry(power + exponent).or_insert(0) += coefficient;
                }
            }
            product = next;
        }
        for (power, coefficient) in product {
            *total.entry(power).or_insert(0) += coefficient;
        }
    }
    total
}

/// All permutations of `0..n` with their signs.
fn permutations(n: usize) -> Vec<(Vec<usize>, i128)> {
    let mut found: Vec<(Vec<usize>, i128)> = [(Vec::new(), 1)].into();
    for i in 0..n {
        found = found
            .iter()
            .flat_map(|(p, sign)| {
                (0..=i).map(move |at| {
                    let mut next = p.clone();
                    next.insert(at, i);
                    (next, if (i - at) % 2 == 0 { *sign } else { -sign })
                })
            })
            .collect();
    }
    found
}

fn leading_sign(polynomial: &BTreeMap<u32, i128>) -> Sign {
    let first = polynomial.values().find(|c| **c != 0).expect("the full matchings do not vanish");
    Sign::of(*first as f64)
}

/// Compares with the polynomial, and with the plain sign where that is not zero, under all orders of the points.
fn check<const N: usize, const P: usize>(
    points: [[f64; N]; P],
    ids: [u64; P],
    plain: Sign,
    lifted: bool,
    sos: impl Fn([[f64; N]; P], [u64; P]) -> Sign,
) {
    let answer = sos(points, ids);
    let exact = points.map(|p| p.iter().map(|x| *x as i128).collect());
    assert_eq!(answer, leading_sign(&polynomial(&exact, ids, lifted)), "{points:?} {ids:?}");
    if !plain.is_zero() {
        assert_eq!(answer, plain);
    }
    for (order, sign) in permutations(P) {
        let permuted = core::array::from_fn(|i| points[order[i]]);
        let names = core::array::from_fn(|i| ids[order[i]]);
        let expected = if sign > 0 { answer } else { -answer };
        assert_eq!(sos(permuted, names), expected, "{points:?} {ids:?} {order:?}");
    }
}

/// A fixed sequence of integers in `0..below`.
struct Sequence(u64);

impl Sequence {
    fn next(&mut self, below: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) % below
    }

    fn points<const N: usize, const P: usize>(&mut self, side: u64) -> [[f64; N]; P] {
        core::array::from_fn(|_| core::array::from_fn(|_| self.next(side) as f64 - 1.0))
    }

    fn ids<const P: usize>(&mut self) -> [u64; P] {
        let mut ids: [u64; P] = core::array::from_fn(|i| 10 * i as u64 + self.next(10));
        for i in (1..P).rev() {
            ids.swap(i, self.next(i as u64 + 1) as usize);
        }
        ids
    }
}

#[test]
fn orient2d_is_the_leading_term_on_every_triple_of_a_grid() {
    let grid: Vec<[f64; 2]> = (0..9).map(|i| [f64::from(i % 3), f64::from(i / 3)]).collect();
    for a in &grid {
        for b in &grid {
            for c in &grid {
                check([*a, *b, *c], [5, 2, 9], orient2d(a, b, c), false, orient2d_sos);
            }
        }
    }
}

#[test]
fn orient3d_is_the_leading_term() {
    let mut random = Sequence(1);
    for round in 0..1500 {
        let p: [[f64; 3]; 4] = random.points(1 + round % 4);
        check(p, random.ids(), orient3d(p[0], p[1], p[2], p[3]), false, orient3d_sos);
    }
}

#[test]
fn incircle_is_the_leading_term() {
    let mut random = Sequence(2);
    for round in 0..1500 {
        let p: [[f64; 2]; 4] = random.points(1 + round % 5);
        check(p, random.ids(), incircle(p[0], p[1], p[2], p[3]), true, incircle_sos);
    }
}

#[test]
fn insphere_is_the_leading_term() {
    let mut random = Sequence(3);
    for round in 0..300 {
        let mut p: [[f64; 3]; 5] = random.points(1 + round % 4);
        if round % 3 == 0 {
            p.iter_mut().for_each(|q| q[1] = 1.0);
        }
        check(p, random.ids(), insphere(p[0], p[1], p[2], p[3], p[4]), true, insphere_sos);
    }
}

#[test]
fn scale_and_extreme_exponents_do_not_matter() {
    let mut random = Sequence(4);
    for round in 0..500 {
        let p: [[f64; 3]; 5] = random.points(1 + round % 3);
        let ids: [u64; 5] = random.ids();
        for scale in [f64::from_bits(1), 2f64.powi(-600), 2f64.powi(1020)] {
            let q = p.map(|p| p.map(|x| x * scale));
            assert_eq!(insphere_sos(q, ids), insphere_sos(p, ids));
            let [a, b, c, d, _] = q;
            let four = [ids[0], ids[1], ids[2], ids[3]];
            assert_eq!(orient3d_sos([a, b, c, d], four), orient3d_sos([p[0], p[1], p[2], p[3]], four));
        }
    }
}

#[test]
fn equal_ids_and_non_finite_points_give_the_plain_answer() {
    let [a, b, c] = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
    assert_eq!(orient2d_sos([a, b, c], [1, 1, 2]), Sign::Zero);
    assert_eq!(orient2d_sos([a, b, [0.0, 1.0]], [1, 1, 2]), Sign::Positive);
    assert_eq!(orient2d_sos([a, b, [f64::NAN, 1.0]], [1, 2, 3]), Sign::Zero);
    assert_eq!(incircle_sos([a, b, c, [0.0, f64::INFINITY]], [1, 2, 3, 4]), Sign::Zero);
}

/// All triangles whose perturbed circumcircle holds no other point, counterclockwise.
fn delaunay_triangles(points: &[[f64; 2]], ids: &[u64]) -> Vec<[usize; 3]> {
    let n = points.len();
    let mut found = Vec::new();
    for i in 0..n {
        for j in i + 1..n {
            for k in j + 1..n {
                let name = |t: [usize; 3]| t.map(|v| ids[v]);
                let mut t = [i, j, k];
                if orient2d_sos(t.map(|v| points[v]), name(t)) == Sign::Negative {
                    t.swap(1, 2);
                }
                let empty = (0..n).filter(|m| !t.contains(m)).all(|m| {
                    let four = [t[0], t[1], t[2], m];
                    incircle_sos(four.map(|v| points[v]), four.map(|v| ids[v])) == Sign::Negative
                });
                if empty {
                    found.push(t);
                }
            }
        }
    }
    found
}

#[test]
fn empty_circles_on_a_grid_tile_it() {
    for seed in 0..12 {
        let mut points: Vec<[f64; 2]> = (0..12).map(|i| [f64::from(i % 4), f64::from(i / 4)]).collect();
        // Twice the same point: the regular triangulation uses one of the two there, or both on the hull.
        points.push(if seed % 2 == 0 { [1.0, 1.0] } else { [3.0, 2.0] });
        let mut random = Sequence(seed);
        let ids: [u64; 13] = random.ids();
        let triangles = delaunay_triangles(&points, &ids);
        let mut edges = BTreeMap::new();
        let mut area = 0.0;
        for t in &triangles {
            let [a, b, c] = t.map(|v| points[v]);
            area += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            for i in 0..3 {
                *edges.entry((t[i], t[(i + 1) % 3])).or_insert(0) += 1;
            }
        }
        assert_eq!(area, 2.0 * 3.0 * 2.0);
        assert!(edges.values().all(|count| *count == 1), "an edge has one triangle on each side");
        let boundary = edges.keys().filter(|(i, j)| !edges.contains_key(&(*j, *i))).count();
        let corners: std::collections::BTreeSet<_> = triangles.iter().flatten().collect();
        assert!(corners.len() >= 12, "each place is a corner");
        if seed % 2 == 0 {
            assert_eq!((corners.contains(&5), corners.contains(&12)), (ids[5] > ids[12], ids[5] < ids[12]));
        }
        assert_eq!(triangles.len(), 2 * corners.len() - 2 - boundary);
    }
}

#[test]
fn empty_spheres_on_a_grid_tile_it() {
    let points: Vec<[f64; 3]> =
        (0..12).map(|i| [f64::from(i % 3), f64::from(i / 3 % 2), f64::from(i / 6)]).collect();
    for seed in 0..4 {
        let mut random = Sequence(seed);
        let ids: [u64; 12] = random.ids();
        let mut faces = BTreeMap::new();
        let mut volume = 0.0;
        for code in 0..12usize.pow(4) {
            let mut t = [code % 12, code / 12 % 12, code / 144 % 12, code / 1728];
            if !(t[0] < t[1] && t[1] < t[2] && t[2] < t[3]) {
                continue;
            }
            if orient3d_sos(t.map(|v| points[v]), t.map(|v| ids[v])) == Sign::Negative {
                t.swap(0, 1);
            }
            let empty = (0..12).filter(|m| !t.contains(m)).all(|m| {
                let five = [t[0], t[1], t[2], t[3], m];
                insphere_sos(five.map(|v| points[v]), five.map(|v| ids[v])) == Sign::Negative
            });
            if !empty {
                continue;
            }
            let [a, b, c, d] = t.map(|v| points[v]);
            let [u, v, w] = [a, b, c].map(|p| [p[0] - d[0], p[1] - d[1], p[2] - d[2]]);
            volume += u[0] * (v[1] * w[2] - v[2] * w[1])
                + u[1] * (v[2] * w[0] - v[0] * w[2])
                + u[2] * (v[0] * w[1] - v[1] * w[0]);
            for face in [[t[0], t[1], t[2]], [t[0], t[3], t[1]], [t[1], t[3], t[2]], [t[2], t[3], t[0]]] {
                // Rotated so that the least comes first: the orientation stays.
                let least = (0..3).min_by_key(|&i| face[i]).expect("three corners");
                let face = [face[least], face[(least + 1) % 3], face[(least + 2) % 3]];
                *faces.entry(face).or_insert(0) += 1;
            }
        }
        assert_eq!(volume, 6.0 * 2.0);
        assert!(faces.values().all(|count| *count == 1), "a face has one tetrahedron on each side");
        // The faces without a partner close up: V - E + F = 2, with 3 F = 2 E.
        let boundary: Vec<_> =
            faces.keys().filter(|f| !faces.contains_key(&[f[0], f[2], f[1]])).copied().collect();
        let corners: std::collections::BTreeSet<_> = boundary.iter().flatten().collect();
        assert_eq!(boundary.len() % 2, 0);
        assert_eq!(corners.len() + boundary.len() - boundary.len() / 2 * 3, 2);
    }
}
