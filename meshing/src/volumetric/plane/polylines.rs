//! [`ClosedPolylines`]: closed curves of straight segments.

use std::fmt;

use thiserror::Error;

use super::turning;
use crate::DVec2;
use crate::surface::list::describe;

/// Closed curves of straight segments, which may intersect themselves and each other. What lies on the left of them is inside: outer curves
/// run counterclockwise, those of holes clockwise.
///
/// *Corner* `c` is the `c`-th index of all loops, one loop after the other; segment `c` leads from there to the next corner of its loop.
///
/// ```
/// use welter_meshing::{DVec2, volumetric::plane::ClosedPolylines};
/// let positions = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(DVec2::from_array).to_vec();
/// let triangle = ClosedPolylines::new(positions.clone(), vec![vec![0, 1, 2]])?;
/// assert_eq!(triangle.segment(2), [positions[2], positions[0]]);
/// assert_eq!(triangle.turning(0), [1, 1]);
/// let defects = ClosedPolylines::new(positions, vec![vec![0, 1, 7], vec![2, 2]]).unwrap_err();
/// assert_eq!((defects.out_of_range, defects.short, defects.repeated), (vec![2], vec![1], vec![3, 4]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedPolylines {
    positions: Vec<DVec2>,
    loops: Vec<Vec<u32>>,
    /// The first corner of each loop, and the end.
    starts: Vec<u32>,
    /// The ends of each segment.
    segments: Vec<[u32; 2]>,
}

/// Everything that keeps curves from being [`ClosedPolylines`], each list ascending.
#[derive(Clone, Debug, Default, Error, PartialEq, Eq)]
#[non_exhaustive]
pub struct PolylineDefects {
    /// Positions that are infinite or NaN, by index.
    pub not_finite: Vec<u32>,
    /// Corners of which the index is out of range.
    pub out_of_range: Vec<usize>,
    /// Corners with the same index as the next one of their loop.
    pub repeated: Vec<usize>,
    /// Loops of less than three corners.
    pub short: Vec<usize>,
    /// How many corners there are, if they cannot be numbered with 32 bits.
    pub too_many: Option<usize>,
}

impl PolylineDefects {
    /// True when there is no defect.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl fmt::Display for PolylineDefects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        describe(&mut parts, &self.not_finite, ["position is not finite", "positions are not finite"]);
        describe(
            &mut parts,
            &self.out_of_range,
            ["corner has an index out of range", "corners have indices out of range"],
        );
        describe(
            &mut parts,
            &self.repeated,
            ["corner has the index of the next one", "corners have the index of the next one"],
        );
        describe(
            &mut parts,
            &self.short,
            ["loop has less than three corners", "loops have less than three corners"],
        );
        if let Some(corners) = self.too_many {
            parts.push(format!("{corners} corners are too many"));
        }
        f.write_str(&parts.join("; "))
    }
}

impl ClosedPolylines {
    /// The curves through positions, by index; each loop is closed from its last corner to its first.
    ///
    /// # Errors
    /// [`PolylineDefects`], all of them.
    pub fn new(positions: Vec<DVec2>, loops: Vec<Vec<u32>>) -> Result<Self, PolylineDefects> {
        let not_finite = (0..).zip(&positions).filter(|(_, p)| !p.is_finite()).map(|(n, _)| n).collect();
        let mut defects = PolylineDefects { not_finite, ..PolylineDefects::default() };
        let (mut starts, mut segments) = (vec![0], Vec::new());
        for (number, corners) in loops.iter().enumerate() {
            if corners.len() < 3 {
                defects.short.push(number);
            }
            for (place, &corner) in corners.iter().enumerate() {
                let next = corners[(place + 1) % corners.len()];
                if corner as usize >= positions.len() {
                    defects.out_of_range.push(segments.len());
                }
                if corner == next {
                    defects.repeated.push(segments.len());
                }
                segments.push([corner, next]);
            }
            starts.push(segments.len() as u32);
        }
        if segments.len() >= u32::MAX as usize / 2 {
            defects.too_many = Some(segments.len());
        }
        if defects.is_empty() { Ok(Self { positions, loops, starts, segments }) } else { Err(defects) }
    }

    /// Where the corners may be.
    #[must_use]
    pub fn positions(&self) -> &[DVec2] {
        &self.positions
    }

    /// The indices of the corners of each loop.
    #[must_use]
    pub fn loops(&self) -> &[Vec<u32>] {
        &self.loops
    }

    /// Number of corners of all loops, which is that of segments.
    #[must_use]
    pub fn len(&self) -> usize {
        self.segments.len()
    }

    /// Whether there is no loop.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    /// Where a segment begins and ends.
    ///
    /// # Panics
    /// If there is no such segment.
    #[must_use]
    pub fn segment(&self, segment: u32) -> [DVec2; 2] {
        self.segments[segment as usize].map(|corner| self.positions[corner as usize])
    }

    /// The corners of a loop.
    ///
    /// # Panics
    /// If there is no such loop.
    #[must_use]
    pub fn corners(&self, number: usize) -> std::ops::Range<u32> {
        self.starts[number]..self.starts[number + 1]
    }

    /// How often the direction of a loop turns around, counterclockwise, exactly: the turning number. Where the loop turns back on
    /// itself, it may be by the left or by the right; so this is the least and the largest number.
    ///
    /// The turning numbers of all curves that bound a surface immersed in the plane add up to its Euler characteristic.
    ///
    /// # Panics
    /// If there is no such loop.
    #[must_use]
    pub fn turning(&self, number: usize) -> [i64; 2] {
        let points: Vec<DVec2> =
            self.loops[number].iter().map(|&corner| self.positions[corner as usize]).collect();
        turning::turning(&points)
    }

    /// The loop of each corner.
    pub(super) fn loop_of(&self, corner: u32) -> usize {
        self.starts.partition_point(|&start| start <= corner) - 1
    }

    /// The corner before one in its loop, which is also the segment that ends there.
    pub(super) fn before(&self, corner: u32) -> u32 {
        let range = self.corners(self.loop_of(corner));
        if corner == range.start { range.end - 1 } else { corner - 1 }
    }
}
