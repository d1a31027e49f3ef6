//! Numbers with their derivatives along the three axes: [`Dual`].

use glam::DVec3;
use std::ops::{Add, Mul, Neg, Sub};

/// A value and its gradient, by the rules of differentiation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual {
    /// The value.
    pub value: f64,
    /// Its derivatives.
    pub gradient: DVec3,
}

impl Dual {
    /// A number that does not depend on the place.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self { value, gradient: DVec3::ZERO }
    }

    /// The three coordinates of a place.
    #[must_use]
    pub fn coordinates(place: DVec3) -> [Self; 3] {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        std::array::from_fn(|k| Self { value: place[k], gradient: axes[k] })
    }

    /// The sine.
    #[must_use]
    pub fn sin(self) -> Self {
        Self { value: self.value.sin(), gradient: self.value.cos() * self.gradient }
    }

    /// The cosine.
    #[must_use]
    pub fn cos(self) -> Self {
        Self { value: self.value.cos(), gradient: -self.value.sin() * self.gradient }
    }

    /// The square root, of a value above zero.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        Self { value, gradient: self.gradient / (2.0 * value) }
    }

    /// One over a value that is not zero.
    #[must_use]
    pub fn recip(self) -> Self {
        Self { value: 1.0 / self.value, gradient: -self.gradient / (self.value * self.value) }
    }

    /// The curl of a vector.
    #[must_use]
    pub fn curl([x, y, z]: [Self; 3]) -> DVec3 {
        DVec3::new(z.gradient.y - y.gradient.z, x.gradient.z - z.gradient.x, y.gradient.x - x.gradient.y)
    }

    /// The values of a vector, and its divergence.
    #[must_use]
    pub fn divergence(vector: [Self; 3]) -> (DVec3, f64) {
        let [x, y, z] = vector;
        (DVec3::new(x.value, y.value, z.value), x.gradient.x + y.gradient.y + z.gradient.z)
    }
}

impl Add for Dual {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, gradient: self.gradient + other.gradient }
    }
}

impl Sub for Dual {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Dual {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, gradient: -self.gradient }
    }
}

impl Mul for Dual {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let gradient = self.value * other.gradient + other.value * self.gradient;
        Self { value: self.value * other.value, gradient }
    }
}

impl Mul<Dual> for f64 {
    type Output = Dual;

    fn mul(self, other: Dual) -> Dual {
        Dual::constant(self) * other
    }
}
