//! Continuous collision where rounded numbers lose what exact ones keep, and parts of the step.

use welter_kit::entropy::{Entropy, stream};
use welter_kit::exact::collision::Motion;
use welter_kit::generate::Movement;
use welter_predicates::ccd::{
    self, edge_edge_during, vertex_face, vertex_face_during, vertex_face_times, vertex_segment_2d_during,
};

/// Motion in the plane z = 0 that touches at the end of the step, by a hundredth of what is left of the abscissas
/// when the axis is scaled to its largest coordinate: at the end they are some 2^-1064 of what they are at the beginning.
#[test]
fn plane_motion_with_a_large_offset_at_one_end() {
    let unit = 2f64.powi(-74);
    let from = [0.0, 1.0, 4.0, 5.0].map(|y| [2f64.powi(1000), y, 0.0]);
    let at = |x: f64, y: f64| [x * unit, y, 0.0];
    let to = |x: f64| [at(0.0, 0.0), at(-1000.55, -1.0), at(x, 2.0), at(-3000.0, 3.0)];
    for (x, touches) in [(2001.11, true), (2001.09, false)] {
        let end = to(x);
        assert_eq!(Motion::vertex_face(&from, &end).contacts().any(), touches, "{x}");
        assert_eq!(vertex_face_times(from, end).any(), touches, "{x}");
        assert_eq!(vertex_face(from, end), touches, "{x}");
        assert_eq!(vertex_face(end, from), touches, "{x}, reversed");
        assert_eq!(vertex_face_during(from, end, [0.5, 1.0]), touches, "{x}, second half");
    }
}

/// The middle of this interval is no `f64`: intervals cut there in more digits must not be passed on rounded, for
/// the root of the volume may be between.
#[test]
fn interval_whose_middle_is_rounded() {
    let t0 = [[1.0, 0.0, -1.0], [0.0, 1.0, -1.0], [-1.0, 0.0, 0.0], [-1.0, 1.0, 1.0]];
    let t1 = [[-1.0, 0.0, 1.0], [0.0, -1.0, 1.0], [-1.0, -1.0, -1.0], [-1.0, 0.0, -1.0]];
    let interval = [0.428_571_428_571_428_6, 1.0 - f64::EPSILON / 2.0];
    assert!(Motion::vertex_face(&t0, &t1).during(interval[0], interval[1]).contacts().any());
    assert!(vertex_face_during(t0, t1, interval));
    assert!(vertex_face_during(t1, t0, [1.0 - interval[1], 1.0 - interval[0]]));
}

/// A time at which contacts of small grids are, one of its neighbours, or an extreme one.
fn time(entropy: &mut Entropy<'_>) -> f64 {
    let parts = 1 + entropy.below(8);
    let time = f64::from(entropy.below(parts + 1)) / f64::from(parts);
    let time = match entropy.below(8) {
        0 | 1 => time,
        2 | 3 => time.next_up(),
        4 | 5 => time.next_down(),
        6 => entropy.pick(&[f64::from_bits(1), f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0]),
        _ => f64::from(entropy.between(0, 9999)) / 9999.0,
    };
    time.clamp(0.0, 1.0)
}

/// Each answer is the oracle's; the interval has a contact if and only if one of its halves has.
#[test]
fn parts_of_the_step() {
    let kinds = [
        Movement::Grid1,
        Movement::Grid2,
        Movement::Grid4,
        Movement::Resting,
        Movement::Sheet,
        Movement::EndTouch,
        Movement::Ulps,
    ];
    let mut found = [0; 2];
    for seed in 0..2100 {
        let bytes = stream(seed, 420);
        let (head, body) = bytes.split_at(20);
        let mut head = Entropy::new(head);
        let (a, b) = (time(&mut head), time(&mut head));
        let b = if head.below(8) == 0 { a } else { b };
        let interval @ [from, to] = [a.min(b), a.max(b)];
        let kind = kinds[usize::try_from(seed).unwrap() % kinds.len()];
        let [t0, t1] = kind.draw(&mut Entropy::new(body));
        let [p0, p1] = kind.draw(&mut Entropy::new(body));
        let mut check = |truth: bool, during: &dyn Fn([f64; 2]) -> bool| {
            let middle = (from + to) / 2.0;
            assert_eq!(during(interval), truth, "{interval:?} of {kind:?}, seed {seed}");
            assert_eq!(
                during([from, middle]) || during([middle, to]),
                truth,
                "halves of {interval:?}, {seed}"
            );
            found[usize::from(truth)] += 1;
        };
        let truth = |motion: &Motion<3>| motion.during(from, to).contacts().any();
        check(truth(&Motion::vertex_face(&t0, &t1)), &|part| vertex_face_during(t0, t1, part));
        check(truth(&Motion::edge_edge(&t0, &t1)), &|part| edge_edge_during(t0, t1, part));
        let in_plane = Motion::vertex_segment(&p0, &p1).during(from, to).contacts().any();
        check(in_plane, &|part| vertex_segment_2d_during(p0, p1, part));
    }
    assert!(found.iter().all(|&count| count > 500), "{found:?}");
}

/// Edges with a vertex in common, and a vertex that is a corner of the face, touch all the time.
#[test]
fn shared_vertices_touch() {
    for seed in 0..3000 {
        let [mut t0, mut t1]: [[[f64; 3]; 4]; 2] = Movement::Ulps.draw(&mut Entropy::new(&stream(seed, 400)));
        let shared = 2 + usize::try_from(seed % 2).unwrap();
        (t0[0], t1[0]) = (t0[shared], t1[shared]);
        assert_eq!(ccd::vertex_face_times(t0, t1), ccd::ContactTimes::Infinite, "seed {seed}");
        assert!(ccd::vertex_face(t0, t1) && ccd::edge_edge(t0, t1), "seed {seed}");
        assert!(edge_edge_during(t0, t1, [0.3, 0.3]), "seed {seed}");
    }
}
