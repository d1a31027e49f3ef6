//! Many queries at once, from a structure of arrays: the culling stages run on several queries in parallel.
//!
//! # What it computes
//! The same answers as [`super::vertex_face`] and [`super::edge_edge`], query by query. Coordinates come in columns, one for each
//! coordinate of each point at each end of the step: [`Columns`].
//!
//! # Method
//! Blocks of [`LANES`] queries. Boxes, then two separating directions, without a branch between the queries of a block, so that the
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
use super::query::{settle_edge_edge, settle_vertex_face};
use super::settle::boxes_apart;
use super::{EDGE_EDGE, STEP, VERTEX_FACE};
use core::fmt;

/// Queries of a block: two vectors of the widest machines, and few enough for their columns to stay in the first cache.
const LANES: usize = 16;

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
        let chunks = |t: usize, p: usize, k: usize| self.columns[t][p][k].as_chunks::<LANES>();
        let padded = each(|t, p, k| {
            let mut lanes = [0.0; LANES];
            let rest = chunks(t, p, k).1;
            lanes[..rest.len()].copy_from_slice(rest);
            lanes
        });
        (each(|t, p, k| chunks(t, p, k).0), padded)
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
    for (number, answers) in answers.chunks_mut(LANES).enumerate() {
        let block = if answers.len() == LANES {
            each(|t, p, k| &full[t][p][k][number])
        } else {
            each(|t, p, k| &padded[t][p][k])
        };
        let apart = dispatched(&block, corners);
        for (l, answer) in answers.iter_mut().enumerate() {
            *answer = apart[l] == 0 && single(lane(&block, l));
        }
    }
    Ok(())
}

/// Something for each time, point and coordinate.
type Table<T> = [[[T; 3]; 4]; 2];

/// Coordinates of a block.
type Block<'b> = Table<&'b [f64; LANES]>;

/// Which queries of a block are culled: all ones, or zero.
type Culled = [u64; LANES];

#[inline(always)]
fn each<T>(f: impl Fn(usize, usize, usize) -> T) -> Table<T> {
    core::array::from_fn(|t| core::array::from_fn(|p| core::array::from_fn(|k| f(t, p, k))))
}

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
        let apart =
            boxes_apart::<K>(&t0, &t1) | Corners::new([&t0, &t1], corners, None).separated_by_first_normal();
        *culled = u64::from(apart).wrapping_neg();
    }
    if culled.iter().fold(u64::MAX, |all, apart| all & apart) != 0 {
        return culled;
    }
    for (l, culled) in culled.iter_mut().enumerate() {
        let [t0, t1] = lane(block, l);
        *culled |= u64::from(Corners::new([&t0, &t1], corners, None).separated_by_centre()).wrapping_neg();
    }
    culled
}

#[inline(always)]
fn lane(block: &Block<'_>, l: usize) -> [[[f64; 3]; 4]; 2] {
    each(|t, p, k| block[t][p][k][l])
}
