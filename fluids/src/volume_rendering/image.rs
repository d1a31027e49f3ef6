//! Planes of pixels: [`Image`].

use rayon::prelude::*;

/// A rectangle of values, row after row from the top, each row from the left.
///
/// ```
/// use welter_fluids::volume_rendering::Image;
/// let mut image = Image::filled(3, 2, 0.0_f32);
/// *image.at_mut(2, 1) = 0.5;
/// assert_eq!(image.pixels(), [0.0, 0.0, 0.0, 0.0, 0.0, 0.5]);
/// assert_eq!((image.width(), image.height(), *image.at(2, 1)), (3, 2, 0.5));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Image<T> {
    width: usize,
    height: usize,
    pixels: Vec<T>,
}

impl<T: Clone> Image<T> {
    /// An image of one value.
    #[must_use]
    pub fn filled(width: usize, height: usize, value: T) -> Self {
        Self { width, height, pixels: vec![value; width * height] }
    }
}

impl<T> Image<T> {
    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// All pixels, row after row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[T] {
        &self.pixels
    }

    /// All pixels, to be changed.
    #[must_use]
    pub fn pixels_mut(&mut self) -> &mut [T] {
        &mut self.pixels
    }

    /// The pixel of a column and a row.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[must_use]
    pub fn at(&self, x: usize, y: usize) -> &T {
        assert!(x < self.width, "column {x} of {}", self.width);
        &self.pixels[y * self.width + x]
    }

    /// The pixel of a column and a row, to be changed.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[must_use]
    pub fn at_mut(&mut self, x: usize, y: usize) -> &mut T {
        assert!(x < self.width, "column {x} of {}", self.width);
        &mut self.pixels[y * self.width + x]
    }
}

impl<T: Copy + Send + Sync> Image<T> {
    /// An image with the sides of another, in the memory of a third of as many pixels, whose values it has at first.
    pub(super) fn like(other: &Self, memory: Self) -> Self {
        assert_eq!(memory.pixels.len(), other.pixels.len(), "the images have as many pixels");
        Self { width: other.width, height: other.height, pixels: memory.pixels }
    }

    /// The image of columns as rows, in the memory of another of as many pixels.
    pub(super) fn transposed(&self, memory: Self) -> Self {
        /// Side of the squares that are moved at once, so that reads and writes stay in the cache.
        const SQUARE: usize = 16;
        let (width, height) = (self.height, self.width);
        let mut pixels = memory.pixels;
        assert_eq!(pixels.len(), self.pixels.len(), "the images have as many pixels");
        if width > 0 {
            pixels.par_chunks_mut(width * SQUARE).enumerate().for_each(|(band, rows)| {
                let first = band * SQUARE;
                let count = rows.len() / width;
                for left in (0..width).step_by(SQUARE) {
                    for row in 0..count {
                        for x in left..(left + SQUARE).min(width) {
                            rows[row * width + x] = self.pixels[x * self.width + first + row];
                        }
                    }
                }
            });
        }
        Self { width, height, pixels }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_become_rows() {
        let mut image = Image::filled(37, 21, (0, 0));
        for y in 0..21 {
            for x in 0..37 {
                *image.at_mut(x, y) = (x, y);
            }
        }
        let turned = image.transposed(Image::filled(37, 21, (0, 0)));
        assert_eq!((turned.width(), turned.height()), (21, 37));
        assert!((0..37).all(|x| (0..21).all(|y| *turned.at(y, x) == (x, y))));
        assert!(turned.transposed(turned.clone()) == image);
    }
}
