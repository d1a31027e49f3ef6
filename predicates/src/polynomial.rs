//! The polynomials behind the predicates, each written once for every number type.
//!
//! A predicate is the sign of a determinant in the differences of its points to the last point:
//!
//! ```text
//! orient2d   | ax ay |        orient3d   | ax ay az |      orient4d   | ax ay az aw |
//!            | bx by |                   | bx by bz |                 | bx by bz bw |
//!                                        | cx cy cz |                 | cx cy cz cw |
//!                                                                     | dx dy dz dw |
//!
//! incircle   | ax ay ax^2+ay^2 |      insphere   | ax ay az ax^2+ay^2+az^2 |
//!            | bx by bx^2+by^2 |                 | bx by bz bx^2+by^2+bz^2 |
//!            | cx cy cx^2+cy^2 |                 | cx cy cz cx^2+cy^2+cz^2 |
//!                                                | dx dy dz dx^2+dy^2+dz^2 |
//! ```
//!
//! A [`Ring`] gives the numbers by degree, because integers of fixed size grow with the degree. The same text
//! thus runs in rounded `f64`, in wide integers, in double-double numbers, in expansions, and, in the tests, in
//! the error bounds of these: what a filter's constant covers is exactly what the filter computes.
//!
//! All functions return each intermediate result to the ring in the same order; the bounds depend on it.

/// Sum and difference of two numbers of the same degree.
pub(crate) trait Additive: Sized {
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
}

/// The product of a number with one of another degree.
pub(crate) trait Times<Rhs> {
    type Product;
    fn times(&self, other: &Rhs) -> Self::Product;
}

/// Number types for the values of degree 1 to 5 in the coordinate differences.
pub(crate) trait Ring {
    type D1: Additive + Times<Self::D1, Product = Self::D2> + Times<Self::D2, Product = Self::D3>;
    type D2: Additive
        + Times<Self::D2, Product = Self::D4>
        + Times<Self::D3, Product = Self::D5>
        + Into<Self::Outcome>;
    type D3: Additive + Into<Self::Outcome>;
    type D4: Additive + Into<Self::Outcome>;
    type D5: Additive + Into<Self::Outcome>;
    /// What is asked of a value in the end.
    type Outcome;
}

/// `ax*by - bx*ay`.
#[inline(always)]
pub(crate) fn minor2<K: Ring>(ax: &K::D1, ay: &K::D1, bx: &K::D1, by: &K::D1) -> K::D2 {
    ax.times(by).minus(&bx.times(ay))
}

/// `az*bc - bz*ac + cz*ab` from the minors `bc`, `ac`, `ab` of the other two columns.
#[inline(always)]
fn expand3<K: Ring>(z: [&K::D1; 3], bc: &K::D2, ac: &K::D2, ab: &K::D2) -> K::D3 {
    z[0].times(bc).minus(&z[1].times(ac)).plus(&z[2].times(ab))
}

/// The sum of the squares of a row of two or three differences.
#[inline(always)]
fn lift2<K: Ring>(row: &[K::D1; 2]) -> K::D2 {
    row[0].times(&row[0]).plus(&row[1].times(&row[1]))
}

#[inline(always)]
fn lift3<K: Ring>(row: &[K::D1; 3]) -> K::D2 {
    row[0].times(&row[0]).plus(&row[1].times(&row[1])).plus(&row[2].times(&row[2]))
}

/// The determinant of two rows of differences.
#[inline(always)]
pub(crate) fn orient2d<K: Ring>([a, b]: &[[K::D1; 2]; 2]) -> K::D2 {
    minor2::<K>(&a[0], &a[1], &b[0], &b[1])
}

/// The determinant of three rows, expanded along the last column.
#[inline(always)]
pub(crate) fn orient3d<K: Ring>([a, b, c]: &[[K::D1; 3]; 3]) -> K::D3 {
    determinant3::<K>(a, b, c)
}

/// [`orient3d`] of rows that lie apart.
#[inline(always)]
pub(crate) fn determinant3<K: Ring>(a: &[K::D1; 3], b: &[K::D1; 3], c: &[K::D1; 3]) -> K::D3 {
    let bc = minor2::<K>(&b[0], &b[1], &c[0], &c[1]);
    let ac = minor2::<K>(&a[0], &a[1], &c[0], &c[1]);
    let ab = minor2::<K>(&a[0], &a[1], &b[0], &b[1]);
    expand3::<K>([&a[2], &b[2], &c[2]], &bc, &ac, &ab)
}

/// The determinant of four rows, expanded along the first two columns: each minor of these times the minor of
/// the other two columns and rows.
#[inline(always)]
pub(crate) fn orient4d<K: Ring>([a, b, c, d]: &[[K::D1; 4]; 4]) -> K::D4 {
    let term = |p: &[K::D1; 4], q: &[K::D1; 4], r: &[K::D1; 4], s: &[K::D1; 4]| {
        minor2::<K>(&p[0], &p[1], &q[0], &q[1]).times(&minor2::<K>(&r[2], &r[3], &s[2], &s[3]))
    };
    let first = term(a, b, c, d).minus(&term(a, c, b, d)).plus(&term(a, d, b, c));
    let second = term(b, c, a, d).minus(&term(b, d, a, c)).plus(&term(c, d, a, b));
    first.plus(&second)
}

