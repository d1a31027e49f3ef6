//! `welter mesh`: the volume of a surface, as hexahedra or tetrahedra; where the surface overlaps itself, sheets of the mesh lie over
//! one another and stay apart. Of a file of lines alone, the area of its curves (`plane`).

mod by_default;
mod cell_size;
mod clock;
mod facts;
mod findings;
mod groups;
mod hosts;
mod options;
mod outputs;
mod plane;
mod product;
mod refused;
mod report;
mod volume_file;

use crate::closed::closed_oriented;
use crate::codes::Code;
use crate::console::Seconds;
use crate::cutaway::{self, Cutaway, Problem};
use crate::failure::Failure;
use crate::input::{Drawn, Input};
use crate::numbers::{self, grouped};
use crate::output::WriteProblem;
use crate::render::{Cut, Image};
use crate::run::{Outcome, Run};
use crate::surface_file::refuse_standard_output_with_json;
use crate::{machine, picture};
use cell_size::{Chosen, Measures};
use clock::Clock;
use facts::Facts;
use findings::Topology;
use groups::Groups;
use outputs::Outputs;
use product::{Boundary, Product};
use report::Report;
use welter_meshing::surface::ClosedOrientedMesh;
use welter_meshing::volumetric::{
    TetError, TetrahedraError, Verification, VolumeMesh, VolumeParameters, mesh_volume, outward, tetrahedra,
    verify, verify_conversion,
};
use welter_meshing::{Cancelled, Monitor};

pub(crate) use by_default::Meshed;
pub(crate) use options::Args;
pub(crate) use volume_file::VolumeFormat;

/// What a run is about: known before the work.
struct Job<'a> {
    args: &'a Args,
    measures: Measures,
    chosen: Chosen,
    clock: &'a Clock,
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let console = &run.console;
    let clock = &Clock::start(args.time_limit);
    let mut seconds = Seconds::default();
    for output in [Some(&args.output), args.hosts.as_ref(), args.picture.as_ref()].into_iter().flatten() {
        refuse_standard_output_with_json(output, run)?;
    }
    let input = Input::open(&args.input, &args.reading)?;
    let outputs = Outputs::prepare(args, run)?;
    let Drawn { soup, lines, held } =
        console.stage(&mut seconds, "reading", || input.read_with_lines(&console.progress))?;
    for ignored in &held.ignored {
        console.detail(2, &format!("{} ({}) passed over", ignored.what, grouped(ignored.count)));
    }
    if soup.triangles.is_empty() && !lines.is_empty() {
        return plane::run(args, &soup.positions, &lines, outputs, clock, seconds, run);
    }
    if !lines.is_empty() {
        console.note(&format!(
            "{} lines passed over: there are triangles too, and their volume is meshed",
            grouped(lines.len() as u64)
        ));
    }
    drop(lines);
    let surface = console.stage(&mut seconds, "checking", || closed_oriented(soup, &args.input))?;
    let report = |p: welter_meshing::Progress| console.progress.report(p.stage, p.done, p.total);
    let monitor = Monitor::new(Some(&report), Some(clock.flag()));
    let surface =
        if args.outward { turned_outward(&surface, run, &mut seconds, &monitor, clock)? } else { surface };
    let measures = Measures::of(&surface);
    let chosen = cell_size::choose(&measures, args.resolution, args.spacing);
    let job = Job { args, measures, chosen, clock };
    if let Some(note) = &job.chosen.note {
        console.note(note);
    }
    let parameters = job.parameters()?;

    let volume = console
        .stage(&mut seconds, "meshing", || mesh_volume(&surface, &parameters, &monitor))
        .map_err(|error| refused::refused(&job, &error))?;
    let product = job.product(volume, run, &mut seconds, &monitor)?;
    job.deliver(&surface, product, outputs, run, seconds, &monitor)
}

/// The surface without components that were turned inside out by mistake.
fn turned_outward(
    surface: &ClosedOrientedMesh,
    run: &Run,
    seconds: &mut Seconds,
    monitor: &Monitor<'_>,
    clock: &Clock,
) -> Result<ClosedOrientedMesh, Box<Failure>> {
    let turned = run.console.stage(seconds, "turning outward", || outward(surface, monitor));
    let (surface, components) = turned.map_err(|Cancelled| clock.time_is_up("turning components outward"))?;
    run.console.note(&format!("{} components turned outward", grouped(components.len() as u64)));
    Ok(surface)
}

