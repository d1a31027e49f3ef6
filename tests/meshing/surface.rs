//! Tests of `welter_meshing::surface`.

use welter_meshing::DVec3;
use welter_meshing::surface::*;

fn data(name: &str) -> Option<TriMesh> {
    let path = format!("{}/../../shared/data/meshes/{name}", env!("CARGO_MANIFEST_DIR"));
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("skipped: {path} is not there");
        return None;
    };
    let mut soup = TriangleSoup::default();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let c: Vec<f64> = words.map(|w| w.parse().unwrap()).collect();
                soup.positions.push(DVec3::new(c[0], c[1], c[2]));
            }
            Some("f") => {
                let v: Vec<u32> =
                    words.map(|w| w.split('/').next().unwrap().parse::<u32>().unwrap() - 1).collect();
                soup.triangles.extend((1..v.len() - 1).map(|i| [v[0], v[i], v[i + 1]]));
            }
            _ => {}
        }
    }
    Some(TriMesh::new(soup).unwrap())
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
