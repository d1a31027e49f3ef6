//! The parity of the crossings of a ray from the origin and a surface of triangles and bilinear patches.
//!
//! # A patch
//! `B(s, t)` has the corners `p0, p1, p2, p3`, of which `p0` and `p3` are opposite. It has the same boundary
//! as the two triangles that share the diagonal `12`, which are `012` and `132`, and as those that share
//! `03`, which are `013` and `032`. With `D_ijk = det(p_i, p_j, p_k)` let (degree 6;
//! [`crate::polynomial::patch_side`])
//!
//! ```text
//! phi = D_012 D_132 - D_013 D_032
//! ```
//!
//! **Claims**, for an origin that is not on the patch:
//!
//! 1. If `phi > 0`, the patch has the degree of pair 12, which the origin is not on. If `phi < 0`, that of
//!    pair 03, likewise.
//! 2. If `phi = 0`, both pairs have the same degree, unless the origin is in one plane with all corners, and
//!    then the degree is zero.
//!
//! And 3.: if the corners are not in one plane, the origin is on the patch if and only if `phi = 0` and the
//! origin is in the closed tetrahedron of the corners.
//!
//! **Proof.** Let `W = p0 - p1 - p2 + p3`, and move the pair 12, taken as linear functions on the two halves
//! of the square, to the patch by straight lines. A point moves by `s t W` in the half `s + t <= 1` and by
//! `(1-s)(1-t) W` in the other; the boundary stays. If the corners are not in one plane, write points in
//! barycentric coordinates `a, b, c, d` and `q = a d - b c`. After the part `m` of the way in the first half,
//! `a = 1 - s - t + m`, `b = s - m`, `c = t - m`, `d = m` and `q = m - s t`: negative on the way, zero at its
//! end. The other half is the same with 0 and 3 exchanged. So an origin on the way has `q < 0`. With 1 and 0,
//! 2 and 3 exchanged, `q` becomes `-q` and pair 12 becomes pair 03, so an origin on the way from pair 03 has
//! `q > 0`. All points of both ways are in the tetrahedron. Solving for the origin's coordinates by Cramer's
//! rule, with `V` six times the volume of the tetrahedron,
//!
//! ```text
//! a V = -D_132    b V = D_032    c V = D_013    d V = -D_012        so    phi = V^2 q
//! ```
//!
//! which is 1. and, as neither way meets an origin outside of the tetrahedron, 2. For 3.: coordinates that
//! are not negative, of sum 1, with `a d = b c`, are those of the patch at `s = b + d`, `t = c + d`. If the
//! corners lie in one plane, so do both ways. A plane that misses the origin makes both degrees that of the
//! patch, whatever `phi`. In one plane with the origin all `D` and `phi` are zero, and the ray leaves the
//! plane. (It does: the plane has a normal, which takes the place of `n` in [`super`].) Conversely, if all
//! `D` are zero the origin is in one plane with all corners.
//!
//! # Without phi, mostly
//! [`patch`] asks first on which of the four triangles the origin is, and which the ray crosses. Suppose that
//! the origin is not on the boundary of the patch. A line from the origin through no edge of the tetrahedron
//! crosses its surface twice or not at all.
//!
//! * *The origin is on no triangle.* If both pairs have the same degree, that is the answer. The origin is
//!   not on the patch then: inside of the tetrahedron, one of the two crossings of the line is on the ray, so
//!   the degrees differ; and a flat patch is in the union of the four triangles. If they differ, the corners
//!   are not in one plane and the origin is in the tetrahedron: `phi` tells, and if it is zero, the origin is
//!   on the patch.
//! * *On triangles of one pair only.* Not in one plane with all corners, the origin is on a face, off the
//!   boundary of the patch, and so `phi` is not zero (`q` is a product of two coordinates that vanish only
//!   there) and tells the other pair. In one plane with them: see below.
//! * *On triangles of both pairs.* Faces of a tetrahedron that belong to different pairs meet in an edge of
//!   the patch: all must be in one plane.
//!
//! In one plane with all corners, the degree is zero and only the position of the origin is asked for. Off
//! the diagonal of a pair it is on the patch if an odd number of the pair's triangles hold it, since the
//! boundary then winds around it an odd number of times. Else the patch is taken as a segment that moves from
//! `p0 p1` to `p2 p3`. In units of the plane's normal, the cross product of its ends is a quadratic of time
//! with the Bernstein coefficients `n_01`, `(n_03 + n_21) / 2`, `n_23`; if these have one strict sign
//! ([`is_steady`]) the segment never holds the origin. So for the segment from `p0 p2` to `p1 p3`. What is
//! left goes to [`super::super::decide`].
//!
//! If the origin is on the line of an edge but not on the edge, the edge's triangles are in one plane with
//! the origin, and on them it is only if it is on another of their edges. The ray does not cross them.

