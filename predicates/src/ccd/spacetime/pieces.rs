//! The pieces of space-time that moving primitives sweep, in the order of the vertices' indices.
//!
//! With `x_1 .. x_k` in the order of their indices, piece `i` has the vertices `x_1 .. x_i` at time 0 and `x_i
//! .. x_k` at time 1. On a face of the prism, `x_j` left out, these are the pieces of the remaining vertices:
//! so they agree where primitives share vertices.

type Event = [f64; 4];

/// A point at time 0 or 1.
fn event<const N: usize, const D: usize>(point: [f64; N], time: f64) -> [f64; D] {
    const { assert!(D == N + 1) };
    core::array::from_fn(|k| if k < N { point[k] } else { time })
}

/// The places of the primitive's vertices, sorted by index; equal indices stay in the order of the arguments.
fn sorted<const N: usize, const K: usize>(
    t0: &[[f64; N]],
    t1: &[[f64; N]],
    indices: &[u32],
) -> ([[f64; N]; K], [[f64; N]; K]) {
    let mut order: [usize; K] = core::array::from_fn(|i| i);
    order.sort_unstable_by_key(|&i| (indices[i], i));
    (order.map(|i| t0[i]), order.map(|i| t1[i]))
}

/// The `K` pieces of the prism over `K` sorted vertices, each with `K + 1` corners.
fn prism<const N: usize, const D: usize, const K: usize, const C: usize>(
    (t0, t1): ([[f64; N]; K], [[f64; N]; K]),
) -> [[[f64; D]; C]; K] {
    const { assert!(C == K + 1) };
    let corner = |piece: usize, i: usize| {
        let last = K - 1 - piece;
        if i <= last { event(t0[i], 0.0) } else { event(t1[i - 1], 1.0) }
    };
    core::array::from_fn(|piece| core::array::from_fn(|i| corner(piece, i)))
}

/// For each of the three tetrahedra, the two ends of the vertex's path and the four corners.
pub(super) fn vertex_face(t0: &[[f64; 3]; 4], t1: &[[f64; 3]; 4], indices: [u32; 4]) -> [[Event; 6]; 3] {
    let path = [event(t0[0], 0.0), event(t1[0], 1.0)];
    let pieces: [[Event; 4]; 3] = prism::<3, 4, 3, 4>(sorted(&t0[1..], &t1[1..], &indices[1..]));
    pieces.map(|[a, b, c, d]| [path[0], path[1], a, b, c, d])
}

/// For each pair of triangles, one of either edge, their corners.
pub(super) fn edge_edge(t0: &[[f64; 3]; 4], t1: &[[f64; 3]; 4], indices: [u32; 4]) -> [[Event; 6]; 4] {
    let first: [[Event; 3]; 2] = prism::<3, 4, 2, 3>(sorted(&t0[..2], &t1[..2], &indices[..2]));
    let second: [[Event; 3]; 2] = prism::<3, 4, 2, 3>(sorted(&t0[2..], &t1[2..], &indices[2..]));
    core::array::from_fn(|pair| {
        let ([a, b, c], [d, e, f]) = (first[pair / 2], second[pair % 2]);
        [a, b, c, d, e, f]
    })
}

/// For each of the two triangles, the two ends of the vertex's path and the three corners.
pub(super) fn vertex_segment(
    t0: &[[f64; 2]; 3],
    t1: &[[f64; 2]; 3],
    indices: [u32; 3],
) -> [[[f64; 3]; 5]; 2] {
    let path = [event(t0[0], 0.0), event(t1[0], 1.0)];
    let pieces: [[[f64; 3]; 3]; 2] = prism::<2, 3, 2, 3>(sorted(&t0[1..], &t1[1..], &indices[1..]));
    pieces.map(|[a, b, c]| [path[0], path[1], a, b, c])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_those_of_the_figure() {
        let t0 = [[9.0; 3], [3.0; 3], [1.0; 3], [2.0; 3]];
        let t1 = t0.map(|p| p.map(|x| 10.0 * x));
        let names = vertex_face(&t0, &t1, [0, 30, 10, 20]).map(|points| points.map(|p| p[0]));
        assert_eq!(
            names,
            [
                [9.0, 90.0, 1.0, 2.0, 3.0, 30.0],
                [9.0, 90.0, 1.0, 2.0, 20.0, 30.0],
                [9.0, 90.0, 1.0, 10.0, 20.0, 30.0]
            ]
        );
        let names = edge_edge(&t0, &t1, [2, 1, 3, 4]).map(|points| points.map(|p| p[0]));
        assert_eq!(names[0], [3.0, 9.0, 90.0, 1.0, 2.0, 20.0]);
        assert_eq!(names[3], [3.0, 30.0, 90.0, 1.0, 10.0, 20.0]);
        assert!(vertex_face(&t0, &t1, [0; 4])[0][5] == [20.0, 20.0, 20.0, 1.0]);
    }
}
