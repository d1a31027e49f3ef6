//! A quantity known inside of a level set, carried outward along its normals: [`extrapolate`].
//!
//! # What it computes
//! At nodes where the level set `phi` is positive a quantity `q` with `grad q . grad phi = 0` (constant along normals), or
//! with a derivative along the normal that is itself constant along normals (linear) \[Aslam04\].
//!
//! # What it promises
//! * The solution of the upwind equations, exactly but for roundings, in one pass: each node depends on neighbours with a smaller
//!   `phi` only, and nodes are taken in the order of `phi` \[Adalsteinsson99\].
//! * For smooth `q` and `phi`: the scheme is of first order in the spacing h over a length. Within a fixed number of
//!   nodes from the surface the result differs from a smooth continuation of `q` by O(h) if constant, O(h^2) if linear.
//! * Constant extrapolation makes no new extrema: every value lies between values inside.
//! * Every value is finite: linear extrapolation ends at the largest number.
//! * The same bits for any number of threads.
//!
//! # What it does not promise
//! A smooth result where normals meet.
//!
//! # Method
//! With the neighbour k of smaller `phi` along each axis (the smaller of two) and `w = phi - phi_k`:
//!
//! ```text
//! sum of w (q - q_k) = h q_n sqrt(sum of w^2),   q_n = 0 for the constant, itself extrapolated as a constant for the linear
//! ```
//!
//! Inside, `q_n = grad q . grad phi / |grad phi|` from differences of `q` between nodes inside, central where both are.
//!
//! # Complexity
//! O(n log n) for n nodes outside.

use rayon::prelude::*;
use thiserror::Error;

use crate::grid::{Grid, NotANumber, Samples};
use crate::{Cancelled, Monitor};

/// What stays constant along normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Degree {
    /// The quantity.
    #[default]
    Constant,
    /// Its derivative along the normal.
    Linear,
}

/// How far and how smoothly to extrapolate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExtrapolationParameters {
    /// What stays constant. Default: the quantity.
    pub degree: Degree,
    /// Largest value of the level set to which the quantity is carried, for a distance field a length; not negative. Default:
    /// infinite.
    pub band: f64,
}

impl Default for ExtrapolationParameters {
    fn default() -> Self {
        Self { degree: Degree::Constant, band: f64::INFINITY }
    }
}

impl ExtrapolationParameters {
    /// # Errors
    /// [`ExtrapolationError::Band`].
    pub fn validate(&self) -> Result<(), ExtrapolationError> {
        if self.band >= 0.0 { Ok(()) } else { Err(ExtrapolationError::Band { band: self.band }) }
    }
}

