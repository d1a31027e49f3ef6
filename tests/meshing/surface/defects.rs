//! Each invariant, a mesh that violates it, and the culprits that the error names.

use super::*;

fn soup(positions: usize, triangles: &[[u32; 3]]) -> TriangleSoup {
    TriangleSoup {
        positions: (0..positions).map(|i| DVec3::new(i as f64, (i * i) as f64, 1.0)).collect(),
        triangles: triangles.to_vec(),
        ..TriangleSoup::default()
    }
}

fn defects(soup: TriangleSoup) -> Box<TriMeshDefects> {
    match TriMesh::new(soup) {
        Err(TriMeshError::Defects(defects)) => defects,
        other => panic!("expected defects, not {other:?}"),
    }
}

fn edge_defects(mesh: TriMesh) -> Box<ClosedOrientedDefects> {
    match ClosedOrientedMesh::new(mesh) {
        Err(ClosedOrientedError::Defects(defects)) => defects,
        other => panic!("expected defects, not {other:?}"),
    }
}

#[test]
fn every_non_finite_vertex_is_named() {
    let mut bad = soup(6, &[[0, 1, 2]]);
    bad.positions[1].y = f64::NAN;
    bad.positions[4].x = f64::INFINITY;
    bad.positions[5].z = f64::NEG_INFINITY; // used by no triangle, and still refused
    let defects = defects(bad.clone());
    let found: Vec<u32> = defects.non_finite_vertices.iter().map(|v| v.vertex.0).collect();
    assert_eq!(found, [1, 4, 5]);
    assert_eq!(defects.non_finite_vertices[1].position.x, f64::INFINITY);
    assert_eq!(
        TriMesh::check(&bad).unwrap_err().to_string(),
        "3 vertices have a non-finite coordinate: 1 (1, NaN, 1), 4 (inf, 16, 1), 5 (5, 25, -inf)"
    );
}

#[test]
fn every_bad_triangle_is_named_with_its_indices() {
    let bad = soup(3, &[[0, 1, 2], [0, 1, 3], [0, 0, 2], [u32::MAX, 1, u32::MAX], [2, 1, 2]]);
    let defects = defects(bad);
    let listed =
        |list: &[TriangleIndices]| list.iter().map(|t| (t.triangle.0, t.indices)).collect::<Vec<_>>();
    let max = u32::MAX;
    assert_eq!(listed(&defects.indices_out_of_range), [(1, [0, 1, 3]), (3, [max, 1, max])]);
    assert_eq!(listed(&defects.repeated_indices), [(2, [0, 0, 2]), (3, [max, 1, max]), (4, [2, 1, 2])]);
    assert_eq!(
        TriMeshError::Defects(defects).to_string(),
        "2 triangles have an index out of range: 1 (0, 1, 3), 3 (4294967295, 1, 4294967295); \
         3 triangles name a vertex twice: 2 (0, 0, 2), 3 (4294967295, 1, 4294967295), 4 (2, 1, 2)"
    );
}

#[test]
fn long_lists_are_cut_in_messages_but_not_in_the_error() {
    let defects = defects(soup(3, &[[0, 1, 9]; 1000]));
    assert_eq!(defects.indices_out_of_range.len(), 1000);
    let text = defects.to_string();
    assert!(text.starts_with("1000 triangles have an index out of range: 0 (0, 1, 9), 1 "), "{text}");
    assert!(text.ends_with(", ...") && text.len() < 120, "{text}");
}

#[test]
fn groups_and_colours_must_fit_the_triangles() {
    let group = |start, end| Group { name: format!("{start}"), triangles: start..end };
    let mut good = soup(3, &[[0, 1, 2], [2, 1, 0], [0, 1, 2]]);
    good.groups = vec![group(0, 1), group(1, 1), group(2, 3)];
    good.triangle_colors = vec![[1, 2, 3]; 3];
    let mesh = TriMesh::new(good.clone()).unwrap();
    assert_eq!(mesh.groups(), good.groups);
    assert_eq!(mesh.triangle_colors(), good.triangle_colors);
    assert_eq!(mesh.into_soup(), good);

    let mut bad = good.clone();
    bad.groups = vec![group(1, 2), group(0, 1), group(2, 4), group(3, 2)];
    bad.triangle_colors.pop();
    let defects = defects(bad);
    assert_eq!(defects.groups_out_of_order, [1, 2, 3]);
    assert_eq!(defects.color_count, Some(2));
}

