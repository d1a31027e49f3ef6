//! Better triangles, by flips \[Lawson77\].

use std::collections::BTreeSet;

use super::Triangulation;

impl Triangulation<'_> {
    /// Flips edges that are not fixed as long as that makes the worse of their two triangles better. The sorted list of all qualities
    /// grows with each flip, so this ends.
    pub(super) fn improve(&mut self, fixed: &BTreeSet<[u32; 2]>, metric: [f64; 3]) {
        let mut open: Vec<[u32; 2]> = self.left.keys().filter(|[a, b]| a < b).copied().collect();
        open.reverse();
        while let Some([a, b]) = open.pop() {
            if fixed.contains(&[a, b]) {
                continue;
            }
            let (Some(c), Some(d)) = (self.apex([a, b]), self.apex([b, a])) else { continue };
            let worse = |one, other| self.quality(one, metric).min(self.quality(other, metric));
            let (now, then) = (worse([a, b, c], [b, a, d]), worse([a, d, c], [d, b, c]));
            if then > now && self.flip([a, b]).is_some() {
                for [a, b] in [[a, d], [d, b], [b, c], [c, a]] {
                    open.push([a.min(b), a.max(b)]);
                }
            }
        }
    }

    /// Area over the sum of the squares of the edges, but for a factor. Of the same three points always the same bits.
    fn quality(&self, mut corners: [u32; 3], [aa, ab, bb]: [f64; 3]) -> f64 {
        corners.sort_unstable();
        let [p, q, r] = corners.map(|i| self.points[i as usize]);
        let edges = [[q[0] - p[0], q[1] - p[1]], [r[0] - q[0], r[1] - q[1]], [p[0] - r[0], p[1] - r[1]]];
        let squares: f64 = edges.iter().map(|&[u, v]| aa * u * u + 2.0 * ab * u * v + bb * v * v).sum();
        (edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0]).abs() / squares
    }
}
