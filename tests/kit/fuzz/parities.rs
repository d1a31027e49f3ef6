//! Parities of the contacts of moving pairs against the exact contacts of the motion.

use crate::entropy::Entropy;
use crate::exact::collision::Motion;
use crate::generate::Movement;
use welter_predicates::ccd::parity::{self, RootParity};

/// What the contacts of a motion say about its parity.
fn expected<const D: usize>(motion: &Motion<D>) -> RootParity {
    let contacts = motion.contacts();
    match contacts.multiplicity_sum {
        _ if contacts.on_boundary => RootParity::OnBoundary,
        Some(sum) if sum % 2 == 1 => RootParity::Odd,
        Some(_) => RootParity::Even,
        // Contact that lasts leaves the domain through its boundary.
        None => {
            assert!(!contacts.any(), "a lasting contact that is not on the boundary: {motion:?}");
            RootParity::Even
        }
    }
}

/// A moving pair of each sort, drawn from the bytes.
pub fn root_parities(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    match entropy.below(3) {
        0 => {
            let (_, [t0, t1]) = Movement::draw_any(&mut entropy);
            let motion = Motion::vertex_face(&t0, &t1);
            assert_eq!(parity::vertex_face(t0, t1), expected(&motion), "{t0:?} {t1:?}");
        }
        1 => {
            let (_, [t0, t1]) = Movement::draw_any(&mut entropy);
            let motion = Motion::edge_edge(&t0, &t1);
            assert_eq!(parity::edge_edge(t0, t1), expected(&motion), "{t0:?} {t1:?}");
        }
        _ => {
            let (_, [t0, t1]) = Movement::draw_any(&mut entropy);
            let motion = Motion::vertex_segment(&t0, &t1);
            assert_eq!(parity::vertex_segment_2d(t0, t1), expected(&motion), "{t0:?} {t1:?}");
        }
    }
}
