//! Pairs of boxes, box queries and refits against all boxes in turn.

use super::{SCALES, crowded, mapped, mesh_of, on_threads, scattered};
use glam::DVec3;
use welter_kit::entropy::{Entropy, stream};
use welter_kit::exact::clip_to_box;
use welter_meshing::Monitor;
use welter_meshing::spatial::{Box3, BoxTree, Bvh, RefitError};
use welter_meshing::surface::{TriId, TriMesh};

fn boxes(mesh: &TriMesh) -> Vec<Box3> {
    (0..mesh.triangles().len()).map(|t| Box3::of(mesh.corners(TriId::from_index(t)))).collect()
}

fn all_pairs(a: &[Box3], b: &[Box3]) -> Vec<[TriId; 2]> {
    let of = |i: usize| {
        (0..b.len()).filter(move |&j| a[i].meets(&b[j])).map(move |j| [i, j].map(TriId::from_index))
    };
    (0..a.len()).flat_map(of).collect()
}

fn meshes() -> Vec<TriMesh> {
    let scattered = (0..3).map(|seed| scattered(&mut Entropy::new(&stream(seed, 20_000)), 150, 0.1));
    let crowded = (0..5).map(|seed| crowded(&mut Entropy::new(&stream(seed, 900)), 30, 60, 8));
    scattered.chain(crowded).collect()
}

#[test]
fn self_pairs_are_all_pairs_of_meeting_boxes() {
    for mesh in meshes() {
        for [a, b] in SCALES {
            let mesh = mapped(&mesh, |p| p * a * b);
            let boxes = boxes(&mesh);
            let expected: Vec<_> = all_pairs(&boxes, &boxes).into_iter().filter(|[i, j]| i < j).collect();
            assert!(!expected.is_empty());
            assert_eq!(Bvh::new(&mesh).self_pairs(&Monitor::none()), Ok(expected.clone()));
            let tree = BoxTree::new(&boxes);
            let raw: Vec<_> = expected.iter().map(|pair| pair.map(|t| t.0)).collect();
            assert_eq!(tree.self_pairs(&boxes, &Monitor::none()), Ok(raw));
        }
    }
}

#[test]
fn pairs_between_two_meshes_whatever_their_frames() {
    let all = meshes();
    for (i, mesh) in all.iter().enumerate() {
        let other = &all[(i + 1) % all.len()];
        // Scenes of very different size and place.
        for (scale, shift) in [(1.0, 0.0), (0.5, 0.3), (1e-9, 0.5), (1e12, -3e11), (f64::MIN_POSITIVE, 0.0)] {
            let other = mapped(other, |p| p * scale + shift);
            let (a, b) = (Bvh::new(mesh), Bvh::new(&other));
            let expected = all_pairs(&boxes(mesh), &boxes(&other));
            assert_eq!(a.pairs_with(&b, &Monitor::none()), Ok(expected.clone()));
            let tree_of = |m: &TriMesh| BoxTree::new(&boxes(m));
            let raw = expected.iter().map(|pair| pair.map(|t| t.0)).collect();
            let found =
                tree_of(mesh).pairs_with(&boxes(mesh), &tree_of(&other), &boxes(&other), &Monitor::none());
            assert_eq!(found, Ok(raw));
        }
    }
    let empty = mesh_of(vec![], vec![]);
    assert_eq!(Bvh::new(&empty).pairs_with(&Bvh::new(&all[0]), &Monitor::none()), Ok(vec![]));
}

