//! Proof that a mesh of an area is right: [`verify_area`].
//!
//! # What it checks
//! * *Copies*: each cell that the curves do not meet has as many quadrilaterals as they wind around it, and each other cell at least as many
//!   as they wind around any of its corners. The winding numbers are counted along rows of nodes, exactly, which the mesher does not do.
//! * *Euler characteristics*: that of each component is the sum of the turning numbers of the curves in it.
//! * *Embedding*: whoever walks along a curve stays in the mesh. The quadrilaterals that hold a segment have their common sides in common, and
//!   those that hold two segments which meet are the same where they do.
//!
//! # Method
//! Only the mesh and its hosts are read, nothing of how they were made. Complexity: linear in cells of the grid, near linear in quadrilaterals
//! and segments in them.

use std::fmt;

use rayon::prelude::*;
use welter_predicates::{Sign, orient2d};

use super::quad_mesh::SIDES;
use super::{AreaMesh, ClosedPolylines};
use crate::grid::Grid2;
use crate::volumetric::Findings;
use crate::{Cancelled, DVec2, Monitor};

/// Something that is not as it must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AreaFinding {
    /// A cell has another number of quadrilaterals than the curves wind around it, or fewer than that if they meet it.
    Copies {
        /// Index of the cell.
        cell: [u32; 2],
        /// How many quadrilaterals it has.
        quadrilaterals: u32,
        /// How often the curves wind around it: at most, if they meet the cell.
        winding: i32,
    },
    /// A component's Euler characteristic is not the sum of the turning numbers of its curves.
    Euler {
        /// The component.
        component: u32,
        /// Its Euler characteristic.
        characteristic: i64,
        /// The sum, at least and at most: where a curve turns back on itself the turn may be to either side.
        turning: [i64; 2],
    },
    /// Corners of one curve lie in different components.
    Torn {
        /// A corner.
        corner: u32,
        /// Its component, and that of the first corner of its curve.
        components: [u32; 2],
    },
    /// The quadrilaterals of a segment in two neighbouring cells have another side than their common one, or none, in common; or they
    /// are two on one cell.
    Side {
        /// The segment.
        segment: u32,
        /// The quadrilaterals.
        quadrilaterals: [u32; 2],
    },
    /// The quadrilateral that holds a corner does not hold a segment that begins or ends there.
    Corner {
        /// The corner.
        corner: u32,
        /// The segment.
        segment: u32,
    },
}

impl fmt::Display for AreaFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Copies { cell: [i, j], quadrilaterals, winding } => write!(
                f,
                "cell ({i}, {j}) has {quadrilaterals} quadrilaterals, the curves wind {winding} times around it"
            ),
            Self::Euler { component, characteristic, turning: [least, most] } => {
                write!(
                    f,
                    "component {component} has Euler characteristic {characteristic}, its curves turn {least}"
                )?;
                if least < most { write!(f, " to {most} times") } else { f.write_str(" times") }
            }
            Self::Torn { corner, components: [a, b] } => {
                write!(f, "corner {corner} lies in component {a}, the first of its curve in {b}")
            }
            Self::Side { segment, quadrilaterals: [a, b] } => {
                write!(f, "quadrilaterals {a} and {b} of segment {segment} do not have their side in common")
            }
            Self::Corner { corner, segment } => {
                write!(f, "corner {corner} lies in a quadrilateral that segment {segment} is not in")
            }
        }
    }
}

/// What was found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[must_use]
pub struct AreaVerification {
    /// Cells with a wrong number of copies.
    pub winding_copies: Findings<AreaFinding>,
    /// Components of a wrong Euler characteristic.
    pub euler: Findings<AreaFinding>,
    /// Places where the curves leave the mesh.
    pub embedding: Findings<AreaFinding>,
    /// How many cells' copies were compared, apart from those that the curves meet.
    pub cells: u64,
    /// The Euler characteristic of each component.
    pub characteristics: Vec<i64>,
}

