//! How much of the light arrives: the shadow texture of the smoke, and where it does not do, the smoke's
//! surface itself; shadows of solids.
//!
//! # What it computes
//! The texture holds, at the face of each voxel that the light leaves by and at those it first enters by, the
//! length of smoke that the light has passed, as the mean over the face. It is linear between the two faces
//! of a voxel, which is right for a voxel of one density, and linear between the middles of columns. The
//! share of the light that arrives is `exp(-extinction length)`.
//!
//! The length at a face is a mean over the face, which where the surface is oblique to the light, or ends,
//! mixes points before and behind it. There lengths bend from node to node, and from that it follows by how
//! much the texture may be off. Where that is more than [`ROUGH`] of the light, nodes are marked, and light
//! is traced through the triangles of the surface ([`LightPaths`]), unless a column has more of them than
//! asked for. Parts that solids keep from the light are cut out of each step ([`Occluders`]).
//!
//! # What it does not promise
//! An exact shadow: where the texture is not marked, the sum of its errors along a ray is not bounded by
//! more than [`ROUGH`] of the smoke that is seen; where columns are crowded, the root mean square error of
//! the scatter of a ball falls with the power 1 to 1.5 of the voxel's side, and a sheet as thin as two voxels
//! is off by several percent. Figures are in `docs/accuracy.md`.

use glam::DVec3;
use rayon::prelude::*;

use super::columns::Columns;
use super::exponential::{exp_of_minus, exps_of_minus};
use super::light_paths::{Before, LightPaths};
use super::light_space::Lattice;
use super::occluders::{Lit, Occluders, Spans};
use super::{InteriorRule, voxels};

/// Points of which the light is looked up together, so that the arithmetic is that of vectors.
pub(super) const LANES: usize = 8;

/// The texture is rough where its bends tell that it may be off by more than this share of the light. Chosen
/// by trial: with half of it errors in the tests are hardly less, with twice of it those of a torus double.
const ROUGH: f32 = 1.0 / 32.0;

/// Lengths of smoke along the light, and solids before it.
#[derive(Debug)]
pub(super) struct Shadow {
    lattice: Lattice,
    texture: Texture,
    occluders: Option<Occluders>,
    /// The smoke's surface, where the texture does not do.
    paths: Option<LightPaths>,
    /// Optical depth of a voxel full of smoke.
    optical_depth: f32,
}

/// Memory for what is not looked up in the texture.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    spans: Spans,
    before: Before,
}

impl Shadow {
    /// The shadow of smoke with a surface and an extinction, and of the triangles of solids, in scaled
    /// coordinates. Light is traced where the texture is rough, unless columns have more than `traced`
    /// triangles in the mean.
    pub(super) fn new(
        lattice: Lattice,
        corners: &[[DVec3; 3]],
        solids: &[[DVec3; 3]],
        extinction: f64,
        rule: InteriorRule,
        traced: usize,
    ) -> Self {
        let placed: Vec<[DVec3; 3]> = if lattice.is_empty() {
            Vec::new()
        } else {
            corners.par_iter().with_min_len(4096).map(|t| t.map(|p| lattice.place_inside(p))).collect()
        };
        let volumes = voxels::volumes(&placed, lattice.size);
        let mut shadow = Self::of_volumes(lattice, &volumes, extinction, rule);
        if placed.is_empty() {
            return shadow;
        }
        let [nx, ny, _] = shadow.lattice.size;
        shadow.occluders = Occluders::new(&shadow.lattice, solids);
        let rough = Columns::entries_at_most(&placed, [nx, ny], traced.saturating_mul(nx * ny))
            && shadow.texture.mark_rough(shadow.optical_depth);
        // What is seen of solids is a point for each pixel, whose light is always traced.
        if rough || !solids.is_empty() {
            let optical_depth = f64::from(shadow.optical_depth);
            shadow.paths = Some(LightPaths::new(&placed, [nx, ny], rule, traced, optical_depth));
        }
        shadow
    }

    /// The texture of smoke of which the volume in each voxel is known, in voxels.
    pub(super) fn of_volumes(lattice: Lattice, volumes: &[f64], extinction: f64, rule: InteriorRule) -> Self {
        let texture = Texture::new(volumes, lattice.size, rule);
        let optical_depth = (extinction * lattice.spacing).min(f64::from(f32::MAX)) as f32;
        Self { lattice, texture, occluders: None, paths: None, optical_depth }
    }

