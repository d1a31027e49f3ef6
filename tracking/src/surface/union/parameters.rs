//! What is asked of a union: [`UnionParameters`].

use welter_meshing::surface::MAX_TRIANGLES;

use super::UnionError;

/// The first shift, as a part of the mean edge length of the shape. Well above roundings, well below what is seen.
const FIRST_SHIFT: f64 = 1.0 / 1024.0;

/// At the last of so many shifts, each twice the one before, a shape is half of an edge away.
const MOST_SHIFTS: u32 = 10;

/// How a shape is united with a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnionParameters {
    /// The most triangles afterwards. Default: as many as a mesh can have.
    pub most_triangles: usize,
    /// How often the shape is shifted if it meets the surface in a way that is not in general position, at most 10. The first shift is
    /// 1/1024 of the mean edge length of the shape, each further one twice the one before, each in another direction. Default: 6, so
    /// 1/32 of an edge at most: that is not seen, and many times the width of the slivers that roundings could turn over.
    pub shifts: u32,
}

impl Default for UnionParameters {
    fn default() -> Self {
        Self { most_triangles: MAX_TRIANGLES, shifts: 6 }
    }
}

impl UnionParameters {
    /// Whether all parameters are in their ranges.
    ///
    /// # Errors
    /// [`UnionError::Shifts`].
    pub fn validate(&self) -> Result<(), UnionError> {
        if self.shifts > MOST_SHIFTS {
            return Err(UnionError::Shifts { shifts: self.shifts, most: MOST_SHIFTS });
        }
        Ok(())
    }
}

/// The shift of an attempt, from 0, as parts of the mean edge length: none first, then in directions that no lattice has.
pub(super) fn shift(attempt: u32) -> glam::DVec3 {
    // Fractional parts of the golden ratio and of the roots of 2 and 3, with the signs of a Gray code.
    let direction = glam::DVec3::new(0.618_033_988_749_895, 0.414_213_562_373_095, 0.732_050_807_568_877);
    let Some(k) = attempt.checked_sub(1) else { return glam::DVec3::ZERO };
    let code = k ^ (k >> 1);
    let sign = |bit: u32| if code >> bit & 1 == 1 { -1.0 } else { 1.0 };
    let turned = match k % 3 {
        0 => direction,
        1 => glam::DVec3::new(direction.y, direction.z, direction.x),
        _ => glam::DVec3::new(direction.z, direction.x, direction.y),
    };
    turned * glam::DVec3::new(sign(0), sign(1), sign(2)) * (FIRST_SHIFT * f64::from(1_u32 << k))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shifts_grow_and_differ() {
        assert_eq!(shift(0), glam::DVec3::ZERO);
        let shifts: Vec<_> = (1..=MOST_SHIFTS).map(shift).collect();
        for pair in shifts.windows(2) {
            let ratio = pair[1].length() / pair[0].length();
            assert!((ratio - 2.0).abs() < 1e-12, "{ratio}");
            assert!(pair[0].cross(pair[1]).length() > 0.1 * pair[0].length() * pair[1].length());
        }
        assert!(shifts.iter().all(|shift| shift.length() < 0.6));
        assert!(UnionParameters { shifts: MOST_SHIFTS, ..UnionParameters::default() }.validate().is_ok());
        assert!(
            UnionParameters { shifts: MOST_SHIFTS + 1, ..UnionParameters::default() }.validate().is_err()
        );
    }
}
