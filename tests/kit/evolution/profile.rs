//! Surfaces of revolution by the line that generates them: [`Profile`].
//!
//! The nearest point of such a surface lies in the half plane of the point in question, so distances are those in the half
//! plane (height along the axis, distance from the axis).

use glam::{DVec2, DVec3};

/// A part of a generating line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Piece {
    /// A segment.
    Segment(DVec2, DVec2),
    /// A part of a circle, counterclockwise from one direction to the other, by less than a full turn.
    Arc {
        /// The centre.
        center: DVec2,
        /// The radius.
        radius: f64,
        /// The direction of the first end, in radians.
        from: f64,
        /// The direction of the last end, above `from`.
        to: f64,
    },
}

/// A generating line that runs from the axis to the axis, with the inside to its left or right.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Its parts; together they and the axis enclose the inside.
    pub pieces: Vec<Piece>,
}

/// A place in the half plane of a surface of revolution about a unit axis through the origin.
#[must_use]
pub fn half_plane(place: DVec3, axis: DVec3) -> DVec2 {
    DVec2::new(place.dot(axis), place.cross(axis).length())
}

impl Piece {
    /// The distance of a place.
    #[must_use]
    pub fn distance(&self, place: DVec2) -> f64 {
        match *self {
            Piece::Segment(a, b) => {
                let along = b - a;
                let square = along.length_squared();
                let t = if square > 0.0 { ((place - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
                (a + t * along).distance(place)
            }
            Piece::Arc { center, radius, from, to } => {
                let seen = place - center;
                let turn = (seen.to_angle() - from).rem_euclid(std::f64::consts::TAU);
                if turn <= to - from {
                    return (seen.length() - radius).abs();
                }
                let end = |angle: f64| (center + radius * DVec2::from_angle(angle)).distance(place);
                end(from).min(end(to))
            }
        }
    }
}

impl Profile {
    /// The distance of a place in the half plane.
    #[must_use]
    pub fn distance(&self, place: DVec2) -> f64 {
        self.pieces.iter().map(|piece| piece.distance(place)).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn distances_of_pieces() {
        let arc = Piece::Arc { center: DVec2::X, radius: 2.0, from: FRAC_PI_2, to: PI };
        assert!((arc.distance(DVec2::new(0.0, 1.0)) - (2.0 - 2f64.sqrt())).abs() < 1e-15);
        assert!((arc.distance(DVec2::new(3.0, 2.0)) - 2.0).abs() < 1e-15);
        assert!((arc.distance(DVec2::new(-1.0, -1.0)) - 1.0).abs() < 1e-15);
        let segment = Piece::Segment(DVec2::ZERO, DVec2::X);
        assert_eq!(segment.distance(DVec2::new(0.5, 2.0)), 2.0);
        assert_eq!(segment.distance(DVec2::new(4.0, 4.0)), 5.0);
        assert_eq!(half_plane(DVec3::new(3.0, 4.0, 5.0), DVec3::Z), DVec2::new(5.0, 5.0));
    }
}
