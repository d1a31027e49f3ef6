//! Crossing parity: of a ray and a bilinear patch, and from it the parity of the contacts of a moving pair
//! \[Brochu12\].
//!
//! # What it computes
//! * [`ray_bilinear_patch`]: whether a ray crosses a bilinear patch an odd or an even number of times, or
//!   begins on it.
//! * [`vertex_face`], [`edge_edge`], [`vertex_segment_2d`]: whether the contacts of a moving pair inside its
//!   domain are odd or even in number, or whether one is on the boundary of the domain: at the beginning or
//!   the end of the step, or with an edge or an end of a primitive at any time.
//!
//! # Promises
//! * The answer is right for every finite `f64`; every degenerate case is decided. No random numbers, no
//!   retry.
//! * A [`RootParity`] depends on the given numbers alone, not on axes, names, the direction of time or units.
//! * No allocation, no recursion; the worst case is bounded by a constant.
//!
//! # Non-promises
//! * **An even number of contacts is not told from none**: a pair that touches and parts again, or passes
//!   through and back, may be `Even`. The complete decision is [`super::vertex_face`] and its siblings.
//! * The parity of a single patch for a ray through its edges or corners: it is that of a ray that passes
//!   close by on a fixed side (below). Only sums over closed surfaces are free of that choice.
//!
//! # Method
//! **Degree.** Let `B` map a square (or a triangle) into space, continuously and so that it misses the
//! origin. A ray from the origin that misses the image of the square's boundary crosses `B`, counted with
//! multiplicity, as often modulo 2 as the degree modulo 2, at the direction of the ray, of `B` projected to
//! the unit sphere. That degree is constant between directions that the image of the boundary does not
//! separate (so it speaks of all nearby rays, and a tangential crossing counts twice), it does not change
//! when `B` is deformed without its boundary and without meeting the origin, and its sum over a closed
//! surface is the same for all directions. That sum, for the image of the boundary of a domain under a map
//! `F`, is the number of roots of `F` in the domain, with multiplicity, modulo 2: the root parity lemma of
//! \[Brochu12\].
//!
//! **Ray.** The direction `R` stands for `R + (e, e^2, e^3)` with an infinitesimal `e > 0`; where the
//! direction is free, it is `(1, e, e^2)`. With `n = p x q` the determinant `det(R, p, q)` then has the sign
//! of the first of
//!
//! ```text
//! R . n,  n_x,  n_y,  n_z        (free: n_x, n_y, n_z)
//! ```
//!
//! that is not zero, for it is `R . n + e n_x + e^2 n_y + e^3 n_z`, and is zero only if `n` is. So the ray
//! meets no line from `p` to `q` but one through the origin, and those are looked at for themselves: no ray
//! has to be tried again.
//!
//! **Triangle.** If the origin is not on it, the ray crosses `p, q, r` if and only if `D = det(p, q, r)` is
//! not zero and `det(R, p, q)`, `det(R, q, r)`, `det(R, r, p)` all have its sign (Cramer:
//! `R = a p + b q + c r` with `a, b, c > 0`).
//!
//! **Patch.** `surface` replaces a patch by two triangles with the same boundary, and proves that it may.
//!
//! **Closed surfaces.** The roots of vertex-face are those of `F(t, u, v)` on a triangular prism, whose
//! boundary becomes two triangles and three patches; edge-edge has a cube and six patches; vertex-segment in
//! the plane a square, whose boundary becomes a quadrilateral.
//!
//! **Contacts.** Let `f(t)` be the volume of [`super`]'s decision, whose roots are the times when the
//! primitives are coplanar. If the answer is not `OnBoundary`, it is the parity of the contacts, each counted
//! as often as its time is a root of `f`. Proof: at a contact the polygon of `decide` has an area, for one
//! without is the union of its edges, and a contact with these is on the boundary. So two of the three
//! equations `F = 0` determine `u` and `v` as smooth functions of `t`, and the third becomes `f` times a
//! function without zero. If `f` is zero throughout, such a contact continues until it leaves the domain
//! through its boundary, where it would have been seen.
//!
//! # Stages
//! Boxes and separating directions, as for the complete decision; the whole surface in rounded arithmetic
//! with proven bounds (`rounded`); the whole surface in integers (`integers`), of machine words if the
//! coordinates lie on a lattice.
//!
//! # Cost
//! Measured on random queries, those that are culled included: in general position, where rounded arithmetic
//! decides, 0.3 microseconds for vertex-face and 0.4 for edge-edge; on small integer grids, in machine words,
//! 0.3 to 1.6; where all points lie in one plane 5 to 20, because some flat patches ask the complete decision for
//! a moving segment. The worst case is that of integers of 2100 bits a coordinate.

mod integers;
mod planar;
mod query;
mod ray;
mod rounded;
mod surface;
#[cfg(test)]
mod tests;

pub use planar::vertex_segment_2d;
pub use query::{edge_edge, vertex_face};
pub use ray::ray_bilinear_patch;

/// How often a ray crosses a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PatchParity {
    /// The ray begins on the patch.
    OnPatch,
    /// An odd number of times.
    Odd,
    /// An even number of times, or never.
    Even,
}

/// How often a moving pair touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RootParity {
    /// There is a contact at the beginning or the end of the step, or with an edge or an end of a primitive.
    OnBoundary,
    /// No such contact, but an odd number of others: at least one.
    Odd,
    /// No such contact, and an even number of others, or none.
    Even,
}

impl RootParity {
    /// True when there must be a contact. That is sufficient, not necessary: an even number of contacts is
    /// not seen.
    ///
    /// ```
    /// use welter_predicates::ccd::parity::RootParity;
    /// assert!(RootParity::OnBoundary.certain() && RootParity::Odd.certain() && !RootParity::Even.certain());
    /// ```
    #[must_use]
    pub fn certain(self) -> bool {
        self != Self::Even
    }

    fn of(parity: surface::Parity) -> Self {
        match parity {
            surface::Parity::On => Self::OnBoundary,
            surface::Parity::Odd => Self::Odd,
            surface::Parity::Even => Self::Even,
        }
    }
}
