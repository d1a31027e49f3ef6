//! A ray and a bilinear patch, from the equations of the patch: [`ray_bilinear_patch`].
//!
//! The equations are solved in rational numbers and square roots of these, without rounding. Whether the patch holds the
//! ray's origin is asked for every ruling that can; the crossings are the roots of the quadratic from which one
//! parameter of the patch has been eliminated, each with its multiplicity. The infinitesimal of the direction is a power
//! of two too small to matter, so that no minor has to be compared with another one. No triangles, no boundary and no
//! degree take part.

use super::surd::{Field, Quadratic, Surd, roots};
use crate::generate::number::power_of_two;
use rug::Rational;
use welter_predicates::ccd::parity::PatchParity::{self, Even, Odd, OnPatch};

type Vector = [Rational; 3];

/// Coefficients of 1, s, t, s t.
type Bilinear = [Rational; 4];

fn bilinear([a, b, c, d]: [Rational; 4]) -> Bilinear {
    let (s, t) = (Rational::from(&b - &a), Rational::from(&c - &a));
    let st = d - &b - &t;
    [a, s, t, st]
}

/// `(a0 + a1 s)(b0 + b1 s)`.
fn product(a: [&Rational; 2], b: [&Rational; 2]) -> Quadratic {
    let mixed = Rational::from(a[0] * b[1]) + Rational::from(a[1] * b[0]);
    [Rational::from(a[0] * b[0]), mixed, Rational::from(a[1] * b[1])]
}

/// The equation for `s` where both bilinear functions vanish, which is without `t`.
fn eliminate(f: &Bilinear, g: &Bilinear) -> Quadratic {
    let first = product([&f[0], &f[1]], [&g[2], &g[3]]);
    let second = product([&g[0], &g[1]], [&f[2], &f[3]]);
    let [a, b, c] = first;
    let [d, e, f] = second;
    [a - d, b - e, c - f]
}

/// Whether the segment from `B(s, 0)` to `B(s, 1)` holds the origin.
fn ruling_holds_origin(field: &Field, functions: &[Bilinear; 3], s: &Surd) -> bool {
    let p = functions.each_ref().map(|f| field.linear([&f[0], &f[1]], s));
    let q: [Surd; 3] =
        std::array::from_fn(|k| field.add(&p[k], &field.linear([&functions[k][2], &functions[k][3]], s)));
    let sign = |x: &Surd| field.sign(x) as i32;
    let parallel = [[0, 1], [1, 2], [2, 0]].iter().all(|&[i, j]| {
        let minor = field.subtract(&field.multiply(&p[i], &q[j]), &field.multiply(&p[j], &q[i]));
        sign(&minor) == 0
    });
    parallel && (0..3).all(|k| sign(&p[k]) * sign(&q[k]) <= 0)
}

/// Whether the origin is on the patch. The `s` for which the segment from `B(s, 0)` to `B(s, 1)` holds it are
/// a closed set, which begins at 0, or where a coordinate of an end or of the ends' cross product is zero.
fn holds_origin(functions: &[Bilinear; 3]) -> bool {
    let fixed = Field::rationals();
    if [0, 1].iter().any(|&s| ruling_holds_origin(&fixed, functions, &Surd::rational(Rational::from(s)))) {
        return true;
    }
    let mut equations = Vec::new();
    for k in 0..3 {
        let f = &functions[k];
        equations.push(eliminate(f, &functions[(k + 1) % 3]));
        equations.push([f[0].clone(), f[1].clone(), Rational::new()]);
        equations.push([Rational::from(&f[0] + &f[2]), Rational::from(&f[1] + &f[3]), Rational::new()]);
    }
    equations.iter().flat_map(roots).any(|root| ruling_holds_origin(&root.field, functions, &root.s))
}

/// How often the ray from the origin in this direction, which is in no special position, crosses the patch.
fn crossings(functions: &[Bilinear; 3], direction: &Vector) -> u32 {
    let k = (0..3).find(|&k| direction[k].cmp0().is_ne()).expect("a direction that is not zero");
    // Functions that vanish on the line of the ray.
    let [f, g]: [Bilinear; 2] = [(k + 1) % 3, (k + 2) % 3].map(|i| {
        std::array::from_fn(|c| {
            Rational::from(&direction[k] * &functions[i][c])
                - Rational::from(&direction[i] * &functions[k][c])
        })
    });
    let mut count = 0;
    for root in roots(&eliminate(&f, &g)) {
        let field = &root.field;
        let linear = |h: &Bilinear, i: usize| field.linear([&h[i], &h[i + 1]], &root.s);
        // t = -constant / slope, from one that determines it.
        let Some(h) = [&f, &g].into_iter().find(|h| field.sign(&linear(h, 2)).is_ne()) else { continue };
        let (constant, slope) = (linear(h, 0), linear(h, 2));
        let sign = |x: &Surd| field.sign(x) as i32;
        let inside =
            sign(&constant) * sign(&slope) < 0 && sign(&field.add(&constant, &slope)) * sign(&slope) > 0;
        // The coordinate along the ray, times the slope.
        let along = field.subtract(
            &field.multiply(&linear(&functions[k], 0), &slope),
            &field.multiply(&linear(&functions[k], 2), &constant),
        );
        let ahead = sign(&along) * sign(&slope) * (direction[k].cmp0() as i32) > 0;
        if inside && ahead {
            count += root.multiplicity;
        }
    }
    count
}

/// A power for [`ray_bilinear_patch`] that is large enough for these points, and small where that is.
///
/// With all coordinates multiples of `2^-m` below `2^n`, minors of two differences are multiples of `2^-2m` below
/// `2^(2n+3)`, those of a direction and two differences multiples of `2^-3m`: a power above `3m + 2n + 3` keeps the
/// order of `1, e, e^2, e^3` among them.
#[must_use]
pub fn infinitesimal(points: &[[f64; 3]]) -> u32 {
    let few_bits = |x: f64| x.abs() < power_of_two(20) && (x * power_of_two(100)).fract() == 0.0;
    if points.iter().flatten().all(|&x| few_bits(x)) { 400 } else { 6500 }
}

/// The answer for the direction `R + (e, e^2, e^3)` with `e = 2^-power`.
///
/// # Panics
/// If a coordinate is not finite.
#[must_use]
pub fn ray_bilinear_patch(
    origin: [f64; 3],
    direction: [f64; 3],
    patch: [[f64; 3]; 4],
    power: u32,
) -> PatchParity {
    let exact = |x: f64| Rational::from_f64(x).expect("finite");
    let functions: [Bilinear; 3] =
        std::array::from_fn(|k| bilinear(patch.map(|p| exact(p[k]) - exact(origin[k]))));
    if holds_origin(&functions) {
        return OnPatch;
    }
    let direction =
        std::array::from_fn(|k| exact(direction[k]) + (Rational::from(1) >> (power * (k as u32 + 1))));
    if crossings(&functions, &direction) % 2 == 1 { Odd } else { Even }
}