    pub(super) fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// The share of the light that the smoke lets through to points in it, in lattice coordinates (all first
    /// ones, then all second ones, ...).
    /// Beside them, whether the texture is rough there.
    #[inline]
    pub(super) fn transmittances<const N: usize>(&self, at: &[[f32; N]; 3]) -> ([f32; N], [bool; N]) {
        if self.texture.lengths.is_empty() {
            // Smoke so small that its voxels would have no side shadows nothing.
            return ([1.0; N], [false; N]);
        }
        let (mut depths, rough) = self.texture.look_up(at);
        for depth in &mut depths {
            *depth *= self.optical_depth;
        }
        (exps_of_minus(&depths), rough)
    }

    /// Whether a solid may keep light from the smoke.
    #[inline]
    pub(super) fn has_solids(&self) -> bool {
        self.occluders.is_some()
    }

    /// The mean share of the light on a short way inside the smoke, in lattice coordinates, by the weight of
    /// what is seen of it through its own optical depth, if `light` is that of the texture at the mean place;
    /// with care, it is traced.
    pub(super) fn mean(
        &self,
        [from, to]: [DVec3; 2],
        optical_depth: f64,
        (light, careful): (f32, bool),
        scratch: &mut Scratch,
    ) -> f32 {
        let lit = match &self.occluders {
            None => Lit::All,
            Some(occluders) => occluders.lit(from, to, &mut scratch.spans),
        };
        let parts: &[[f64; 2]] = match lit {
            Lit::Nothing => return 0.0,
            Lit::All => &[[0.0, 1.0]],
            Lit::Parts => &scratch.spans.lit,
        };
        let paths = self.paths.as_ref().filter(|_| careful);
        let traced =
            paths.and_then(|paths| paths.mean([from, to], optical_depth, parts, &mut scratch.before));
        if let Some(light) = traced {
            return light as f32;
        }
        if lit == Lit::All {
            return light;
        }
        let of_part = |&[start, end]: &[f64; 2]| {
            let place = start + (end - start) * centre((end - start) * optical_depth);
            let at = (from + place * (to - from)).to_array().map(|c| [c as f32]);
            let ([light], _) = self.transmittances(&at);
            weight([start, end], optical_depth) * f64::from(light)
        };
        parts.iter().map(of_part).sum::<f64>() as f32
    }

    /// The share of the light that the smoke lets through to a point anywhere, in scaled coordinates.
    pub(super) fn transmittance_of_smoke(&self, point: DVec3, scratch: &mut Scratch) -> f64 {
        if self.lattice.is_empty() {
            return 1.0;
        }
        let p = self.lattice.place(point);
        let [nx, ny, _] = self.lattice.size.map(|n| n as f64);
        if !(0.0..=nx).contains(&p.x) || !(0.0..=ny).contains(&p.y) || p.z.is_nan() {
            return 1.0;
        }
        let traced = self.paths.as_ref().and_then(|paths| paths.transmittance(p, &mut scratch.before));
        traced.unwrap_or_else(|| {
            let ([length], _) = self.texture.look_up(&[[p.x as f32], [p.y as f32], [p.z as f32]]);
            f64::from(exp_of_minus(self.optical_depth * length))
        })
    }
}

/// Where on a way through smoke of an optical depth the mean place of the light scattered to the eye is, in
/// parts of the way: `1 / t - 1 / (exp(t) - 1)`, whose next term is below 3e-5 t.
#[inline]
pub(super) fn centre(t: f64) -> f64 {
    0.5 - t / 12.0 + t * t * t / 720.0
}

/// How much a part of a way through smoke of an optical depth has of what is seen of all of it.
fn weight([start, end]: [f64; 2], t: f64) -> f64 {
    let whole = -libm::expm1(-t);
    if whole > 0.0 { libm::exp(-start * t) * -libm::expm1(-(end - start) * t) / whole } else { end - start }
}

/// Voxels of smoke that the light has passed, at the faces of the voxels.
///
/// There is a column more on each side, equal to its neighbour, and a face more at the end of each column, so
/// that no coordinate needs a case of its own.
#[derive(Debug)]
struct Texture {
    /// Faces of a column along the light together, then columns along the first axis. The last bit of a number
    /// is 1 where the texture is rough.
    lengths: Vec<f32>,
    size: [usize; 3],
}

