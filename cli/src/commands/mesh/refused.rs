//! What a person is told when there is no volumetric mesh: [`VolumeError`] as failures.

use super::cell_size::Measures;
use super::{Args, Job};
use crate::codes::Code;
use crate::failure::{Failure, shell_word};
use crate::numbers::{self, grouped, point};
use welter_meshing::DVec3;
use welter_meshing::volumetric::{Place, Verification, VolumeError};

/// What the mesher calls the cells of which there can be too many by a parameter.
const CELLS_OF_GRID: &str = "cells of the grid";

/// The failure for an error of the mesher.
pub(super) fn refused(job: &Job<'_>, error: &VolumeError) -> Box<Failure> {
    let args = job.args;
    let code = code_of(error);
    let because = |what: String| Failure::new(code, what).subject(args.input.display().to_string());
    let failure = || because(error.to_string());
    match error {
        VolumeError::Grid(_) | VolumeError::Parameter { .. } => failure()
            .place(format!("bounding box of {}", size(job.measures.sides)))
            .help("-r 63   # cells along the shortest side; or: -s LENGTH"),
        VolumeError::Empty => failure()
            .why("a surface without triangles bounds no volume")
            .help(format!("welter info {}", shell_word(&args.input))),
        VolumeError::Negative { place, winding } => {
            let what = format!(
                "the surface is inside out around {}: it winds {winding} times there",
                point(middle(place))
            );
            let failure = because(what);
            failure.place(in_words(place)).help(look(args, place, &job.measures))
        }
        VolumeError::TooManyCopies { place, copies, most } => {
            let what = format!(
                "{copies} sheets lie over one another around {}, at most {most} can be told apart",
                point(middle(place))
            );
            let failure = because(what);
            failure.place(in_words(place)).help(look(args, place, &job.measures))
        }
        VolumeError::UnderResolved { place, what, spacing, refinements } => {
            let finer = 0.5 * spacing;
            let what = format!(
                "cells of side {} are too large around {}: {what}",
                numbers::number(*spacing),
                point(middle(place))
            );
            let failure = because(what);
            let failure = match refinements {
                0 => failure,
                n => failure
                    .place(format!("halved {n} times from side {}", numbers::number(job.chosen.spacing))),
            };
            let needed = job.measures.bytes(finer, args.tet);
            let memory =
                if needed.is_finite() { numbers::bytes(needed as u64) } else { "too much".to_owned() };
            failure.place(in_words(place)).help(format!(
                "welter mesh {} -o {} -s {finer}   # may take {memory} of memory",
                shell_word(&args.input),
                shell_word(&args.output)
            ))
        }
        VolumeError::TooLarge { what: CELLS_OF_GRID, count, most } => {
            let what = format!(
                "cells of side {} are {} in the box of the surface, and {} are allowed",
                numbers::number(job.chosen.spacing),
                grouped(*count),
                grouped(*most)
            );
            let cells = |h: f64| job.measures.sides.to_array().map(|side| side / h + 3.0).iter().product();
            let help = match job.measures.smallest_cells(*most as f64, cells) {
                Some(spacing) => format!("-s {spacing}   # or: --max-cells {count}"),
                None => format!("--max-cells {count}"),
            };
            because(what).help(help)
        }
        VolumeError::TooLarge { .. } => failure().help("larger cells: -s LENGTH, or fewer: -r N"),
        VolumeError::Cancelled(_) => job.clock.time_is_up("meshing"),
        _ => failure().help("send the file to the authors"),
    }
}

/// The failure for a file of lines without triangles.
pub(super) fn lines_alone(args: &Args) -> Box<Failure> {
    Failure::new(Code::NoTriangles, "there are lines and no triangles")
        .subject(args.input.display().to_string())
        .why(
            "this command meshes the volume of surfaces, not the area of curves, which only the library does",
        )
        .help(format!("welter info {}", shell_word(&args.input)))
}

