//! Operations on surfaces small enough to be drawn.

use glam::DVec3;
use welter_kit::surface::{Replay, closed_surfaces, non_manifold_surfaces};
use welter_meshing::surface::{TriId, TriMesh, TriangleSoup, VertexId};
use welter_tracking::surface::{EventKind, HalfEdge, MovingSurface, Refusal, Rule};

fn surface(vertices: u32, triangles: &[[u32; 3]]) -> MovingSurface {
    let positions = (0..vertices).map(f64::from).map(|i| DVec3::new(i, i * i, i * i * i)).collect();
    let soup = TriangleSoup { positions, triangles: triangles.to_vec(), ..TriangleSoup::default() };
    MovingSurface::new(&TriMesh::new(soup).unwrap()).unwrap()
}

/// A prism around a ring of three edges: vertices 0, 1, 2 of the ring, apexes 3 below and 4 above.
fn bipyramid() -> MovingSurface {
    surface(5, &[[0, 1, 4], [1, 2, 4], [2, 0, 4], [1, 0, 3], [2, 1, 3], [0, 2, 3]])
}

fn edge(surface: &MovingSurface, a: u32, b: u32) -> welter_meshing::surface::EdgeId {
    surface.connectivity().edge_between(VertexId(a), VertexId(b)).unwrap()
}

#[test]
fn a_tetrahedron_collapses_into_nothing() {
    let mut tetrahedron = MovingSurface::new(&closed_surfaces().swap_remove(0).1).unwrap();
    let plan = tetrahedron.plan_collapse(edge(&tetrahedron, 0, 1), VertexId(0), 0.5).unwrap();
    let told = tetrahedron.consequences(&plan);
    assert_eq!(told.cancelled.len(), 1);
    assert_eq!(told.lost_vertices, [0, 1, 2, 3].map(VertexId));
    tetrahedron.apply(plan);
    assert_eq!(tetrahedron.connectivity().triangle_count(), 0);
    assert_eq!(tetrahedron.check(), Ok(()));
    assert_eq!(tetrahedron.log().get(0).unwrap().triangles.len(), 4);
    tetrahedron.compact();
    assert_eq!(tetrahedron.connectivity().vertex_slots(), 0);
}

#[test]
fn a_ring_of_three_edges_is_told_before_it_collapses() {
    // Two prisms on one another: the ring 0, 1, 2 has no triangle, so a collapse of 0-1 joins 0-2 with 1-2.
    let upper = [[1, 0, 5], [5, 0, 4], [2, 1, 6], [6, 1, 5], [0, 2, 4], [4, 2, 6], [5, 4, 6]];
    let lower = upper.map(|[a, b, c]: [u32; 3]| [b, a, c].map(|v| if v < 3 { v } else { v + 3 }));
    let mut prisms = surface(10, &[upper, lower].concat());
    assert_eq!(prisms.connectivity().euler_characteristic(), 2);
    let plan = prisms.plan_collapse(edge(&prisms, 0, 1), VertexId(0), 0.5).unwrap();
    let told = prisms.consequences(&plan);
    assert_eq!(told.joined_edges, [[VertexId(0), VertexId(2)]]);
    assert_eq!((told.lost_vertices, told.cancelled), (vec![VertexId(1)], vec![]));
    prisms.apply(plan);
    assert_eq!(prisms.connectivity().edge_triangles(edge(&prisms, 0, 2)), 4);
    assert_eq!(prisms.check(), Ok(()));
}

/// A bipyramid is cut at its waist: two tetrahedra, whose log and attributes follow.
#[test]
fn a_ring_of_three_edges_is_cut_into_two_closed_surfaces() {
    let mut both = bipyramid();
    let amounts = (0..5).map(|i| f64::from(1 << i)).collect();
    let amount = both.vertex_attributes_mut().add("amount", amounts, Rule::Conserve).unwrap();
    let before = Replay::of(both.connectivity());
    let ring = [0, 1, 2].map(VertexId);
    let plan = both.plan_cut(ring).unwrap();
    let EventKind::Cut { ring: told, copies } = plan.kind() else { panic!("{:?}", plan.kind()) };
    assert_eq!(told, ring);
    // Triangles run along the ring in this order above: that part gets the copies.
    assert!(plan.changed().iter().all(|(_, corners)| corners.contains(&VertexId(4))));
    assert_eq!((plan.changed().len(), plan.added().len(), plan.removed().len()), (3, 2, 0));
    both.apply(plan);
    assert_eq!(both.check(), Ok(()));
    let mesh = both.connectivity();
    assert_eq!((mesh.vertex_count(), mesh.edge_count(), mesh.triangle_count()), (8, 12, 8));
    assert!(mesh.edges().all(|e| mesh.edge_triangles(e) == 2));
    assert!(
        copies
            .iter()
            .all(|&v| mesh.vertex_triangles(v) == 3
                && both.position(v) == both.position(ring[v.0 as usize - 5]))
    );
    let values = both.vertex_attributes().values(amount);
    assert_eq!(mesh.vertices().map(|v| values[v.index()]).sum::<f64>(), 31.0);
    let mut replay = before;
    both.log().iter().for_each(|event| replay.apply(&event));
    assert_eq!(replay, Replay::of(mesh));
}

