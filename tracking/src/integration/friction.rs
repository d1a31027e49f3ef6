//! Coulomb friction: [`rub`].
//!
//! # Method
//! An impulse that takes an approach `a` off a contact along its normal takes at most `mu a` off the
//! relative displacement along the plane of contact, and no more than there is: the rule of \[Bridson02, section 7.1\], in
//! displacements.

use super::contact::Contact;
use super::step::Step;
use crate::collision::{length, unit};

/// Slows the sliding of a contact from which an impulse has taken an approach (nothing is done for a separation).
pub(super) fn rub(step: &mut Step<'_>, contact: &Contact, approach: f64) {
    let friction = step.parameters.friction;
    if friction == 0.0 || approach <= 0.0 {
        return;
    }
    let relative = step.relative(contact);
    let sliding = relative - contact.normal.dot(relative) * contact.normal;
    if let Some(direction) = unit(sliding) {
        step.push(contact, direction, -length(sliding).min(friction * approach));
    }
}