#[test]
fn box_queries_are_exact_about_boxes_and_about_triangles() {
    let mut passing_by = 0;
    for (seed, mesh) in (0..).zip(meshes()) {
        let bytes = stream(100 + seed, 2000);
        let entropy = &mut Entropy::new(&bytes);
        let (bvh, boxes) = (Bvh::new(&mesh), boxes(&mesh));
        for _ in 0..20 {
            // Grid points, so that boxes touch exactly.
            let corner = |entropy: &mut Entropy<'_>| {
                DVec3::from_array([(); 3].map(|()| f64::from(entropy.below(17)) / 2.0))
            };
            let query = Box3::of([corner(entropy), corner(entropy)]);
            let meeting = |t: &TriId| boxes[t.index()].meets(&query);
            let expected: Vec<TriId> = (0..boxes.len()).map(TriId::from_index).filter(meeting).collect();
            assert_eq!(bvh.boxes_meeting(&query), expected);
            let touching = |t: &TriId| {
                let corners = mesh.corners(*t).map(|p| p.to_array());
                !clip_to_box(&corners, query.min.to_array(), query.max.to_array()).is_empty()
            };
            let (inside, outside): (Vec<_>, Vec<_>) = expected.into_iter().partition(touching);
            assert_eq!(bvh.triangles_meeting(&query), inside);
            passing_by += outside.len();
        }
        assert!(bvh.boxes_meeting(&Box3::EMPTY).is_empty());
    }
    assert!(passing_by > 20, "{passing_by}");
}

#[test]
fn a_refitted_tree_answers_like_a_new_one() {
    for mesh in meshes() {
        let mut tree = Bvh::new(&mesh).into_tree();
        for step in 1..4 {
            let bent = mapped(&mesh, |p| {
                let turn = f64::from(step) * p.z;
                DVec3::new(
                    p.x * turn.cos() - p.y * turn.sin(),
                    p.x * turn.sin() + p.y * turn.cos(),
                    1e3 + p.z,
                )
            });
            let refitted = Bvh::refitted(tree, &bent).unwrap();
            let rebuilt = Bvh::new(&bent);
            assert_eq!(refitted.self_pairs(&Monitor::none()), rebuilt.self_pairs(&Monitor::none()));
            for k in 0..20 {
                let query = DVec3::new(f64::from(k) * 0.4, 3.0 - f64::from(k) * 0.3, 1e3 + f64::from(k));
                assert_eq!(refitted.closest_point(query), rebuilt.closest_point(query));
                assert_eq!(refitted.ray_hits(query, DVec3::NEG_ONE), rebuilt.ray_hits(query, DVec3::NEG_ONE));
            }
            tree = refitted.into_tree();
        }
    }
    let (one, none) =
        (mesh_of(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]]), mesh_of(vec![], vec![]));
    let refused = Bvh::refitted(Bvh::new(&one).into_tree(), &none).map(|_| ());
    assert_eq!(refused, Err(RefitError { boxes: 1, triangles: 0 }));
}

#[test]
fn regular_strips_and_equal_boxes_do_not_take_forever() {
    // All distances between neighbours tie.
    let strip: Vec<Box3> = (0..20_000)
        .map(|i| Box3 { min: DVec3::X * f64::from(i), max: DVec3::X * f64::from(i) + DVec3::ONE })
        .collect();
    let pairs = BoxTree::new(&strip).self_pairs(&strip, &Monitor::none()).unwrap();
    assert_eq!(pairs.len(), strip.len() - 1);
    let equal = vec![Box3::of([DVec3::ONE]); 100_000];
    assert!(BoxTree::new(&equal).meeting(&equal, &Box3::of([DVec3::ZERO])).is_empty());
    assert_eq!(BoxTree::new(&equal).meeting(&equal, &Box3::of([DVec3::ZERO, DVec3::ONE])).len(), equal.len());
}

#[test]
fn the_tree_is_the_same_for_any_number_of_threads() {
    // More boxes than those from which the build goes parallel.
    let side: u32 = 330;
    let boxes: Vec<Box3> = (0..side * side)
        .map(|i| {
            let [x, y] = [i % side, i / side].map(f64::from);
            Box3::of([DVec3::new(x, y, (x * y * 0.01).sin()), DVec3::new(x + 1.5, y + 1.25, 1.0)])
        })
        .collect();
    let moved: Vec<Box3> = boxes.iter().map(|b| Box3 { min: b.min * 2.0, max: b.max * 2.0 }).collect();
    let answers = |threads| {
        on_threads(threads, || {
            let mut tree = BoxTree::new(&boxes);
            let built = tree.clone();
            tree.refit(&moved);
            let pairs = tree.self_pairs(&moved, &Monitor::none()).unwrap();
            (built, tree, pairs)
        })
    };
    let one = answers(1);
    for threads in [2, 5] {
        assert!(answers(threads) == one, "{threads} threads");
    }
}
