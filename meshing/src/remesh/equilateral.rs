//! [`equilateral`]: the driver.

use super::RemeshError;
use super::buckets::MOST_REACHES;
use super::connectivity::Connectivity;
use super::report::RemeshReport;
use super::rounds::LONG_REL;
use super::shape::area_vector;
use super::workpiece::Workpiece;
use crate::field::ScalarField;
use crate::shapes::{MAX_LENGTH, MAX_SHAPE_TRIANGLES, MIN_LENGTH};
use crate::surface::{ClosedOrientedMesh, EmbeddedMesh, TriId, TriMesh, TriangleSoup};
use crate::{DVec3, Monitor};

/// Most triangles that an edge length may ask for.
pub const MOST_TRIANGLES: f64 = MAX_SHAPE_TRIANGLES as f64;

/// Passes over the worst triangles; the stage ends by itself where nothing improves, after about five.
const MOST_IMPROVEMENTS: usize = 12;

/// Area of an equilateral triangle whose sides have length one.
const UNIT_AREA: f64 = 0.433_012_701_892_219_3;

/// Parameters of [`equilateral`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilateral {
    /// Length that edges shall have, positive. Default: 0.05, that of the built-in shapes.
    pub edge_length: f64,
    /// Rounds of split, collapse, flip and smooth; 0 to 1000. Default: 6, after which the sharpest angles of
    /// the benchmark's fields improve no more.
    pub rounds: u32,
    /// Triangles with angles below this are worked at in the end, in radians; 0 to pi/3. Default: pi/6, which
    /// smooth surfaces nearly always reach.
    pub goal_angle: f64,
}

impl Default for Equilateral {
    fn default() -> Self {
        Self { edge_length: 0.05, rounds: 6, goal_angle: std::f64::consts::FRAC_PI_6 }
    }
}

impl Equilateral {
    /// Refuses parameters out of range.
    ///
    /// # Errors
    /// [`RemeshError::Parameter`].
    pub fn validate(&self) -> Result<(), RemeshError> {
        let require = |holds: bool, parameter, value, range| {
            if holds { Ok(()) } else { Err(RemeshError::Parameter { parameter, value, range }) }
        };
        let holds = (MIN_LENGTH..=MAX_LENGTH).contains(&self.edge_length);
        require(holds, "edge_length", self.edge_length, "a length between 1e-75 and 1e75")?;
        require(self.rounds <= 1000, "rounds", f64::from(self.rounds), "at most 1000")?;
        let holds = (0.0..=std::f64::consts::FRAC_PI_3).contains(&self.goal_angle);
        require(holds, "goal_angle", self.goal_angle, "between 0 and pi/3")
    }
}

/// The surface with triangles near equilateral and vertices on the zero set of a field, which may be positive
/// on either side of the surface.
///
/// Closed, oriented, embedded, and of the same topology by the way it is made; angles and lengths are in the
/// report. The surface shall be within about half an edge length of the zero set, as isosurfaces are:
/// vertices from which no zero is found within that stay where they are, and the report counts them.
///
/// ```
/// use welter_meshing::{DVec3, Monitor, remesh::{Equilateral, equilateral}, shapes, surface::EmbeddedMesh};
/// // A ball becomes an ellipsoid.
/// let start = shapes::sphere(&shapes::Sphere { edge_length: 0.7, ..Default::default() })?;
/// let ellipsoid = |p: DVec3| (p / DVec3::new(1.1, 1.0, 0.9)).length() - 1.0;
/// let parameters = Equilateral { edge_length: 0.3, ..Equilateral::default() };
/// let (mesh, report) = equilateral(&EmbeddedMesh::new(start)?, &ellipsoid, &parameters, &Monitor::none())?;
/// assert!(mesh.positions().iter().all(|&p| ellipsoid(p).abs() < 1e-9) && report.off_surface == 0);
/// assert!(report.smallest_angle.to_degrees() > 20.0 && report.edges.near_mean > 0.99);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RemeshError`]: parameters out of range; an edge with more than two triangles or a vertex with several
/// fans; an edge length too small for the coordinates or the area; the monitor.
pub fn equilateral(
    mesh: &EmbeddedMesh,
    surface: &impl ScalarField,
    parameters: &Equilateral,
    monitor: &Monitor<'_>,
) -> Result<(EmbeddedMesh, RemeshReport), RemeshError> {
    parameters.validate()?;
    require_room(mesh, parameters.edge_length)?;
    let connectivity = Connectivity::new(mesh)?;
    let mut piece = Workpiece::new(surface, parameters.edge_length, connectivity, mesh.positions().to_vec());
    let mut report = RemeshReport::default();
    for _ in 0..parameters.rounds {
        let stage = monitor.stage("equilateral triangles", 4);
        report.splits += piece.split_long(&stage)?;
        stage.advance(1);
        report.collapses += piece.collapse_short(&stage)?;
        stage.advance(1);
        report.flips += piece.flip_edges(&stage)?;
        stage.advance(1);
        report.moves += piece.smooth(&stage)?;
        stage.advance(1);
    }
    let stage = monitor.stage("worst triangles", MOST_IMPROVEMENTS as u64);
    let [moved, _] = piece.project_all(&stage)?;
    report.moves += moved;
    let goal = libm::cos(parameters.goal_angle);
    for _ in 0..MOST_IMPROVEMENTS {
        let done = piece.improve_worst(goal, &stage)?;
        report.flips += done.flips;
        report.moves += done.moves;
        report.collapses += done.collapses;
        stage.advance(1);
        if !done.any() {
            break;
        }
    }
    let [moved, off] = piece.project_all(&stage)?;
    report.moves += moved;
    report.off_surface = off;
    report.measure(&piece);
    Ok((finished(&piece), report))
}

/// Refuses edge lengths that coordinates cannot express, and those that ask for too many triangles.
fn require_room(mesh: &TriMesh, edge_length: f64) -> Result<(), RemeshError> {
    let coordinate = mesh.positions().iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let most = MAX_LENGTH.min(MOST_REACHES * edge_length);
    if coordinate > most {
        return Err(RemeshError::TooFar { coordinate, most, edge_length });
    }
    let scaled = |t: usize| area_vector(mesh.corners(TriId::from_index(t)).map(|p| p / edge_length)).length();
    let area: f64 = (0..mesh.triangles().len()).map(scaled).sum::<f64>() / 2.0;
    // A needle of no area is cut too, along its length.
    let longest = |t: usize| {
        let [a, b, c] = mesh.corners(TriId::from_index(t)).map(|p| p / edge_length);
        let side = a.distance(b).max(b.distance(c)).max(c.distance(a));
        if side > LONG_REL { side } else { 0.0 }
    };
    let along: f64 = (0..mesh.triangles().len()).map(longest).sum();
    let triangles = (area / UNIT_AREA).max(along);
    if triangles > MOST_TRIANGLES {
        return Err(RemeshError::TooManyTriangles { edge_length, triangles, most: MOST_TRIANGLES });
    }
    Ok(())
}

fn finished<F: ScalarField>(piece: &Workpiece<'_, F>) -> EmbeddedMesh {
    let (triangles, old) = piece.mesh.compacted();
    let positions: Vec<DVec3> = old.iter().map(|&v| piece.at(v)).collect();
    let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
    let mesh =
        TriMesh::new(soup).expect("finite positions, numbered without gaps, three different ones a triangle");
    EmbeddedMesh::by_construction(ClosedOrientedMesh::by_construction(mesh))
}