#[test]
fn what_is_no_ring_is_not_cut() {
    let both = bipyramid();
    // The sides of a triangle leave nothing on one side; 3 and 4 have no edge; twice the same vertex is none.
    for ring in [[0, 1, 4], [1, 0, 4], [0, 3, 4], [0, 0, 1]] {
        let refused = both.plan_cut(ring.map(VertexId));
        assert!(matches!(refused, Err(Refusal::Corners { .. })), "{ring:?}: {refused:?}");
    }
    assert!(matches!(both.plan_cut([0, 1, 9].map(VertexId)), Err(Refusal::NotInUse { .. })));
}

#[test]
fn a_flip_onto_an_edge_that_exists_cancels_what_lies_on_each_other() {
    let mut bipyramid = bipyramid();
    // The apexes of 0-1 are 3 and 4, not joined yet: nothing else happens.
    let sides = |s: &MovingSurface, a: u32, b: u32| {
        let around: Vec<HalfEdge> = s.connectivity().around_edge(edge(s, a, b)).collect();
        [around[0], around[1]]
    };
    let plan = bipyramid.plan_flip(sides(&bipyramid, 0, 1)).unwrap();
    assert_eq!(bipyramid.consequences(&plan), Default::default());
    bipyramid.apply(plan);
    // Those of 1-2 are 3 and 4 too: of its new triangles one lies on a triangle of the first flip, and both cancel.
    let plan = bipyramid.plan_flip(sides(&bipyramid, 1, 2)).unwrap();
    let told = bipyramid.consequences(&plan);
    assert_eq!((told.cancelled.len(), told.lost_vertices), (1, vec![VertexId(1)]));
    bipyramid.apply(plan);
    assert_eq!(bipyramid.connectivity().triangle_count(), 4);
    assert_eq!(bipyramid.check(), Ok(()));
    let kind = bipyramid.log().get(1).unwrap().kind;
    assert!(matches!(kind, EventKind::Flip { .. }), "{kind:?}");
}

#[test]
fn half_edges_of_the_same_way_are_not_flipped() {
    let five = MovingSurface::new(&non_manifold_surfaces().swap_remove(1).1).unwrap();
    let mesh = five.connectivity();
    let shared = edge(&five, 0, 1);
    assert_eq!(mesh.edge_triangles(shared), 10);
    let forward: Vec<HalfEdge> =
        mesh.around_edge(shared).filter(|&h| mesh.tail(h) == VertexId(0)).take(2).collect();
    let half_edges = [forward[0], forward[1]];
    assert_eq!(five.plan_flip(half_edges).unwrap_err(), Refusal::NotOpposite { half_edges });
}

#[test]
fn three_triangles_at_an_edge_are_refused_with_the_edge() {
    let square = surface(5, &[[0, 1, 2], [2, 1, 3]]);
    let refusal = square.plan_replacement(&[], &[[1, 2, 4].map(VertexId)]).unwrap_err();
    // Vertex 4 has no triangle, so it is not in use.
    assert!(matches!(refusal, Refusal::Corners { .. }));
    let square = surface(6, &[[0, 1, 2], [2, 1, 3], [3, 4, 5]]);
    let refusal = square.plan_replacement(&[], &[[1, 2, 4].map(VertexId)]).unwrap_err();
    assert_eq!(
        refusal,
        Refusal::Unbalanced { vertices: [VertexId(1), VertexId(2)], forward: 2, backward: 1 }
    );
}

#[test]
fn the_same_triangle_is_refused_and_its_reverse_cancels() {
    let mut one = surface(3, &[[0, 1, 2]]);
    let again = one.plan_replacement(&[], &[[1, 2, 0].map(VertexId)]).unwrap_err();
    assert_eq!(again, Refusal::Doubled { corners: [0, 1, 2].map(VertexId) });
    let reverse = one.plan_replacement(&[], &[[2, 1, 0].map(VertexId)]).unwrap();
    assert_eq!(one.consequences(&reverse).cancelled, [[None, Some(TriId(0))]]);
    one.apply(reverse);
    assert_eq!(one.connectivity().triangle_count(), 0);
}

#[test]
fn an_edge_of_many_triangles_is_split_as_a_whole() {
    let mut five = MovingSurface::new(&non_manifold_surfaces().swap_remove(1).1).unwrap();
    let triangles = five.connectivity().triangle_slots();
    let areas = five.triangle_attributes_mut().add("area", vec![1.0; triangles], Rule::Conserve).unwrap();
    let shared = edge(&five, 0, 1);
    let plan = five.plan_split(shared, 0.25).unwrap();
    let outcome = five.apply(plan);
    assert_eq!(outcome.triangles.len(), 10);
    let m = outcome.vertices[0];
    assert_eq!(five.connectivity().vertex_triangles(m), 20);
    let parts: Vec<f64> =
        outcome.triangles.iter().map(|t| five.triangle_attributes().values(areas)[t.index()]).collect();
    assert_eq!(parts, [0.75; 10]);
    assert_eq!(five.connectivity().edge_between(VertexId(0), VertexId(1)), None);
    assert_eq!(five.check(), Ok(()));
}

#[test]
#[should_panic(expected = "a plan is for one state of a surface")]
fn a_plan_of_an_earlier_state_is_not_applied() {
    let mut bipyramid = bipyramid();
    let plans: Vec<_> = (0..2).map(|_| bipyramid.plan_split(edge(&bipyramid, 0, 1), 0.5).unwrap()).collect();
    for plan in plans {
        bipyramid.apply(plan);
    }
}
