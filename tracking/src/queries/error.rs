//! What can be wrong with a file of queries, and where: [`ReadError`].

use std::io;

/// Why queries could not be read. Lines and columns are counted from 1; columns are fields between commas.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// There is no row: no bytes, or nothing but white space.
    #[error("the file is empty, expected rows of 6 or 7 integers separated by commas")]
    Empty,
    /// A row of another length than the format has, or than the first row of the file has.
    #[error("line {line}: {found} columns, expected {expected}")]
    ColumnCount {
        /// The line.
        line: u64,
        /// `6 or 7`, or the number on the first row.
        expected: &'static str,
        /// The number there is.
        found: usize,
    },
    /// A field that should be a decimal integer is not.
    #[error("line {line}, column {column}: expected an integer, found `{found}`")]
    NotAnInteger {
        /// The line.
        line: u64,
        /// The column.
        column: usize,
        /// What stands there, shortened and with unprintable characters escaped.
        found: String,
    },
    /// A denominator is zero.
    #[error("line {line}, column {column}: the denominator is zero")]
    ZeroDenominator {
        /// The line.
        line: u64,
        /// The column of the denominator.
        column: usize,
    },
    /// A fraction is no `f64`, and rounding was not asked for.
    #[error("line {line}, column {column}: {value} equals no f64, the nearest is {nearest:e}")]
    NotRepresentable {
        /// The line.
        line: u64,
        /// The column of the numerator.
        column: usize,
        /// The fraction, shortened.
        value: String,
        /// The nearest `f64`, ties to even.
        nearest: f64,
    },
    /// A fraction is so large that the nearest `f64` is infinite.
    #[error("line {line}, column {column}: {value} is beyond the range of f64")]
    BeyondRange {
        /// The line.
        line: u64,
        /// The column of the numerator.
        column: usize,
        /// The fraction, shortened.
        value: String,
    },
    /// The known answer is neither 0 nor 1.
    #[error("line {line}, column 7: expected 0 or 1, found `{found}`")]
    NotATruth {
        /// The line.
        line: u64,
        /// What stands there, shortened and with unprintable characters escaped.
        found: String,
    },
    /// The rows of one query have different answers.
    #[error("line {line}, column 7: the query that begins on line {first_line} has both answers, 0 and 1")]
    TruthDiffers {
        /// The first line whose answer differs from that of the first row.
        line: u64,
        /// The line of the query's first row.
        first_line: u64,
    },
    /// A blank line between rows.
    #[error("line {line}: the line is blank, and rows follow")]
    BlankLine {
        /// The line.
        line: u64,
    },
    /// The file ends inside a query.
    #[error("line {line}: the file ends here, after {rows} of 8 rows of a query")]
    Truncated {
        /// The line of the last row.
        line: u64,
        /// How many rows of the last query there are.
        rows: usize,
    },
    /// A line is not UTF-8: another encoding, or no text.
    #[error("line {line}: byte {byte} of the line is not UTF-8 text")]
    NotUtf8 {
        /// The line.
        line: u64,
        /// The first byte at fault, counted from 1 in the line.
        byte: usize,
    },
    /// A line is longer than any sane file has; binary data taken for text.
    #[error("line {line}: the line is longer than {limit} bytes")]
    LineTooLong {
        /// The line.
        line: u64,
        /// The limit in bytes, with the line's end.
        limit: usize,
    },
    /// The underlying reader failed.
    #[error("line {line}: cannot read on: {source}")]
    Io {
        /// The line that could not be read.
        line: u64,
        /// The failure.
        source: io::Error,
    },
}

impl ReadError {
    /// The line at fault, where there is one.
    #[must_use]
    pub fn line(&self) -> Option<u64> {
        match *self {
            Self::Empty => None,
            Self::ColumnCount { line, .. }
            | Self::NotAnInteger { line, .. }
            | Self::ZeroDenominator { line, .. }
            | Self::NotRepresentable { line, .. }
            | Self::BeyondRange { line, .. }
            | Self::NotATruth { line, .. }
            | Self::TruthDiffers { line, .. }
            | Self::BlankLine { line }
            | Self::Truncated { line, .. }
            | Self::NotUtf8 { line, .. }
            | Self::LineTooLong { line, .. }
            | Self::Io { line, .. } => Some(line),
        }
    }
}

/// How much of a field a message shows.
const SHOWN: usize = 40;

/// Foreign text for a message: shortened, unprintable characters escaped.
pub(super) fn shown(text: &str) -> String {
    let mut shown: String = text.chars().take(SHOWN).flat_map(char::escape_debug).collect();
    if text.chars().nth(SHOWN).is_some() {
        shown.push_str("...");
    }
    shown
}
