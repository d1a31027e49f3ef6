//! How well shaped tetrahedra are: [`tetrahedra_quality`].
//!
//! # What it computes
//! Volumes, dihedral angles, and radius ratios: three times the radius of the inscribed sphere over that of the circumscribed one,
//! 1 of a regular tetrahedron and 0 of a flat one. The hexahedra of a [`HexMesh`](super::HexMesh) are cubes and need no figures.
//!
//! # What it promises
//! The same bits for any number of threads. Angles of well shaped tetrahedra are within 1e-14 of those of the positions given; figures
//! do not depend on the unit of length, since each tetrahedron is scaled by a power of two first.
//!
//! # What it does not promise
//! Relative accuracy of the volumes and angles of tetrahedra so flat that their volume is rounding. Whether a volume is positive is decided
//! by `orient3d`, exactly.
//!
//! # Complexity
//! O(n); no memory but for the result.

use std::f64::consts::PI;

use rayon::prelude::*;
use welter_predicates::{Sign, orient3d};

use super::TetMesh;
use super::complex::{EDGES, TetError, check};
use crate::surface::measure::sum::{CHUNK, Sum};
use crate::{DVec3, Monitor};

/// Bins of the histogram of dihedral angles: of 10 degrees each.
pub const DIHEDRAL_BINS: usize = 18;

/// Bins of the histogram of radius ratios: of a tenth each.
pub const RATIO_BINS: usize = 10;

/// Figures of all tetrahedra of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TetQuality {
    /// How many tetrahedra there are.
    pub count: u64,
    /// How many have no positive volume, or a position that is not finite. They count as of radius ratio 0.
    pub not_positive: u64,
    /// The first of those.
    pub first_not_positive: Option<usize>,
    /// The volumes added up, those inside out as negative. Infinite where beyond the range of `f64`, as the other volumes;
    /// not a number if a position is not finite.
    pub volume: f64,
    /// The smallest volume.
    pub min_volume: f64,
    /// The largest volume.
    pub max_volume: f64,
    /// The smallest dihedral angle, in radians.
    pub min_dihedral: f64,
    /// The first tetrahedron that has it.
    pub min_dihedral_at: usize,
    /// The largest dihedral angle, in radians.
    pub max_dihedral: f64,
    /// The first tetrahedron that has it.
    pub max_dihedral_at: usize,
    /// How many dihedral angles there are in each range of 10 degrees; one of 180 degrees counts in the last, and
    /// one that is not a number, of positions that are not finite, in the first.
    pub dihedral_histogram: [u64; DIHEDRAL_BINS],
    /// The smallest radius ratio.
    pub min_ratio: f64,
    /// The first tetrahedron that has it.
    pub min_ratio_at: usize,
    /// How many radius ratios there are in each range of a tenth; 1 counts in the last.
    pub ratio_histogram: [u64; RATIO_BINS],
}

/// The figures of all tetrahedra of a mesh; none of a mesh without. In parallel.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, volumetric::{TetMesh, tetrahedra_quality}};
/// let positions = [[1.0; 3], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(DVec3::from_array);
/// let mesh = TetMesh { positions: positions.to_vec(), tetrahedra: vec![[0, 2, 1, 3]], hexahedra: vec![0] };
/// let quality = tetrahedra_quality(&mesh, &Monitor::none())?.expect("it has a tetrahedron");
/// // A regular one.
/// assert!((quality.min_ratio - 1.0).abs() < 1e-14 && (quality.volume - 8.0 / 3.0).abs() < 1e-14);
/// assert!((quality.min_dihedral.cos() - 1.0 / 3.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`TetError`]: a corner that is no vertex or is there twice, or cancelled.
pub fn tetrahedra_quality(mesh: &TetMesh, monitor: &Monitor<'_>) -> Result<Option<TetQuality>, TetError> {
    check(mesh)?;
    let stage = monitor.stage("quality of tetrahedra", mesh.tetrahedra.len() as u64);
    let chunks: Vec<Option<(TetQuality, Sum)>> = mesh
        .tetrahedra
        .par_chunks(CHUNK)
        .enumerate()
        .map(|(chunk, tetrahedra)| {
            stage.check()?;
            let figures = tetrahedra.iter().zip(chunk * CHUNK..).map(|(corners, at)| {
                let one = Tetrahedron::of(corners.map(|v| mesh.positions[v as usize]));
                let mut volume = Sum::default();
                volume.add(one.volume);
                (one.quality(at), volume)
            });
            let figures = figures.reduce(both);
            stage.advance(tetrahedra.len() as u64);
            Ok(figures)
        })
        .collect::<Result<_, crate::Cancelled>>()?;
    let all = chunks.into_iter().flatten().reduce(both);
    Ok(all.map(|(quality, volume)| TetQuality { volume: volume.value(), ..quality }))
}

/// One tetrahedron.
struct Tetrahedron {
    positive: bool,
    volume: f64,
    ratio: f64,
    dihedrals: [f64; 6],
}

