//! Proof that a volumetric mesh is right: [`verify`].
//!
//! # What it checks
//! * *Copies*: each cell that the surface does not meet has as many hexahedra as the surface winds around it, and each other cell at least
//!   as many as it winds around any of its corners. The winding numbers are those of [`grid_winding_numbers`](crate::distance::grid_winding_numbers), which the mesher does not use.
//! * *Euler characteristics*: that of each component is half that of the surfaces that bound it, as for every compact 3-manifold.
//! * *Embedding*: whoever walks along the surface stays in the mesh. The hexahedra that hold a triangle have their common sides in
//!   common; in each cell that an edge meets both of its triangles are in one hexahedron; all triangles around a vertex agree on its host.
//!
//! # What it does not check
//! That the boundary is a manifold: a right mesh can have edges with more than two boundary faces. Betti numbers: see
//! [`betti_numbers`](super::betti_numbers).
//!
//! # Method
//! Only the mesh and its hosts are read, nothing of how they were made. Complexity: near linear in cells of the grid, hexahedra and
//! triangles in them.

mod conversion;
mod embedding;
mod euler;
mod windings;

pub use conversion::verify_conversion;
pub(super) use euler::{check as check_euler, place_of};
pub(super) use windings::check as check_copies;

use std::fmt;

use super::VolumeMesh;
use super::pairing::Pairing;
use crate::surface::ClosedOrientedMesh;
use crate::{Cancelled, Monitor};

/// Most findings of one kind that are listed; all are counted.
const MOST_LISTED: usize = 16;

/// Something that is not as it must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Finding {
    /// A cell has another number of hexahedra than the surface winds around it, or fewer than that if the surface meets it.
    Copies {
        /// Index of the cell.
        cell: [u32; 3],
        /// How many hexahedra it has.
        hexahedra: u32,
        /// How often the surface winds around it: at most, if the surface meets the cell.
        winding: i32,
    },
    /// A component's Euler characteristic is not half that of its boundary.
    Euler {
        /// The component.
        component: u32,
        /// Its Euler characteristic.
        characteristic: i64,
        /// That of the surface in it.
        surface: i64,
    },
    /// Triangles of one connected surface lie in different components.
    Torn {
        /// A triangle.
        triangle: u32,
        /// Its component, and that of another triangle of its surface.
        components: [u32; 2],
    },
    /// The hexahedra of a triangle in two neighbouring cells have another side than their common one, or none, in common.
    Side {
        /// The triangle.
        triangle: u32,
        /// The hexahedra.
        hexahedra: [u32; 2],
    },
    /// In a cell that an edge meets its two triangles are in different hexahedra.
    Edge {
        /// The triangles.
        triangles: [u32; 2],
        /// The hexahedra.
        hexahedra: [u32; 2],
    },
    /// A tetrahedron has no positive volume.
    Flat {
        /// The tetrahedron.
        tetrahedron: u32,
    },
    /// A component of hexahedra fell apart in tetrahedra, or became one with another.
    Regrouped {
        /// The component of hexahedra.
        hexahedra: u32,
        /// That of tetrahedra.
        tetrahedra: u32,
    },
    /// Tetrahedra have another Euler characteristic than the hexahedra from which they were made.
    Converted {
        /// The component of hexahedra.
        component: u32,
        /// Its Euler characteristic.
        characteristic: i64,
        /// That of its tetrahedra; 0 if there are none.
        of_tetrahedra: i64,
    },
    /// Triangles around a vertex lie in different hexahedra where the vertex is.
    Vertices {
        /// How many vertices are so.
        count: usize,
    },
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Copies { cell: [i, j, k], hexahedra, winding } => {
                write!(
                    f,
                    "cell ({i}, {j}, {k}) has {hexahedra} hexahedra, the surface winds {winding} times around it"
                )
            }
            Self::Euler { component, characteristic, surface } => write!(
                f,
                "component {component} has Euler characteristic {characteristic}, \
                 its boundary {surface}, which is not twice that"
            ),
            Self::Torn { triangle, components: [a, b] } => {
                write!(f, "triangle {triangle} lies in component {a}, its surface in {b}")
            }
            Self::Side { triangle, hexahedra: [a, b] } => {
                write!(f, "hexahedra {a} and {b} of triangle {triangle} do not have their side in common")
            }
            Self::Edge { triangles: [s, t], hexahedra: [a, b] } => {
                write!(
                    f,
                    "triangles {s} and {t} have an edge in a cell where they are in hexahedra {a} and {b}"
                )
            }
            Self::Flat { tetrahedron } => write!(f, "tetrahedron {tetrahedron} has no positive volume"),
            Self::Regrouped { hexahedra, tetrahedra } => {
                write!(
                    f,
                    "component {hexahedra} of hexahedra is not all of component {tetrahedra} of tetrahedra"
                )
            }
            Self::Converted { component, characteristic, of_tetrahedra } => write!(
                f,
                "component {component} has Euler characteristic {characteristic}, its tetrahedra {of_tetrahedra}"
            ),
            Self::Vertices { count } => write!(f, "{count} vertices have no one host"),
        }
    }
}