impl Texture {
    fn new(volumes: &[f64], size: [usize; 3], rule: InteriorRule) -> Self {
        let [nx, ny, nz] = size;
        if volumes.is_empty() {
            return Self { lengths: Vec::new(), size };
        }
        let faces = nz + 2;
        let mut lengths = vec![0.0; (nx + 2) * (ny + 2) * faces];
        lengths.par_chunks_mut((nx + 2) * faces).enumerate().for_each(|(row, lengths)| {
            let j = row.clamp(1, ny) - 1;
            for (column, lengths) in lengths.chunks_mut(faces).enumerate() {
                let i = column.clamp(1, nx) - 1;
                let volumes = &volumes[(j * nx + i) * nz..][..nz];
                let mut passed = 0.0;
                for (length, &volume) in lengths[1..].iter_mut().zip(volumes) {
                    passed += rule.density(volume);
                    *length = unmarked(passed as f32);
                }
                lengths[nz + 1] = unmarked(passed as f32);
            }
        });
        Self { lengths, size }
    }

    /// Marks where the texture is rough for voxels of an optical depth: in the last bits of the lengths, which
    /// their value does not notice. Whether it is anywhere.
    ///
    /// Where the surface is a plane that is oblique to the light, the second difference of lengths across it
    /// comes to up to the slope, in voxels, and the mean over a face and between columns is off by a quarter
    /// of that; where the surface ends, by up to half. Along the light, a length is linear within a voxel that
    /// is filled in part, which is off by a quarter of the second difference at most.
    fn mark_rough(&mut self, optical_depth: f32) -> bool {
        let [nx, ny, nz] = self.size;
        let faces = nz + 2;
        let column = |i: usize, j: usize| &self.lengths[((j + 1) * (nx + 2) + i + 1) * faces..][..faces];
        let nothing = vec![0.0; faces];
        let mut marks = vec![0_u32; nx * ny * faces];
        marks.par_chunks_mut(nx * faces).enumerate().for_each(|(j, marks)| {
            for (i, marks) in marks.chunks_mut(faces).enumerate() {
                let of = column(i, j);
                let beside = [
                    if i > 0 { column(i - 1, j) } else { &nothing },
                    if i + 1 < nx { column(i + 1, j) } else { &nothing },
                    if j > 0 { column(i, j - 1) } else { &nothing },
                    if j + 1 < ny { column(i, j + 1) } else { &nothing },
                ];
                for (k, mark) in marks.iter_mut().enumerate() {
                    let bend = |p: f32, q: f32| (p - 2.0 * of[k] + q).abs();
                    let across = bend(beside[0][k], beside[1][k]) + bend(beside[2][k], beside[3][k]);
                    let along = bend(if k > 0 { of[k - 1] } else { 0.0 }, of[(k + 1).min(faces - 1)]);
                    let error = optical_depth * (0.5 * across + 0.25 * along);
                    if error > ROUGH {
                        let least = optical_depth * (of[k] - across).max(0.0);
                        *mark = u32::from(exp_of_minus(least) * (1.0 - exp_of_minus(error)) > ROUGH);
                    }
                }
            }
        });
        let any = marks.par_iter().any(|&mark| mark != 0);
        self.lengths.par_chunks_mut((nx + 2) * faces).enumerate().for_each(|(row, lengths)| {
            let j = row.clamp(1, ny) - 1;
            for (column, lengths) in lengths.chunks_mut(faces).enumerate() {
                let i = column.clamp(1, nx) - 1;
                for (length, mark) in lengths.iter_mut().zip(&marks[(j * nx + i) * faces..]) {
                    *length = f32::from_bits(length.to_bits() | mark);
                }
            }
        });
        any
    }

