//! Named curves: those of [Gagniere22] 3.10.1, and those where something is on the verge.

use std::f64::consts::TAU;

use super::{check, curves, meshed, strip};

fn square(x: f64, y: f64, side: f64) -> Vec<[f64; 2]> {
    vec![[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
}

fn hole(x: f64, y: f64, side: f64) -> Vec<[f64; 2]> {
    let mut points = square(x, y, side);
    points.reverse();
    points
}

fn arc(centre: [f64; 2], radius: f64, from: f64, to: f64, steps: usize) -> Vec<[f64; 2]> {
    let at = |k: usize| from + (to - from) * k as f64 / steps as f64;
    let point = |a: f64| [centre[0] + radius * a.cos(), centre[1] + radius * a.sin()];
    (0..=steps).map(|k| point(TAU * at(k))).collect()
}

#[test]
fn single_overlap() {
    // A bar bent round so that its ends lie over each other (Fig. 3.23).
    let mut path = arc([0.0, 0.0], 2.0, 0.0, 0.75, 40);
    path.extend((1..=20).map(|k| [f64::from(k) * 0.2, -2.0 + f64::from(k) * 0.15]));
    let bar = curves(&[strip(&path, 0.8)]);
    let area = meshed(&bar, 0.1).unwrap();
    check(&bar, &area);
    assert_eq!(area.mesh.components().1, [1]);
    assert_eq!(area.windings.iter().max(), Some(&2));
}

#[test]
fn ribbon() {
    // One end passes through the other and divides it (Fig. 3.24).
    let mut path = vec![[-4.0, -4.0], [-1.0, -1.0]];
    path.extend(arc([1.5, 0.0], 1.5, -0.35, 0.35, 30));
    path.extend([[-1.0, 1.0], [-4.0, 4.0]]);
    let path: Vec<[f64; 2]> = path.iter().map(|p| [p[0], -p[1]]).chain([]).collect();
    let crossing: Vec<[f64; 2]> =
        arc([2.0, 0.0], 2.0, -0.40, 0.40, 40).into_iter().map(|p| [p[0], p[1]]).collect();
    let mut loopy = vec![[-3.0, 3.0], [-1.5, 1.5]];
    loopy.extend(crossing);
    loopy.extend([[-1.5, -1.5], [-3.0, -3.0]]);
    for path in [path, loopy] {
        let ribbon = curves(&[strip(&path, 0.5)]);
        let area = meshed(&ribbon, 0.08).unwrap();
        check(&ribbon, &area);
        assert_eq!(area.mesh.components().1, [1]);
    }
}

#[test]
fn ribbon_through_itself() {
    let path: Vec<[f64; 2]> = (0..=80)
        .map(|k| {
            let t = -2.0 + 4.0 * f64::from(k) / 80.0;
            [t * t * t - 2.0 * t, 3.0 - t * t]
        })
        .collect();
    let ribbon = curves(&[strip(&path, 0.5)]);
    let area = meshed(&ribbon, 0.1).unwrap();
    check(&ribbon, &area);
    assert_eq!(area.mesh.components().1, [1]);
    assert_eq!(area.windings.iter().max(), Some(&2));
    let deep = area.windings.iter().filter(|&&w| w == 2).count();
    assert_eq!(deep, 1);
}

/// A face with two eyes and a mouth whose lips overlap: where they do, the mouth's curve runs the other way round.
fn face() -> Vec<Vec<[f64; 2]>> {
    let head = arc([0.0, 0.0], 4.0, 0.0, 1.0, 60)[..60].to_vec();
    let eye = |x: f64| {
        let mut eye = arc([x, 1.5], 0.6, 0.0, 1.0, 16)[..16].to_vec();
        eye.reverse();
        eye
    };
    // Clockwise at both ends, counterclockwise between: a hole, an overlap, a hole.
    let mouth: Vec<[f64; 2]> = (0..60)
        .map(|k| {
            let a = TAU * f64::from(k) / 60.0;
            [2.4 * a.cos(), -1.5 - 1.2 * a.sin() * (0.25 - (1.0 - a.cos().abs()).powi(2))]
        })
        .collect();
    vec![head, eye(-1.5), eye(1.5), mouth]
}

#[test]
fn face_with_overlapping_lips() {
    let face = curves(&face());
    assert_eq!(face.turning(3), [-1, -1]);
    let area = meshed(&face, 0.1).unwrap();
    check(&face, &area);
    assert_eq!(area.mesh.components().1, [-2]);
    assert_eq!(area.windings.iter().max(), Some(&2));
}

#[test]
fn curve_on_grid_lines() {
    let on_lines = curves(&[square(0.0, 0.0, 4.0), square(2.0, 2.0, 4.0), hole(1.0, 1.0, 1.0)]);
    let area = meshed(&on_lines, 0.5).unwrap();
    check(&on_lines, &area);
    let mut characteristics = area.mesh.components().1;
    characteristics.sort_unstable();
    assert_eq!(characteristics, [0, 1]);
}

#[test]
fn coincident_loops() {
    let coincident = curves(&[square(0.0, 0.0, 2.0), square(0.0, 0.0, 2.0), square(0.0, 0.0, 2.0)]);
    for spacing in [0.5, 0.3] {
        let area = meshed(&coincident, spacing).unwrap();
        check(&coincident, &area);
        assert_eq!(area.mesh.components().1, [1; 3]);
        assert_eq!(area.mesh.len() % 3, 0);
    }
}

#[test]
fn bodies_that_touch_stay_apart() {
    let touching = curves(&[square(0.0, 0.0, 2.0), square(2.0, 0.0, 2.0), square(4.0, 2.0, 1.0)]);
    let area = meshed(&touching, 0.5).unwrap();
    check(&touching, &area);
    assert_eq!(area.mesh.components().1, [1; 3]);
    // They overlap by nothing: between their crossings there is no node.
    let deep = |r: &&u32| **r != u32::MAX && area.windings[**r as usize] > 1;
    assert_eq!(area.regions.iter().filter(deep).count(), 0);
}

#[test]
fn nested_loops() {
    let nested: Vec<_> =
        (0..5).map(|k| square(f64::from(k), f64::from(k), 11.0 - 2.0 * f64::from(k))).collect();
    let nested = curves(&nested);
    let area = meshed(&nested, 0.4).unwrap();
    check(&nested, &area);
    assert_eq!(area.mesh.components().1, [1; 5]);
    assert_eq!(area.windings.iter().max(), Some(&5));
    assert!(!area.ambiguous);
}

#[test]
fn island_in_a_hole() {
    let island = curves(&[square(0.0, 0.0, 8.0), hole(1.0, 1.0, 6.0), square(3.0, 3.0, 2.0)]);
    let area = meshed(&island, 0.25).unwrap();
    check(&island, &area);
    assert_eq!(area.mesh.components().1, [0, 1]);
}

#[test]
fn a_hole_in_a_body_within_a_body_is_ambiguous() {
    let hollow = curves(&[square(0.0, 0.0, 9.0), square(1.0, 1.0, 7.0), hole(3.0, 3.0, 3.0)]);
    let area = meshed(&hollow, 0.5).unwrap();
    check(&hollow, &area);
    assert!(area.ambiguous);
}

#[test]
fn spiral() {
    // Two turns of a strip wider than its pitch: each turn lies over the one before.
    let path: Vec<[f64; 2]> = (0..=160)
        .map(|k| {
            let (a, r) = (TAU * f64::from(k) / 64.0, 1.5 + 0.012 * f64::from(k));
            [r * a.cos(), r * a.sin()]
        })
        .collect();
    let spiral = curves(&[strip(&path, 1.8)]);
    let area = meshed(&spiral, 0.07).unwrap();
    check(&spiral, &area);
    assert_eq!(area.mesh.components().1, [1]);
    assert_eq!(area.windings.iter().max(), Some(&3));
}

#[test]
fn features_finer_than_cells_are_found_by_refinement() {
    // A hole smaller than a cell is seen by the turning numbers.
    let pierced = curves(&[square(0.0, 0.0, 4.0), hole(1.3, 1.3, 0.3)]);
    let area = meshed(&pierced, 1.0).unwrap();
    check(&pierced, &area);
    assert!(area.refinements > 0);
    assert_eq!(area.mesh.components().1, [0]);
}
