//! The composite: smoke over what lies behind it.
//!
//! ```text
//!   color = albedo (radiance scatter + ambient alpha) + (1 - alpha) backdrop
//! ```
//! with `1 - alpha` taken as 0 where a blur has made alpha exceed 1.

use rayon::prelude::*;

use super::{Image, Light, Medium};

/// The color of each pixel (red, green, blue), from planes of one size.
pub(super) fn composite(
    alpha: &Image<f32>,
    scatter: &Image<f32>,
    backdrop: &Image<[f32; 3]>,
    light: &Light,
    medium: &Medium,
) -> Image<[f32; 3]> {
    let lit: [f32; 3] = [0, 1, 2].map(|k| (medium.albedo[k] * light.radiance[k]) as f32);
    let ambient: [f32; 3] = [0, 1, 2].map(|k| (medium.albedo[k] * light.ambient[k]) as f32);
    let mut result = Image::filled(alpha.width(), alpha.height(), [0.0; 3]);
    result.pixels_mut().par_iter_mut().with_min_len(4096).enumerate().for_each(|(at, pixel)| {
        let (a, s, behind) = (alpha.pixels()[at], scatter.pixels()[at], backdrop.pixels()[at]);
        let clear = (1.0 - a).max(0.0);
        *pixel = [0, 1, 2].map(|k| lit[k] * s + ambient[k] * a + clear * behind[k]);
    });
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smoke_lies_over_the_backdrop() {
        let plane = |value: f32| Image::filled(1, 1, value);
        let backdrop = Image::filled(1, 1, [0.8, 0.4, 0.0]);
        let light = Light { radiance: [2.0; 3], ambient: [0.5; 3], ..Light::default() };
        let medium = Medium { albedo: [1.0, 0.5, 0.0], ..Medium::white(1.0) };
        let of = |a: f32, s: f32| composite(&plane(a), &plane(s), &backdrop, &light, &medium).pixels()[0];
        assert_eq!(of(0.0, 0.0), [0.8, 0.4, 0.0]);
        assert_eq!(of(0.5, 0.25), [0.5 + 0.25 + 0.4, 0.25 + 0.125 + 0.2, 0.0]);
        assert_eq!(of(1.5, 0.0), [0.75, 0.375, 0.0]);
    }
}
