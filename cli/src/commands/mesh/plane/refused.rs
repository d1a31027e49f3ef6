//! What a person is told when there is no mesh of an area, apart from what the mesher says.

use crate::codes::Code;
use crate::commands::mesh::Args;
use crate::failure::{Failure, shell_word};
use crate::numbers::number;
use welter_meshing::DVec3;
use welter_meshing::volumetric::plane::JoinError;

/// A failure if options were given that mean nothing in the plane.
pub(super) fn options_of_surfaces(args: &Args) -> Result<(), Box<Failure>> {
    let given = [
        ("--outward", args.outward),
        ("--hosts", args.hosts.is_some()),
        ("--boundary", args.boundary),
        ("--coarsen", args.coarsen > 0),
        ("--cut", args.cut.is_some()),
        ("--camera", args.camera.is_some()),
    ];
    let names: Vec<&str> =
        given.into_iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name).collect();
    if names.is_empty() {
        return Ok(());
    }
    let mean = if names.len() == 1 { "means" } else { "mean" };
    Err(Failure::new(Code::Usage, format!("{} {mean} nothing for curves in the plane", names.join(", ")))
        .subject(args.input.display().to_string())
        .why("the file has lines and no triangles, so it is the area of its curves that is meshed")
        .help(format!("leave out {}", names.join(" "))))
}

/// The failure for lines that are no closed curves in the plane. Vertices are counted from 1, as OBJ does.
pub(super) fn no_curves(args: &Args, positions: &[DVec3], error: &JoinError) -> Box<Failure> {
    let failure = |code, what: String| Failure::new(code, what).subject(args.input.display().to_string());
    let spot = |vertex: u32| {
        let p = positions.get(vertex as usize).copied().unwrap_or(DVec3::NAN);
        format!("vertex {}, at ({}, {}, {})", u64::from(vertex) + 1, number(p.x), number(p.y), number(p.z))
    };
    match error {
        JoinError::NotFlat { vertex, first, .. } => {
            let what = "the curves lie in no plane of constant z".to_owned();
            failure(Code::NotPlanar, what).place(spot(*first)).place(spot(*vertex)).help(
                "give all vertices of lines the same z; curves in another plane must be turned there first",
            )
        }
        JoinError::Open { vertex, arriving, leaving } => {
            let what = if (arriving + leaving) % 2 == 1 {
                "a curve is open"
            } else {
                "a curve is open, or its lines run against each other"
            };
            let lines = format!(", where {arriving} lines end and {leaving} begin");
            failure(Code::NotClosed, what.to_owned())
                .place(spot(*vertex) + &lines)
                .why("a curve with ends bounds no area")
                .help("end each curve where it begins (l 1 2 3 1), or where another of its lines begins")
        }
        JoinError::Defects(defects) if !defects.not_finite.is_empty() => {
            let found = failure(Code::NonFiniteVertex, defects.to_string());
            let places = defects.not_finite.iter().fold(found, |found, &vertex| found.place(spot(vertex)));
            places.help(format!("welter info {}   # tells how many there are", shell_word(&args.input)))
        }
        other => failure(Code::NoArea, other.to_string())
            .why("a curve needs three vertices or more, each another than the one before it")
            .help("leave out lines that lead back at once, and vertices that are named twice in a row"),
    }
}

/// The failure for triangles that cannot be numbered.
pub(super) fn too_many_triangles(args: &Args) -> Box<Failure> {
    Failure::new(Code::OverCount, "the vertices of the triangles cannot be numbered with 32 bits")
        .subject(args.input.display().to_string())
        .help("larger cells: -s LENGTH, or fewer: -r N")
}
