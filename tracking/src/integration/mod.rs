//! Integration: from predicted positions to positions at which the surface does not intersect itself.
//!
//! # What it computes
//! [`resolve`] changes the predicted ends of the vertices, as little as its stages need, so that no two elements touch on the
//! straight ways to them; [`accept`] proves that the surface does not intersect itself there, and moves it.
//!
//! # What it promises
//! * A surface that starts free of self-intersection is so after every step, whatever the ends and the parameters. Final
//!   positions are the rounded numbers themselves; the exact static check of all triangles is passed before they are
//!   accepted.
//! * Ends of which nothing collides, nor is near, are kept bit for bit.
//! * It ends in bounded time. The worst that happens is that vertices stay where they are.
//! * No length is absolute: multiplying positions, ends and the reference length by a power of two multiplies the result, bit for bit,
//!   barring overflow and underflow of coordinates. Far from the origin only coordinates are coarser.
//! * The same bits for any number of threads.
//! * In an error the surface is what it was before, and the broad phase is at rest.
//! * Vertices of infinite mass go to their ends as prescribed: impulses and zones do not touch them. Their motion may be cut with
//!   the step, and they may stay with others that would collide.
//!
//! # What it does not promise
//! * That a motion is the physical one: where impulses and zones fail, safety comes first. The report tells what was needed.
//! * That a broad phase which has not followed the surface is noticed by more than its elements; it must be at rest.
//!
//! # Method
//! Velocity filtering \[Bridson02\] as in \[Brochu12, section 3.2.7, Algorithm 2\], in displacements instead of velocities, with
//! exact continuous collision detection in every stage:
//!
//! 1. elements nearer than a distance repel each other (`proximity`);
//! 2. single impulses, a few sweeps (`impulses`), with friction (`friction`);
//! 3. impact zones, solved at once (`impact_zones`, `least_squares`, `conjugate_gradients`);
//! 4. rigid zones (`rigid_zones`);
//! 5. all of this with half the step, and again; at last what collides stays where it is (`shorter_steps`).
//!
//! # Complexity
//! Without contacts, one descent for proximity, one refreshment and descent for collision, one of each for the check. Each
//! further sweep costs as the vertices that it changed.

mod check;
mod conjugate_gradients;
mod contact;
mod error;
mod free;
mod friction;
mod impact_zones;
mod impulses;
mod least_squares;
mod parameters;
mod proximity;
mod report;
mod rigid_zones;
mod shorter_steps;
mod step;
mod union;

pub use contact::ElementPair;
pub use error::{IntegrationError, Tangle};
pub(crate) use free::is_free;
pub use parameters::IntegrationParameters;
pub use report::IntegrationReport;

use crate::broad_phase::{BroadPhase, Motion};
use crate::surface::MovingSurface;
use glam::DVec3;
use proximity::Proximities;
use step::Step;
use welter_meshing::Monitor;

/// How often a crowded step is shortened; then all vertices stay where they are. The first time brings it to a few edge
/// lengths, so the last one to a sixteenth of one.
const MOST_CROWDS: u32 = 8;

/// Ends that can be reached without a collision.
#[must_use]
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// Where each vertex ends, by vertex id; those of ids not in use stay where they are.
    pub ends: Vec<DVec3>,
    /// The part of the step that these ends are of: in (0, 1], a power of two.
    pub fraction: f64,
    /// What was needed.
    pub report: IntegrationReport,
}

/// Finds ends near the predicted ones that can be reached on straight ways without a collision.
///
/// `ends` are the predicted positions by vertex id, `length` is the reference length of the mesh, such as its mean edge
/// length. The broad phase has followed the surface, at rest; afterwards it holds the motion to the ends, until [`accept`].
///
/// ```
/// use welter_meshing::{DVec3, Monitor, shapes};
/// use welter_tracking::broad_phase::{BroadPhase, Motion};
/// use welter_tracking::integration::{IntegrationParameters, accept, resolve};
/// use welter_tracking::surface::MovingSurface;
///
/// let sphere = shapes::sphere(&shapes::Sphere { edge_length: 0.25, ..Default::default() })?;
/// let mut surface = MovingSurface::new(&sphere)?;
/// let mut broad_phase = BroadPhase::new(&surface, Motion::Rest)?;
/// // The upper half is to go through the lower one.
/// let ends = surface.positions().iter().map(|&p| DVec3::new(p.x, p.y, -2.0 * p.z.max(0.0))).collect();
/// let (parameters, nobody) = (IntegrationParameters::default(), Monitor::none());
/// let resolved = resolve(&surface, &mut broad_phase, ends, 0.25, &parameters, &nobody)?;
/// // None: so many pairs collide on that way that it was shortened at once.
/// assert_ne!(resolved.report.collisions, Some(0));
/// accept(&mut surface, &mut broad_phase, &resolved.ends, &nobody)?;
/// assert!(welter_meshing::spatial::self_intersections(&surface.to_mesh(), &nobody)?.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`IntegrationError`], but never [`IntegrationError::Intersection`]. The broad phase is at rest then.
pub fn resolve(
    surface: &MovingSurface,
    broad_phase: &mut BroadPhase,
    ends: Vec<DVec3>,
    length: f64,
    parameters: &IntegrationParameters,
    monitor: &Monitor<'_>,
) -> Result<Resolved, IntegrationError> {
    parameters.validate()?;
    if !(0.0..=f64::MAX).contains(&length) {
        let range = "a finite length, not below 0";
        return Err(IntegrationError::Parameter { parameter: "length", value: length, range });
    }
    let resolved = integrate(surface, broad_phase, ends, length, parameters, monitor);
    if resolved.is_err() {
        // It fails only for a broad phase that has not followed, which then is as it was.
        let _ = broad_phase.refresh(surface, Motion::Rest);
    }
    resolved
}

