//! Ray queries against all triangles in turn.

use super::{SCALES, crowded, mapped, scattered};
use glam::DVec3;
use welter_kit::entropy::{Entropy, stream};
use welter_kit::exact::meeting_of_ray;
use welter_meshing::spatial::Bvh;
use welter_meshing::surface::{TriId, TriMesh};

/// The triangles that meet the closed ray, each intersected exactly.
fn all(mesh: &TriMesh, origin: DVec3, direction: DVec3) -> Vec<TriId> {
    (0..mesh.triangles().len())
        .map(TriId::from_index)
        .filter(|&t| {
            let corners = mesh.corners(t).map(|p| p.to_array());
            !meeting_of_ray(origin.to_array(), direction.to_array(), &corners).is_empty()
        })
        .collect()
}

fn found(mesh: &TriMesh, origin: DVec3, direction: DVec3) -> Vec<TriId> {
    Bvh::new(mesh).ray_hits(origin, direction).into_iter().map(|hit| hit.0).collect()
}

#[test]
fn rays_meet_exactly_the_triangles_that_they_meet() {
    let mut hits = 0;
    for seed in 0..12 {
        let bytes = stream(seed, 4000);
        let entropy = &mut Entropy::new(&bytes);
        let mesh = if seed % 2 == 0 { crowded(entropy, 14, 20, 5) } else { scattered(entropy, 25, 0.7) };
        for _ in 0..12 {
            let whole = |entropy: &mut Entropy<'_>, low, high| {
                DVec3::from_array([(); 3].map(|()| f64::from(entropy.between(low, high))))
            };
            let (origin, direction) = (whole(entropy, -2, 5), whole(entropy, -2, 2));
            let expected = all(&mesh, origin, direction);
            hits += expected.len();
            assert_eq!(found(&mesh, origin, direction), expected, "{origin} {direction}");
            for [a, b] in SCALES {
                let scaled = mapped(&mesh, |p| p * a * b);
                let exact = scaled.positions().iter().zip(mesh.positions()).all(|(s, p)| s / a / b == *p);
                if exact {
                    assert_eq!(found(&scaled, origin * a * b, direction), expected);
                }
            }
        }
    }
    assert!(hits > 50, "{hits}");
}

#[test]
fn far_origins_and_uneven_directions() {
    let mesh = crowded(&mut Entropy::new(&stream(3, 400)), 12, 16, 4);
    let far = [1e3, 1e9, 1e40, 1e300];
    for distance in far {
        for (origin, direction) in [
            (DVec3::new(1.0, 1.0, -distance), DVec3::Z),
            (DVec3::new(-distance, 2.0, 2.0), DVec3::new(distance, 0.0, 0.0)),
            (DVec3::new(1.0 - distance, 2.0 - distance, 1.0), DVec3::new(1.0, 1.0, 0.0)),
            (DVec3::new(1.0, 1.5, -distance), DVec3::new(1e-300, 1e-320, 1.0)),
        ] {
            assert_eq!(
                found(&mesh, origin, direction),
                all(&mesh, origin, direction),
                "{origin} {direction}"
            );
        }
    }
    assert!(found(&mesh, DVec3::NAN, DVec3::X).is_empty());
    assert!(found(&mesh, DVec3::ZERO, DVec3::INFINITY).is_empty());
}
