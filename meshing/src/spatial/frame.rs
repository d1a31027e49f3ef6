//! The single-precision frame of a scene: [`Frame`] maps `f64` coordinates to `f32` and keeps their order.
//!
//! # What it promises
//! * **Order**: `x <= y` implies `map(x) <= map(y)`, per axis, for all finite `x`, `y` and whatever the scene: 1e308,
//!   subnormal, or far from the origin. Hence closed boxes that meet are mapped to closed boxes that meet, and no
//!   box has to be widened for an overlap query.
//! * **Closeness**: within the scene's box the mapped coordinates lie in [-1, 1] and differ from the exact
//!   `(x - center) * 2^k` by at most 2^-24.
//! * No NaN. Points outside of the scene may be mapped to infinity, in order.
//!
//! # What it does not promise
//! To keep different coordinates different: `f32` holds 24 bits. Mapped boxes may meet where exact boxes do not.
//!
//! # Method
//! `map(x) = f32((x - center) * s1 * s2)` with powers of two `s1 s2 = 2^k`, each in the normal range. Subtraction of a
//! constant, multiplication by a positive constant and conversion to `f32`, each rounded to nearest, never decrease
//! when their argument grows; so neither does their composition. `x - center` cannot be NaN for finite `x`.
//!
//! Closeness: with `h` the largest distance from the center along an axis, `2^e <= h < 2^(e+1)` and `k = -e - 2`, so that
//! `|x - center| 2^k <= 0.5`. The subtraction errs by at most 2^-53 of its result, the conversion by 2^-25 below 1, both
//! underflows by far less: together below 2^-24.

use glam::DVec3;

use super::Box3;

/// An order-preserving map from a scene's `f64` coordinates to `f32` coordinates in [-1, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    center: DVec3,
    /// Largest distance of the scene from its center along an axis.
    half: f64,
    scale: Scale,
}

impl Frame {
    /// Bound on the distance of a mapped coordinate of the scene from its exact place in the frame.
    pub(crate) const ERROR: f64 = 1.0 / (1 << 24) as f64;

    /// The frame of the smallest box around the scene; any frame will do for an empty scene.
    pub(crate) fn of(scene: Box3) -> Self {
        if scene.is_empty() {
            return Self { center: DVec3::ZERO, half: 0.0, scale: Scale::shrinking(0.0) };
        }
        // Halves first: a sum or difference of the corners may overflow.
        let center = scene.min * 0.5 + scene.max * 0.5;
        // Not half of the difference, which rounds to zero for the smallest numbers.
        let half = (scene.max - center).max(center - scene.min).max_element();
        Self { center, half, scale: Scale::shrinking(half) }
    }

    /// The place of `point` in the frame before rounding to `f32`; may be infinite outside of the scene.
    #[inline]
    pub(crate) fn place(&self, point: DVec3) -> DVec3 {
        self.scale.apply(point - self.center)
    }

    /// A length in the unit of the frame; may be infinite.
    pub(crate) fn scaled(&self, length: f64) -> f64 {
        self.scale.apply(DVec3::splat(length)).x
    }

    /// The mapped point.
    #[inline]
    pub(crate) fn map(&self, point: DVec3) -> [f32; 3] {
        self.place(point).to_array().map(|x| x as f32)
    }
}

/// Coordinates relative to a point in which the scene has size one: what distances to the scene are computed in.
///
/// Differences to the point are rounded to nearest, once, and then scaled exactly; nothing overflows, and what
/// underflows is below 2^-1000 of the larger of the scene and its distance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Local {
    origin: DVec3,
    /// Differences are taken of halves where they might overflow otherwise.
    halved: bool,
    scale: Scale,
    frame_scale: Scale,
}

impl Frame {
    /// Coordinates relative to a finite `origin`.
    pub(crate) fn about(&self, origin: DVec3) -> Local {
        /// Where a sum of two still does not overflow.
        const LARGE: f64 = f64::MAX / 16.0;
        let far = (origin - self.center).abs().max_element().max(self.half);
        let halved = far > LARGE;
        let far = if halved {
            (origin * 0.5 - self.center * 0.5).abs().max_element().max(self.half * 0.5)
        } else {
            far
        };
        Local { origin, halved, scale: Scale::shrinking(far), frame_scale: self.scale }
    }
}

impl Local {
    /// A point of the scene relative to the origin; coordinates in [-1, 1].
    #[inline]
    pub(crate) fn place(&self, point: DVec3) -> DVec3 {
        let difference = if self.halved { point * 0.5 - self.origin * 0.5 } else { point - self.origin };
        self.scale.apply(difference)
    }

    /// The point at a place.
    pub(crate) fn point_at(&self, place: DVec3) -> DVec3 {
        let difference = self.scale.undo(place);
        if self.halved { (self.origin * 0.5 + difference) * 2.0 } else { self.origin + difference }
    }

