//! Many queries at once, from a structure of arrays: the culling stages run on several queries in parallel.
//!
//! # What it computes
//! The same answers as [`super::vertex_face`] and [`super::edge_edge`], query by query. Coordinates come in columns, one for each
//! coordinate of each point at each end of the step: [`Columns`].
//!
//! # Method
//! Blocks of a few dozen queries. Boxes and the likeliest separating direction, without a branch between the queries of a block, so that the
//! compiler turns the loop over them into vector instructions; with the feature `simd` for the widest vectors that the machine
//! has, chosen at run time. What these stages leave goes to the single query.
//!
//! ```
//! use welter_predicates::ccd::batch::{self, Columns};
//! // Two vertices that fall on one resting face, of which the second stops short of it.
//! let (zero, a, b) = (vec![0.0; 2], vec![-4.0; 2], vec![4.0; 2]);
//! let (above, below) = (vec![1.0; 2], vec![-1.0, 0.5]);
//! let face = [[&a[..], &a, &zero], [&b, &a, &zero], [&zero, &b, &zero]];
//! let t0 = [[&zero[..], &zero, &above], face[0], face[1], face[2]];
//! let t1 = [[&zero[..], &zero, &below], face[0], face[1], face[2]];
//! let mut answers = [false; 2];
//! batch::vertex_face(&Columns::new([t0, t1])?, &mut answers)?;
//! assert_eq!(answers, [true, false]);
//! # Ok::<(), batch::LengthMismatch>(())
//! ```

use super::corners::Corners;
use super::query::{copied, settle_edge_edge, settle_vertex_face};
use super::{EDGE_EDGE, STEP, VERTEX_FACE};
use core::fmt;

/// Queries of a block: two vectors of the widest machines, and few enough for their columns to stay in the first cache.
const LANES: usize = 32;

/// The places of four points at the beginning and at the end of many steps, column by column: time, point, coordinate. The
/// order of points is that of the single query.
#[derive(Clone, Copy, Debug)]
pub struct Columns<'a> {
    columns: [[[&'a [f64]; 3]; 4]; 2],
    len: usize,
}

/// Two columns, or the columns and the answers, have not the same length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LengthMismatch {
    /// The length of the first column.
    pub expected: usize,
    /// The length that differs.
    pub found: usize,
}

impl fmt::Display for LengthMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a column of {} entries beside one of {}", self.found, self.expected)
    }
}

impl core::error::Error for LengthMismatch {}

