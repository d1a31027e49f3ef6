//! Inelastic impact zones: [`solve`].
//!
//! # What it computes
//! Collisions that share movable vertices form a zone. All collisions of a zone are stopped at once: the ends become those
//! nearest to the ones before, in the metric of masses, for which no pair of the zone approaches along its normal. What
//! collides then joins the zones, until nothing does.
//!
//! # What it promises
//! * The sum of masses times displacements is kept to rounding where no vertex is immovable; kinetic energy does not grow.
//! * A singular system is found out: by its rank, a large one by what iterations leave. It is solved in the least squares
//!   sense all the same where its collisions can be stopped together; a zone whose collisions cannot, or are too many, keeps the ends that it had, and is left
//!   to rigid motions.
//! * It ends after the rounds that the parameters allow; a pair joins its zone at most that many times.
//!
//! # Method
//! \[Harmon08\], as in \[Brochu12, section 3.2.7\]: to minimise `|u' - u|_M` with `C u' = 0`, where row `i` of `C` holds
//! the signed weights of collision `i` times its normal, solve `C M^-1 C^T l = C u`, then `u' = u - M^-1 C^T l`
//! (`least_squares`; for many collisions `conjugate_gradients`). A round starts from the ends of the one before: that is the same, since the
//! projection onto the solutions of more rows is that of the projection onto the solutions of fewer. Complexity: for n collisions of a zone, whose number is bounded, n^3 / 6 operations up to [`DENSE`],
//! then some 50 n for each iteration, of which there are a few hundred.

use super::IntegrationError;
use super::contact::{Contact, ElementPair};
use super::step::Step;
use super::union::Groups;
use super::{conjugate_gradients, least_squares};
use glam::DVec3;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use welter_meshing::surface::VertexId;

/// A zone whose largest approach is down to this part of itself has nothing left that counts: 2^-12.
const SOLVED: f64 = 1.0 / (1 << 12) as f64;

/// Of a zone that is not solved further, at most this part may be left: an eighth. If it still collides, the next round takes as
/// much off that again. What a singular system leaves that cannot be solved is of the order of 1.
const PROGRESS: f64 = 0.125;

/// How often what is left of the approaches is solved for, at most.
const REPETITIONS: usize = 2;

/// Up to so many collisions a zone's system is factorised, which tells the rank; chosen by trial.
const DENSE: usize = 384;

/// Contacts of a pair whose normals differ by less than the angle with this versine (a degree) are one constraint.
const ALIKE: f64 = 1.0 / (1 << 13) as f64;

/// The same for their weights.
const ALIKE_WEIGHTS: f64 = 1.0 / 64.0;

/// Stops all collisions of zones at once, and again, until nothing collides or the rounds are used up.
pub(super) fn solve(step: &mut Step<'_>) -> Result<(), IntegrationError> {
    let vertices = step.ends().len();
    let mut zones = Zones {
        groups: Groups::new(vertices),
        contacts: Vec::new(),
        of_pair: BTreeMap::new(),
        given_up: vec![false; vertices],
    };
    for _ in 0..step.parameters.zone_rounds {
        step.detect()?;
        if step.is_crowded() {
            break;
        }
        let changed = zones.take_in(step);
        if changed.is_empty() {
            break;
        }
        zones.solve(step, &changed);
    }
    step.detect()
}

struct Zones {
    groups: Groups,
    contacts: Vec<Contact>,
    /// Which of them a pair has.
    of_pair: BTreeMap<ElementPair, Vec<usize>>,
    /// By the smallest vertex of a zone: whether it is left to rigid motions.
    given_up: Vec<bool>,
}

