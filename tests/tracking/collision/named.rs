//! Named cases.

use super::pairs::{Pair, Query};
use welter_tracking::collision::CollisionError;

const WIDTH: f64 = 1.0 / (1u64 << 40) as f64;

/// The first contact is at `time`; gives the normal and the weights.
fn first_contact(pair: Pair, query: Query, time: f64) -> (Vec<f64>, Vec<f64>) {
    for width in [WIDTH, 0.0, 0.5] {
        let impact = pair.impact(&query, width).unwrap().unwrap();
        let [lo, hi] = impact.time;
        assert!(lo < time && time <= hi, "{lo} {hi} {time}");
        assert!(hi - lo <= width || hi == lo.next_up(), "{lo} {hi}");
    }
    let impact = pair.impact(&query, WIDTH).unwrap().unwrap();
    (impact.normal, impact.weights)
}

fn near(a: &[f64], b: &[f64]) {
    assert!(a.len() == b.len() && a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-9), "{a:?} {b:?}");
}

#[test]
fn vertex_face_swings_through_twice() {
    let t0 = [[-1.0, 0.0, -0.25], [-4.0, -4.0, -4.0], [4.0, -4.0, 4.0], [0.0, 4.0, 0.0]];
    let t1 = [[1.0, 0.0, -0.25], [-4.0, -4.0, 4.0], [4.0, -4.0, -4.0], [0.0, 4.0, 0.0]];
    let (normal, weights) = first_contact(Pair::VertexFace, [t0, t1], 0.25);
    near(&weights, &[1.0, 0.3125, 0.1875, 0.5]);
    // The face is the plane z = x / 2 then, met from below... of the moving vertex at (-1/2, 0, -1/4).
    let norm = 1.25f64.sqrt();
    near(&normal.iter().map(|x| x.abs()).collect::<Vec<_>>(), &[0.5 / norm, 0.0, 1.0 / norm]);
    // Reversed in time, the first contact is the last one.
    first_contact(Pair::VertexFace, [t1, t0], 0.25);
}

#[test]
fn vertex_face_tangential() {
    let t0 = [[-1.0, 0.0, 0.0], [-4.0, -4.0, -4.0], [4.0, -4.0, 4.0], [0.0, 4.0, 0.0]];
    let t1 = [[1.0, 0.0, 0.0], [-4.0, -4.0, 4.0], [4.0, -4.0, -4.0], [0.0, 4.0, 0.0]];
    let (normal, _) = first_contact(Pair::VertexFace, [t0, t1], 0.5);
    assert!(normal[2].abs() > 0.999, "{normal:?}");
}

#[test]
fn edge_edge_swings_through_twice() {
    let t0 = [[-4.0, 0.0, -4.0], [4.0, 0.0, 4.0], [-1.0, -1.0, -0.25], [-1.0, 1.0, -0.25]];
    let t1 = [[-4.0, 0.0, 4.0], [4.0, 0.0, -4.0], [1.0, -1.0, -0.25], [1.0, 1.0, -0.25]];
    let (_, weights) = first_contact(Pair::EdgeEdge, [t0, t1], 0.25);
    near(&weights, &[0.5625, 0.4375, 0.5, 0.5]);
}

