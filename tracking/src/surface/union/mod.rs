//! The union of a surface and a closed shape: [`MovingSurface::unite`].
//!
//! # What it computes
//! The surface of what lies inside the surface or inside the shape. Both are cut along the curves in which they cross; of the
//! surface what lies outside of the shape remains, of the shape what lies outside of the surface.
//!
//! # What it promises
//! * The result is free of self-intersection, proven by the exact check of all its triangles, if the surface and the shape are.
//! * Every point off the surfaces has the larger of both winding numbers, but for points that roundings of new vertices, or the shift that
//!   the report tells, bring to the other side.
//! * What is not cut and does not lie inside the other keeps its positions, masses and values bit for bit. Values of what is new: see
//!   `inheritance`.
//! * A shape within the surface changes nothing, and what lies within the shape goes; both are told, and no error.
//! * A union that fails returns an error and leaves the surface as it was.
//! * The same bits for any number of threads. With all lengths times a power of two the same connectivity, and the same bits, scaled.
//!
//! # What it does not promise
//! * Triangles of a good shape at the curves: they are as the curves cut them, down to slivers. Remeshing makes them better.
//! * The union with open sheets, which have no inside: a shape that crosses one is refused, and one that lies within the shape stays.
//! * A union where both meet in no general position (at a vertex, along faces in one plane) as it is: the shape is shifted then by
//!   small parts of its edges ([`UnionParameters::shifts`]), and refused if that does not help.
//!
//! # Method
//! As \[Zhou16\]: cut triangles, then choose by winding numbers; but with two sides that are known to be embedded, curves meet only at
//! their ends, and the places of new vertices may be rounded at once and the result checked.
//! 1. Pairs of triangles that meet, exactly (`overlay`).
//! 2. The winding numbers on both sides of the walls that they are of, exactly (`walls`).
//! 3. The points where edges pierce triangles: exactly which, in rounded places (`piercing`).
//! 4. Triangulations of cut triangles, with the segments of the curves as edges (`triangulation`, `refinement`).
//! 5. Which pieces stay, exactly (`selection`).
//! 6. The surface of them (`assembly`), checked; then values (`inheritance`).
//!
//! # Complexity
//! O(n log n) for n triangles of both, most of it for the two searches for intersections; and O(k^2) for k points in one triangle.

mod assembly;
mod error;
mod inheritance;
mod overlay;
mod parameters;
mod patches;
mod piercing;
mod refinement;
mod report;
mod selection;
mod triangulation;
mod walls;

pub use error::{UnionError, UnionObstacle};
pub use parameters::UnionParameters;
pub use report::{UnionOutcome, UnionReport};

use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::spatial::{Box3, self_intersections};
use welter_meshing::surface::{ClosedOrientedMesh, VertexId};

use self::assembly::Assembly;
use self::error::Stop;
use self::overlay::Overlay;
use self::parameters::shift;
use self::piercing::Crossings;
use self::refinement::Refinement;
use self::walls::{Side, Walls};
use super::append::{AppendError, MOST_HALF_EDGES};
use super::{MovingSurface, RadialConnectivity};
use crate::quadric::scale::Scale;

/// What of a shape counts: vertices of triangles, and those.
struct Body {
    positions: Vec<DVec3>,
    triangles: Vec<[VertexId; 3]>,
}

impl Body {
    fn new(shape: &ClosedOrientedMesh) -> Result<Self, UnionError> {
        let connectivity = RadialConnectivity::new(shape)?;
        let mut new = vec![VertexId(u32::MAX); shape.positions().len()];
        let mut positions = Vec::with_capacity(connectivity.vertex_count());
        for v in connectivity.vertices() {
            new[v.index()] = VertexId::from_index(positions.len());
            positions.push(shape.positions()[v.index()]);
        }
        let triangles = shape.triangles().iter().map(|corners| corners.map(|v| new[v.index()])).collect();
        Ok(Self { positions, triangles })
    }

    /// By how much the shape is shifted in an attempt: a part of the mean over all sides of its triangles, added up in their order.
    fn shift(&self, attempt: u32) -> DVec3 {
        if attempt == 0 || self.triangles.is_empty() {
            return DVec3::ZERO;
        }
        let around = Box3::of(self.positions.iter().copied());
        let size = (around.max - around.min).max_element();
        let scale = if size.is_finite() {
            Scale::of_length(size, 1.0)
        } else {
            Scale::of_length((0.5 * around.max - 0.5 * around.min).max_element(), 0.5)
        };
        let side = |a: VertexId, b: VertexId| {
            scale.difference(self.positions[a.index()], self.positions[b.index()]).length()
        };
        let sum: f64 = self.triangles.iter().map(|&[a, b, c]| side(a, b) + side(b, c) + side(c, a)).sum();
        scale.restored(shift(attempt) * (sum / (3.0 * self.triangles.len() as f64)))
    }
}

