//! The predicates of the moved grid against one that is really moved.

use crate::entropy::Entropy;
use crate::exact::{MovedLine, moved_box_meets, moved_orient};
use crate::generate::Kind;
use std::cmp::Ordering;
use welter_predicates::moved_grid as mg;

/// One question about a node, a line or a cell of the moved grid, drawn from the bytes.
pub fn moved_grid(bytes: &[u8]) {
    let mut entropy = Entropy::new(bytes);
    let question = entropy.below(4);
    let axis = usize::from(entropy.below(3));
    let (kind, [a, b, c, d, e, f, q]) = Kind::draw_any::<3, 7>(&mut entropy);
    let context = format!("{kind:?} {axis} {a:?} {b:?} {c:?} {d:?} {e:?} {f:?} {q:?}");
    match question {
        0 => {
            let sign = mg::orient3d_moved(a, b, c, q);
            assert_eq!(i32::from(sign as i8), moved_orient(&[a, b, c], q), "{context}");
        }
        1 => {
            let (min, max) = ([0, 1, 2].map(|i| d[i].min(q[i])), [0, 1, 2].map(|i| d[i].max(q[i])));
            let meets = mg::moved_box_meets_triangle(min, max, [a, b, c]);
            assert_eq!(meets, moved_box_meets(min, max, &[a, b, c]), "{context}");
            let meets = mg::moved_box_meets_segment(min, max, [a, b]);
            assert_eq!(meets, moved_box_meets(min, max, &[a, b]), "{context}");
        }
        _ => {
            // Through any point, or through a corner that both triangles share.
            let (through, second) = if question == 2 { (q, [d, e, f]) } else { (a, [d, e, a]) };
            let line = [through[(axis + 1) % 3], through[(axis + 2) % 3]];
            let expected = MovedLine::new(axis, line, &[[a, b, c], second], &[through[axis]]);
            let sign = mg::axis_line_crossing(axis, line, [a, b, c]);
            let crossed = if expected.crossings[0].is_some() { expected.normals[0] } else { 0 };
            assert_eq!(i32::from(sign as i8), crossed, "{context}");
            let before = expected.planes[0].as_ref().is_some_and(|at| *at < expected.nodes[0]);
            assert_eq!(mg::crossing_precedes(axis, line, [a, b, c], through[axis]), before, "{context}");
            let order = match &expected.planes[..] {
                [Some(first), Some(second)] => first.cmp(second),
                _ => Ordering::Equal,
            };
            assert_eq!(mg::compare_crossings(axis, line, [a, b, c], second), order, "{context}");
        }
    }
}