/// Why a quantity was not extrapolated.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ExtrapolationError {
    /// The band is no distance.
    #[error("the band is {band}, must be at least 0")]
    Band {
        /// The band asked for.
        band: f64,
    },
    /// The quantity and the level set are on different grids.
    #[error("the quantity is sampled on another grid than the level set")]
    Grids,
    /// A sample of the level set is NaN.
    #[error("level set: {0}")]
    LevelSet(#[from] NotANumber),
    /// The quantity is not finite at a node where the level set is not positive.
    #[error("the quantity is {value} at node {node:?}, where the level set is not positive")]
    Quantity {
        /// The index of the first such node along each axis.
        node: Vec<u32>,
        /// The quantity there.
        value: f64,
    },
    /// By the monitor.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// How many nodes got a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use]
pub struct ExtrapolationReport {
    /// Nodes outside, within the band, that got a value.
    pub extrapolated: usize,
    /// Nodes outside, within the band, that kept their own: no neighbour has a smaller value of the level set from which the
    /// quantity could come, or the level set is infinite there.
    pub unreached: usize,
}

/// Carries a quantity from the nodes where a level set is at most 0 to those where it is positive, along normals.
///
/// Nodes with a level set greater than the band keep their values; whatever the quantity is outside has no influence.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, distance::*, grid::{Grid3, Samples}};
/// let grid = Grid3::covering([-1.0; 3], [1.0; 3], 0.125, 0)?;
/// let ball = Samples::of(&grid, &|p: DVec3| p.length() - 0.5, &Monitor::none())?;
/// let warm = Samples::of(&grid, &|p: DVec3| if p.length() <= 0.5 { 20.0 } else { f64::NAN }, &Monitor::none())?;
/// let (all, report) = extrapolate(&warm, &ball, &ExtrapolationParameters::default(), &Monitor::none())?;
/// assert_eq!(report.unreached, 0);
/// assert!(all.values().iter().all(|&t| t == 20.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ExtrapolationError`]: a bad band, different grids, numbers that are none, or cancelled by the monitor.
pub fn extrapolate<const D: usize>(
    quantity: &Samples<D>,
    level_set: &Samples<D>,
    parameters: &ExtrapolationParameters,
    monitor: &Monitor<'_>,
) -> Result<(Samples<D>, ExtrapolationReport), ExtrapolationError> {
    parameters.validate()?;
    let grid = level_set.grid();
    if quantity.grid() != grid {
        return Err(ExtrapolationError::Grids);
    }
    level_set.require_numbers()?;
    let phi = level_set.values();
    let inside = |node: usize| phi[node] <= 0.0;
    let bad = (0..phi.len()).into_par_iter();
    if let Some(node) = bad.find_first(|&node| inside(node) && !quantity.values()[node].is_finite()) {
        let (value, node) = (quantity.values()[node], grid.node_at(node).to_vec());
        return Err(ExtrapolationError::Quantity { node, value });
    }
    let mut outward = Outward::new(grid, phi, parameters.band);
    let mut values = quantity.values().to_vec();
    let slopes = match parameters.degree {
        Degree::Constant => None,
        Degree::Linear => {
            let mut slopes = normal_derivatives(grid, phi, &values);
            let _same_nodes = outward.carry(&mut slopes, None, monitor)?;
            Some(slopes)
        }
    };
    let report = outward.carry(&mut values, slopes.as_deref(), monitor)?;
    Ok((Samples::new(*grid, values), report))
}

/// The neighbour before and the one after a node along each axis, by number.
fn neighbours<const D: usize>(grid: &Grid<D>, node: usize) -> [[Option<usize>; 2]; D] {
    let index = grid.node_at(node);
    let (nodes, mut stride) = (grid.nodes(), 1);
    std::array::from_fn(|axis| {
        let before = (index[axis] > 0).then(|| node - stride);
        let after = (index[axis] + 1 < nodes[axis]).then(|| node + stride);
        stride *= nodes[axis] as usize;
        [before, after]
    })
}

/// Nodes between checks of the monitor.
const BATCH: usize = 1 << 14;

/// The nodes outside, in the order of the level set.
struct Outward<'a, const D: usize> {
    grid: &'a Grid<D>,
    phi: &'a [f64],
    order: Vec<usize>,
    known: Vec<bool>,
}

impl<'a, const D: usize> Outward<'a, D> {
    fn new(grid: &'a Grid<D>, phi: &'a [f64], band: f64) -> Self {
        let outside = |&node: &usize| phi[node] > 0.0 && phi[node] <= band;
        let mut order: Vec<usize> = (0..phi.len()).filter(outside).collect();
        order.par_sort_unstable_by(|&a, &b| phi[a].total_cmp(&phi[b]).then(a.cmp(&b)));
        Self { grid, phi, order, known: Vec::new() }
    }

