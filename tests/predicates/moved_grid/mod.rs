//! The predicates of the moved grid against a grid that is really moved, by powers of two that are small enough, and
//! what must hold between their answers.

mod laws;
mod totality;
mod twins;

type P3 = [f64; 3];

/// A box from two opposite corners.
fn sorted(p: P3, q: P3) -> (P3, P3) {
    ([0, 1, 2].map(|i| p[i].min(q[i])), [0, 1, 2].map(|i| p[i].max(q[i])))
}

/// The coordinates of the line along an axis through a point.
fn line_through(axis: usize, p: P3) -> [f64; 2] {
    [p[(axis + 1) % 3], p[(axis + 2) % 3]]
}
