//! Colours in linear light, and the sRGB transfer function (IEC 61966-2-1:1999).

use std::sync::LazyLock;

/// Red, green and blue in linear light, 0 to 1 where displayable (primaries of sRGB).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Rgb {
    /// Linear red.
    pub(crate) r: f32,
    /// Linear green.
    pub(crate) g: f32,
    /// Linear blue.
    pub(crate) b: f32,
}

impl Rgb {
    pub(crate) const BLACK: Self = Self::new(0.0, 0.0, 0.0);

    pub(crate) const fn new(r: f32, g: f32, b: f32) -> Self {
        Self { r, g, b }
    }

    /// From display values, 0 to 255.
    pub(crate) fn of_bytes(bytes: [u8; 3]) -> Self {
        let [r, g, b] = bytes.map(|v| DECODED[usize::from(v)]);
        Self { r, g, b }
    }

    /// The nearest display values.
    pub(crate) fn to_bytes(self) -> [u8; 3] {
        [self.r, self.g, self.b].map(encode)
    }

    /// Display values that average to this colour over a patch of pixels; `threshold` from [`dither`].
    pub(crate) fn to_bytes_dithered(self, threshold: f32) -> [u8; 3] {
        [self.r, self.g, self.b].map(|v| encode_dithered(v, threshold))
    }

    /// The smaller of each component.
    #[inline]
    pub(crate) fn least(self, o: Self) -> Self {
        Self::new(self.r.min(o.r), self.g.min(o.g), self.b.min(o.b))
    }

    /// `self` at 0, `other` at 1.
    #[inline]
    pub(crate) fn mix(self, other: Self, amount: f32) -> Self {
        self * (1.0 - amount) + other * amount
    }
}

impl std::ops::Add for Rgb {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Self::new(self.r + o.r, self.g + o.g, self.b + o.b)
    }
}

impl std::ops::Mul for Rgb {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        Self::new(self.r * o.r, self.g * o.g, self.b * o.b)
    }
}

impl std::ops::Mul<f32> for Rgb {
    type Output = Self;
    #[inline]
    fn mul(self, s: f32) -> Self {
        Self::new(self.r * s, self.g * s, self.b * s)
    }
}

/// Linear light of a display value in [0, 1] (and of values outside, continued).
pub(crate) fn to_linear(display: f64) -> f64 {
    if display <= 0.040_45 { display / 12.92 } else { libm::pow((display + 0.055) / 1.055, 2.4) }
}

/// Linear light of each display value.
static DECODED: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|v| to_linear(v as f64 / 255.0) as f32));

/// Entry `v` is the least linear light displayed as `v + 1`: the transfer function at `v + 1/2`.
static THRESHOLDS: LazyLock<[f32; 255]> =
    LazyLock::new(|| std::array::from_fn(|v| to_linear((v as f64 + 0.5) / 255.0) as f32));

/// Positions of an 8 x 8 pattern, in bit-reversed order \[Bayer73\]: rounds so that gradients show no bands.
pub(crate) fn dither(x: usize, y: usize) -> f32 {
    let (mut v, x, y) = (0, x as u32 & 7, y as u32 & 7);
    for bit in 0..3 {
        v = (v << 2) | (((x ^ y) >> bit & 1) << 1) | (y >> bit & 1);
    }
    (v as f32 + 0.5) / 64.0
}

/// The display value below or above a linear one; above where the remainder passes `threshold` in (0, 1).
fn encode_dithered(linear: f32, threshold: f32) -> u8 {
    let low = (DECODED.partition_point(|&t| t <= linear).max(1) - 1).min(254);
    let rest = (linear - DECODED[low]) / (DECODED[low + 1] - DECODED[low]);
    low as u8 + u8::from(rest > threshold)
}

fn encode(linear: f32) -> u8 {
    THRESHOLDS.partition_point(|&t| t <= linear) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_display_value_survives_linear_light() {
        for v in 0..=255 {
            assert_eq!(Rgb::of_bytes([v, 0, 255 - v]).to_bytes(), [v, 0, 255 - v]);
        }
    }

    #[test]
    fn values_out_of_range_and_nan_are_displayable() {
        assert_eq!(Rgb::new(-3.0, 7.0, f32::NAN).to_bytes(), [0, 255, 0]);
    }
}
