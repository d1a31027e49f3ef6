//! Surfaces that are released over time: [`Emission`].
//!
//! # What it computes
//! For each release of a [`Schedule`] the shape, displaced to where the emitter is at that time. A closed shape encloses smoke; an
//! open one is the upper side of a layer that is given its depth when it is drawn \[Brochu12, section 5.5.2\].
//!
//! # What it promises
//! * A shape that was accepted is one that smoke can be made of: a closed one has a positive volume, beyond the error bound of its
//!   computation; an open one has an edge, one or two triangles at each edge, and the same side up everywhere.
//! * What is released differs from the shape by its displacement alone: ids stay, and without a path so do the bits.
//!
//! # What it does not promise
//! That a closed shape does not intersect itself: `welter_meshing::surface::EmbeddedMesh` proves that, for a run that needs it.

use glam::DVec3;
use thiserror::Error;
use welter_meshing::surface::measure::signed_volume_bounded;
use welter_meshing::surface::{ClosedOrientedError, ClosedOrientedMesh, Topology, TriMesh, TriMeshError};
use welter_predicates::Sign;

use super::{Release, Schedule};
use crate::procedural::Path;

/// What is released.
#[derive(Clone, Debug, PartialEq)]
pub enum EmittedShape {
    /// A surface that encloses smoke.
    Closed(ClosedOrientedMesh),
    /// A sheet, the upper side of a layer.
    Open(TriMesh),
}

impl EmittedShape {
    /// The surface.
    #[must_use]
    pub fn mesh(&self) -> &TriMesh {
        match self {
            Self::Closed(mesh) => mesh.as_mesh(),
            Self::Open(mesh) => mesh,
        }
    }
}

/// What becomes of a release and smoke that it meets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Joining {
    /// It is a component of its own; where components overlap there is smoke of both.
    #[default]
    Separate,
    /// It becomes one with smoke that it overlaps, their union, and with what it comes to touch later, where the tracker merges.
    /// Closed shapes only.
    Merged,
}

/// Surfaces that are released over time. All vertices of a release have the age zero at its time.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::procedural::{Interpolation, Path};
/// use welter_fluids::smoke::{Emission, EmittedShape, Joining, Schedule};
/// use welter_meshing::shapes::{Sphere, sphere};
///
/// let puff = sphere(&Sphere { radius: 0.25, edge_length: 0.1, ..Sphere::default() })?;
/// let emission = Emission {
///     shape: EmittedShape::Closed(puff),
///     schedule: Schedule { start: 0.0, interval: 0.5, count: Some(4) },
///     joining: Joining::Separate,
///     path: Some(Path::new(vec![(0.0, DVec3::ZERO), (2.0, DVec3::X)], Interpolation::Linear)?),
/// };
/// emission.validate()?;
/// for release in emission.schedule.within(0.9, 1.1) {
///     let surface = emission.released(release)?;
///     assert_eq!(surface.mesh().positions()[0], emission.shape.mesh().positions()[0] + 0.5 * DVec3::X);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Emission {
    /// What is released.
    pub shape: EmittedShape,
    /// When.
    pub schedule: Schedule,
    /// What becomes of it.
    pub joining: Joining,
    /// The displacement of the emitter over time; none if it rests.
    pub path: Option<Path>,
}

