//! The area of closed curves in the plane, as quadrilaterals or triangles; where the curves overlap themselves, sheets of the mesh lie over
//! one another and stay apart.

mod picture;
mod refused;
mod report;
mod sheet;

use super::cell_size::{self, Measures};
use super::clock::Clock;
use super::outputs::Outputs;
use super::refused::{not_verified, refused};
use super::{Args, Job};
use crate::console::Seconds;
use crate::failure::Failure;
use crate::picture::write_png;
use crate::render::Image;
use crate::run::{Outcome, Run};
use report::Report;
use sheet::Sheet;
use welter_meshing::volumetric::plane::{AreaVerification, ClosedPolylines, mesh_area, verify_area};
use welter_meshing::{Cancelled, DVec3, Monitor};

/// Meshes the area of the curves that lines make up.
pub(super) fn run(
    args: &Args,
    positions: &[DVec3],
    lines: &[Vec<u32>],
    outputs: Outputs,
    clock: &Clock,
    mut seconds: Seconds,
    run: &Run,
) -> Outcome {
    let console = &run.console;
    refused::options_of_surfaces(args)?;
    let joined = console.stage(&mut seconds, "checking", || ClosedPolylines::joined(positions, lines));
    let curves = joined.map_err(|error| refused::no_curves(args, positions, &error))?;
    let height = lines.iter().flatten().next().map_or(0.0, |&vertex| positions[vertex as usize].z);
    let report = |p: welter_meshing::Progress| console.progress.report(p.stage, p.done, p.total);
    let monitor = Monitor::new(Some(&report), Some(clock.flag()));
    let measures = Measures::of_curves(&curves);
    let chosen = cell_size::choose(&measures, args.resolution, args.spacing);
    let job = Job { args, measures, chosen, clock };
    if let Some(note) = &job.chosen.note {
        console.note(note);
    }
    let parameters = job.parameters()?;
    let area = console
        .stage(&mut seconds, "meshing", || mesh_area(&curves, &parameters, &monitor))
        .map_err(|error| refused(&job, &error))?;
    let made = console.stage(&mut seconds, "cells", || Sheet::new(area, height, args.tet));
    let sheet = made.ok_or_else(|| refused::too_many_triangles(args))?;
    job.deliver_area(&curves, &sheet, outputs, run, seconds, &monitor)
}

impl Job<'_> {
    /// Finds out what is to be told, and writes everything. Once there is a mesh it is written, whatever comes.
    fn deliver_area(
        &self,
        curves: &ClosedPolylines,
        sheet: &Sheet,
        outputs: Outputs,
        run: &Run,
        mut seconds: Seconds,
        monitor: &Monitor<'_>,
    ) -> Outcome {
        let (args, console) = (self.args, &run.console);
        let found = self.find_out_of_area(curves, sheet, run, &mut seconds, monitor)?;
        let dropped = console.stage(&mut seconds, "writing", || -> Result<_, Box<Failure>> {
            let dropped = sheet.write(&outputs.writing, outputs.volume)?;
            if let (Some(output), Some(image)) = (outputs.picture, &found.image) {
                write_png(image, output)?;
            }
            Ok(dropped)
        })?;
        console.progress.clear();
        for loss in &dropped {
            console.note(&format!("{}: {loss}", args.output.display()));
        }
        let failure = match &found.verification {
            Some(verification) if !verification.passed() => Some(not_verified(args, verification.findings())),
            _ => found.stopped.map(|stage| self.clock.time_is_up(stage)),
        };
        let verification = found.verification.as_ref();
        let drawn = found.image.is_some();
        let report =
            Report { job: self, curves: curves.loops().len(), sheet, verification, drawn, dropped: &dropped };
        report.tell(run, &seconds, failure)
    }

    /// Looks at the mesh until the time is up.
    fn find_out_of_area(
        &self,
        curves: &ClosedPolylines,
        sheet: &Sheet,
        run: &Run,
        seconds: &mut Seconds,
        monitor: &Monitor<'_>,
    ) -> Result<Found, Box<Failure>> {
        let (args, console) = (self.args, &run.console);
        let mut found = Found::default();
        if !args.no_verify {
            match console.stage(seconds, "verifying", || verify_area(curves, &sheet.area, monitor)) {
                Ok(verification) => found.verification = Some(verification),
                Err(Cancelled) => return Ok(Found { stopped: Some("verifying"), ..found }),
            }
        }
        if args.picture.is_some() {
            picture::affordable(args)?;
            let drawn = console
                .stage(seconds, "drawing", || picture::draw(curves, &sheet.area, args.picture_size, monitor));
            match drawn {
                Ok(image) => found.image = Some(image),
                Err(Cancelled) => return Ok(Found { stopped: Some("drawing the picture"), ..found }),
            }
        }
        Ok(found)
    }
}

/// What was found out about a mesh.
#[derive(Default)]
struct Found {
    verification: Option<AreaVerification>,
    image: Option<Image>,
    /// What was under way when the time was up.
    stopped: Option<&'static str>,
}
