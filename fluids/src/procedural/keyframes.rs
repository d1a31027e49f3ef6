//! Values that change in time: [`Keyframes`], and positions among them: [`Path`].

use std::ops::{Add, Mul, Sub};

use glam::DVec3;

use super::ProceduralError;

/// What keyframes can have as a value: numbers and vectors.
pub trait Keyed: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> {
    /// What comes to rest.
    const ZERO: Self;

    /// Whether no part of it is infinite or not a number.
    fn is_finite(self) -> bool;
}

impl Keyed for f64 {
    const ZERO: Self = 0.0;

    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

impl Keyed for DVec3 {
    const ZERO: Self = DVec3::ZERO;

    fn is_finite(self) -> bool {
        DVec3::is_finite(self)
    }
}

/// How values go from one keyframe to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// At a constant rate. The rate jumps at keyframes: a step of the method of Runge and Kutta that ends elsewhere has an error of
    /// order 2 there.
    Linear,
    /// From rest to rest, with three continuous derivatives: `35 s^4 - 84 s^5 + 70 s^6 - 20 s^7`.
    #[default]
    Smooth,
}

impl Interpolation {
    /// The part of the way, and its rate, at a part of the time from 0 to 1.
    fn at(self, s: f64) -> (f64, f64) {
        match self {
            Self::Linear => (s, 1.0),
            Self::Smooth => {
                let (forward, back) = (s * s * s, 1.0 - s);
                // From the nearer end, so that both ends are met exactly and the way is the same backwards.
                let part = if s <= 0.5 { seventh(s) } else { 1.0 - seventh(back) };
                (part, 140.0 * forward * (back * back * back))
            }
        }
    }
}

/// `35 s^4 - 84 s^5 + 70 s^6 - 20 s^7`.
fn seventh(s: f64) -> f64 {
    let square = s * s;
    square * square * (35.0 + s * (-84.0 + s * (70.0 - 20.0 * s)))
}

/// A value at each time, given at some. Before the first and after the last it stays.
///
/// ```
/// use welter_fluids::procedural::{Interpolation, Keyframes};
/// let keys = Keyframes::new(vec![(0.0, 1.0), (2.0, 3.0)], Interpolation::Smooth)?;
/// assert_eq!([-1.0, 0.0, 1.0, 2.0, 5.0].map(|t| keys.at(t)), [1.0, 1.0, 2.0, 3.0, 3.0]);
/// assert_eq!(keys.rate(0.0), 0.0);
/// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Keyframes<T> {
    keys: Vec<(f64, T)>,
    course: Course<T>,
}

/// How values go from one keyframe to the next.
#[derive(Clone, Debug, PartialEq)]
enum Course<T> {
    Between(Interpolation),
    /// By the cubic polynomials that have these rates at the keyframes.
    Rates(Vec<T>),
}

/// Displacements over time.
pub type Path = Keyframes<DVec3>;

impl<T: Keyed> Keyframes<T> {
    /// Times and values.
    ///
    /// # Errors
    /// [`ProceduralError::NoKeyframes`], [`ProceduralError::KeyTime`] or [`ProceduralError::KeyValue`] for the first fault.
    pub fn new(keys: Vec<(f64, T)>, interpolation: Interpolation) -> Result<Self, ProceduralError> {
        check(&keys)?;
        Ok(Self { keys, course: Course::Between(interpolation) })
    }

    /// Times, values and how fast they change there: between them the cubic polynomials that fit, so that the rate is continuous. Before
    /// the first and after the last the value stays, whatever the rate.
    ///
    /// ```
    /// use welter_fluids::procedural::Keyframes;
    /// let square = Keyframes::with_rates(&[(0.0, 0.0, 0.0), (2.0, 4.0, 4.0), (3.0, 9.0, 6.0)])?;
    /// assert_eq!([0.5, 1.0, 2.0, 2.5].map(|t| square.at(t)), [0.25, 1.0, 4.0, 6.25]);
    /// assert_eq!(square.rate(1.5), 3.0);
    /// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Keyframes::new`]; [`ProceduralError::KeyValue`] also for a rate that is not finite.
    pub fn with_rates(keys: &[(f64, T, T)]) -> Result<Self, ProceduralError> {
        if let Some(index) = keys.iter().position(|&(_, _, rate)| !rate.is_finite()) {
            return Err(ProceduralError::KeyValue { index });
        }
        let rates = keys.iter().map(|&(_, _, rate)| rate).collect();
        let keys: Vec<_> = keys.iter().map(|&(time, value, _)| (time, value)).collect();
        check(&keys)?;
        Ok(Self { keys, course: Course::Rates(rates) })
    }

