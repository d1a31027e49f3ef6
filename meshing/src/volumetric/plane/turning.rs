//! How often a closed polyline turns around: [`turning`].
//!
//! # Method
//! The direction of the polyline turns by less than half a turn at each corner, to the side that an exact orientation tells. Each
//! time that it passes the direction of the x-axis is counted. Complexity: O(n).

use welter_predicates::{Sign, orient2d};

use crate::DVec2;

/// The least and the largest turning number of a closed polyline: where it turns back on itself the turn may be to either side. A polyline
/// of one point may turn once to either side.
pub(super) fn turning(points: &[DVec2]) -> [i64; 2] {
    let mut corners: Vec<DVec2> = Vec::with_capacity(points.len());
    for &p in points {
        if corners.last() != Some(&p) {
            corners.push(p);
        }
    }
    while corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    if corners.len() < 2 {
        return [-1, 1];
    }
    let n = corners.len();
    let mut count = [0, 0];
    for k in 0..n {
        let [a, b, c] = [k, k + 1, k + 2].map(|k| corners[k % n]);
        let [before, after] = [upward(a, b), upward(b, c)];
        let side = orient2d(a, b, c);
        // Straight on, or back: then the half-planes differ, since the directions are opposite.
        let sides = match side {
            Sign::Zero if before == after => continue,
            Sign::Zero => [Sign::Negative, Sign::Positive],
            side => [side; 2],
        };
        for (count, side) in count.iter_mut().zip(sides) {
            *count += match (side, before, after) {
                (Sign::Positive, false, true) => 1,
                (Sign::Negative, true, false) => -1,
                _ => 0,
            };
        }
    }
    count
}

/// Whether the angle of a direction from the x-axis is at least 0 and less than half a turn.
fn upward(a: DVec2, b: DVec2) -> bool {
    b.y > a.y || b.y == a.y && b.x > a.x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(points: &[[f64; 2]]) -> [i64; 2] {
        turning(&points.iter().copied().map(DVec2::from_array).collect::<Vec<_>>())
    }

    #[test]
    fn turns_are_counted() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(of(&square), [1, 1]);
        let mut reversed = square;
        reversed.reverse();
        assert_eq!(of(&reversed), [-1, -1]);
        assert_eq!(of(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), [0, 0]);
        let pentagram = [[0.0, 3.0], [-2.0, -3.0], [3.0, 1.0], [-3.0, 1.0], [2.0, -3.0]];
        assert_eq!(of(&pentagram), [2, 2]);
    }

    #[test]
    fn turning_back_is_open_to_both_sides() {
        assert_eq!(of(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), [-1, 1]);
        assert_eq!(of(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, 2.0], [1.0, 1.0], [0.0, 1.0]]), [0, 1]);
        assert_eq!(of(&[[0.5, 0.5]; 3]), [-1, 1]);
    }
}
