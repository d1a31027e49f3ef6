//! Where the eye stands: [`View`].
//!
//! The automatic view looks from a little above at the surface turned by a quarter less than halfway, with its longest
//! horizontal principal axis (area-weighted second moments) across the picture. The distance is the smallest from which
//! every vertex falls within the margins: with the eye on the line `p + D d` and half-angle tangents `tx, ty`, a vertex at
//! `(x, y, z)` in axes (right, up, toward the eye) needs `|x - cx| <= tx (D - z)`; the best shift `cx` balances the
//! largest `z + x/tx` and `z - x/tx`, and the same in y.

use super::caption::Layout;
use super::model::Model;
use super::scene::{Camera, RenderError, Scene, Up};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Degrees across the shorter side of the picture: near the angle at which a page is looked at.
const FIELD_OF_VIEW: f64 = 30.0;
/// Degrees that the automatic view is turned from the face of the bounding box, and raised.
const THREE_QUARTER: (f64, f64) = (32.0, 24.0);
/// Share of the frame that the fitted scene fills.
const FILL: f64 = 0.86;
/// Share of the height of a caption that the fitted scene keeps clear: a corner of the frame is seldom filled.
const CLEARANCE: f64 = 0.6;
/// Extent along z below this share of that along y: the thing lies flat, so z is up.
const FLAT: f64 = 0.6;
/// Horizontal second moments nearer than this ratio: no axis is long, so the coordinate axes are kept.
const ROUND: f64 = 1.15;

/// An eye and its axes. View coordinates: the eye at the origin, x right, y up, looking along -z.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) eye: DVec3,
    pub(super) right: DVec3,
    pub(super) above: DVec3,
    pub(super) toward: DVec3,
    /// World up axis in view coordinates.
    pub(super) up: DVec3,
    /// Pixels a unit of slope `x / -z`.
    pub(super) focal: f64,
    /// Picture size in pixels.
    pub(super) size: DVec2,
    /// Where the axis of view meets the picture, in pixels: above the middle if there is a caption.
    pub(super) middle: DVec2,
}

impl View {
    /// From model (unit size) to view coordinates.
    #[inline]
    pub(super) fn of_model(&self, p: DVec3) -> DVec3 {
        self.turn(p - self.eye)
    }

    fn turn(&self, v: DVec3) -> DVec3 {
        DVec3::new(self.right.dot(v), self.above.dot(v), self.toward.dot(v))
    }

    /// Pixel coordinates, y downward, of a point before the eye.
    #[inline]
    pub(super) fn project(&self, p: DVec3) -> DVec2 {
        let s = self.focal / -p.z;
        DVec2::new(self.middle.x + p.x * s, self.middle.y - p.y * s)
    }

    /// The direction with z = -1 through a point of the picture, in pixels.
    #[inline]
    pub(super) fn ray(&self, x: f64, y: f64) -> DVec3 {
        DVec3::new((x - self.middle.x) / self.focal, (self.middle.y - y) / self.focal, -1.0)
    }

    /// The view that a scene asks for.
    pub(super) fn of(scene: &Scene<'_>, model: &Model) -> Result<Self, RenderError> {
        let size = DVec2::new(f64::from(scene.size[0]), f64::from(scene.size[1]));
        let taken = Layout::of(&scene.caption, scene.size).map_or(0.0, |l| CLEARANCE * f64::from(l.height()));
        let middle = DVec2::new(0.5 * size.x, 0.5 * (size.y - taken));
        let focal = 0.5 * size.min_element() / libm::tan((0.5 * FIELD_OF_VIEW).to_radians());
        let up_axis = scene.up.axis(model.half_extent);
        // Azimuth 0: the eye at `front`, `side` to its right.
        let (side, front) = (DVec3::X, DVec3::X.cross(up_axis));
        let (azimuth, elevation, distance) = match scene.camera {
            Camera::Automatic => (
                principal_turn(model, side, front) + THREE_QUARTER.0.to_radians(),
                THREE_QUARTER.1.to_radians(),
                None,
            ),
            Camera::Orbit { azimuth, elevation, distance } => {
                let finite = |name, value: f64| {
                    let fault = RenderError::Parameter { name, value, range: "a finite number" };
                    if value.is_finite() { Ok(value) } else { Err(fault) }
                };
                let azimuth = finite("azimuth", azimuth)? % 360.0;
                let elevation = finite("elevation", elevation)?.clamp(-90.0, 90.0);
                if let Some(value) = distance
                    && !(value.is_finite() && value > 0.0)
                {
                    return Err(RenderError::Parameter {
                        name: "distance",
                        value,
                        range: "finite and positive",
                    });
                }
                (azimuth.to_radians(), elevation.to_radians(), distance)
            }
        };
        let (sa, ca) = (libm::sin(azimuth), libm::cos(azimuth));
        let toward = toward_eye(up_axis, azimuth, elevation);
        let right = side * ca - front * sa;
        let above = toward.cross(right);
        let mut view = Self { eye: DVec3::ZERO, right, above, toward, up: DVec3::ZERO, focal, size, middle };
        view.up = view.turn(up_axis);
        view.eye = match distance {
            // Farther than this the picture is a dot, nearer the eye touches the middle.
            Some(d) => toward * model.frame.length(d, 1e6).max(1e-6),
            None => view.fitted(model),
        };
        Ok(view)
    }

