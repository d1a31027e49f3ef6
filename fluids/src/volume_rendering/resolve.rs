//! From crossings to stretches of smoke: entering and leaving counted along a ray.
//!
//! The winding number before the first crossing is minus the sum of all crossings, since it is 0 behind the
//! last: so a ray that starts in the smoke is in it from the start, with no need to close the surface before
//! the eye. Between crossings the winding number tells the density ([`InteriorRule`]). A crossing out of
//! order by rounding makes a stretch of no length to speak of wrong, not the rest of the ray.

use super::InteriorRule;
use super::crossings::Crossing;

/// A part of a ray inside the smoke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    /// Depths at which it begins and ends.
    pub(super) near: f64,
    pub(super) far: f64,
    /// Mean of the ages at both ends.
    pub(super) age: f64,
    /// Density by the rule, above 0.
    pub(super) density: f64,
}

/// The winding number in the eye, from all crossings of a ray.
pub(super) fn winding_in_eye(crossings: &[Crossing]) -> i32 {
    -crossings.iter().map(|c| c.sign).sum::<i32>()
}

/// Calls `visit` with the stretches of a ray up to a depth, from near to far.
#[inline]
pub(super) fn stretches(
    crossings: &[Crossing],
    limit: f64,
    rule: InteriorRule,
    mut visit: impl FnMut(Stretch),
) {
    let Some(first) = crossings.first() else { return };
    let mut winding = winding_in_eye(crossings);
    // The age in the eye is not known; that of the surface next to it is taken.
    let (mut near, mut near_age) = (0.0, f64::from(first.age));
    for crossing in crossings {
        if near >= limit {
            return;
        }
        let (end, end_age) = (crossing.depth, f64::from(crossing.age));
        let density = rule.density(f64::from(winding));
        if density > 0.0 && end > near {
            let far = end.min(limit);
            let far_age = near_age + (end_age - near_age) * ((far - near) / (end - near));
            visit(Stretch { near, far, age: 0.5 * (near_age + far_age), density });
        }
        winding += crossing.sign;
        (near, near_age) = (end, end_age);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crossings(list: &[(f64, i32)]) -> Vec<Crossing> {
        let crossing = |(i, &(depth, sign)): (usize, &(f64, i32))| Crossing {
            depth,
            age: depth as f32,
            piece: i as u32,
            pixel: 0,
            sign,
        };
        list.iter().enumerate().map(crossing).collect()
    }

    fn found(list: &[(f64, i32)], limit: f64, rule: InteriorRule) -> Vec<(f64, f64, f64, f64)> {
        let mut found = Vec::new();
        stretches(&crossings(list), limit, rule, |s| found.push((s.near, s.far, s.age, s.density)));
        found
    }

    #[test]
    fn rules_tell_what_overlaps_and_what_is_inside_out() {
        let overlapping = [(1.0, 1), (2.0, 1), (4.0, -1), (8.0, -1)];
        let (a, b, c) = ((1.0, 2.0, 1.5), (2.0, 4.0, 3.0), (4.0, 8.0, 6.0));
        let dense = |(near, far, age): (f64, f64, f64), density| (near, far, age, density);
        let limit = f64::INFINITY;
        assert_eq!(
            found(&overlapping, limit, InteriorRule::NonZero),
            [dense(a, 1.0), dense(b, 1.0), dense(c, 1.0)]
        );
        assert_eq!(found(&overlapping, limit, InteriorRule::Odd), [dense(a, 1.0), dense(c, 1.0)]);
        assert_eq!(
            found(&overlapping, limit, InteriorRule::Multiplicity),
            [dense(a, 1.0), dense(b, 2.0), dense(c, 1.0)]
        );
        let inside_out = [(1.0, -1), (2.0, 1)];
        assert_eq!(found(&inside_out, limit, InteriorRule::NonZero), [dense(a, 1.0)]);
        assert!(found(&inside_out, limit, InteriorRule::Positive).is_empty());
    }

    #[test]
    fn a_ray_may_begin_in_the_smoke_and_end_at_a_solid() {
        let leaving = [(2.0, -1), (4.0, 1), (8.0, -1)];
        assert_eq!(winding_in_eye(&crossings(&leaving)), 1);
        let limit = 5.0;
        assert_eq!(
            found(&leaving, limit, InteriorRule::NonZero),
            [(0.0, 2.0, 2.0, 1.0), (4.0, 5.0, 4.5, 1.0)]
        );
        assert!(found(&[], limit, InteriorRule::NonZero).is_empty());
    }
}
