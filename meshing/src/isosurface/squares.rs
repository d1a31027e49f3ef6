//! Marching squares, the twin of marching cubes in the plane: [`SquareCase`], [`marching_squares`].
//!
//! # What it promises
//! * The 16 cases by the convex-hull rule: the region of a square is the convex polygon of its negative corners and samples, so diagonal negative corners are
//!   joined; the same rule as on a face of [`CellCase`](super::CellCase).
//! * Wherever the samples lie on their edges, the triangles of a case are positively oriented and tile its polygon: all corners of it lie on the
//!   rim of the square, in order, so it stays convex.
//! * The contours of any samples do not meet themselves or one another; they are closed or end at the grid's wall.
//!
//! # What it does not promise
//! The same contours for the opposite samples, where diagonal corners differ.
//!
//! # Complexity
//! One pass over the samples, in two rows of numbers.

use super::IsosurfaceError;
use super::crossing::{level_between, require_room};
use super::cubes::{DEFAULT_MARGIN, require_level_and_margin};
use crate::grid::Samples;
use crate::{DVec2, Monitor};

/// The corners of a square, counterclockwise.
const AROUND: [u8; 4] = [0, 1, 3, 2];

/// The edges between one corner of [`AROUND`] and the next.
const SIDES: [u8; 4] = [0, 3, 1, 2];

/// A point of a square: a corner, or the sample on an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SquarePoint {
    /// Corner `c`, at `(c & 1, c >> 1)`.
    Corner(u8),
    /// The sample on edge `e`: along axis `e / 2`, at the lower (`e % 2 == 0`) or upper side.
    Edge(u8),
}

impl SquarePoint {
    /// The two corners at the ends of the edge, the lower first; a corner twice.
    ///
    /// # Panics
    /// If there is no such edge.
    #[must_use]
    pub fn ends(self) -> [u8; 2] {
        match self {
            Self::Corner(corner) => [corner; 2],
            Self::Edge(edge) => [[0, 1], [2, 3], [0, 2], [1, 3]][usize::from(edge)],
        }
    }
}

/// Which corners of a square are negative: bit `c` for corner `c`.
///
/// ```
/// use welter_meshing::isosurface::{SquareCase, SquarePoint::{Corner, Edge}};
/// let case = SquareCase(0b0001); // the corner at the origin
/// assert_eq!(case.polygon(), [Corner(0), Edge(0), Edge(2)]);
/// assert_eq!(case.segments().collect::<Vec<_>>(), [[Edge(0), Edge(2)]]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SquareCase(pub u8);

impl SquareCase {
    /// Whether a corner is negative; not if there is no such corner.
    #[must_use]
    pub fn is_negative(self, corner: u8) -> bool {
        corner < 4 && self.0 >> corner & 1 == 1
    }

    /// The negative part, a convex polygon, counterclockwise from its lowest negative corner; empty if there is none.
    #[must_use]
    pub fn polygon(self) -> Vec<SquarePoint> {
        let mut polygon = Vec::with_capacity(6);
        for (i, corner) in AROUND.into_iter().enumerate() {
            if self.is_negative(corner) {
                polygon.push(SquarePoint::Corner(corner));
            }
            if self.is_negative(corner) != self.is_negative(AROUND[(i + 1) % 4]) {
                polygon.push(SquarePoint::Edge(SIDES[i]));
            }
        }
        let lowest = polygon.iter().position(|p| Some(p) == polygon.iter().min()).unwrap_or(0);
        polygon.rotate_left(lowest);
        polygon
    }

    /// The contour's segments, at most two: the negative part is on their left.
    pub fn segments(self) -> impl Iterator<Item = [SquarePoint; 2]> {
        let polygon = self.polygon();
        let next = polygon.iter().copied().cycle().skip(1);
        let pairs: Vec<_> = polygon.iter().copied().zip(next).map(|(a, b)| [a, b]).collect();
        pairs.into_iter().filter(|pair| pair.iter().all(|p| matches!(p, SquarePoint::Edge(_))))
    }

    /// Triangles that tile the negative part, counterclockwise; the first corner of each is the lowest negative corner.
    pub fn triangles(self) -> impl Iterator<Item = [SquarePoint; 3]> {
        let polygon = self.polygon();
        (2..polygon.len()).map(move |i| [polygon[0], polygon[i - 1], polygon[i]])
    }
}

/// Parameters of [`marching_squares`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarchingSquares {
    /// The contour is where the samples have this value; finite. Default 0.
    pub level: f64,
    /// As [`MarchingCubes::margin`](super::MarchingCubes::margin), with the same default.
    pub margin: f64,
}

impl Default for MarchingSquares {
    fn default() -> Self {
        Self { level: 0.0, margin: DEFAULT_MARGIN }
    }
}

impl MarchingSquares {
    /// Refuses parameters out of range.
    ///
    /// # Errors
    /// [`IsosurfaceError::Parameter`].
    pub fn validate(&self) -> Result<(), IsosurfaceError> {
        require_level_and_margin(self.level, self.margin)
    }
}

/// Lines on which samples in the plane have a level.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contours {
    /// Where the vertices are; each on an edge of the grid.
    pub positions: Vec<DVec2>,
    /// Pairs of vertices; where the samples are below the level is on the left. A vertex begins at most one of them and ends at most one.
    pub segments: Vec<[u32; 2]>,
}

