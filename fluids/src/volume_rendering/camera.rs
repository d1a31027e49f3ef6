//! From where the scene is seen: [`Camera`], and the [`View`] made of it.
//!
//! A pinhole camera with square pixels. The ray of pixel `(i, j)`, column and row from the top left, goes
//! from the eye through the middle of the pixel. Everything in front of the eye is seen, however near: there
//! is no near plane.

use glam::DVec3;

use super::RenderError;

/// A pinhole camera.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::volume_rendering::Camera;
/// let camera = Camera::toward(DVec3::new(0.0, 1.0, 4.0), DVec3::ZERO);
/// assert!(camera.validate().is_ok());
/// assert!(Camera { up: DVec3::ZERO, ..camera }.validate().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the eye is.
    pub eye: DVec3,
    /// What is seen in the middle of the image; not the eye.
    pub target: DVec3,
    /// Upward in the image, any length, not along the line of sight.
    pub up: DVec3,
    /// Angle between the uppermost and the lowest line of sight, in radians, from 2^-20 to 3.
    pub vertical_field_of_view: f64,
}

impl Camera {
    /// A camera with y upward and a field of view of 40 degrees, as of a lens of 50 mm before 35 mm film
    /// upright.
    #[must_use]
    pub fn toward(eye: DVec3, target: DVec3) -> Self {
        Self { eye, target, up: DVec3::Y, vertical_field_of_view: 40.0_f64.to_radians() }
    }

    /// Whether the camera looks anywhere.
    ///
    /// # Errors
    /// [`RenderError`] with the first fault.
    pub fn validate(&self) -> Result<(), RenderError> {
        RenderError::require_finite("the eye of the camera", self.eye)?;
        RenderError::require_finite("the target of the camera", self.target)?;
        RenderError::require_finite("the upward direction of the camera", self.up)?;
        let angle = self.vertical_field_of_view;
        let fits = (1.0 / f64::from(1 << 20)..=3.0).contains(&angle);
        RenderError::require(fits, "vertical_field_of_view", angle, "from 2^-20 to 3 radians")?;
        self.axes().map(|_| ())
    }

    /// Unit vectors to the right, downward and forward, a right-handed frame.
    fn axes(&self) -> Result<[DVec3; 3], RenderError> {
        // Halves, so that the difference of two finite points is finite.
        let forward = unit(self.target * 0.5 - self.eye * 0.5);
        let forward = forward.ok_or(RenderError::Direction { name: "the target", value: self.target })?;
        let nowhere = RenderError::Direction { name: "the upward direction", value: self.up };
        let right = unit(self.up).and_then(|up| unit(forward.cross(up))).ok_or(nowhere)?;
        Ok([right, forward.cross(right), forward])
    }
}

/// The unit vector along a vector, without overflow; none of zero.
pub(super) fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    let v = v / largest;
    let v = v / v.length();
    v.is_finite().then_some(v)
}

/// A camera and its pixels, in scaled coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) eye: DVec3,
    /// To the right, downward, forward.
    pub(super) axes: [DVec3; 3],
    /// Distance from the eye to the image, in pixels.
    pub(super) focal: f64,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl View {
    /// The view of a camera in coordinates multiplied by `scale`.
    pub(super) fn new(camera: &Camera, scale: f64, [width, height]: [u32; 2]) -> Result<Self, RenderError> {
        let focal = 0.5 * f64::from(height) / libm::tan(0.5 * camera.vertical_field_of_view);
        Ok(Self { eye: camera.eye * scale, axes: camera.axes()?, focal, width, height })
    }

    /// A point as seen from the eye: to the right, downward, forward.
    #[inline]
    pub(super) fn place(&self, point: DVec3) -> DVec3 {
        let p = point - self.eye;
        DVec3::new(p.dot(self.axes[0]), p.dot(self.axes[1]), p.dot(self.axes[2]))
    }

    /// From the eye to the point of depth 1 on the ray of a pixel, in the frame of [`View::place`].
    #[inline]
    pub(super) fn ray(&self, x: u32, y: u32) -> DVec3 {
        let middle = |at: u32, count: u32| 0.5 * (2.0 * f64::from(at) + 1.0 - f64::from(count)) / self.focal;
        DVec3::new(middle(x, self.width), middle(y, self.height), 1.0)
    }

    /// A vector of that frame in the coordinates of the scene.
    #[inline]
    pub(super) fn turned_back(&self, v: DVec3) -> DVec3 {
        v.x * self.axes[0] + v.y * self.axes[1] + v.z * self.axes[2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_right_handed_and_tell_directions() {
        let camera = Camera::toward(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO);
        assert_eq!(camera.axes(), Ok([DVec3::X, -DVec3::Y, -DVec3::Z]));
    }

    #[test]
    fn far_and_tiny_vectors_have_directions() {
        let camera = Camera::toward(DVec3::splat(f64::MAX), DVec3::splat(-f64::MAX));
        assert!(camera.validate().is_ok());
        assert_eq!(unit(DVec3::splat(1e-310)).map(|u| u.is_normalized()), Some(true));
        assert_eq!(unit(DVec3::ZERO), None);
    }

    #[test]
    fn cameras_without_a_view_are_refused() {
        let camera = Camera::toward(DVec3::new(0.0, 3.0, 0.0), DVec3::ZERO);
        assert!(matches!(
            camera.validate(),
            Err(RenderError::Direction { name: "the upward direction", .. })
        ));
        let camera = Camera::toward(DVec3::ONE, DVec3::ONE);
        assert!(matches!(camera.validate(), Err(RenderError::Direction { name: "the target", .. })));
        for bad in [0.0, f64::NAN, 3.2] {
            let camera = Camera { vertical_field_of_view: bad, ..Camera::toward(DVec3::ONE, DVec3::ZERO) };
            assert!(matches!(camera.validate(), Err(RenderError::Parameter { .. })), "{bad}");
        }
    }
}