    /// The eye from which everything is in the frame; axes must be set and the eye at the origin.
    fn fitted(&self, model: &Model) -> DVec3 {
        let slope = self.middle * (FILL / self.focal);
        let most = |a: [f64; 4], b: [f64; 4]| std::array::from_fn(|i| a[i].max(b[i]));
        let none = [f64::NEG_INFINITY; 4];
        let reach = model
            .triangles
            .par_iter()
            .fold(
                || none,
                |worst, t| {
                    t.iter().fold(worst, |worst, &v| {
                        let p = self.turn(model.positions[v as usize]);
                        let (x, y) = (p.x / slope.x, p.y / slope.y);
                        most(worst, [p.z + x, p.z - x, p.z + y, p.z - y])
                    })
                },
            )
            .reduce(|| none, most);
        if reach[0] == f64::NEG_INFINITY {
            return self.toward * 4.0;
        }
        let shift = self.right * (0.5 * (reach[0] - reach[1]) * slope.x)
            + self.above * (0.5 * (reach[2] - reach[3]) * slope.y);
        // A point or a far speck: not nearer than shows it as one.
        let distance = (0.5 * (reach[0] + reach[1])).max(0.5 * (reach[2] + reach[3])).max(0.1);
        shift + self.toward * distance
    }
}

impl Up {
    /// The axis, for surfaces of this extent.
    pub(crate) fn axis(self, extent: DVec3) -> DVec3 {
        match self {
            Self::Y => DVec3::Y,
            Self::Z => DVec3::Z,
            Self::Automatic if extent.z < FLAT * extent.y => DVec3::Z,
            Self::Automatic => DVec3::Y,
        }
    }
}

/// From the middle to an eye at angles in radians, of unit length.
pub(crate) fn toward_eye(up: DVec3, azimuth: f64, elevation: f64) -> DVec3 {
    let (side, front) = (DVec3::X, DVec3::X.cross(up));
    let away = side * libm::sin(azimuth) + front * libm::cos(azimuth);
    away * libm::cos(elevation) + up * libm::sin(elevation)
}

/// The turn around the up axis that brings the longest horizontal principal axis across the picture.
fn principal_turn(model: &Model, side: DVec3, front: DVec3) -> f64 {
    let corner = |v: u32| {
        let p = model.positions[v as usize];
        DVec2::new(p.dot(side), p.dot(front))
    };
    // Triangle by triangle in order, so that the sum does not depend on threads.
    let (mut weight, mut mean, mut xx, mut xy, mut yy) = (0.0, DVec2::ZERO, 0.0, 0.0, 0.0);
    for (t, &[a, b, c]) in model.triangles.iter().enumerate() {
        let [p, q, r] = model.corners(&model.positions, t as u32);
        let area = (q - p).cross(r - p).length();
        let middle = (corner(a) + corner(b) + corner(c)) / 3.0;
        weight += area;
        mean += middle * area;
        xx += area * middle.x * middle.x;
        xy += area * middle.x * middle.y;
        yy += area * middle.y * middle.y;
    }
    if weight <= 0.0 {
        return 0.0;
    }
    mean /= weight;
    let (xx, xy, yy) =
        (xx / weight - mean.x * mean.x, xy / weight - mean.x * mean.y, yy / weight - mean.y * mean.y);
    // Eigenvalues of the symmetric 2 x 2 matrix.
    let (middle, radius) = (0.5 * (xx + yy), libm::hypot(0.5 * (xx - yy), xy));
    if middle + radius <= ROUND * (middle - radius).max(0.0) {
        return 0.0;
    }
    // Angle of the long axis from `side` toward `front`, in (-90, 90]; the right axis is `side cos - front sin`.
    -0.5 * libm::atan2(2.0 * xy, xx - yy)
}
