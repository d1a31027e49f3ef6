//! What is accepted as a surface, and what is refused.

use glam::DVec3;
use welter_kit::surface::{closed_surfaces, non_manifold_surfaces, open_surfaces};
use welter_meshing::surface::{EmbeddedMesh, Topology, TriId, TriMesh, TriangleSoup, VertexId};
use welter_tracking::surface::{
    AttributeError, MassRule, MovingSurface, RadialConnectivity, Refusal, Rule, VertexValueError,
};

fn mesh(vertices: u32, triangles: &[[u32; 3]]) -> TriMesh {
    let positions = (0..vertices).map(f64::from).map(|i| DVec3::new(i, i * i, i * i * i)).collect();
    TriMesh::new(TriangleSoup { positions, triangles: triangles.to_vec(), ..TriangleSoup::default() })
        .unwrap()
}

#[test]
fn edges_are_numbered_as_in_topology() {
    for (name, mesh) in [closed_surfaces(), non_manifold_surfaces(), open_surfaces()].concat() {
        let surface = RadialConnectivity::new(&mesh).unwrap();
        assert_eq!(surface.check(), Ok(()), "{name}");
        let topology = Topology::of(&mesh);
        let ends: Vec<_> = surface.edges().map(|e| surface.ends(e)).collect();
        assert_eq!(ends, topology.edges(), "{name}");
        for e in surface.edges() {
            let triangles: Vec<_> = surface.around_edge(e).map(|h| h.triangle()).collect();
            assert_eq!(triangles, topology.edge_triangles(e).collect::<Vec<_>>(), "{name}");
        }
        assert_eq!(surface.euler_characteristic(), topology.euler_characteristic(), "{name}");
        let singular: Vec<_> = surface.vertices().filter(|&v| surface.fans(v).len() > 1).collect();
        assert_eq!(singular, topology.non_manifold_vertices(), "{name}");
    }
}

#[test]
fn embedded_meshes_are_accepted() {
    let sphere = welter_meshing::shapes::sphere(&welter_meshing::shapes::Sphere::default()).unwrap();
    let embedded = EmbeddedMesh::new(sphere).unwrap();
    let surface = MovingSurface::new(&embedded).unwrap();
    assert_eq!(surface.to_mesh().triangles(), embedded.triangles());
    assert_eq!(surface.to_mesh().positions(), embedded.positions());
}

#[test]
fn every_defect_is_told_with_its_ids() {
    // Three triangles at 0-1, two of the same way at 5-6, and the corners 8, 9, 10 twice.
    let triangles = [[0, 1, 2], [1, 0, 3], [0, 1, 4], [5, 6, 7], [5, 6, 11], [8, 9, 10], [10, 9, 8]];
    let defects = MovingSurface::new(&mesh(12, &triangles)).unwrap_err();
    let edges: Vec<_> = defects.unbalanced.iter().map(|d| (d.vertices, d.forward, d.backward)).collect();
    assert_eq!(edges, [([VertexId(0), VertexId(1)], 2, 1), ([VertexId(5), VertexId(6)], 2, 0)]);
    assert_eq!(*defects.unbalanced[0].triangles, [TriId(0), TriId(1), TriId(2)]);
    assert_eq!(defects.doubled.len(), 1);
    assert_eq!(defects.doubled[0].triangles, [TriId(5), TriId(6)]);
    assert_eq!(defects.doubled[0].corners, [VertexId(8), VertexId(9), VertexId(10)]);
    assert_eq!(
        defects.to_string(),
        "2 edges with unbalanced triangles: 0-1 (triangles 0, 1, 2), 5-6 (triangles 3, 4); \
         1 set of triangles with the same corners: 5 and 6 (8, 9, 10)"
    );
}