impl<'a> Columns<'a> {
    /// Columns of one length.
    ///
    /// # Errors
    /// [`LengthMismatch`] with the first length that differs from that of the first column.
    pub fn new(columns: [[[&'a [f64]; 3]; 4]; 2]) -> Result<Self, LengthMismatch> {
        let len = columns[0][0][0].len();
        let all = columns.as_flattened().as_flattened();
        match all.iter().find(|column| column.len() != len) {
            Some(column) => Err(LengthMismatch { expected: len, found: column.len() }),
            None => Ok(Self { columns, len }),
        }
    }

    /// The number of queries.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// True when there is no query.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// All full blocks, column by column, and the rest, filled up with zeros.
    fn blocks(&self) -> (Table<&'a [[f64; LANES]]>, Table<[f64; LANES]>) {
        let mut full: Table<&[[f64; LANES]]> = [&[]; 24];
        let mut padded = [[0.0; LANES]; 24];
        let columns = self.columns.as_flattened().as_flattened();
        for ((full, padded), column) in full.iter_mut().zip(&mut padded).zip(columns) {
            let (blocks, rest) = column.as_chunks::<LANES>();
            *full = blocks;
            padded[..rest.len()].copy_from_slice(rest);
        }
        (full, padded)
    }
}

/// [`super::vertex_face`] for many queries: `answers[i]` tells whether the primitives of query `i` touch.
///
/// # Errors
/// [`LengthMismatch`] when there are not as many answers as queries.
pub fn vertex_face(queries: &Columns<'_>, answers: &mut [bool]) -> Result<(), LengthMismatch> {
    all(queries, answers, &VERTEX_FACE, |step| settle_vertex_face(step, STEP).0)
}

/// [`super::edge_edge`] for many queries: `answers[i]` tells whether the primitives of query `i` touch.
///
/// # Errors
/// [`LengthMismatch`] when there are not as many answers as queries.
pub fn edge_edge(queries: &Columns<'_>, answers: &mut [bool]) -> Result<(), LengthMismatch> {
    all(queries, answers, &EDGE_EDGE, |step| settle_edge_edge(step, STEP).0)
}

fn all<const K: usize>(
    queries: &Columns<'_>,
    answers: &mut [bool],
    corners: &[(usize, usize); K],
    single: impl Fn([[[f64; 3]; 4]; 2]) -> bool,
) -> Result<(), LengthMismatch> {
    if answers.len() != queries.len() {
        return Err(LengthMismatch { expected: queries.len(), found: answers.len() });
    }
    let (full, padded) = queries.blocks();
    let mut block: Block<'_> = padded.each_ref();
    for (number, answers) in answers.chunks_mut(LANES).enumerate() {
        if answers.len() == LANES {
            for (lanes, column) in block.iter_mut().zip(&full) {
                *lanes = &column[number];
            }
        } else {
            block = padded.each_ref();
        }
        let apart = dispatched(&block, corners);
        for (l, answer) in answers.iter_mut().enumerate() {
            *answer = apart[l] == 0 && {
                let [t0, t1] = lane(&block, l);
                let centre = || Corners::new([&t0, &t1], corners, None).separated_by_centre();
                !(K == 4 && centre()) && single([t0, t1].map(copied))
            };
        }
    }
    Ok(())
}

/// Something for each time, point and coordinate, in this order.
type Table<T> = [T; 24];

/// Coordinates of a block.
type Block<'b> = Table<&'b [f64; LANES]>;

/// Which queries of a block are culled: all ones, or zero.
type Culled = [u64; LANES];

/// [`culled`] compiled for several machines, of which this one's is taken.
#[cfg(feature = "simd")]
#[inline(never)]
fn dispatched<const K: usize>(block: &Block<'_>, corners: &[(usize, usize); K]) -> Culled {
    struct Task<'t, const K: usize>(&'t Block<'t>, &'t [(usize, usize); K]);
    impl<const K: usize> pulp::WithSimd for Task<'_, K> {
        type Output = Culled;
        #[inline(always)]
        fn with_simd<S: pulp::Simd>(self, _: S) -> Culled {
            culled(self.0, self.1)
        }
    }
    pulp::Arch::new().dispatch(Task(block, corners))
}

#[cfg(not(feature = "simd"))]
#[inline(never)]
fn dispatched<const K: usize>(block: &Block<'_>, corners: &[(usize, usize); K]) -> Culled {
    culled(block, corners)
}

#[inline(always)]
fn culled<const K: usize>(block: &Block<'_>, corners: &[(usize, usize); K]) -> Culled {
    let mut culled = [0; LANES];
    for (l, culled) in culled.iter_mut().enumerate() {
        let [t0, t1] = lane(block, l);
        let (differences, mut apart) = Corners::with_boxes([&t0, &t1], corners);
        apart |= differences.separated_by_first_normal();
        if K == 3 {
            // One in ten separations of a vertex and a face; hardly any of two edges.
            apart |= differences.separated_by_centre();
        }
        *culled = u64::from(apart).wrapping_neg();
    }
    culled
}

#[inline(always)]
fn lane(block: &Block<'_>, l: usize) -> [[[f64; 3]; 4]; 2] {
    // In this form the loop over the lanes becomes vector instructions.
    core::array::from_fn(|t| core::array::from_fn(|p| core::array::from_fn(|k| block[12 * t + 3 * p + k][l])))
}
