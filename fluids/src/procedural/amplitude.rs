//! Weights that depend on time: [`Amplitude`].

use super::{Interpolation, Keyframes, ProceduralError};

/// The weight of a part of a flow.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Amplitude {
    /// The same at all times.
    Constant(f64),
    /// By keyframes.
    Keyed(Keyframes<f64>),
    /// On and off, once or again and again.
    Pulsed(Pulse),
}

impl Amplitude {
    /// The weight at a time.
    ///
    /// ```
    /// use welter_fluids::procedural::{Amplitude, Pulse};
    /// let puff = Amplitude::Pulsed(Pulse::new(3.0, 1.0, [0.5, 1.0, 0.5], 4.0)?);
    /// assert_eq!([0.0, 1.25, 2.0, 2.75, 3.5, 6.0].map(|t| puff.at(t)), [0.0, 1.5, 3.0, 1.5, 0.0, 3.0]);
    /// # Ok::<(), welter_fluids::procedural::ProceduralError>(())
    /// ```
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Constant(weight) => *weight,
            Self::Keyed(keys) => keys.at(time),
            Self::Pulsed(pulse) => pulse.at(time),
        }
    }
}

/// A weight that rises smoothly from zero, stays, and falls smoothly to zero; three derivatives are continuous.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulse {
    keys: Keyframes<f64>,
    start: f64,
    period: f64,
}

impl Pulse {
    /// A pulse of a height that begins at `start`, with the durations of its rise, its top and its fall; the next one begins a
    /// period later, never if that is infinite.
    ///
    /// # Errors
    /// [`ProceduralError::Parameter`]: a height or a start that is not finite; a rise or a fall that is not finite and above 0, a top that is
    /// not finite and at least 0; a period shorter than the pulse.
    pub fn new(
        height: f64,
        start: f64,
        [rise, top, fall]: [f64; 3],
        period: f64,
    ) -> Result<Self, ProceduralError> {
        ProceduralError::require_finite("height", height)?;
        ProceduralError::require_finite("start", start)?;
        for (name, duration) in [("rise", rise), ("fall", fall)] {
            let ok = duration.is_finite() && duration > 0.0;
            ProceduralError::require(ok, name, duration, "finite and above 0")?;
        }
        ProceduralError::require(top.is_finite() && top >= 0.0, "top", top, "finite and not below 0")?;
        let whole = rise + top + fall;
        ProceduralError::require(
            period >= whole,
            "period",
            period,
            "at least as long as rise, top and fall",
        )?;
        let mut keys = vec![(0.0, 0.0), (rise, height)];
        if top > 0.0 {
            keys.push((rise + top, height));
        }
        keys.push((whole, 0.0));
        Ok(Self { keys: Keyframes::new(keys, Interpolation::Smooth)?, start, period })
    }

    /// The weight at a time.
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        let since = time - self.start;
        if since < self.period || since.is_nan() {
            // Before the first as well: zero.
            return self.keys.at(since);
        }
        // The remainder is exact.
        self.keys.at(since % self.period)
    }
}
