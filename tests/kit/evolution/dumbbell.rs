//! The generating line of a dumbbell: [`DumbbellProfile`].

use glam::DVec2;
use std::f64::consts::PI;

/// Two balls and a round handle between their centres, with or without fillets.
///
/// Its default is the dumbbell of \[Brochu12, section 3.3.2\]. The text names \[Sethian99\] and no sizes; these are those of
/// the example of this flow in the toolbox of level set methods \[Mitchell08\] that the text compares with: its box of 2 x 1 x 1, its grid of
/// 100 x 50 x 50, and its end at 0.025 agree, and the handle parts when the figure there shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DumbbellProfile {
    /// Of the balls.
    pub radius: f64,
    /// Of the balls' centres from the middle, along the axis.
    pub offset: f64,
    /// Of the handle.
    pub neck_radius: f64,
    /// Of the fillets that touch ball and handle; 0 for a sharp ridge there.
    pub fillet_radius: f64,
}

impl Default for DumbbellProfile {
    fn default() -> Self {
        Self { radius: 0.3, offset: 0.5, neck_radius: 0.2, fillet_radius: 0.0 }
    }
}

impl DumbbellProfile {
    /// `count + 1` points from the middle of the handle to the pole, at equal distances along the line, in the half plane
    /// (height, distance from the axis).
    #[must_use]
    pub fn half_line(&self, count: usize) -> Vec<DVec2> {
        let &Self { radius, offset, neck_radius, fillet_radius } = self;
        let across = neck_radius + fillet_radius;
        let reach = radius + fillet_radius;
        let down = (reach * reach - across * across).sqrt();
        let neck = offset - down;
        // The angle at the ball's centre between the axis toward the middle and the fillet's centre.
        let angle = across.atan2(down);
        let lengths = [neck, fillet_radius * (0.5 * PI - angle), radius * (PI - angle)];
        let total: f64 = lengths.iter().sum();
        let at = |s: f64| {
            if s <= lengths[0] {
                return DVec2::new(s, neck_radius);
            }
            let s = s - lengths[0];
            if s < lengths[1] {
                let turned = s / fillet_radius;
                return DVec2::new(neck, across) + fillet_radius * DVec2::new(turned.sin(), -turned.cos());
            }
            let turned = (s - lengths[1]) / radius + angle;
            DVec2::new(offset - radius * turned.cos(), radius * turned.sin().max(0.0))
        };
        let mut line: Vec<DVec2> = (0..count).map(|i| at(total * i as f64 / count as f64)).collect();
        line.push(DVec2::new(offset + radius, 0.0));
        line
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_at_equal_distances_on_the_dumbbell() {
        for fillet_radius in [0.0, 0.1] {
            let dumbbell = DumbbellProfile { fillet_radius, ..DumbbellProfile::default() };
            let line = dumbbell.half_line(2000);
            let steps: Vec<f64> = line.windows(2).map(|w| w[0].distance(w[1])).collect();
            let total: f64 = steps.iter().sum();
            // All but the one over the ridge, if there is no fillet.
            let uneven = steps.iter().filter(|&step| (step - total / 2000.0).abs() > 1e-6).count();
            assert!(uneven <= usize::from(fillet_radius == 0.0), "{uneven}");
            for p in line {
                let ball = (p - DVec2::new(dumbbell.offset, 0.0)).length() - dumbbell.radius;
                let nearest = if p.x > 0.3 { ball } else { ball.min(p.y - dumbbell.neck_radius) };
                let in_fillet = fillet_radius > 0.0 && p.x < 0.4;
                assert!(in_fillet || nearest.abs() < 1e-12 || (p.y - 0.2).abs() < 1e-12, "{p} {nearest}");
            }
        }
    }
}