/// Algorithm 2 of \[Brochu12\], with shorter steps.
fn integrate(
    surface: &MovingSurface,
    broad_phase: &mut BroadPhase,
    mut ends: Vec<DVec3>,
    length: f64,
    parameters: &IntegrationParameters,
    monitor: &Monitor<'_>,
) -> Result<Resolved, IntegrationError> {
    broad_phase.check_ends(surface, &ends)?;
    broad_phase.check_followed(surface)?;
    if parameters.check_start {
        check::require_embedded(surface, broad_phase, monitor)?;
    }
    for (v, end) in ends.iter_mut().enumerate() {
        if !end.is_finite() {
            *end = surface.positions()[v]; // Of an id that is not in use.
        }
    }
    let proximities = Proximities::find(surface, broad_phase, length, parameters, monitor)?;
    let mut step = Step::new(surface, broad_phase, parameters, monitor);
    step.report.proximities = proximities.len();
    let (mut fraction, mut halvings, mut crowds) = (1.0, 0, 0);
    loop {
        step.begin(shorter_steps::shortened(surface, &ends, fraction));
        proximity::repel(&mut step, &proximities);
        step.detect()?;
        if step.report.shortenings == 0 {
            step.report.collisions = (!step.is_crowded()).then_some(step.colliding().len());
        }
        if step.is_crowded() && crowds < MOST_CROWDS {
            crowds += 1;
            let cut = shorter_steps::fraction_of_a_few_lengths(surface, &ends, length, fraction);
            fraction = cut.min(0.5 * fraction);
            step.report.shortenings += 1;
            continue;
        }
        if !step.is_crowded() {
            impulses::sweep(&mut step)?;
            if step.collides() {
                impact_zones::solve(&mut step)?;
            }
            if step.collides() {
                rigid_zones::stiffen(&mut step)?;
            }
        }
        if step.collides() && halvings < parameters.most_halvings {
            halvings += 1;
            fraction *= 0.5;
            step.report.shortenings += 1;
            continue;
        }
        if step.collides() {
            shorter_steps::rest(&mut step)?;
        }
        break;
    }
    let (ends, report) = step.into_ends();
    Ok(Resolved { ends, fraction, report })
}

/// Moves the surface to some ends, once it is proven that it does not intersect itself there; then the broad phase is
/// at rest with it.
///
/// Exact, for the numbers as they are, and independent of how they were found. `ends` by vertex id; those of ids not in use do
/// not matter. See [`resolve`] for an example.
///
/// # Errors
/// [`IntegrationError::Intersection`] if it would intersect itself, and others as [`resolve`]. The broad phase is at rest at the
/// positions before, then.
pub fn accept(
    surface: &mut MovingSurface,
    broad_phase: &mut BroadPhase,
    ends: &[DVec3],
    monitor: &Monitor<'_>,
) -> Result<(), IntegrationError> {
    if let Err(error) = check::require_embedded_at(surface, broad_phase, ends, monitor) {
        // As in `resolve`.
        let _ = broad_phase.refresh(surface, Motion::Rest);
        return Err(error);
    }
    place(surface, ends);
    Ok(())
}

/// Moves the surface to ends that can be reached without a collision, as [`resolve`] and [`is_free`] find them, without the static
/// check: for positions that are none that a step ends with. The broad phase is at rest then.
pub(crate) fn pass_through(
    surface: &mut MovingSurface,
    broad_phase: &mut BroadPhase,
    ends: &[DVec3],
) -> Result<(), IntegrationError> {
    broad_phase.refresh(surface, Motion::At(ends))?;
    place(surface, ends);
    Ok(())
}

fn place(surface: &mut MovingSurface, ends: &[DVec3]) {
    let vertices: Vec<_> = surface.connectivity().vertices().collect();
    for v in vertices {
        surface
            .set_position(v, ends[v.index()])
            .expect("the broad phase has refused ends that are not finite");
    }
}
