//! The boundary of a mesh.

use super::*;
use std::collections::BTreeMap;

#[test]
fn sides_are_those_that_a_map_of_all_sides_has_on_one_side_only() {
    for (seed, mesh) in random_meshes(100).enumerate() {
        let mut all: BTreeMap<[u32; 4], Vec<(usize, usize)>> = BTreeMap::new();
        for (hexahedron, vertices) in mesh.hexahedra().iter().enumerate() {
            for (side, corners) in QUADRILATERALS.iter().enumerate() {
                let mut key = corners.map(|corner| vertices[corner]);
                key.sort_unstable();
                all.entry(key).or_default().push((hexahedron, side));
            }
        }
        let mut expected: Vec<BoundarySide> = all
            .values()
            .filter(|members| members.iter().all(|(_, side)| *side == members[0].1))
            .map(|members| {
                let (hexahedron, side) = members[0];
                let vertices = QUADRILATERALS[side].map(|corner| mesh.hexahedra()[hexahedron][corner]);
                BoundarySide { hexahedron, side, vertices, hexahedra: members.len() }
            })
            .collect();
        expected.sort_unstable();
        assert_eq!(boundary_sides(&mesh, &Monitor::none()).unwrap(), expected, "{seed}");
    }
}

#[test]
fn boundaries_of_known_shapes_are_counted() {
    let count = |name| {
        let (_, mesh, _) = shapes().into_iter().find(|(other, ..)| *other == name).unwrap();
        boundary_sides(&mesh, &Monitor::none()).unwrap().len()
    };
    assert_eq!(count("nothing"), 0);
    assert_eq!(count("block"), 2 * (3 * 2 + 3 * 2 + 2 * 2));
    assert_eq!(count("ball with a cavity"), 6 * 9 + 6);
    assert_eq!(count("two cubes with a side"), 11);
    assert_eq!(count("two cubes with all sides"), 6);
    assert_eq!(count("Y joint"), 15);
}
