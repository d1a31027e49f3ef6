//! Meshes added to a surface, against the surface of both meshes at once.

use glam::DVec3;
use welter_kit::surface::{closed_surfaces, open_surfaces};
use welter_meshing::surface::{TriMesh, TriangleSoup, VertexId};
use welter_tracking::surface::{AppendError, EventKind, MovingSurface, Rule};

/// Both, one after the other; vertices without triangles left out.
fn both(a: &TriMesh, b: &TriMesh) -> TriMesh {
    let [mut soup, other] = [a, b].map(|mesh| MovingSurface::new(mesh).unwrap().to_mesh().to_soup());
    let count = soup.positions.len() as u32;
    soup.positions.extend(other.positions);
    soup.triangles.extend(other.triangles.iter().map(|corners| corners.map(|v| v + count)));
    TriMesh::new(soup).unwrap()
}

/// A surface after some operations that leave gaps.
fn changed(mesh: &TriMesh) -> MovingSurface {
    let mut surface = MovingSurface::new(mesh).unwrap();
    for e in surface.connectivity().edges().collect::<Vec<_>>().into_iter().step_by(5) {
        if surface.connectivity().has_edge(e) {
            let [kept, _] = surface.connectivity().ends(e);
            if let Ok(plan) = surface.plan_collapse(e, kept, 0.5) {
                surface.apply(plan);
            }
        }
    }
    surface
}

#[test]
fn appended_meshes_are_as_if_they_had_been_there() {
    let meshes = [closed_surfaces(), open_surfaces()].concat();
    for (i, (name, mesh)) in meshes.iter().enumerate() {
        let (other_name, other) = &meshes[(i + 3) % meshes.len()];
        let mut surface = changed(mesh);
        let expected = both(&surface.to_mesh(), other);
        let before = surface.connectivity().vertex_count() as u32;
        let added = surface.append(other).unwrap();
        assert_eq!(surface.check(), Ok(()), "{name}, {other_name}");
        assert_eq!(surface.to_mesh(), expected, "{name}, {other_name}");
        assert_eq!(added, before..surface.connectivity().vertex_count() as u32);
        let fresh = MovingSurface::new(&expected).unwrap();
        let edges = |surface: &MovingSurface| {
            let mesh = surface.connectivity();
            mesh.edges().map(|e| (e, mesh.ends(e))).collect::<Vec<_>>()
        };
        assert_eq!(edges(&surface), edges(&fresh), "{name}, {other_name}");
    }
}

/// The last event tells all that came, and nothing else.
#[test]
fn the_log_tells_what_came() {
    let (_, mesh) = &closed_surfaces()[0];
    let mut surface = changed(mesh);
    let _ = surface.compact();
    let _ = surface.take_log();
    let [v, e, t] = [
        surface.connectivity().vertex_slots(),
        surface.connectivity().edge_slots(),
        surface.connectivity().triangle_slots(),
    ];
    let _ = surface.append(mesh).unwrap();
    let log = surface.take_log();
    assert_eq!(
        log.iter().map(|event| event.kind).collect::<Vec<_>>(),
        [EventKind::Compact, EventKind::Append]
    );
    let event = log.get(1).unwrap();
    let connectivity = surface.connectivity();
    assert!(
        event
            .vertices
            .iter()
            .map(|c| (c.vertex.index(), c.born))
            .eq((v..connectivity.vertex_slots()).map(|v| (v, true)))
    );
    assert!(event.edges.iter().map(|c| c.edge.index()).eq(e..connectivity.edge_slots()));
    assert!(event.edges.iter().all(|c| c.born && c.ends == connectivity.ends(c.edge)));
    assert!(event.triangles.iter().map(|c| c.triangle.index()).eq(t..connectivity.triangle_slots()));
    assert!(
        event
            .triangles
            .iter()
            .all(|c| c.before.is_none() && c.after == Some(connectivity.corners(c.triangle)))
    );
}

#[test]
fn values_stay_and_new_ones_come_from_nothing() {
    let (_, mesh) = &closed_surfaces()[0];
    let mut surface = MovingSurface::new(mesh).unwrap();
    let [v, e, t] = [
        surface.connectivity().vertex_slots(),
        surface.connectivity().edge_slots(),
        surface.connectivity().triangle_slots(),
    ];
    let numbers = |n: usize| (1..=n).map(|i| i as f64).collect::<Vec<_>>();
    let age = surface.vertex_attributes_mut().add("age", numbers(v), Rule::Interpolate).unwrap();
    let flux = surface.edge_attributes_mut().add_directed("flux", numbers(e), Rule::Conserve).unwrap();
    let group = surface
        .triangle_attributes_mut()
        .add(
            "group",
            vec![4_i64; t],
            Rule::custom(|sources| sources.first().map_or(-1, |source| source.value)),
        )
        .unwrap();
    surface.set_mass(VertexId(2), f64::INFINITY).unwrap();
    let _ = surface.append(mesh).unwrap();
    let with = |mut old: Vec<f64>, zeros: usize| {
        old.resize(old.len() + zeros, 0.0);
        old
    };
    assert_eq!(surface.vertex_attributes().values(age), with(numbers(v), v));
    assert_eq!(surface.edge_attributes().values(flux), with(numbers(e), e));
    assert_eq!(surface.triangle_attributes().values(group), [vec![4; t], vec![-1; t]].concat());
    assert!(surface.masses()[2].is_infinite() && surface.masses()[v..].iter().all(|&mass| mass == 1.0));
}

#[test]
fn what_is_no_surface_is_refused_and_nothing_changed() {
    let (_, mesh) = &closed_surfaces()[0];
    let mut surface = changed(mesh);
    let before = (surface.to_mesh(), surface.log().len());
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let soup = TriangleSoup { positions, triangles: vec![[0, 1, 2], [0, 1, 3]], ..TriangleSoup::default() };
    let refused = surface.append(&TriMesh::new(soup).unwrap());
    assert!(
        matches!(&refused, Err(AppendError::Defects(defects)) if defects.unbalanced.len() == 1),
        "{refused:?}"
    );
    assert_eq!((surface.to_mesh(), surface.log().len()), before);
    let nothing = TriMesh::new(TriangleSoup::default()).unwrap();
    assert!(surface.append(&nothing).unwrap().is_empty());
    assert_eq!(surface.to_mesh(), before.0);
}
