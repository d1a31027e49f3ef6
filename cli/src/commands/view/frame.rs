//! A surface as the bytes that the page draws: [`pack`].
//!
//! Positions are steps of a cube around the frame, 2^20 along its side. Numbers are differences to the one before, zigzag coded, in planes of bytes
//! (all lowest bytes, then all next ones), and all of it is deflated: `viewer.js` has the inverse.

use flate2::Compression;
use flate2::write::DeflateEncoder;
use std::io::Write;
use welter_meshing::DVec3;
use welter_meshing::surface::TriangleSoup;

/// Steps along the side of the cube. Its coordinates take three bytes.
const STEPS: f64 = (1 << 20) as f64;

/// The cube that the positions of a frame are in, or all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cube {
    min: DVec3,
    /// Half of the side, so that it is finite; not zero.
    half_side: f64,
    /// The extents of what is in it, in sides.
    pub(super) extent: DVec3,
}

/// Where a cube lies in another one, in sides of that.
pub(super) struct Place {
    pub(super) corner: DVec3,
    pub(super) side: f64,
}

impl Cube {
    /// Around a box.
    pub(super) fn around(min: DVec3, max: DVec3) -> Self {
        let half = 0.5 * max - 0.5 * min;
        let half_side = if half.max_element() > 0.0 { half.max_element() } else { 1.0 };
        Self { min, half_side, extent: half / half_side }
    }

    /// Around positions.
    pub(super) fn of(positions: &[DVec3]) -> Self {
        let min = positions.iter().copied().reduce(DVec3::min).unwrap_or_default();
        Self::around(min, positions.iter().copied().reduce(DVec3::max).unwrap_or_default())
    }

    /// Around what is in some others; none if there are none.
    pub(super) fn around_all<'c>(cubes: impl Iterator<Item = &'c Self> + Clone) -> Option<Self> {
        let min = cubes.clone().map(|cube| cube.min).reduce(DVec3::min)?;
        let max = cubes.map(|cube| cube.min + cube.half_side * cube.extent + cube.half_side * cube.extent);
        Some(Self::around(min, max.reduce(DVec3::max)?))
    }

    pub(super) fn within(&self, other: &Self) -> Place {
        let corner = (0.5 * self.min - 0.5 * other.min) / other.half_side;
        Place { corner, side: self.half_side / other.half_side }
    }

    /// The nearest steps.
    fn steps(&self, position: DVec3) -> [i32; 3] {
        let place = (0.5 * position - 0.5 * self.min) / self.half_side;
        (place.clamp(DVec3::ZERO, DVec3::ONE) * STEPS).round().to_array().map(|x| x as i32)
    }
}

/// Deflated: the numbers of vertices and triangles, whether there are colours, the coordinates by axis, the corners, the colours.
pub(super) fn pack(soup: &TriangleSoup, cube: &Cube) -> Vec<u8> {
    let colored = !soup.triangle_colors.is_empty();
    let mut bytes = Vec::new();
    for number in [soup.positions.len() as u32, soup.triangles.len() as u32, u32::from(colored)] {
        bytes.extend(number.to_le_bytes());
    }
    let steps: Vec<[i32; 3]> = soup.positions.iter().map(|&p| cube.steps(p)).collect();
    for axis in 0..3 {
        planes(&mut bytes, steps.iter().map(|of| of[axis]), 3);
    }
    // Reinterpreted: differences wrap, and the page takes them back to 32 bits.
    planes(&mut bytes, soup.triangles.iter().flatten().map(|&corner| corner.cast_signed()), 4);
    bytes.extend(soup.triangle_colors.iter().flatten());
    let mut deflated = DeflateEncoder::new(Vec::new(), Compression::default());
    let written = deflated.write_all(&bytes).and_then(|()| deflated.finish());
    written.expect("memory takes all bytes")
}

