//! The system of barycentric weights as a matrix of polynomials of time, and its minors: [`System`].

use super::polynomial::Polynomial;
use super::time::Time;
use super::{Motion, Touch};
use rug::Integer;
use std::cmp::Ordering;

/// The matrix `[ M | target ]` of a motion (see [`super`]) with entries linear in time, and its minors, each computed when
/// first asked for. Sets of rows and columns are bit sets; the target is the last column.
pub(super) struct System {
    entries: Vec<Vec<Polynomial>>,
    /// By rows, then columns.
    minors: Vec<Option<Polynomial>>,
    /// The columns of points of the first primitive.
    first: u32,
}

impl System {
    pub(super) fn new<const D: usize>(motion: &Motion<D>) -> Self {
        let size = D + 2;
        assert_eq!(motion.from.len(), D + 1, "a vertex and a face, or two edges");
        let mut entries = vec![Vec::new(); size];
        for (point, (from, to)) in motion.from.iter().zip(&motion.to).enumerate() {
            let second = point >= motion.first;
            for axis in 0..D {
                let line = [from[axis].clone(), Integer::from(&to[axis] - &from[axis])];
                let line = line.map(|c| if second { -c } else { c });
                entries[axis].push(Polynomial::new(line.into()));
            }
            entries[D].push(Polynomial::constant(i32::from(!second)));
            entries[D + 1].push(Polynomial::constant(i32::from(second)));
        }
        for (row, line) in entries.iter_mut().enumerate() {
            line.push(Polynomial::constant(i32::from(row >= D)));
        }
        Self { entries, minors: vec![None; 1 << (2 * size)], first: (1 << motion.first) - 1 }
    }

    fn size(&self) -> usize {
        self.entries.len()
    }

    /// The column of the target.
    fn target(&self) -> u32 {
        1 << (self.size() - 1)
    }

    /// The minor of these rows and columns, by expansion along the lowest row.
    fn minor(&mut self, rows: u32, columns: u32) -> &Polynomial {
        let index = (rows as usize) << self.size() | columns as usize;
        if self.minors[index].is_none() {
            let minor = self.expand(rows, columns);
            self.minors[index] = Some(minor);
        }
        self.minors[index].as_ref().expect("just computed")
    }

    fn expand(&mut self, rows: u32, columns: u32) -> Polynomial {
        if rows == 0 {
            return Polynomial::constant(1);
        }
        let row = rows.trailing_zeros();
        let mut sum = Polynomial::new(Vec::new());
        for (place, column) in members(columns).enumerate() {
            let entry = self.entries[row as usize][column as usize].clone();
            if !entry.is_zero() {
                sum.add_product(
                    place % 2 == 1,
                    &entry,
                    self.minor(rows & !(1 << row), columns & !(1 << column)),
                );
            }
        }
        sum
    }

    /// The determinant of the whole matrix. Where it does not vanish there is no contact: the target is no combination of
    /// the other columns.
    pub(super) fn determinant(&mut self) -> Polynomial {
        let all = (1 << self.size()) - 1;
        self.minor(all, all).clone()
    }

    /// All minors that are not constant, up to constant factors, each once.
    pub(super) fn all_minors(&mut self) -> Vec<Polynomial> {
        let all = 1_u32 << self.size();
        let mut found = Vec::new();
        for rows in 1..all {
            for columns in (1..all).filter(|columns| columns.count_ones() == rows.count_ones()) {
                found.push(self.minor(rows, columns).clone().normal());
            }
        }
        found.retain(|p| p.degree() > Some(0));
        found.sort();
        found.dedup();
        found
    }

    /// Whether there is a contact at a time, from the signs of minors.
    pub(super) fn touch(&mut self, time: &mut Time) -> Touch {
        let points = self.target() - 1;
        let mut found = Touch::None;
        for support in 1..=points {
            if support & self.first == 0 || support & !self.first == 0 || !self.carries(support, time) {
                continue;
            }
            found = found.max(if support == points { Touch::Inside } else { Touch::Boundary });
        }
        found
    }

    /// True if these columns are independent and the target is a combination of them with positive weights only: Cramer's
    /// rule in rows where they are independent, and bordered minors for the other rows.
    fn carries(&mut self, support: u32, time: &mut Time) -> bool {
        let (all_rows, target) = (0..1_u32 << self.size(), self.target());
        let mut candidates = all_rows.filter(|rows| rows.count_ones() == support.count_ones());
        let Some((rows, sign)) = candidates.find_map(|rows| {
            let sign = time.sign(self.minor(rows, support));
            sign.is_ne().then_some((rows, sign))
        }) else {
            return false;
        };
        let weights_are_positive = members(support).all(|column| {
            // The target stands in the last place, not in that of the column which it replaces.
            let moved = (support >> (column + 1)).count_ones();
            let numerator = time.sign(self.minor(rows, support & !(1 << column) | target));
            let numerator = if moved.is_multiple_of(2) { numerator } else { numerator.reverse() };
            numerator == sign
        });
        weights_are_positive
            && (0..self.size())
                .filter(|row| rows >> row & 1 == 0)
                .all(|row| time.sign(self.minor(rows | 1 << row, support | target)) == Ordering::Equal)
    }
}

/// The members of a bit set, ascending.
fn members(set: u32) -> impl Iterator<Item = u32> {
    (0..u32::BITS).filter(move |i| set >> i & 1 == 1)
}
