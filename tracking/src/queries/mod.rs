//! Reader of continuous collision queries with known answers, as public benchmarks store them \[Wang21\].
//!
//! What it computes: the [`Query`]s of a text file, one after the other, with coordinates as `f64`.
//!
//! # The format
//! A row is a vertex, eight rows are a query: the four vertices at time 0, then the same at time 1. Vertex against face:
//! the vertex, then the corners of the face. Edge against edge: the ends of one, then of the other. Nothing in the file
//! tells which of the two it holds. A row has seven columns, separated by commas:
//!
//! ```text
//! x numerator, x denominator, y numerator, y denominator, z numerator, z denominator, 1 if there is contact, else 0
//! ```
//!
//! The last column is the same on the eight rows of a query. It may be missing from all rows of the file.
//!
//! # Promises
//! * A coordinate is the `f64` that equals the fraction. A fraction that none equals is an error, or with
//!   [`Parameters::rounded`] becomes the nearest `f64`, ties to even, and is counted. Integers have any number of
//!   digits that fits in a line; fractions need not be in lowest terms.
//! * Coordinates are finite: a fraction whose nearest `f64` is infinite is always an error.
//! * Every error names its line, counted from 1. After an error nothing more is read.
//! * No panic on any input. Memory is bounded by a constant: lines of more than [`LONGEST_LINE`] bytes are refused.
//!
//! Accepted besides: `\r\n`, blank lines at the end, spaces around numbers, a byte order mark, a sign on either number.
//!
//! # Non-promises
//! * That the known answer is right.
//! * The sign of zero: every fraction that is zero becomes `+0`.
//!
//! # Method
//! Powers of two below a fraction with at most 53 significant bits are decided in 128-bit integers, all else by one
//! division of big integers with remainder (`rational`). Linear in the bytes of a file, quadratic in the digits of a number.

mod error;
mod rational;
mod read;

pub use error::ReadError;
pub use read::{LONGEST_LINE, Queries};

/// A question about continuous collision: four vertices that move on straight lines during a time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Query {
    /// The vertices at time 0.
    pub t0: [[f64; 3]; 4],
    /// The vertices at time 1.
    pub t1: [[f64; 3]; 4],
    /// Whether there is contact in the closed time step, as the file says; `None` where it says nothing.
    pub truth: Option<bool>,
    /// The line of the first row, counted from 1.
    pub line: u64,
}

/// How to read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Parameters {
    /// Whether a fraction that equals no `f64` is read as the nearest one. Default: no, it is an error, because the
    /// rounded query is another query, whose answer may differ.
    pub rounded: bool,
}