/// Why an emission is refused.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum EmissionError {
    /// A parameter is out of range.
    #[error("{name} is {value}, must be {must}")]
    Parameter {
        /// Which parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it has to be.
        must: &'static str,
    },
    /// The shape has no triangle.
    #[error("the shape has no triangle")]
    NoTriangles,
    /// A closed shape is inside out, or so flat that its volume is lost in roundings.
    #[error("the closed shape has a volume of {volume} within {bound}, must be above 0")]
    Volume {
        /// The signed volume.
        volume: f64,
        /// How far the true volume can be.
        bound: f64,
    },
    /// An open shape has no edge with one triangle: it is a closed one.
    #[error("the open shape has no boundary; give it as a closed one")]
    NoBoundary,
    /// An open shape has edges of three or more triangles.
    #[error("the open shape has {edges} edges with more than two triangles")]
    NotManifold {
        /// How many.
        edges: usize,
    },
    /// Neighbouring triangles of an open shape have different sides up.
    #[error("the open shape has {edges} edges across which its triangles are turned over")]
    NotOriented {
        /// How many such edges it has.
        edges: usize,
    },
    /// An open shape cannot be merged: it has no inside.
    #[error("an open shape has no inside, so it cannot be merged")]
    MergedSheet,
    /// A displaced vertex is beyond the range of numbers.
    #[error("displaced by ({}, {}, {}), the shape leaves the range of numbers: {error}",
        displacement.x, displacement.y, displacement.z)]
    Displaced {
        /// The displacement.
        displacement: DVec3,
        /// Which vertices.
        error: TriMeshError,
    },
    /// A displaced closed shape is none.
    #[error("the displaced shape is not closed: {0}")]
    NotClosed(ClosedOrientedError),
}

/// The time of the first release of any emission after a time, up to an end.
pub(crate) fn next_release(emissions: &[Emission], time: f64, end: f64) -> Option<f64> {
    let first = |emission: &Emission| {
        emission.schedule.within(time.next_up(), end.next_up()).next().map(|release| release.time)
    };
    emissions.iter().filter_map(first).reduce(f64::min)
}

impl Emission {
    /// Whether this is an emission of smoke.
    ///
    /// # Errors
    /// [`EmissionError`] for the first thing that is not.
    pub fn validate(&self) -> Result<(), EmissionError> {
        self.schedule.validate()?;
        let mesh = self.shape.mesh();
        if mesh.triangles().is_empty() {
            return Err(EmissionError::NoTriangles);
        }
        match &self.shape {
            EmittedShape::Closed(_) => {
                let volume = signed_volume_bounded(mesh);
                if volume.sign() != Sign::Positive {
                    let (volume, bound) = (volume.value(), volume.error_bound());
                    return Err(EmissionError::Volume { volume, bound });
                }
            }
            EmittedShape::Open(_) if self.joining == Joining::Merged => {
                return Err(EmissionError::MergedSheet);
            }
            EmittedShape::Open(_) => {
                let topology = Topology::of(mesh);
                if !topology.is_edge_manifold() {
                    return Err(EmissionError::NotManifold { edges: topology.non_manifold_edges().len() });
                }
                if !topology.is_oriented() {
                    return Err(EmissionError::NotOriented { edges: topology.inconsistent_edges().len() });
                }
                if topology.is_closed() {
                    return Err(EmissionError::NoBoundary);
                }
            }
        }
        Ok(())
    }

