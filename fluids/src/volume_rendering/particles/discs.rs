//! Particles as the camera sees them, and which pixels they may cover.
//!
//! The box around a ball along the axes of the camera is projected, a pixel added on each side. So every pixel whose ray meets the
//! ball is in the rectangle. A box that reaches behind the eye counts for the whole image; a ball behind it for nothing.

use glam::DVec3;

use super::super::camera::View;
use super::super::raster::Window;

/// A particle in the frame of the camera.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    /// To the right, downward, forward.
    pub(super) center: DVec3,
    pub(super) age: f64,
    /// The first column and row that it may cover, and those after the last.
    first: [u16; 2],
    end: [u16; 2],
}

impl Disc {
    /// None if no pixel sees the ball.
    pub(super) fn new(view: &View, center: DVec3, radius: f64, age: f64) -> Option<Self> {
        let center = view.place(center);
        let (near, far) = (center.z - radius, center.z + radius);
        if far.is_nan() || far <= 0.0 {
            return None;
        }
        let sizes = [view.width, view.height];
        let (mut first, mut end) = ([0_u16; 2], sizes.map(|n| n as u16));
        if near > 0.0 {
            for axis in 0..2 {
                let (low, high) = (center[axis] - radius, center[axis] + radius);
                let middle = 0.5 * f64::from(sizes[axis]);
                let low = view.focal * (low / near).min(low / far) + middle;
                let high = view.focal * (high / near).max(high / far) + middle;
                // The casts saturate.
                first[axis] = ((low - 1.0) as u16).min(end[axis]);
                end[axis] = ((high + 2.0) as u16).min(end[axis]);
                if first[axis] >= end[axis] {
                    return None;
                }
            }
        }
        Some(Self { center, age, first, end })
    }

    /// Rows that it may cover.
    pub(super) fn rows(&self) -> [u16; 2] {
        [self.first[1], self.end[1]]
    }

    /// Pixels that it may cover.
    pub(super) fn window(&self) -> Window {
        let [x, y] = [0, 1].map(|axis| u32::from(self.first[axis])..u32::from(self.end[axis]));
        Window { x, y }
    }
}
