//! The point of a convex polygon closest to the origin, and directions that hold the polygon away from it:
//! [`Polygon`].
//!
//! # What it computes
//! The polygon is `P_0 + s A + t B` for `A = P_1 - P_0`, `B = P_last - P_0` and `(s, t)` in a segment,
//! triangle or square: the difference of a vertex and a segment, of a vertex and a face, or of two edges.
//!
//! # What it promises
//! * The parameters are multiples of 2^-52 within their domain, so the weights of the vertices are not
//!   negative and sum to one without rounding.
//! * The computed distance of that point errs by at most [`ROUNDING`] of the size `r` of the motion, the norm
//!   of [`Motion::maxima`](super::motion::Motion): `24u` from the corners, whose errors of `8u` have weights
//!   that sum to at most 3 in magnitude; `10u` from `P_0 + s A + t B` in `f64`; `3u` from the norm.
//!
//! # What it does not promise
//! That no other point is closer by more than a bound known beforehand: thin triangles and nearly parallel
//! edges leave equations of bad condition. Whoever needs a bound takes it from a direction `d`: the distance
//! is at least the least of `d . P_i / |d|`, whatever `d` is (`support`).
//!
//! # Method
//! The closest point of each edge and the foot of the perpendicular are the candidates \[Ericson05\], and the
//! closest of them wins. The foot is found in an orthonormal frame of the polygon and then twice corrected
//! from where it was found: the correction is proportional to what is left, so that a frame turned by an
//! angle `e` leaves `e^2` of the height, and not `e` of the size. Likely directions are the normal and, for
//! each edge, the vector to its closest point, made perpendicular to it.

use glam::DVec3;

/// Bound of the error of a computed distance, relative to the size of the motion: 37u, rounded up to 40u.
pub(super) const ROUNDING: f64 = 20.0 * f64::EPSILON;

/// Corrections of the foot of the perpendicular. The first leaves the square of the frame's error, the second
/// is spare.
const CORRECTIONS: usize = 2;

/// Four edges and a normal.
pub(super) const MOST_DIRECTIONS: usize = 5;

/// Parameters of the corners of a triangle (or segment), and of a parallelogram.
const TRIANGLE: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// A polygon at one time.
pub(super) struct Polygon<const K: usize> {
    corners: [DVec3; K],
    along: [DVec3; 2],
    frame: Option<Frame>,
}

/// A point of a polygon.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// Parameters `s`, `t`.
    pub(super) parameters: [f64; 2],
    /// Where it is, relative to the origin.
    pub(super) place: DVec3,
    /// The length of that.
    pub(super) distance: f64,
}

/// An orthonormal frame of the polygon's plane, whose first vector is along the longer of `A` and `B`.
#[derive(Clone, Copy)]
struct Frame {
    /// Which of `A`, `B` is the longer, and the lengths of it and of the other's part across.
    longer: usize,
    length: f64,
    across: f64,
    /// Part of the other along the longer.
    skew: f64,
    axes: [DVec3; 2],
}

impl Frame {
    fn new(along: [DVec3; 2]) -> Option<Self> {
        let lengths = along.map(length);
        let longer = usize::from(lengths[1] > lengths[0]);
        let (long, other) = (along[longer], along[1 - longer]);
        let first = unit(long)?;
        let mut rest = other - first * other.dot(first);
        // Cancellation leaves a part along the first: taken away again.
        rest -= first * rest.dot(first);
        let second = unit(rest)?;
        Some(Self {
            longer,
            length: lengths[longer],
            across: length(rest),
            skew: other.dot(first),
            axes: [first, second],
        })
    }

    /// Steps of the parameters from `place` to the foot of the perpendicular.
    fn step(&self, place: DVec3) -> [f64; 2] {
        let other = -place.dot(self.axes[1]) / self.across;
        let longer = (-place.dot(self.axes[0]) - other * self.skew) / self.length;
        if self.longer == 0 { [longer, other] } else { [other, longer] }
    }
}

impl<const K: usize> Polygon<K> {
    pub(super) fn new(corners: [DVec3; K]) -> Self {
        let along = [corners[1] - corners[0], if K > 2 { corners[K - 1] - corners[0] } else { DVec3::ZERO }];
        let frame = if K > 2 { Frame::new(along) } else { None };
        Self { corners, along, frame }
    }

    /// The unit normal, `A x B`; for a segment of the plane its normal there. None where rounding leaves no
    /// direction.
    pub(super) fn normal(&self) -> Option<DVec3> {
        if K == 2 {
            let along = unit(self.along[0])?;
            return Some(DVec3::new(-along.y, along.x, 0.0));
        }
        let frame = self.frame?;
        let normal = unit(frame.axes[0].cross(frame.axes[1]))?;
        Some(if frame.longer == 0 { normal } else { -normal })
    }

