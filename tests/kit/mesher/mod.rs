//! Twins and generators for the volumetric mesher: solids made of tetrahedra ([`Solid`]) that overlap themselves, whose hexahedra
//! follow exactly from their own connectivity ([`Unfolded`]), and checks of any mesh ([`check`]).

pub mod bodies;
pub mod checks;
pub mod compare;
mod complex;
pub mod hostile;
mod random;
mod solid;
mod unfolded;

pub use checks::{Checked, check};
pub use compare::{Motion, equals_unfolded, isomorphic};
pub use complex::Complex;
pub use random::Random;
pub use solid::Solid;
pub use unfolded::Unfolded;

/// Disjoint sets of `0..n`; the lowest member stands for each.
struct Sets(Vec<usize>);

impl Sets {
    fn new(n: usize) -> Self {
        Self((0..n).collect())
    }

    fn root(&mut self, x: usize) -> usize {
        if self.0[x] != x {
            let root = self.root_of(x);
            self.0[x] = root;
        }
        self.0[x]
    }

    fn root_of(&self, mut x: usize) -> usize {
        while self.0[x] != x {
            x = self.0[x];
        }
        x
    }

    fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}
