//! The determinant as a polynomial in the displacement: its terms in order, each an exact minor.

use crate::arithmetic::fixed_point::{COORDINATE_LIMBS, Integer, Integers, Unit};
use crate::arithmetic::scaled::Scaled;
use crate::polynomial::{Additive, Times, minor2};
use crate::{Sign, orient2d, orient3d};

type Coordinate = Integer<COORDINATE_LIMBS>;
type Square = Integer<{ 2 * COORDINATE_LIMBS }>;

/// The most rows a matrix has: those of `insphere`.
const MOST_ROWS: usize = 5;

/// The displaced matrix: a row for each point, with its `N` coordinates, `w` if lifted, and 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Expansion<const N: usize, const P: usize> {
    points: [[f64; N]; P],
    /// The rows in the order of their ids.
    ranked: [usize; P],
    lifted: bool,
    /// False when no displacement is defined: equal ids, or a coordinate that is not finite.
    defined: bool,
}

/// A partial matching of rows and columns, as the sets of those left over.
#[derive(Clone, Copy, Debug)]
struct Term {
    rows: u8,
    columns: u8,
    /// The sign with which the minor of the rest enters.
    sign: Sign,
}

impl Term {
    /// The term with one more displaced entry; `None` if its row or column is taken.
    fn with(self, row: usize, column: usize) -> Option<Self> {
        if self.rows >> row & 1 == 0 || self.columns >> column & 1 == 0 {
            return None;
        }
        // The cofactor's sign counts the places of row and column among those left.
        let before = |set: u8, at: usize| (set & ((1 << at) - 1)).count_ones();
        let odd = (before(self.rows, row) + before(self.columns, column)) % 2 == 1;
        Some(Self {
            rows: self.rows & !(1 << row),
            columns: self.columns & !(1 << column),
            sign: if odd { -self.sign } else { self.sign },
        })
    }
}

impl<const N: usize, const P: usize> Expansion<N, P> {
    pub(super) fn new(points: [[f64; N]; P], ids: [u64; P], lifted: bool) -> Self {
        let mut ranked: [usize; P] = core::array::from_fn(|i| i);
        ranked.sort_unstable_by_key(|&i| ids[i]);
        let distinct = ranked.windows(2).all(|pair| ids[pair[0]] != ids[pair[1]]);
        let finite = points.as_flattened().iter().all(|x| x.is_finite());
        Self { points, ranked, lifted, defined: distinct && finite }
    }

    /// The sign of the first term that is not zero, where the plain determinant is known to be zero.
    pub(super) fn sign(&self) -> Sign {
        if !self.defined {
            return Sign::Zero;
        }
        let entries = P * (N + usize::from(self.lifted));
        let rows = (1 << P) - 1;
        // The column of ones is never displaced; a minor always has it.
        let columns = (1 << (N + usize::from(self.lifted))) - 1;
        self.first_nonzero(entries, Term { rows, columns, sign: Sign::Positive })
    }

    /// Visits, in ascending order of exponents, the terms that displace those of `term` and any of the first
    /// `entries` entries.
    fn first_nonzero(&self, entries: usize, term: Term) -> Sign {
        let sign = term.sign * self.minor(term);
        if !sign.is_zero() {
            return sign;
        }
        for entry in 0..entries {
            let (row, column) = self.place(entry);
            if let Some(next) = term.with(row, column) {
                let sign = self.first_nonzero(entry, next);
                if !sign.is_zero() {
                    return sign;
                }
            }
        }
        Sign::Zero
    }

    /// Row and column of the entry that is displaced by `e^(2^entry)`.
    fn place(&self, entry: usize) -> (usize, usize) {
        if !self.lifted {
            return (self.ranked[entry / N], entry % N);
        }
        match entry.checked_sub(P) {
            None => (self.ranked[entry], N),
            Some(entry) => (self.ranked[entry / N], entry % N),
        }
    }

    /// The sign of the minor of the rows and columns left over and the column of ones.
    fn minor(&self, term: Term) -> Sign {
        let mut rows = [[0.0; N]; MOST_ROWS];
        let mut count = 0;
        for i in (0..P).filter(|i| term.rows >> i & 1 == 1) {
            rows[count] = self.points[i];
            count += 1;
        }
        let mut columns = [0; N];
        let mut width = 0;
        for k in (0..N).filter(|k| term.columns >> k & 1 == 1) {
            columns[width] = k;
            width += 1;
        }
        let rows = &rows[..count];
        if term.columns >> N & 1 == 1 {
            return lifted_minor(rows, &columns[..width]);
        }
        match (&columns[..width], rows) {
            (&[], _) => Sign::Positive,
            (&[x], &[a, b]) => Sign::of_difference(a[x], b[x]),
            (&[x, y], &[a, b, c]) => orient2d([a[x], a[y]], [b[x], b[y]], [c[x], c[y]]),
            (&[x, y, z], &[a, b, c, d]) => {
                orient3d([a[x], a[y], a[z]], [b[x], b[y], b[z]], [c[x], c[y], c[z]], [d[x], d[y], d[z]])
            }
            _ => Sign::Zero,
        }
    }
}

/// The sign of the determinant of at most two columns of coordinates, `w` and 1. Zero for three: that is the plain
/// determinant of `insphere`, which is known to be zero.
///
/// These minors depend on the origin, since `w` does; so they take the coordinates as they are, in integers.
fn lifted_minor<const N: usize>(rows: &[[f64; N]], columns: &[usize]) -> Sign {
    let unit = Unit::of(rows.as_flattened().iter().copied());
    let square = |p: &[f64; N]| -> Square {
        p.iter().fold(Square::ZERO, |sum, &x| {
            let x = unit.integer(x);
            sum.plus(&Square::product(&x, &x))
        })
    };
    let Some((last, rows)) = rows.split_last() else { return Sign::Zero };
    let last_square = square(last);
    let w = |i: usize| square(&rows[i]).minus(&last_square);
    let x = |i: usize, k: usize| -> Coordinate { unit.integer(rows[i][k]).minus(&unit.integer(last[k])) };
    match (columns, rows.len()) {
        ([], 1) => Scaled::from(w(0)),
        (&[k], 2) => Scaled::from(x(0, k).times(&w(1)).minus(&x(1, k).times(&w(0)))),
        (&[k, l], 3) => {
            let minor = |i, j| minor2::<Integers>(&x(i, k), &x(i, l), &x(j, k), &x(j, l));
            let sum =
                w(0).times(&minor(1, 2)).minus(&w(1).times(&minor(0, 2))).plus(&w(2).times(&minor(0, 1)));
            Scaled::from(sum)
        }
        _ => Scaled::ZERO,
    }
    .sign()
}
