//! The reader: lines to rows, eight rows to a query.

use super::error::{ReadError, shown};
use super::rational::{Decimal, nearest};
use super::{Parameters, Query};
use std::io::{BufRead, Read};

/// Longest line read, in bytes, with its end. The longest fractions in lowest terms that are `f64` have 16 and 324 digits or
/// 309 and 1, so a row of them has less than 1,100 bytes; the rest is room for spaces and fractions not in lowest terms.
pub const LONGEST_LINE: usize = 8192;

/// Rows of a query: four vertices, twice.
const ROWS: usize = 8;
/// Columns of a row with an answer; without it there is one less.
const COLUMNS: usize = 7;

/// Reads queries one after the other.
///
/// ```
/// use welter_tracking::queries::{Parameters, Queries};
/// let row = |x: &str, z: i32| format!("{x},0,1,{z},1,1\n");
/// let at = |z| row("-3,4", z) + "-4,1,-4,1,0,1,1\n4,1,-4,1,0,1,1\n0,1,4,1,0,1,1\n";
/// let file = at(1) + &at(-1);
/// let queries: Result<Vec<_>, _> = Queries::new(file.as_bytes(), Parameters::default()).collect();
/// let queries = queries?;
/// assert_eq!(queries[0].t1[0], [-0.75, 0.0, -1.0]);
/// assert_eq!(queries[0].truth, Some(true));
///
/// let third = file.replace("-3,4", "1,3");
/// let error = Queries::new(third.as_bytes(), Parameters::default()).next().unwrap().unwrap_err();
/// assert_eq!(error.to_string(), "line 1, column 1: 1/3 equals no f64, the nearest is 3.333333333333333e-1");
///
/// let mut rounded = Queries::new(third.as_bytes(), Parameters { rounded: true });
/// assert_eq!(rounded.next().unwrap()?.t0[0], [1.0 / 3.0, 0.0, 1.0]);
/// assert_eq!(rounded.rounded(), 2);
/// # Ok::<(), welter_tracking::queries::ReadError>(())
/// ```
#[derive(Debug)]
pub struct Queries<R> {
    input: R,
    parameters: Parameters,
    /// The line last read.
    text: Vec<u8>,
    /// Its number.
    line: u64,
    bytes: u64,
    rounded: u64,
    /// Columns of the first row.
    columns: Option<usize>,
    /// The end was reached, or an error.
    finished: bool,
}

/// A vertex, and what its row says of the answer.
struct Row {
    point: [f64; 3],
    truth: Option<bool>,
}

impl<R: BufRead> Queries<R> {
    /// A reader of `input`, of which nothing is read yet.
    pub fn new(input: R, parameters: Parameters) -> Self {
        Self {
            input,
            parameters,
            text: Vec::new(),
            line: 0,
            bytes: 0,
            rounded: 0,
            columns: None,
            finished: false,
        }
    }

    /// How many coordinates read so far were rounded to the nearest `f64`.
    pub fn rounded(&self) -> u64 {
        self.rounded
    }

    /// How many bytes were read so far.
    pub fn bytes_read(&self) -> u64 {
        self.bytes
    }

    /// The next query; `None` at the end of the file.
    fn query(&mut self) -> Result<Option<Query>, ReadError> {
        let mut points = [[0.0; 3]; ROWS];
        let (mut first_line, mut truth) = (0, None);
        for (rows, point) in points.iter_mut().enumerate() {
            let last = self.line;
            let Some(row) = self.row()? else {
                return match (rows, self.columns) {
                    (0, None) => Err(ReadError::Empty),
                    (0, Some(_)) => Ok(None),
                    _ => Err(ReadError::Truncated { line: last, rows }),
                };
            };
            if rows == 0 {
                (first_line, truth) = (self.line, row.truth);
            } else if row.truth != truth {
                return Err(ReadError::TruthDiffers { line: self.line, first_line });
            }
            *point = row.point;
        }
        let [a, b, c, d, e, f, g, h] = points;
        Ok(Some(Query { t0: [a, b, c, d], t1: [e, f, g, h], truth, line: first_line }))
    }

