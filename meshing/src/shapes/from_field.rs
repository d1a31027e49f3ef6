//! Shapes that are surfaces of fields: [`gyroid_ball`], [`text_surface`].
//!
//! Method: marching cubes with vertices on the field, on cubes about as large as the edge length, which is near the mean edge of
//! marching cubes. Where the shape has features smaller than a few edges, the cubes are chosen to resolve them.
//!
//! Does not promise: well-shaped triangles.

use super::error::{MAX_SHAPE_SAMPLES, ShapeError, require, require_length};
use crate::Monitor;
use crate::field::{AnyField, Ball, Caps, Gyroid, Intersection, ScalarField, Text, TextShape};
use crate::grid::{Grid3, Samples};
use crate::isosurface::{MarchingCubes, marching_cubes};
use crate::surface::ClosedOrientedMesh;

/// Side of the cubes over the edge length: the inverse of the mean edge of marching cubes on cubes of side one, measured on the two
/// shapes here at several sizes.
const CUBE_PER_EDGE: f64 = 1.05;

/// Parameters of [`gyroid_ball`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroidBall {
    /// Radius of the ball, at least a quarter of the period. Default: 1.
    pub radius: f64,
    /// Length after which the gyroid repeats. Default: 1.
    pub period: f64,
    /// Width of the blend between the gyroid and the ball, at most a quarter of the period. Default: 0.1.
    pub blend_width: f64,
    /// Mean edge wanted; edges are at most a fifteenth of the period all the same. Default: 0.055.
    pub edge_length: f64,
}

impl Default for GyroidBall {
    fn default() -> Self {
        Self { radius: 1.0, period: 1.0, blend_width: 0.1, edge_length: 0.055 }
    }
}

/// One of the two labyrinths of a gyroid \[Schoen70\] within a ball around the origin. How many components and handles it has depends on
/// the number of periods.
///
/// ```
/// use welter_meshing::shapes::{GyroidBall, gyroid_ball};
/// use welter_meshing::surface::Topology;
/// let mesh = gyroid_ball(&GyroidBall::default())?;
/// assert!(Topology::of(&mesh).is_vertex_manifold());
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range.
pub fn gyroid_ball(parameters: &GyroidBall) -> Result<ClosedOrientedMesh, ShapeError> {
    let &GyroidBall { radius, period, blend_width, edge_length } = parameters;
    require_length("radius", radius)?;
    require_length("period", period)?;
    require_length("edge_length", edge_length)?;
    require(period <= 4.0 * radius, "period", period, "at most four radii")?;
    let blends = (0.0..=0.25 * period).contains(&blend_width);
    require(blends, "blend_width", blend_width, "from 0 to a quarter of the period")?;
    let labyrinth = AnyField::new(Gyroid { period, thickness: 0.0 });
    let ball = AnyField::new(Ball { radius, ..Ball::default() });
    surface(&Intersection { parts: vec![labyrinth, ball], blend_width }, edge_length, period / 15.0)
}

/// Parameters of [`text_surface`].
#[derive(Clone, Debug, PartialEq)]
pub struct TextSurface {
    /// Words, pen and depth. Default: `curl`, four characters without holes, with capitals of height 2, a pen of radius 0.15 and rounded
    /// ends, 0.5 deep.
    pub shape: TextShape,
    /// Mean edge wanted; edges are at most half of the radius of the pen all the same. Default: 0.065.
    pub edge_length: f64,
}

impl Default for TextSurface {
    fn default() -> Self {
        let words = "curl".to_owned();
        let shape = TextShape { words, height: 2.0, pen_radius: 0.15, depth: 0.5, caps: Caps::Rounded };
        Self { shape, edge_length: 0.065 }
    }
}

/// Words as a surface: see [`Text`].
///
/// ```
/// use welter_meshing::field::TextShape;
/// use welter_meshing::shapes::{TextSurface, text_surface};
/// use welter_meshing::surface::Topology;
/// let mut parameters = TextSurface::default();
/// parameters.shape.words = "8".into();
/// let mesh = text_surface(&parameters)?;
/// assert_eq!(Topology::of(&mesh).genus(), Some(2));
/// # Ok::<(), welter_meshing::shapes::ShapeError>(())
/// ```
///
/// # Errors
/// [`ShapeError`] for a parameter out of range, and for words of which nothing is seen.
pub fn text_surface(parameters: &TextSurface) -> Result<ClosedOrientedMesh, ShapeError> {
    require_length("edge_length", parameters.edge_length)?;
    let text = Text::new(&parameters.shape)?;
    surface(&text, parameters.edge_length, 0.5 * parameters.shape.pen_radius)
}

/// The surface of a bounded field.
fn surface(
    field: &impl ScalarField,
    edge_length: f64,
    largest: f64,
) -> Result<ClosedOrientedMesh, ShapeError> {
    let around = field.bounds().expect("fields of shapes have bounds");
    let spacing = CUBE_PER_EDGE * edge_length.min(largest);
    let extent = around.max - around.min;
    // Nodes along a side: one more than cells, the margin of two, and one for the rounding to multiples.
    let samples: f64 = extent.to_array().map(|side| side / spacing + 4.0).iter().product();
    if samples > f64::from(MAX_SHAPE_SAMPLES) {
        return Err(ShapeError::TooManySamples { edge_length, samples });
    }
    let refused = |_| ShapeError::Parameter {
        parameter: "edge_length",
        value: edge_length,
        range: "such that nodes of a grid near the shape have exact coordinates",
    };
    let grid = Grid3::covering(around.min.to_array(), around.max.to_array(), spacing, 1).map_err(refused)?;
    let samples = Samples::of(&grid, field, &Monitor::none()).expect("nobody cancels");
    let marching = MarchingCubes { roots_of: Some(field), ..MarchingCubes::default() };
    let mesh = marching_cubes(&samples, &marching, &Monitor::none()).map_err(|_| ShapeError::Parameter {
        parameter: "size of the shape",
        value: extent.max_element(),
        range: "below 1e75 and of values that are numbers",
    })?;
    Ok(mesh.into_closed_oriented())
}
