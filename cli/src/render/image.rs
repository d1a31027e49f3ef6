//! [`Image`]: 8-bit pixels and their PNG file.

use super::scene::RenderError;
use std::io::Write;

/// Red, green and blue bytes (sRGB), rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Image {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) pixels: Vec<[u8; 3]>,
}

impl Image {
    /// The pixel in column `x`, row `y` from the top.
    #[cfg(test)]
    pub(crate) fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        self.pixels[y as usize * self.width as usize + x as usize]
    }

    /// Writes a PNG file: 8 bits a channel, marked sRGB, no time stamp, so that equal images give equal files.
    ///
    /// # Errors
    /// [`RenderError::Write`].
    pub(crate) fn write_png(&self, out: impl Write) -> Result<(), RenderError> {
        let failed = |e: png::EncodingError| match e {
            png::EncodingError::IoError(e) => RenderError::Write(e),
            other => RenderError::Write(std::io::Error::other(other)),
        };
        let mut encoder = png::Encoder::new(out, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header().map_err(failed)?;
        writer.write_image_data(self.pixels.as_flattened()).map_err(failed)?;
        writer.finish().map_err(failed)
    }

    /// The bytes of the PNG file.
    ///
    /// # Errors
    /// [`RenderError::Write`].
    pub(crate) fn to_png(&self) -> Result<Vec<u8>, RenderError> {
        let mut bytes = Vec::new();
        self.write_png(&mut bytes)?;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn png_decodes_to_the_same_pixels() {
        let pixels = (0..35u8).map(|i| [i, 7 * i, 255 - i]).collect();
        let image = Image { width: 7, height: 5, pixels };
        let bytes = image.to_png().unwrap();
        assert_eq!(bytes, image.to_png().unwrap());
        let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
        let mut decoded = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut decoded).unwrap();
        assert_eq!((info.width, info.height), (7, 5));
        assert_eq!(decoded, image.pixels.as_flattened());
    }
}
