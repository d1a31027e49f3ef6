//! Which frames of a scene a command makes: [`FrameRange`].

use crate::codes::Code;
use crate::failure::Failure;
use std::str::FromStr;

/// From a frame to another, which is made too; `None` for the last of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct FrameRange {
    first: u64,
    last: Option<u64>,
}

impl FromStr for FrameRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wanted = || "frames are given as A..B, ..B or A.., such as 0..20".to_owned();
        let (first, last) = text.split_once("..").ok_or_else(wanted)?;
        let number = |text: &str| text.parse::<u64>().map_err(|_| wanted());
        let first = if first.is_empty() { 0 } else { number(first)? };
        let last = if last.is_empty() { None } else { Some(number(last)?) };
        if last.is_some_and(|last| last < first) {
            return Err("the last frame is before the first".to_owned());
        }
        Ok(Self { first, last })
    }
}

impl FrameRange {
    /// The step of the last frame, where frames are some steps apart.
    pub(super) fn last_step(self, every: u64) -> u64 {
        self.last.map_or(u64::MAX, |last| last.saturating_mul(every))
    }

    /// Refuses frames that do not follow on what is there: each depends on those before.
    pub(super) fn require_reached(self, step: u64, every: u64) -> Result<(), Box<Failure>> {
        let reached = step / every;
        // A run that begins makes frame 0, one that goes on makes the next.
        let next = if step == 0 { 0 } else { reached + 1 };
        if self.first <= next {
            return Ok(());
        }
        let what = format!("the next frame is {next}, and frame {} depends on those before it", self.first);
        Err(Failure::new(Code::Usage, what)
            .help(format!("--frames {next}..{}", self.last.map_or(String::new(), |last| last.to_string()))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_read_and_others_refused() {
        let range = |text: &str| text.parse::<FrameRange>();
        assert_eq!(range("3..7"), Ok(FrameRange { first: 3, last: Some(7) }));
        assert_eq!((range(".."), range("..7").map(|r| r.last_step(2))), (Ok(FrameRange::default()), Ok(14)));
        assert_eq!(range("4..").map(|r| r.last_step(2)), Ok(u64::MAX));
        for text in ["", "3", "7..3", "a..b", "-1..3", "1...3", "1..2..3"] {
            assert!(range(text).is_err(), "{text}");
        }
        let from_5 = range("5..9").unwrap();
        assert!(from_5.require_reached(8, 2).is_ok() && from_5.require_reached(20, 2).is_ok());
        assert!(from_5.require_reached(7, 2).is_err() && from_5.require_reached(0, 2).is_err());
    }
}
