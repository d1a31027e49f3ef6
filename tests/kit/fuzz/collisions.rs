//! Continuous collision queries against the exact contacts of the motion.

use crate::entropy::Entropy;
use crate::exact::collision::{Count, Motion};
use crate::generate::Movement;
use welter_predicates::ccd;

/// Panics unless the predicate's answers are those of the oracle; the number of contact times.
fn agree<const D: usize, const N: usize>(
    answers: (bool, ccd::ContactTimes),
    motion: &Motion<D>,
    [t0, t1]: [[[f64; D]; N]; 2],
) -> Count {
    let count = motion.contacts().count;
    let times = match answers.1 {
        ccd::ContactTimes::Finite(times) => Count::Finite(u32::from(times)),
        ccd::ContactTimes::Infinite => Count::Infinite,
    };
    assert_eq!(times, count, "times of contact of {t0:?} {t1:?}");
    assert_eq!(answers.0, count != Count::Finite(0), "contact of {t0:?} {t1:?}");
    count
}

/// `ccd::vertex_face` and `vertex_face_times` of one query against the oracle, whose count is returned.
///
/// # Panics
/// If they differ.
pub fn check_vertex_face([t0, t1]: [[[f64; 3]; 4]; 2]) -> Count {
    let answers = (ccd::vertex_face(t0, t1), ccd::vertex_face_times(t0, t1));
    agree(answers, &Motion::vertex_face(&t0, &t1), [t0, t1])
}

/// `ccd::edge_edge` and `edge_edge_times` of one query against the oracle, whose count is returned.
///
/// # Panics
/// If they differ.
pub fn check_edge_edge([t0, t1]: [[[f64; 3]; 4]; 2]) -> Count {
    let answers = (ccd::edge_edge(t0, t1), ccd::edge_edge_times(t0, t1));
    agree(answers, &Motion::edge_edge(&t0, &t1), [t0, t1])
}

/// `ccd::vertex_segment_2d` and `vertex_segment_2d_times` of one query against the oracle, whose count is returned.
///
/// # Panics
/// If they differ.
pub fn check_vertex_segment([t0, t1]: [[[f64; 2]; 3]; 2]) -> Count {
    let answers = (ccd::vertex_segment_2d(t0, t1), ccd::vertex_segment_2d_times(t0, t1));
    agree(answers, &Motion::vertex_segment(&t0, &t1), [t0, t1])
}

/// A moving vertex against a moving face, drawn from the bytes.
pub fn vertex_face_collisions(bytes: &[u8]) {
    check_vertex_face(Movement::draw_any(&mut Entropy::new(bytes)).1);
}

/// A moving edge against a moving edge, drawn from the bytes.
pub fn edge_edge_collisions(bytes: &[u8]) {
    check_edge_edge(Movement::draw_any(&mut Entropy::new(bytes)).1);
}

/// A moving vertex against a moving segment of the plane, drawn from the bytes.
pub fn vertex_segment_collisions(bytes: &[u8]) {
    check_vertex_segment(Movement::draw_any(&mut Entropy::new(bytes)).1);
}
