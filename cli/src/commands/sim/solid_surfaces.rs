//! Solids as triangles, to be drawn: [`SolidSurface`].
//!
//! Promises: vertices are on the surface of the solid; triangles are flat and at most a 64th of a turn wide, so a round surface is drawn
//! within a thousandth of its radius. Sharp edges are sharp. The same bits everywhere.

use super::bounds::Bounds;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use welter_meshing::field::{Ball, Capsule, Cuboid, Cylinder, HalfSpace, Torus};
use welter_meshing::surface::{TriMesh, TriMeshError, TriangleSoup};

/// Parts of a full turn around an axis.
const AROUND: u32 = 192;
/// Parts of a quarter of a turn along a profile.
const QUARTER: u32 = 32;

/// The surface of a solid.
#[derive(Clone, Debug)]
pub(super) enum SolidSurface {
    /// A curve that is turned around an axis: distances from it and heights along it, from the lower to the upper end.
    Turned {
        origin: DVec3,
        axis: DVec3,
        profile: Vec<[f64; 2]>,
    },
    Box(Cuboid),
    Plane(HalfSpace),
}

impl SolidSurface {
    pub(super) fn ball(ball: &Ball) -> Self {
        let profile = arc(ball.radius, [0.0, 0.0], -FRAC_PI_2, PI);
        Self::Turned { origin: ball.center, axis: DVec3::Z, profile }
    }

    pub(super) fn torus(torus: &Torus) -> Self {
        let profile = arc(torus.tube_radius, [torus.radius, 0.0], -PI, TAU);
        Self::Turned { origin: torus.center, axis: torus.axis, profile }
    }

    pub(super) fn capsule(capsule: &Capsule) -> Self {
        let [a, b] = capsule.ends;
        let mut profile = arc(capsule.radius, [0.0, 0.0], -FRAC_PI_2, FRAC_PI_2);
        profile.extend(arc(capsule.radius, [0.0, a.distance(b)], 0.0, FRAC_PI_2));
        Self::Turned { origin: a, axis: if a == b { DVec3::Z } else { b - a }, profile }
    }

    pub(super) fn cylinder(cylinder: &Cylinder) -> Self {
        let [a, b] = cylinder.ends;
        let (radius, height) = (cylinder.radius, a.distance(b));
        let profile = vec![[0.0, 0.0], [radius, 0.0], [radius, height], [0.0, height]];
        Self::Turned { origin: a, axis: b - a, profile }
    }

    /// A box around it, if it ends somewhere.
    pub(super) fn bounds(&self) -> Option<Bounds> {
        match self {
            Self::Turned { .. } => Bounds::of(self.mesh(DVec3::ZERO, 0.0).ok()?.positions().iter().copied()),
            Self::Box(cuboid) => Some(Bounds { low: cuboid.min, high: cuboid.max }),
            Self::Plane(_) => None,
        }
    }

    /// Its triangles; a plane is a square around the point nearest to `middle`, and goes as far as `horizon`.
    pub(super) fn mesh(&self, middle: DVec3, horizon: f64) -> Result<TriMesh, TriMeshError> {
        let (positions, triangles) = match self {
            Self::Turned { origin, axis, profile } => turned(*origin, *axis, profile),
            Self::Box(cuboid) => rounded_box(cuboid),
            Self::Plane(half) => {
                let [u, v, w] = frame(half.normal);
                let foot = middle - w * (middle - half.point).dot(w);
                let corner = |s: f64, t: f64| foot + horizon * (s * u + t * v);
                let square = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
                (square, vec![[0, 1, 2], [0, 2, 3]])
            }
        };
        TriMesh::new(TriangleSoup { positions, triangles, ..TriangleSoup::default() })
    }
}

/// Points of an arc around a middle, with their distances from an axis and heights along it.
fn arc(radius: f64, [away, height]: [f64; 2], from: f64, turn: f64) -> Vec<[f64; 2]> {
    let parts = (turn / FRAC_PI_2).round() as u32 * QUARTER;
    let point = |k: u32| {
        let angle = from + turn * (f64::from(k) / f64::from(parts));
        // On the axis exactly, where the arc ends there.
        let distance =
            if away == 0.0 && (angle.abs() - FRAC_PI_2).abs() < 1e-9 { 0.0 } else { libm::cos(angle) };
        [away + radius * distance, height + radius * libm::sin(angle)]
    };
    (0..=parts).map(point).collect()
}

/// A right-handed frame that ends with a direction.
fn frame(direction: DVec3) -> [DVec3; 3] {
    let w = (direction / direction.abs().max_element()).normalize_or_zero();
    let across = if w.x.abs() < 0.7 { DVec3::X } else { DVec3::Y };
    let u = across.cross(w).normalize_or_zero();
    [u, w.cross(u), w]
}

