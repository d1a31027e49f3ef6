//! The 256 cases of a cell, each by itself and beside every neighbour it can have.

use std::collections::BTreeMap;

use glam::DVec3;
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::Monitor;
use welter_meshing::isosurface::CellPoint::{Corner, Edge};
use welter_meshing::isosurface::{CellCase, CellPoint};
use welter_meshing::spatial::{Winding, WindingNumbers};
use welter_meshing::surface::{ClosedOrientedMesh, EmbeddedMesh, TriMesh, TriangleSoup};
use welter_predicates::{Sign, orient3d};

fn cases() -> impl Iterator<Item = CellCase> {
    (0..=255).map(CellCase)
}

fn corner(c: u8) -> DVec3 {
    DVec3::new(f64::from(c & 1), f64::from(c >> 1 & 1), f64::from(c >> 2 & 1))
}

/// Samples at `at[e]` of edge `e`, measured from its lower end.
fn place(point: CellPoint, at: &[f64; 12]) -> DVec3 {
    let [low, high] = point.ends().map(corner);
    match point {
        Corner(_) => low,
        Edge(e) => low + at[usize::from(e)] * (high - low),
    }
}

/// The directed edges of polygons that are not cancelled by their reverse.
fn boundary<P: Copy + Ord>(polygons: impl IntoIterator<Item = Vec<P>>) -> BTreeMap<[P; 2], i32> {
    let mut edges = BTreeMap::new();
    for polygon in polygons {
        for i in 0..polygon.len() {
            let [a, b] = [polygon[i], polygon[(i + 1) % polygon.len()]];
            *edges.entry([a.min(b), a.max(b)]).or_insert(0) += if a < b { 1 } else { -1 };
        }
    }
    edges.retain(|_, &mut sum| sum != 0);
    edges
}

fn triangles(case: CellCase) -> Vec<Vec<CellPoint>> {
    case.triangles().map(|t| t.to_vec()).collect()
}

fn face_polygons(case: CellCase) -> Vec<Vec<CellPoint>> {
    (0..6).map(|f| case.face_polygon(f).to_vec()).filter(|p| !p.is_empty()).collect()
}

/// Places of samples: middles, then drawn ones near to and far from the ends, all dyadic so that nothing is rounded.
fn placings(seed: u64) -> impl Iterator<Item = [f64; 12]> {
    let drawn = stream(seed, 6 * 12 * 2);
    let mut entropy = Entropy::new(&drawn);
    let mut placings = vec![[0.5; 12]];
    for _ in 0..6 {
        placings.push(std::array::from_fn(|_| {
            let near = entropy.pick(&[1.0 / 1024.0, 0.25, 1.0 / 65536.0, 0.375]);
            if entropy.byte() < 128 { near } else { 1.0 - near }
        }));
    }
    placings.into_iter()
}

#[test]
fn with_the_polygons_of_its_faces_every_case_is_a_closed_polyhedron() {
    for case in cases() {
        let polygons = triangles(case).into_iter().chain(face_polygons(case));
        assert_eq!(boundary(polygons), BTreeMap::new(), "{case:?}");
        let separates = |t: [CellPoint; 3]| t.iter().all(|p| matches!(p, Edge(_)));
        assert!(case.triangles().all(separates), "{case:?}");
        assert_eq!(case.triangles().len() > 0, case.is_mixed(), "{case:?}");
    }
}

