//! Topology: against a slow obvious twin on random connectivity, by named examples, and on real meshes.

use super::*;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Everything that follows from the definitions, by maps of sets.
struct Twin {
    /// Triangles and directions of each edge.
    edges: BTreeMap<[u32; 2], Vec<(usize, bool)>>,
    triangles: Vec<[u32; 3]>,
}

impl Twin {
    fn of(triangles: &[[u32; 3]]) -> Self {
        let mut edges = BTreeMap::<_, Vec<_>>::new();
        for (t, &[a, b, c]) in triangles.iter().enumerate() {
            for (tail, head) in [(a, b), (b, c), (c, a)] {
                edges.entry([tail.min(head), tail.max(head)]).or_default().push((t, tail < head));
            }
        }
        Self { edges, triangles: triangles.to_vec() }
    }

    /// The classes of `0..count` under a relation, by flooding.
    fn classes(count: usize, linked: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
        let mut classes: Vec<Vec<usize>> = Vec::new();
        let mut seen = vec![false; count];
        for start in 0..count {
            if seen[start] {
                continue;
            }
            let (mut class, mut stack) = (Vec::new(), vec![start]);
            seen[start] = true;
            while let Some(i) = stack.pop() {
                class.push(i);
                for (j, seen) in seen.iter_mut().enumerate() {
                    if !*seen && linked(i, j) {
                        *seen = true;
                        stack.push(j);
                    }
                }
            }
            class.sort_unstable();
            classes.push(class);
        }
        classes
    }

    fn components(&self) -> Vec<Vec<usize>> {
        let t = &self.triangles;
        Self::classes(t.len(), |i, j| t[i].iter().any(|v| t[j].contains(v)))
    }

    fn fans(&self, v: u32) -> usize {
        let at: Vec<[u32; 3]> = self.triangles.iter().copied().filter(|t| t.contains(&v)).collect();
        Self::classes(at.len(), |i, j| at[i].iter().any(|w| *w != v && at[j].contains(w))).len()
    }

    fn edges_with(&self, pick: impl Fn(usize, usize) -> bool) -> Vec<[u32; 2]> {
        let picked = self.edges.iter().filter(|(_, list)| {
            let forward = list.iter().filter(|(_, forward)| *forward).count();
            pick(forward, list.len() - forward)
        });
        picked.map(|(&edge, _)| edge).collect()
    }
}

fn connectivity() -> impl Strategy<Value = Vec<[u32; 3]>> {
    // Few vertices: shared edges, fins, pinched vertices and duplicates are common.
    let triangle = (2..14u32).prop_flat_map(|count| {
        let distinct = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
        prop::array::uniform3(0..=count).prop_filter("three vertices", distinct)
    });
    prop::collection::vec(triangle, 0..24)
}

