//! Rigid zones: [`stiffen`].
//!
//! # What it computes
//! Collisions that share movable vertices form a zone, whose vertices move as a rigid body: with the momentum and, for angles up
//! to a right one, the angular momentum that they have together, on straight lines to places that are rotated and shifted. What
//! collides then joins the zones. A zone whose own parts collide all the same, by rounding, rests. So does one that touches
//! immovable vertices which rest; where these move, the zone moves with them if all move alike.
//!
//! # What it promises
//! * It ends after the rounds that the parameters allow. What collides then is told by [`Step::colliding`].
//! * Rotated and rounded positions are trusted no more than others: they are asked about like all.
//!
//! # Method
//! \[Provot97\] and \[Bridson02, section 7.3\]. The rotation by the vector `w`, `I w = L`, is the exponential of
//! `w` (Rodrigues' formula), not its linear part, which would swell the zone. On straight lines between a zone and itself
//! rotated by less than half a turn it is mapped linearly with a positive determinant, so its parts do not touch but for rounding.
//! `I` is singular for vertices on a line; the rotation about that line is left out then.

use super::IntegrationError;
use super::contact::ElementPair;
use super::least_squares;
use super::step::Step;
use super::union::Groups;
use crate::collision::unit;
use glam::{DMat3, DVec3};
use std::collections::{BTreeMap, BTreeSet};
use welter_meshing::surface::VertexId;

/// Rotations are cut to a right angle: half of what turns a zone inside out on straight lines.
const LARGEST_ANGLE: f64 = std::f64::consts::FRAC_PI_2;

/// Makes zones of what collides rigid, and again, until nothing collides or the rounds are used up.
pub(super) fn stiffen(step: &mut Step<'_>) -> Result<(), IntegrationError> {
    let before = step.ends().to_vec();
    let mut zones = Zones {
        groups: Groups::new(before.len()),
        vertices: BTreeSet::new(),
        resting: vec![false; before.len()],
    };
    for _ in 0..step.parameters.rigid_rounds {
        step.detect()?;
        if !step.collides() || step.is_crowded() {
            break;
        }
        let changed = zones.take_in(step);
        if changed.is_empty() {
            break;
        }
        zones.stiffen(step, &before, &changed);
    }
    step.detect()
}

struct Zones {
    groups: Groups,
    /// All vertices of zones, immovable ones too.
    vertices: BTreeSet<VertexId>,
    /// By the smallest vertex of a zone.
    resting: Vec<bool>,
}

impl Zones {
    /// Adds what collides now; tells the zones that have become others.
    fn take_in(&mut self, step: &mut Step<'_>) -> BTreeSet<VertexId> {
        let mesh = step.surface.connectivity();
        let movable = |pair: &ElementPair, step: &Step<'_>| {
            pair.vertices(mesh).into_iter().find(|&v| step.mobility(v) > 0.0)
        };
        // What a former round has made rigid, and collides within itself.
        let mut changed: Vec<VertexId> = Vec::new();
        for pair in step.colliding().to_vec() {
            let Some(first) = movable(&pair, step) else { continue };
            let zone = self.groups.of(first);
            let within = pair
                .vertices(mesh)
                .into_iter()
                .all(|v| self.vertices.contains(&v) && self.groups.of(v) == zone);
            if !within {
                changed.push(first);
            } else if !self.resting[zone.index()] {
                self.resting[zone.index()] = true;
                step.report.resting_zones += 1;
                changed.push(first);
            }
        }
        for pair in step.colliding().to_vec() {
            let Some(first) = movable(&pair, step) else { continue };
            for v in pair.vertices(mesh) {
                self.vertices.insert(v);
                let [a, b] = [self.groups.of(first), self.groups.of(v)];
                let resting = self.resting[a.index()] || self.resting[b.index()];
                self.groups.merge(a, b);
                self.resting[a.min(b).index()] = resting;
            }
        }
        changed.into_iter().map(|v| self.groups.of(v)).collect()
    }

    fn stiffen(&mut self, step: &mut Step<'_>, before: &[DVec3], changed: &BTreeSet<VertexId>) {
        let mut members: BTreeMap<VertexId, Vec<VertexId>> = BTreeMap::new();
        for &v in &self.vertices {
            let zone = self.groups.of(v);
            if changed.contains(&zone) {
                members.entry(zone).or_default().push(v);
            }
        }
        for (zone, members) in members {
            step.report.rigid_zones += 1;
            let resting = self.resting[zone.index()];
            let motion = if resting { Rigid::REST } else { Rigid::of(step, before, &members) };
            for &v in members.iter().filter(|&&v| step.mobility(v) > 0.0).collect::<Vec<_>>() {
                step.set_end(v, motion.end(step.surface.position(v)));
            }
        }
    }
}

