//! What is known of a volumetric mesh, as rows for people and as JSON: [`Facts`].

use super::findings::Topology;
use super::product::Product;
use crate::numbers::{grouped, number};
use serde_json::{Map, Value, json};
use welter_meshing::volumetric::Verification;

/// A mesh and what was found out about it.
#[derive(Clone, Copy)]
pub(crate) struct Facts<'a> {
    pub(crate) product: &'a Product,
    /// None if there was no time for it.
    pub(crate) topology: Option<&'a Topology>,
    /// None if it was not asked for, or if there was no time for it.
    pub(crate) verification: Option<&'a Verification>,
    /// Of the surface, what lies over itself counted as often.
    pub(crate) surface_volume: f64,
}

impl Facts<'_> {
    /// The most sheets that lie over one another.
    fn sheets(&self) -> i32 {
        self.product.volume.windings.iter().copied().max().unwrap_or(0).max(0)
    }

    fn tetrahedra(&self) -> Option<usize> {
        self.product.tetrahedra.as_ref().map(|tetrahedra| tetrahedra.mesh().tetrahedra.len())
    }

    /// The keys of `mesh --json` that are about the mesh itself.
    pub(crate) fn to_json(self) -> Map<String, Value> {
        let volume = &self.product.volume;
        let grid = volume.mesh.grid();
        let h = grid.spacing();
        let value = json!({
            "cell_size": h,
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
            "surface_volume": self.surface_volume,
            "volume": volume.mesh.len() as f64 * h * h * h,
            "verification": self.verification.map(|found| json!({
                "winding_copies": found.winding_copies.none(),
                "euler": found.euler.none(),
                "embedding": found.embedding.none(),
                "cells": found.cells,
                "details": found.findings().map(ToString::to_string).collect::<Vec<_>>(),
            })),
        });
        match value {
            Value::Object(map) => map,
            _ => Map::new(),
        }
    }

    /// Names and values.
    pub(crate) fn rows(self) -> Vec<(&'static str, String)> {
        let volume = &self.product.volume;
        let grid = volume.mesh.grid();
        let count = |n: usize| grouped(n as u64);
        let cells = grid.cells().map(grouped).join(" x ");
        let mut rows = vec![
            ("cells", format!("{cells} of side {}", number(grid.spacing()))),
            ("hexahedra", count(volume.mesh.len())),
        ];
        rows.extend(self.tetrahedra().map(|n| ("tetrahedra", count(n))));
        rows.push(("vertices", count(self.product.vertex_count())));
        if let Some(topology) = self.topology {
            rows.push(("components", count(topology.components.counts().len())));
            rows.push(("Euler characteristic", grouped(topology.euler_characteristic())));
            let betti = topology.betti.map_or("not computed".to_owned(), |numbers| {
                numbers.map(grouped).join(" ") + "   (pieces, tunnels, cavities)"
            });
            rows.push(("Betti numbers", betti));
        }
        rows.push((
            "regions",
            format!("{}, of {} copies", count(volume.region_count()), count(volume.copy_count())),
        ));
        rows.push(("sheets over one another", grouped(self.sheets())));
        if volume.refinements + volume.coarsenings > 0 {
            let text = format!("{} times, then doubled {} times", volume.refinements, volume.coarsenings);
            rows.push(("cells halved", text));
        }
        rows.push(("volume of the surface", number(self.surface_volume)));
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
        rows
    }

    /// The rows as lines.
    pub(crate) fn in_words(self) -> String {
        self.rows().into_iter().map(|(name, value)| format!("  {name:<25}{value}\n")).collect()
    }
}