#[test]
fn neighbours_agree_on_the_face_they_share() {
    let mut pairs = 0;
    for axis in 0..3 {
        let shift = |point: CellPoint| match point {
            Corner(c) => Corner(c & !(1 << axis)),
            Edge(_) => {
                let [a, b] = point.ends().map(|c| c & !(1 << axis));
                (0..12).map(Edge).find(|e| e.ends() == [a, b]).expect("an edge of the lower face")
            }
        };
        let on_upper = |p: CellPoint| p.ends().iter().all(|c| c >> axis & 1 == 1);
        let on_lower = |p: CellPoint| p.ends().iter().all(|c| c >> axis & 1 == 0);
        for (a, b) in cases().flat_map(|a| cases().map(move |b| (a, b))) {
            let lower =
                |case: CellCase| (0..8).filter(|c| c >> axis & 1 == 0).map(move |c| case.is_negative(c));
            let upper =
                |case: CellCase| (0..8).filter(|c| c >> axis & 1 == 1).map(move |c| case.is_negative(c));
            if !upper(a).eq(lower(b)) {
                continue;
            }
            pairs += 1;
            // Volume: the same polygon from both sides, the other way round.
            let ours: Vec<_> = a.face_polygon(2 * axis + 1).iter().map(|&p| shift(p)).collect();
            let theirs = b.face_polygon(2 * axis).to_vec();
            assert_eq!(boundary([ours.clone(), theirs.clone()]), BTreeMap::new(), "{a:?} {b:?}");
            assert_eq!(ours.len(), theirs.len());
            // Surface: its segments on the face are the same, the other way round.
            let segments = |case, on: &dyn Fn(CellPoint) -> bool| {
                let mut edges = boundary(triangles(case));
                edges.retain(|&[p, q], _| on(p) && on(q));
                edges
            };
            let mut sum = segments(b, &on_lower);
            for ([p, q], n) in segments(a, &on_upper) {
                let ([p, q], n) =
                    if shift(p) < shift(q) { ([shift(p), shift(q)], n) } else { ([shift(q), shift(p)], -n) };
                *sum.entry([p, q]).or_insert(0) += n;
            }
            assert!(sum.values().all(|&n| n == 0), "{a:?} {b:?}");
        }
    }
    assert_eq!(pairs, 3 * 16 * 16 * 16);
}

#[test]
fn tetrahedra_never_invert() {
    // The volume is affine in each sample's place: over all places it is least with every sample at an end.
    for case in cases() {
        for tetrahedron in case.tetrahedra() {
            let mut solid = false;
            for choice in 0..16_usize {
                let mut bit = 0;
                let [a, b, c, d] = tetrahedron.map(|p| {
                    bit += 1;
                    corner(p.ends()[choice >> (bit - 1) & 1])
                });
                let volume = (b - a).cross(c - a).dot(d - a);
                assert!(volume >= 0.0, "{case:?} {tetrahedron:?}");
                solid |= volume > 0.0;
            }
            assert!(solid, "{case:?} {tetrahedron:?}");
        }
    }
}

#[test]
fn tetrahedra_share_whole_faces_and_end_at_the_polyhedron() {
    for case in cases() {
        let mut faces: BTreeMap<[CellPoint; 3], i32> = BTreeMap::new();
        for [a, b, c, d] in case.tetrahedra() {
            for face in [[b, c, d], [a, d, c], [a, b, d], [a, c, b]] {
                let mut sorted = face;
                sorted.sort_unstable();
                let is_even = (0..3).any(|r| [0, 1, 2].map(|i| face[(i + r) % 3]) == sorted);
                *faces.entry(sorted).or_insert(0) += if is_even { 1 } else { -1 };
            }
        }
        assert!(faces.values().all(|n| n.abs() <= 1), "{case:?}");
        // What is left is the surface, triangle by triangle, and triangles that lie on faces of the cell and make up their polygons.
        for triangle in case.triangles() {
            let mut sorted = triangle;
            sorted.sort_unstable();
            assert!(faces.remove(&sorted).is_some_and(|n| n != 0), "{case:?} {triangle:?}");
        }
        faces.retain(|_, n| *n != 0);
        let on_a_face = |t: &[CellPoint; 3]| {
            (0..3).any(|axis| {
                let mut sides = t.iter().flat_map(|p| p.ends()).map(|c| c >> axis & 1);
                let first = sides.next().expect("three points");
                sides.all(|side| side == first)
            })
        };
        assert!(faces.keys().all(on_a_face), "{case:?}");
        let corners: usize = face_polygons(case).iter().map(|p| p.len() - 2).sum();
        assert_eq!(faces.len(), corners, "{case:?}");
    }
}

/// The polyhedron of a case, its faces cut into fans.
fn polyhedron(case: CellCase, at: &[f64; 12]) -> ClosedOrientedMesh {
    let mut points: Vec<CellPoint> = (0..8).map(Corner).chain((0..12).map(Edge)).collect();
    let index = |p: CellPoint| points.iter().position(|&q| q == p).expect("a point of the cell") as u32;
    let mut soup = TriangleSoup::default();
    for polygon in triangles(case).into_iter().chain(face_polygons(case)) {
        let ids: Vec<u32> = polygon.iter().map(|&p| index(p)).collect();
        soup.triangles.extend((2..ids.len()).map(|i| [ids[0], ids[i - 1], ids[i]]));
    }
    soup.positions = points.drain(..).map(|p| place(p, at)).collect();
    ClosedOrientedMesh::new(TriMesh::new(soup).expect("a valid mesh")).expect("closed")
}

