//! The public ray query: [`ray_bilinear_patch`].

use super::PatchParity;
use super::integers::Given;
use super::rounded::parity_of_patch;
use super::surface::{Face, Parity};
use crate::Point;

const PATCH: [Face; 1] = [Face::Patch([0, 1, 2, 3])];

/// Whether a ray crosses a bilinear patch an odd or an even number of times.
///
/// The patch has the corners `[p00, p10, p01, p11]` and is the set of the points
///
/// ```text
/// B(s, t) = (1-s)(1-t) p00 + s(1-t) p10 + (1-s)t p01 + s t p11,    0 <= s, t <= 1
/// ```
///
/// It may be flat, folded, or shrunk to a line or to a point. The ray begins at `origin`. Its direction `R`
/// stands for `R + (e, e^2, e^3)` with an infinitesimal `e > 0`, so that a ray through an edge or a corner
/// passes on one side of it, and the zero vector is a direction as well. The crossings are counted with
/// multiplicity: a ray that touches from one side has an even number. Over the patches of a closed surface,
/// the parities add up to the same for every direction.
///
/// `Even` when a coordinate is not finite.
///
/// ```
/// use welter_predicates::ccd::parity::{PatchParity, ray_bilinear_patch};
/// // The saddle z = x y.
/// let patch = [[-1.0, -1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [1.0, 1.0, 1.0]];
/// let up = [0.0, 0.0, 1.0];
/// assert_eq!(ray_bilinear_patch([0.5, 0.5, 0.0], up, patch), PatchParity::Odd);
/// assert_eq!(ray_bilinear_patch([0.5, 0.5, 0.25], up, patch), PatchParity::OnPatch);
/// assert_eq!(ray_bilinear_patch([0.5, 0.5, 0.5], up, patch), PatchParity::Even);
/// // In at one side and out at the other.
/// assert_eq!(ray_bilinear_patch([2.0, 2.0, 0.25], [-1.0, -1.0, 0.0], patch), PatchParity::Even);
/// ```
#[must_use]
pub fn ray_bilinear_patch(
    origin: impl Point<3>,
    direction: impl Point<3>,
    patch: [impl Point<3>; 4],
) -> PatchParity {
    let (origin, direction, [a, b, c, d]) = (origin.coords(), direction.coords(), patch.map(Point::coords));
    let corners = [a, b, c, d].map(|p| core::array::from_fn(|k| p[k] - origin[k]));
    let parity = parity_of_patch(&corners, &direction, &PATCH)
        .unwrap_or_else(|| exactly([a, b, c, d, origin], direction));
    match parity {
        Parity::On => PatchParity::OnPatch,
        Parity::Odd => PatchParity::Odd,
        Parity::Even => PatchParity::Even,
    }
}

#[cold]
fn exactly(points: [[f64; 3]; 5], direction: [f64; 3]) -> Parity {
    if !points.as_flattened().iter().chain(&direction).all(|x| x.is_finite()) {
        return Parity::Even;
    }
    Given::new(&points, [(0, 4), (1, 4), (2, 4), (3, 4)], Some(direction)).parity(&PATCH)
}
