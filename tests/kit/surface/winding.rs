//! How often a closed surface winds around a point, by crossings with a segment out of it: [`winding_number`].

use crate::exact::orient;
use glam::DVec3;
use welter_meshing::spatial::Box3;
use welter_meshing::surface::TriMesh;

/// The winding number of a closed surface, oriented outward, about a point off it. All triangles are tried with exact orientations
/// along a segment to a point outside; one that passes through an edge or a vertex is not used.
///
/// # Panics
/// If no segment passes between all edges.
#[must_use]
pub fn winding_number(mesh: &TriMesh, point: DVec3) -> i32 {
    let far = mesh.positions().iter().fold(point.abs(), |far, p| far.max(p.abs())).max_element();
    // Nearly along axes, so that few boxes are met.
    let directions = [[13.0, 0.05, 0.07], [0.11, -17.0, 0.03], [0.04, -0.09, 31.0], [-37.0, -0.07, 0.06]];
    let ends = directions.map(|d| point + DVec3::from_array(d) * far);
    ends.into_iter().find_map(|end| crossings(mesh, [point, end])).expect("a segment in general position")
}

/// The sum of the crossings of a segment; none if it meets an edge.
fn crossings(mesh: &TriMesh, segment: [DVec3; 2]) -> Option<i32> {
    let [p, q] = segment.map(|end| end.to_array());
    let mut sum = 0;
    let around = Box3::of(segment);
    for corners in mesh.triangles() {
        let corners = corners.map(|v| mesh.positions()[v.index()]);
        if !Box3::of(corners).meets(&around) {
            continue;
        }
        let [a, b, c] = corners.map(|corner| corner.to_array());
        let around = [[a, b], [b, c], [c, a]].map(|[a, b]| orient(&[p, q, a, b]));
        if around.contains(&1) && around.contains(&-1) {
            continue;
        }
        let [from, to] = [p, q].map(|end| orient(&[a, b, c, end]));
        if from * to > 0 {
            continue;
        }
        if around.contains(&0) || from == 0 || to == 0 {
            return None;
        }
        // Out of the side below a triangle: out of what it encloses.
        sum += if from > 0 { 1 } else { -1 };
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::shapes::{BoxPair, nested_boxes};

    #[test]
    fn nested_boxes_wind_twice() {
        let mesh = nested_boxes(&BoxPair { edge_length: 1.0, ..BoxPair::nested() }).unwrap();
        let at = |x: f64| winding_number(&mesh, DVec3::new(x, 0.015625, 0.03125));
        assert_eq!([at(0.0), at(0.75), at(3.0)], [2, 1, 0]);
        assert_eq!(winding_number(mesh.clone().reversed().as_mesh(), DVec3::splat(0.011)), -2);
    }
}
