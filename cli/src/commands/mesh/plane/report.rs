//! What is told of a mesh of an area: [`Report`], for people and as JSON.

use super::sheet::Sheet;
use crate::commands::mesh::Job;
use crate::console::Seconds;
use crate::failure::{Failure, shown};
use crate::input::STANDARD;
use crate::numbers::{grouped, number};
use crate::run::{Outcome, Run};
use crate::{interrupt, machine};
use serde_json::{Value, json};
use std::path::Path;
use welter_meshing::volumetric::plane::AreaVerification;

/// Everything that is told.
pub(super) struct Report<'a> {
    pub(super) job: &'a Job<'a>,
    /// How many curves there are.
    pub(super) curves: usize,
    pub(super) sheet: &'a Sheet,
    /// None if it was not asked for, or if there was no time for it.
    pub(super) verification: Option<&'a AreaVerification>,
    /// Whether there is a picture.
    pub(super) drawn: bool,
    /// What the format could not hold.
    pub(super) dropped: &'a [String],
}

impl Report<'_> {
    /// Tells it; the exit code is that of the failure, if there is one.
    pub(super) fn tell(&self, run: &Run, seconds: &Seconds, failure: Option<Box<Failure>>) -> Outcome {
        interrupt::end_begins();
        let (console, args) = (&run.console, self.job.args);
        if self.sheet.area.ambiguous {
            console.note(
                "the curves bound other areas too, which hang together in another way; this is one of them",
            );
        }
        console.note(&format!("{} written", args.output.display()));
        if args.output != Path::new(STANDARD) {
            let rows = self.rows().into_iter().map(|(name, value)| format!("  {name:<25}{value}\n"));
            console.result(&format!("{}\n{}", args.input.display(), rows.collect::<String>()))?;
        }
        let mut object = self.to_json(seconds);
        if let Some(failure) = &failure {
            console.error(failure);
            object["error"] = failure.to_json();
        }
        console.object(&object)?;
        Ok(failure.map_or(0, |failure| failure.code.exit()))
    }

    fn triangles(&self) -> Option<usize> {
        self.sheet.triangles.as_ref().map(|triangles| triangles.triangles.len())
    }

    fn euler_characteristic(&self) -> i64 {
        self.sheet.characteristics.iter().sum()
    }

    /// The most sheets that lie over one another.
    fn sheets(&self) -> i32 {
        self.sheet.area.windings.iter().copied().max().unwrap_or(0).max(0)
    }

    fn to_json(&self, seconds: &Seconds) -> Value {
        let (args, area, measures) = (self.job.args, &self.sheet.area, &self.job.measures);
        let grid = area.mesh.grid();
        let h = grid.spacing();
        json!({
            "input": shown(&args.input),
            "output": shown(&args.output),
            "dimension": 2,
            "cell_size": h,
            "cells_along_shortest_side": measures.shortest_side() / h,
            "origin": grid.origin(),
            "grid": grid.cells(),
            "curves": self.curves,
            "hexahedra": 0,
            "tetrahedra": 0,
            "quadrilaterals": area.mesh.len(),
            "triangles": self.triangles().unwrap_or(0),
            "vertices": self.sheet.vertex_count(),
            "components": self.sheet.characteristics.len(),
            "euler_characteristic": self.euler_characteristic(),
            "regions": area.region_count(),
            "copies": area.copy_count(),
            "sheets": self.sheets(),
            "refinements": area.refinements,
            "coarsenings": 0,
            "ambiguous": area.ambiguous,
            "curve_area": measures.content,
            "area": area.mesh.len() as f64 * h * h,
            "verification": self.verification.map(|found| json!({
                "winding_copies": found.winding_copies.none(),
                "euler": found.euler.none(),
                "embedding": found.embedding.none(),
                "cells": found.cells,
                "details": found.findings().map(ToString::to_string).collect::<Vec<_>>(),
            })),
            "picture": args.picture.as_deref().filter(|_| self.drawn).map(shown),
            "dropped": self.dropped,
            "seconds": seconds.to_json(),
            "peak_rss_bytes": machine::peak_memory(),
        })
    }

    /// Names and values.
    fn rows(&self) -> Vec<(&'static str, String)> {
        let area = &self.sheet.area;
        let grid = area.mesh.grid();
        let count = |n: usize| grouped(n as u64);
        let cells = grid.cells().map(grouped).join(" x ");
        let mut rows = vec![
            ("curves", count(self.curves)),
            ("cells", format!("{cells} of side {}", number(grid.spacing()))),
            ("quadrilaterals", count(area.mesh.len())),
        ];
        rows.extend(self.triangles().map(|n| ("triangles", count(n))));
        rows.extend([
            ("vertices", count(self.sheet.vertex_count())),
            ("components", count(self.sheet.characteristics.len())),
            ("Euler characteristic", grouped(self.euler_characteristic())),
            ("regions", format!("{}, of {} copies", count(area.region_count()), count(area.copy_count()))),
            ("sheets over one another", grouped(self.sheets())),
        ]);
        if area.refinements > 0 {
            rows.push(("cells halved", format!("{} times", area.refinements)));
        }
        rows.push(("area within the curves", number(self.job.measures.content)));
        let verified = match self.verification {
            None => "no",
            Some(found) if found.passed() => {
                "copies match winding numbers, Euler characteristics, curves within"
            }
            Some(_) => "FAILED",
        };
        rows.push(("verified", verified.to_owned()));
        rows
    }
}