impl AreaVerification {
    /// Whether all is as it must be.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.winding_copies.none() && self.euler.none() && self.embedding.none()
    }

    /// Everything that was listed.
    pub fn findings(&self) -> impl Iterator<Item = &AreaFinding> {
        [&self.winding_copies, &self.euler, &self.embedding].into_iter().flat_map(|findings| &findings.first)
    }
}

/// Checks the mesh of an area against its curves.
///
/// ```
/// use welter_meshing::{DVec2, Monitor};
/// use welter_meshing::volumetric::{Resolution, VolumeParameters, plane::{ClosedPolylines, mesh_area, verify_area}};
/// let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from_array);
/// let curves = ClosedPolylines::new(square.to_vec(), vec![vec![0, 1, 2, 3]])?;
/// let parameters = VolumeParameters { resolution: Resolution::ShortestSide(8), ..VolumeParameters::default() };
/// let area = mesh_area(&curves, &parameters, &Monitor::none())?;
/// let verification = verify_area(&curves, &area, &Monitor::none())?;
/// assert!(verification.passed());
/// assert_eq!(verification.characteristics, [1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Cancelled`] by the monitor.
pub fn verify_area(
    curves: &ClosedPolylines,
    area: &AreaMesh,
    monitor: &Monitor<'_>,
) -> Result<AreaVerification, Cancelled> {
    let (winding_copies, cells) = copies(curves, area, monitor)?;
    let turnings: Vec<[i64; 2]> = (0..curves.loops().len()).map(|number| curves.turning(number)).collect();
    let (euler, characteristics) = euler(curves, &turnings, area);
    let embedding = embedding(curves, area, monitor)?;
    Ok(AreaVerification { winding_copies, euler, embedding, cells, characteristics })
}

/// Where a segment crosses a row of nodes.
struct Crossing {
    row: u32,
    /// The first node of the row that lies right of the segment, all nodes moved by less than anything, along x more than along y.
    node: u32,
    /// What it adds to the winding numbers from there on.
    step: i32,
}

/// Cells with a wrong number of copies, and how many cells had to have exactly as many.
fn copies(
    curves: &ClosedPolylines,
    area: &AreaMesh,
    monitor: &Monitor<'_>,
) -> Result<(Findings<AreaFinding>, u64), Cancelled> {
    let mesh = &area.mesh;
    let grid = mesh.grid();
    let [nx, ny] = grid.cells();
    let crossings = crossings(curves, grid, monitor)?;
    let mut touched: Vec<u64> =
        area.hosts.segments.iter().map(|pair| mesh.cells()[pair[0] as usize]).collect();
    touched.dedup();
    let numbers = |row: u32| -> Vec<i32> {
        let begin = crossings.partition_point(|crossing| crossing.row < row);
        let mut steps = vec![0; nx as usize + 1];
        for crossing in crossings[begin..].iter().take_while(|crossing| crossing.row == row) {
            if let Some(step) = steps.get_mut(crossing.node as usize) {
                *step += crossing.step;
            }
        }
        let mut winding = 0;
        steps.iter_mut().for_each(|step| {
            winding += *step;
            *step = winding;
        });
        steps
    };
    let stage = monitor.stage("check of copies", u64::from(ny));
    let found: Vec<(Findings<AreaFinding>, u64)> = (0..ny)
        .into_par_iter()
        .map(|j| {
            stage.check()?;
            let (below, above) = (numbers(j), numbers(j + 1));
            let (mut findings, mut compared) = (Findings::default(), 0);
            let begin = grid.cell_index([0, j]) as u64;
            let mut place = mesh.cells().partition_point(|&c| c < begin);
            let mut touch = touched.partition_point(|&c| c < begin);
            for (i, cell) in (0..nx).zip(begin..) {
                let before = place;
                while mesh.cells().get(place) == Some(&cell) {
                    place += 1;
                }
                let quadrilaterals = (place - before) as u32;
                let is_touched = touched.get(touch) == Some(&cell);
                let at = i as usize;
                let winding = if is_touched {
                    touch += 1;
                    [below[at], below[at + 1], above[at], above[at + 1]].into_iter().fold(0, i32::max)
                } else {
                    compared += 1;
                    below[at]
                };
                let difference = i64::from(quadrilaterals) - i64::from(winding);
                if difference < 0 || (difference > 0 && !is_touched) {
                    findings.add(AreaFinding::Copies { cell: [i, j], quadrilaterals, winding });
                }
            }
            stage.advance(1);
            Ok((findings, compared))
        })
        .collect::<Result<_, Cancelled>>()?;
    let compared = found.iter().map(|(_, compared)| compared).sum();
    Ok((Findings::merge(found.into_iter().map(|(findings, _)| findings)), compared))
}

