//! The surface at the beginning: built-in shapes, sheets and files, placed beside each other.

use crate::codes::Code;
use crate::commands::shape;
use crate::failure::{Failure, shell_word};
use crate::input::{Input, Reading};
use crate::machine;
use crate::numbers::{self, grouped};
use crate::progress::Progress;
use crate::runs::settings::{POSITIVE, Settings};
use glam::DVec3;
use std::path::{Path, PathBuf};
use welter_meshing::shapes::{NAMES, by_name};
use welter_meshing::surface::measure::area;
use welter_meshing::surface::{TriMesh, TriangleSoup};

/// Memory of a run, in bytes a triangle of its beginning. Measured at the peak of first steps: 920 and 1,070 of 237,620 and 60,500 triangles
/// that stay as they are, 1,640 of 56,180 that become 68,940.
const BYTES_A_TRIANGLE: f64 = 2000.0;

/// The most triangles: vertices, edges and half-edges are numbered with 32 bits.
const MOST_TRIANGLES: f64 = 1e9;

/// What the scene says of the surface.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceSpec {
    /// Length of the edges; none for the default of each shape.
    edge_length: Option<f64>,
    parts: Vec<Part>,
}

#[derive(Clone, Debug)]
struct Part {
    kind: Kind,
    scale: f64,
    translate: DVec3,
}

#[derive(Clone, Debug)]
enum Kind {
    /// Of `welter shape --list`.
    Shape(String),
    /// The unit square around the origin in the plane of x and y: a surface with a boundary.
    Sheet,
    File {
        path: PathBuf,
        checksum: Option<String>,
    },
}

impl SurfaceSpec {
    /// Files are sought in `folder`; without one they are not looked at.
    pub(crate) fn read(surface: &mut Settings<'_>, folder: Option<&Path>) -> Result<Self, Box<Failure>> {
        let edge_length = surface.optional_number("edge_length", POSITIVE)?;
        let parts = match surface.tables("parts", |part| Part::read(part, folder))? {
            Some(parts) => parts,
            None => vec![Part::read(surface, folder)?],
        };
        Ok(Self { edge_length, parts })
    }

    /// Refuses a surface that would take more memory than there is.
    pub(crate) fn require_memory(&self, scene: &Path) -> Result<(), Box<Failure>> {
        let mut triangles = 0.0;
        for part in &self.parts {
            triangles += part.triangles(self.edge_length)?;
        }
        let help = "take a larger edge_length in the table [surface]";
        let refuse =
            |code, what: String| Failure::new(code, what).subject(scene.display().to_string()).help(help);
        if triangles > MOST_TRIANGLES {
            return Err(refuse(Code::OverCount, format!("about {triangles:.0e} triangles at the beginning")));
        }
        let needed = (triangles * BYTES_A_TRIANGLE) as u64;
        match machine::available_memory() {
            Some(free) if needed > free => Err(refuse(
                Code::OverMemory,
                format!(
                    "about {} triangles at the beginning may take {}, and {} are free",
                    grouped(triangles as i64),
                    numbers::bytes(needed),
                    numbers::bytes(free)
                ),
            )),
            _ => Ok(()),
        }
    }

    /// The surface, all parts after one another.
    pub(crate) fn build(&self, progress: &Progress) -> Result<TriMesh, Box<Failure>> {
        let mut whole = TriangleSoup::default();
        for part in &self.parts {
            let first = whole.positions.len() as u32;
            let soup = part.build(self.edge_length, progress)?;
            whole.positions.extend(soup.positions.iter().map(|&p| p * part.scale + part.translate));
            whole.triangles.extend(soup.triangles.iter().map(|t| t.map(|v| v + first)));
        }
        TriMesh::new(whole).map_err(|error| match &self.parts[..] {
            [Part { kind: Kind::File { path, .. }, .. }] => {
                crate::commands::check::failures_of(&error, path).swap_remove(0)
            }
            _ => crate::commands::check::failures_of(&error, Path::new("surface")).swap_remove(0),
        })
    }

    /// Centres and radii if all parts are spheres.
    pub(super) fn balls(&self) -> Option<Vec<(DVec3, f64)>> {
        let mut balls = Vec::new();
        for Part { kind, scale, translate } in &self.parts {
            match kind {
                Kind::Shape(name) if name == "sphere" => balls.push((*translate, *scale)),
                Kind::Shape(name) if name == "two-spheres" => {
                    let [a, b] =
                        [-0.25, 0.25].map(|x| (DVec3::new(x, 0.0, 0.0) * *scale + *translate, 0.2 * scale));
                    balls.extend([a, b]);
                }
                _ => return None,
            }
        }
        Some(balls)
    }
}

