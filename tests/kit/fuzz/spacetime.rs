//! Collisions of swept simplices against the enumeration of weights.

use crate::entropy::Entropy;
use crate::exact::swept_meet;
use crate::generate::Movement;
use welter_predicates::ccd::spacetime::{self, by_elimination};

/// Indices that differ, in an order drawn from the bytes.
fn indices<const P: usize>(entropy: &mut Entropy<'_>) -> [u32; P] {
    let start = entropy.pick(&[0, 7, u32::MAX - 3]);
    let mut order = [0, 1, 2, 3];
    for i in 1..4 {
        order.swap(i, usize::from(entropy.below(4)) % (i + 1));
    }
    std::array::from_fn(|i| start + order[i])
}

/// A moving pair of each sort, drawn from the bytes, by both implementations.
pub fn spacetime_collisions(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    let entropy = &mut entropy;
    match entropy.below(3) {
        0 => {
            let (i, (_, [t0, t1])) = (indices(entropy), Movement::draw_any(entropy));
            let expected = swept_meet::<3, 4, 4>(&[t0, t1], &i, 1);
            assert_eq!(spacetime::vertex_face(t0, t1, i), expected, "{t0:?} {t1:?} {i:?}");
            assert_eq!(by_elimination::vertex_face(t0, t1, i), expected, "{t0:?} {t1:?} {i:?}");
        }
        1 => {
            let (i, (_, [t0, t1])) = (indices(entropy), Movement::draw_any(entropy));
            let expected = swept_meet::<3, 4, 4>(&[t0, t1], &i, 2);
            assert_eq!(spacetime::edge_edge(t0, t1, i), expected, "{t0:?} {t1:?} {i:?}");
            assert_eq!(by_elimination::edge_edge(t0, t1, i), expected, "{t0:?} {t1:?} {i:?}");
        }
        _ => {
            let (i, (_, [t0, t1])) = (indices(entropy), Movement::draw_any(entropy));
            let expected = swept_meet::<2, 3, 3>(&[t0, t1], &i, 1);
            assert_eq!(spacetime::vertex_segment_2d(t0, t1, i), expected, "{t0:?} {t1:?} {i:?}");
            assert_eq!(by_elimination::vertex_segment_2d(t0, t1, i), expected, "{t0:?} {t1:?} {i:?}");
        }
    }
}
