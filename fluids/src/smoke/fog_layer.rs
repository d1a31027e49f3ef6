//! Sheets of smoke as layers of a thickness: [`FogLayer`].
//!
//! # What it computes
//! A surface without boundary for the renderer. Each component with a boundary is the upper side of a layer
//! \[Brochu12, section 5.5.2\]: its lower side is a copy of it, turned over and displaced by the thickness, and along the boundary both
//! are joined by a wall. Components without boundary stay as they are.
//!
//! # What it promises
//! * Closed and consistently oriented, whatever the sheet looks like; vertices and triangles that were there keep their ids and bits,
//!   new ones come behind them.
//! * A vertex of the lower side has the age of the one above it.
//! * The volume of the layer below a plane patch is area times thickness, up to rounding. Below a curved one, with displacements along
//!   its normals, it is that of the layer below the smooth surface with an error of order two in the edge length: normals are exact
//!   on a sphere, also at the boundary.
//! * All lengths and the thickness times a power of two: the same bits, scaled.
//!
//! # What it does not promise
//! That the layer is free of intersections. Where the sheet is bent more sharply than the thickness, or folded, sides cross; what is
//! smoke there is told by `volume_rendering::InteriorRule`. A vertex whose triangles have no area is displaced along no normal, and
//! the layer is thin there.
//!
//! # Method
//! Normals at vertices by the weights of \[Max99\]. At the boundary a fan is open, and its mean lags half an edge behind; so the normals
//! of the neighbours inside are mirrored there, each in the middle plane of its edge, as is exact on circles and spheres.
//!
//! # Complexity
//! Near linear in the triangles.

use glam::DVec3;
use thiserror::Error;
use welter_meshing::surface::{ClosedOrientedMesh, Topology, TriMesh, TriMeshError, TriangleSoup, VertexId};

/// How sheets become layers.
///
/// ```
/// use glam::DVec3;
/// use welter_fluids::smoke::FogLayer;
/// use welter_meshing::surface::{TriMesh, TriangleSoup, measure::signed_volume};
///
/// let positions = vec![DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
/// let square = TriangleSoup { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..TriangleSoup::default() };
/// let layer = FogLayer::new(0.25).close(&TriMesh::new(square)?, &[0.0, 1.0, 2.0, 3.0])?;
/// assert_eq!(signed_volume(&layer.surface), 0.25);
/// assert_eq!(layer.ages[4..], [0.0, 1.0, 2.0, 3.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FogLayer {
    /// Distance from the upper to the lower side, above 0 and finite; a length of the scene. Not relative to the edges of the surface:
    /// these grow where a run meets its budget of triangles, and the layer would grow with them. There is no default.
    pub thickness: f64,
    /// Where the lower side is, as seen from the upper one, any length but zero; a direction against the upper side, or the layer is inside
    /// out. None: against the normals, so that the layer is equally thick everywhere. Default: none.
    pub direction: Option<DVec3>,
}

/// A surface without boundary that encloses smoke, and what it carries.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedSmoke {
    /// The surface.
    pub surface: ClosedOrientedMesh,
    /// The age of each vertex; empty if none were given.
    pub ages: Vec<f64>,
}

/// Why there is no layer.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum FogLayerError {
    /// The thickness is out of range.
    #[error("the thickness of a layer is {thickness}, must be finite and above 0")]
    Thickness {
        /// What was given.
        thickness: f64,
    },
    /// The direction is none.
    #[error("({}, {}, {}) gives no direction from the upper to the lower side", direction.x, direction.y, direction.z)]
    Direction {
        /// What was given.
        direction: DVec3,
    },
    /// There is not one age a vertex.
    #[error("{ages} ages for {vertices} vertices; there must be one a vertex, or none at all")]
    AgeCount {
        /// Vertices of the surface.
        vertices: usize,
        /// Ages given.
        ages: usize,
    },
    /// Triangles at an edge have different sides up.
    #[error("at {edges} edges triangles are turned over, the first from vertex {} to {}", first[0].0, first[1].0)]
    NotOriented {
        /// How many such edges there are.
        edges: usize,
        /// The ends of the first.
        first: [VertexId; 2],
    },
    /// The lower side leaves the range of numbers, or there are too many vertices.
    #[error("the lower side: {0}")]
    OutOfRange(#[from] TriMeshError),
}

impl FogLayer {
    /// A layer of a thickness, measured along the normals.
    #[must_use]
    pub fn new(thickness: f64) -> Self {
        Self { thickness, direction: None }
    }

    /// Whether both numbers are in range.
    ///
    /// # Errors
    /// [`FogLayerError::Thickness`] or [`FogLayerError::Direction`].
    pub fn validate(&self) -> Result<(), FogLayerError> {
        let thickness = self.thickness;
        if !(thickness > 0.0 && thickness.is_finite()) {
            return Err(FogLayerError::Thickness { thickness });
        }
        match self.direction {
            Some(direction) if unit(direction).is_none() => Err(FogLayerError::Direction { direction }),
            _ => Ok(()),
        }
    }

