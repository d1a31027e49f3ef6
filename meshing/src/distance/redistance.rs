//! The distance to the zero contour of any level set: [`redistance`].
//!
//! # What it computes
//! From samples of a function the samples of the signed distance to its zero contour, with the same signs.
//!
//! # What it promises
//! * A node next to the contour (see `interface.rs`) has the distance to the contour of the piecewise linear interpolant, exactly
//!   but for a few roundings: the contour is displaced by O(h^2) for spacing h.
//! * All other nodes solve the upwind equations of `|gradient d| = 1` to the tolerance, which has an error of O(h log(1/h)) \[Zhao05\].
//! * The same bits for any number of threads.
//!
//! # What it does not promise
//! Exact distances away from the contour: for a surface in triangles there is
//! [`signed_distance`](super::signed_distance). The order is lost near points where the contour has corners.
//!
//! # Method
//! Fast sweeping \[Zhao05\]: nodes next to the contour are fixed, all others start at infinity; Godunov's upwind scheme is solved at each
//! node in turn, in the `2^D` orders in which the axes may be run through, again and again until nothing changes. Information
//! flows along straight lines, each of which some order follows, so that a fixed number of rounds is enough on
//! any grid. A sweep uses values of its own, so it runs on one thread; the values next to the contour are found in parallel.
//!
//! # Complexity
//! O(nodes) a sweep, 2^D sweeps a round, two rounds for most level sets (the second finds nothing to do).

use rayon::prelude::*;
use thiserror::Error;

use super::interface::Interface;
use crate::grid::{Grid, NotANumber, Samples};
use crate::{Cancelled, Monitor};

/// When to stop sweeping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RedistanceParameters {
    /// Most sweeps; at least 1. Default: 64, eight rounds in three dimensions, where two are usual.
    pub max_sweeps: u32,
    /// Largest change of a value in a round at which no further round is made, as a part of the spacing; not
    /// negative. Default: 1e-12, four digits above rounding on a grid of 1000 nodes along an axis.
    pub tolerance_rel: f64,
}

impl Default for RedistanceParameters {
    fn default() -> Self {
        Self { max_sweeps: 64, tolerance_rel: 1e-12 }
    }
}

impl RedistanceParameters {
    /// # Errors
    /// [`RedistanceError::Parameter`].
    pub fn validate(&self) -> Result<(), RedistanceError> {
        if self.max_sweeps == 0 {
            return Err(RedistanceError::Parameter {
                parameter: "max_sweeps",
                value: 0.0,
                range: "at least 1",
            });
        }
        if self.tolerance_rel.is_nan() || self.tolerance_rel < 0.0 {
            let (parameter, value) = ("tolerance_rel", self.tolerance_rel);
            return Err(RedistanceError::Parameter { parameter, value, range: "at least 0" });
        }
        Ok(())
    }
}

/// Why a level set was not redistanced.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RedistanceError {
    /// A parameter is out of its range.
    #[error("{parameter} is {value}, must be {range}")]
    Parameter {
        /// Its field name.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// The range it must lie in.
        range: &'static str,
    },
    /// A sample is NaN.
    #[error(transparent)]
    NotANumber(#[from] NotANumber),
    /// By the monitor.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// How the sweeps went.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct RedistanceReport {
    /// Nodes next to the zero contour. If there are none, all distances are infinite.
    pub beside_contour: usize,
    /// Sweeps made.
    pub sweeps: u32,
    /// Largest change of a value in the last round, in spacings.
    pub last_change: f64,
    /// Whether that is within the tolerance.
    pub converged: bool,
}

/// The signed distance to the zero contour of a level set of two or three dimensions.
///
/// Values may be infinite, which counts as very large. Without a zero contour every distance is infinite, with the
/// sign of the value.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, distance::{RedistanceParameters, redistance}, grid::{Grid3, Samples}};
/// let grid = Grid3::covering([-1.0; 3], [1.0; 3], 0.125, 0)?;
/// let steep = Samples::of(&grid, &|p: DVec3| 7.0 * (p.length_squared() - 0.25), &Monitor::none())?;
/// let (distances, report) = redistance(&steep, &RedistanceParameters::default(), &Monitor::none())?;
/// assert!(report.converged);
/// assert!((distances.at([16, 8, 8]) - 0.5).abs() < 0.02); // at (1, 0, 0)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RedistanceError`]: parameters out of range, a sample that is NaN, or cancelled by the monitor.
pub fn redistance<const D: usize>(
    level_set: &Samples<D>,
    parameters: &RedistanceParameters,
    monitor: &Monitor<'_>,
) -> Result<(Samples<D>, RedistanceReport), RedistanceError> {
    const { assert!(D == 2 || D == 3, "level sets of two or three dimensions") };
    parameters.validate()?;
    level_set.require_numbers()?;
    let grid = level_set.grid();
    let interface = Interface { grid, values: level_set.values() };
    let beside: Vec<Option<f64>> = (0..grid.node_count())
        .into_par_iter()
        .with_min_len(1024)
        .map(|node| interface.distance(grid.node_at(node)))
        .collect();
    let beside_contour = beside.par_iter().filter(|distance| distance.is_some()).count();
    let mut sweeps = Sweeps::new(grid, &beside);
    drop(beside);
    let mut report = RedistanceReport { beside_contour, sweeps: 0, last_change: 0.0, converged: true };
    if beside_contour > 0 {
        sweeps.run(parameters, monitor, &mut report)?;
    }
    let spacing = grid.spacing();
    let signed = |(value, distance): (&f64, &f64)| (distance * spacing).copysign(*value);
    let values = level_set.values().par_iter().zip(&sweeps.distances).map(signed).collect();
    Ok((Samples::new(*grid, values), report))
}

