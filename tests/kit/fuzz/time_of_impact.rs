//! Times of impact and first approaches against exact decisions and rational distances.

use crate::entropy::Entropy;
use crate::exact::moving::{self, Moving, rational};
use crate::generate::Kind;
use rug::Rational;
use welter_predicates::ccd;
use welter_tracking::collision::{
    MinimumSeparationParameters, TimeOfImpactParameters, minimum_separation, time_of_impact,
};

/// What both constructions answer about a pair of primitives drawn from the bytes, and the predicates on it.
struct Answers {
    moving: Moving,
    touches: bool,
    /// The bracket.
    impact: Option<[f64; 2]>,
    /// Contact in the bracket, and before it.
    during: [bool; 2],
    /// Time and bounds of the distance.
    approach: Option<(f64, [f64; 2])>,
}

macro_rules! answers {
    ($name:ident, $during:ident, $corners:ident, $t0:expr, $t1:expr, $width:expr, $distance:expr) => {{
        let (t0, t1) = ($t0, $t1);
        let impact = time_of_impact::$name(t0, t1, &TimeOfImpactParameters { width: $width });
        let parameters = MinimumSeparationParameters { distance: $distance, ..Default::default() };
        let approach = minimum_separation::$name(t0, t1, &parameters);
        let impact = impact.expect("finite").map(|i| i.time);
        let [lo, hi] = impact.unwrap_or_default();
        Answers {
            moving: Moving::new(&t0, &t1, moving::$corners),
            touches: ccd::$name(t0, t1),
            impact,
            during: [[lo, hi], [0.0, lo]].map(|part| impact.is_some() && ccd::$during(t0, t1, part)),
            approach: approach.expect("finite").map(|a| (a.time, a.distance)),
        }
    }};
}

/// Pairs of moving primitives drawn from the bytes.
pub fn time_of_impact(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    let width = entropy.pick(&[1.0 / (1u64 << 40) as f64, 1e-3, 1.0, 1e-15, 0.0]);
    let distance = entropy.pick(&[0.0, 1e-9, 0.1, 1.0, 4.0, 1e-300, 1e200]);
    // Exact decisions on wide exponents take milliseconds: one in eight, and then few of them.
    let wide = entropy.below(8) == 7;
    let kinds = [Kind::Grid, Kind::FlatGrid, Kind::Uniform, Kind::Dyadic, Kind::NearFlat, Kind::Scaled];
    let kind = entropy.pick(if wide { &Kind::ALL[..] } else { &kinds[..] });
    let width = if wide { width.max(1e-3) } else { width };
    let answers = match entropy.below(3) {
        0 => {
            let [a, b, c, d, e, f, g, h] = kind.draw::<3, 8>(&mut entropy);
            answers!(
                vertex_face,
                vertex_face_during,
                VERTEX_FACE,
                [a, b, c, d],
                [e, f, g, h],
                width,
                distance
            )
        }
        1 => {
            let [a, b, c, d, e, f, g, h] = kind.draw::<3, 8>(&mut entropy);
            answers!(edge_edge, edge_edge_during, EDGE_EDGE, [a, b, c, d], [e, f, g, h], width, distance)
        }
        _ => {
            let [a, b, c, d, e, f] = kind.draw::<2, 6>(&mut entropy);
            answers!(
                vertex_segment_2d,
                vertex_segment_2d_during,
                VERTEX_SEGMENT,
                [a, b, c],
                [d, e, f],
                width,
                distance
            )
        }
    };
    check_impact(&answers, width);
    check_approach(&answers, distance);
}

fn check_impact(answers: &Answers, width: f64) {
    let moving = &answers.moving;
    assert_eq!(answers.impact.is_some(), answers.touches, "{moving:?}");
    let Some([lo, hi]) = answers.impact else { return };
    assert!(0.0 <= lo && lo <= hi && hi <= 1.0, "{lo} {hi} {moving:?}");
    assert!(rational(hi) - rational(lo) <= width || hi == lo.next_up(), "{lo} {hi} {moving:?}");
    assert_eq!(answers.during, [true, hi == 0.0], "{lo} {hi} {moving:?}");
    let way = moving.speed_squared() * (rational(hi) - rational(lo)).square();
    assert!(moving.distance_squared(&rational(lo)) <= way, "{lo} {hi} {moving:?}");
}

fn check_approach(answers: &Answers, distance: f64) {
    let moving = &answers.moving;
    let time = answers.approach.map_or(1.0, |(time, _)| time);
    let proof = moving.stays_beyond(&rational(distance), &Rational::new(), &rational(time));
    assert!(time == 0.0 || proof != Some(false), "late: {time} {distance:e} {moving:?}");
    if distance == 0.0 {
        assert_eq!(answers.approach.is_some(), answers.touches, "{moving:?}");
    }
    let Some((time, [lower, upper])) = answers.approach else { return };
    let exact = moving.distance_squared(&rational(time));
    assert!(rational(lower).square() <= exact, "{time} {lower:e} {moving:?}");
    assert!(!upper.is_finite() || exact <= rational(upper).square(), "{time} {upper:e} {moving:?}");
}
