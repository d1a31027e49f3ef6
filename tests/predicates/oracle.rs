//! Every determinant predicate equals its oracle on every kind of input.

use crate::family::{Predicate, check, for_each_predicate, same};
use welter_kit::generate::{Kind, points};

fn agrees_with_integers<const D: usize, const N: usize>(predicate: &Predicate<D, N>) {
    for kind in Kind::ALL {
        check((predicate.name, kind), predicate.cases, &points::<D, N>(kind), |p| {
            same((predicate.sign)(&p), (predicate.oracle)(&p))
        });
    }
}

for_each_predicate! { agrees_with_integers }
