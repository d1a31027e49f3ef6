//! Vortices along lines by quadrature: [`LineVortex`].

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use welter_meshing::quadrature::SegmentRule;

use crate::evolution::Dual;

/// `circulation / (4 pi)  sum of  dl / sqrt(|x - y|^2 + a^2)` over points `y` of a line, and the same of its curl, term by term.
#[derive(Clone, Debug)]
pub struct LineVortex {
    /// Points and line elements.
    elements: Vec<(DVec3, DVec3)>,
    core: f64,
    circulation: f64,
}

impl LineVortex {
    /// A circle by the trapezoid rule, which converges exponentially once its points are closer than core or distance.
    #[must_use]
    pub fn circle([center, axis]: [DVec3; 2], radius: f64, core: f64, circulation: f64, points: u32) -> Self {
        let axis = axis.normalize();
        let (u, v) = axis.any_orthonormal_pair();
        let element = |i: u32| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(points)).sin_cos();
            let length = TAU * radius / f64::from(points);
            // u, v and the axis are right-handed.
            (center + radius * (cos * u + sin * v), length * (cos * v - sin * u))
        };
        assert!(u.cross(v).dot(axis) > 0.0);
        Self { elements: (0..points).map(element).collect(), core, circulation }
    }

    /// A polyline, each segment cut into panels of 32 Gauss points.
    #[must_use]
    pub fn polyline(vertices: &[DVec3], core: f64, circulation: f64, panels: u32) -> Self {
        let rule = SegmentRule::of_degree(63).expect("the highest degree there is");
        let mut elements = Vec::new();
        for pair in vertices.windows(2) {
            let along = (pair[1] - pair[0]) / f64::from(panels);
            for panel in 0..panels {
                let start = pair[0] + f64::from(panel) * along;
                elements.extend(rule.points().iter().map(|&([_, s], w)| (start + s * along, w * along)));
            }
        }
        Self { elements, core, circulation }
    }

    /// From each point to `x`, with the line element and one over the distance.
    fn terms(&self, x: [Dual; 3]) -> impl Iterator<Item = ([Dual; 3], DVec3, Dual)> {
        let core = Dual::constant(self.core * self.core);
        self.elements.iter().map(move |&(y, dl)| {
            let d: [Dual; 3] = std::array::from_fn(|k| x[k] - Dual::constant(y[k]));
            let square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + core;
            (d, dl, square.sqrt().recip())
        })
    }

    fn times_strength(&self, sum: [Dual; 3]) -> [Dual; 3] {
        sum.map(|component| self.circulation / (4.0 * PI) * component)
    }

    /// The potential at a place given as three coordinates.
    #[must_use]
    pub fn potential(&self, x: [Dual; 3]) -> [Dual; 3] {
        let terms = self.terms(x).map(|(_, dl, inverse)| dl.to_array().map(|c| c * inverse));
        self.times_strength(total(&terms.collect::<Vec<_>>()))
    }

    /// The velocity.
    #[must_use]
    pub fn velocity(&self, x: [Dual; 3]) -> [Dual; 3] {
        let terms = self.terms(x).map(|(d, dl, inverse)| {
            let cubed = inverse * inverse * inverse;
            let cross = |i: usize, j: usize| cubed * (dl[i] * d[j] - dl[j] * d[i]);
            [cross(1, 2), cross(2, 0), cross(0, 1)]
        });
        self.times_strength(total(&terms.collect::<Vec<_>>()))
    }

    /// The sums of the magnitudes of the terms of potential, velocity and the derivatives of the velocity: what their roundings are
    /// relative to.
    #[must_use]
    pub fn magnitudes(&self, x: DVec3) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for (_, dl, inverse) in self.terms(Dual::coordinates(x)) {
            for (sum, power) in sums.iter_mut().zip(1..) {
                *sum += self.circulation.abs() / (4.0 * PI) * dl.length() * inverse.value.powi(power);
            }
        }
        // A derivative of a term of the velocity is up to four times that.
        [sums[0], sums[1], 4.0 * sums[2]]
    }
}

/// The sum of halves of the terms, so that it has few roundings.
fn total(terms: &[[Dual; 3]]) -> [Dual; 3] {
    match terms {
        [] => [Dual::constant(0.0); 3],
        [one] => *one,
        _ => {
            let (a, b) = terms.split_at(terms.len() / 2);
            let (a, b) = (total(a), total(b));
            std::array::from_fn(|k| a[k] + b[k])
        }
    }
}