/// The code alone.
pub(super) fn code_of(error: &VolumeError) -> Code {
    match error {
        VolumeError::Grid(_) | VolumeError::Parameter { .. } => Code::NoSuchCells,
        VolumeError::Empty => Code::NoTriangles,
        VolumeError::Negative { .. } => Code::InsideOut,
        VolumeError::TooManyCopies { .. } => Code::TooManySheets,
        VolumeError::UnderResolved { .. } => Code::UnderResolved,
        VolumeError::TooLarge { what: CELLS_OF_GRID, .. } => Code::OverCells,
        VolumeError::TooLarge { .. } => Code::OverCount,
        VolumeError::Cancelled(_) => Code::TimeLimit,
        _ => Code::OwnBug,
    }
}

/// The failure for a mesh that was written and is wrong.
pub(super) fn not_verified(args: &Args, verification: &Verification) -> Box<Failure> {
    let failure = Failure::new(Code::MeshNotVerified, "the mesh that was written is wrong")
        .subject(args.output.display().to_string())
        .help(format!(
            "-s LENGTH   # smaller cells may help; and send {} with the command line to the authors",
            shell_word(&args.input)
        ));
    verification.findings().fold(failure, |failure, finding| failure.place(finding.to_string()))
}

fn middle(place: &Place) -> DVec3 {
    place.min * 0.5 + place.max * 0.5
}

/// A box, and how many nodes of the grid it stands for.
fn in_words(place: &Place) -> String {
    let nodes = match place.nodes {
        0 => String::new(),
        1 => ", 1 node of the grid".to_owned(),
        n => format!(", {} nodes of the grid", grouped(n)),
    };
    format!("{} to {}{nodes}", point(place.min), point(place.max))
}

/// The command that shows what is there: from the side that makes the widest picture of the place.
fn look(args: &Args, place: &Place, measures: &Measures) -> String {
    let input = shell_word(&args.input);
    if measures.volume < 0.0 && !args.outward {
        return format!(
            "--outward   # turns it; to look: welter render {input} -o look.png, where blue is the inside"
        );
    }
    let extent = place.max - place.min;
    let axis = (0..3).min_by(|&a, &b| extent[a].total_cmp(&extent[b])).unwrap_or(2);
    let cut = numbers::number(middle(place)[axis]);
    // Highlighted self-intersections would hide the blue.
    let turn = if args.outward { "" } else { "; if whole components are: --outward" };
    format!(
        "welter render {input} -o look.png --cut {}={cut}   # blue is the inside{turn}",
        ["x", "y", "z"][axis]
    )
}

fn size(sides: DVec3) -> String {
    format!("{} x {} x {}", numbers::number(sides.x), numbers::number(sides.y), numbers::number(sides.z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Cli, Command};
    use clap::Parser;
    use welter_meshing::shapes::{Box_, box_};
    use welter_meshing::volumetric::{Finding, Findings};

    fn args(line: &str) -> Args {
        let cli = Cli::try_parse_from(line.split(' ')).expect("a command line");
        let Command::Mesh(args) = cli.command else { panic!("another command") };
        args
    }

    #[test]
    fn what_was_tried_is_not_proposed_again() {
        let surface = box_(&Box_::default()).expect("a box");
        let place = Place { min: DVec3::ZERO, max: DVec3::new(1.0, 3.0, 2.0), nodes: 9 };
        let help = |line: &str| look(&args(line), &place, &Measures::of(&surface));
        let first = help("welter mesh a.ply -o a.vtu");
        assert!(first.contains("--cut x=0.5 ") && first.contains("--outward"), "{first}");
        let second = help("welter mesh a.ply -o a.vtu --outward");
        assert!(second.contains("--cut x=0.5 ") && !second.contains("--outward"), "{second}");
    }

    #[test]
    fn a_wrong_mesh_is_told_with_its_places() {
        let args = args("welter mesh a.ply -o a.vtu");
        let finding = Finding::Copies { cell: [1, 2, 3], hexahedra: 1, winding: 2 };
        let winding_copies = Findings { count: 1, first: vec![finding] };
        let verification = Verification { winding_copies, ..Verification::default() };
        assert!(!verification.passed());
        let failure = not_verified(&args, &verification);
        assert_eq!((failure.code, failure.code.exit()), (Code::MeshNotVerified, 9));
        assert!(failure.places[0].starts_with("cell (1, 2, 3) has 1 hexahedra"), "{}", failure.places[0]);
    }
}
