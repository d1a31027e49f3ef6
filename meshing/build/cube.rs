//! One case of marching cubes: which triangles and tetrahedra it has.

use crate::cell::{CORNERS, EDGE_ENDS, corner_offset};
use crate::hull::{Point, facets, volume};

/// A point of a cell by its number (see `cell`).
type PointId = u8;

/// Surface and volume of the cells in which exactly the corners of a set are negative.
#[derive(Default)]
pub(crate) struct Case {
    /// Counterclockwise seen from the positive side; all corners are samples.
    pub(crate) triangles: Vec<[PointId; 3]>,
    /// Positively oriented; the first corner is the lowest negative corner of the cell.
    pub(crate) tetrahedra: Vec<[PointId; 4]>,
}

impl Case {
    /// The case in which the corners whose bits are set are negative.
    pub(crate) fn of(negative: u8) -> Self {
        let mut case = Self::default();
        if negative == 0 {
            return case;
        }
        let points = points(negative);
        let places: Vec<Point> = points.iter().map(|&p| middle(p)).collect();
        let apex = points[0];
        for facet in facets(&places) {
            let polygon: Vec<PointId> = facet.iter().map(|&i| points[i]).collect();
            let on_face = on_face_of_cell(facet.iter().map(|&i| places[i]));
            if polygon.contains(&apex) {
                assert!(on_face, "near a negative corner the hull is the cell");
                continue;
            }
            let cones = |ways: &[[PointId; 3]]| ways.iter().all(|&[a, b, c]| never_inverts([apex, a, b, c]));
            let triangles = ways_to_triangulate(&polygon)
                .into_iter()
                .find(|way| cones(way))
                .expect("every case has a way without inverted tetrahedra");
            case.tetrahedra.extend(triangles.iter().map(|&[a, b, c]| [apex, a, b, c]));
            if !on_face {
                case.triangles.extend(triangles);
            }
        }
        case
    }
}

/// The negative corners, then the samples.
fn points(negative: u8) -> Vec<PointId> {
    let is_negative = |corner: u8| negative >> corner & 1 == 1;
    let corners = (0..CORNERS).filter(|&c| is_negative(c));
    let cut = (0..12).filter(|&e| {
        let [a, b] = EDGE_ENDS[usize::from(e)];
        is_negative(a) != is_negative(b)
    });
    corners.chain(cut.map(|e| CORNERS + e)).collect()
}

/// Where a point is, in halves of a cell: samples in the middle of their edges.
fn middle(point: PointId) -> Point {
    let [a, b] = ends(point).map(|end| corner_offset(end).map(i32::from));
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// The ends of the edge that a sample is on; a corner twice.
fn ends(point: PointId) -> [u8; 2] {
    if point < CORNERS { [point; 2] } else { EDGE_ENDS[usize::from(point - CORNERS)] }
}

fn on_face_of_cell(places: impl Iterator<Item = Point> + Clone) -> bool {
    (0..3).any(|axis| [0, 2].iter().any(|&side| places.clone().all(|p| p[axis] == side)))
}

/// Whether a tetrahedron has no negative volume wherever its samples are, and is not always flat.
fn never_inverts(tetrahedron: [PointId; 4]) -> bool {
    let mut is_solid = false;
    for choice in 0..16 {
        let mut at = 0;
        let [a, b, c, d] = tetrahedron.map(|p| {
            at += 1;
            corner_offset(ends(p)[choice >> (at - 1) & 1]).map(i32::from)
        });
        let volume = volume(a, b, c, d);
        if volume < 0 {
            return false;
        }
        is_solid |= volume > 0;
    }
    is_solid
}

/// All ways to cut a convex polygon into triangles.
fn ways_to_triangulate(polygon: &[PointId]) -> Vec<Vec<[PointId; 3]>> {
    if polygon.len() < 3 {
        return vec![Vec::new()];
    }
    let last = polygon.len() - 1;
    let mut ways = Vec::new();
    for k in 1..last {
        for before in ways_to_triangulate(&polygon[..=k]) {
            for after in ways_to_triangulate(&polygon[k..]) {
                let triangle = [polygon[0], polygon[k], polygon[last]];
                ways.push([before.as_slice(), &after, &[triangle]].concat());
            }
        }
    }
    ways
}
