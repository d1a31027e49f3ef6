//! The slow twin of every case: exact linear programming on small integers, and drivers that compare.
//!
//! A point of the relative interior of a face is a strictly positive combination of its vertices; two relative
//! interiors meet exactly when a homogeneous system of equations has a strictly positive solution, and in exactly
//! one point when moreover the solutions form a line. Fourier-Motzkin elimination in 128-bit integers decides
//! that, by no orientation, no projection and no order. The feature pairs so found must be those of the case.

extern crate std;

use std::vec::Vec;

/// `row . x = 0`, `row . x >= 0` or `row . x > 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Relation {
    Zero,
    AtLeast,
    Above,
}

pub(super) type Row = (Vec<i128>, Relation);

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

fn reduced(mut row: Vec<i128>) -> Vec<i128> {
    let divisor = row.iter().fold(0, |g, &x| gcd(g, x));
    if divisor > 1 {
        row.iter_mut().for_each(|x| *x /= divisor);
    }
    row
}

/// `p * a + q * b`, reduced.
fn combined(p: i128, a: &[i128], q: i128, b: &[i128]) -> Vec<i128> {
    reduced(a.iter().zip(b).map(|(x, y)| p * x + q * y).collect())
}

/// The dimension of the space cut out by the equations if the homogeneous system has a solution, else `None`.
pub(super) fn solve(mut rows: Vec<Row>) -> Option<usize> {
    let variables = rows[0].0.len();
    let mut eliminated = std::vec![false; variables];
    while let Some(at) =
        rows.iter().position(|(row, kind)| *kind == Relation::Zero && row.iter().any(|&x| x != 0))
    {
        let (pivot_row, _) = rows.swap_remove(at);
        let v = pivot_row.iter().position(|&x| x != 0).expect("the row was chosen for it");
        eliminated[v] = true;
        let p = pivot_row[v];
        for (row, _) in &mut rows {
            if row[v] != 0 {
                *row = combined(p.abs(), row, -row[v] * p.signum(), &pivot_row);
            }
        }
    }
    rows.retain(|(_, kind)| *kind != Relation::Zero);
    let dimension = eliminated.iter().filter(|gone| !**gone).count();
    for v in 0..variables {
        if eliminated[v] {
            continue;
        }
        let (with, mut next): (Vec<Row>, Vec<Row>) = rows.into_iter().partition(|(row, _)| row[v] != 0);
        let (up, down): (Vec<&Row>, Vec<&Row>) = with.iter().partition(|(row, _)| row[v] > 0);
        for (a, kind_a) in &up {
            for (b, kind_b) in &down {
                next.push((combined(-b[v], a, a[v], b), *kind_a.max(kind_b)));
            }
        }
        next.sort();
        next.dedup();
        rows = next;
    }
    rows.iter().all(|(_, kind)| *kind == Relation::AtLeast).then_some(dimension)
}

/// A point (weight 1) or a direction (weight 0) in homogeneous integers.
pub(super) type Generator = [i128; 4];

/// A system with one variable for each generator of `a` and `b`, that equates the two combinations, and asks the
/// chosen ones to be positive and the others zero.
fn system(a: &[Generator], b: &[Generator], in_a: usize, in_b: usize) -> Vec<Row> {
    let n = a.len() + b.len();
    let mut rows: Vec<Row> = (0..4)
        .map(|k| {
            let left = a.iter().map(|p| p[k]);
            (left.chain(b.iter().map(|p| -p[k])).collect(), Relation::Zero)
        })
        .collect();
    for v in 0..n {
        let mut row = std::vec![0; n];
        row[v] = 1;
        let chosen = if v < a.len() { in_a >> v & 1 == 1 } else { in_b >> (v - a.len()) & 1 == 1 };
        rows.push((row, if chosen { Relation::Above } else { Relation::Zero }));
    }
    rows
}

/// Every pair of faces, as sets of generators, whose relative interiors meet, with whether in one point only.
pub(super) fn face_pairs(a: &[Generator], b: &[Generator]) -> Vec<(usize, usize, bool)> {
    let mut pairs = Vec::new();
    for in_a in 1..1 << a.len() {
        for in_b in 1..1 << b.len() {
            if let Some(dimension) = solve(system(a, b, in_a, in_b)) {
                pairs.push((in_a, in_b, dimension == 1));
            }
        }
    }
    pairs
}

/// The generator of an integer point.
pub(super) fn point(p: [f64; 3]) -> Generator {
    [p[0] as i128, p[1] as i128, p[2] as i128, 1]
}

/// The rank of integer vectors.
pub(super) fn rank(vectors: &[Generator]) -> usize {
    let columns = 4;
    let rows: Vec<Row> = vectors
        .iter()
        .map(|v| (v.to_vec(), Relation::Zero))
        .chain([(std::vec![0; 4], Relation::AtLeast)])
        .collect();
    columns - solve(rows).expect("zero solves it")
}

/// A linear congruential generator: fixed sequences for the tests.
#[derive(Clone, Debug)]
pub(super) struct Sequence(pub(super) u64);

impl Sequence {
    pub(super) fn next(&mut self) -> u64 {
        // Constants of Knuth's MMIX.
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        self.0 >> 33
    }

    /// An integer in `-reach..=reach`.
    pub(super) fn integer(&mut self, reach: i64) -> f64 {
        (self.next() as i64 % (2 * reach + 1) - reach) as f64
    }

    /// `P` points with such coordinates.
    pub(super) fn points<const N: usize, const P: usize>(&mut self, reach: i64) -> [[f64; N]; P] {
        core::array::from_fn(|_| core::array::from_fn(|_| self.integer(reach)))
    }
}

mod boxes;
mod contacts;
mod laws;
