//! The path of a point: [`followed`].

use glam::DVec3;

/// Where a point is after a number of equal steps of the classical method of Runge and Kutta from one time to another.
pub fn followed(
    velocity: impl Fn(DVec3, f64) -> DVec3,
    start: DVec3,
    [from, to]: [f64; 2],
    steps: u32,
) -> DVec3 {
    let dt = (to - from) / f64::from(steps);
    (0..steps).fold(start, |x, i| {
        let t = from + f64::from(i) * dt;
        let k1 = velocity(x, t);
        let k2 = velocity(x + 0.5 * dt * k1, t + 0.5 * dt);
        let k3 = velocity(x + 0.5 * dt * k2, t + 0.5 * dt);
        let k4 = velocity(x + dt * k3, t + dt);
        x + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    })
}
