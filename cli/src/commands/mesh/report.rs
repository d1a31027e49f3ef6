//! What `welter mesh` tells: [`Report`], for people and as JSON.

use super::Job;
use super::facts::Facts;
use super::groups::Groups;
use crate::console::Seconds;
use crate::failure::{Failure, shown};
use crate::input::STANDARD;
use crate::render::Cut;
use crate::run::{Outcome, Run};
use crate::{interrupt, machine, numbers};
use serde_json::{Value, json};
use std::path::Path;

/// Times the volume of the surface that a mesh has before it is told that its cells are wide.
const WIDE: f64 = 2.0;

/// Everything that is told.
pub(super) struct Report<'a> {
    pub(super) job: &'a Job<'a>,
    pub(super) facts: Facts<'a>,
    pub(super) groups: &'a Groups,
    /// Where the picture is cut.
    pub(super) cut: Option<Cut>,
    /// What the format could not hold.
    pub(super) dropped: &'a [String],
}

impl Report<'_> {
    /// The volume of the mesh, as a multiple of that of the surface.
    fn times_the_volume(&self) -> f64 {
        let mesh = &self.facts.product.volume.mesh;
        mesh.len() as f64 * mesh.grid().spacing().powi(3) / self.facts.surface_volume
    }

    /// Tells it; the exit code is that of the failure, if there is one.
    pub(super) fn tell(&self, run: &Run, seconds: &Seconds, failure: Option<Box<Failure>>) -> Outcome {
        interrupt::end_begins();
        let (console, args, volume) = (&run.console, self.job.args, &self.facts.product.volume);
        if volume.ambiguous {
            console.note("the surface bounds other volumes too, which hang together in another way; this is one of them");
        }
        let wanted = volume.refinements + args.coarsen;
        if volume.coarsenings < wanted {
            console.note(&format!(
                "coarsened {} of {wanted} times: once more would change the topology, or join sheets that overlap",
                volume.coarsenings
            ));
        }
        let times = self.times_the_volume();
        if times > WIDE && times.is_finite() {
            console.note(&format!(
                "the mesh has {} times the volume of the surface: the cells are wider than most of it is thick (-r or -s for smaller ones)",
                numbers::number(times)
            ));
        }
        console.note(&format!("{} written", args.output.display()));
        if args.output != Path::new(STANDARD) {
            console.result(&format!("{}\n{}", args.input.display(), self.facts.in_words()))?;
        }
        let mut object = self.facts.to_json();
        let axis = |cut: Cut| format!("{}={}", ["x", "y", "z"][cut.axis], cut.value);
        for (key, value) in [
            ("input", json!(shown(&args.input))),
            ("output", json!(shown(&args.output))),
            (
                "cells_along_shortest_side",
                json!(self.job.measures.shortest_side() / volume.mesh.grid().spacing()),
            ),
            ("groups", json!(self.groups.names)),
            ("hosts", json!(args.hosts.as_deref().map(shown))),
            ("picture", json!(self.cut.and(args.picture.as_deref()).map(shown))),
            ("cut", json!(self.cut.map(axis))),
            ("dropped", json!(self.dropped)),
            ("seconds", seconds.to_json()),
            ("peak_rss_bytes", json!(machine::peak_memory())),
        ] {
            object.insert(key.to_owned(), value);
        }
        if let Some(failure) = &failure {
            console.error(failure);
            object.insert("error".to_owned(), failure.to_json());
        }
        console.object(&Value::Object(object))?;
        Ok(failure.map_or(0, |failure| failure.code.exit()))
    }
}
