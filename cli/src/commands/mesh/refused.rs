//! What a person is told when there is no volumetric mesh: [`VolumeError`] as failures.

use super::cell_size::Measures;
use super::{Args, Job};
use crate::codes::Code;
use crate::failure::{Failure, shell_word};
use crate::numbers::{self, grouped, point};
use welter_meshing::DVec3;
use welter_meshing::volumetric::{Place, VolumeError};

/// How the mesher begins to say that sheets could not be told apart.
const SHEETS: &str = "no way to tell its sheets apart";

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
            .place(format!("bounding box of {}", size(&job.measures)))
            .help("-r 63   # cells along the shortest side; or: -s LENGTH"),
        VolumeError::Empty => failure()
            .why("a surface without triangles bounds no volume")
            .help(format!("welter info {}", shell_word(&args.input))),
        VolumeError::Negative { place, winding } if job.measures.plane => {
            let what = format!(
                "the curves run the wrong way round {}: they wind {winding} times there",
                job.spot(middle(place))
            );
            because(what)
                .place(job.in_words(place))
                .why("the inside is on the left of curves: outer ones run counterclockwise, those of holes clockwise")
                .help("reverse the order of the vertices of these curves")
        }
        VolumeError::Negative { place, winding } => {
            let what = format!(
                "the surface is inside out around {}: it winds {winding} times there",
                job.spot(middle(place))
            );
            let failure = because(what);
            failure.place(job.in_words(place)).help(look(args, place, &job.measures))
        }
        VolumeError::TooManyCopies { place, copies, most } => {
            let what = format!(
                "{copies} sheets lie over one another around {}, at most {most} can be told apart",
                job.spot(middle(place))
            );
            let help = if job.measures.plane {
                "leave out curves that lie over others there".to_owned()
            } else {
                look(args, place, &job.measures)
            };
            because(what).place(job.in_words(place)).help(help)
        }
        VolumeError::Turning { .. } => failure()
            .help("divide a curve that winds twice without bounding an area, where it crosses itself"),
        VolumeError::UnderResolved { place, what, spacing, refinements } => {
            let in_doubt = job.measures.plane || what.starts_with(SHEETS);
            let doubt = if in_doubt { doubt(job) } else { String::new() };
            let finer = 0.5 * spacing;
            let what = format!(
                "cells of side {} are too large around {}: {what}",
                numbers::number(*spacing),
                job.spot(middle(place))
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
            failure.place(job.in_words(place)).help(format!(
                "welter mesh {} -o {} -s {finer:?}   # may take {memory} of memory{doubt}",
                shell_word(&args.input),
                shell_word(&args.output)
            ))
        }
        VolumeError::TooLarge { what: CELLS_OF_GRID, count, most } => {
            let what = format!(
                "cells of side {} are {} in the bounding box, and {} are allowed",
                numbers::number(job.chosen.spacing),
                grouped(*count),
                grouped(*most)
            );
            let cells = |spacing| job.measures.cells_of_grid(spacing);
            let help = match job.measures.smallest_cells(*most as f64, cells) {
                Some(spacing) => format!("-s {spacing:?}   # or: --max-cells {count}"),
                None => format!("--max-cells {count}"),
            };
            because(what).help(help)
        }
        VolumeError::TooLarge { .. } => failure().help("larger cells: -s LENGTH, or fewer: -r N"),
        VolumeError::Cancelled(_) => job.clock.time_is_up("meshing"),
        _ => failure().help("send the file to the authors"),
    }
}

/// The code alone.
pub(super) fn code_of(error: &VolumeError) -> Code {
    match error {
        VolumeError::Grid(_) | VolumeError::Parameter { .. } => Code::NoSuchCells,
        VolumeError::Empty => Code::NoTriangles,
        VolumeError::Negative { .. } => Code::InsideOut,
        VolumeError::Turning { .. } => Code::NoArea,
        VolumeError::TooManyCopies { .. } => Code::TooManySheets,
        VolumeError::UnderResolved { .. } => Code::UnderResolved,
        VolumeError::TooLarge { what: CELLS_OF_GRID, .. } => Code::OverCells,
        VolumeError::TooLarge { .. } => Code::OverCount,
        VolumeError::Cancelled(_) => Code::TimeLimit,
        _ => Code::OwnBug,
    }
}