    /// Voxels of smoke before points, in lattice coordinates; those outside are moved to the border. Beside
    /// them, whether a node next to the point is marked.
    #[inline]
    fn look_up<const N: usize>(&self, at: &[[f32; N]; 3]) -> ([f32; N], [bool; N]) {
        let [nx, ny, nz] = self.size.map(|n| n as f32);
        let (row, faces) = ((self.size[0] + 2) as u32, (self.size[2] + 2) as u32);
        let (i, u) = nodes(&at[0], 0.5, nx);
        let (j, v) = nodes(&at[1], 0.5, ny);
        let (k, w) = nodes(&at[2], 0.0, nz);
        let mut first = [0; N];
        for lane in 0..N {
            first[lane] = (j[lane] * row + i[lane]) * faces + k[lane];
        }
        let mut corners = [[0.0_f32; N]; 8];
        let steps = [0, faces, row * faces, (row + 1) * faces];
        for lane in 0..N {
            for (column, step) in steps.into_iter().enumerate() {
                let at = (first[lane] + step) as usize;
                let pair = &self.lengths[at..at + 2];
                (corners[2 * column][lane], corners[2 * column + 1][lane]) = (pair[0], pair[1]);
            }
        }
        let (mut lengths, mut rough) = ([0.0; N], [false; N]);
        for lane in 0..N {
            let along =
                |column: usize| mix(corners[2 * column][lane], corners[2 * column + 1][lane], w[lane]);
            let (upper, lower) = (mix(along(0), along(1), u[lane]), mix(along(2), along(3), u[lane]));
            lengths[lane] = mix(upper, lower, v[lane]);
            rough[lane] = corners.iter().fold(0, |marks, corner| marks | corner[lane].to_bits()) & 1 == 1;
        }
        (lengths, rough)
    }
}

/// A length with a clear last bit.
#[inline]
fn unmarked(length: f32) -> f32 {
    f32::from_bits(length.to_bits() & !1)
}

#[inline]
fn mix(a: f32, b: f32, part: f32) -> f32 {
    a + part * (b - a)
}

/// For each coordinate, moved between 0 and `most` and then by `shift`, a node next to it, and the part of
/// the way to the next node, from 0 to 1.
#[inline]
fn nodes<const N: usize>(coordinates: &[f32; N], shift: f32, most: f32) -> ([u32; N], [f32; N]) {
    // Adding 2^23 rounds to an integer, which then is in the last bits. A node itself may count as the end of
    // the interval before.
    const ROUND: f32 = 8_388_608.0;
    let (mut inside, mut shifted) = ([0.0_f32; N], [0.0_f32; N]);
    for k in 0..N {
        let least = if coordinates[k] > 0.0 { coordinates[k] } else { 0.0 };
        inside[k] = (if least < most { least } else { most }) + shift;
    }
    for k in 0..N {
        let before = inside[k] - 0.5;
        shifted[k] = (if before > 0.0 { before } else { 0.0 }) + ROUND;
    }
    let (mut nodes, mut parts) = ([0; N], [0.0; N]);
    for k in 0..N {
        nodes[k] = shifted[k].to_bits() - ROUND.to_bits();
        parts[k] = inside[k] - (shifted[k] - ROUND);
    }
    (nodes, parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture(volumes: &[f64], size: [usize; 3]) -> Shadow {
        let lattice =
            Lattice { axes: [DVec3::X, DVec3::Y, DVec3::Z], origin: DVec3::ZERO, spacing: 1.0, size };
        let texture = Texture::new(volumes, size, InteriorRule::NonZero);
        Shadow { lattice, texture, occluders: None, paths: None, optical_depth: 1.0 }
    }

    #[test]
    fn lengths_are_linear_along_the_light_and_between_columns() {
        let shadow = texture(&[1.0, 0.5, 0.0, 0.0], [2, 1, 2]);
        for (at, length) in [
            ([0.5, 0.5, 0.0], 0.0),
            ([0.5, 0.5, 0.25], 0.25),
            ([0.0, 0.9, 1.5], 1.25),
            ([0.5, 0.5, 2.0], 1.5),
            ([0.5, 0.5, 7.0], 1.5),
            ([1.0, 0.5, 1.0], 0.5),
            ([1.9, 0.5, 2.0], 0.0),
        ] {
            assert_eq!(shadow.texture.look_up(&at.map(|c: f32| [c])), ([length], [false]), "{at:?}");
        }
    }

    #[test]
    fn nothing_is_shadowed_beside_the_smoke() {
        let shadow = texture(&[1.0; 8], [2; 3]);
        let mut scratch = Scratch::default();
        assert_eq!(shadow.transmittance_of_smoke(DVec3::new(-0.1, 1.0, 2.0), &mut scratch), 1.0);
        assert_eq!(shadow.transmittance_of_smoke(DVec3::new(1.0, 1.0, -5.0), &mut scratch), 1.0);
        let behind = shadow.transmittance_of_smoke(DVec3::new(1.0, 1.0, 9.0), &mut scratch);
        assert!((behind - (-2.0_f64).exp()).abs() < 1e-6);
    }
}
