//! [`Model`]: the layers of a scene checked, joined and brought to unit size.
//!
//! Promises: positions lie in the cube [-1, 1]^3 around the middle of their bounding box, larger than 1/4 along one axis
//! unless all coincide; scaling is by a power of two and nothing overflows, from subnormal coordinates to 1e308.

use super::scene::{Field, Layer, Paint, RenderError, Scene};
use glam::DVec3;
use rayon::prelude::*;

/// All layers in one numbering.
pub(super) struct Model {
    /// Vertex positions, unit size.
    pub(super) positions: Vec<DVec3>,
    /// Corners of each triangle, in the joint numbering.
    pub(super) triangles: Vec<[u32; 3]>,
    /// First vertex and first triangle of each layer.
    pub(super) starts: Vec<(usize, usize)>,
    /// Which triangles are highlighted.
    pub(super) highlighted: Vec<bool>,
    /// Whether any is.
    pub(super) any_highlighted: bool,
    /// From mesh units to unit size.
    pub(super) frame: Frame,
    /// Half the extents of the bounding box, unit size.
    pub(super) half_extent: DVec3,
}

/// `p -> (p * before - centre) * after`, with powers of two as factors, given by their exponents.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    before: i32,
    centre: DVec3,
    after: i32,
}

/// `x * 2^exponent`.
fn scale(x: f64, exponent: i32) -> f64 {
    libm::scalbn(x, exponent)
}

/// Least `e` with `x < 2^e`, for a finite x > 0.
fn exponent(x: f64) -> i32 {
    libm::frexp(x).1
}

impl Frame {
    fn of(low: DVec3, high: DVec3) -> (Self, DVec3) {
        // Above 2^1000 a difference could overflow: then shrink first. Nothing visible is lost.
        let before = if low.abs().max(high.abs()).max_element() > scale(1.0, 1000) { -64 } else { 0 };
        let [low, high] = [low, high].map(|p| p.to_array().map(|x| scale(x, before)).into());
        let (low, high): (DVec3, DVec3) = (low, high);
        // Of subnormal ends the halves may round, so the sum is halved.
        let centre = (low + high) * 0.5;
        let half = (high - centre).max(centre - low);
        let largest = half.max_element();
        let after = if largest > 0.0 { -exponent(largest) } else { 0 };
        let frame = Self { before, centre, after };
        (frame, half.to_array().map(|x| scale(x, after)).into())
    }

    /// A position at unit size.
    pub(super) fn apply(&self, p: DVec3) -> DVec3 {
        let at = |x: f64, c: f64| scale(scale(x, self.before) - c, self.after);
        DVec3::new(at(p.x, self.centre.x), at(p.y, self.centre.y), at(p.z, self.centre.z))
    }

    /// One coordinate at unit size, within [-4, 4].
    pub(super) fn coordinate(&self, axis: usize, x: f64) -> f64 {
        scale(scale(x, self.before) - self.centre[axis], self.after).clamp(-4.0, 4.0)
    }

    /// A length at unit size, at most `most`.
    pub(super) fn length(&self, length: f64, most: f64) -> f64 {
        scale(scale(length, self.before), self.after).min(most)
    }
}