use crate::Sign;

/// Parity of crossings with one or more faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parity {
    /// The origin is on a face.
    On,
    Odd,
    Even,
}

/// A face of a surface, by indices of corners.
#[derive(Clone, Copy, Debug)]
pub(super) enum Face {
    Triangle([usize; 3]),
    /// The first and the last corner are opposite.
    Patch([usize; 4]),
}

/// Corners relative to the ray's origin in some arithmetic; `None` where that is not certain.
pub(super) trait Image {
    /// The sign of `det(R, p_i, p_j)` for the ray; zero only if the origin is on the line of `p_i` and `p_j`.
    fn side(&self, i: usize, j: usize) -> Option<Sign>;
    /// The sign of `det(p_i, p_j, p_k)`.
    fn volume(&self, triangle: [usize; 3]) -> Option<Sign>;
    /// The sign of `phi`.
    fn patch_side(&self, patch: [usize; 4]) -> Option<Sign>;
    /// Whether the origin is on the edge from `p_i` to `p_j`, if it is on its line.
    fn edge_holds_origin(&self, i: usize, j: usize) -> Option<bool>;
    /// Whether the origin is on a patch that is in one plane with it.
    fn flat_patch_holds_origin(&self, patch: [usize; 4]) -> Option<bool>;
}

/// Where a triangle is, seen along the line of the ray.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    /// Beside the line.
    Beside,
    Ahead,
    Behind,
    /// At the origin.
    Here,
}

/// The parity of the crossings with all faces of a surface.
#[inline(always)]
pub(super) fn surface(image: &impl Image, faces: &[Face]) -> Option<Parity> {
    let mut odd = false;
    for &face in faces {
        let parity = match face {
            Face::Triangle(corners) => triangle(image, corners)?,
            Face::Patch(corners) => patch(image, corners)?,
        };
        match parity {
            Parity::On => return Some(Parity::On),
            Parity::Odd => odd = !odd,
            Parity::Even => {}
        }
    }
    Some(of(odd))
}

fn of(odd: bool) -> Parity {
    if odd { Parity::Odd } else { Parity::Even }
}

#[inline(always)]
fn holds_origin(image: &impl Image, side: Sign, i: usize, j: usize) -> Option<bool> {
    if side.is_zero() { image.edge_holds_origin(i, j) } else { Some(false) }
}

fn triangle(image: &impl Image, corners: [usize; 3]) -> Option<Parity> {
    let [p, q, r] = corners;
    let sides = [image.side(p, q)?, image.side(q, r)?, image.side(r, p)?];
    let on_edge = holds_origin(image, sides[0], p, q)?
        || holds_origin(image, sides[1], q, r)?
        || holds_origin(image, sides[2], r, p)?;
    Some(match place(image, corners, sides, on_edge)? {
        Place::Here => Parity::On,
        Place::Ahead => Parity::Odd,
        Place::Beside | Place::Behind => Parity::Even,
    })
}

