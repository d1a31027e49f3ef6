//! Slow and obvious twins: all pairs, unbounded integers.

use rug::Integer;
use welter_kit::exact::{lift, linear::primitive, meeting};
use welter_meshing::spatial::Sharing;
use welter_meshing::surface::{TriId, TriMesh};

/// All pairs of triangles that meet in more than the vertex or edge that they share, found by intersecting every two
/// triangles exactly.
pub(crate) fn self_intersections(mesh: &TriMesh, sharing: Sharing) -> Vec<[TriId; 2]> {
    let count = mesh.triangles().len() as u32;
    (0..count)
        .flat_map(|i| (i + 1..count).map(move |j| [TriId(i), TriId(j)]))
        .filter(|&pair| meet_in_more(mesh, pair, sharing))
        .collect()
}

/// Whether one pair of triangles meets in more than it shares.
pub(crate) fn meet_in_more(mesh: &TriMesh, [i, j]: [TriId; 2], sharing: Sharing) -> bool {
    let corners = |t: TriId| mesh.corners(t).map(|p| p.to_array());
    // The same integers as inside of `meeting`.
    let lifted = lift(&[corners(i), corners(j)].concat());
    let (s, t) = (mesh.triangles()[i.index()], mesh.triangles()[j.index()]);
    let same = |k: usize, l: usize| match sharing {
        Sharing::Index => s[k] == t[l],
        Sharing::Position => lifted[k] == lifted[3 + l],
    };
    let mut shared: Vec<&[Integer; 3]> =
        (0..3).filter(|&k| (0..3).any(|l| same(k, l))).map(|k| &lifted[k]).collect();
    if sharing == Sharing::Position {
        shared.dedup();
    }
    let outside = |point: &[Integer]| match shared[..] {
        [] => true,
        [v] => !in_segment(point, v, v),
        [u, v] => !in_segment(point, u, v),
        // Of a collapsed triangle the first and the last corner may be the same.
        [u, v, w] => sharing == Sharing::Index || u != w || !in_segment(point, u, v),
        _ => unreachable!("a triangle has three corners"),
    };
    let all_by_index = sharing == Sharing::Index && shared.len() == 3;
    all_by_index || meeting(&corners(i), &corners(j)).corners.iter().any(|corner| outside(&corner.point))
}

/// Whether a point in homogeneous coordinates lies in the closed segment `uv`.
fn in_segment(point: &[Integer], u: &[Integer; 3], v: &[Integer; 3]) -> bool {
    let w = &point[3];
    let from_u: [Integer; 3] = std::array::from_fn(|k| &point[k] - Integer::from(&u[k] * w));
    let edge: [Integer; 3] = std::array::from_fn(|k| Integer::from(&v[k] - &u[k]));
    let cross =
        |a: usize, b: usize| Integer::from(&from_u[a] * &edge[b]) - Integer::from(&from_u[b] * &edge[a]);
    if edge.iter().all(Integer::is_zero) {
        let at_u = u.iter().cloned().chain([Integer::from(1)]).collect();
        return primitive(at_u) == primitive(point.to_vec());
    }
    let dot = |a: &[Integer; 3]| -> Integer { (0..3).map(|k| Integer::from(&a[k] * &edge[k])).sum() };
    let along = dot(&from_u);
    let length = dot(&edge) * w;
    cross(0, 1).is_zero() && cross(1, 2).is_zero() && cross(2, 0).is_zero() && along >= 0 && along <= length
}
