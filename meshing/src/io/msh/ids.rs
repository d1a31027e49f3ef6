//! Numbers that a file gives its nodes or elements, and the places where these stand: [`Numbering`], [`Places`].

/// Numbers as they arrive. Those of most files are 1, 2, 3 and so on, and need no memory.
#[derive(Default)]
pub(super) struct Numbering {
    /// How many there are.
    count: usize,
    /// All of them, from the first that is not the next.
    numbers: Vec<u64>,
}

impl Numbering {
    #[inline]
    pub(super) fn push(&mut self, number: u64) {
        if self.numbers.is_empty() && number != self.count as u64 + 1 {
            self.numbers.extend(1..=self.count as u64);
            self.numbers.push(number);
        } else if !self.numbers.is_empty() {
            self.numbers.push(number);
        }
        self.count += 1;
    }

    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Whether the numbers are 1, 2, 3 and so on.
    pub(super) fn is_plain(&self) -> bool {
        self.numbers.is_empty()
    }

    /// The number at a place.
    pub(super) fn number(&self, place: usize) -> u64 {
        self.numbers.get(place).copied().unwrap_or(place as u64 + 1)
    }

    /// The places by number.
    ///
    /// # Errors
    /// A number that is given twice.
    pub(super) fn into_places(self) -> Result<Places, u64> {
        let Self { count, numbers } = self;
        if numbers.is_empty() {
            return Ok(Places { count, sorted: Vec::new() });
        }
        let mut sorted: Vec<(u64, u32)> = numbers.into_iter().zip(0..).collect();
        sorted.sort_unstable();
        match sorted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            Some(pair) => Err(pair[0].0),
            None => Ok(Places { count, sorted }),
        }
    }
}

/// Where the thing of a number stands.
#[derive(Default)]
pub(super) struct Places {
    count: usize,
    /// Number and place, by number; empty where the numbers are 1, 2, 3 and so on.
    sorted: Vec<(u64, u32)>,
}

impl Places {
    #[inline]
    pub(super) fn place(&self, number: u64) -> Option<usize> {
        if self.sorted.is_empty() {
            return usize::try_from(number.checked_sub(1)?).ok().filter(|&place| place < self.count);
        }
        let found = self.sorted.binary_search_by_key(&number, |pair| pair.0).ok()?;
        Some(self.sorted[found].1 as usize)
    }

    pub(super) fn is_plain(&self) -> bool {
        self.sorted.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_with_and_without_gaps() {
        for numbers in [&[1, 2, 3][..], &[1, 2, 9, 4], &[7], &[3, 2, 1], &[1, 0]] {
            let mut numbering = Numbering::default();
            numbers.iter().for_each(|&number| numbering.push(number));
            assert_eq!(numbering.len(), numbers.len());
            for (place, &number) in numbers.iter().enumerate() {
                assert_eq!(numbering.number(place), number);
            }
            let plain = numbering.is_plain();
            let places = numbering.into_places().unwrap();
            assert_eq!((plain, places.is_plain()), (numbers == [1, 2, 3], numbers == [1, 2, 3]));
            for number in 0..12 {
                assert_eq!(places.place(number), numbers.iter().position(|&n| n == number));
            }
        }
        let mut twice = Numbering::default();
        [1, 2, 2].into_iter().for_each(|number| twice.push(number));
        assert_eq!(twice.into_places().err(), Some(2));
    }
}
