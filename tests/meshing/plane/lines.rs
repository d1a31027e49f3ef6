//! Curves from the lines of OBJ files.

use super::{check, curves, meshed, strip};
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::io::{Limits, read_obj_polylines};
use welter_meshing::volumetric::plane::{ClosedPolylines, JoinError};

/// A file of loops at height 2, cut into lines of up to four segments, which come in any order.
fn file(loops: &[Vec<[f64; 2]>], seed: u64) -> String {
    let bytes = stream(seed, 4000);
    let mut entropy = Entropy::new(&bytes);
    let (mut text, mut lines, mut first) = (String::new(), Vec::new(), 1);
    for points in loops {
        points.iter().for_each(|[x, y]| text.push_str(&format!("v {x} {y} 2\n")));
        let (count, mut from) = (points.len(), 0);
        while from < count {
            let to = (from + 1 + usize::from(entropy.below(4))).min(count);
            let line: Vec<String> = (from..=to).map(|k| (first + k % count).to_string()).collect();
            lines.insert(usize::from(entropy.byte()) % (lines.len() + 1), format!("l {}\n", line.join(" ")));
            from = to;
        }
        first += count;
    }
    text + &lines.concat()
}

/// A strip that crosses itself, and a square with a hole over it.
fn loops() -> Vec<Vec<[f64; 2]>> {
    let path: Vec<[f64; 2]> = (0..=40)
        .map(|k| {
            let t = 0.2 + 5.6 * f64::from(k) / 40.0;
            [4.0 * t.sin(), 3.0 * (2.0 * t).sin()]
        })
        .collect();
    let square =
        |at: f64, side: f64| vec![[at, at], [at + side, at], [at + side, at + side], [at, at + side]];
    let mut hole = square(1.5, 1.0);
    hole.reverse();
    vec![strip(&path, 0.6), square(1.0, 2.0), hole]
}

#[test]
fn lines_in_any_order_mesh_as_their_curves() {
    let expected = meshed(&curves(&loops()), 0.25).unwrap();
    for seed in 0..5 {
        let (found, report) =
            read_obj_polylines(file(&loops(), seed).as_bytes(), &Limits::default()).unwrap();
        assert!(report.ignored.is_empty());
        let joined = ClosedPolylines::joined(&found.positions, &found.lines).unwrap();
        assert_eq!((joined.loops().len(), joined.positions().len()), (3, 90));
        let area = meshed(&joined, 0.25).unwrap();
        check(&joined, &area);
        assert_eq!((area.mesh, area.windings), (expected.mesh.clone(), expected.windings.clone()), "{seed}");
    }
}

#[test]
fn a_missing_line_is_an_open_curve() {
    let whole = file(&loops(), 1);
    for missing in 0..whole.lines().filter(|line| line.starts_with('l')).count() {
        let mut number = 0;
        let kept = whole.lines().filter(|line| {
            number += usize::from(line.starts_with('l'));
            !line.starts_with('l') || number != missing + 1
        });
        let text: String = kept.map(|line| format!("{line}\n")).collect();
        let (found, _) = read_obj_polylines(text.as_bytes(), &Limits::default()).unwrap();
        let error = ClosedPolylines::joined(&found.positions, &found.lines).unwrap_err();
        let JoinError::Open { vertex, arriving, leaving } = error else { panic!("{error}") };
        // The end of the line is missing at the first of its two ends.
        let ends: Vec<u32> = found.lines.iter().flat_map(|line| [line[0], line[line.len() - 1]]).collect();
        assert_eq!(ends.iter().filter(|&&end| end == vertex).count(), arriving + leaving);
        assert_eq!(arriving + leaving, 1, "{missing}: {vertex}");
    }
}