impl Job<'_> {
    /// What the mesher is told, after a look at the memory that it takes.
    fn parameters(&self) -> Result<VolumeParameters, Box<Failure>> {
        let (args, spacing) = (self.args, self.chosen.spacing);
        let parameters = VolumeParameters {
            resolution: self.chosen.resolution,
            max_refinements: args.max_refinements,
            max_cells: args.max_cells.unwrap_or(VolumeParameters::default().max_cells),
            coarsenings: args.coarsen,
            ..VolumeParameters::default()
        };
        // What is out of range has no cells to be counted.
        parameters.validate().map_err(|error| refused::refused(self, &error))?;
        let Some(free) = args.reading.max_memory.or_else(machine::available_memory) else {
            return Ok(parameters);
        };
        let fits = |halvings: u32| {
            self.measures.bytes(spacing * 0.5f64.powi(halvings as i32), args.tet) <= free as f64
        };
        if !self.measures.is_empty() && !fits(0) {
            return Err(self.over_memory(free));
        }
        let affordable = (0..parameters.max_refinements).take_while(|&halvings| fits(halvings + 1)).count();
        Ok(VolumeParameters { max_refinements: affordable as u32, ..parameters })
    }

    fn over_memory(&self, free: u64) -> Box<Failure> {
        let (args, spacing) = (self.args, self.chosen.spacing);
        let needed = self.measures.bytes(spacing, args.tet);
        let cells = match self.measures.cells(spacing) {
            count if count.is_finite() => format!("about {}", numbers::number(count)),
            _ => "more than 1e308".to_owned(),
        };
        let what = format!(
            "cells of side {} are {cells} {}, which may take {}, and {} {}",
            numbers::number(spacing),
            self.measures.cell_name(),
            if needed < 1e18 {
                numbers::bytes(needed as u64)
            } else {
                "more than any machine has".to_owned()
            },
            numbers::bytes(free),
            if args.reading.max_memory.is_some() { "are allowed" } else { "are free" }
        );
        let largest =
            self.measures.smallest_cells(free as f64, |spacing| self.measures.bytes(spacing, args.tet));
        let help = match largest {
            Some(spacing) => {
                let count = (self.measures.shortest_side() / spacing).floor();
                let cells = if count >= 1.0 { format!(", or: -r {count}") } else { String::new() };
                format!("-s {spacing:?}   # would fit{cells}")
            }
            None => "no cells would fit: allow more memory, or take a simpler surface".to_owned(),
        };
        Failure::new(Code::OverMemory, what).subject(args.input.display().to_string()).help(help)
    }

    /// The mesh in the form that was asked for.
    fn product(
        &self,
        volume: VolumeMesh,
        run: &Run,
        seconds: &mut Seconds,
        monitor: &Monitor<'_>,
    ) -> Result<Product, Box<Failure>> {
        let tetrahedra = match self.args.tet {
            false => None,
            true => Some(
                run.console.stage(seconds, "tetrahedra", || tetrahedra(&volume.mesh, monitor)).map_err(
                    |error| match error {
                        TetrahedraError::Cancelled(_) => self.clock.time_is_up("making tetrahedra"),
                        TetrahedraError::TooMany { .. } => Failure::new(Code::OverCount, error.to_string())
                            .subject(self.args.input.display().to_string())
                            .help("larger cells: -s LENGTH, or fewer: -r N"),
                        _ => Failure::new(Code::NoSuchCells, error.to_string())
                            .subject(self.args.input.display().to_string())
                            .help("-r 63   # a size of cells with fewer digits"),
                    },
                )?,
            ),
        };
        Ok(Product { volume, tetrahedra, components: Vec::new() })
    }

    /// Finds out what is to be told, and writes everything. Once there is a mesh it is written, whatever comes.
    fn deliver(
        &self,
        surface: &ClosedOrientedMesh,
        mut product: Product,
        outputs: Outputs,
        run: &Run,
        mut seconds: Seconds,
        monitor: &Monitor<'_>,
    ) -> Outcome {
        let (args, console) = (self.args, &run.console);
        let found = self.find_out(surface, &mut product, run, &mut seconds, monitor)?;
        let groups = Groups::of(surface);
        let dropped = console.stage(&mut seconds, "writing", || {
            write(surface, &product, &groups, outputs, found.image.as_ref())
        })?;
        console.progress.clear();
        for loss in &dropped {
            console.note(&format!("{}: {loss}", args.output.display()));
        }
        let facts = Facts {
            product: &product,
            topology: found.topology.as_ref(),
            verification: found.verification.as_ref(),
            surface_volume: self.measures.content,
        };
        let report = Report { job: self, facts, groups: &groups, cut: found.cut, dropped: &dropped };
        let failure = match &found.verification {
            Some(verification) if !verification.passed() => {
                Some(refused::not_verified(args, verification.findings()))
            }
            _ => found.stopped.map(|stage| self.clock.time_is_up(stage)),
        };
        report.tell(run, &seconds, failure)
    }

    /// Looks at the mesh until the time is up. Sets the components of the product.
    fn find_out(
        &self,
        surface: &ClosedOrientedMesh,
        product: &mut Product,
        run: &Run,
        seconds: &mut Seconds,
        monitor: &Monitor<'_>,
    ) -> Result<Found, Box<Failure>> {
        let (args, console) = (self.args, &run.console);
        let taken = machine::peak_memory().unwrap_or(0);
        let left = args.reading.max_memory.map(|most| most.saturating_sub(taken));
        let for_betti = if args.no_betti { Some(0) } else { left.or_else(machine::available_memory) };
        let mut found = Found::default();
        product.components = vec![0; product.volume.mesh.len()];
        match console.stage(seconds, "topology", || Topology::of(&product.volume, for_betti, monitor)) {
            Ok(topology) => {
                product.components.copy_from_slice(topology.components.labels().of());
                found.topology = Some(topology);
            }
            Err(Cancelled) => return Ok(Found { stopped: Some("counting components"), ..found }),
        }
        if !args.no_verify {
            match console.stage(seconds, "verifying", || verify(surface, &product.volume, monitor)) {
                Ok(mut verification) => {
                    if let Some(tetrahedra) = &product.tetrahedra {
                        let conversion = console.stage(seconds, "verifying tetrahedra", || {
                            verify_conversion(&product.volume, tetrahedra.mesh(), monitor)
                        });
                        match conversion {
                            Ok(findings) => verification.add_conversion(findings),
                            Err(TetError::Cancelled(_)) => {
                                return Ok(Found { stopped: Some("verifying tetrahedra"), ..found });
                            }
                            Err(error) => unreachable!("tetrahedra of hexahedra are a complex: {error}"),
                        }
                    }
                    found.verification = Some(verification);
                }
                Err(Cancelled) => return Ok(Found { stopped: Some("verifying"), ..found }),
            }
        }
        if args.picture.is_some() {
            let (mesh, components) = (&product.volume.mesh, &product.components[..]);
            let cut = args.cut.unwrap_or_else(|| cutaway::through_overlap(&product.volume));
            let title = &args.input.file_stem().unwrap_or_default().to_string_lossy();
            let view = Cutaway { mesh, components, cut, camera: args.camera, size: args.picture_size, title };
            match cutaway::draw(&view, run, seconds, monitor) {
                Ok(image) => (found.image, found.cut) = (Some(image), Some(cut)),
                Err(Problem::Cancelled) => {
                    return Ok(Found { stopped: Some("drawing the picture"), ..found });
                }
                Err(problem) => return Err(problem.into_failure()),
            }
        }
        Ok(found)
    }
}

/// What was found out about a mesh.
#[derive(Default)]
struct Found {
    topology: Option<Topology>,
    verification: Option<Verification>,
    image: Option<Image>,
    /// Where the picture is cut.
    cut: Option<Cut>,
    /// What was under way when the time was up.
    stopped: Option<&'static str>,
}

/// Writes everything; returns what the format could not hold.
fn write(
    surface: &ClosedOrientedMesh,
    product: &Product,
    groups: &Groups,
    outputs: Outputs,
    image: Option<&Image>,
) -> Result<Vec<String>, Box<Failure>> {
    let boundary = if outputs.writing.with_boundary {
        // Nobody asks to stop here: the mesh is to be written.
        Boundary::of(product, surface, groups, &Monitor::none()).unwrap_or_default()
    } else {
        Boundary::default()
    };
    let dropped = outputs.writing.write(outputs.volume, product, &boundary)?;
    if let Some(output) = outputs.hosts {
        output.write(|file| hosts::write_hosts(file, product).map_err(WriteProblem::Io))?;
    }
    if let (Some(output), Some(image)) = (outputs.picture, image) {
        picture::write_png(image, output)?;
    }
    Ok(dropped)
}