    /// A surface with all its sheets as layers. `ages` has one number a vertex, or none at all.
    ///
    /// # Errors
    /// [`FogLayerError`] for parameters, ages or a surface that make no layer.
    pub fn close(&self, mesh: &TriMesh, ages: &[f64]) -> Result<ClosedSmoke, FogLayerError> {
        self.validate()?;
        let vertices = mesh.positions().len();
        if !ages.is_empty() && ages.len() != vertices {
            return Err(FogLayerError::AgeCount { vertices, ages: ages.len() });
        }
        let topology = Topology::of(mesh);
        if let Some(&first) = topology.inconsistent_edges().first() {
            let (edges, first) = (topology.inconsistent_edges().len(), topology.edges()[first.index()]);
            return Err(FogLayerError::NotOriented { edges, first });
        }
        let sheets = Sheets::of(mesh, &topology);
        let displacements = match self.direction.and_then(unit) {
            Some(direction) => vec![self.thickness * direction; vertices],
            None => sheets.normals(mesh, &topology).into_iter().map(|n| -self.thickness * n).collect(),
        };
        let mut soup = mesh.to_soup();
        let mut ages = ages.to_vec();
        let mut below = vec![u32::MAX; vertices];
        for v in sheets.vertices(mesh) {
            below[v] = soup.positions.len() as u32;
            soup.positions.push(mesh.positions()[v] + displacements[v]);
            if !ages.is_empty() {
                ages.push(ages[v]);
            }
        }
        sheets.close(mesh, &below, &mut soup);
        let surface = ClosedOrientedMesh::new(TriMesh::new(soup)?)
            .expect("each edge of the boundary has a wall, and all others as many triangles on either side");
        Ok(ClosedSmoke { surface, ages })
    }
}

/// The components of a surface that have a boundary.
struct Sheets {
    /// Their triangles, ascending.
    triangles: Vec<[usize; 3]>,
    /// The edges of their boundaries, each the way its triangle goes.
    boundary: Vec<[usize; 2]>,
}

impl Sheets {
    fn of(mesh: &TriMesh, topology: &Topology) -> Self {
        let corners = |t: usize| mesh.triangles()[t].map(|v| v.index());
        let open: Vec<bool> = topology.components().iter().map(|component| !component.closed).collect();
        let of_sheet = |t: usize| open[topology.component_of(welter_meshing::surface::TriId::from_index(t))];
        let triangles = (0..mesh.triangles().len()).filter(|&t| of_sheet(t)).map(corners).collect();
        let mut boundary = Vec::new();
        for (e, &[a, b]) in topology.edges().iter().enumerate() {
            let (a, b) = (a.index(), b.index());
            let mut surplus = 0_i32;
            for t in topology.edge_triangles(welter_meshing::surface::EdgeId::from_index(e)) {
                let [i, j, k] = corners(t.index());
                let forward = [[i, j], [j, k], [k, i]].contains(&[a, b]);
                surplus += if forward { 1 } else { -1 };
            }
            match surplus {
                0 => {}
                1 => boundary.push([a, b]),
                _ => boundary.push([b, a]),
            }
        }
        Self { triangles, boundary }
    }

    /// All vertices of sheets, ascending.
    fn vertices(&self, mesh: &TriMesh) -> impl Iterator<Item = usize> + use<> {
        let mut used = vec![false; mesh.positions().len()];
        self.triangles.iter().flatten().for_each(|&v| used[v] = true);
        used.into_iter().enumerate().filter_map(|(v, used)| used.then_some(v))
    }

    /// Adds lower sides and walls.
    fn close(&self, mesh: &TriMesh, below: &[u32], soup: &mut TriangleSoup) {
        let first = soup.triangles.len();
        soup.triangles.extend(self.triangles.iter().map(|&[a, b, c]| [below[a], below[c], below[b]]));
        for &[a, b] in &self.boundary {
            soup.triangles.push([b as u32, a as u32, below[a]]);
            soup.triangles.push([b as u32, below[a], below[b]]);
        }
        debug_assert_eq!(first, mesh.triangles().len());
    }

    /// A unit vector at each vertex of a sheet, zero where its triangles have no area.
    fn normals(&self, mesh: &TriMesh, topology: &Topology) -> Vec<DVec3> {
        // A power of two, so that products of edges stay in range and scaled surfaces have the same normals.
        let longest = self.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let edge = |[a, b]: [usize; 2]| mesh.positions()[b] * 0.5 - mesh.positions()[a] * 0.5;
        let longest = longest.fold(0.0_f64, |longest, ends| longest.max(edge(ends).abs().max_element()));
        let (_, exponent) = libm::frexp(longest);
        let scale = libm::ldexp(1.0, (-exponent).clamp(-1022, 1023));
        let edge = |a: usize, b: usize| edge([a, b]) * scale;

        let mut sums = vec![DVec3::ZERO; mesh.positions().len()];
        for &[a, b, c] in &self.triangles {
            for [at, next, last] in [[a, b, c], [b, c, a], [c, a, b]] {
                let (to_next, to_last) = (edge(at, next), edge(at, last));
                let weighted = to_next.cross(to_last) / (to_next.length_squared() * to_last.length_squared());
                if weighted.is_finite() {
                    sums[at] += weighted;
                }
            }
        }
        let mut normals: Vec<DVec3> = sums.into_iter().map(|sum| unit(sum).unwrap_or(DVec3::ZERO)).collect();

        let mut at_boundary = vec![false; normals.len()];
        self.boundary.iter().flatten().for_each(|&v| at_boundary[v] = true);
        let mut mirrored = vec![DVec3::ZERO; normals.len()];
        for &[a, b] in topology.edges() {
            for [to, from] in [[a.index(), b.index()], [b.index(), a.index()]] {
                if at_boundary[to]
                    && !at_boundary[from]
                    && let Some(along) = unit(edge(from, to))
                {
                    let normal = normals[from];
                    mirrored[to] += normal - 2.0 * normal.dot(along) * along;
                }
            }
        }
        for (normal, mirrored) in normals.iter_mut().zip(mirrored) {
            if let Some(mirrored) = unit(mirrored) {
                *normal = mirrored;
            }
        }
        normals
    }
}

/// The unit vector along a vector, without overflow; none of zero, or of what is not finite.
fn unit(v: DVec3) -> Option<DVec3> {
    let v = v / v.abs().max_element();
    let v = v / v.length();
    v.is_finite().then_some(v)
}
