//! Pictures of volumetric meshes cut open: what lies before a plane is taken away, and what is seen then is drawn.
//!
//! Promises: whole hexahedra are taken away, those whose centre lies before the plane. The faces on the cut tell by their colour how far
//! they are from one end of the mesh, along the mesh; where several hexahedra lie on one cell the face is divided among them, so sheets
//! that pass through each other are seen as a pattern of two colours. A mesh of several components has one colour for each.
//! The same bits for any number of threads.
//! Does not promise: which hexahedra hang together at other faces than those that are seen.

mod faces;
mod plane;
mod way;

use crate::codes::Code;
use crate::console::Seconds;
use crate::failure::Failure;
use crate::numbers::{grouped, number};
use crate::picture;
use crate::render::{
    Camera, Caption, ColorMap, Cut, Edges, Image, Layer, Paint, Rgb, Scene, Shading, Style, Up, toward_eye,
};
use crate::run::Run;
use faces::{Face, Faces, Kind};
use welter_meshing::surface::VertexId;
use welter_meshing::volumetric::HexMesh;
use welter_meshing::{Cancelled, DVec3, Monitor};

pub(crate) use plane::through_overlap;

/// What to draw.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cutaway<'a> {
    pub(crate) mesh: &'a HexMesh,
    /// The component of each hexahedron.
    pub(crate) components: &'a [u32],
    /// The plane.
    pub(crate) cut: Cut,
    /// From where; none for a view of the cut at a slant.
    pub(crate) camera: Option<Camera>,
    pub(crate) size: [u32; 2],
    pub(crate) title: &'a str,
}

/// Share of its colour that a face off the cut keeps; the rest is that of a plain surface.
const OFF_THE_CUT: f32 = 0.35;

/// Share of white in the colour of the last of several hexahedra on one cell.
const LIGHTER: f32 = 0.12;

/// Degrees that the view is turned from the front of a cut, and raised.
const SLANT: (f64, f64) = (28.0, 26.0);

/// Degrees above the horizon for a cut seen from above.
const FROM_ABOVE: f64 = 52.0;

/// Draws a mesh cut open.
pub(crate) fn draw(
    view: &Cutaway<'_>,
    run: &Run,
    seconds: &mut Seconds,
    monitor: &Monitor<'_>,
) -> Result<Image, Problem> {
    let sides = DVec3::from_array(view.mesh.grid().cells().map(f64::from));
    let up = Up::Automatic.axis(sides);
    let camera = view.camera.unwrap_or_else(|| at_a_slant(view.cut.axis, up));
    let toward = direction(camera, view.cut.axis, up);
    let seen = run.console.stage(seconds, "cutting open", || -> Result<Seen, Cancelled> {
        let colors = Colors::of(view, monitor)?;
        let faces = Faces::of(view.mesh, view.cut, toward[view.cut.axis] >= 0.0, monitor)?;
        Ok(Seen::of(&faces, &colors, view.mesh))
    })?;
    let scene = Scene {
        // Of the two triangles of a square the common side is not drawn; of a fan the sides to its middle.
        layers: vec![seen.squares.layer([true, false, true]), seen.fans.layer([true, false, false])],
        camera,
        up: if up == DVec3::Z { Up::Z } else { Up::Y },
        size: view.size,
        caption: caption(view, &seen),
        ..Scene::default()
    };
    picture::draw(&scene, run, seconds).map_err(Problem::Failure)
}

/// Why there is no picture.
#[derive(Debug)]
pub(crate) enum Problem {
    Cancelled,
    Failure(Box<Failure>),
}

impl From<Cancelled> for Problem {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl Problem {
    /// As a failure, where nothing asks to stop.
    pub(crate) fn into_failure(self) -> Box<Failure> {
        match self {
            Self::Cancelled => Failure::new(Code::Interrupted, "the picture was not finished"),
            Self::Failure(failure) => failure,
        }
    }
}

/// A camera before the positive side of a cut, turned and raised a little.
fn at_a_slant(axis: usize, up: DVec3) -> Camera {
    let up_axis = if up == DVec3::Z { 2 } else { 1 };
    let (azimuth, elevation) = match axis {
        axis if axis == up_axis => (SLANT.0, FROM_ABOVE),
        0 => (90.0 - SLANT.0, SLANT.1),
        _ => (SLANT.0, SLANT.1),
    };
    Camera::Orbit { azimuth, elevation, distance: None }
}

/// From the middle toward the eye.
fn direction(camera: Camera, axis: usize, up: DVec3) -> DVec3 {
    match camera {
        Camera::Orbit { azimuth, elevation, .. } => {
            toward_eye(up, azimuth.to_radians(), elevation.clamp(-90.0, 90.0).to_radians())
        }
        // The automatic camera depends on what is left: the slanted one stands for it.
        Camera::Automatic => direction(at_a_slant(axis, up), axis, up),
    }
}

fn caption(view: &Cutaway<'_>, seen: &Seen) -> Caption {
    let axis = ["x", "y", "z"][view.cut.axis];
    let mut lines = vec![
        (
            None,
            format!(
                "{} hexahedra of side {}",
                grouped(view.mesh.len() as u64),
                number(view.mesh.grid().spacing())
            ),
        ),
        (None, format!("cut open at {axis} = {}", number(view.cut.value))),
    ];
    if seen.shared > 0 {
        let what = if seen.most == 2 { "two triangles" } else { "triangles" };
        lines.push((
            None,
            format!("{} faces of {what}: as many hexahedra on one cell", grouped(seen.shared as u64)),
        ));
    }
    let scale = seen
        .ends
        .map(|end| (ColorMap::Sequential, ["way through the mesh: 0".to_owned(), format!("{end} cells")]));
    Caption { title: view.title.to_owned(), lines, scale }
}

/// The colour of each hexahedron.
struct Colors<'a> {
    of: Of<'a>,
}