proptest! {
    #[test]
    fn topology_equals_its_definition(triangles in connectivity()) {
        let mesh = placed(&triangles);
        let topology = Topology::of(&mesh);
        let twin = Twin::of(&triangles);

        let edges: Vec<[u32; 2]> = topology.edges().iter().map(|e| e.map(|v| v.0)).collect();
        prop_assert_eq!(&edges, &twin.edges.keys().copied().collect::<Vec<_>>());
        for (e, list) in twin.edges.values().enumerate() {
            let found: Vec<usize> = topology.edge_triangles(EdgeId::from_index(e)).map(TriId::index).collect();
            prop_assert_eq!(found, list.iter().map(|(t, _)| *t).collect::<Vec<_>>());
        }
        for (t, sides) in topology.triangle_edges().iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (triangles[t][k], triangles[t][(k + 1) % 3]);
                prop_assert_eq!(edges[sides[k].index()], [a.min(b), a.max(b)]);
            }
        }
        let ends = |ids: &[EdgeId]| ids.iter().map(|e| edges[e.index()]).collect::<Vec<_>>();
        prop_assert_eq!(ends(topology.non_manifold_edges()), twin.edges_with(|f, b| f + b > 2));
        let inconsistent = twin.edges_with(|f, b| f.abs_diff(b) != (f + b) % 2);
        prop_assert_eq!(ends(topology.inconsistent_edges()), inconsistent);
        prop_assert_eq!(topology.is_closed(), twin.edges_with(|f, b| (f + b) % 2 == 1).is_empty());
        let accepted = twin.edges_with(|f, b| f != b).is_empty();
        prop_assert_eq!(ClosedOrientedMesh::check(&mesh).is_ok(), accepted);
        prop_assert_eq!(topology.is_closed() && topology.is_oriented(), accepted);

        let fans: Vec<usize> = (0..mesh.positions().len() as u32).map(|v| twin.fans(v)).collect();
        let with = |pick: fn(usize) -> bool| {
            (0..fans.len()).filter(|&v| pick(fans[v])).map(VertexId::from_index).collect::<Vec<_>>()
        };
        prop_assert_eq!(topology.non_manifold_vertices(), with(|n| n > 1));
        prop_assert_eq!(topology.unreferenced_vertices(), with(|n| n == 0));

        let components = twin.components();
        prop_assert_eq!(topology.components().len(), components.len());
        let used = fans.iter().filter(|&&n| n > 0).count();
        let euler = used as i64 - edges.len() as i64 + triangles.len() as i64;
        prop_assert_eq!(topology.euler_characteristic(), euler);
        for (c, expected) in components.iter().enumerate() {
            let found: Vec<usize> = topology.component_triangles(c).iter().map(|t| t.index()).collect();
            prop_assert_eq!(&found, expected);
            prop_assert!(expected.iter().all(|&t| topology.component_of(TriId::from_index(t)) == c));
            // Each component by itself has what the component says.
            let part: Vec<[u32; 3]> = expected.iter().map(|&t| triangles[t]).collect();
            let alone = Topology::of(&placed(&part));
            let component = topology.components()[c];
            prop_assert_eq!(component.first_triangle.index(), expected[0]);
            prop_assert_eq!(component.triangles, expected.len());
            prop_assert_eq!(component.edges, alone.edges().len());
            prop_assert_eq!(component.euler_characteristic, alone.euler_characteristic());
            prop_assert_eq!(component.boundary_loops, alone.boundary_loops().len());
            prop_assert_eq!(component.closed, alone.is_closed());
            prop_assert_eq!(component.oriented, alone.is_oriented());
            prop_assert_eq!(component.manifold, alone.is_edge_manifold() && alone.is_vertex_manifold());
            prop_assert_eq!(component.genus, alone.genus());
            prop_assert_eq!(component.genus.is_some(), component.oriented && component.manifold);
        }

        let duplicates: Vec<_> = Twin::classes(triangles.len(), |i, j| {
            triangles[i].iter().collect::<BTreeSet<_>>() == triangles[j].iter().collect()
        });
        let duplicates: Vec<_> = duplicates.into_iter().filter(|class| class.len() > 1).collect();
        let found: Vec<Vec<usize>> = duplicate_triangles(&mesh, &topology)
            .iter()
            .map(|class| class.iter().map(|t| t.index()).collect())
            .collect();
        prop_assert_eq!(found, duplicates);
    }

    #[test]
    fn boundary_loops_use_each_boundary_edge_once(triangles in connectivity()) {
        let topology = Topology::of(&placed(&triangles));
        let twin = Twin::of(&triangles);
        let mut used = Vec::new();
        for boundary in topology.boundary_loops() {
            let n = boundary.edges.len();
            prop_assert_eq!(boundary.vertices.len(), if boundary.closed { n } else { n + 1 });
            for (i, edge) in boundary.edges.iter().enumerate() {
                let (a, b) = (boundary.vertices[i], boundary.vertices[(i + 1) % boundary.vertices.len()]);
                prop_assert_eq!(topology.edges()[edge.index()], [a.min(b), a.max(b)]);
                used.push([a.0.min(b.0), a.0.max(b.0)]);
            }
        }
        used.sort_unstable();
        prop_assert_eq!(used, twin.edges_with(|f, b| f + b == 1));
        if topology.is_edge_manifold() {
            prop_assert!(topology.boundary_loops().iter().all(|boundary| boundary.closed));
        }
    }
}

fn loops(triangles: &[[u32; 3]]) -> Vec<(Vec<u32>, bool)> {
    let topology = Topology::of(&placed(triangles));
    let ids = |l: &BoundaryLoop| l.vertices.iter().map(|v| v.0).collect();
    topology.boundary_loops().iter().map(|l| (ids(l), l.closed)).collect()
}