/// Where the curves cross the rows of nodes, by row.
fn crossings(
    curves: &ClosedPolylines,
    grid: &Grid2,
    monitor: &Monitor<'_>,
) -> Result<Vec<Crossing>, Cancelled> {
    const CHUNK: u32 = 1024;
    let rows = grid.nodes()[1];
    // The first row at a height or above.
    let row_from =
        |y: f64| first(rows, (y - grid.origin()[1]) / grid.spacing(), |j| grid.coordinate(1, j) >= y);
    let count = curves.len() as u32;
    let stage = monitor.stage("check of copies: rows", u64::from(count));
    let mut crossings = Vec::new();
    for segment in 0..count {
        if segment % CHUNK == 0 {
            stage.check()?;
        }
        let [p, q] = curves.segment(segment);
        // To the left of what goes up the winding number is larger by one.
        let (low, high, step) = if p.y <= q.y { (p, q, -1) } else { (q, p, 1) };
        for row in row_from(low.y)..row_from(high.y) {
            crossings.push(Crossing { row, node: first_right(grid, low, high, row), step });
        }
        stage.advance(1);
    }
    crossings.sort_by_key(|crossing| crossing.row);
    Ok(crossings)
}

/// The first node of a row that lies right of a segment that goes up through the row, or on it.
fn first_right(grid: &Grid2, low: DVec2, high: DVec2, row: u32) -> u32 {
    let y = grid.coordinate(1, row);
    let x = low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y));
    let right = |i: u32| orient2d(low, high, grid.position([i, row])) != Sign::Positive;
    first(grid.nodes()[0], (x - grid.origin()[0]) / grid.spacing(), right)
}

/// The first of `count` numbers that a rule holds for, which does from there on; `count` if there is none. The search begins at a guess.
fn first(count: u32, guess: f64, holds: impl Fn(u32) -> bool) -> u32 {
    // What is no number becomes 0.
    let mut number = (guess.clamp(0.0, f64::from(count)) as u32).min(count);
    while number > 0 && holds(number - 1) {
        number -= 1;
    }
    while number < count && !holds(number) {
        number += 1;
    }
    number
}

/// Components that are not what the curves in them bound, and the Euler characteristic of each component.
pub(super) fn euler(
    curves: &ClosedPolylines,
    turnings: &[[i64; 2]],
    area: &AreaMesh,
) -> (Findings<AreaFinding>, Vec<i64>) {
    let (of, characteristics) = area.mesh.components();
    let component = |corner: u32| of[area.hosts.corners[corner as usize].quadrilateral as usize];
    let mut findings = Findings::default();
    let mut sums = vec![[0, 0]; characteristics.len()];
    for (number, turning) in turnings.iter().enumerate() {
        let corners = curves.corners(number);
        let first = component(corners.start);
        if let Some(torn) = corners.clone().find(|&corner| component(corner) != first) {
            findings.add(AreaFinding::Torn { corner: torn, components: [component(torn), first] });
        }
        for (sum, turning) in sums[first as usize].iter_mut().zip(turning) {
            *sum += turning;
        }
    }
    for (component, (&turning, &characteristic)) in (0..).zip(sums.iter().zip(&characteristics)) {
        let [least, most] = turning;
        if !(least..=most).contains(&characteristic) {
            findings.add(AreaFinding::Euler { component, characteristic, turning });
        }
    }
    (findings, characteristics)
}

