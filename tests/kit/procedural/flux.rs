//! What flows out of a closed surface: [`flux_of_box`], [`flux_of_sphere`].

use glam::DVec3;
use welter_meshing::quadrature::SegmentRule;

/// A flux, and what it is small against.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flux {
    /// The integral of the velocity along the outward normal.
    pub outward: f64,
    /// The integral of its magnitude.
    pub through: f64,
}

impl Flux {
    fn add(&mut self, velocity: DVec3, normal: DVec3, area: f64) {
        self.outward += area * velocity.dot(normal);
        self.through += area * velocity.length();
    }

    /// The flux relative to what goes through.
    #[must_use]
    pub fn relative(&self) -> f64 {
        self.outward.abs() / self.through
    }
}

/// Nodes in (0, 1) and weights that sum to one.
fn nodes(panels: u32) -> Vec<(f64, f64)> {
    let rule = SegmentRule::of_degree(31).expect("a degree below the highest");
    let width = 1.0 / f64::from(panels);
    let panel =
        |i: u32| rule.points().iter().map(move |&([_, s], w)| ((f64::from(i) + s) * width, w * width));
    (0..panels).flat_map(panel).collect()
}

/// Out of an axis-parallel box, each face cut into `panels` times `panels` squares of 16 times 16 Gauss points.
pub fn flux_of_box(velocity: impl Fn(DVec3) -> DVec3, [min, max]: [DVec3; 2], panels: u32) -> Flux {
    let (nodes, size) = (nodes(panels), max - min);
    let mut flux = Flux::default();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for (side, sign) in [(min[axis], -1.0), (max[axis], 1.0)] {
            for &(a, wa) in &nodes {
                for &(b, wb) in &nodes {
                    let (mut point, mut normal) = (DVec3::ZERO, DVec3::ZERO);
                    (point[axis], normal[axis]) = (side, sign);
                    point[u] = min[u] + a * size[u];
                    point[v] = min[v] + b * size[v];
                    flux.add(velocity(point), normal, wa * wb * size[u] * size[v]);
                }
            }
        }
    }
    flux
}

/// Out of a sphere: Gauss panels from pole to pole, the trapezoid rule around.
pub fn flux_of_sphere(velocity: impl Fn(DVec3) -> DVec3, center: DVec3, radius: f64, panels: u32) -> Flux {
    let around = 32 * panels;
    let mut flux = Flux::default();
    for (s, w) in nodes(panels) {
        let z = 2.0 * s - 1.0;
        let across = (1.0 - z * z).sqrt();
        for i in 0..around {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(around)).sin_cos();
            let normal = DVec3::new(across * cos, across * sin, z);
            let area = 4.0 * std::f64::consts::PI * radius * radius * w / f64::from(around);
            flux.add(velocity(center + radius * normal), normal, area);
        }
    }
    flux
}
