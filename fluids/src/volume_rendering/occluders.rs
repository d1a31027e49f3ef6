//! Shadows of solids on the smoke: which parts of a way no solid keeps from the light.
//!
//! # What it promises
//! The parts are those of the solids' triangles, up to rounding: a ray goes dark where it passes behind the
//! edge of a solid, not at the border of a texel. Gaps of less than [`SLIVER`] of a way count as dark, those
//! that rounding leaves between neighbouring triangles among them.
//!
//! # Method
//! What a triangle keeps from the light is a prism without end; a way is inside for an interval. The union
//! of the intervals is taken by one pass over them in the order of their starts. Ways that are lit or dark as
//! a whole column is are told by [`Cover`] before. Triangles are cut to what
//! lies over the lattice and before its end, and what lies before its start is laid onto that.

use glam::DVec3;
use rayon::prelude::*;

use super::clip::{Corner, Polygon};
use super::columns::Columns;
use super::cover::Cover;
use super::light_space::Lattice;

/// Gaps between shadows shorter than this part of a way are closed.
const SLIVER: f64 = 1.0 / (1_u64 << 24) as f64;

/// Solids before the smoke or in it.
#[derive(Debug)]
pub(super) struct Occluders {
    columns: Columns,
    cover: Cover,
}

/// Memory for [`Occluders::lit`].
#[derive(Debug, Default)]
pub(super) struct Spans {
    found: Vec<u32>,
    dark: Vec<[f64; 2]>,
    /// The parts of the way that are lit, in order.
    pub(super) lit: Vec<[f64; 2]>,
}

/// How much of a way is lit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lit {
    All,
    /// The parts in [`Spans::lit`], at least one.
    Parts,
    Nothing,
}

impl Occluders {
    /// The triangles, in scaled coordinates, that can cast a shadow on the smoke; none if there are none.
    pub(super) fn new(lattice: &Lattice, triangles: &[[DVec3; 3]]) -> Option<Self> {
        if lattice.is_empty() || triangles.is_empty() {
            return None;
        }
        let [nx, ny, nz] = lattice.size;
        let place = |triangle: &[DVec3; 3]| triangle.map(|p| lattice.place(p));
        let placed: Vec<[DVec3; 3]> = triangles.par_iter().with_min_len(1024).map(place).collect();
        let parts: Vec<[DVec3; 3]> = placed
            .par_iter()
            .with_min_len(1024)
            .flat_map_iter(|triangle| parts([nx, ny, nz], triangle))
            .collect();
        if parts.is_empty() {
            return None;
        }
        let columns = Columns::new(&parts, [nx, ny]);
        let cover = Cover::new(&columns, &placed, [nx, ny]);
        Some(Self { columns, cover })
    }

    /// Which parts of the way between two points, in lattice coordinates, no solid keeps from the light.
    #[inline]
    pub(super) fn lit(&self, from: DVec3, to: DVec3, spans: &mut Spans) -> Lit {
        match self.cover.lit(from, to) {
            Lit::Parts => self.lit_by_triangles(from, to, spans),
            whole => whole,
        }
    }

    #[cfg(test)]
    pub(super) fn cover(&self) -> &Cover {
        &self.cover
    }

    /// The same, from the triangles.
    pub(super) fn lit_by_triangles(&self, from: DVec3, to: DVec3, spans: &mut Spans) -> Lit {
        self.columns.along(from, to, usize::MAX, &mut spans.found);
        spans.dark.clear();
        for &index in &spans.found {
            match self.columns.prism(index).behind(from, to) {
                None => {}
                Some([start, end]) if start <= 0.0 && end >= 1.0 => return Lit::Nothing,
                Some(part) => spans.dark.push(part),
            }
        }
        if spans.dark.is_empty() { Lit::All } else { spans.remainder() }
    }
}

impl Spans {
    /// What the dark parts leave.
    fn remainder(&mut self) -> Lit {
        self.dark.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        self.lit.clear();
        let mut reached = 0.0_f64;
        for &[start, end] in &self.dark {
            if start - reached >= SLIVER {
                self.lit.push([reached, start]);
            }
            reached = reached.max(end);
        }
        if 1.0 - reached >= SLIVER {
            self.lit.push([reached, 1.0]);
        }
        if self.lit.is_empty() { Lit::Nothing } else { Lit::Parts }
    }
}