    /// The same value at all times.
    ///
    /// # Errors
    /// [`ProceduralError::KeyValue`]: it is not finite.
    pub fn constant(value: T) -> Result<Self, ProceduralError> {
        Self::new(vec![(0.0, value)], Interpolation::default())
    }

    /// Times and values, in order of time; at least one.
    #[must_use]
    pub fn keys(&self) -> &[(f64, T)] {
        &self.keys
    }

    /// The value at a time.
    #[must_use]
    pub fn at(&self, time: f64) -> T {
        self.value_and_rate(time).0
    }

    /// How fast the value changes; at a keyframe, what it does after it.
    #[must_use]
    pub fn rate(&self, time: f64) -> T {
        self.value_and_rate(time).1
    }

    /// Both.
    #[must_use]
    pub fn value_and_rate(&self, time: f64) -> (T, T) {
        // NaN is after no key, and gets the value of the first.
        let after = self.keys.partition_point(|&(key, _)| key <= time);
        let (_, first) = self.keys[after.saturating_sub(1)];
        if after == 0 || after == self.keys.len() {
            return (first, T::ZERO);
        }
        let ((start, a), (end, b)) = (self.keys[after - 1], self.keys[after]);
        let duration = end - start;
        let s = (time - start) / duration;
        match &self.course {
            Course::Between(interpolation) => {
                let (part, rate) = interpolation.at(s);
                (a * (1.0 - part) + b * part, (b - a) * (rate / duration))
            }
            Course::Rates(rates) => {
                let (leaving, arriving, back) = (rates[after - 1], rates[after], 1.0 - s);
                let part = s * s * (3.0 - 2.0 * s);
                let bend = (leaving * back - arriving * s) * (s * back * duration);
                let rate = (b - a) * (6.0 * s * back / duration);
                let slope = leaving * (back * (1.0 - 3.0 * s)) + arriving * (s * (3.0 * s - 2.0));
                (a * (1.0 - part) + b * part + bend, rate + slope)
            }
        }
    }
}

/// Refuses keyframes out of order, or that are not finite.
fn check<T: Keyed>(keys: &[(f64, T)]) -> Result<(), ProceduralError> {
    if keys.is_empty() {
        return Err(ProceduralError::NoKeyframes);
    }
    let mut before = f64::NEG_INFINITY;
    for (index, &(time, value)) in keys.iter().enumerate() {
        if !time.is_finite() || time <= before {
            return Err(ProceduralError::KeyTime { index, time });
        }
        if !value.is_finite() {
            return Err(ProceduralError::KeyValue { index });
        }
        before = time;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_ways_are_flat_at_both_ends_and_symmetric() {
        let smooth = |s: f64| Interpolation::Smooth.at(s);
        assert_eq!([0.0, 0.5, 1.0].map(|s| smooth(s).0), [0.0, 0.5, 1.0]);
        assert_eq!([0.0, 1.0].map(|s| smooth(s).1), [0.0, 0.0]);
        let h = 1.0 / 1024.0;
        for i in 1..512_u32 {
            let s = f64::from(i) * h;
            assert_eq!(smooth(1.0 - s).0, 1.0 - smooth(s).0);
            // The rate is a polynomial of degree six, whose integral over a step Simpson's rule has within h^5 / 2880 times the
            // fourth derivative, below 10^4.
            let way = h / 6.0 * (smooth(s - h).1 + 4.0 * smooth(s - 0.5 * h).1 + smooth(s).1);
            assert!((smooth(s).0 - smooth(s - h).0 - way).abs() < 1e-14, "{s}");
            // Of the fourth power at the ends: three derivatives vanish.
            assert!(smooth(s).0 <= 35.0 * s.powi(4));
        }
    }
}
