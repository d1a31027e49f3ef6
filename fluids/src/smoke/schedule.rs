//! When surfaces are released: [`Schedule`].

use super::EmissionError;

/// Times at equal intervals, `start + index interval` for each index below the count.
///
/// ```
/// use welter_fluids::smoke::Schedule;
/// let puffs = Schedule { start: 1.0, interval: 0.5, count: Some(3) };
/// puffs.validate()?;
/// let times = |from, to| puffs.within(from, to).map(|release| release.time).collect::<Vec<_>>();
/// assert_eq!(times(0.0, 1.5), [1.0]);
/// assert_eq!(times(1.5, 9.0), [1.5, 2.0]);
/// # Ok::<(), welter_fluids::smoke::EmissionError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schedule {
    /// Time of the first release, finite. Default: 0.
    pub start: f64,
    /// From one release to the next, finite and above 0, and not so short that it vanishes next to the start. Not looked at if there
    /// is only one. Default: 1.
    pub interval: f64,
    /// How many releases there are, at least 1; none for 2^32 of them, more than any run takes. Default: one.
    pub count: Option<u32>,
}

impl Default for Schedule {
    fn default() -> Self {
        Self { start: 0.0, interval: 1.0, count: Some(1) }
    }
}

/// A release of a schedule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Release {
    /// The how manieth it is, from 0.
    pub index: u32,
    /// When.
    pub time: f64,
}

impl Schedule {
    /// Whether the parameters are in range.
    ///
    /// # Errors
    /// [`EmissionError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), EmissionError> {
        let &Self { start, interval, count } = self;
        let parameter = |name, value, must| Err(EmissionError::Parameter { name, value, must });
        if !start.is_finite() {
            return parameter("start", start, "finite");
        }
        match count {
            Some(0) => parameter("count", 0.0, "at least 1"),
            Some(1) => Ok(()),
            _ if !(interval.is_finite() && interval > 0.0 && start + interval > start) => {
                parameter("interval", interval, "finite, above 0, and enough to change the start")
            }
            _ => Ok(()),
        }
    }

    /// The time of an index; later for larger ones, or the same where the interval vanishes next to the time.
    fn time(&self, index: u32) -> f64 {
        // Not a sum of intervals: no drift, and the same for every way to come to it.
        if index == 0 { self.start } else { self.start + f64::from(index) * self.interval }
    }

    /// The first index, or the count, whose time is not before a time.
    fn first_from(&self, time: f64) -> u64 {
        let (mut low, mut high) = (0, self.count.map_or(1 << 32, u64::from));
        while low < high {
            let middle = low + (high - low) / 2;
            // Below the count, so below 2^32.
            if self.time(middle as u32) < time { low = middle + 1 } else { high = middle }
        }
        low
    }

    /// The releases from one time on and before another, in order.
    pub fn within(&self, from: f64, to: f64) -> impl Iterator<Item = Release> + '_ {
        let (first, end) = (self.first_from(from), self.first_from(to));
        (first..end).map(|index| {
            let index = index as u32;
            Release { index, time: self.time(index) }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_release_falls_into_one_step() {
        for schedule in [
            Schedule { start: 0.3, interval: 0.1, count: Some(50) },
            Schedule { start: -1.0, interval: 1.0 / 3.0, count: None },
            Schedule { start: 1e15, interval: 0.25, count: None },
        ] {
            schedule.validate().unwrap();
            for steps in [1, 7, 60, 1000] {
                let ends: Vec<f64> = (0..=steps)
                    .map(|i| schedule.start - 0.5 + f64::from(i) * 8.0 / f64::from(steps))
                    .collect();
                let released: Vec<Release> =
                    ends.windows(2).flat_map(|step| schedule.within(step[0], step[1])).collect();
                assert!(
                    released.iter().enumerate().all(|(i, release)| release.index as usize == i),
                    "{schedule:?}"
                );
                let all = schedule.within(f64::NEG_INFINITY, ends[ends.len() - 1]);
                assert!(released.len() > 10 && all.eq(released.iter().copied()), "{schedule:?}, {steps}");
            }
        }
    }

    #[test]
    fn there_are_as_many_as_asked_for() {
        let count = |schedule: Schedule| schedule.within(f64::NEG_INFINITY, 1e9).count();
        assert_eq!(count(Schedule::default()), 1);
        assert_eq!(count(Schedule { count: Some(17), ..Schedule::default() }), 17);
        let once = Schedule { interval: f64::NAN, ..Schedule::default() };
        assert_eq!((once.validate().is_ok(), count(once)), (true, 1));
        let endless = Schedule { count: None, interval: 1e-3, ..Schedule::default() };
        assert_eq!(endless.within(4.0, 5.0).count(), 1000);
        assert_eq!(endless.within(5.0, 4.0).count(), 0);
        assert_eq!(endless.within(f64::NAN, f64::NAN).count(), 0);
        assert_eq!(endless.first_from(f64::INFINITY), 1 << 32);
    }

    #[test]
    fn schedules_out_of_range_are_refused() {
        let name = |schedule: Schedule| match schedule.validate() {
            Err(EmissionError::Parameter { name, .. }) => name,
            other => panic!("{other:?}"),
        };
        let endless = Schedule { count: None, ..Schedule::default() };
        for start in [f64::NAN, f64::INFINITY] {
            assert_eq!(name(Schedule { start, ..endless }), "start");
        }
        for interval in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(name(Schedule { interval, ..endless }), "interval");
        }
        assert_eq!(name(Schedule { start: 1e17, ..endless }), "interval");
        assert_eq!(name(Schedule { count: Some(0), ..endless }), "count");
    }
}
