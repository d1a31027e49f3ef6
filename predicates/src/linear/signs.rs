//! Solutions of given signs: [`nonnegative`], by removing columns.
//!
//! # Method
//! Is there an `x >= 0` with `A x = b`? If the system has one solution, its signs tell; if it has none, no.
//! Otherwise some columns depend on each other: there is a vector `k`, not zero, with `A k = 0`. If an `x >= 0`
//! solves the system, so do `x + s k` and `x - s k`; one of them, as `s` grows, makes a component fall to zero
//! while the others are not yet negative, for `k` or `-k` has a negative component. That component is one at
//! which `k` is not zero. So there is a solution exactly if there is one that is zero at one of these places,
//! that is, if one of the systems without one of these columns has one \[Brochu12\]. Each has a column less,
//! and a system without columns has the solution zero or none.
//!
//! The sets of columns are visited in falling order of their binary numbers, each once: a set follows those
//! that it was made from. At most 64 systems are solved; without dependent columns one.

use super::system::System;
use super::{MOST, Outcome};

/// Whether some solution has no negative component; `settle` finds the outcome of a system.
pub(super) fn nonnegative(system: &System, settle: impl Fn(&System) -> Outcome) -> bool {
    let all = (1_u32 << system.unknowns) - 1;
    let mut wanted = [false; 1 << MOST];
    wanted[all as usize] = true;
    for set in (0..=all).rev() {
        if !wanted[set as usize] {
            continue;
        }
        match settle(&system.with_columns(set)) {
            Outcome::Unique(x) if x.iter().all(|&x| x >= 0.0) => return true,
            Outcome::Unique(_) => {}
            Outcome::Inconsistent if set == all => return false,
            Outcome::Inconsistent => {}
            Outcome::Underdetermined { dependency, .. } => {
                // Bit `place` of `dependency` stands for the bit of `set` at that place.
                let mut rest = set;
                for place in 0..set.count_ones() {
                    let column = rest & rest.wrapping_neg();
                    rest ^= column;
                    wanted[(set ^ column) as usize] |= dependency >> place & 1 == 1;
                }
            }
        }
    }
    false
}