    /// What a release sets free.
    ///
    /// # Errors
    /// [`EmissionError::Displaced`]: the path leads beyond the range of numbers.
    pub fn released(&self, release: Release) -> Result<EmittedShape, EmissionError> {
        let Some(path) = &self.path else { return Ok(self.shape.clone()) };
        let displacement = path.at(release.time);
        let mut soup = self.shape.mesh().to_soup();
        soup.positions.iter_mut().for_each(|position| *position += displacement);
        let mesh = TriMesh::new(soup).map_err(|error| EmissionError::Displaced { displacement, error })?;
        Ok(match self.shape {
            // Closed and oriented by its triangles alone, which are those of the shape.
            EmittedShape::Closed(_) => {
                EmittedShape::Closed(ClosedOrientedMesh::new(mesh).map_err(EmissionError::NotClosed)?)
            }
            EmittedShape::Open(_) => EmittedShape::Open(mesh),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::shapes::{Sphere, sphere};
    use welter_meshing::surface::TriangleSoup;

    fn emission(shape: EmittedShape) -> Emission {
        Emission { shape, schedule: Schedule::default(), joining: Joining::Separate, path: None }
    }

    fn ball() -> ClosedOrientedMesh {
        sphere(&Sphere { radius: 1.0, edge_length: 0.5, ..Sphere::default() }).unwrap()
    }

    fn open(triangles: &[[u32; 3]]) -> EmittedShape {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE, DVec3::NEG_ONE];
        let soup = TriangleSoup { positions, triangles: triangles.to_vec(), ..TriangleSoup::default() };
        EmittedShape::Open(TriMesh::new(soup).unwrap())
    }

    #[test]
    fn closed_shapes_enclose_something() {
        assert!(emission(EmittedShape::Closed(ball())).validate().is_ok());
        let inside_out = emission(EmittedShape::Closed(ball().reversed())).validate();
        assert!(
            matches!(inside_out, Err(EmissionError::Volume { volume, .. }) if volume < -3.0),
            "{inside_out:?}"
        );
        let flat = |mut soup: TriangleSoup| {
            soup.positions.iter_mut().for_each(|p| p.z = 0.25);
            ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap()
        };
        let flat = emission(EmittedShape::Closed(flat(ball().as_mesh().to_soup()))).validate();
        assert!(matches!(flat, Err(EmissionError::Volume { .. })), "{flat:?}");
        // Also where the volume itself is below the smallest number.
        let mut soup = ball().as_mesh().to_soup();
        soup.positions.iter_mut().for_each(|p| *p *= 1e-150);
        let tiny = ClosedOrientedMesh::new(TriMesh::new(soup).unwrap()).unwrap();
        assert!(emission(EmittedShape::Closed(tiny)).validate().is_ok());
    }

    #[test]
    fn open_shapes_are_sheets() {
        assert!(emission(open(&[[0, 1, 2], [2, 1, 3]])).validate().is_ok());
        let refused = |triangles: &[[u32; 3]]| emission(open(triangles)).validate().unwrap_err();
        assert!(matches!(refused(&[]), EmissionError::NoTriangles));
        assert!(matches!(refused(&[[0, 1, 2], [1, 2, 3]]), EmissionError::NotOriented { edges: 1 }));
        let three = [[0, 1, 2], [2, 1, 3], [1, 2, 4]];
        assert!(matches!(refused(&three), EmissionError::NotManifold { edges: 1 }));
        let closed = emission(EmittedShape::Open(ball().into_mesh())).validate();
        assert!(matches!(closed, Err(EmissionError::NoBoundary)));
        let merged = Emission { joining: Joining::Merged, ..emission(open(&[[0, 1, 2]])) }.validate();
        assert!(matches!(merged, Err(EmissionError::MergedSheet)));
    }

    #[test]
    fn releases_are_displaced_along_the_path() {
        let path = Path::constant(DVec3::splat(0.5)).unwrap();
        for shape in [EmittedShape::Closed(ball()), open(&[[0, 1, 2], [2, 1, 3]])] {
            let release = Release { index: 0, time: 0.0 };
            let resting = emission(shape.clone());
            assert_eq!(resting.released(release).unwrap(), shape);
            let moving = Emission { path: Some(path.clone()), ..resting };
            let released = moving.released(release).unwrap();
            assert_eq!(released.mesh().triangles(), shape.mesh().triangles());
            let pairs = released.mesh().positions().iter().zip(shape.mesh().positions());
            assert!(pairs.into_iter().all(|(&a, &b)| a == b + DVec3::splat(0.5)));
            assert_eq!(matches!(released, EmittedShape::Closed(_)), matches!(shape, EmittedShape::Closed(_)));
        }
        let mut far = TriangleSoup { triangles: vec![[0, 1, 2]], ..TriangleSoup::default() };
        far.positions = vec![DVec3::ZERO, DVec3::X, DVec3::splat(f64::MAX)];
        let far = emission(EmittedShape::Open(TriMesh::new(far).unwrap()));
        let far = Emission { path: Some(Path::constant(DVec3::splat(f64::MAX)).unwrap()), ..far };
        let refused = far.released(Release { index: 0, time: 0.0 });
        assert!(matches!(refused, Err(EmissionError::Displaced { .. })), "{refused:?}");
    }
}