/// The parts of a triangle in lattice coordinates that lie over the lattice and before its end; what lies
/// before its start is moved onto that.
fn parts([nx, ny, nz]: [usize; 3], triangle: &[DVec3; 3]) -> Vec<[DVec3; 3]> {
    let (over, nz) = (over([nx, ny], triangle), nz as f64);
    let flat = |p: DVec3| DVec3::new(p.x, p.y, 0.0);
    if over.corners().iter().all(|corner| corner.point.z <= 0.0) {
        return fans(&over).map(|part| part.map(flat)).collect();
    }
    let (mut before, mut within, mut spare) = (over, over, over);
    over.cut(|p| -p.z, |p| p.z = 0.0, &mut before);
    over.cut(|p| p.z, |p| p.z = 0.0, &mut spare);
    spare.cut(|p| nz - p.z, |p| p.z = nz, &mut within);
    fans(&before).map(|part| part.map(flat)).chain(fans(&within)).collect()
}

/// The part of a triangle in lattice coordinates that lies over a lattice with so many voxels across.
pub(super) fn over(across: [usize; 2], triangle: &[DVec3; 3]) -> Polygon {
    let mut over = Polygon::triangle(triangle.map(|point| Corner { point, value: 0.0 }));
    let mut spare = over;
    // A voxel of margin, so that rounding does not uncover the border.
    for (axis, end) in [(0, across[0] as f64 + 1.0), (1, across[1] as f64 + 1.0)] {
        over.cut(|p| p[axis] + 1.0, |p| p[axis] = -1.0, &mut spare);
        spare.cut(|p| end - p[axis], |p| p[axis] = end, &mut over);
    }
    over
}

/// The triangles of a convex polygon.
pub(super) fn fans(polygon: &Polygon) -> impl Iterator<Item = [DVec3; 3]> + '_ {
    let corners = polygon.corners();
    let pairs = corners.get(1..).unwrap_or_default().windows(2);
    pairs.map(|pair| [corners[0].point, pair[0].point, pair[1].point])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice() -> Lattice {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        Lattice { axes, origin: DVec3::ZERO, spacing: 1.0, size: [8, 8, 8] }
    }

    #[test]
    fn a_half_plane_casts_a_shadow_with_a_sharp_edge() {
        let triangle = [DVec3::new(4.3, -1e9, 3.0), DVec3::new(4.3, 1e9, 3.0), DVec3::new(-1e9, 0.0, 3.0)];
        let occluders = Occluders::new(&lattice(), &[triangle]).expect("it lies before the smoke's end");
        let mut spans = Spans::default();
        let mut lit = |from: [f64; 3], to: [f64; 3]| {
            let lit = occluders.lit(DVec3::from_array(from), DVec3::from_array(to), &mut spans);
            (lit, spans.lit.clone())
        };
        for y in [0.0, 3.3, 8.0] {
            assert_eq!(lit([2.0, y, 3.5], [4.2, y, 6.0]).0, Lit::Nothing);
            assert_eq!(lit([2.0, y, 0.5], [4.2, y, 2.9]).0, Lit::All);
            assert_eq!(lit([4.4, y, 3.5], [7.0, y, 6.0]).0, Lit::All);
            let (parts, list) = lit([3.3, y, 3.5], [5.3, y, 4.5]);
            assert!(parts == Lit::Parts && list.len() == 1);
            assert!((list[0][0] - 0.5).abs() < 1e-9 && list[0][1] == 1.0, "{list:?}");
            let (parts, list) = lit([1.0, y, 2.0], [1.0, y, 6.0]);
            assert!(parts == Lit::Parts && list == [[0.0, 0.25]], "{list:?}");
        }
        assert!(Occluders::new(&lattice(), &[triangle.map(|p| p + 6.0 * DVec3::Z)]).is_none());
        let before = triangle.map(|p| p - 1e300 * DVec3::Z);
        let occluders = Occluders::new(&lattice(), &[before]).expect("it lies before the smoke");
        assert_eq!(occluders.lit(DVec3::ONE, 3.0 * DVec3::ONE, &mut spans), Lit::Nothing);
    }

    #[test]
    fn shadows_are_joined_and_the_rest_is_lit() {
        let mut spans =
            Spans { dark: vec![[0.5, 0.6], [0.1, 0.3], [0.2, 0.4], [0.4 + 1e-12, 0.45]], ..Spans::default() };
        assert_eq!(spans.remainder(), Lit::Parts);
        assert_eq!(spans.lit, [[0.0, 0.1], [0.45, 0.5], [0.6, 1.0]]);
        spans.dark = vec![[0.3, 1.0], [0.0, 0.3 - 1e-15]];
        assert_eq!(spans.remainder(), Lit::Nothing);
    }
}
