//! The options of `welter mesh`.

use super::clock::parse_seconds;
use super::volume_file::VolumeFormat;
use crate::input::Reading;
use crate::picture::{parse_camera, parse_cut, parse_size};
use crate::render::{Camera, Cut};
use clap::ValueEnum;
use std::path::PathBuf;
use std::time::Duration;

/// Mesh the volume of a closed surface, or the area of closed curves in the plane, which may intersect themselves
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Where a surface overlaps itself the sheets of its volume lie over one another, with hexahedra of their own: they
share no vertices and move apart when the mesh moves. Cells are those of a grid, cut by nothing: the surface lies
within, and --hosts says where.

Without -r and -s there are 63 cells along the shortest side of the bounding box, or fewer where that would be
more than about 3 million hexahedra. Where features are too fine, cells are halved and the mesh is made again.

A .vtu file has the cells, with the fields copy (which of the sheets on its cell), region and component; .msh and
.mesh files have the faces of the boundary too, tagged with the groups of the surface, as .vtu has with --boundary.
.msh and .vtu keep the names of the groups.

An OBJ file of lines alone holds curves in a plane of constant z: closed, with the inside on their left. Their area
is meshed with quadrilaterals, or with triangles by --tet, by the same rules and with the same fields; --outward,
--hosts, --boundary, --coarsen, --cut and --camera are for surfaces alone.

Exit codes: 3 when the surface is open, not oriented, or inside out somewhere; 6 when memory would not suffice;
8 when features are too fine or the time is up (a mesh that is there by then is written); 9 when verification
fails (the mesh is written).

Examples:
  welter mesh part.stl -o part.vtu
  welter mesh part.obj -o part.msh --tet -r 40
  welter mesh part.ply -o part.vtu -s 0.02 --hosts hosts.csv --picture part.png
  welter mesh curve.obj -o area.vtu --picture area.png
  welter mesh part.ply -o part.vtu --json --max-memory 4000000000 --time-limit 60")]
pub(crate) struct Args {
    /// Surface to mesh (obj, ply, stl, off), or curves (`l` statements of an obj without faces); `-` is standard input
    pub(super) input: PathBuf,
    /// File to write (vtu, msh, mesh), not overwritten without --force; `-` is standard output
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
    /// Format of the output [default: by its extension]; needed for standard output
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(super) to: Option<VolumeFormat>,
    /// Write hexahedra, all of them cubes (the default); of curves quadrilaterals, all of them squares
    #[arg(long, conflicts_with = "tet")]
    pub(super) hex: bool,
    /// Write tetrahedra, about twelve for each hexahedron; of curves triangles, about four for each quadrilateral
    #[arg(long)]
    pub(super) tet: bool,
    /// Cells along the shortest side of the bounding box [default: 63]
    #[arg(short, long, value_name = "N", conflicts_with = "spacing")]
    pub(super) resolution: Option<u32>,
    /// Side of a cell, absolute
    #[arg(short, long, value_name = "H", allow_negative_numbers = true)]
    pub(super) spacing: Option<f64>,
    /// Double the cells of the finished mesh K times, or as often as its topology is kept and sheets stay apart
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub(super) coarsen: u32,
    /// How often cells may be halved where features are too fine
    #[arg(long, value_name = "K", default_value_t = 3)]
    pub(super) max_refinements: u32,
    /// Most cells of the grid, counted over the whole bounding box [default: 4294967296]
    #[arg(long, value_name = "N")]
    pub(super) max_cells: Option<u64>,
    /// Stop after so long; a mesh that is there by then is written, and the exit code is 8
    #[arg(long, value_name = "S", value_parser = parse_seconds)]
    pub(super) time_limit: Option<Duration>,
    /// Check the mesh against the surface by other means than it was made (the default)
    #[arg(long, conflicts_with = "no_verify")]
    pub(super) verify: bool,
    /// Leave the check out
    #[arg(long)]
    pub(super) no_verify: bool,
    /// Leave out the Betti numbers, which take most of the time and memory for millions of hexahedra
    #[arg(long)]
    pub(super) no_betti: bool,
    /// Turn components of the surface outward that are inside out and lie in no other
    #[arg(long)]
    pub(super) outward: bool,
    /// Write, for each vertex of the surface, the cell that holds it, the vertices of this cell and their weights
    #[arg(long, value_name = "FILE.csv")]
    pub(super) hosts: Option<PathBuf>,
    /// Draw the mesh cut open; of curves the mesh from above, striped where sheets lie over one another
    #[arg(long, value_name = "FILE.png")]
    pub(super) picture: Option<PathBuf>,
    /// Plane of the cut, for example z=0.5 [default: where the most sheets lie over one another]
    #[arg(long, value_name = "x|y|z=V", value_parser = parse_cut, requires = "picture")]
    pub(super) cut: Option<Cut>,
    /// From where: degrees around the up axis, degrees above the horizon [default: at a slant to the cut]
    #[arg(long, value_name = "AZIMUTH,ELEVATION[,DISTANCE]", value_parser = parse_camera, requires = "picture", allow_hyphen_values = true)]
    pub(super) camera: Option<Camera>,
    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "1200x900", value_parser = parse_size)]
    pub(super) picture_size: [u32; 2],
    /// Write the faces of the boundary into a .vtu file too
    #[arg(long)]
    pub(super) boundary: bool,
    /// Version of a .msh file
    #[arg(long, value_enum, value_name = "VERSION", default_value_t = Msh::Four)]
    pub(super) msh: Msh,
    /// Write text where the format has text and binary (vtu, msh)
    #[arg(long)]
    pub(super) ascii: bool,
    #[command(flatten)]
    pub(super) reading: Reading,
}

/// A version of Gmsh's format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Msh {
    // 2.2
    #[value(name = "2")]
    Two,
    // 4.1
    #[value(name = "4")]
    Four,
}
