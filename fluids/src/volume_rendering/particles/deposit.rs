//! The volume of particles in the voxels of the shadow texture.
//!
//! A particle is shared among the voxels whose middle lies in it, in proportion to `(1 - r^2/h^2)^2` there, so that its shares add up to
//! its volume. The radius is that of the particle, but one voxel at least, so that there are such middles: less than a voxel is not
//! resolved by the texture anyway.

use glam::DVec3;
use rayon::prelude::*;

/// Rows of voxels that a thread takes at once.
const BAND: usize = 4;

/// The volume in each voxel, in voxels: voxels along the third axis together, then along the first, as those of a surface. Centers
/// and radius are in lattice coordinates, all balls within the lattice.
pub(super) fn volumes(centers: &[DVec3], radius: f64, volume: f64, size: [usize; 3]) -> Vec<f64> {
    let [nx, ny, nz] = size;
    let mut volumes = vec![0.0; nx * ny * nz];
    if volumes.is_empty() {
        return volumes;
    }
    let stamp = Stamp { radius: radius.max(1.0), size };
    let shares: Vec<f64> = centers
        .par_iter()
        .with_min_len(1024)
        .map(|&center| {
            let mut sum = 0.0;
            stamp.visit(center, 0, ny, |_, weight| sum += weight);
            volume / sum
        })
        .collect();
    volumes.par_chunks_mut(nx * nz * BAND).enumerate().for_each(|(band, volumes)| {
        let (first, end) = (band * BAND, (band * BAND + BAND).min(ny));
        let reach = (first as f64 - stamp.radius, end as f64 + stamp.radius);
        for (&center, share) in centers.iter().zip(&shares) {
            if center.y > reach.0 && center.y < reach.1 {
                stamp.visit(center, first, end, |at, weight| volumes[at] += share * weight);
            }
        }
    });
    volumes
}

/// How a particle meets voxels.
struct Stamp {
    radius: f64,
    size: [usize; 3],
}

impl Stamp {
    /// Calls `visit` with the place of each voxel of some rows, counted from the first of these, and its weight.
    fn visit(&self, center: DVec3, first: usize, end: usize, mut visit: impl FnMut(usize, f64)) {
        let [nx, _, nz] = self.size;
        let cells = |axis: usize, first: usize, end: usize| {
            // The casts saturate.
            let low = (center[axis] - self.radius - 0.5).ceil() as usize;
            let high = (center[axis] + self.radius - 0.5).floor() as usize + 1;
            low.max(first)..high.min(end)
        };
        let inverse_square = 1.0 / (self.radius * self.radius);
        let square = |cell: usize, axis: usize| {
            let away = cell as f64 + 0.5 - center[axis];
            away * away * inverse_square
        };
        let (columns, along) = (cells(0, 0, nx), cells(2, 0, nz));
        for j in cells(1, first, end) {
            let from_j = 1.0 - square(j, 1);
            for i in columns.clone() {
                let from_i = from_j - square(i, 0);
                if from_i <= 0.0 {
                    continue;
                }
                let base = ((j - first) * nx + i) * nz;
                for k in along.clone() {
                    let rest = from_i - square(k, 2);
                    if rest > 0.0 {
                        visit(base + k, rest * rest);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_add_up_to_the_volume_also_at_the_border() {
        let size = [5, 9, 4];
        for radius in [0.0, 0.4, 1.0, 1.9] {
            for center in [
                DVec3::new(2.3, 4.1, 1.9),
                DVec3::ZERO,
                DVec3::new(5.0, 9.0, 4.0),
                DVec3::new(2.0, 4.0, 2.0),
                DVec3::new(2.5, 3.5, 1.5),
            ] {
                let volumes = volumes(&[center], radius, 0.3, size);
                let sum: f64 = volumes.iter().sum();
                assert!((sum - 0.3).abs() < 1e-15, "{radius} {center}: {sum}");
                let mean: DVec3 = (0..volumes.len())
                    .map(|at| {
                        let (j, i, k) = (at / 20, at / 4 % 5, at % 4);
                        volumes[at] / sum * (DVec3::new(i as f64, j as f64, k as f64) + 0.5)
                    })
                    .sum();
                assert!(mean.distance(center) < 1.0, "{radius} {center}: {mean}");
            }
        }
        assert!(volumes(&[], 1.0, 1.0, [0; 3]).is_empty());
    }
}
