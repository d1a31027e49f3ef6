//! What to draw: [`Scene`] and its parts, and why it can be refused: [`RenderError`].

use super::color::Rgb;
use super::color_map::ColorMap;
use glam::DVec3;
use welter_meshing::surface::{TriId, TriMesh, VertexId};

/// Pictures wider or taller than this are refused.
pub(crate) const MAX_SIDE: u32 = 16_384;

/// Surfaces, a viewpoint and the sheet they are drawn on.
#[derive(Clone, Debug)]
pub(crate) struct Scene<'a> {
    /// Surfaces; they hide and shade each other.
    pub(crate) layers: Vec<Layer<'a>>,
    /// From where.
    pub(crate) camera: Camera,
    /// Which coordinate axis points up in the picture.
    pub(crate) up: Up,
    /// Width and height in pixels, each in `1..=MAX_SIDE`.
    pub(crate) size: [u32; 2],
    /// What is seen behind the surfaces.
    pub(crate) background: Background,
    /// Removes what lies on the viewer's side of a coordinate plane.
    pub(crate) cut: Option<Cut>,
    /// A soft shadow on a floor below the surfaces (only seen from above).
    pub(crate) floor: bool,
    /// Text in the lower left corner; empty for none.
    pub(crate) caption: Caption,
    /// Samples a pixel along each axis, in `1..=4`.
    pub(crate) samples: u32,
    /// Bytes that the estimate of memory must not pass.
    pub(crate) max_memory: u64,
}

impl Default for Scene<'_> {
    fn default() -> Self {
        Self {
            layers: Vec::new(),
            camera: Camera::Automatic,
            up: Up::Automatic,
            size: [1200, 900],
            background: Background::default(),
            cut: None,
            floor: true,
            caption: Caption::default(),
            samples: 3,
            max_memory: 8 << 30,
        }
    }
}

/// One surface and how it looks.
#[derive(Clone, Debug)]
pub(crate) struct Layer<'a> {
    /// Vertex positions, finite.
    pub(crate) positions: &'a [DVec3],
    /// Triangles, indices into `positions`.
    pub(crate) triangles: &'a [[VertexId; 3]],
    /// Colour of the surface.
    pub(crate) paint: Paint<'a>,
    /// Triangles drawn in the accent colour and seen through the others; any order, repeats allowed.
    pub(crate) highlighted: &'a [TriId],
    /// Everything else.
    pub(crate) style: Style,
}

impl<'a> Layer<'a> {
    /// A mesh in the default style.
    pub(crate) fn of(mesh: &'a TriMesh) -> Self {
        Self {
            positions: mesh.positions(),
            triangles: mesh.triangles(),
            paint: Paint::Plain,
            highlighted: &[],
            style: Style::default(),
        }
    }
}

/// Colour of a surface's front.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Paint<'a> {
    /// `Style::front`.
    Plain,
    /// A colour a triangle.
    Triangles(&'a [[u8; 3]]),
    /// A number a vertex, interpolated; see [`Field`].
    #[allow(dead_code)] // for the commands that compute fields
    VertexField(Field<'a>),
    /// A number a triangle.
    #[allow(dead_code)] // for the commands that compute fields
    TriangleField(Field<'a>),
}

/// Numbers shown through a colour map. Values outside `range` take the end colours; NaN is drawn grey.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field<'a> {
    /// A value a vertex or a triangle.
    pub(crate) values: &'a [f64],
    /// Values that take the first and the last colour; `None`: smallest and largest finite value.
    pub(crate) range: Option<[f64; 2]>,
    /// Colours.
    pub(crate) map: ColorMap,
}

/// Look of one surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Style {
    /// Smooth or flat.
    pub(crate) shading: Shading,
    /// Colour of the side that the triangle normals point to.
    pub(crate) front: Rgb,
    /// Colour of the other side.
    pub(crate) back: Rgb,
    /// Colour of highlighted triangles.
    pub(crate) accent: Rgb,
    /// Triangle edges as thin lines.
    pub(crate) edges: Option<Edges>,
    /// How much of the surface behind a triangle it hides, in (0, 1]; highlighted triangles are always opaque.
    pub(crate) opacity: f64,
    /// How strongly highlighted triangles show through what hides them, in [0, 1].
    pub(crate) see_through: f64,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            shading: Shading::Smooth { crease_degrees: 60.0 },
            front: Rgb::of_bytes([229, 219, 200]),
            back: Rgb::of_bytes([112, 150, 180]),
            accent: Rgb::of_bytes([222, 76, 20]),
            edges: None,
            opacity: 1.0,
            see_through: 0.55,
        }
    }
}

/// How normals vary over a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shading {
    /// One normal a triangle.
    Flat,
    /// Corner normals averaged, by angle, over the neighbours whose normal differs by less than the crease angle.
    Smooth {
        /// In degrees; 180 smooths everything.
        crease_degrees: f64,
    },
}

