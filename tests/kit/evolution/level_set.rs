//! Mean curvature of a surface of revolution by a level set in the half plane: [`MeridianLevelSet`].
//!
//! The surface is where `phi(x, r) = 0`, at height `x` and distance `r` from the axis, and with both principal curvatures
//! ```text
//!   phi_t = phi_xx + phi_rr + phi_r / r - (phi_x^2 phi_xx + 2 phi_x phi_r phi_xr + phi_r^2 phi_rr) / (phi_x^2 + phi_r^2)
//! ```
//! Central differences of second order at cell centres, reflected at the axis and at the plane of symmetry, linear beyond the outer
//! sides; Euler's method with steps of a fifth of the square of the spacing, far below its limit. Each level moves by its
//! own curvature, whatever the values, so they are not made distances again. It parts where the surface does by itself.

use glam::DVec2;

/// One half of a surface of revolution that is symmetric to the plane of height 0.
#[derive(Clone, Debug, PartialEq)]
pub struct MeridianLevelSet {
    columns: usize,
    rows: usize,
    spacing: f64,
    values: Vec<f64>,
    time: f64,
}

impl MeridianLevelSet {
    /// Cells of a spacing up to a height and a distance from the axis, with the values of a function, negative inside.
    pub fn new([height, distance]: [f64; 2], spacing: f64, value: impl Fn(DVec2) -> f64) -> Self {
        let [columns, rows] = [height, distance].map(|length| (length / spacing).ceil() as usize);
        let center = |i: usize| (i as f64 + 0.5) * spacing;
        let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
        let values = cells.map(|(i, j)| value(DVec2::new(center(i), center(j)))).collect();
        Self { columns, rows, spacing, values, time: 0.0 }
    }

    /// The value of a cell, also of one beyond the sides by one.
    fn at(&self, i: isize, j: isize) -> f64 {
        let beyond = |k: isize, count: usize| k >= count as isize;
        if beyond(i, self.columns) {
            return 2.0 * self.at(i - 1, j) - self.at(i - 2, j);
        }
        if beyond(j, self.rows) {
            return 2.0 * self.at(i, j - 1) - self.at(i, j - 2);
        }
        let mirrored = |k: isize| if k < 0 { (-1 - k) as usize } else { k as usize };
        self.values[mirrored(j) * self.columns + mirrored(i)]
    }

    /// Moves the surface up to a time.
    pub fn advance_to(&mut self, time: f64) {
        let longest = 0.2 * self.spacing * self.spacing;
        while self.time < time {
            let dt = longest.min(time - self.time);
            let cells = (0..self.rows as isize).flat_map(|j| (0..self.columns as isize).map(move |i| (i, j)));
            let changed: Vec<f64> = cells.map(|(i, j)| self.at(i, j) + dt * self.rate(i, j)).collect();
            self.values = changed;
            self.time = if dt == time - self.time { time } else { self.time + dt };
        }
    }

    fn rate(&self, i: isize, j: isize) -> f64 {
        let h = self.spacing;
        let at = |di: isize, dj: isize| self.at(i + di, j + dj);
        let here = at(0, 0);
        let (x, r) = ((at(1, 0) - at(-1, 0)) / (2.0 * h), (at(0, 1) - at(0, -1)) / (2.0 * h));
        let xx = (at(1, 0) - 2.0 * here + at(-1, 0)) / (h * h);
        let rr = (at(0, 1) - 2.0 * here + at(0, -1)) / (h * h);
        let xr = (at(1, 1) - at(-1, 1) - at(1, -1) + at(-1, -1)) / (4.0 * h * h);
        let revolution = r / ((j as f64 + 0.5) * h);
        let square = x * x + r * r;
        let across = if square > 0.0 { (x * x * xx + 2.0 * x * r * xr + r * r * rr) / square } else { 0.0 };
        xx + rr + revolution - across
    }

    /// The value at a place, by bilinear interpolation, over the slope there: the signed distance near the surface.
    #[must_use]
    pub fn distance_near(&self, place: DVec2) -> f64 {
        let cell = DVec2::new(place.x.abs(), place.y) / self.spacing - DVec2::splat(0.5);
        let (i, j) = (cell.x.floor(), cell.y.floor());
        let (s, t) = (cell.x - i, cell.y - j);
        let [a, b, c, d] =
            [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(di, dj)| self.at(i as isize + di, j as isize + dj));
        let value = (1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * c + s * d);
        let slope = DVec2::new((1.0 - t) * (b - a) + t * (d - c), (1.0 - s) * (c - a) + s * (d - b));
        value * self.spacing / slope.length()
    }
}