/// The failure for a mesh that was written and is wrong.
pub(super) fn not_verified<F: ToString>(args: &Args, findings: impl Iterator<Item = F>) -> Box<Failure> {
    let failure = Failure::new(Code::MeshNotVerified, "the mesh that was written is wrong")
        .subject(args.output.display().to_string())
        .help(format!(
            "-s LENGTH   # smaller cells may help; and send {} with the command line to the authors",
            shell_word(&args.input)
        ));
    findings.fold(failure, |failure, finding| failure.place(finding.to_string()))
}

fn middle(place: &Place) -> DVec3 {
    place.min * 0.5 + place.max * 0.5
}

impl Job<'_> {
    /// A point, of as many coordinates as there are.
    fn spot(&self, p: DVec3) -> String {
        if self.measures.plane {
            format!("({}, {})", numbers::number(p.x), numbers::number(p.y))
        } else {
            point(p)
        }
    }

    /// A box, and how many nodes of the grid it stands for.
    fn in_words(&self, place: &Place) -> String {
        let nodes = match place.nodes {
            0 => String::new(),
            1 => ", 1 node of the grid".to_owned(),
            n => format!(", {} nodes of the grid", grouped(n)),
        };
        format!("{} to {}{nodes}", self.spot(place.min), self.spot(place.max))
    }
}

/// What else may be the matter than cells where no way to tell sheets apart is consistent.
fn doubt(job: &Job<'_>) -> String {
    if job.measures.plane {
        "; no cells help where the curves bound no area".to_owned()
    } else {
        format!(
            "; no cells help where the surface bounds no volume, as where it is turned inside out around a vertex: \
             welter check {} --pairs",
            shell_word(&job.args.input)
        )
    }
}

/// The command that shows what is there: from the side that makes the widest picture of the place.
fn look(args: &Args, place: &Place, measures: &Measures) -> String {
    let input = shell_word(&args.input);
    if measures.content < 0.0 && !args.outward {
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

fn size(measures: &Measures) -> String {
    let sides = measures.sides.to_array().map(numbers::number);
    sides[..if measures.plane { 2 } else { 3 }].join(" x ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Cli, Command};
    use crate::commands::mesh::cell_size;
    use crate::commands::mesh::clock::Clock;
    use clap::Parser;
    use welter_meshing::shapes::{Box_, box_};
    use welter_meshing::volumetric::{Finding, Findings, Verification};

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
    fn finer_cells_are_not_all_that_is_proposed_where_sheets_are_not_told_apart() {
        let surface = box_(&Box_::default()).expect("a box");
        let (args, measures) = (args("welter mesh a.ply -o a.vtu -s 1e300"), Measures::of(&surface));
        let chosen = cell_size::choose(&measures, args.resolution, args.spacing);
        let job = Job { args: &args, measures, chosen, clock: &Clock::start(None) };
        let help = |what: &'static str| {
            let place = Place { min: DVec3::ZERO, max: DVec3::ONE, nodes: 9 };
            let error = VolumeError::UnderResolved { place, what, spacing: 1e300, refinements: 1 };
            let failure = refused(&job, &error);
            assert!(failure.what.len() < 200 && failure.places[0].ends_with("from side 1.00000e300"));
            failure.help.clone()
        };
        let trouble = "no way to tell its sheets apart is consistent";
        assert!(
            help(trouble).starts_with("welter mesh a.ply -o a.vtu -s 5e299   # may take"),
            "{}",
            help(trouble)
        );
        assert!(help(trouble).ends_with("around a vertex: welter check a.ply --pairs"), "{}", help(trouble));
        assert!(!help("a gap is within one cell").contains("no cells help"));
    }

    #[test]
    fn a_wrong_mesh_is_told_with_its_places() {
        let args = args("welter mesh a.ply -o a.vtu");
        let finding = Finding::Copies { cell: [1, 2, 3], hexahedra: 1, winding: 2 };
        let winding_copies = Findings { count: 1, first: vec![finding] };
        let verification = Verification { winding_copies, ..Verification::default() };
        assert!(!verification.passed());
        let failure = not_verified(&args, verification.findings());
        assert_eq!((failure.code, failure.code.exit()), (Code::MeshNotVerified, 9));
        assert!(failure.places[0].starts_with("cell (1, 2, 3) has 1 hexahedra"), "{}", failure.places[0]);
    }
}
