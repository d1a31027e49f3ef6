//! Orientation predicates. (First form: the exact stage alone.)

use crate::arithmetic::fixed_point::{COORDINATE_LIMBS, Integer, Unit};
use crate::{Point, Sign};

type Difference = Integer<COORDINATE_LIMBS>;
type Degree2 = Integer<{ 2 * COORDINATE_LIMBS }>;
type Degree3 = Integer<{ 3 * COORDINATE_LIMBS }>;
type Degree4 = Integer<{ 4 * COORDINATE_LIMBS }>;
type Degree5 = Integer<{ 5 * COORDINATE_LIMBS }>;

fn all_finite<const N: usize, const P: usize>(points: &[[f64; N]; P]) -> bool {
    points.as_flattened().iter().all(|x| x.is_finite())
}

/// Rows of differences to the last point.
fn differences<const N: usize, const P: usize, const R: usize>(
    points: [[f64; N]; P],
) -> [[Difference; N]; R] {
    let unit = Unit::of(points.as_flattened().iter().copied());
    let last = points[P - 1].map(|x| unit.integer(x));
    core::array::from_fn(|i| core::array::from_fn(|j| unit.integer(points[i][j]).minus(&last[j])))
}

fn det2(a: &Difference, b: &Difference, c: &Difference, d: &Difference) -> Degree2 {
    Degree2::product(a, d).minus(&Degree2::product(b, c))
}

fn det3(m: [&[Difference; 3]; 3]) -> Degree3 {
    let [a, b, c] = m;
    let t0 = Degree3::product(&a[2], &det2(&b[0], &b[1], &c[0], &c[1]));
    let t1 = Degree3::product(&b[2], &det2(&a[0], &a[1], &c[0], &c[1]));
    let t2 = Degree3::product(&c[2], &det2(&a[0], &a[1], &b[0], &b[1]));
    t0.minus(&t1).plus(&t2)
}

fn lift<const N: usize>(row: &[Difference; N]) -> Degree2 {
    row.iter().fold(Degree2::ZERO, |sum, x| sum.plus(&Degree2::product(x, x)))
}

/// The orientation of three points of the plane: positive when `a`, `b`, `c` turn counterclockwise.
pub fn orient2d(a: impl Point<2>, b: impl Point<2>, c: impl Point<2>) -> Sign {
    let points = [a.coords(), b.coords(), c.coords()];
    if !all_finite(&points) {
        return Sign::Zero;
    }
    let [a, b]: [_; 2] = differences(points);
    det2(&a[0], &a[1], &b[0], &b[1]).sign()
}

/// The orientation of four points of space: positive when `a`, `b`, `c` appear clockwise seen from `d`, that is,
/// the determinant of `a - d`, `b - d`, `c - d` is positive.
pub fn orient3d(a: impl Point<3>, b: impl Point<3>, c: impl Point<3>, d: impl Point<3>) -> Sign {
    let points = [a.coords(), b.coords(), c.coords(), d.coords()];
    if !all_finite(&points) {
        return Sign::Zero;
    }
    let [a, b, c]: [_; 3] = differences(points);
    det3([&a, &b, &c]).sign()
}

/// The orientation of five points of four-dimensional space: the sign of the determinant of `a - e` ... `d - e`.
pub fn orient4d(
    a: impl Point<4>,
    b: impl Point<4>,
    c: impl Point<4>,
    d: impl Point<4>,
    e: impl Point<4>,
) -> Sign {
    let points = [a.coords(), b.coords(), c.coords(), d.coords(), e.coords()];
    if !all_finite(&points) {
        return Sign::Zero;
    }
    let rows: [_; 4] = differences(points);
    let head = |i: usize| -> [Difference; 3] { [rows[i][0], rows[i][1], rows[i][2]] };
    let mut sum = Degree4::ZERO;
    for i in 0..4 {
        let [j, k, l] = others(i);
        let term = Degree4::product(&rows[i][3], &det3([&head(j), &head(k), &head(l)]));
        sum = if i % 2 == 1 { sum.plus(&term) } else { sum.minus(&term) };
    }
    sum.sign()
}

/// Whether `d` lies inside the circle through `a`, `b`, `c`: positive inside when `orient2d(a, b, c)` is positive.
pub fn incircle(a: impl Point<2>, b: impl Point<2>, c: impl Point<2>, d: impl Point<2>) -> Sign {
    let points = [a.coords(), b.coords(), c.coords(), d.coords()];
    if !all_finite(&points) {
        return Sign::Zero;
    }
    let [a, b, c]: [_; 3] = differences(points);
    let t0 = Degree4::product(&lift(&a), &det2(&b[0], &b[1], &c[0], &c[1]));
    let t1 = Degree4::product(&lift(&b), &det2(&a[0], &a[1], &c[0], &c[1]));
    let t2 = Degree4::product(&lift(&c), &det2(&a[0], &a[1], &b[0], &b[1]));
    t0.minus(&t1).plus(&t2).sign()
}

/// Whether `e` lies inside the sphere through `a`, `b`, `c`, `d`: positive inside when `orient3d(a, b, c, d)` is
/// positive.
pub fn insphere(
    a: impl Point<3>,
    b: impl Point<3>,
    c: impl Point<3>,
    d: impl Point<3>,
    e: impl Point<3>,
) -> Sign {
    let points = [a.coords(), b.coords(), c.coords(), d.coords(), e.coords()];
    if !all_finite(&points) {
        return Sign::Zero;
    }
    let rows: [_; 4] = differences(points);
    let mut sum = Degree5::ZERO;
    for i in 0..4 {
        let [j, k, l] = others(i);
        let term = Degree5::product(&lift(&rows[i]), &det3([&rows[j], &rows[k], &rows[l]]));
        sum = if i % 2 == 1 { sum.plus(&term) } else { sum.minus(&term) };
    }
    sum.sign()
}

fn others(i: usize) -> [usize; 3] {
    match i {
        0 => [1, 2, 3],
        1 => [0, 2, 3],
        2 => [0, 1, 3],
        _ => [0, 1, 2],
    }
}