impl Part {
    fn read(part: &mut Settings<'_>, folder: Option<&Path>) -> Result<Self, Box<Failure>> {
        let kind = match (part.text("shape")?, part.text("file")?) {
            (Some(_), Some(_)) => return Err(part.bad("file", "either shape or file, not both")),
            (None, None) => {
                return Err(part
                    .bad("shape", "neither shape nor file is given")
                    .help("shape = \"sphere\"   # welter shape --list names them, and there is \"sheet\""));
            }
            (Some(name), None) if name == "sheet" => Kind::Sheet,
            (Some(name), None) => {
                // Known now rather than after the folder is made.
                if let (false, Err(error)) =
                    (NAMES.iter().any(|shape| shape.name == name), by_name(&name, None))
                {
                    return Err(part.bad("shape", error.to_string()).help("welter shape --list"));
                }
                Kind::Shape(name)
            }
            (None, Some(name)) => {
                let checksum = part.text("checksum")?;
                let Some(folder) = folder else {
                    let kind = Kind::File { path: name.into(), checksum };
                    return Self::placed(part, kind);
                };
                let path = folder.join(name);
                let found = checksum_of(&path)?;
                if checksum.as_ref().is_some_and(|known| *known != found) {
                    let what =
                        format!("{} is not the file that it was: its checksum is {found}", path.display());
                    return Err(part
                        .bad("checksum", what)
                        .help("take out the line to use the file as it is"));
                }
                let path = path.canonicalize().unwrap_or(path);
                part.settle_text("file", &path.display().to_string());
                part.settle_text("checksum", &found);
                Kind::File { path, checksum: Some(found) }
            }
        };
        Self::placed(part, kind)
    }

    fn placed(part: &mut Settings<'_>, kind: Kind) -> Result<Self, Box<Failure>> {
        Ok(Self {
            kind,
            scale: part.number("scale", 1.0, POSITIVE)?,
            translate: part.vector("translate", DVec3::ZERO)?,
        })
    }

    /// About how many triangles it has.
    fn triangles(&self, edge_length: Option<f64>) -> Result<f64, Box<Failure>> {
        let equilateral = |area: f64, edge: f64| area / (0.25 * 3.0_f64.sqrt() * edge * edge);
        Ok(match (&self.kind, edge_length) {
            (Kind::Sheet, edge) => {
                2.0 * (self.scale / edge.unwrap_or(SHEET_EDGE * self.scale)).ceil().powi(2)
            }
            // Of a shape at its default size the area is known soon.
            (Kind::Shape(name), Some(edge)) => {
                let mesh = shape::build(name, None)?;
                equilateral(area(mesh.as_mesh()), edge / self.scale)
            }
            (Kind::Shape(_), None) => 0.0,
            (Kind::File { path, .. }, _) => {
                // At least 24 bytes in every format that is read.
                std::fs::metadata(path).map_or(0.0, |meta| meta.len() as f64 / 24.0)
            }
        })
    }

    fn build(&self, edge_length: Option<f64>, progress: &Progress) -> Result<TriangleSoup, Box<Failure>> {
        let edge = edge_length.map(|edge| edge / self.scale);
        match &self.kind {
            Kind::Shape(name) => Ok(shape::build(name, edge)?.as_mesh().to_soup()),
            Kind::Sheet => Ok(sheet(edge.unwrap_or(SHEET_EDGE))),
            Kind::File { path, checksum } => {
                let input = Input::open(path, &Reading { from: None, max_memory: None })?;
                let (soup, _) = input.read(progress)?;
                if checksum.as_ref().is_some_and(|known| checksum_of(path).ok().as_ref() != Some(known)) {
                    return Err(Failure::new(Code::ReadFailed, "the file changed while it was read")
                        .subject(path.display().to_string())
                        .help("run the same command again"));
                }
                Ok(soup)
            }
        }
    }
}

/// Edge length of a sheet of side 1 where the scene gives none.
const SHEET_EDGE: f64 = 0.02;

/// The unit square around the origin, facing up: squares with a diagonal each, in turns one way and the other.
fn sheet(edge: f64) -> TriangleSoup {
    let n = (1.0 / edge).ceil().max(1.0) as u32;
    let coordinate = |k: u32| f64::from(k) / f64::from(n) - 0.5;
    let positions =
        (0..=n).flat_map(|j| (0..=n).map(move |i| DVec3::new(coordinate(i), coordinate(j), 0.0))).collect();
    let mut triangles = Vec::with_capacity(2 * (n as usize).pow(2));
    for j in 0..n {
        for i in 0..n {
            let a = j * (n + 1) + i;
            let (b, c, d) = (a + 1, a + n + 2, a + n + 1);
            if (i + j) % 2 == 0 {
                triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                triangles.extend([[a, b, d], [b, c, d]]);
            }
        }
    }
    TriangleSoup { positions, triangles, ..TriangleSoup::default() }
}

/// Names the content of a file.
fn checksum_of(path: &Path) -> Result<String, Box<Failure>> {
    let bytes = std::fs::read(path).map_err(|error| {
        let failure = crate::input::cannot_read(path, &error);
        failure.help(format!("ls {}   # files are sought beside the scene", shell_word(path)))
    })?;
    Ok(format!("crc32:{:08x}", crc32fast::hash(&bytes)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::surface::Topology;

    #[test]
    fn a_sheet_is_flat_whole_and_faces_up() {
        for edge in [0.5, 0.3, 0.05] {
            let mesh = TriMesh::new(sheet(edge)).unwrap();
            assert!((area(&mesh) - 1.0).abs() < 1e-12);
            let topology = Topology::of(&mesh);
            assert_eq!((topology.boundary_loops().len(), topology.euler_characteristic()), (1, 1));
            assert!(topology.is_oriented() && topology.is_edge_manifold());
            let [a, b, c] = mesh.triangles()[0].map(|v| mesh.positions()[v.index()]);
            assert!((b - a).cross(c - a).z > 0.0);
        }
    }
}