/// Lines along triangle edges. They fade where triangles are too small for lines to tell them apart.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edges {
    /// Line colour.
    pub(crate) color: Rgb,
    /// Width in pixels of the line between two triangles.
    pub(crate) width: f64,
    /// In [0, 1].
    pub(crate) opacity: f64,
    /// Which sides of each triangle are drawn, by the opposite corner: two triangles can stand for a quadrilateral.
    pub(crate) sides: [bool; 3],
}

impl Default for Edges {
    fn default() -> Self {
        Self { color: Rgb::of_bytes([38, 45, 56]), width: 1.1, opacity: 0.6, sides: [true; 3] }
    }
}

/// From where the scene is seen. Perspective, 30 degrees across the shorter side of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Camera {
    /// A three-quarter view from above, the longest horizontal extent across the picture, fitted to the frame.
    #[default]
    Automatic,
    /// On a sphere around the middle of the bounding box.
    Orbit {
        /// Degrees around the up axis; 0 looks from +z where y is up, from -y where z is up; positive turns the eye
        /// to the right.
        azimuth: f64,
        /// Degrees above the horizon, clamped to [-90, 90].
        elevation: f64,
        /// From the middle of the bounding box in the units of the mesh; `None` fits the frame.
        distance: Option<f64>,
    },
}

/// The axis that points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Up {
    /// Z for surfaces much flatter along z than along y, else y.
    #[default]
    Automatic,
    /// +y, the habit of animation.
    Y,
    /// +z, the habit of engineering.
    Z,
}

/// A vertical gradient.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Background {
    /// Upper edge.
    pub(crate) top: Rgb,
    /// Lower edge.
    pub(crate) bottom: Rgb,
}

impl Default for Background {
    fn default() -> Self {
        Self { top: Rgb::of_bytes([241, 242, 244]), bottom: Rgb::of_bytes([203, 211, 219]) }
    }
}

/// Keeps what lies on the far side of the plane `p[axis] = value`, seen from the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cut {
    /// 0, 1 or 2 for x, y or z.
    pub(crate) axis: usize,
    /// Position of the plane in the units of the mesh.
    pub(crate) value: f64,
}

/// Text in the lower left corner. Characters other than printable ASCII are drawn as `?`, text too long
/// for the picture is cut, and pictures under 160 pixels get none.
#[derive(Clone, Debug, Default)]
pub(crate) struct Caption {
    /// Larger, first line.
    pub(crate) title: String,
    /// Further lines, each with an optional swatch of colour before it.
    pub(crate) lines: Vec<(Option<Rgb>, String)>,
    /// A colour bar between the texts of its ends.
    pub(crate) scale: Option<(ColorMap, [String; 2])>,
}

/// Why a scene is not drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub(crate) enum RenderError {
    /// A side is 0 or larger than [`MAX_SIDE`].
    #[error("a picture of {width} x {height} pixels: each side must be 1 to {MAX_SIDE}")]
    Size {
        /// Asked.
        width: u32,
        /// Asked.
        height: u32,
    },
    /// The picture would need more memory than the caller allows.
    #[error("a picture of {width} x {height} pixels needs about {needed} bytes, {allowed} are allowed")]
    Memory {
        /// Asked.
        width: u32,
        /// Asked.
        height: u32,
        /// Estimate, in bytes.
        needed: u64,
        /// In bytes.
        allowed: u64,
    },
    /// More triangles or vertices than 32-bit ids can name.
    #[error("too many triangles or vertices in one scene")]
    TooManyElements,
    /// A coordinate is infinite or NaN.
    #[error("vertex {vertex} of layer {layer} has a non-finite coordinate")]
    NonFinite {
        /// Index of the layer.
        layer: usize,
        /// Index of the vertex.
        vertex: usize,
    },
    /// A triangle names a vertex that is not there.
    #[error("triangle {triangle} of layer {layer} names a vertex that does not exist")]
    VertexOutOfRange {
        /// Index of the layer.
        layer: usize,
        /// Index of the triangle.
        triangle: usize,
    },
    /// An array has not one entry a vertex or triangle, or a highlighted id is out of range.
    #[error("{what} of layer {layer}: {found} given, {expected} expected")]
    Mismatch {
        /// Which array.
        what: &'static str,
        /// Index of the layer.
        layer: usize,
        /// Its length, or the id.
        found: usize,
        /// Length wanted, or the number of triangles.
        expected: usize,
    },
    /// A parameter is out of its range or not a number.
    #[error("{name} = {value} is out of range: {range}")]
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Allowed values.
        range: &'static str,
    },
    /// Writing the picture failed.
    #[error("writing the picture: {0}")]
    Write(#[from] std::io::Error),
}
