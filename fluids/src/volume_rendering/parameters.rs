//! How a picture is made: [`RenderParameters`], [`AgeBlur`].

use super::{MAX_PIXELS, MAX_SIDE, RenderError};

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderParameters {
    /// Pixels in a row, from 1 to [`MAX_SIDE`]. Default: 960.
    pub width: u32,
    /// Rows of pixels, from 1 to [`MAX_SIDE`]. Default: 540.
    pub height: u32,
    /// Voxels of the shadow texture along the longest side of the smoke, as seen from the light; from 1 to
    /// 4096. Voxels are cubes, so this sets the other sides. Default: 128, between the sides of the texture
    /// of \[Brochu12, section 6.7\].
    pub shadow_resolution: u32,
    /// Most triangles of the smoke's surface in the columns of the shadow texture, in the mean, with which light
    /// is traced through the surface itself where the texture would be off; a single column may have four
    /// times as many. With more, and always if this is 0, the light is that of the texture. Time goes with it
    /// where the surface is oblique to the light or its shadow has an edge. Default: 16, which holds for a
    /// surface whose triangles are no smaller than voxels and that has a few layers along the light; the
    /// picture is then within 1 % of one with all rays traced, also of sheets thinner than a voxel.
    pub traced_triangles: u32,
    /// Most optical depth between two samples of the light along a ray; they are also at most a voxel apart.
    /// From 2^-10 to 1. Default: 1/4: what the light of a sample misses is below (1/4)^2 / 24 of it where
    /// light falls off at that rate too.
    pub optical_step: f64,
    /// Part of the light from beyond that no longer needs samples of its own: what lies deeper gets the light
    /// of the last sample. From 2^-30 to 1/2. Default: 2^-12, below a step of an 8-bit image.
    pub dark: f64,
    /// Blur of old smoke. Default: none.
    pub age_blur: Option<AgeBlur>,
}

impl Default for RenderParameters {
    fn default() -> Self {
        Self {
            width: 960,
            height: 540,
            shadow_resolution: 128,
            traced_triangles: 16,
            optical_step: 0.25,
            dark: 1.0 / 4096.0,
            age_blur: None,
        }
    }
}

impl RenderParameters {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`RenderError`] with the first that is not.
    pub fn validate(&self) -> Result<(), RenderError> {
        let (width, height) = (self.width, self.height);
        let side = 1..=MAX_SIDE;
        if !side.contains(&width)
            || !side.contains(&height)
            || u64::from(width) * u64::from(height) > MAX_PIXELS
        {
            return Err(RenderError::ImageSize { width, height });
        }
        let voxels = self.shadow_resolution;
        let fits = (1..=4096).contains(&voxels);
        RenderError::require(fits, "shadow_resolution", f64::from(voxels), "from 1 to 4096")?;
        let fits = (1.0 / 1024.0..=1.0).contains(&self.optical_step);
        RenderError::require(fits, "optical_step", self.optical_step, "from 2^-10 to 1")?;
        let fits = (1.0 / f64::from(1 << 30)..=0.5).contains(&self.dark);
        RenderError::require(fits, "dark", self.dark, "from 2^-30 to 1/2")?;
        self.age_blur.map_or(Ok(()), |blur| blur.validate())
    }
}

/// How smoke is blurred as it ages: as if it diffused across the picture \[Brochu12, section 6.6\].
///
/// The standard deviation of the blur is `spread_rel` times the height of the image times the square root of
/// the age, as that of a diffusing substance is, and at most `most_rel` times the height of the image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AgeBlur {
    /// Standard deviation at age 1, as part of the height of the image; finite, from 0 on. It depends on the
    /// unit of time, so there is no default.
    pub spread_rel: f64,
    /// Largest standard deviation, as part of the height of the image; from 0 to 1/8. [`AgeBlur::new`] sets
    /// 1/40.
    pub most_rel: f64,
}

impl AgeBlur {
    /// A blur of a standard deviation at age 1, in parts of the height of the image.
    #[must_use]
    pub fn new(spread_rel: f64) -> Self {
        Self { spread_rel, most_rel: 0.025 }
    }

    /// Whether both numbers are in range.
    ///
    /// # Errors
    /// [`RenderError`] with the first that is not.
    pub fn validate(&self) -> Result<(), RenderError> {
        let fits = (0.0..=f64::MAX).contains(&self.spread_rel);
        RenderError::require(fits, "spread_rel", self.spread_rel, "finite and not below 0")?;
        let fits = (0.0..=0.125).contains(&self.most_rel);
        RenderError::require(fits, "most_rel", self.most_rel, "from 0 to 1/8")
    }

    /// The standard deviation in pixels.
    pub(super) fn deviation(&self, age: f64, height: usize) -> f64 {
        (self.spread_rel * age.sqrt()).min(self.most_rel) * height as f64
    }
}