enum Of<'a> {
    Components(&'a [u32]),
    /// Cells from one end, and the largest number.
    Way(Vec<u32>, u32),
}

impl<'a> Colors<'a> {
    fn of(view: &Cutaway<'a>, monitor: &Monitor<'_>) -> Result<Self, Cancelled> {
        let several = view.components.iter().any(|&component| component > 0);
        let of = if several {
            Of::Components(view.components)
        } else {
            let way = way::from_one_end(view.mesh, monitor)?;
            let most = way.iter().copied().max().unwrap_or(0);
            Of::Way(way, most)
        };
        Ok(Self { of })
    }

    fn color(&self, face: Face, lighter: f32) -> [u8; 3] {
        let hexahedron = face.hexahedron;
        let color = match &self.of {
            Of::Components(of) => Rgb::of_bytes(picture::distinct(of[hexahedron as usize] as usize)),
            Of::Way(way, most) => {
                ColorMap::Sequential.at(f64::from(way[hexahedron as usize]) / f64::from((*most).max(1)))
            }
        };
        let amount = if face.kind == Kind::Cut { 1.0 } else { OFF_THE_CUT };
        Style::default().front.mix(color, amount).mix(Rgb::new(1.0, 1.0, 1.0), lighter).to_bytes()
    }
}

/// Triangles of one style.
#[derive(Default)]
struct Part {
    positions: Vec<DVec3>,
    triangles: Vec<[VertexId; 3]>,
    colors: Vec<[u8; 3]>,
}

impl Part {
    /// As a layer of a scene; only some sides of triangles are drawn.
    fn layer(&self, sides: [bool; 3]) -> Layer<'_> {
        let edges = Edges { width: 1.0, opacity: 0.5, sides, ..Edges::default() };
        Layer {
            positions: &self.positions,
            triangles: &self.triangles,
            paint: Paint::Triangles(&self.colors),
            highlighted: &[],
            style: Style { shading: Shading::Flat, edges: Some(edges), ..Style::default() },
        }
    }

    fn push(&mut self, corners: [DVec3; 3], color: [u8; 3]) {
        let first = self.positions.len() as u32;
        self.positions.extend(corners);
        self.triangles.push([first, first + 1, first + 2].map(VertexId));
        self.colors.push(color);
    }
}

/// The triangles that are seen.
#[derive(Default)]
struct Seen {
    /// Two triangles for each face with one or two hexahedra; what they have in common is opposite to the second corner.
    squares: Part,
    /// A fan for each face with more; the middle is the first corner.
    fans: Part,
    /// Faces with several hexahedra, and the most that one has.
    shared: usize,
    most: usize,
    /// Where the way ends.
    ends: Option<u32>,
}

impl Seen {
    fn of(faces: &Faces, colors: &Colors<'_>, mesh: &HexMesh) -> Self {
        let mut seen = Self::default();
        if let Of::Way(_, most) = colors.of {
            seen.ends = Some(most);
        }
        for face in faces.stacks() {
            let corners = faces.corners(face[0], mesh);
            // Lighter from one to the next: their places along the mesh may happen to be as far from its end.
            let step = LIGHTER / (face.len().max(2) - 1) as f32;
            let color = |k: usize| colors.color(face[k], step * k as f32);
            if face.len() > 1 && face.iter().any(|face| face.kind == Kind::Cut) {
                seen.shared += 1;
                seen.most = seen.most.max(face.len());
            }
            if face.len() <= 2 {
                let [a, b, c, d] = corners;
                seen.squares.push([a, b, c], color(0));
                seen.squares.push([c, d, a], color(face.len() - 1));
            } else {
                (0..face.len()).for_each(|k| seen.push_sector(corners, k, face.len(), color(k)));
            }
        }
        seen
    }

    /// The part of a square around its middle that is the `k`-th of `n`.
    fn push_sector(&mut self, corners: [DVec3; 4], k: usize, n: usize, color: [u8; 3]) {
        let middle = (corners[0] + corners[1] + corners[2] + corners[3]) * 0.25;
        // Places on the outline, in sides.
        let at = |place: f64| {
            let side = (place.floor() as usize).min(3);
            corners[side].lerp(corners[(side + 1) % 4], place - side as f64)
        };
        let [begin, end] = [k, k + 1].map(|k| 4.0 * k as f64 / n as f64);
        let mut from = begin;
        while from < end {
            let to = (from.floor() + 1.0).min(end);
            self.fans.push([middle, at(from), at(to)], color);
            from = to;
        }
    }
}
