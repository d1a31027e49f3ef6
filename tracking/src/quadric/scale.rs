//! Powers of two that bring the star of a vertex to a size near one: [`Scale`].

use std::ops::Mul;

use glam::DVec3;
use rayon::prelude::*;
use welter_meshing::surface::VertexId;

use crate::surface::MovingSurface;

/// Differences of positions, scaled by a power of two. Squares and fourth powers of what comes out neither overflow
/// nor vanish, and are the same bits when all positions are multiplied by a power of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    /// Before the subtraction: 1, or 1/2 where the difference could overflow.
    before: f64,
    /// After it, in two steps, since the whole factor can be beyond the range of `f64`.
    after: [f64; 2],
    /// True lengths are 2^exponent times scaled ones.
    exponent: i32,
}

impl Scale {
    /// The scale in which the longest component of an edge out of a vertex is in [1/2, 1). That of a vertex whose
    /// edges have no length, or that has none, is 1.
    pub(crate) fn of_star(surface: &MovingSurface, vertex: VertexId) -> Self {
        let mesh = surface.connectivity();
        let center = surface.position(vertex);
        let longest = |factor: f64| {
            let others = mesh.star(vertex).flat_map(|h| [mesh.head(h), mesh.apex(h)]);
            let edges = others.map(|other| factor * surface.position(other) - factor * center);
            edges.fold(0.0, |longest: f64, edge| longest.max(edge.abs().max_element()))
        };
        let whole = longest(1.0);
        if whole.is_finite() { Self::of_length(whole, 1.0) } else { Self::of_length(longest(0.5), 0.5) }
    }

    /// The scale in which the longest side of the bounding box of all positions, also those of free ids, is in [1/2, 1).
    pub(crate) fn of_surface(surface: &MovingSurface) -> Self {
        let empty = || (DVec3::INFINITY, DVec3::NEG_INFINITY);
        // Minimum and maximum do not depend on the order.
        let (min, max) = surface
            .positions()
            .par_iter()
            .with_min_len(4096)
            .fold(empty, |(min, max), &p| (min.min(p), max.max(p)))
            .reduce(empty, |a, b| (a.0.min(b.0), a.1.max(b.1)));
        if surface.positions().is_empty() {
            return Self::of_length(0.0, 1.0);
        }
        let whole = (max - min).max_element();
        if whole.is_finite() {
            Self::of_length(whole, 1.0)
        } else {
            Self::of_length((0.5 * max - 0.5 * min).max_element(), 0.5)
        }
    }

    /// The scale in which a length that was measured after multiplication with `before` is in [1/2, 1).
    pub(crate) fn of_length(length: f64, before: f64) -> Self {
        let (_, exponent) = libm::frexp(length);
        let half = exponent / 2;
        Self {
            before,
            after: [power_of_two(-half), power_of_two(half - exponent)],
            exponent: exponent + i32::from(before < 1.0),
        }
    }

    /// `(a - b) / 2^exponent`: one rounding, relative to the difference.
    #[inline]
    pub(crate) fn difference(&self, a: DVec3, b: DVec3) -> DVec3 {
        (a * self.before - b * self.before) * self.after[0] * self.after[1]
    }

    /// A true length, or a vector of lengths, in scaled length.
    #[inline]
    pub(crate) fn scaled<T: Mul<f64, Output = T>>(&self, length: T) -> T {
        length * self.before * self.after[0] * self.after[1]
    }

    /// A vector of scaled length in true length.
    #[inline]
    pub(crate) fn restored(&self, scaled: DVec3) -> DVec3 {
        let half = self.exponent / 2;
        scaled * power_of_two(half) * power_of_two(self.exponent - half)
    }

    /// A number of the dimension length^power in true size.
    pub(crate) fn restored_power(&self, scaled: f64, power: i32) -> f64 {
        libm::scalbn(scaled, power * self.exponent)
    }

    /// A number of the dimension length^power in scaled size.
    pub(crate) fn scaled_power(&self, size: f64, power: i32) -> f64 {
        libm::scalbn(size, -power * self.exponent)
    }
}

/// 2^exponent, for exponents of normal numbers.
fn power_of_two(exponent: i32) -> f64 {
    debug_assert!((-1022..=1023).contains(&exponent), "{exponent}");
    f64::from_bits(((1023 + i64::from(exponent)) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_of_every_size_come_near_one_and_back() {
        for exponent in (-1073..=1023).chain([-1074]) {
            let length = libm::scalbn(1.0, exponent);
            let scale = Scale::of_length(length, 1.0);
            let scaled = scale.difference(DVec3::new(length, 0.0, 0.0), DVec3::ZERO);
            assert_eq!(scaled.x, 0.5, "2^{exponent}");
            assert_eq!(scale.restored(scaled).x, length, "2^{exponent}");
            assert_eq!(scale.restored_power(scaled.x, 1), length, "2^{exponent}");
        }
        assert_eq!(Scale::of_length(0.0, 1.0).difference(DVec3::ONE, DVec3::ZERO), DVec3::ONE);
    }

    #[test]
    fn differences_beyond_the_largest_number_are_scaled() {
        let scale = Scale::of_length(f64::MAX, 0.5);
        let across = scale.difference(DVec3::splat(f64::MAX), DVec3::splat(-f64::MAX));
        assert!((across - DVec3::ONE).length() < 1e-15, "{across}");
    }
}