/// What was found of one kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Findings<F = Finding> {
    /// How many.
    pub count: u64,
    /// The first of them.
    pub first: Vec<F>,
}

impl<F> Default for Findings<F> {
    fn default() -> Self {
        Self { count: 0, first: Vec::new() }
    }
}

impl<F> Findings<F> {
    /// Whether all is as it must be.
    #[must_use]
    pub fn none(&self) -> bool {
        self.count == 0
    }

    pub(super) fn add(&mut self, finding: F) {
        self.count += 1;
        if self.first.len() < MOST_LISTED {
            self.first.push(finding);
        }
    }

    pub(super) fn merge(lists: impl IntoIterator<Item = Self>) -> Self {
        let mut all = Self::default();
        for list in lists {
            all.count += list.count;
            let room = MOST_LISTED - all.first.len();
            all.first.extend(list.first.into_iter().take(room));
        }
        all
    }
}

/// What was found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[must_use]
pub struct Verification {
    /// Cells with a wrong number of copies.
    pub winding_copies: Findings,
    /// Components of a wrong Euler characteristic.
    pub euler: Findings,
    /// Places where the surface leaves the mesh.
    pub embedding: Findings,
    /// How many cells' copies were compared, apart from those that the surface meets.
    pub cells: u64,
    /// The Euler characteristic of each component.
    pub characteristics: Vec<i64>,
}

impl Verification {
    /// Whether all is as it must be.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.winding_copies.none() && self.euler.none() && self.embedding.none()
    }

    /// Adds what was found when the hexahedra became tetrahedra to the Euler characteristics.
    pub fn add_conversion(&mut self, findings: Findings) {
        self.euler = Findings::merge([std::mem::take(&mut self.euler), findings]);
    }

    /// Everything that was listed.
    pub fn findings(&self) -> impl Iterator<Item = &Finding> {
        [&self.winding_copies, &self.euler, &self.embedding].into_iter().flat_map(|findings| &findings.first)
    }
}

/// Checks a volumetric mesh against its surface.
///
/// ```
/// use welter_meshing::{Monitor, shapes, volumetric::{VolumeParameters, Resolution, mesh_volume, verify}};
/// let surface = shapes::torus(&shapes::Torus::default())?;
/// let parameters = VolumeParameters { resolution: Resolution::ShortestSide(8), ..VolumeParameters::default() };
/// let volume = mesh_volume(&surface, &parameters, &Monitor::none())?;
/// let verification = verify(&surface, &volume, &Monitor::none())?;
/// assert!(verification.passed());
/// assert_eq!(verification.characteristics, [0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Cancelled`] by the monitor.
pub fn verify(
    surface: &ClosedOrientedMesh,
    volume: &VolumeMesh,
    monitor: &Monitor<'_>,
) -> Result<Verification, Cancelled> {
    let (winding_copies, cells) = windings::check(surface, volume, monitor)?;
    let (euler, characteristics) = euler::check(volume, &Pairing::new(surface), monitor)?;
    let embedding = embedding::check(surface, volume, monitor)?;
    Ok(Verification { winding_copies, euler, embedding, cells, characteristics })
}
