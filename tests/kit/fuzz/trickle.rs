//! Input in pieces: [`Trickle`].

use std::io::Read;

/// A reader that gives a few bytes at a time.
pub(super) struct Trickle<'a> {
    pub(super) rest: &'a [u8],
    pub(super) step: usize,
}

impl Read for Trickle<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = self.step.min(buffer.len()).min(self.rest.len());
        let (now, later) = self.rest.split_at(count);
        buffer[..count].copy_from_slice(now);
        self.rest = later;
        Ok(count)
    }
}
