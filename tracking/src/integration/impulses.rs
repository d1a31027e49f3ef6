//! Sweeps of single impulses: [`sweep`].
//!
//! # What it computes
//! In each sweep the pairs that collide, in the order of their ids, with the ends that the impulses before them left: an
//! impulse takes their approach along the normal of the contact away, without rebound.
//!
//! # What it promises
//! The sum of masses times displacements is kept to rounding where no vertex is immovable; kinetic energy does not grow.
//! Not that no collision is left: one impulse may cause another collision.
//!
//! # Method
//! The second phase of \[Brochu12, section 3.2.7\]. Normal and weights are those of the time of impact, which are proven not to be
//! late and have a choice for every degenerate case; the middle of the step, which \[Brochu12, section 4.5.5\] takes, says nothing
//! about motions of many edge lengths. Where the points of contact do not approach each other along the normal,
//! which is so when elements turn into each other, all of their relative motion is taken away.

use super::IntegrationError;
use super::contact::Contact;
use super::friction::rub;
use super::step::Step;
use crate::collision::{length, unit};

/// Makes as many sweeps as the parameters say, or until nothing collides.
pub(super) fn sweep(step: &mut Step<'_>) -> Result<(), IntegrationError> {
    for _ in 0..step.parameters.sweeps {
        step.detect()?;
        if step.colliding().is_empty() {
            break;
        }
        step.report.sweeps += 1;
        for pair in step.colliding().to_vec() {
            // As the impulses before have left it.
            if let Some(contact) = step.impact(pair) {
                stop(step, &contact);
            }
        }
    }
    step.detect()
}

/// Takes the approach of a contact away.
fn stop(step: &mut Step<'_>, contact: &Contact) {
    let relative = step.relative(contact);
    let approach = -contact.normal.dot(relative);
    let pushed = if approach > 0.0 {
        let pushed = step.push(contact, contact.normal, approach);
        rub(step, contact, approach);
        pushed
    } else {
        unit(relative).is_some_and(|direction| step.push(contact, direction, -length(relative)))
    };
    step.report.impulses += usize::from(pushed);
}
