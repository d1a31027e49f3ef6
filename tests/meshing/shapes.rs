//! Tests of `welter_meshing::shapes`.

use welter_meshing::shapes::{NAMES, by_name};
use welter_meshing::surface::TriMesh;

fn volume(mesh: &TriMesh) -> f64 {
    let position = |v: welter_meshing::surface::VertexId| mesh.positions()[v.index()];
    mesh.triangles().iter().map(|&[a, b, c]| position(a).dot(position(b).cross(position(c))) / 6.0).sum()
}

#[test]
fn every_named_shape_has_positive_volume_and_a_moderate_size() {
    for shape in NAMES {
        let mesh = by_name(shape.name, None).unwrap();
        let triangles = mesh.triangles().len();
        println!("{}: {triangles} triangles, volume {}", shape.name, volume(&mesh));
        assert!((5_000..=20_000).contains(&triangles), "{} has {triangles} triangles", shape.name);
        assert!(volume(&mesh) > 0.0, "{}", shape.name);
    }
}