impl Tetrahedron {
    fn of(corners: [DVec3; 4]) -> Self {
        let [a, b, c, d] = corners;
        let positive = corners.iter().all(|p| p.is_finite()) && orient3d(a, b, c, d) == Sign::Negative;
        // By a power of two, so that the largest edge is of length about 1: exact.
        let largest = EDGES.map(|[i, j]| (corners[j] - corners[i]).abs().max_element());
        let exponent = libm::frexp(largest.into_iter().fold(0.0, f64::max)).1;
        // In two factors, since the power itself may be beyond the range of `f64`.
        let half = -exponent / 2;
        let factors = [half, -exponent - half].map(|power| libm::ldexp(1.0, power));
        let scaled = |i: usize, j: usize| (corners[j] - corners[i]) * factors[0] * factors[1];
        let [u, v, w] = [scaled(0, 1), scaled(0, 2), scaled(0, 3)];
        let six_volumes = u.cross(v).dot(w);
        let areas = v.cross(w).length() + w.cross(u).length() + u.cross(v).length();
        let twice_areas = areas + (v - u).cross(w - u).length();
        let towards_centre = u.length_squared() * v.cross(w)
            + v.length_squared() * w.cross(u)
            + w.length_squared() * u.cross(v);
        // The radii are 6 V / (twice the area) and |towards_centre| / (2 * 6 V).
        let ratio = 6.0 * six_volumes * six_volumes / (twice_areas * towards_centre.length());
        let dihedrals = EDGES.map(|[i, j]| {
            let [k, l] = others(i, j);
            let (edge, p, q) = (scaled(i, j), scaled(i, k), scaled(i, l));
            let (p, q) = (edge.cross(p), edge.cross(q));
            libm::atan2(p.cross(q).length(), p.dot(q))
        });
        let ratio = if positive && ratio.is_finite() { ratio.min(1.0) } else { 0.0 };
        let volume = libm::ldexp(six_volumes / 6.0, exponent.saturating_mul(3));
        Self { positive, volume, ratio, dihedrals }
    }

    fn quality(&self, at: usize) -> TetQuality {
        let mut quality = TetQuality {
            count: 1,
            not_positive: u64::from(!self.positive),
            first_not_positive: (!self.positive).then_some(at),
            volume: self.volume,
            min_volume: self.volume,
            max_volume: self.volume,
            min_dihedral: f64::INFINITY,
            min_dihedral_at: at,
            max_dihedral: f64::NEG_INFINITY,
            max_dihedral_at: at,
            dihedral_histogram: [0; DIHEDRAL_BINS],
            min_ratio: self.ratio,
            min_ratio_at: at,
            ratio_histogram: [0; RATIO_BINS],
        };
        quality.ratio_histogram[((self.ratio * RATIO_BINS as f64) as usize).min(RATIO_BINS - 1)] = 1;
        for angle in self.dihedrals {
            quality.min_dihedral = quality.min_dihedral.min(angle);
            quality.max_dihedral = quality.max_dihedral.max(angle);
            let bin = (angle * (DIHEDRAL_BINS as f64 / PI)) as usize;
            quality.dihedral_histogram[bin.min(DIHEDRAL_BINS - 1)] += 1;
        }
        quality
    }
}

/// The other two corners.
fn others(i: usize, j: usize) -> [usize; 2] {
    let other = EDGES.iter().find(|edge| !edge.contains(&i) && !edge.contains(&j));
    *other.expect("opposite to each edge is one")
}

/// Of these tetrahedra and of later ones.
fn both((a, mut volume): (TetQuality, Sum), (b, later): (TetQuality, Sum)) -> (TetQuality, Sum) {
    volume.merge(later);
    let least = |(x, at): (f64, usize), (y, later): (f64, usize)| if y < x { (y, later) } else { (x, at) };
    let (min_dihedral, min_dihedral_at) =
        least((a.min_dihedral, a.min_dihedral_at), (b.min_dihedral, b.min_dihedral_at));
    let (max_dihedral, max_dihedral_at) =
        least((-a.max_dihedral, a.max_dihedral_at), (-b.max_dihedral, b.max_dihedral_at));
    let (min_ratio, min_ratio_at) = least((a.min_ratio, a.min_ratio_at), (b.min_ratio, b.min_ratio_at));
    let quality = TetQuality {
        count: a.count + b.count,
        not_positive: a.not_positive + b.not_positive,
        first_not_positive: a.first_not_positive.or(b.first_not_positive),
        volume: 0.0,
        min_volume: a.min_volume.min(b.min_volume),
        max_volume: a.max_volume.max(b.max_volume),
        min_dihedral,
        min_dihedral_at,
        max_dihedral: -max_dihedral,
        max_dihedral_at,
        dihedral_histogram: std::array::from_fn(|i| a.dihedral_histogram[i] + b.dihedral_histogram[i]),
        min_ratio,
        min_ratio_at,
        ratio_histogram: std::array::from_fn(|i| a.ratio_histogram[i] + b.ratio_histogram[i]),
    };
    (quality, volume)
}