fn planes(bytes: &mut Vec<u8>, numbers: impl Iterator<Item = i32>, width: usize) {
    let mut last = 0_i32;
    let codes: Vec<[u8; 4]> = numbers
        .map(|number| {
            let difference = number.wrapping_sub(last);
            last = number;
            (difference.wrapping_shl(1) ^ (difference >> 31)).cast_unsigned().to_le_bytes()
        })
        .collect();
    for plane in 0..width {
        bytes.extend(codes.iter().map(|code| code[plane]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::DeflateDecoder;
    use std::io::Read;

    /// The inverse, as the page has it.
    fn numbers(bytes: &[u8], count: usize, width: usize) -> Vec<i32> {
        let mut last = 0_i32;
        (0..count)
            .map(|i| {
                let code =
                    (0..width).fold(0_u32, |code, k| code | u32::from(bytes[k * count + i]) << (8 * k));
                last = last.wrapping_add((code >> 1).cast_signed() ^ -((code & 1).cast_signed()));
                last
            })
            .collect()
    }

    #[test]
    fn what_is_packed_is_unpacked() {
        let positions = vec![DVec3::ZERO, DVec3::new(1.0, -3.0, 2.0), DVec3::new(0.25, 1.0, -1.0)];
        let soup = TriangleSoup {
            positions: positions.clone(),
            triangles: vec![[0, 1, 2], [2, 1, 0], [u32::MAX, 0, 7]],
            triangle_colors: vec![[1, 2, 3], [4, 5, 6], [7, 8, 9]],
            ..TriangleSoup::default()
        };
        let cube = Cube::around(DVec3::new(0.0, -3.0, -1.0), DVec3::new(1.0, 1.0, 2.0));
        let mut bytes = Vec::new();
        DeflateDecoder::new(&*pack(&soup, &cube)).read_to_end(&mut bytes).unwrap();
        assert_eq!(bytes[..12], [3, 0, 0, 0, 3, 0, 0, 0, 1, 0, 0, 0]);
        for axis in 0..3 {
            let steps = numbers(&bytes[12 + 9 * axis..], 3, 3);
            for (step, position) in steps.iter().zip(&positions) {
                let unit = 2.0 * cube.half_side / STEPS;
                let value = cube.min[axis] + f64::from(*step) * unit;
                assert!((value - position[axis]).abs() <= 0.5 * unit, "{value}, {position}");
            }
        }
        let corners: Vec<u32> = numbers(&bytes[39..], 9, 4).into_iter().map(i32::cast_unsigned).collect();
        assert_eq!(corners, soup.triangles.concat());
        assert_eq!(bytes[39 + 36..], [1, 2, 3, 4, 5, 6, 7, 8, 9]);
    }

    #[test]
    fn cubes_have_places_in_one_around_them() {
        let cubes = [[0.0, 4.0], [-4.0, -2.0], [1.0, 1.0]]
            .map(|[from, to]| Cube::around(DVec3::splat(from), DVec3::new(to, to, from)));
        let all = Cube::around_all(cubes.iter()).unwrap();
        assert_eq!((all.half_side, all.extent), (4.0, DVec3::new(1.0, 1.0, 0.625)));
        let places = cubes.map(|cube| cube.within(&all));
        assert_eq!(places.each_ref().map(|place| place.corner.x), [0.5, 0.0, 0.625]);
        assert_eq!(places[1].side, 0.25);
        assert!(Cube::around_all([].iter()).is_none());
    }

    #[test]
    fn every_box_has_a_cube() {
        let cube = Cube::around(DVec3::ONE, DVec3::ONE);
        assert_eq!((cube.steps(DVec3::ONE), cube.extent), ([0; 3], DVec3::ZERO));
        for size in [f64::MIN_POSITIVE, 1e-300, 1.0, f64::MAX] {
            let (min, max) = (DVec3::new(-size, 0.0, size), DVec3::splat(size));
            let cube = Cube::around(min, max);
            assert_eq!(cube.extent, DVec3::new(1.0, 0.5, 0.0), "{size}");
            assert_eq!(cube.steps(max), [1 << 20, 1 << 19, 0], "{size}");
        }
    }
}