    /// The next row; `None` where nothing but blank lines follows.
    fn row(&mut self) -> Result<Option<Row>, ReadError> {
        let mut blank = None;
        while self.next_line()? {
            if self.text.trim_ascii().is_empty() {
                blank.get_or_insert(self.line);
                continue;
            }
            return match blank.filter(|_| self.columns.is_some()) {
                Some(line) => Err(ReadError::BlankLine { line }),
                None => self.parse().map(Some),
            };
        }
        Ok(None)
    }

    /// Reads a line into `text`; false at the end of the file.
    fn next_line(&mut self) -> Result<bool, ReadError> {
        self.text.clear();
        let line = self.line + 1;
        let mut limited = (&mut self.input).take(LONGEST_LINE as u64 + 1);
        let count =
            limited.read_until(b'\n', &mut self.text).map_err(|source| ReadError::Io { line, source })?;
        if count > LONGEST_LINE {
            return Err(ReadError::LineTooLong { line, limit: LONGEST_LINE });
        }
        if count > 0 {
            self.line = line;
            self.bytes += count as u64;
        }
        Ok(count > 0)
    }

    /// The line last read as a row.
    fn parse(&mut self) -> Result<Row, ReadError> {
        const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
        let line = self.line;
        let bytes = match self.text.strip_prefix(BYTE_ORDER_MARK) {
            Some(rest) if line == 1 => rest,
            _ => &self.text,
        };
        let text = std::str::from_utf8(bytes)
            .map_err(|error| ReadError::NotUtf8 { line, byte: error.valid_up_to() + 1 })?;
        let mut fields = [""; COLUMNS];
        let mut found = 0;
        for field in text.split(',') {
            if let Some(slot) = fields.get_mut(found) {
                *slot = field.trim();
            }
            found += 1;
        }
        let expected = match self.columns {
            None => "6 or 7",
            Some(COLUMNS) => "7 as on the first row",
            Some(_) => "6 as on the first row",
        };
        if self.columns.map_or(!(COLUMNS - 1..=COLUMNS).contains(&found), |columns| columns != found) {
            return Err(ReadError::ColumnCount { line, expected, found });
        }
        let mut point = [0.0; 3];
        for (axis, x) in point.iter_mut().enumerate() {
            let column = 2 * axis + 1;
            let (value, rounded) =
                coordinate([fields[2 * axis], fields[2 * axis + 1]], line, column, self.parameters)?;
            *x = value;
            self.rounded += u64::from(rounded);
        }
        self.columns = Some(found);
        let truth = (found == COLUMNS).then(|| truth(fields[COLUMNS - 1], line)).transpose()?;
        Ok(Row { point, truth })
    }
}

impl<R: BufRead> Iterator for Queries<R> {
    type Item = Result<Query, ReadError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.finished {
            return None;
        }
        let query = self.query().transpose();
        self.finished = !matches!(query, Some(Ok(_)));
        query
    }
}

impl<R: BufRead> std::iter::FusedIterator for Queries<R> {}

/// The fraction in two fields, of which the first is `column`, as an `f64`, and whether it was rounded.
fn coordinate(
    fields: [&str; 2],
    line: u64,
    column: usize,
    parameters: Parameters,
) -> Result<(f64, bool), ReadError> {
    let integer = |k: usize| {
        Decimal::parse(fields[k]).ok_or_else(|| ReadError::NotAnInteger {
            line,
            column: column + k,
            found: shown(fields[k]),
        })
    };
    let (numerator, denominator) = (integer(0)?, integer(1)?);
    if denominator.is_zero() {
        return Err(ReadError::ZeroDenominator { line, column: column + 1 });
    }
    let found = nearest(numerator, denominator);
    let value = || format!("{}/{}", shown(fields[0]), shown(fields[1]));
    if !found.value.is_finite() {
        return Err(ReadError::BeyondRange { line, column, value: value() });
    }
    if !found.exact && !parameters.rounded {
        return Err(ReadError::NotRepresentable { line, column, value: value(), nearest: found.value });
    }
    Ok((found.value, !found.exact))
}

fn truth(field: &str, line: u64) -> Result<bool, ReadError> {
    match field {
        "0" => Ok(false),
        "1" => Ok(true),
        _ => Err(ReadError::NotATruth { line, found: shown(field) }),
    }
}
