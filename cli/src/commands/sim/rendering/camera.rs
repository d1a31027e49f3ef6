//! From where a run is seen, in all frames the same: [`CameraSpec`].

use crate::commands::sim::bounds::Bounds;
use crate::failure::Failure;
use crate::runs::settings::{ANY, FINITE, Settings};
use glam::DVec3;
use welter_fluids::volume_rendering::Camera;

/// What a scene says of its camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CameraSpec {
    Placed(Camera),
    /// So far away that a box is in the picture.
    Around {
        up: DVec3,
        /// Radians.
        azimuth: f64,
        elevation: f64,
        field_of_view: f64,
        /// The part of the picture that the box fills, across or upright.
        fill: f64,
        /// None for one around all that is known of the scene beforehand.
        bounds: Option<Bounds>,
    },
}

impl CameraSpec {
    pub(super) fn read(table: &mut Settings<'_>) -> Result<Self, Box<Failure>> {
        let up = table.vector("up", DVec3::Z)?;
        let degrees = table.number("field_of_view", 40.0, ANY)?;
        let field_of_view = degrees.to_radians();
        let (eye, target) = (table.optional_vector("eye")?, table.optional_vector("target")?);
        let spec = match (eye, target) {
            (Some(eye), Some(target)) => {
                for key in ["azimuth", "elevation", "fill", "box"] {
                    if table.has(key) {
                        return Err(table.bad(key, "either eye and target, or a way around a box, not both"));
                    }
                }
                // Known here, so that they are told from keys that nobody knows.
                Self::Placed(Camera { eye, target, up, vertical_field_of_view: field_of_view })
            }
            (None, None) => {
                let azimuth = table.number("azimuth", 30.0, FINITE)?;
                let elevation = table.number("elevation", 10.0, FINITE)?;
                let fill = table.number("fill", 0.9, FINITE)?;
                let wanted = "an array of two corners, such as [[-1, -1, 0], [1, 1, 3]]";
                let bounds = match table.optional_rows::<3>("box", wanted)? {
                    None => None,
                    Some(rows) => match rows[..] {
                        [low, high] if (0..3).all(|k| low[k] < high[k]) => {
                            Some(Bounds { low: low.into(), high: high.into() })
                        }
                        _ => return Err(table.bad("box", wanted)),
                    },
                };
                if !(fill > 0.0 && fill <= 1.0) {
                    return Err(table.bad("fill", "above 0, up to 1"));
                }
                if elevation.abs() >= 90.0 {
                    return Err(table.bad("elevation", "between -90 and 90 degrees"));
                }
                let (azimuth, elevation) = ((azimuth % 360.0).to_radians(), elevation.to_radians());
                Self::Around { up, azimuth, elevation, field_of_view, fill, bounds }
            }
            (Some(_), None) => {
                return Err(table.bad("eye", "a target belongs to it").help("target = [0, 0, 0]"));
            }
            (None, Some(_)) => {
                return Err(table.bad("target", "an eye belongs to it").help("eye = [5, 0, 0]"));
            }
        };
        // With a box in the place of one that is not known yet.
        let unit = Bounds { low: DVec3::NEG_ONE, high: DVec3::ONE };
        spec.camera(unit, [1, 1]).validate().map_err(|error| {
            let key = if error.to_string().contains("field_of_view") { "field_of_view" } else { "up" };
            table.bad(key, error.to_string())
        })?;
        Ok(spec)
    }

    /// The camera for a picture of a size; `known` is a box around all that is known of the scene.
    pub(super) fn camera(&self, known: Bounds, [width, height]: [u32; 2]) -> Camera {
        let (up, azimuth, elevation, field_of_view, fill, bounds) = match *self {
            Self::Placed(camera) => return camera,
            Self::Around { up, azimuth, elevation, field_of_view, fill, bounds } => {
                (up, azimuth, elevation, field_of_view, fill, bounds.unwrap_or(known))
            }
        };
        // Azimuth 0: x to the right; or y, where x is up.
        let above = (up / up.abs().max_element()).normalize_or_zero();
        let across = if above.x.abs() < 0.9 { DVec3::X } else { DVec3::Y };
        let side = (across - across.dot(above) * above).normalize_or_zero();
        let front = side.cross(above);
        let away = side * libm::sin(azimuth) + front * libm::cos(azimuth);
        let toward_eye = away * libm::cos(elevation) + above * libm::sin(elevation);
        let right = above.cross(toward_eye).normalize_or_zero();
        let top = toward_eye.cross(right);
        let slope = fill * libm::tan(0.5 * field_of_view);
        let slopes = [slope * f64::from(width) / f64::from(height), slope];
        let middle = bounds.middle();
        // The eye is farther away than the farthest corner is from the middle, and sees every corner in the frame.
        let least = 0.51 * bounds.diagonal();
        let distance = bounds.corners().into_iter().fold(least, |distance, corner| {
            let p = corner - middle;
            let near = p.dot(toward_eye);
            let [x, y] = [p.dot(right).abs() / slopes[0], p.dot(top).abs() / slopes[1]];
            distance.max(near + x.max(y))
        });
        Camera {
            eye: middle + distance * toward_eye,
            target: middle,
            up,
            vertical_field_of_view: field_of_view,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_box_is_in_the_picture_and_touches_its_margin() {
        let bounds = Bounds { low: DVec3::new(-1.0, -2.0, 0.0), high: DVec3::new(1.0, 0.5, 5.0) };
        for up in [DVec3::Z, DVec3::Y, DVec3::X, DVec3::new(1.0, 2.0, -3.0)] {
            for (azimuth, elevation) in [(0.0, 0.0), (0.7, 0.3), (3.0, -1.2)] {
                let spec = CameraSpec::Around {
                    up,
                    azimuth,
                    elevation,
                    field_of_view: 0.6,
                    fill: 0.8,
                    bounds: Some(bounds),
                };
                let camera = spec.camera(Bounds::around(DVec3::ZERO, 1.0), [300, 200]);
                assert!(camera.validate().is_ok());
                let forward = (camera.target - camera.eye).normalize();
                let right = forward.cross(up).normalize();
                let top = right.cross(forward);
                let slope = (0.3_f64).tan();
                let most = bounds.corners().into_iter().map(|corner| {
                    let p = corner - camera.eye;
                    assert!(p.dot(forward) > 0.0);
                    let [x, y] = [p.dot(right), p.dot(top)].map(|c| (c / p.dot(forward)).abs() / slope);
                    (x / 1.5).max(y)
                });
                let most = most.fold(0.0, f64::max);
                assert!((most - 0.8).abs() < 1e-12, "{most} {up} {azimuth} {elevation}");
            }
        }
    }
}
