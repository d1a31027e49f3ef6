//! Findings for people: a verdict, a block for one file, a row for many.

use super::Findings;
use crate::numbers::{grouped, number, point};
use crate::table::aligned;
use std::fmt::Write as _;
use std::path::Path;

/// Column heads of [`row`].
pub(crate) const HEADINGS: [&str; 9] =
    ["file", "triangles", "comp.", "genus", "closed", "oriented", "manifold", "volume", "self-int."];

impl Findings {
    /// The answer in one sentence.
    pub(crate) fn verdict(&self) -> String {
        if self.triangles == 0 {
            return "no triangles".to_owned();
        }
        let topology = &self.topology;
        let mut parts = vec![
            match self.boundary_edges.len() {
                0 => "closed".to_owned(),
                n => format!("open ({})", count(n, "boundary edge")),
            },
            match topology.inconsistent_edges().len() {
                0 => "consistently oriented".to_owned(),
                n => format!("not consistently oriented ({})", count(n, "edge")),
            },
        ];
        for (n, what) in [
            (topology.non_manifold_edges().len(), "non-manifold edge"),
            (topology.non_manifold_vertices().len(), "non-manifold vertex"),
            (self.inside_out_components, "inside-out component"),
            (self.degenerate.len(), "degenerate triangle"),
            (self.duplicate_triangles, "duplicate triangle"),
            (self.duplicate_vertices, "duplicate vertex"),
        ] {
            if n > 0 {
                parts.push(count(n, what));
            }
        }
        parts.push(match (self.pairs.first(), self.first_near) {
            (Some([i, j]), Some(near)) => format!(
                "{}, first {} and {} near {}",
                count(self.pairs.len(), "self-intersecting triangle pair"),
                i.0,
                j.0,
                point(near)
            ),
            _ => "free of self-intersection".to_owned(),
        });
        parts.join(", ")
    }
}

/// Names and values, as one list.
pub(crate) fn facts(f: &Findings) -> Vec<(&'static str, String)> {
    let topology = &f.topology;
    let yes = |is: bool| if is { "yes" } else { "no" }.to_owned();
    let known = |value: Option<String>| value.unwrap_or_else(|| "-".to_owned());
    vec![
        ("vertices", grouped(f.vertices as u64)),
        ("triangles", grouped(f.triangles as u64)),
        ("components", grouped(topology.components().len() as u64)),
        ("genus", known(topology.genus().map(grouped))),
        ("Euler characteristic", grouped(topology.euler_characteristic())),
        ("area", number(f.area)),
        ("volume", known(f.volume.map(number))),
        ("inside-out components", grouped(f.inside_out_components as u64)),
        ("closed", yes(topology.is_closed())),
        ("oriented", yes(topology.is_oriented())),
        ("edge-manifold", yes(topology.is_edge_manifold())),
        ("vertex-manifold", yes(topology.is_vertex_manifold())),
        ("degenerate triangles", grouped(f.degenerate.len() as u64)),
        ("duplicate vertices", grouped(f.duplicate_vertices as u64)),
        ("duplicate triangles", grouped(f.duplicate_triangles as u64)),
        ("self-intersecting pairs", grouped(f.pairs.len() as u64)),
    ]
}

/// The findings on one file: two columns of facts, then the verdict.
pub(crate) fn block(file: &Path, f: &Findings) -> String {
    let facts = facts(f);
    let (left, right) = facts.split_at(facts.len() / 2);
    let mut rows = Vec::new();
    for ((a, x), (b, y)) in left.iter().zip(right) {
        rows.push([format!("  {a}"), x.clone(), format!("   {b}"), y.clone()]);
    }
    let mut text = format!("{}\n{}", file.display(), aligned(&rows, &[0, 2]));
    if let Some([low, high]) = f.bounding_box {
        let _ = writeln!(text, "  bounding box  {} .. {}", point(low), point(high));
    }
    let _ = writeln!(text, "{}: {}", file.display(), f.verdict());
    text
}

/// The findings on one of many files.
pub(crate) fn row(file: &Path, f: &Findings) -> [String; 9] {
    let topology = &f.topology;
    let yes = |is: bool| if is { "yes" } else { "no" }.to_owned();
    let known = |value: Option<String>| value.unwrap_or_else(|| "-".to_owned());
    [
        file.display().to_string(),
        grouped(f.triangles as u64),
        grouped(topology.components().len() as u64),
        known(topology.genus().map(grouped)),
        yes(topology.is_closed()),
        yes(topology.is_oriented()),
        yes(topology.is_edge_manifold() && topology.is_vertex_manifold()),
        known(f.volume.map(number)),
        grouped(f.pairs.len() as u64),
    ]
}

/// `1 edge`, `2 edges`, `2 vertices`.
fn count(n: usize, what: &str) -> String {
    match (n, what.strip_suffix("vertex")) {
        (1, _) => format!("1 {what}"),
        (_, Some(before)) => format!("{} {before}vertices", grouped(n as u64)),
        _ => format!("{} {what}s", grouped(n as u64)),
    }
}