fn turned(origin: DVec3, axis: DVec3, profile: &[[f64; 2]]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let [u, v, w] = frame(axis);
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for &[away, height] in profile {
        positions.extend((0..AROUND).map(|k| {
            let angle = TAU * (f64::from(k) / f64::from(AROUND));
            origin + away * (libm::cos(angle) * u + libm::sin(angle) * v) + height * w
        }));
    }
    for (row, pair) in profile.windows(2).enumerate() {
        let first = row as u32 * AROUND;
        for k in 0..AROUND {
            let next = (k + 1) % AROUND;
            let [a, b, c, d] = [first + k, first + next, first + AROUND + next, first + AROUND + k];
            // No triangle without area where the curve meets the axis.
            if pair[0][0] > 0.0 {
                triangles.push([a, b, c]);
            }
            if pair[1][0] > 0.0 {
                triangles.push([a, c, d]);
            }
        }
    }
    (positions, triangles)
}

/// Six faces, each of a grid that is flat within and bends around the edges.
fn rounded_box(cuboid: &Cuboid) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let radius = cuboid.rounding;
    let parts = if radius > 0.0 { QUARTER / 2 } else { 0 };
    // Side of the core, and slope of the direction across it.
    let low = (0..=parts).rev().map(|k| (0.0, -f64::from(k) / f64::from(parts.max(1))));
    let high = (0..=parts).map(|k| (1.0, f64::from(k) / f64::from(parts.max(1))));
    let line: Vec<(f64, f64)> = low.chain(high).collect();
    let (core_low, core_high) = (cuboid.min + DVec3::splat(radius), cuboid.max - DVec3::splat(radius));
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for face in 0..6 {
        let (axis, side) = (face / 2, face % 2);
        let base = positions.len() as u32;
        for &(s, across) in &line {
            for &(t, along) in &line {
                let (mut at, mut slope) = (DVec3::ZERO, DVec3::ZERO);
                (at[axis], slope[axis]) = (side as f64, 2.0 * side as f64 - 1.0);
                (at[(axis + 1) % 3], slope[(axis + 1) % 3]) = (s, across);
                (at[(axis + 2) % 3], slope[(axis + 2) % 3]) = (t, along);
                let core = core_low * (DVec3::ONE - at) + core_high * at;
                positions.push(core + radius * slope.normalize());
            }
        }
        let n = line.len() as u32;
        for i in 0..n - 1 {
            for j in 0..n - 1 {
                let [a, b, c, d] = [i * n + j, (i + 1) * n + j, (i + 1) * n + j + 1, i * n + j + 1];
                let [a, b, c, d] = [a, b, c, d].map(|v| base + v);
                let two = if side == 1 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
                triangles.extend(two);
            }
        }
    }
    (positions, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::field::ScalarField;

    /// Vertices and middles of triangles are on the solid, and triangles face away from it.
    fn check(surface: &SolidSurface, field: &dyn ScalarField, size: f64) {
        let mesh = surface.mesh(DVec3::ZERO, 1.0).unwrap();
        for &p in mesh.positions() {
            assert!(field.value(p).abs() < 1e-12 * size, "{p}: {}", field.value(p));
        }
        for corners in mesh.triangles() {
            let [a, b, c] = corners.map(|v| mesh.positions()[v.index()]);
            let normal = (b - a).cross(c - a);
            assert!(normal.length() > 0.0);
            let middle = (a + b + c) / 3.0;
            assert!(field.value(middle).abs() < 2e-3 * size, "{middle}");
            assert!(field.value(middle + 0.01 * size * normal.normalize()) > 0.0, "{middle}");
        }
    }

    #[test]
    fn solids_are_drawn_where_they_are() {
        let ball = Ball { center: DVec3::new(1.0, 2.0, 3.0), radius: 0.5 };
        check(&SolidSurface::ball(&ball), &ball, 0.5);
        let torus =
            Torus { center: DVec3::X, axis: DVec3::new(1.0, 2.0, -1.0), radius: 2.0, tube_radius: 0.5 };
        check(&SolidSurface::torus(&torus), &torus, 0.5);
        let ends = [DVec3::new(0.0, 1.0, 0.0), DVec3::new(2.0, 1.0, 1.0)];
        let capsule = Capsule { ends, radius: 0.5 };
        check(&SolidSurface::capsule(&capsule), &capsule, 0.5);
        let cylinder = Cylinder { ends, radius: 0.5 };
        check(&SolidSurface::cylinder(&cylinder), &cylinder, 0.5);
        for rounding in [0.0, 0.25, 0.5] {
            let cuboid = Cuboid { min: DVec3::new(-1.0, 0.0, 0.0), max: DVec3::new(1.0, 1.0, 1.5), rounding };
            if rounding < 0.5 {
                check(&SolidSurface::Box(cuboid), &cuboid, 1.0);
            }
            let mesh = SolidSurface::Box(cuboid).mesh(DVec3::ZERO, 1.0).unwrap();
            let bounds = Bounds::of(mesh.positions().iter().copied()).unwrap();
            assert_eq!((bounds.low, bounds.high), (cuboid.min, cuboid.max));
        }
        let half = HalfSpace { point: DVec3::new(0.0, 0.0, -1.0), normal: DVec3::new(0.0, 3.0, 4.0) };
        check(&SolidSurface::Plane(half), &half, 1.0);
    }
}