impl MovingSurface {
    /// Makes the surface that of its union with a shape, which is to be embedded as the surface is. New vertices have unit masses and
    /// values from nothing where they are of the shape, and means of what is there along the curves.
    ///
    /// Unless the shape lies within, the surface is compacted, before and afterwards.
    ///
    /// ```
    /// use welter_meshing::{DVec3, Monitor, shapes::{Sphere, sphere}};
    /// use welter_meshing::surface::measure::signed_volume;
    /// use welter_tracking::surface::{MovingSurface, UnionOutcome, UnionParameters};
    ///
    /// let ball = |x: f64| sphere(&Sphere { center: x * DVec3::X, radius: 1.0, edge_length: 0.2 });
    /// let mut surface = MovingSurface::new(ball(0.0)?.as_mesh())?;
    /// let report = surface.unite(&ball(1.0)?, &UnionParameters::default(), &Monitor::none())?;
    /// assert_eq!(report.outcome, UnionOutcome::Joined);
    /// // Of the second ball all but a lens of both is new: 11/16 of it.
    /// let whole = signed_volume(&surface.to_mesh());
    /// assert!((whole / (27.0 / 12.0 * std::f64::consts::PI) - 1.0).abs() < 0.02);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`UnionError`]; the surface is as it was then.
    pub fn unite(
        &mut self,
        shape: &ClosedOrientedMesh,
        parameters: &UnionParameters,
        monitor: &Monitor<'_>,
    ) -> Result<UnionReport, UnionError> {
        parameters.validate()?;
        let body = Body::new(shape)?;
        let vertices = self.connectivity.vertex_count() + body.positions.len();
        let triangles = self.connectivity.triangle_count() + body.triangles.len();
        require_ids(vertices, triangles)?;
        let mut surface = self.clone();
        let _ = surface.compact();
        let mut obstacle = UnionObstacle::GeneralPosition;
        for attempt in 0..=parameters.shifts {
            let shift = body.shift(attempt);
            match surface.unite_shifted(&body, shift, parameters, monitor) {
                Ok(report) => {
                    let report = UnionReport { shifts: attempt, shift, ..report };
                    if report.outcome != UnionOutcome::Within {
                        *self = surface;
                    }
                    return Ok(report);
                }
                Err(Stop::Degenerate(met)) => obstacle = met,
                Err(Stop::Error(error)) => return Err(error),
            }
        }
        Err(UnionError::Degenerate { shifts: parameters.shifts, obstacle })
    }

    /// One attempt on a compacted surface, which is as it was unless something is added.
    fn unite_shifted(
        &mut self,
        body: &Body,
        shift: DVec3,
        parameters: &UnionParameters,
        monitor: &Monitor<'_>,
    ) -> Result<UnionReport, Stop> {
        let overlay = Overlay::new(self, body, shift)?;
        let meeting = overlay.meeting(shift != DVec3::ZERO, monitor)?;
        let closed = [0, 1].map(|side| overlay.closed(side));
        let sides = [Side::new(&closed[0]), Side::new(&closed[1])];
        let walls = Walls::new(&overlay, &sides)?;
        let crossings = Crossings::new(&overlay, &selection::cutting(&walls, &meeting)?)?;
        let refinement = Refinement::new(&overlay, &crossings)?;
        require_ids(refinement.positions.len(), refinement.pieces.len())?;
        let stays = selection::selected(&overlay, &crossings, &refinement, &walls, &sides)?;
        monitor.check()?;

        let side = |i: usize| overlay.side(refinement.pieces[i].origin);
        let staying = |wanted: usize| (0..stays.len()).filter(move |&i| side(i) == wanted);
        let all = |wanted: usize| staying(wanted).all(|i| stays[i]);
        let mut report = UnionReport {
            outcome: UnionOutcome::Joined,
            shifts: 0,
            shift,
            segments: crossings.segments,
            removed_triangles: 0,
            new_triangles: 0,
            new_vertices: 0,
            added_volume: 0.0,
        };
        if all(0) && staying(1).all(|i| !stays[i]) {
            return Ok(UnionReport { outcome: UnionOutcome::Within, segments: 0, ..report });
        }
        if crossings.segments == 0 && all(0) && all(1) {
            report.outcome = UnionOutcome::Beside;
        }
        let assembly = Assembly::new(&overlay, &crossings, &refinement, &stays)?;
        let after = assembly.connectivity.triangle_count();
        if after > parameters.most_triangles {
            return Err(UnionError::Budget { triangles: after, most: parameters.most_triangles }.into());
        }
        let mesh = assembly.mesh().ok_or(Stop::Degenerate(UnionObstacle::Range))?;
        if !self_intersections(&mesh, monitor)?.is_empty() {
            return Err(Stop::Degenerate(UnionObstacle::Intersection));
        }
        let [kept_vertices, kept_triangles] = assembly.kept();
        report.removed_triangles = overlay.triangles - kept_triangles;
        report.new_triangles = after - kept_triangles;
        report.new_vertices = assembly.connectivity.vertex_count() - kept_vertices;
        report.added_volume = assembly.added_volume();
        assembly.apply(self);
        Ok(report)
    }
}

fn require_ids(vertices: usize, triangles: usize) -> Result<(), AppendError> {
    if triangles > MOST_HALF_EDGES / 3 || vertices >= u32::MAX as usize {
        return Err(AppendError::TooMany { vertices, triangles });
    }
    Ok(())
}
