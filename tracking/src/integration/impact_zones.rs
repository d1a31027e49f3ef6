//! Inelastic impact zones: [`solve`].
//!
//! # What it computes
//! Collisions that share movable vertices form a zone. All collisions of a zone are stopped at once: the ends become those
//! nearest to the ones before, in the metric of masses, for which no pair of the zone approaches along its normal. What
//! collides then joins the zones, until nothing does.
//!
//! # What it promises
//! * The sum of masses times displacements is kept to rounding where no vertex is immovable; kinetic energy does not grow.
//! * A singular system is found out by its rank. It is solved in the least squares sense all the same where its collisions
//!   can be stopped together; a zone whose collisions cannot, or are too many, keeps the ends that it had, and is left
//!   to rigid motions.
//! * It ends after the rounds that the parameters allow; a pair joins its zone at most that many times.
//!
//! # Method
//! \[Harmon08\], as in \[Brochu12, section 3.2.7\]: to minimise `|u' - u|_M` with `C u' = 0`, where row `i` of `C` holds
//! the signed weights of collision `i` times its normal, solve `C M^-1 C^T l = C u`, then `u' = u - M^-1 C^T l`
//! (`least_squares`). As the projection onto the solutions of more rows is the projection of that onto fewer, each round starts from the
//! ends before all zones. Dense: n^3 / 6 operations for n collisions of a zone, whose number is bounded.

use super::IntegrationError;
use super::contact::Contact;
use super::least_squares;
use super::step::Step;
use super::union::Groups;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeMap;
use welter_meshing::surface::VertexId;

/// The part of its largest approach that a zone may have left after it was solved: 2^-20; what a singular system leaves that
/// cannot be solved is of the order of 1.
const UNSOLVED: f64 = 1.0 / (1 << 20) as f64;

/// Stops all collisions of zones at once, and again, until nothing collides or the rounds are used up.
pub(super) fn solve(step: &mut Step<'_>) -> Result<(), IntegrationError> {
    let before = step.ends().to_vec();
    let mut zones = Zones {
        groups: Groups::new(before.len()),
        contacts: Vec::new(),
        given_up: vec![false; before.len()],
    };
    for _ in 0..step.parameters.zone_rounds {
        step.detect()?;
        if step.is_crowded() || !zones.take_in(step) {
            break;
        }
        zones.solve(step, &before);
    }
    step.detect()
}

struct Zones {
    groups: Groups,
    contacts: Vec<Contact>,
    /// By the smallest vertex of a zone: whether it is left to rigid motions.
    given_up: Vec<bool>,
}

impl Zones {
    /// Adds what collides now. False if that changes nothing.
    fn take_in(&mut self, step: &Step<'_>) -> bool {
        let contacts: Vec<Contact> =
            step.colliding().par_iter().filter_map(|&pair| step.impact(pair)).collect();
        let mut news = false;
        for contact in contacts {
            let mut movable = contact.vertices.into_iter().filter(|&v| step.mobility(v) > 0.0);
            let Some(first) = movable.next() else { continue };
            let mut given_up = self.given_up[self.groups.of(first).index()];
            for v in movable {
                given_up |= self.given_up[self.groups.of(v).index()];
                self.groups.merge(first, v);
            }
            if step.yielding(&contact).is_none() {
                given_up = true;
            }
            self.given_up[self.groups.of(first).index()] = given_up;
            news |= !given_up;
            self.contacts.push(contact);
        }
        news
    }

    /// The collisions of each zone, in the order in which they came.
    fn by_zone(&mut self, step: &Step<'_>) -> Vec<(VertexId, Vec<Contact>)> {
        let mut zones: BTreeMap<VertexId, Vec<Contact>> = BTreeMap::new();
        for contact in &self.contacts {
            if let Some(&v) = contact.vertices.iter().find(|&&v| step.mobility(v) > 0.0) {
                zones.entry(self.groups.of(v)).or_default().push(*contact);
            }
        }
        zones.into_iter().collect()
    }

    fn solve(&mut self, step: &mut Step<'_>, before: &[DVec3]) {
        let zones: Vec<(VertexId, Vec<Contact>)> = self.by_zone(step);
        let zones: Vec<(VertexId, Vec<Contact>)> =
            zones.into_iter().filter(|(zone, _)| !self.given_up[zone.index()]).collect();
        let view: &Step<'_> = step;
        let solved: Vec<Zone> =
            zones.par_iter().map(|(_, contacts)| Zone::new(view, before, contacts)).collect();
        for ((zone, contacts), solved) in zones.iter().zip(solved) {
            step.report.largest_impact_zone = step.report.largest_impact_zone.max(contacts.len());
            step.report.singular_systems += usize::from(solved.singular);
            match solved.ends {
                Some(ends) => {
                    step.report.impact_zones += 1;
                    ends.into_iter().for_each(|(v, end)| step.set_end(v, end));
                }
                None => {
                    self.given_up[zone.index()] = true;
                    for v in contacts.iter().flat_map(|contact| contact.vertices) {
                        step.set_end(v, before[v.index()]);
                    }
                }
            }
        }
    }
}

/// What came of a zone.
struct Zone {
    singular: bool,
    /// The ends of its movable vertices, if its collisions could be stopped.
    ends: Option<Vec<(VertexId, DVec3)>>,
}

impl Zone {
    fn new(step: &Step<'_>, before: &[DVec3], contacts: &[Contact]) -> Self {
        if contacts.len() > step.parameters.most_zone_collisions as usize {
            return Self { singular: false, ends: None };
        }
        let displacement = |v: VertexId| before[v.index()] - step.surface.position(v);
        let approach: Vec<f64> =
            contacts.iter().map(|c| c.normal.dot(c.weighted(c.vertices.map(displacement)))).collect();
        let least_squares::Solution { x: impulses, rank } =
            least_squares::solve(&system(step, contacts), &approach);
        let mut changes: BTreeMap<VertexId, DVec3> = BTreeMap::new();
        for (contact, impulse) in contacts.iter().zip(&impulses) {
            for (&v, weight) in contact.vertices.iter().zip(contact.weights) {
                let mobility = step.mobility(v);
                if mobility > 0.0 {
                    *changes.entry(v).or_default() -= (weight * mobility * impulse) * contact.normal;
                }
            }
        }
        let after = |v: VertexId| displacement(v) + changes.get(&v).copied().unwrap_or_default();
        let left = contacts.iter().map(|c| c.normal.dot(c.weighted(c.vertices.map(after))).abs());
        let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let stopped = most(&mut { left }) <= UNSOLVED * most(&mut approach.iter().map(|a| a.abs()));
        let ends = changes.iter().map(|(&v, &change)| (v, before[v.index()] + change)).collect();
        Self { singular: rank < contacts.len(), ends: stopped.then_some(ends) }
    }
}

/// The lower triangle of `C M^-1 C^T`.
fn system(step: &Step<'_>, contacts: &[Contact]) -> Vec<Vec<f64>> {
    let mut at: BTreeMap<VertexId, Vec<(usize, f64)>> = BTreeMap::new();
    let mut rows = Vec::with_capacity(contacts.len());
    for (i, contact) in contacts.iter().enumerate() {
        let mut row = vec![0.0; i + 1];
        for (&v, weight) in contact.vertices.iter().zip(contact.weights) {
            let mobility = step.mobility(v);
            if mobility == 0.0 {
                continue;
            }
            let others = at.entry(v).or_default();
            others.push((i, weight));
            for &(j, other) in others.iter() {
                row[j] += (weight * other * mobility) * contact.normal.dot(contacts[j].normal);
            }
        }
        rows.push(row);
    }
    rows
}