    /// A length in the scene's unit; infinite beyond the largest number.
    pub(crate) fn length(&self, length: f64) -> f64 {
        let length = self.scale.undo(DVec3::splat(length)).x;
        if self.halved { length * 2.0 } else { length }
    }

    /// A length in the unit of the frame that this was made of; infinite where its unit is very much smaller.
    pub(crate) fn length_in_frame(&self, length: f64) -> f64 {
        // Not by way of the scene's unit, in which a length may be rounded to zero.
        let exponent = self.frame_scale.exponent - self.scale.exponent + i32::from(self.halved);
        match exponent {
            ..=1023 => length * power_of_two(exponent.max(-1022)),
            _ if length == 0.0 => 0.0,
            _ => f64::INFINITY,
        }
    }
}

/// Multiplication by a power of two that may be out of the range of `f64`, as two factors of the normal range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    exponent: i32,
    factors: [f64; 2],
    inverse: [f64; 2],
}

impl Scale {
    /// The factor `2^k` that takes `size` to [1/4, 1/2).
    pub(crate) fn shrinking(size: f64) -> Self {
        let exponent = if size > 0.0 { -(binary_exponent(size) + 2) } else { 0 };
        let parts = [exponent / 2, exponent - exponent / 2];
        Self { exponent, factors: parts.map(power_of_two), inverse: parts.map(|part| power_of_two(-part)) }
    }

    #[inline]
    pub(crate) fn apply(&self, v: DVec3) -> DVec3 {
        v * self.factors[0] * self.factors[1]
    }

    #[inline]
    fn undo(&self, v: DVec3) -> DVec3 {
        v * self.inverse[0] * self.inverse[1]
    }
}

/// `e` with `2^e <= x < 2^(e+1)`, for positive finite `x`.
fn binary_exponent(x: f64) -> i32 {
    let bits = x.to_bits();
    let biased = (bits >> 52) as i32;
    if biased > 0 { biased - 1023 } else { 63 - bits.leading_zeros() as i32 - 1074 }
}

/// `2^exponent` of the normal range.
fn power_of_two(exponent: i32) -> f64 {
    debug_assert!((-1022..=1023).contains(&exponent));
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents() {
        for e in [-1074, -1050, -1023, -1022, -1, 0, 1, 1023] {
            let x = 2f64.powi(e.max(-1022)) * 2f64.powi(e.min(-1022) + 1022);
            assert_eq!(binary_exponent(x), e);
        }
        assert_eq!(binary_exponent(f64::MAX), 1023);
        assert_eq!(power_of_two(-1022), f64::MIN_POSITIVE);
        assert_eq!(power_of_two(3), 8.0);
    }

    fn scenes() -> Vec<Box3> {
        let scene = |min, max| Box3 { min: DVec3::splat(min), max: DVec3::splat(max) };
        let tiny = f64::from_bits(1);
        vec![
            scene(-1.0, 1.0),
            scene(-f64::MAX, f64::MAX),
            scene(0.9 * f64::MAX, f64::MAX),
            scene(0.0, tiny),
            scene(-3.0 * tiny, 17.0 * tiny),
            scene(1e6, 1e6 + 1.0),
            scene(2.0, 2.0),
            scene(1e-300, 1.0),
        ]
    }

    #[test]
    fn order_is_kept_and_the_scene_fills_the_frame() {
        for scene in scenes() {
            let frame = Frame::of(scene);
            let (a, b) = (scene.min.x, scene.max.x);
            let mut xs = vec![a, b, a.next_up(), b.next_down(), -f64::MAX, f64::MAX, 0.0, 1.0, -1e-320];
            for i in 0..=1000 {
                let t = f64::from(i) / 1000.0;
                let x = a * (1.0 - t) + b * t;
                xs.extend([x.next_down(), x, x.next_up()].into_iter().filter(|x| x.is_finite()));
            }
            xs.sort_by(f64::total_cmp);
            let mapped: Vec<f32> = xs.iter().map(|&x| frame.map(DVec3::splat(x))[0]).collect();
            assert!(mapped.iter().all(|x| !x.is_nan()), "{scene:?}");
            assert!(mapped.is_sorted(), "{scene:?}");
            for (&x, &y) in xs.iter().zip(&mapped).filter(|&(&x, _)| a <= x && x <= b) {
                let place = frame.place(DVec3::splat(x)).x;
                assert!((place - f64::from(y)).abs() <= Frame::ERROR, "{scene:?}: {x}");
            }
            let ends = [frame.map(scene.min)[0], frame.map(scene.max)[0]];
            assert!(ends.iter().all(|x| x.abs() <= 1.0), "{scene:?}: {ends:?}");
            if b > a {
                assert!(ends[1] - ends[0] >= 0.25, "{scene:?}: {ends:?}");
            }
        }
    }
}