#[test]
fn vertices_without_triangles_are_given_out_first() {
    let mut surface = MovingSurface::new(&mesh(6, &[[1, 3, 5]])).unwrap();
    assert_eq!(surface.connectivity().vertices().collect::<Vec<_>>(), [1, 3, 5].map(VertexId));
    let edge = surface.connectivity().edges().next().unwrap();
    let plan = surface.plan_split(edge, 0.5).unwrap();
    assert_eq!(surface.apply(plan).vertices, [VertexId(0)]);
    assert_eq!(surface.check(), Ok(()));
    assert_eq!(surface.to_mesh().positions().len(), 4);
}

#[test]
fn values_out_of_range_are_refused() {
    let mut surface = MovingSurface::new(&mesh(3, &[[0, 1, 2]])).unwrap();
    let v = VertexId(1);
    for mass in [0.0, -1.0, f64::NAN] {
        assert!(matches!(surface.set_mass(v, mass), Err(VertexValueError::Mass { .. })));
    }
    let at = DVec3::new(0.0, f64::INFINITY, 0.0);
    assert_eq!(surface.set_position(v, at), Err(VertexValueError::Position { vertex: v, position: at }));
    let attributes = surface.vertex_attributes_mut();
    let wrong = attributes.add("a", vec![1.0], Rule::Copy).unwrap_err();
    assert_eq!(wrong, AttributeError::Length { name: "a".to_owned(), values: 1, ids: 3 });
    assert!(attributes.add("a", vec![1.0; 3], Rule::Copy).is_ok());
    assert_eq!(
        attributes.add("a", vec![1_i64; 3], Rule::Copy).unwrap_err(),
        AttributeError::Name { name: "a".to_owned() }
    );
    assert!(matches!(
        attributes.add("b", vec![1_i64; 3], Rule::Interpolate),
        Err(AttributeError::Mean { .. })
    ));
    assert!(attributes.find::<f64>("a").is_some() && attributes.find::<i64>("a").is_none());

    let edge = surface.connectivity().edges().next().unwrap();
    for fraction in [0.0, 1.0, -0.5, f64::NAN] {
        assert!(matches!(surface.plan_split(edge, fraction), Err(Refusal::Fraction { .. })));
    }
    assert!(matches!(
        surface.plan_split(welter_meshing::surface::EdgeId(77), 0.5),
        Err(Refusal::NotInUse { .. })
    ));
    let triangle = TriId(0);
    assert!(matches!(surface.plan_replacement(&[triangle, triangle], &[]), Err(Refusal::NotInUse { .. })));
    assert!(matches!(surface.plan_replacement(&[TriId(1)], &[]), Err(Refusal::NotInUse { .. })));
}

#[test]
fn masses_follow_their_rule_and_immovable_vertices_stay_so() {
    for rule in [MassRule::Interpolate, MassRule::Conserve] {
        let mut surface = MovingSurface::new(&mesh(4, &[[0, 1, 2], [2, 1, 3]])).unwrap();
        surface.set_mass_rule(rule);
        surface.set_mass(VertexId(0), f64::INFINITY).unwrap();
        surface.set_mass(VertexId(1), f64::INFINITY).unwrap();
        surface.set_mass(VertexId(2), 4.0).unwrap();
        let split = |surface: &mut MovingSurface, a: u32, b: u32| {
            let edge = surface.connectivity().edge_between(VertexId(a), VertexId(b)).unwrap();
            let plan = surface.plan_split(edge, 0.5).unwrap();
            let vertex = surface.apply(plan).vertices[0];
            (edge, surface.masses()[vertex.index()])
        };
        let (_, between_immovable) = split(&mut surface, 0, 1);
        assert_eq!(between_immovable, f64::INFINITY);
        let (_, between) = split(&mut surface, 1, 2);
        // Vertex 2 has three triangles, of which two are on the edge.
        assert_eq!(between, if rule == MassRule::Interpolate { 4.0 } else { 4.0 / 3.0 });
        let edge = surface.connectivity().edge_between(VertexId(0), VertexId(2)).unwrap();
        let plan = surface.plan_collapse(edge, VertexId(2), 0.0).unwrap();
        surface.apply(plan);
        assert_eq!(surface.masses()[2], f64::INFINITY);
    }
}
