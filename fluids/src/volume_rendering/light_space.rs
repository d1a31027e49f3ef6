//! The lattice of the shadow texture: cubes in rows along the light.
//!
//! Its third axis is the way of the light; the first two are at right angles to it, the first also to the
//! axis of the scene that is most nearly so. It begins at the least coordinates of the smoke along these
//! axes. In lattice coordinates a voxel has side 1.

use glam::DVec3;

use super::camera::unit;
use super::{MAX_VOXELS, RenderError};

/// Axes, origin and size of a lattice, in scaled coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lattice {
    /// Unit vectors; the last is the way of the light.
    pub(super) axes: [DVec3; 3],
    /// The least coordinates along the axes.
    pub(super) origin: DVec3,
    /// Side of a voxel; 0 if there is nothing to enclose.
    pub(super) spacing: f64,
    /// Voxels along each axis; zeros if there is nothing to enclose.
    pub(super) size: [usize; 3],
}

impl Lattice {
    /// The lattice of `resolution` voxels along the longest side of the box, aligned with the light, of balls
    /// of one radius, 0 for points.
    pub(super) fn enclosing(
        points: impl Iterator<Item = DVec3>,
        radius: f64,
        light: DVec3,
        resolution: u32,
    ) -> Result<Self, RenderError> {
        let nowhere = RenderError::Direction { name: "the direction of the light", value: light };
        let axes = axes(light).ok_or(nowhere)?;
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for point in points {
            let p = turned(&axes, point);
            (low, high) = (low.min(p - radius), high.max(p + radius));
        }
        let extent = high - low;
        let longest = extent.max_element();
        let spacing = longest / f64::from(resolution);
        if !(longest > 0.0 && longest < f64::INFINITY && spacing > 0.0) {
            return Ok(Self { axes, origin: DVec3::ZERO, spacing: 0.0, size: [0; 3] });
        }
        let voxels = |length: f64| {
            ((length / longest * f64::from(resolution)).ceil() as usize).clamp(1, resolution as usize)
        };
        let size = extent.to_array().map(voxels);
        if size.iter().product::<usize>() as u64 > MAX_VOXELS {
            return Err(RenderError::ShadowTexture { size });
        }
        Ok(Self { axes, origin: low, spacing, size })
    }

    /// Whether there are no voxels.
    pub(super) fn is_empty(&self) -> bool {
        self.size[0] == 0
    }

    /// A point in lattice coordinates.
    #[inline]
    pub(super) fn place(&self, point: DVec3) -> DVec3 {
        (turned(&self.axes, point) - self.origin) / self.spacing
    }

    /// A vector in lattice coordinates.
    #[inline]
    pub(super) fn turn(&self, vector: DVec3) -> DVec3 {
        turned(&self.axes, vector) / self.spacing
    }

    /// A point of the smoke in lattice coordinates; rounding does not place it outside.
    #[inline]
    pub(super) fn place_inside(&self, point: DVec3) -> DVec3 {
        let [nx, ny, nz] = self.size.map(|n| n as f64);
        self.place(point).clamp(DVec3::ZERO, DVec3::new(nx, ny, nz))
    }
}

/// A right-handed frame of unit vectors that ends with the way of the light.
fn axes(light: DVec3) -> Option<[DVec3; 3]> {
    let w = unit(light)?;
    let size = w.abs();
    let across = if size.x <= size.y && size.x <= size.z {
        DVec3::X
    } else if size.y <= size.z {
        DVec3::Y
    } else {
        DVec3::Z
    };
    let u = unit(across.cross(w))?;
    Some([u, w.cross(u), w])
}

#[inline]
fn turned(axes: &[DVec3; 3], v: DVec3) -> DVec3 {
    DVec3::new(v.dot(axes[0]), v.dot(axes[1]), v.dot(axes[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voxels_are_cubes_that_hold_all_points() {
        let points = [DVec3::new(-1.0, 0.5, 0.1), DVec3::new(2.0, 0.9, -0.3), DVec3::new(0.3, 1.7, 0.2)];
        for light in [DVec3::X, DVec3::NEG_Y, DVec3::new(0.3, -0.9, 0.2), DVec3::new(1e-200, 0.0, 1e-201)] {
            let lattice = Lattice::enclosing(points.into_iter(), 0.0, light, 31).expect("a few points");
            assert_eq!(lattice.size.into_iter().max(), Some(31));
            for p in points {
                let placed = lattice.place(p);
                assert!(placed.distance(lattice.place_inside(p)) < 1e-13, "{placed}");
            }
            let [u, v, w] = lattice.axes;
            assert!(u.cross(v).distance(w) < 1e-15 && w.dot(light) > 0.0);
        }
    }

    #[test]
    fn nothing_needs_no_voxels() {
        for points in [vec![], vec![DVec3::ONE; 3]] {
            let lattice = Lattice::enclosing(points.into_iter(), 0.0, DVec3::X, 8).expect("no voxels");
            assert!(lattice.is_empty());
        }
    }

    #[test]
    fn too_many_voxels_are_refused() {
        let corners = [DVec3::ZERO, DVec3::ONE];
        let error = Lattice::enclosing(corners.into_iter(), 0.0, DVec3::X, 4096);
        assert_eq!(error, Err(RenderError::ShadowTexture { size: [4096; 3] }));
    }
}