impl Zones {
    /// Adds what collides now; tells the zones that have become others and are not given up.
    fn take_in(&mut self, step: &Step<'_>) -> BTreeSet<VertexId> {
        let impact = |&pair: &ElementPair| Some((pair, step.impact(pair)?));
        let contacts: Vec<(ElementPair, Contact)> = step.colliding().par_iter().filter_map(impact).collect();
        let mut touched = Vec::new();
        for (pair, contact) in contacts {
            let mut movable = contact.vertices.into_iter().filter(|&v| step.mobility(v) > 0.0);
            let Some(first) = movable.next() else { continue };
            let mut given_up =
                self.given_up[self.groups.of(first).index()] || step.yielding(&contact).is_none();
            for v in movable {
                given_up |= self.given_up[self.groups.of(v).index()];
                self.groups.merge(first, v);
            }
            self.given_up[self.groups.of(first).index()] = given_up;
            let known = self.of_pair.entry(pair).or_default();
            if !known.iter().any(|&i| alike(&self.contacts[i], &contact)) {
                known.push(self.contacts.len());
                self.contacts.push(contact);
            }
            touched.push(first);
        }
        let zones = touched.into_iter().map(|v| self.groups.of(v));
        zones.filter(|zone| !self.given_up[zone.index()]).collect()
    }

    /// The collisions of some zones, in the order in which they came.
    fn by_zone(&mut self, step: &Step<'_>, of: &BTreeSet<VertexId>) -> Vec<(VertexId, Vec<Contact>)> {
        let mut zones: BTreeMap<VertexId, Vec<Contact>> = BTreeMap::new();
        for contact in &self.contacts {
            let movable = contact.vertices.iter().find(|&&v| step.mobility(v) > 0.0);
            if let Some(zone) = movable.map(|&v| self.groups.of(v)).filter(|zone| of.contains(zone)) {
                zones.entry(zone).or_default().push(*contact);
            }
        }
        zones.into_iter().collect()
    }

    fn solve(&mut self, step: &mut Step<'_>, changed: &BTreeSet<VertexId>) {
        let zones = self.by_zone(step, changed);
        let view: &Step<'_> = step;
        let solved: Vec<Zone> = zones.par_iter().map(|(_, contacts)| Zone::new(view, contacts)).collect();
        for ((zone, contacts), solved) in zones.iter().zip(solved) {
            step.report.largest_impact_zone = step.report.largest_impact_zone.max(contacts.len());
            step.report.singular_systems += usize::from(solved.singular);
            match solved.ends {
                Some(ends) => {
                    step.report.impact_zones += 1;
                    ends.into_iter().for_each(|(v, end)| step.set_end(v, end));
                }
                None => self.given_up[zone.index()] = true,
            }
        }
    }
}

/// Whether two contacts of a pair say the same.
fn alike(a: &Contact, b: &Contact) -> bool {
    let weights = a.weights.iter().zip(&b.weights);
    1.0 - a.normal.dot(b.normal) < ALIKE && weights.into_iter().all(|(a, b)| (a - b).abs() < ALIKE_WEIGHTS)
}

/// What came of a zone.
struct Zone {
    singular: bool,
    /// The ends of its movable vertices, if its collisions could be stopped.
    ends: Option<Vec<(VertexId, DVec3)>>,
}

impl Zone {
    fn new(step: &Step<'_>, contacts: &[Contact]) -> Self {
        if contacts.len() > step.parameters.most_zone_collisions as usize {
            return Self { singular: false, ends: None };
        }
        let mut ends: BTreeMap<VertexId, DVec3> = BTreeMap::new();
        for v in contacts.iter().flat_map(|contact| contact.vertices) {
            ends.insert(v, step.ends()[v.index()]);
        }
        let system = System::new(step, contacts);
        let (mut first, mut left, mut singular) = (None, f64::INFINITY, false);
        for repetition in 0..=REPETITIONS {
            let displacement = |v: VertexId| ends[&v] - step.surface.position(v);
            let approach: Vec<f64> =
                contacts.iter().map(|c| c.normal.dot(c.weighted(c.vertices.map(displacement)))).collect();
            left = approach.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
            if left <= SOLVED * *first.get_or_insert(left) || repetition == REPETITIONS {
                break;
            }
            let impulses = system.solve(&approach, &mut singular);
            for (contact, impulse) in contacts.iter().zip(&impulses) {
                for (&v, weight) in contact.vertices.iter().zip(contact.weights) {
                    if let Some(end) = ends.get_mut(&v).filter(|_| step.mobility(v) > 0.0) {
                        *end -= (weight * step.mobility(v) * impulse) * contact.normal;
                    }
                }
            }
        }
        let stopped = left <= PROGRESS * first.unwrap_or(0.0);
        Self { singular: singular || !stopped, ends: stopped.then(|| ends.into_iter().collect()) }
    }
}