impl Model {
    /// Checks and joins.
    pub(super) fn of(scene: &Scene<'_>) -> Result<Self, RenderError> {
        let vertices: usize = scene.layers.iter().map(|l| l.positions.len()).sum();
        let count: usize = scene.layers.iter().map(|l| l.triangles.len()).sum();
        // Clipped pieces and the empty sample need numbers of their own.
        if vertices >= u32::MAX as usize || count >= (u32::MAX / 4) as usize {
            return Err(RenderError::TooManyElements);
        }
        for (layer, l) in scene.layers.iter().enumerate() {
            check(layer, l)?;
        }
        let mut used: Option<(DVec3, DVec3)> = None;
        for l in &scene.layers {
            for p in l.triangles.iter().flatten().map(|v| l.positions[v.index()]) {
                used = Some(used.map_or((p, p), |(low, high)| (low.min(p), high.max(p))));
            }
        }
        let (low, high) = used.unwrap_or_default();
        let (frame, half_extent) = Frame::of(low, high);

        let mut positions = Vec::with_capacity(vertices);
        let mut triangles = Vec::with_capacity(count);
        let mut highlighted = vec![false; count];
        let mut starts = Vec::with_capacity(scene.layers.len());
        for l in &scene.layers {
            let (first_vertex, first_triangle) = (positions.len(), triangles.len());
            starts.push((first_vertex, first_triangle));
            // Vertices of no triangle may lie far outside the frame; nothing reads them.
            positions.par_extend(l.positions.par_iter().map(|&p| frame.apply(p.clamp(low, high))));
            triangles.par_extend(l.triangles.par_iter().map(|t| t.map(|v| v.0 + first_vertex as u32)));
            for t in l.highlighted {
                highlighted[first_triangle + t.index()] = true;
            }
        }
        let any_highlighted = highlighted.contains(&true);
        Ok(Self { positions, triangles, starts, highlighted, any_highlighted, frame, half_extent })
    }

    /// The layer of a triangle.
    pub(super) fn layer(&self, triangle: u32) -> usize {
        self.starts.partition_point(|&(_, first)| first <= triangle as usize) - 1
    }

    /// Corner positions of a triangle, looked up in an array like `positions`.
    #[inline]
    pub(super) fn corners<T: Copy>(&self, of: &[T], triangle: u32) -> [T; 3] {
        self.triangles[triangle as usize].map(|v| of[v as usize])
    }
}

fn check(layer: usize, l: &Layer<'_>) -> Result<(), RenderError> {
    if let Some(vertex) = l.positions.par_iter().position_first(|p| !p.is_finite()) {
        return Err(RenderError::NonFinite { layer, vertex });
    }
    let n = l.positions.len();
    if let Some(triangle) = l.triangles.par_iter().position_first(|t| t.iter().any(|v| v.index() >= n)) {
        return Err(RenderError::VertexOutOfRange { layer, triangle });
    }
    let mismatch = |what, found, expected| Err(RenderError::Mismatch { what, layer, found, expected });
    if let Some(t) = l.highlighted.iter().find(|t| t.index() >= l.triangles.len()) {
        return mismatch("highlighted triangle", t.index(), l.triangles.len());
    }
    let (what, found, expected) = match l.paint {
        Paint::Plain => return Ok(()),
        Paint::Triangles(colors) => ("triangle colours", colors.len(), l.triangles.len()),
        Paint::TriangleField(Field { values, .. }) => ("triangle values", values.len(), l.triangles.len()),
        Paint::VertexField(Field { values, .. }) => ("vertex values", values.len(), n),
    };
    if found == expected { Ok(()) } else { mismatch(what, found, expected) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_finite_range_comes_to_unit_size() {
        let tiny = f64::from_bits(1);
        for (low, high) in [
            (-f64::MAX, f64::MAX),
            (0.0, f64::MAX),
            (f64::MAX / 2.0, f64::MAX),
            (-1.0, 1e-300),
            (-tiny, tiny),
            (0.0, tiny),
            (0.0, 3.0 * tiny),
            (1.0, 1.0 + f64::EPSILON),
            (-1e-308, 3e-308),
        ] {
            let (low, high) = (DVec3::new(low, low / 4.0, 0.0), DVec3::new(high, high / 4.0, 0.0));
            let (frame, half) = Frame::of(low, high);
            for p in [low, high, frame.centre] {
                let q = frame.apply(if frame.before == 0 { p } else { p.clamp(low, high) });
                assert!(q.abs().max_element() <= 1.0, "{low} {high}: {p} -> {q}");
            }
            assert!((0.25..=1.0).contains(&half.max_element()), "{low} {high}: {half}");
        }
    }

    #[test]
    fn one_point_stays_at_the_origin() {
        let p = DVec3::new(1e308, -3.0, 1e-320);
        let (frame, half) = Frame::of(p, p);
        assert_eq!(frame.apply(p), DVec3::ZERO);
        assert_eq!(half, DVec3::ZERO);
    }
}