/// Distances in spacings while they are swept.
struct Sweeps<const D: usize> {
    nodes: [usize; D],
    distances: Vec<f64>,
    fixed: Vec<bool>,
}

impl<const D: usize> Sweeps<D> {
    fn new(grid: &Grid<D>, beside: &[Option<f64>]) -> Self {
        Self {
            nodes: grid.nodes().map(|n| n as usize),
            distances: beside.iter().map(|distance| distance.unwrap_or(f64::INFINITY)).collect(),
            fixed: beside.iter().map(Option::is_some).collect(),
        }
    }

    fn run(
        &mut self,
        parameters: &RedistanceParameters,
        monitor: &Monitor<'_>,
        report: &mut RedistanceReport,
    ) -> Result<(), Cancelled> {
        let stage = monitor.stage("sweeps", 0);
        loop {
            report.last_change = 0.0;
            for order in 0..1 << D {
                if report.sweeps == parameters.max_sweeps {
                    // An unfinished round proves nothing.
                    report.converged = false;
                    return Ok(());
                }
                stage.check()?;
                report.last_change = self.sweep(order).max(report.last_change);
                report.sweeps += 1;
                stage.advance(1);
            }
            report.converged = report.last_change <= parameters.tolerance_rel;
            if report.converged {
                return Ok(());
            }
        }
    }

    /// One pass over all nodes, backward along the axes whose bit is set; returns the largest change.
    fn sweep(&mut self, order: usize) -> f64 {
        let mut change: f64 = 0.0;
        let rows: usize = self.nodes[1..].iter().product();
        let length = self.nodes[0];
        for row in 0..rows {
            // The row's index along the other axes, and its neighbours' offsets.
            let (mut rest, mut stride, mut first) = (row, length, 0);
            let mut sides = [[None; 2]; 3];
            for (axis, &count) in self.nodes.iter().enumerate().skip(1) {
                let along = rest % count;
                rest /= count;
                let i = if order >> axis & 1 == 1 { count - 1 - along } else { along };
                first += i * stride;
                sides[axis] = [(i > 0).then_some(stride), (i + 1 < count).then_some(stride)];
                stride *= count;
            }
            for along in 0..length {
                let i = if order & 1 == 1 { length - 1 - along } else { along };
                sides[0] = [(i > 0).then_some(1), (i + 1 < length).then_some(1)];
                change = change.max(self.update(first + i, &sides));
            }
        }
        change
    }

    /// Solves the upwind equation at a node; returns by how much its distance fell.
    #[inline(always)]
    fn update(&mut self, node: usize, sides: &[[Option<usize>; 2]; 3]) -> f64 {
        if self.fixed[node] {
            return 0.0;
        }
        let at = |place: Option<usize>| place.map_or(f64::INFINITY, |place| self.distances[place]);
        let mut nearer = [f64::INFINITY; 3];
        for (nearer, [before, after]) in nearer.iter_mut().zip(&sides[..D]) {
            *nearer = at(before.map(|s| node - s)).min(at(after.map(|s| node + s)));
        }
        let old = self.distances[node];
        if nearer[0].min(nearer[1]).min(nearer[2]) >= old {
            return 0.0;
        }
        let new = upwind(nearer);
        if new < old {
            self.distances[node] = new;
            old - new
        } else {
            0.0
        }
    }
}

/// The solution x of `sum of max(x - a, 0)^2 = 1` over the nearer neighbour's distance `a` along each axis, of which one at least is
/// finite.
#[inline(always)]
fn upwind([a, b, c]: [f64; 3]) -> f64 {
    let (low, high) = (a.min(b), a.max(b));
    let (first, second, third) = (low.min(c), low.max(c).min(high), high.max(c));
    let one = first + 1.0;
    if one <= second {
        return one;
    }
    // Differences to the first: no digits are lost far from the contour.
    let s = second - first;
    let two = 0.5 * (s + (2.0 - s * s).sqrt());
    if first + two <= third {
        return first + two;
    }
    let t = third - first;
    let sum = s + t;
    first + (sum + (sum * sum - 3.0 * (s * s + t * t - 1.0)).max(0.0).sqrt()) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_upwind_equation_is_solved() {
        for a in [0.0, 0.3, 5.0] {
            for b in [a, a + 0.2, a + 0.999, a + 1.0, f64::INFINITY] {
                for c in [b, a, a + 0.5, a + 7.0, f64::INFINITY] {
                    for order in [[a, b, c], [c, a, b], [b, c, a], [c, b, a]] {
                        let x = upwind(order);
                        let sum: f64 = order.iter().map(|&y| (x - y).max(0.0).powi(2)).sum();
                        assert!((sum - 1.0).abs() < 1e-14, "{order:?}: {x}");
                    }
                }
            }
        }
    }
}
