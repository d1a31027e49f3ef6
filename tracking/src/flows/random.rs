//! Random numbers that are the same everywhere: [`Random`].

use std::f64::consts::TAU;

use glam::DVec3;

/// A sequence of 64 bits each, by the generator of \[Steele14\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Random {
    state: u64,
}

/// 2^64 over the golden ratio, odd.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

impl Random {
    /// The sequence of several numbers, each of which changes all of it.
    pub(crate) fn of(numbers: &[u64]) -> Self {
        numbers.iter().fold(Self { state: 0 }, |mut random, &number| {
            random.state ^= number;
            Self { state: random.next() }
        })
    }

    /// The next 64 bits.
    pub(crate) fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(STEP);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A multiple of 2^-53 in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number in [-1, 1).
    pub(crate) fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// A unit vector; all directions are equally likely (a slice of the sphere has the area of that of its cylinder).
    pub(crate) fn direction(&mut self) -> DVec3 {
        let z = self.signed();
        let (sin, cos) = libm::sincos(TAU * self.unit());
        let across = (1.0 - z * z).max(0.0).sqrt();
        DVec3::new(across * cos, across * sin, z)
    }
}
