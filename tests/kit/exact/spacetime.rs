//! Whether two swept simplices meet in space-time: [`swept_meet`].
//!
//! The prism over a simplex that moves is cut into simplices by the order of its vertices' indices; two prisms meet if
//! two of their pieces do, which [`meeting`] tells by enumeration of weights.

use super::meeting;

/// The prism over vertices sorted by index, written out as in the thesis's figure.
fn pieces<const N: usize, const D: usize>(at: [&[[f64; N]]; 2], indices: &[u32]) -> Vec<Vec<[f64; D]>> {
    let mut order: Vec<usize> = (0..indices.len()).collect();
    order.sort_by_key(|&i| indices[i]);
    let event = |i: usize, time: usize| -> [f64; D] {
        std::array::from_fn(|k| if k < N { at[time][order[i]][k] } else { time as f64 })
    };
    match indices.len() {
        1 => vec![vec![event(0, 0), event(0, 1)]],
        2 => vec![vec![event(0, 0), event(1, 0), event(1, 1)], vec![event(0, 0), event(0, 1), event(1, 1)]],
        _ => vec![
            vec![event(0, 0), event(1, 0), event(2, 0), event(2, 1)],
            vec![event(0, 0), event(1, 0), event(1, 1), event(2, 1)],
            vec![event(0, 0), event(0, 1), event(1, 1), event(2, 1)],
        ],
    }
}

/// Whether the first `split` vertices and the others, from their places at time 0 to those at time 1, collide in
/// space-time of `D = N + 1` dimensions; each primitive is split by the order of its vertices' indices.
#[must_use]
pub fn swept_meet<const N: usize, const D: usize, const P: usize>(
    [t0, t1]: &[[[f64; N]; P]; 2],
    indices: &[u32; P],
    split: usize,
) -> bool {
    let first = pieces::<N, D>([&t0[..split], &t1[..split]], &indices[..split]);
    let second = pieces::<N, D>([&t0[split..], &t1[split..]], &indices[split..]);
    first.iter().any(|a| second.iter().any(|b| !meeting(a, b).is_empty()))
}
