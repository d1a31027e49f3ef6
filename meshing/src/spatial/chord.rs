//! How far a triangle reaches along one axis where another coordinate is known: [`chord`].

use super::Box3;
use crate::DVec3;

/// Bounds of coordinate `u` of a triangle where its coordinate `v` has a value; within those of its box.
///
/// On an edge, `a.u + t (b.u - a.u)` with `t` of [0, 1]: the quotient `t` errs by at most 4 u, the
/// product by 6 u of the difference, the sum by one u of itself; 16 u of the largest magnitude twice over is more.
pub(crate) fn chord(corners: [DVec3; 3], around: &Box3, [u, v]: [usize; 2], value: f64) -> [f64; 2] {
    const SLACK: f64 = 1.0 / (1u64 << 48) as f64;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for e in 0..3 {
        let (a, b) = (corners[e], corners[(e + 1) % 3]);
        if a[v].min(b[v]) > value || a[v].max(b[v]) < value {
            continue;
        }
        if a[v] == b[v] {
            (low, high) = (low.min(a[u].min(b[u])), high.max(a[u].max(b[u])));
            continue;
        }
        let at = a[u] + ((value - a[v]) / (b[v] - a[v])).clamp(0.0, 1.0) * (b[u] - a[u]);
        if !at.is_finite() {
            return [around.min[u], around.max[u]];
        }
        (low, high) = (low.min(at), high.max(at));
    }
    let slack = SLACK * around.min[u].abs().max(around.max[u].abs()) + f64::MIN_POSITIVE;
    [(low - slack).max(around.min[u]), (high + slack).min(around.max[u])]
}
