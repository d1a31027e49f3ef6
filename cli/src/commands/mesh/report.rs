//! What `welter mesh` tells: [`Report`], for people and as JSON.

use super::Job;
use super::findings::Topology;
use super::groups::Groups;
use super::product::Product;
use crate::console::Seconds;
use crate::failure::{Failure, shown};
use crate::input::STANDARD;
use crate::machine;
use crate::numbers::{grouped, number};
use crate::render::Cut;
use crate::run::{Outcome, Run};
use serde_json::{Map, Value, json};
use std::path::Path;
use welter_meshing::volumetric::Verification;

/// Everything that is told.
pub(super) struct Report<'a> {
    pub(super) job: &'a Job<'a>,
    pub(super) product: &'a Product,
    /// None if the time was up before.
    pub(super) topology: Option<&'a Topology>,
    /// None if it was not asked for, or if the time was up before.
    pub(super) verification: Option<&'a Verification>,
    pub(super) groups: &'a Groups,
    /// Where the picture is cut.
    pub(super) cut: Option<Cut>,
    /// What the format could not hold.
    pub(super) dropped: &'a [String],
}

impl Report<'_> {
    /// Tells it; the exit code is that of the failure, if there is one.
    pub(super) fn tell(&self, run: &Run, seconds: &Seconds, failure: Option<Box<Failure>>) -> Outcome {
        let console = &run.console;
        let args = self.job.args;
        if self.product.volume.ambiguous {
            console.note(
                "the surface bounds other volumes too: how its sheets hang together is not told by the surface alone",
            );
        }
        let wanted = self.product.volume.refinements + args.coarsen;
        if self.product.volume.coarsenings < wanted {
            console.note(&format!(
                "coarsened {} of {wanted} times: once more would change the topology",
                self.product.volume.coarsenings
            ));
        }
        console.note(&format!("{} written", args.output.display()));
        if args.output != Path::new(STANDARD) {
            console.result(&self.in_words())?;
        }
        let mut object = self.to_json();
        object.insert("seconds".to_owned(), seconds.to_json());
        object.insert("peak_rss_bytes".to_owned(), json!(machine::peak_memory()));
        if let Some(failure) = &failure {
            console.error(failure);
            object.insert("error".to_owned(), failure.to_json());
        }
        console.object(&Value::Object(object))?;
        Ok(failure.map_or(0, |failure| failure.code.exit()))
    }

    /// The most sheets that lie over one another.
    fn sheets(&self) -> i32 {
        self.product.volume.windings.iter().copied().max().unwrap_or(0).max(0)
    }

    fn tetrahedra(&self) -> Option<usize> {
        self.product.tetrahedra.as_ref().map(|tetrahedra| tetrahedra.mesh().tetrahedra.len())
    }

    fn to_json(&self) -> Map<String, Value> {
        let (args, volume) = (self.job.args, &self.product.volume);
        let grid = volume.mesh.grid();
        let h = grid.spacing();
        let axis = |cut: Cut| format!("{}={}", ["x", "y", "z"][cut.axis], cut.value);
        let value = json!({
            "input": shown(&args.input),
            "output": shown(&args.output),
            "cell_size": h,
            "cells_along_shortest_side": self.job.measures.shortest_side() / h,
            "origin": grid.origin(),
            "grid": grid.cells(),
            "hexahedra": volume.mesh.len(),
            "tetrahedra": self.tetrahedra().unwrap_or(0),
            "vertices": self.product.vertex_count(),
            "components": self.topology.map(|topology| topology.components.counts().len()),
            "euler_characteristic": self.topology.map(Topology::euler_characteristic),
            "betti": self.topology.and_then(|topology| topology.betti),
            "regions": volume.region_count(),
            "copies": volume.copy_count(),
            "sheets": self.sheets(),
            "refinements": volume.refinements,
            "coarsenings": volume.coarsenings,
            "ambiguous": volume.ambiguous,
            "surface_volume": self.job.measures.volume,
            "volume": volume.mesh.len() as f64 * h * h * h,
            "verification": self.verification.map(|found| json!({
                "winding_copies": found.winding_copies.none(),
                "euler": found.euler.none(),
                "embedding": found.embedding.none(),
                "cells": found.cells,
                "details": found.findings().map(ToString::to_string).collect::<Vec<_>>(),
            })),
            "groups": self.groups.names,
            "hosts": args.hosts.as_deref().map(shown),
            "picture": self.cut.and(args.picture.as_deref()).map(shown),
            "cut": self.cut.map(axis),
            "dropped": self.dropped,
        });
        match value {
            Value::Object(map) => map,
            _ => Map::new(),
        }
    }

    fn in_words(&self) -> String {
        let volume = &self.product.volume;
        let grid = volume.mesh.grid();
        let count = |n: usize| grouped(n as u64);
        let mut rows = vec![("hexahedra", count(volume.mesh.len()))];
        rows.extend(self.tetrahedra().map(|n| ("tetrahedra", count(n))));
        rows.push(("vertices", count(self.product.vertex_count())));
        if let Some(topology) = self.topology {
            rows.push(("components", count(topology.components.counts().len())));
            rows.push(("Euler characteristic", grouped(topology.euler_characteristic())));
            let betti = topology.betti.map_or("not computed: too large".to_owned(), |numbers| {
                numbers.map(grouped).join(" ") + "   (pieces, tunnels, cavities)"
            });
            rows.push(("Betti numbers", betti));
        }
        rows.push(("regions", format!("{}, of {} copies", count(volume.region_count()), count(volume.copy_count()))));
        rows.push(("sheets over one another", grouped(self.sheets())));
        if volume.refinements + volume.coarsenings > 0 {
            let text = format!("{} times, then doubled {} times", volume.refinements, volume.coarsenings);
            rows.push(("cells halved", text));
        }
        rows.push(("volume of the surface", number(self.job.measures.volume)));
        rows.push((
            "verified",
            match self.verification {
                None => "no".to_owned(),
                Some(found) if found.passed() => {
                    "copies match winding numbers, Euler characteristics, surface within".to_owned()
                }
                Some(_) => "FAILED".to_owned(),
            },
        ));
        let lines = rows.into_iter().map(|(name, value)| format!("  {name:<25}{value}\n"));
        let cells = grid.cells().map(grouped).join(" x ");
        let head = format!("{}: {cells} cells of side {}\n", self.job.args.input.display(), number(grid.spacing()));
        head + &lines.collect::<String>()
    }
}
