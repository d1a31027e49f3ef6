//! [`glyph`]: printable ASCII as strokes.
//!
//! Points are two characters: x and y in base 16 on a grid with the baseline at y = 3, the x-height at 9, capitals at c and
//! descenders at 0. A stroke is a polyline; with `~` before it, an open quadratic B-spline from its first to its last
//! point; with `o`, a closed one.

/// One stroke of a glyph.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Polyline on the grid, x from the left edge, y up from the baseline.
    pub points: Vec<[f32; 2]>,
}

/// Height of capitals above the baseline.
pub const CAPITAL: f32 = 9.0;
/// Space between glyphs.
pub const GAP: f32 = 2.4;
/// Baseline on the grid.
const BASELINE: f32 = 3.0;
/// Line segments for each span of a spline.
const STEPS: usize = 6;

/// Advance width without the gap, and strokes. Characters other than printable ASCII are drawn as `?`.
pub fn glyph(c: char) -> (f32, Vec<Stroke>) {
    let index = (c as usize).wrapping_sub(32);
    let &(width, strokes) = GLYPHS.get(index).unwrap_or(&GLYPHS['?' as usize - 32]);
    (width, strokes.split_whitespace().map(stroke).collect())
}

fn stroke(text: &str) -> Stroke {
    let (kind, text) = match text.as_bytes()[0] {
        b'~' => ('~', &text[1..]),
        b'o' => ('o', &text[1..]),
        _ => ('-', text),
    };
    let digit = |c: u8| (c as char).to_digit(16).unwrap_or(0) as f32;
    let control: Vec<[f32; 2]> =
        text.as_bytes().chunks_exact(2).map(|p| [digit(p[0]), digit(p[1]) - BASELINE]).collect();
    let points = match kind {
        '~' => spline(&control, false),
        'o' => spline(&control, true),
        _ => control,
    };
    Stroke { points }
}