    /// The sine of the angle between `A` and `B`; one for a segment.
    pub(super) fn sine(&self) -> f64 {
        if K == 2 {
            1.0
        } else {
            self.frame.map_or(0.0, |f| f.across / length(DVec3::new(f.skew, f.across, 0.0)))
        }
    }

    /// The closest point, and directions along which the polygon is likely to be away from the origin: that
    /// of each edge, and the normal.
    pub(super) fn closest(&self) -> (Spot, [Option<DVec3>; MOST_DIRECTIONS]) {
        let mut directions = [None; MOST_DIRECTIONS];
        let mut best: Option<Spot> = None;
        let edges = if K == 2 { 1 } else { K };
        for (i, direction) in directions.iter_mut().enumerate().take(edges) {
            let (spot, across) = self.closest_on_edge(i);
            *direction = unit(across);
            if best.is_none_or(|b| spot.distance < b.distance) {
                best = Some(spot);
            }
        }
        directions[MOST_DIRECTIONS - 1] = self.normal();
        let best = best.unwrap_or_else(|| self.spot([0.0; 2]));
        let best = match self.foot() {
            Some(foot) if foot.distance < best.distance => foot,
            _ => best,
        };
        (best, directions)
    }

    /// The longer of `A` and `B`.
    pub(super) fn longer_edge(&self) -> DVec3 {
        let [a, b] = self.along;
        if length(b) > length(a) { b } else { a }
    }

    /// The closest point of edge `i`, and the vector to it made perpendicular to the edge if it is inside of
    /// it.
    fn closest_on_edge(&self, i: usize) -> (Spot, DVec3) {
        let j = (i + 1) % K;
        let (from, to) = (self.corners[i], self.corners[j]);
        let along = to - from;
        let length = length(along);
        let direction = if length > 0.0 { along / length } else { DVec3::ZERO };
        let parameter = on_grid(-from.dot(direction) / direction.length_squared() / length);
        let ends = [i, j].map(parameters_of_corner::<K>);
        let spot = self.spot([0, 1].map(|k| ends[0][k] + parameter * (ends[1][k] - ends[0][k])));
        let inside = parameter > 0.0 && parameter < 1.0;
        let place = from + along * parameter;
        let across = match parameter {
            _ if inside => place - direction * (place.dot(direction) / direction.length_squared()),
            1.0 => to,
            _ => from,
        };
        (spot, across)
    }

    /// The foot of the perpendicular from the origin, if it lies in the polygon.
    fn foot(&self) -> Option<Spot> {
        let frame = self.frame?;
        let mut parameters = [0.0; 2];
        for _ in 0..=CORRECTIONS {
            let step = frame.step(self.place(parameters));
            parameters = [parameters[0] + step[0], parameters[1] + step[1]];
        }
        let [s, t] = parameters;
        let inside = s >= 0.0 && t >= 0.0 && if K == 3 { s + t <= 1.0 } else { s <= 1.0 && t <= 1.0 };
        inside.then(|| {
            let (s, t) = (on_grid(s), on_grid(t));
            self.spot([s, if K == 3 { t.min(1.0 - s) } else { t }])
        })
    }

    fn place(&self, [s, t]: [f64; 2]) -> DVec3 {
        self.corners[0] + self.along[0] * s + self.along[1] * t
    }

    fn spot(&self, parameters: [f64; 2]) -> Spot {
        let place = self.place(parameters);
        Spot { parameters, place, distance: length(place) }
    }
}

fn parameters_of_corner<const K: usize>(i: usize) -> [f64; 2] {
    if K == 4 { SQUARE[i] } else { TRIANGLE[i] }
}

/// The nearest multiple of 2^-52 in [0, 1]; 0 for NaN.
fn on_grid(parameter: f64) -> f64 {
    if parameter >= 1.0 {
        1.0
    } else if parameter > 0.0 {
        (parameter + 1.0) - 1.0
    } else {
        0.0
    }
}

/// The length of a vector, without underflow.
pub(crate) fn length(v: DVec3) -> f64 {
    let size = v.abs().max_element();
    if size == 0.0 { 0.0 } else { size * (v / size).length() }
}

/// The unit vector along `v`, unless that is zero.
pub(crate) fn unit(v: DVec3) -> Option<DVec3> {
    let size = v.abs().max_element();
    let v = v / size;
    v.is_finite().then(|| v / v.length())
}