/// A rigid motion.
struct Rigid {
    centre: DVec3,
    shift: DVec3,
    /// The unit axis, with the sine of the angle and one minus its cosine.
    rotation: Option<(DVec3, f64, f64)>,
}

impl Rigid {
    const REST: Self = Self { centre: DVec3::ZERO, shift: DVec3::ZERO, rotation: None };

    /// The motion of some vertices together.
    fn of(step: &Step<'_>, before: &[DVec3], vertices: &[VertexId]) -> Self {
        let displacement = |v: VertexId| before[v.index()] - step.surface.position(v);
        let mut anchors = vertices.iter().filter(|&&v| step.mobility(v) == 0.0).map(|&v| displacement(v));
        if let Some(first) = anchors.next() {
            // Where they do not move alike, no rigid motion will do; the shift of the first does no harm.
            return if anchors.all(|d| d == first) {
                Self { shift: first, ..Self::REST }
            } else {
                Self::REST
            };
        }
        // Masses relative to the lightest of the zone; lengths to the zone's size, which is a power of two.
        let lightest = vertices.iter().map(|&v| step.mobility(v)).fold(0.0, f64::max);
        let mass = |v: VertexId| lightest / step.mobility(v);
        let total: f64 = vertices.iter().map(|&v| mass(v)).sum();
        let mean = |of: &dyn Fn(VertexId) -> DVec3| {
            vertices.iter().map(|&v| (mass(v) / total) * of(v)).sum::<DVec3>()
        };
        let origin = step.surface.position(vertices[0]);
        let centre = origin + mean(&|v| step.surface.position(v) - origin);
        let shift = mean(&displacement);
        let arm = |v: VertexId| step.surface.position(v) - centre;
        let size = vertices.iter().map(|&v| arm(v).abs().max_element()).fold(0.0, f64::max);
        let unit_length = libm::scalbn(1.0, (-libm::frexp(size).1).clamp(-1022, 1023));
        let (mut inertia, mut momentum) = (DMat3::ZERO, DVec3::ZERO);
        for &v in vertices {
            let (r, u) = (arm(v) * unit_length, (displacement(v) - shift) * unit_length);
            let share = mass(v) / total;
            let outer = DMat3::from_cols(r.x * r, r.y * r, r.z * r);
            inertia += share * (DMat3::from_diagonal(DVec3::splat(r.length_squared())) - outer);
            momentum += share * r.cross(u);
        }
        let rows: Vec<Vec<f64>> = (0..3).map(|i| (0..=i).map(|j| inertia.col(j)[i]).collect()).collect();
        let solution = least_squares::solve(&rows, &momentum.to_array());
        let turn = DVec3::from_slice(&solution.x);
        let rotation = unit(turn).map(|axis| {
            let angle = turn.dot(axis).min(LARGEST_ANGLE);
            let half = libm::sin(0.5 * angle);
            (axis, libm::sin(angle), 2.0 * half * half)
        });
        Self { centre, shift, rotation }
    }

    fn end(&self, place: DVec3) -> DVec3 {
        let turned = self.rotation.map_or(DVec3::ZERO, |(axis, sine, versine)| {
            let across = axis.cross(place - self.centre);
            sine * across + versine * axis.cross(across)
        });
        place + (self.shift + turned)
    }
}