/// Joins the middles of the sides of the control polygon by parabolas tangent to them.
fn spline(control: &[[f32; 2]], closed: bool) -> Vec<[f32; 2]> {
    let n = control.len();
    let mix = |a: [f32; 2], b: [f32; 2], t: f32| [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
    let middle = |i: usize, j: usize| mix(control[i % n], control[j % n], 0.5);
    let mut points = Vec::new();
    let corners = if closed { 0..n } else { 1..n.saturating_sub(1) };
    for i in corners {
        let (before, after) = (i + n - 1, i + 1);
        let start = if !closed && i == 1 { control[0] } else { middle(before, i) };
        let end = if !closed && after == n - 1 { control[n - 1] } else { middle(i, after) };
        let bend = control[i];
        points.extend((0..STEPS).map(|k| {
            let t = k as f32 / STEPS as f32;
            mix(mix(start, bend, t), mix(bend, end, t), t)
        }));
        if (!closed && after == n - 1) || (closed && i == n - 1) {
            points.push(end);
        }
    }
    points
}

/// Width and strokes from space to tilde.
const GLYPHS: [(f32, &str); 95] = [
    (2.0, ""),
    (0.0, "0c06 0303"),
    (2.0, "0c0a 2c2a"),
    (6.0, "132c 435c 0666 0969"),
    (5.0, "~5a5c0c0857530305 2d22"),
    (6.0, "036c o0c2c2909 o46666343"),
    (6.0, "~630a0c4c490703435367"),
    (0.0, "0c0a"),
    (2.0, "~2d090521"),
    (2.0, "~0d292501"),
    (4.0, "272b 084a 0a48"),
    (4.0, "0747 2925"),
    (1.0, "1301"),
    (4.0, "0747"),
    (0.0, "0303"),
    (4.0, "024c"),
    (5.0, "o0c5c5303"),
    (5.0, "1a3c33"),
    (5.0, "~0a0c5c5803 0353"),
    (5.0, "~0b0c5c5828 ~2858530304"),
    (5.0, "4c0656 4c43"),
    (5.0, "4c0c08 ~082959530304"),
    (5.0, "~4c0b06 o08585303"),
    (5.0, "0c5c23"),
    (5.0, "o0c5c5808 o08585303"),
    (5.0, "~135459 o0c5c5707"),
    (0.0, "0303 0808"),
    (1.0, "1301 1818"),
    (4.0, "490643"),
    (4.0, "0646 0949"),
    (4.0, "094603"),
    (5.0, "~0a0c5c582725 2323"),
    (7.0, "~63030c7c755559 o29595525"),
    (6.0, "033c63 1656"),
    (5.0, "0c03 ~0c5c5808 ~08585303"),
    (6.0, "~6a6c0c036365"),
    (6.0, "030c ~0c6c6303"),
    (5.0, "5c0c0353 0848"),
    (5.0, "5c0c03 0848"),
    (6.0, "~6a6c0c036367 6747"),
    (6.0, "030c 636c 0868"),
    (0.0, "030c"),
    (4.0, "~4c430306"),
    (5.0, "030c 5c06 2853"),
    (5.0, "0c0353"),
    (8.0, "030c458c83"),
    (6.0, "030c636c"),
    (7.0, "o0c7c7303"),
    (5.0, "030c ~0c5c5707"),
    (7.0, "o0c7c7303 4572"),
    (5.0, "030c ~0c5c5707 3753"),
    (5.0, "~5a5c0c0857530305"),
    (6.0, "0c6c 3c33"),
    (6.0, "~0c080363686c"),
    (6.0, "0c336c"),
    (8.0, "0c234b638c"),
    (6.0, "036c 0c63"),
    (6.0, "0c376c 3733"),
    (6.0, "0c6c0363"),
    (2.0, "2d0d0121"),
    (4.0, "0c42"),
    (2.0, "0d2d2101"),
    (4.0, "092c49"),
    (5.0, "0252"),
    (1.0, "0c1a"),
    (5.0, "o09595303 5953"),
    (5.0, "0c03 o09595303"),
    (5.0, "~585909035354"),
    (5.0, "5c53 o09595303"),
    (5.0, "0656 ~565909035354"),
    (4.0, "~4c1c19 1913 0939"),
    (5.0, "o09595303 ~59500002"),
    (5.0, "0c03 ~0609595553"),
    (0.0, "0903 0c0c"),
    (2.0, "~292000 2c2c"),
    (4.0, "0c03 4905 1643"),
    (0.0, "0c03"),
    (8.0, "0903 ~0609494543 ~4649898583"),
    (5.0, "0903 ~0609595553"),
    (5.0, "o09595303"),
    (5.0, "0900 o09595303"),
    (5.0, "5950 o09595303"),
    (3.0, "0903 ~060939"),
    (4.0, "~4849090745430304"),
    (3.0, "~1c151333 0939"),
    (5.0, "~0907035356 5953"),
    (4.0, "092349"),
    (8.0, "0923486389"),
    (4.0, "0349 0943"),
    (4.0, "0923 4910"),
    (4.0, "09490343"),
    (3.0, "~3d1d1907 ~07151131"),
    (0.0, "0d01"),
    (3.0, "~0d2d2937 ~37252101"),
    (4.0, "~06193548"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_printable_character_has_strokes_within_its_width() {
        for c in '!'..='~' {
            let (width, strokes) = glyph(c);
            assert!(!strokes.is_empty(), "{c}");
            for [x, y] in strokes.into_iter().flat_map(|s| s.points) {
                assert!((0.0..=width).contains(&x) && (-3.0..=10.0).contains(&y), "{c}: {x} {y}");
            }
        }
        assert!(glyph(' ').1.is_empty());
        assert_eq!(glyph('\u{00e9}').1, glyph('?').1);
        assert_eq!(glyph('\n').1, glyph('?').1);
    }

    #[test]
    fn all_strokes_are_whole_points_on_the_grid() {
        for (_, strokes) in GLYPHS {
            for s in strokes.split_whitespace() {
                let points = s.trim_start_matches(['~', 'o']);
                assert!(points.len().is_multiple_of(2) && points.len() >= 4, "{s}");
                assert!(points.bytes().all(|b| b.is_ascii_hexdigit()), "{s}");
            }
        }
    }
}