/// The system of a zone.
struct System<'a> {
    contacts: &'a [Contact],
    /// The vertices of each collision by number, and the mobility of each number.
    numbers: Vec<[usize; 4]>,
    mobility: Vec<f64>,
    /// The lower triangle of `C M^-1 C^T`, if there are few collisions.
    rows: Option<Vec<Vec<f64>>>,
}

impl<'a> System<'a> {
    fn new(step: &Step<'_>, contacts: &'a [Contact]) -> Self {
        let mut vertices: Vec<VertexId> = contacts.iter().flat_map(|c| c.vertices).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let number = |v: VertexId| vertices.binary_search(&v).expect("all of them are listed");
        let numbers: Vec<[usize; 4]> = contacts.iter().map(|c| c.vertices.map(number)).collect();
        let mobility: Vec<f64> = vertices.iter().map(|&v| step.mobility(v)).collect();
        let mut system = Self { contacts, numbers, mobility, rows: None };
        system.rows = (contacts.len() <= DENSE).then(|| system.lower_triangle());
        system
    }

    fn lower_triangle(&self) -> Vec<Vec<f64>> {
        let mut at: Vec<Vec<(usize, f64)>> = vec![Vec::new(); self.mobility.len()];
        let mut rows = Vec::with_capacity(self.contacts.len());
        for (i, (contact, numbers)) in self.contacts.iter().zip(&self.numbers).enumerate() {
            let mut row = vec![0.0; i + 1];
            for (&v, weight) in numbers.iter().zip(contact.weights) {
                at[v].push((i, weight));
                for &(j, other) in &at[v] {
                    row[j] +=
                        (weight * other * self.mobility[v]) * contact.normal.dot(self.contacts[j].normal);
                }
            }
            rows.push(row);
        }
        rows
    }

    /// The impulses that take approaches away, as far as they are found; tells whether the system is singular.
    fn solve(&self, approach: &[f64], singular: &mut bool) -> Vec<f64> {
        if let Some(rows) = &self.rows {
            let solution = least_squares::solve(rows, approach);
            *singular |= solution.rank < approach.len();
            return solution.x;
        }
        let diagonal = |(c, numbers): (&Contact, &[usize; 4])| {
            (0..4).map(|k| c.weights[k] * c.weights[k] * self.mobility[numbers[k]]).sum()
        };
        let diagonal: Vec<f64> = self.contacts.iter().zip(&self.numbers).map(diagonal).collect();
        conjugate_gradients::solve(&diagonal, approach, |x, product| self.times(x, product))
    }

    /// `C M^-1 C^T x`.
    fn times(&self, x: &[f64], product: &mut [f64]) {
        let mut moved = vec![DVec3::ZERO; self.mobility.len()];
        for ((c, numbers), x) in self.contacts.iter().zip(&self.numbers).zip(x) {
            for k in 0..4 {
                moved[numbers[k]] += (c.weights[k] * x) * c.normal;
            }
        }
        moved.iter_mut().zip(&self.mobility).for_each(|(m, mobility)| *m *= *mobility);
        for ((c, numbers), product) in self.contacts.iter().zip(&self.numbers).zip(product) {
            *product = c.normal.dot(c.weighted(numbers.map(|i| moved[i])));
        }
    }
}