#[test]
fn edge_edge_single_transversal_root() {
    let t0 = [[-2.0, -1.0, 1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [-2.0, 2.0, 1.0]];
    let t1 = [[2.0, -1.0, 0.0], [2.0, 0.0, 2.0], [2.0, -1.0, -2.0], [-1.0, 0.0, -1.0]];
    let [lo, hi] = Pair::EdgeEdge.impact(&[t0, t1], WIDTH).unwrap().unwrap().time;
    assert!(0.320_87 < lo && hi < 0.320_89, "{lo} {hi}");
}

#[test]
fn edge_edge_flat_patch_without_contact() {
    let t0 = [[-1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [0.0, 0.0, 0.25], [0.0, 1.0, 0.25]];
    let t1 = [[-1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 0.25], [0.0, 1.0, 0.25]];
    assert_eq!(Pair::EdgeEdge.impact(&[t0, t1], WIDTH), Ok(None));
}

#[test]
fn vertex_slides_into_a_face_in_its_plane() {
    let face = [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [0.0, 4.0, 1.0]];
    let step = |x0: f64, x1: f64| [x0, x1].map(|x| [[x, 1.0, 1.0], face[0], face[1], face[2]]);
    let (normal, weights) = first_contact(Pair::VertexFace, step(-1.0, 3.0), 0.25);
    near(&normal, &[-1.0, 0.0, 0.0]);
    near(&weights, &[1.0, 0.75, 0.0, 0.25]);
}

#[test]
fn vertex_meets_one_corner_of_a_face_in_its_plane() {
    let face = [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [0.0, 4.0, 1.0]];
    let step = [[-1.0, 1.0], [1.0, -1.0]].map(|[x, y]| [[x, y, 1.0], face[0], face[1], face[2]]);
    let (_, weights) = first_contact(Pair::VertexFace, step, 0.5);
    near(&weights, &[1.0, 1.0, 0.0, 0.0]);
}

#[test]
fn collinear_edges() {
    let t0 = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    let t1 = [[1.5, 0.0, 0.0], [2.5, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    let impact = Pair::EdgeEdge.impact(&[t0, t1], 0.0).unwrap().unwrap();
    // 2/3 is rounded down.
    assert_eq!(impact.time, [2.0 / 3.0, (2.0f64 / 3.0).next_up()]);
    assert_eq!((impact.normal, impact.weights), (vec![-1.0, 0.0, 0.0], vec![0.0, 1.0, 1.0, 0.0]));
}

#[test]
fn parallel_edges_come_together_across() {
    let e = |y: f64| [[0.0, y, 0.0], [2.0, y, 0.0], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    let (normal, weights) = first_contact(Pair::EdgeEdge, [e(3.0), e(-1.0)], 0.75);
    near(&normal, &[0.0, 1.0, 0.0]);
    // Some point of the common part.
    let x = 2.0 * weights[1];
    assert!((1.0..=2.0).contains(&x) && (x - (1.0 + 2.0 * weights[3])).abs() < 1e-9, "{weights:?}");
}

#[test]
fn static_overlap_is_a_contact_at_zero() {
    let touching = [[1.0, 1.0, 0.0], [0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let away = [[1.0, 1.0, 5.0], touching[1], touching[2], touching[3]];
    for t1 in [touching, away] {
        let impact = Pair::VertexFace.impact(&[touching, t1], WIDTH).unwrap().unwrap();
        assert_eq!((impact.time, impact.normal[2].abs()), ([0.0, 0.0], 1.0));
        assert_eq!(impact.weights, [1.0, 0.5, 0.25, 0.25]);
    }
    // All four vertices at one place, for ever.
    let p = [[3.0, 2.0, 1.0]; 4];
    for pair in [Pair::VertexFace, Pair::EdgeEdge, Pair::VertexSegment] {
        assert_eq!(pair.impact(&[p, p], WIDTH).unwrap().unwrap().time, [0.0, 0.0]);
        assert_eq!(pair.approach(&[p, p], 0.0).unwrap().unwrap().time, 0.0);
    }
    let crossing = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    let impact = Pair::EdgeEdge.impact(&[crossing, crossing], WIDTH).unwrap().unwrap();
    assert_eq!((impact.time, impact.weights), ([0.0, 0.0], vec![0.5; 4]));
}

#[test]
fn contact_at_the_very_end_and_just_after_the_beginning() {
    let face = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
    let v = |z: f64| [[0.0, 0.0, z], face[0], face[1], face[2]];
    first_contact(Pair::VertexFace, [v(1.0), v(0.0)], 1.0);
    assert_eq!(Pair::VertexFace.impact(&[v(1.0), v(f64::from_bits(1))], WIDTH), Ok(None));
    // First contact at 2^-600, about: nothing but adjacent numbers is that narrow.
    let tiny = 2f64.powi(-600);
    let [lo, hi] = Pair::VertexFace.impact(&[v(tiny), v(-1.0)], 0.0).unwrap().unwrap().time;
    assert!(hi == lo.next_up() && 0.5 * tiny < lo && hi < 2.0 * tiny, "{lo:e} {hi:e}");
}

#[test]
fn faces_without_area_and_edges_without_length() {
    // A face that is a segment across the path of the vertex, and one that is a point.
    let v = |z: f64, f: [[f64; 3]; 3]| [[0.0, 0.0, z], f[0], f[1], f[2]];
    let segment = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let (normal, _) = first_contact(Pair::VertexFace, [v(1.0, segment), v(-3.0, segment)], 0.25);
    near(&normal, &[0.0, 0.0, 1.0]);
    let (normal, _) = first_contact(Pair::VertexFace, [v(1.0, [[0.0; 3]; 3]), v(-3.0, [[0.0; 3]; 3])], 0.25);
    near(&normal, &[0.0, 0.0, 1.0]);
    let e = |z: f64| [[0.0, 0.0, z], [0.0, 0.0, z], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    let (normal, _) = first_contact(Pair::EdgeEdge, [e(1.0), e(-3.0)], 0.25);
    near(&normal, &[0.0, 0.0, 1.0]);
}

#[test]
fn what_is_not_finite_is_named() {
    let points = [[0.0, 0.0, 1.0], [-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]];
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut query = [points; 2];
        query[1][2][1] = bad;
        for (pair, name) in [(Pair::VertexFace, "f1"), (Pair::EdgeEdge, "eb0"), (Pair::VertexSegment, "s1")] {
            let errors = [pair.impact(&query, WIDTH).unwrap_err(), pair.approach(&query, 0.1).unwrap_err()];
            for error in errors {
                let CollisionError::NonFinite { time: 1, vertex, coordinate: 1, value } = error else {
                    panic!("{error}")
                };
                assert_eq!((vertex, value.to_bits()), (name, bad.to_bits()));
                assert!(error.to_string().contains(&format!("coordinate 1 of {name} at time 1")), "{error}");
            }
        }
    }
    for bad in [f64::NAN, f64::INFINITY, -1e-300, -1.0] {
        let error = Pair::EdgeEdge.approach(&[points; 2], bad).unwrap_err();
        assert!(matches!(error, CollisionError::Parameter { parameter: "distance", .. }), "{error}");
        let error = Pair::EdgeEdge.impact(&[points; 2], bad).unwrap_err();
        assert!(matches!(error, CollisionError::Parameter { parameter: "width", .. }), "{error}");
    }
}