    /// Solves the upwind equations with a derivative along the normal, or none, for all nodes outside.
    fn carry(
        &mut self,
        values: &mut [f64],
        slopes: Option<&[f64]>,
        monitor: &Monitor<'_>,
    ) -> Result<ExtrapolationReport, Cancelled> {
        let stage = monitor.stage("extrapolation", self.order.len() as u64);
        self.known = self.phi.iter().map(|&phi| phi <= 0.0 && phi.is_finite()).collect();
        let mut report = ExtrapolationReport { extrapolated: 0, unreached: 0 };
        for batch in self.order.chunks(BATCH) {
            stage.check()?;
            for &node in batch {
                match self.solve(node, values, slopes.map_or(0.0, |slopes| slopes[node])) {
                    Some(value) => {
                        values[node] = value;
                        self.known[node] = true;
                        report.extrapolated += 1;
                    }
                    None => report.unreached += 1,
                }
            }
            stage.advance(batch.len() as u64);
        }
        Ok(report)
    }

    /// The value at a node from its known neighbours of smaller `phi`.
    fn solve(&self, node: usize, values: &[f64], slope: f64) -> Option<f64> {
        let phi = self.phi[node];
        if !phi.is_finite() {
            return None;
        }
        let nearer = neighbours(self.grid, node).map(|sides| {
            let sides = sides.into_iter().flatten().filter(|&k| self.known[k] && self.phi[k] < phi);
            sides.reduce(|a, b| if self.phi[b] < self.phi[a] { b } else { a })
        });
        let weights = nearer.map(|k| k.map_or(0.0, |k| phi - self.phi[k]));
        // Relative to the largest, so that no square overflows.
        let largest = weights.iter().fold(0.0, |a: f64, &b| a.max(b));
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        // Differences to one of the values: equal values have exactly their mean. Quarters where differences overflow.
        let one = nearer.iter().flatten().map(|&k| values[k]).next()?;
        let (mut sum, mut squares, mut mean, mut quarters) = (0.0, 0.0, 0.0, 0.0);
        let (mut low, mut high) = (one, one);
        for (weight, k) in weights.into_iter().zip(nearer) {
            let Some(k) = k else { continue };
            let weight = weight / largest;
            sum += weight;
            squares += weight * weight;
            mean += weight * (values[k] - one);
            quarters += weight * (0.25 * values[k]);
            (low, high) = (low.min(values[k]), high.max(values[k]));
        }
        let mean = if mean.is_finite() { one + mean / sum } else { quarters / sum * 4.0 };
        let value = mean.clamp(low, high) + self.grid.spacing() * slope * squares.sqrt() / sum;
        Some(value.clamp(-f64::MAX, f64::MAX))
    }
}

/// At nodes inside, the derivative of the quantity along the normal; 0 where it cannot be told.
fn normal_derivatives<const D: usize>(grid: &Grid<D>, phi: &[f64], values: &[f64]) -> Vec<f64> {
    let spacing = grid.spacing();
    let at = |node: usize| {
        if !(phi[node] <= 0.0 && phi[node].is_finite()) {
            return 0.0;
        }
        let sides = neighbours(grid, node);
        let normal = sides.map(|sides| difference(node, sides, phi, spacing, |k| phi[k].is_finite()));
        let gradient = sides.map(|sides| difference(node, sides, values, spacing, |k| phi[k] <= 0.0));
        let (mut dot, mut square) = (0.0, 0.0);
        for (n, g) in normal.into_iter().zip(gradient) {
            dot += n * g;
            square += n * n;
        }
        let slope = dot / square.sqrt();
        if slope.is_finite() { slope } else { 0.0 }
    };
    (0..phi.len()).into_par_iter().with_min_len(1024).map(at).collect()
}

/// The derivative along an axis from those neighbours that are of use: central, one-sided, or 0.
fn difference(
    node: usize,
    sides: [Option<usize>; 2],
    values: &[f64],
    spacing: f64,
    of_use: impl Fn(usize) -> bool,
) -> f64 {
    match sides.map(|side| side.filter(|&k| of_use(k))) {
        [Some(a), Some(b)] => (values[b] - values[a]) / (2.0 * spacing),
        [Some(a), None] => (values[node] - values[a]) / spacing,
        [None, Some(b)] => (values[b] - values[node]) / spacing,
        [None, None] => 0.0,
    }
}