impl Contours {
    /// The segments joined end to end: runs of vertices. A run that is closed has its first vertex again at its end. Of two segments that
    /// begin at one vertex, which contours have not, the first is left out.
    ///
    /// # Panics
    /// If a segment has a vertex without a position.
    #[must_use]
    pub fn lines(&self) -> Vec<Vec<u32>> {
        const NONE: u32 = u32::MAX;
        let (mut next, mut has_previous) =
            (vec![NONE; self.positions.len()], vec![false; self.positions.len()]);
        for &[a, b] in &self.segments {
            next[a as usize] = b;
            has_previous[b as usize] = true;
        }
        let vertices = 0..self.positions.len();
        // Lines that begin at the wall first, so that what is left is closed.
        let (ends, others): (Vec<usize>, Vec<usize>) = vertices.partition(|&v| !has_previous[v]);
        let mut lines = Vec::new();
        for start in ends.into_iter().chain(others) {
            if next[start] == NONE {
                continue;
            }
            let mut line = vec![start as u32];
            let mut at = start;
            while next[at] != NONE {
                let to = std::mem::replace(&mut next[at], NONE);
                line.push(to);
                at = to as usize;
            }
            lines.push(line);
        }
        lines
    }
}

/// The contours of samples at a level. A sample that equals the level counts as larger; infinite samples are allowed, and have
/// the contour as near to their finite neighbours as the margin lets it.
///
/// ```
/// use welter_meshing::{Monitor, grid::{Grid2, Samples}, isosurface::{MarchingSquares, marching_squares}};
/// let grid = Grid2::covering([-1.0; 2], [1.0; 2], 0.125, 1)?;
/// let disc = (0..grid.node_count()).map(|n| grid.position(grid.node_at(n)).length() - 0.9).collect();
/// let contours = marching_squares(&Samples::new(grid, disc), &MarchingSquares::default(), &Monitor::none())?;
/// let lines = contours.lines();
/// assert_eq!(lines.len(), 1);
/// assert_eq!(lines[0].first(), lines[0].last()); // closed
/// assert!(contours.positions.iter().all(|p| (p.length() - 0.9).abs() < 0.01));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// As [`marching_cubes`](super::marching_cubes).
pub fn marching_squares(
    samples: &Samples<2>,
    parameters: &MarchingSquares,
    monitor: &Monitor<'_>,
) -> Result<Contours, IsosurfaceError> {
    parameters.validate()?;
    samples.require_numbers()?;
    let grid = samples.grid();
    require_room(grid, parameters.margin)?;
    let [nx, ny] = grid.nodes();
    let stage = monitor.stage("contours", u64::from(ny));
    let mut contours = Contours::default();
    // Numbers of the samples on the x-edges of the row below and of this row, and on the y-edges between them.
    let [mut below, mut here, mut between] = [(); 3].map(|()| vec![0_u32; nx as usize]);
    for j in 0..ny {
        stage.check()?;
        number_edges(samples, parameters, 0, j, &mut here, &mut contours)?;
        if j > 0 {
            number_edges(samples, parameters, 1, j - 1, &mut between, &mut contours)?;
            for i in 0..nx - 1 {
                let case = case_of(samples, parameters.level, [i, j - 1]);
                if case.0 == 0 || case.0 == 15 {
                    continue;
                }
                let i = i as usize;
                let numbers = [below[i], here[i], between[i], between[i + 1]];
                contours.segments.extend(case.segments().map(|pair| {
                    pair.map(|point| match point {
                        SquarePoint::Edge(edge) => numbers[usize::from(edge)],
                        SquarePoint::Corner(_) => unreachable!("segments join samples"),
                    })
                }));
            }
        }
        std::mem::swap(&mut below, &mut here);
        stage.advance(1);
    }
    Ok(contours)
}

fn case_of(samples: &Samples<2>, level: f64, [i, j]: [u32; 2]) -> SquareCase {
    let corners = [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]];
    SquareCase((0..4).map(|c| u8::from(samples.at(corners[c]) < level) << c).sum())
}

/// Makes the vertices on the edges along `axis` that begin in row `j`, and notes their numbers.
fn number_edges(
    samples: &Samples<2>,
    parameters: &MarchingSquares,
    axis: usize,
    j: u32,
    numbers: &mut [u32],
    contours: &mut Contours,
) -> Result<(), IsosurfaceError> {
    let grid = samples.grid();
    let edges = grid.nodes()[0] - if axis == 0 { 1 } else { 0 };
    for i in 0..edges {
        let (start, mut end) = ([i, j], [i, j]);
        end[axis] += 1;
        let values = [start, end].map(|node| samples.at(node));
        if (values[0] < parameters.level) == (values[1] < parameters.level) {
            continue;
        }
        let at = level_between(values, parameters.level).clamp(parameters.margin, 1.0 - parameters.margin);
        let mut position = grid.position(start);
        position[axis] += at * grid.spacing();
        let count = contours.positions.len();
        numbers[i as usize] = u32::try_from(count)
            .map_err(|_| IsosurfaceError::TooMany { what: "vertices", count: count as u64 })?;
        contours.positions.push(position);
    }
    Ok(())
}