#[test]
fn wherever_samples_are_the_polyhedron_is_embedded_and_the_tetrahedra_tile_it() {
    for case in cases().filter(|case| case.0 != 0) {
        for at in placings(u64::from(case.0)) {
            let polyhedron = polyhedron(case, &at);
            assert_eq!(EmbeddedMesh::check(&polyhedron, &Monitor::none()), Ok(()), "{case:?} {at:?}");
            let solids: Vec<[DVec3; 4]> = case.tetrahedra().map(|t| t.map(|p| place(p, &at))).collect();
            let numbers = WindingNumbers::new(&polyhedron);
            // Points inside of each tetrahedron are in no other, and in the polyhedron; others are in none and outside.
            let drawn = stream(u64::from(case.0) + 1000, 3 * 12);
            let mut entropy = Entropy::new(&drawn);
            let centers = solids.iter().map(|&[a, b, c, d]| 0.25 * (a + b + c + d));
            let scattered = (0..12).map(|_| {
                DVec3::new(f64::from(entropy.byte()), f64::from(entropy.byte()), f64::from(entropy.byte()))
                    / 256.0
            });
            for point in centers.chain(scattered) {
                let (inside, touching) = containing(&solids, point);
                assert!(inside <= 1, "{case:?} {at:?} {point}");
                match numbers.at(point) {
                    Winding::Number(number) => {
                        assert_eq!(number != 0, inside + touching > 0, "{case:?} {at:?} {point}")
                    }
                    Winding::OnSurface { .. } => {
                        assert!(inside == 0 && touching > 0, "{case:?} {at:?} {point}")
                    }
                    Winding::NotFinite => unreachable!("finite points"),
                }
            }
        }
    }
}

/// In how many tetrahedra a point lies inside, and on the boundary of how many.
fn containing(solids: &[[DVec3; 4]], point: DVec3) -> (usize, usize) {
    let signs = solids.iter().map(|&[a, b, c, d]| {
        let parts = [[point, b, c, d], [a, point, c, d], [a, b, point, d], [a, b, c, point]];
        parts.map(|[p, q, r, s]| orient3d(p, q, r, s) * orient3d(a, b, c, d))
    });
    let mut counts = (0, 0);
    for signs in signs {
        if signs.iter().all(|&s| s == Sign::Positive) {
            counts.0 += 1;
        } else if signs.iter().all(|&s| s != Sign::Negative) {
            counts.1 += 1;
        }
    }
    counts
}

#[test]
fn volumes_of_tetrahedra_add_up() {
    for case in cases() {
        for at in placings(7 * u64::from(case.0)) {
            let tetrahedra: f64 = case
                .tetrahedra()
                .map(|t| t.map(|p| place(p, &at)))
                .map(|[a, b, c, d]| (b - a).cross(c - a).dot(d - a) / 6.0)
                .sum();
            let whole = if case.0 == 0 {
                0.0
            } else {
                welter_meshing::surface::measure::signed_volume(&polyhedron(case, &at))
            };
            assert!((tetrahedra - whole).abs() < 1e-14, "{case:?} {tetrahedra} {whole}");
        }
    }
}

#[test]
fn the_complement_has_the_same_rim_just_where_no_face_is_ambiguous() {
    let ambiguous = |case: CellCase| (0..6).any(|f| case.face_polygon(f).len() == 6);
    let (mut with, mut same_triangles) = (0, 0);
    for case in cases().filter(|case| case.is_mixed()) {
        let complement = CellCase(!case.0);
        let reversed = |t: Vec<CellPoint>| t.into_iter().rev().collect::<Vec<_>>();
        let rim = boundary(triangles(case));
        let other = boundary(triangles(complement).into_iter().map(reversed));
        assert_eq!(rim == other, !ambiguous(case), "{case:?}");
        with += usize::from(ambiguous(case));
        let canonical = |t: Vec<CellPoint>| (0..3).map(|r| [t[r], t[(r + 1) % 3], t[(r + 2) % 3]]).min();
        let mut ours: Vec<_> = triangles(case).into_iter().map(canonical).collect();
        let mut theirs: Vec<_> = triangles(complement).into_iter().map(reversed).map(canonical).collect();
        ours.sort_unstable();
        theirs.sort_unstable();
        same_triangles += usize::from(ours == theirs);
    }
    assert_eq!(with, 120);
    assert_eq!(same_triangles, 36);
}