/// The determinant of three rows with their squared lengths, expanded along the last column.
#[inline(always)]
pub(crate) fn incircle<K: Ring>([a, b, c]: &[[K::D1; 2]; 3]) -> K::D4 {
    let bc = minor2::<K>(&b[0], &b[1], &c[0], &c[1]);
    let ac = minor2::<K>(&a[0], &a[1], &c[0], &c[1]);
    let ab = minor2::<K>(&a[0], &a[1], &b[0], &b[1]);
    lift2::<K>(a).times(&bc).minus(&lift2::<K>(b).times(&ac)).plus(&lift2::<K>(c).times(&ab))
}

/// The determinant of four rows with their squared lengths, expanded along the last column.
#[inline(always)]
pub(crate) fn insphere<K: Ring>([a, b, c, d]: &[[K::D1; 3]; 4]) -> K::D5 {
    let ab = minor2::<K>(&a[0], &a[1], &b[0], &b[1]);
    let ac = minor2::<K>(&a[0], &a[1], &c[0], &c[1]);
    let ad = minor2::<K>(&a[0], &a[1], &d[0], &d[1]);
    let bc = minor2::<K>(&b[0], &b[1], &c[0], &c[1]);
    let bd = minor2::<K>(&b[0], &b[1], &d[0], &d[1]);
    let cd = minor2::<K>(&c[0], &c[1], &d[0], &d[1]);
    let abc = expand3::<K>([&a[2], &b[2], &c[2]], &bc, &ac, &ab);
    let abd = expand3::<K>([&a[2], &b[2], &d[2]], &bd, &ad, &ab);
    let acd = expand3::<K>([&a[2], &c[2], &d[2]], &cd, &ad, &ac);
    let bcd = expand3::<K>([&b[2], &c[2], &d[2]], &cd, &bd, &bc);
    let cd_terms = lift3::<K>(d).times(&abc).minus(&lift3::<K>(c).times(&abd));
    let ab_terms = lift3::<K>(b).times(&acd).minus(&lift3::<K>(a).times(&bcd));
    cd_terms.plus(&ab_terms)
}

/// The normal of a triangle along the last axis, and the volume of its rows: that normal times the last coordinate at which the
/// line of the axis through the origin meets its plane.
#[inline(always)]
fn plane3<K: Ring>(a: &[K::D1; 3], b: &[K::D1; 3], c: &[K::D1; 3]) -> (K::D2, K::D3) {
    let bc = minor2::<K>(&b[0], &b[1], &c[0], &c[1]);
    let ac = minor2::<K>(&a[0], &a[1], &c[0], &c[1]);
    let ab = minor2::<K>(&a[0], &a[1], &b[0], &b[1]);
    let volume = expand3::<K>([&a[2], &b[2], &c[2]], &bc, &ac, &ab);
    (ab.plus(&bc).minus(&ac), volume)
}

/// Where the last axis meets the plane of the first three rows, less where it meets that of the others, times the
/// normals of both along the axis.
#[inline(always)]
pub(crate) fn crossings<K: Ring>([a, b, c, d, e, f]: &[[K::D1; 3]; 6]) -> K::D5 {
    let (first, first_volume) = plane3::<K>(a, b, c);
    let (second, second_volume) = plane3::<K>(d, e, f);
    second.times(&first_volume).minus(&first.times(&second_volume))
}

/// How fast the last coordinate of the plane of the first three rows grows with coordinate `k`, less how fast that of the other
/// two and the origin does, times the normals of both along the last axis.
#[inline(always)]
pub(crate) fn slopes<K: Ring>([a, b, c, d, e]: &[[K::D1; 3]; 5], k: usize) -> K::D4 {
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let first = |i: usize, j: usize| {
        let ab = minor2::<K>(&a[i], &a[j], &b[i], &b[j]);
        let bc = minor2::<K>(&b[i], &b[j], &c[i], &c[j]);
        let ac = minor2::<K>(&a[i], &a[j], &c[i], &c[j]);
        ab.plus(&bc).minus(&ac)
    };
    let second = |i: usize, j: usize| minor2::<K>(&d[i], &d[j], &e[i], &e[j]);
    second(i, j).times(&first(0, 1)).minus(&first(i, j).times(&second(0, 1)))
}

/// A ring with the products of two values of degree 3.
pub(crate) trait SixthDegree: Ring<D3: Times<Self::D3, Product = Self::D6>> {
    type D6: Additive;
}

/// On which side of the bilinear patch with the corners `a`, `b`, `c`, `d` the origin is, `d` being opposite to
/// `a`: the product of the determinants of the two triangles that share the diagonal `bc`, less that of the two
/// that share `ad` \[Brochu12\].
#[inline(always)]
pub(crate) fn patch_side<K: SixthDegree>([a, b, c, d]: [&[K::D1; 3]; 4]) -> K::D6 {
    let across_bc = determinant3::<K>(a, b, c).times(&determinant3::<K>(b, d, c));
    let across_ad = determinant3::<K>(a, b, d).times(&determinant3::<K>(a, d, c));
    across_bc.minus(&across_ad)
}

/// Rounded evaluation in `f64`.
pub(crate) struct Rounded;

impl SixthDegree for Rounded {
    type D6 = f64;
}

impl Ring for Rounded {
    type D1 = f64;
    type D2 = f64;
    type D3 = f64;
    type D4 = f64;
    type D5 = f64;
    type Outcome = f64;
}

impl Additive for f64 {
    #[inline(always)]
    fn plus(&self, other: &Self) -> Self {
        self + other
    }
    #[inline(always)]
    fn minus(&self, other: &Self) -> Self {
        self - other
    }
}

impl Times<f64> for f64 {
    type Product = f64;
    #[inline(always)]
    fn times(&self, other: &f64) -> f64 {
        self * other
    }
}
