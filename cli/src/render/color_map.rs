//! Colour maps of even perceived steps, from a formula.
//!
//! In the Oklab space \[Ottosson20\] with lightness L, chroma C and hue h, at position t in [0, 1]:
//! ```text
//! sequential   L = 0.28 + 0.62 t     h = 300 - 200 t degrees (violet, blue, green, yellow)   C = 0.093 + 0.22 (t - 0.42)^2
//! diverging    L = 0.93 - 0.43 s     h = 255 (t < 1/2) or 45 degrees (blue, orange)          C = 0.14 s,  s = |2t - 1|
//! ```
//! C stays just within what sRGB can show at that lightness and hue, least for the greenish blue near t = 0.42: a smooth
//! curve, so that no step stands out. Lightness alone orders the sequential map, so that it survives greyscale print and
//! colour-blind eyes; blue against orange does so for the diverging one.

use super::color::Rgb;

/// Which colours a range of numbers takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum ColorMap {
    /// Dark violet over green to light yellow.
    #[default]
    Sequential,
    /// Blue over near-white to orange: for values around a middle.
    Diverging,
}

impl ColorMap {
    /// Colour at `t`, clamped to [0, 1]; grey for NaN.
    pub(crate) fn at(self, t: f64) -> Rgb {
        if t.is_nan() {
            return Rgb::of_bytes([128, 128, 128]);
        }
        let t = t.clamp(0.0, 1.0);
        match self {
            Self::Sequential => {
                of_polar(0.28 + 0.62 * t, 0.093 + 0.22 * (t - 0.42) * (t - 0.42), 300.0 - 200.0 * t)
            }
            Self::Diverging => {
                let s = (2.0 * t - 1.0).abs();
                of_polar(0.93 - 0.43 * s, 0.14 * s, if t < 0.5 { 255.0 } else { 45.0 })
            }
        }
    }

    /// 256 colours, evenly spaced.
    pub(crate) fn table(self) -> Vec<Rgb> {
        (0..256).map(|i| self.at(f64::from(i) / 255.0)).collect()
    }
}

/// Lightness, chroma and hue to linear sRGB.
fn of_polar(lightness: f64, chroma: f64, hue_degrees: f64) -> Rgb {
    let hue = hue_degrees.to_radians();
    let [r, g, b] =
        linear_srgb(lightness, chroma * libm::cos(hue), chroma * libm::sin(hue)).map(|v| v as f32);
    Rgb::new(r, g, b)
}

/// Oklab to linear sRGB, matrices of \[Ottosson20\].
fn linear_srgb(l: f64, a: f64, b: f64) -> [f64; 3] {
    let cube = |x: f64| x * x * x;
    let long = cube(l + 0.396_337_777_4 * a + 0.215_803_757_3 * b);
    let medium = cube(l - 0.105_561_345_8 * a - 0.063_854_172_8 * b);
    let short = cube(l - 0.089_484_177_5 * a - 1.291_485_548_0 * b);
    [
        4.076_741_662_1 * long - 3.307_711_591_3 * medium + 0.230_969_929_2 * short,
        -1.268_438_004_6 * long + 2.609_757_401_1 * medium - 0.341_319_396_5 * short,
        -0.004_196_086_3 * long - 0.703_418_614_7 * medium + 1.707_614_701_0 * short,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(c: Rgb) -> f32 {
        0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b
    }

    #[test]
    fn the_sequential_map_brightens_at_every_step() {
        let table = ColorMap::Sequential.table();
        for pair in table.windows(2) {
            assert!(luminance(pair[0]) < luminance(pair[1]), "{pair:?}");
        }
    }

    #[test]
    fn colours_are_displayable() {
        for map in [ColorMap::Sequential, ColorMap::Diverging] {
            for c in map.table() {
                for v in [c.r, c.g, c.b] {
                    assert!((0.0..=1.0).contains(&v), "{c:?}");
                }
            }
        }
    }

    #[test]
    fn the_oklab_matrices_send_white_to_white() {
        for v in linear_srgb(1.0, 0.0, 0.0) {
            assert!((v - 1.0).abs() < 1e-6, "{v}");
        }
    }
}
