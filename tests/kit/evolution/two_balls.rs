//! Two balls that grow and shrink along their normals: [`two_balls`].
//!
//! The viscosity solution of motion along the normal by `d` outward is the set of points within `d` (dilation), inward by `d` the
//! set of points with no point outside within `d` (erosion). So outward by `grown` and then inward by `shrunk` is, for
//! balls of radius `r`, the erosion of the union of balls of radius `R = r + grown`. Its surface consists of parts of two spheres of radius
//! `R - shrunk` and, where the larger balls meet in a circle, of a part of the torus of radius `shrunk` around that circle.

use glam::{DVec2, DVec3};
use std::f64::consts::PI;

use super::profile::{Piece, Profile, half_plane};

/// Two equal balls with their centres on the x axis, symmetric to the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoBalls {
    /// Distance of the centres from the origin.
    pub offset: f64,
    /// Radius at the beginning.
    pub radius: f64,
}

impl Default for TwoBalls {
    /// Those of \[Brochu12, section 3.3.1\].
    fn default() -> Self {
        Self { offset: 0.25, radius: 0.2 }
    }
}

/// The signed distance, negative inside, from the surface of two balls after they moved outward by `grown` and then
/// inward by `shrunk`, neither below 0.
///
/// # Panics
/// If they shrink by so much that the neck between them parts, or the balls vanish.
pub fn two_balls(balls: TwoBalls, grown: f64, shrunk: f64) -> impl Fn(DVec3) -> f64 {
    let TwoBalls { offset, radius } = balls;
    let large = radius + grown;
    assert!(large > shrunk, "the balls vanish");
    let union = eroded(offset, large, 0.0);
    let surface = eroded(offset, large, shrunk);
    move |place| {
        let place = half_plane(place, DVec3::X);
        let inside_union = DVec2::new(place.x.abs() - offset, place.y).length() < large;
        let inside = inside_union && union.distance(place) > shrunk;
        if inside { -surface.distance(place) } else { surface.distance(place) }
    }
}

/// The erosion by `shrunk` of two balls of radius `large` at distance `offset` from the origin.
fn eroded(offset: f64, large: f64, shrunk: f64) -> Profile {
    let small = large - shrunk;
    let arc = |center: DVec2, radius: f64, from: f64, to: f64| Piece::Arc { center, radius, from, to };
    let (left, right) = (DVec2::new(-offset, 0.0), DVec2::new(offset, 0.0));
    if large <= offset {
        return Profile { pieces: vec![arc(left, small, 0.0, PI), arc(right, small, 0.0, PI)] };
    }
    // The circle in which the large balls meet.
    let circle = DVec2::new(0.0, (large * large - offset * offset).sqrt());
    assert!(circle.y > shrunk, "the neck parts");
    let angle = (circle - left).to_angle();
    let mut pieces = vec![arc(left, small, angle, PI), arc(right, small, 0.0, PI - angle)];
    if shrunk > 0.0 {
        // From the direction to the left centre, which is below, to that to the right one.
        pieces.push(arc(circle, shrunk, PI + angle, 2.0 * PI - angle));
    }
    Profile { pieces }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_distances() {
        let balls = TwoBalls::default();
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a}, not {b}");
        let before = two_balls(balls, 0.0, 0.0);
        close(before(DVec3::ZERO), 0.05);
        close(before(DVec3::new(0.25, 0.0, 0.0)), -0.2);
        let grown = two_balls(balls, 0.2, 0.0);
        let circle = (0.4_f64 * 0.4 - 0.25 * 0.25).sqrt();
        close(grown(DVec3::ZERO), -circle);
        close(grown(DVec3::new(0.0, 0.0, circle)), 0.0);
        close(grown(DVec3::new(0.0, 2.0, 0.0)), DVec2::new(0.25, 2.0).length() - 0.4);
        let after = two_balls(balls, 0.2, 0.2);
        close(after(DVec3::ZERO), -(circle - 0.2));
        close(after(DVec3::new(0.0, circle - 0.15, 0.0)), 0.05);
        close(after(DVec3::new(0.5, 0.0, 0.0)), 0.05);
    }

    /// Against a search on a grid of the plane, which makes both offsets by their definition.
    #[test]
    fn signs_are_those_of_dilation_and_erosion() {
        let (balls, grown, shrunk) = (TwoBalls::default(), 0.15, 0.11);
        let exact = two_balls(balls, grown, shrunk);
        let start = two_balls(balls, 0.0, 0.0);
        let step = 1.0 / 128.0;
        let nodes = |limit: i32| (-limit..=limit).flat_map(move |i| (-limit..=limit).map(move |j| (i, j)));
        let place = |(i, j): (i32, i32)| step * DVec3::new(f64::from(i), f64::from(j), 0.0);
        // Within `grown` of a ball is within `radius + grown` of its centre.
        let outside: Vec<DVec3> = nodes(100).map(place).filter(|&p| start(p) > grown).collect();
        let mut checked = [0; 2];
        for p in nodes(70).map(place) {
            let nearest = outside.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
            // The grid knows distances within its diagonal.
            if (nearest - shrunk).abs() > 2.0 * step {
                assert_eq!(exact(p) < 0.0, nearest > shrunk, "{p}");
                checked[usize::from(nearest > shrunk)] += 1;
            }
        }
        assert!(checked.iter().all(|&count| count > 1000), "{checked:?}");
    }
}