#[test]
fn boundary_loops_run_with_the_surface_to_their_left() {
    assert_eq!(loops(&[[0, 1, 2]]), [(vec![0, 1, 2], true)]);
    assert_eq!(loops(&[[0, 1, 2], [2, 1, 3]]), [(vec![0, 1, 3, 2], true)]);
    // Two triangles that touch at a vertex: two loops through it, not one that crosses over.
    assert_eq!(loops(&[[0, 1, 2], [0, 3, 4]]), [(vec![0, 1, 2], true), (vec![0, 3, 4], true)]);
    // An annulus: two loops.
    let annulus: Vec<[u32; 3]> =
        (0..4).flat_map(|i| [[i, (i + 1) % 4, 4 + i], [4 + i, (i + 1) % 4, 4 + (i + 1) % 4]]).collect();
    assert_eq!(loops(&annulus), [(vec![0, 1, 2, 3], true), (vec![5, 4, 7, 6], true)]);
    let topology = Topology::of(&placed(&annulus));
    assert_eq!((topology.euler_characteristic(), topology.genus()), (0, Some(0)));
    // A Moebius band: one loop.
    let band = [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 0, 4], [4, 0, 1]];
    assert_eq!(loops(&band).len(), 1);
    assert_eq!(loops(&band)[0].0.len(), 5);
    // Three pages of a book: each ends at the spine.
    let book = [[0, 1, 2], [0, 1, 3], [0, 1, 4]];
    assert_eq!(loops(&book), [(vec![1, 2, 0], false), (vec![1, 3, 0], false), (vec![1, 4, 0], false)]);
}

#[test]
fn two_tetrahedra_that_share_a_vertex_are_one_component_with_a_pinched_vertex() {
    let tetrahedron = |[a, b, c, d]: [u32; 4]| [[a, c, b], [a, b, d], [b, c, d], [c, a, d]];
    let pinched = [tetrahedron([0, 1, 2, 3]), tetrahedron([3, 4, 5, 6])].concat();
    let topology = Topology::of(&placed(&pinched));
    assert_eq!(topology.components().len(), 1);
    assert_eq!(topology.euler_characteristic(), 3);
    assert_eq!(topology.non_manifold_vertices(), [VertexId(3)]);
    assert_eq!(topology.genus(), None);
    assert!(topology.is_edge_manifold() && !topology.is_vertex_manifold());
}

#[test]
fn the_empty_mesh_has_nothing_and_no_fault() {
    let mesh = mesh(&[[0.0; 3]], &[]);
    let topology = Topology::of(&mesh);
    assert_eq!(topology.euler_characteristic(), 0);
    assert_eq!((topology.components(), topology.genus()), (&[][..], Some(0)));
    assert_eq!(topology.unreferenced_vertices(), [VertexId(0)]);
    assert!(topology.is_closed() && topology.is_oriented());
}

#[test]
fn equal_positions_are_found_whatever_the_sign_of_zero() {
    let tiny = f64::from_bits(1);
    let points = [
        [0.0, 1.0, 2.0],
        [1.0, 1.0, 2.0],
        [-0.0, 1.0, 2.0],
        [tiny, 1.0, 2.0],
        [1.0, 1.0, 2.0],
        [0.0, 1.0, 2.0],
    ];
    let classes: Vec<Vec<u32>> =
        duplicate_vertices(&mesh(&points, &[])).iter().map(|c| c.iter().map(|v| v.0).collect()).collect();
    assert_eq!(classes, [vec![0, 2, 5], vec![1, 4]]);
}

#[test]
fn degenerate_triangles_are_those_on_a_line_exactly() {
    let up = 1.0_f64.next_up();
    let positions = [
        [0.0, 0.0, 0.0],
        [1.0, 1.0, 1.0],
        [3.0, 3.0, 3.0],
        [3.0, 3.0, 3.0_f64.next_up()],
        [1e-300, 1e-300, 1e-300],
        [1e300, 1e300, 1e300],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, up],
    ];
    let triangles = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [0, 4, 5], [4, 1, 5], [0, 6, 7], [1, 6, 7], [2, 4, 3]];
    let found: Vec<u32> = degenerate_triangles(&mesh(&positions, &triangles)).iter().map(|t| t.0).collect();
    assert_eq!(found, [0, 3, 4, 5]);
}

#[test]
fn components_and_genus_of_real_meshes() {
    for (name, triangles, components, genus) in [
        ("manifold_self_intersectA.obj", 17_160, 1, 0),
        ("simpleBridge_39comp.obj", 32_014, 39, 0),
        ("openscad_nonmanifold_crash.obj", 1_442, 2, 4),
        ("manifold_offset1.obj", 4_418, 39, 0),
        ("manifold_generic_twin_right.obj", 11_656, 1, 0),
        ("comb.obj", 9_816, 1, 0),
        ("spot.obj", 5_856, 1, 0),
    ] {
        let Some(mesh) = data(name) else { return };
        let topology = Topology::of(&mesh);
        assert_eq!(mesh.triangles().len(), triangles, "{name}");
        assert_eq!(topology.components().len(), components, "{name}");
        assert_eq!(topology.genus(), Some(genus), "{name}");
        assert!(topology.is_closed() && topology.is_oriented(), "{name}");
        assert!(ClosedOrientedMesh::check(&mesh).is_ok(), "{name}");
    }
}
