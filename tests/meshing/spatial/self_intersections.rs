//! The list of self-intersections against all pairs decided exactly, and its laws.

use super::{SCALES, crowded, mapped, mesh_of, on_threads, oracle, scattered};
use glam::DVec3;
use welter_kit::entropy::{Entropy, stream};
use welter_kit::generate::Kind;
use welter_meshing::spatial::{Bvh, Sharing, self_intersections};
use welter_meshing::surface::{TriId, TriMesh};
use welter_meshing::{Cancelled, Monitor};

fn found(mesh: &TriMesh) -> Vec<[TriId; 2]> {
    self_intersections(mesh, &Monitor::none()).expect("nobody cancels")
}

fn found_by_position(mesh: &TriMesh) -> Vec<[TriId; 2]> {
    Bvh::new(mesh).self_intersections(Sharing::Position, &Monitor::none()).expect("nobody cancels")
}

fn crowded_meshes(count: u64) -> impl Iterator<Item = TriMesh> {
    (0..count).map(|seed| {
        let bytes = stream(seed, 400);
        crowded(&mut Entropy::new(&bytes), 4 + (seed % 8) as u8, 12, 2 + (seed % 4) as u8)
    })
}

#[test]
fn crowded_meshes_agree_with_all_pairs() {
    let mut by_shared = [[0; 2]; 4];
    for mesh in crowded_meshes(60) {
        let expected = oracle::self_intersections(&mesh, Sharing::Index);
        assert_eq!(found(&mesh), expected, "{mesh:?}");
        assert_eq!(
            found_by_position(&mesh),
            oracle::self_intersections(&mesh, Sharing::Position),
            "{mesh:?}"
        );
        for (i, s) in mesh.triangles().iter().enumerate() {
            for (j, t) in mesh.triangles().iter().enumerate().skip(i + 1) {
                let meet = expected.contains(&[TriId::from_index(i), TriId::from_index(j)]);
                by_shared[s.iter().filter(|v| t.contains(v)).count()][usize::from(meet)] += 1;
            }
        }
    }
    // Every case of the rule was met, with either answer.
    assert!(by_shared[..3].as_flattened().iter().all(|&count| count > 50), "{by_shared:?}");
}

#[test]
fn hard_coordinates_agree_with_all_pairs() {
    for kind in Kind::ALL {
        for seed in 0..6 {
            let bytes = stream(seed, 4000);
            let entropy = &mut Entropy::new(&bytes);
            let points: [[f64; 3]; 9] = kind.draw(entropy);
            let triangles = super::distinct_triples(entropy, 9, 8);
            let mesh = mesh_of(points.map(DVec3::from_array).to_vec(), triangles);
            assert_eq!(found(&mesh), oracle::self_intersections(&mesh, Sharing::Index), "{kind:?}: {mesh:?}");
        }
    }
}

#[test]
fn renumbering_renumbers_the_pairs() {
    for (seed, mesh) in crowded_meshes(20).enumerate() {
        let mut soup = mesh.to_soup();
        soup.triangles.reverse();
        soup.triangles.iter_mut().for_each(|t| t.rotate_left(seed % 3));
        // The vertices in reverse order too.
        let last = soup.positions.len() as u32 - 1;
        soup.positions.reverse();
        soup.triangles.iter_mut().flatten().for_each(|v| *v = last - *v);
        let renumbered = TriMesh::new(soup).unwrap();
        let count = mesh.triangles().len() as u32;
        let back = |t: TriId| TriId(count - 1 - t.0);
        let mut pairs: Vec<_> = found(&renumbered).into_iter().map(|[i, j]| [back(j), back(i)]).collect();
        pairs.sort_unstable();
        assert_eq!(pairs, found(&mesh));
    }
}

#[test]
fn exact_motions_keep_the_pairs() {
    for mesh in crowded_meshes(12) {
        let pairs = found(&mesh);
        assert_eq!(found(&mapped(&mesh, |p| DVec3::new(p.y, p.z, p.x))), pairs);
        assert_eq!(found(&mapped(&mesh, |p| DVec3::new(-p.x, p.z, p.y))), pairs);
        for shift in [1.0, 1e6, 1e15, -4e15] {
            assert_eq!(found(&mapped(&mesh, |p| p + DVec3::new(shift, 0.0, -shift))), pairs, "shift {shift}");
        }
        for [a, b] in SCALES {
            assert_eq!(found(&mapped(&mesh, |p| p * a * b)), pairs, "scale {a:e} {b:e}");
        }
    }
}

#[test]
fn threads_do_not_matter() {
    let bytes = stream(7, 40_000);
    let mesh = scattered(&mut Entropy::new(&bytes), 400, 0.4);
    let one = on_threads(1, || found(&mesh));
    assert!(one.len() > 100);
    for threads in [2, 3, 8] {
        assert_eq!(on_threads(threads, || found(&mesh)), one);
    }
}

#[test]
fn coincident_triangles_all_meet() {
    // Equal boxes: the case in which clustering has nothing to choose by.
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let count = 300;
    let mesh =
        mesh_of(corners.repeat(count), (0..count as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect());
    assert_eq!(found(&mesh).len(), count * (count - 1) / 2);
    assert_eq!(found_by_position(&mesh).len(), count * (count - 1) / 2);
    let points = mapped(&mesh, |_| DVec3::splat(3.0));
    assert_eq!(found(&points).len(), count * (count - 1) / 2);
}

#[test]
fn a_cancelled_search_has_no_list() {
    let stop = std::sync::atomic::AtomicBool::new(true);
    let mesh = mesh_of(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], vec![[0, 1, 2], [1, 2, 3]]);
    assert_eq!(self_intersections(&mesh, &Monitor::new(None, Some(&stop))), Err(Cancelled));
}

#[test]
fn small_meshes() {
    assert!(found(&mesh_of(vec![], vec![])).is_empty());
    assert!(found(&mesh_of(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]])).is_empty());
    let twice = mesh_of(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2], [2, 1, 0]]);
    assert_eq!(found(&twice), [[TriId(0), TriId(1)]]);
}