/// Where a triangle is, given the sides of its edges and whether the origin is on one of these.
#[inline(always)]
fn place(image: &impl Image, triangle: [usize; 3], sides: [Sign; 3], on_edge: bool) -> Option<Place> {
    if on_edge {
        return Some(Place::Here);
    }
    if sides[0].is_zero() || sides[0] != sides[1] || sides[0] != sides[2] {
        return Some(Place::Beside);
    }
    // The line passes through the inside: at zero volume it does so at the origin.
    let volume = image.volume(triangle)?;
    Some(if volume.is_zero() {
        Place::Here
    } else if volume == sides[0] {
        Place::Ahead
    } else {
        Place::Behind
    })
}

/// The parity of the crossings with a bilinear patch; the module's head has the proof.
#[inline(always)]
fn patch(image: &impl Image, corners: [usize; 4]) -> Option<Parity> {
    let [a, b, c, d] = corners;
    let [ab, bd, dc, ca] = [image.side(a, b)?, image.side(b, d)?, image.side(d, c)?, image.side(c, a)?];
    let [bc, ad] = [image.side(b, c)?, image.side(a, d)?];
    if holds_origin(image, ab, a, b)?
        || holds_origin(image, bd, b, d)?
        || holds_origin(image, dc, d, c)?
        || holds_origin(image, ca, c, a)?
    {
        return Some(Parity::On);
    }
    let on_bc = holds_origin(image, bc, b, c)?;
    let across_bc =
        [place(image, [a, b, c], [ab, bc, ca], on_bc)?, place(image, [b, d, c], [bd, dc, -bc], on_bc)?];
    let on_ad = holds_origin(image, ad, a, d)?;
    let across_ad =
        [place(image, [a, b, d], [ab, bd, -ad], on_ad)?, place(image, [a, d, c], [ad, dc, ca], on_ad)?];
    let odd = |pair: [Place; 2]| (pair[0] == Place::Ahead) != (pair[1] == Place::Ahead);
    let [odd_bc, odd_ad] = [odd(across_bc), odd(across_ad)];
    let (on_bc, on_ad) = (across_bc.contains(&Place::Here), across_ad.contains(&Place::Here));
    if !on_bc && !on_ad {
        if odd_bc == odd_ad {
            return Some(of(odd_bc));
        }
        return Some(match image.patch_side(corners)? {
            Sign::Positive => of(odd_bc),
            Sign::Negative => of(odd_ad),
            Sign::Zero => Parity::On,
        });
    }
    if (on_bc && on_ad) || is_flat(image, corners)? {
        let winds = |places: [Place; 2], diagonal: Sign| {
            !diagonal.is_zero() && (places[0] == Place::Here) != (places[1] == Place::Here)
        };
        if winds(across_bc, bc) || winds(across_ad, ad) {
            return Some(Parity::On);
        }
        let turns_one_way = is_steady([ab, -dc, ad, -bc]) || is_steady([-ca, bd, ad, bc]);
        let on = !turns_one_way && image.flat_patch_holds_origin(corners)?;
        return Some(if on { Parity::On } else { Parity::Even });
    }
    Some(of(if on_bc { odd_ad } else { odd_bc }))
}

/// True when a quadratic has no root in [0, 1]: its Bernstein coefficients there have the signs `first`,
/// `last`, and, as a mean, those of both `inner`.
fn is_steady([first, last, inner @ ..]: [Sign; 4]) -> bool {
    !first.is_zero() && last == first && inner.into_iter().all(|sign| sign != -first)
}

/// True when all corners are in one plane with the origin.
fn is_flat(image: &impl Image, [a, b, c, d]: [usize; 4]) -> Option<bool> {
    for triangle in [[a, b, c], [b, d, c], [a, b, d], [a, d, c]] {
        if !image.volume(triangle)?.is_zero() {
            return Some(false);
        }
    }
    Some(true)
}