#[test]
fn a_boundary_is_named_edge_by_edge() {
    let open = placed(&[[0, 2, 1], [0, 1, 3], [1, 2, 3]]);
    let defects = edge_defects(open);
    let edges: Vec<_> =
        defects.boundary.iter().map(|e| (e.vertices.map(|v| v.0), e.triangles[0].0)).collect();
    assert_eq!(edges, [([0, 2], 0), ([0, 3], 1), ([2, 3], 2)]);
    assert!(defects.inconsistent.is_empty() && defects.unbalanced.is_empty());
    assert_eq!(defects.to_string(), "3 boundary edges: 0-2 (triangle 0), 0-3 (triangle 1), 2-3 (triangle 2)");
}

#[test]
fn a_flipped_triangle_is_named_by_its_edges() {
    let flipped = placed(&[[0, 2, 1], [0, 1, 3], [1, 3, 2], [2, 0, 3]]);
    let defects = edge_defects(flipped);
    let edges: Vec<_> =
        defects.inconsistent.iter().map(|e| (e.vertices.map(|v| v.0), &*e.triangles)).collect();
    assert_eq!(
        edges,
        [
            ([1, 2], &[TriId(0), TriId(2)][..]),
            ([1, 3], &[TriId(1), TriId(2)]),
            ([2, 3], &[TriId(2), TriId(3)])
        ]
    );
    assert_eq!((defects.inconsistent[0].forward, defects.inconsistent[0].backward), (0, 2));
}

#[test]
fn a_moebius_band_is_refused() {
    // Five triangles, the smallest band with one side: an edge must disagree however they are turned.
    let band = [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 0, 4], [4, 0, 1]];
    for flips in 0..1u32 << 5 {
        let triangles: Vec<[u32; 3]> = band
            .iter()
            .enumerate()
            .map(|(i, &[a, b, c])| if flips >> i & 1 == 1 { [a, c, b] } else { [a, b, c] })
            .collect();
        let defects = edge_defects(placed(&triangles));
        assert_eq!(defects.boundary.len(), 5);
        assert_eq!(defects.inconsistent.len() % 2, 1, "an odd number of disagreements goes round");
    }
}

#[test]
fn unbalanced_edges_are_named_and_balanced_ones_allowed() {
    let tetrahedron = |[a, b, c, d]: [u32; 4]| [[a, c, b], [a, b, d], [b, c, d], [c, a, d]];
    // Two tetrahedra with a common edge: four triangles on it, two each way.
    let kissing = [tetrahedron([0, 1, 2, 3]), tetrahedron([0, 1, 4, 5])].concat();
    assert!(ClosedOrientedMesh::new(placed(&kissing)).is_ok());
    let topology = Topology::of(&placed(&kissing));
    assert_eq!(topology.non_manifold_edges(), [topology.edge_between(VertexId(1), VertexId(0)).unwrap()]);
    assert!(topology.is_closed() && topology.is_oriented() && !topology.is_edge_manifold());

    // One of them inside out: still balanced, since each balances itself.
    let reversed: Vec<_> = tetrahedron([0, 1, 4, 5]).map(|[a, b, c]| [a, c, b]).to_vec();
    assert!(
        ClosedOrientedMesh::new(placed(&[tetrahedron([0, 1, 2, 3]).to_vec(), reversed].concat())).is_ok()
    );

    // Three triangles on an edge.
    let fin = [tetrahedron([0, 1, 2, 3]).to_vec(), vec![[0, 1, 4]]].concat();
    let defects = edge_defects(placed(&fin));
    assert_eq!(defects.unbalanced[0].vertices, [VertexId(0), VertexId(1)]);
    assert_eq!((defects.unbalanced[0].forward, defects.unbalanced[0].backward), (2, 1));
    assert_eq!(*defects.unbalanced[0].triangles, [TriId(0), TriId(1), TriId(4)]);
    assert_eq!(defects.iter().count(), 3);

    // A triangle listed once each way is closed; listed twice the same way it is not.
    assert!(ClosedOrientedMesh::new(placed(&[[0, 1, 2], [0, 2, 1]])).is_ok());
    assert_eq!(edge_defects(placed(&[[0, 1, 2], [0, 1, 2]])).inconsistent.len(), 3);
    assert!(ClosedOrientedMesh::new(placed(&[])).is_ok());
}
