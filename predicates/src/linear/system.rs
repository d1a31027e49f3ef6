//! A system of linear equations as the exact stages read it: [`System`], and the [`Units`] that make it one of
//! integers.

use super::MOST;
use crate::arithmetic::fixed_point::decompose;
use crate::arithmetic::scaled::Scaled;

/// Finite coefficients, of each equation those of the unknowns and then the right-hand side.
#[derive(Clone, Copy, Debug)]
pub(super) struct System {
    pub(super) rows: [[f64; MOST + 1]; MOST],
    pub(super) equations: usize,
    pub(super) unknowns: usize,
}

impl System {
    pub(super) fn new<const M: usize, const N: usize>(a: &[[f64; N]; M], b: &[f64; M]) -> Self {
        const { assert!(M <= MOST && N <= MOST, "at most six equations and six unknowns") };
        let mut rows = [[0.0; MOST + 1]; MOST];
        for ((row, coefficients), &right) in rows.iter_mut().zip(a).zip(b) {
            row[..N].copy_from_slice(coefficients);
            row[N] = right;
        }
        Self { rows, equations: M, unknowns: N }
    }

    pub(super) fn equations(&self) -> &[[f64; MOST + 1]] {
        &self.rows[..self.equations]
    }

    /// The system of the columns whose bit is set: the other unknowns are zero.
    pub(super) fn with_columns(&self, set: u32) -> Self {
        let mut result = Self { rows: [[0.0; MOST + 1]; MOST], equations: self.equations, unknowns: 0 };
        for column in (0..self.unknowns).filter(|&column| set >> column & 1 == 1).chain([self.unknowns]) {
            for (to, from) in result.rows.iter_mut().zip(&self.rows) {
                to[result.unknowns] = from[column];
            }
            result.unknowns += 1;
        }
        result.unknowns -= 1;
        result
    }
}

/// Powers of two that, as factors of rows and columns, make all coefficients integers.
///
/// Multiplied by 2^(rows(i) + columns(j)), no row and no column has a factor of two in common. Graded systems,
/// whose rows or columns have units of their own, thus become integers of the length of one of their numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    rows: [i32; MOST],
    columns: [i32; MOST + 1],
    /// All integers are below 2^bits.
    pub(super) bits: i32,
}

impl Units {
    pub(super) fn of(system: &System) -> Self {
        let mut lowest = [[None; MOST + 1]; MOST];
        for (lowest, row) in lowest.iter_mut().zip(system.equations()) {
            for (lowest, &value) in lowest.iter_mut().zip(&row[..=system.unknowns]) {
                let (_, mantissa, exponent) = decompose(value);
                *lowest = (mantissa != 0).then(|| exponent + mantissa.trailing_zeros() as i32);
            }
        }
        let mut units = Self { rows: [0; MOST], columns: [0; MOST + 1], bits: 0 };
        for (unit, row) in units.rows.iter_mut().zip(&lowest) {
            *unit = -row.iter().flatten().min().copied().unwrap_or(0);
        }
        for (j, unit) in units.columns.iter_mut().enumerate() {
            let column = lowest.iter().zip(&units.rows).filter_map(|(row, r)| row[j].map(|low| low + r));
            *unit = -column.min().unwrap_or(0);
        }
        for (i, row) in system.equations().iter().enumerate() {
            for (j, &value) in row[..=system.unknowns].iter().enumerate() {
                let (_, mantissa, exponent) = decompose(value);
                if mantissa != 0 {
                    let top = exponent + 64 - mantissa.leading_zeros() as i32;
                    units.bits = units.bits.max(top + units.shift(i, j));
                }
            }
        }
        units
    }

    /// The power of two that multiplies a coefficient.
    pub(super) fn shift(&self, row: usize, column: usize) -> i32 {
        self.rows[row] + self.columns[column]
    }

    /// The component `numerator / denominator` of the scaled system's solution, in units of the system itself.
    ///
    /// Leading parts have 62 bits; each is rounded to an `f64`, and so is the quotient: off by less than 2^-51
    /// of it.
    pub(super) fn component(
        &self,
        column: usize,
        right: usize,
        numerator: Scaled,
        denominator: Scaled,
    ) -> f64 {
        if numerator.mantissa == 0 {
            return 0.0;
        }
        let quotient = numerator.mantissa as f64 / denominator.mantissa as f64;
        let power = numerator.exponent - denominator.exponent + self.columns[column] - self.columns[right];
        Scaled::of_f64(quotient).times_power_of_two(power).to_f64()
    }
}
