//! Positions relative to a primitive, in units of a power of two near its size: [`Frame`].

use glam::DVec3;

/// An origin and a power of two. Relative positions are the same bits when all lengths are multiplied by a power of two,
/// and powers of them are numbers whatever the size of the primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    origin: DVec3,
    /// Relative lengths are this times true ones.
    factor: f64,
}

/// Where a position is, as a [`Frame`] sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// Relative to the origin, in units.
    Near(DVec3),
    /// Farther away than 2^500 units, where every primitive that decays counts as zero.
    Far,
    /// Infinite, or not a number.
    Nowhere,
}

/// In units. The square is a number.
const FAR: f64 = f64::from_bits((1023 + 500) << 52);

impl Frame {
    /// The frame in which a size, a positive number within 2^-1000 and 2^1000, is in [1/2, 1).
    pub(super) fn new(origin: DVec3, size: f64) -> Self {
        let (_, exponent) = libm::frexp(size);
        Self { origin, factor: libm::scalbn(1.0, -exponent) }
    }

    /// A length, or a vector of lengths, in units.
    pub(super) fn scaled<T: std::ops::Mul<f64, Output = T>>(&self, length: T) -> T {
        length * self.factor
    }

    /// A position, relative to the origin in units.
    pub(super) fn place(&self, position: DVec3) -> Place {
        if !position.is_finite() {
            return Place::Nowhere;
        }
        let relative = (position - self.origin) * self.factor;
        // A difference beyond the largest number is infinite, and far.
        if relative.abs().max_element() <= FAR { Place::Near(relative) } else { Place::Far }
    }
}

/// The unit vector along a vector that has a direction.
pub(super) fn unit(vector: DVec3) -> DVec3 {
    let vector = vector / vector.abs().max_element();
    vector / vector.length()
}