/// Where the curves leave the mesh.
fn embedding(
    curves: &ClosedPolylines,
    area: &AreaMesh,
    monitor: &Monitor<'_>,
) -> Result<Findings<AreaFinding>, Cancelled> {
    const CHUNK: usize = 1024;
    let mesh = &area.mesh;
    // Sorted by segment, then by quadrilateral and so by cell.
    let mut pairs: Vec<[u32; 2]> = area.hosts.segments.iter().map(|&[q, segment]| [segment, q]).collect();
    pairs.par_sort_unstable();
    let count = curves.len() as u32;
    let stage = monitor.stage("check of the embedding", u64::from(count));
    let lists: Vec<Findings<AreaFinding>> = (0..count.div_ceil(CHUNK as u32))
        .into_par_iter()
        .map(|chunk| {
            stage.check()?;
            let segments = chunk * CHUNK as u32..count.min((chunk + 1) * CHUNK as u32);
            let mut findings = Findings::default();
            for segment in segments.clone() {
                let begin = pairs.partition_point(|pair| pair[0] < segment);
                let end = begin + pairs[begin..].partition_point(|pair| pair[0] == segment);
                sides(area, &pairs[begin..end], &mut findings);
                let host = area.hosts.corners[segment as usize].quadrilateral;
                for of_corner in [segment, curves.before(segment)] {
                    if pairs.binary_search(&[of_corner, host]).is_err() {
                        findings.add(AreaFinding::Corner { corner: segment, segment: of_corner });
                    }
                }
            }
            stage.advance(segments.len() as u64);
            Ok(findings)
        })
        .collect::<Result<_, Cancelled>>()?;
    debug_assert!(pairs.iter().all(|pair| (pair[1] as usize) < mesh.len()), "hosts are of the mesh");
    Ok(Findings::merge(lists))
}

/// The quadrilaterals of a segment in neighbouring cells have the side between in common.
fn sides(area: &AreaMesh, of_segment: &[[u32; 2]], findings: &mut Findings<AreaFinding>) {
    let mesh = &area.mesh;
    let cell_of = |pair: &[u32; 2]| mesh.cells()[pair[1] as usize];
    let [nx, _] = mesh.grid().cells();
    for (place, pair) in of_segment.iter().enumerate() {
        let [segment, quadrilateral] = *pair;
        let cell = cell_of(pair);
        if let Some(next) = of_segment.get(place + 1).filter(|next| cell_of(next) == cell) {
            findings.add(AreaFinding::Side { segment, quadrilaterals: [quadrilateral, next[1]] });
        }
        let index = mesh.grid().cell_at(cell as usize);
        for (axis, step) in [1, u64::from(nx)].into_iter().enumerate() {
            if index[axis] + 1 == mesh.grid().cells()[axis] {
                continue;
            }
            let at = of_segment.partition_point(|pair| cell_of(pair) < cell + step);
            let Some(other) = of_segment.get(at).filter(|other| cell_of(other) == cell + step) else {
                continue;
            };
            let [a, b] = [quadrilateral, other[1]].map(|q| mesh.quadrilaterals()[q as usize]);
            let [lower, upper] = [SIDES[2 * axis], SIDES[2 * axis + 1]];
            // The sides run counterclockwise, so against each other.
            if a[upper[0]] != b[lower[1]] || a[upper[1]] != b[lower[0]] {
                findings.add(AreaFinding::Side { segment, quadrilaterals: [quadrilateral, other[1]] });
            }
        }
    }
}
