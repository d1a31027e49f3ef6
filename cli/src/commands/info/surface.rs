//! What a surface file holds: [`SurfaceFacts`].

use super::{Bounds, LISTED, Line, ignored, not_read, size};
use crate::failure::{Failure, shown};
use crate::input::{Input, Reading};
use crate::numbers::{bytes, grouped};
use crate::run::Run;
use serde_json::{Value, json};
use std::path::Path;
use welter_meshing::io::{Format, ReadReport};
use welter_meshing::surface::TriangleSoup;

pub(super) struct SurfaceFacts {
    format: Format,
    bytes: Option<u64>,
    soup: TriangleSoup,
    held: ReadReport,
    bounds: Bounds,
}

impl SurfaceFacts {
    pub(super) fn of(file: &Path, reading: &Reading, run: &Run) -> Result<Self, Box<Failure>> {
        let input = Input::open(file, reading)?;
        let (format, bytes) = (input.format, input.bytes);
        let (soup, held) = input.read(&run.console.progress)?;
        run.console.progress.clear();
        let bounds = Bounds::of(&soup.positions);
        Ok(Self { format, bytes, soup, held, bounds })
    }

    pub(super) fn row(&self, name: String) -> [String; 7] {
        [
            name,
            self.format.to_string(),
            self.bytes.map_or_else(String::new, grouped),
            grouped(self.soup.positions.len() as u64),
            grouped(self.soup.triangles.len() as u64),
            grouped(self.soup.groups.len() as u64),
            self.bounds.sides.map_or_else(String::new, size),
        ]
    }

    pub(super) fn lines(&self) -> Vec<Line> {
        let size_on_disk = self.bytes.map_or_else(String::new, |count| format!(", {}", bytes(count)));
        let mut lines: Vec<Line> = vec![
            ("format", format!("{}{size_on_disk}", self.format)),
            ("vertices", grouped(self.soup.positions.len() as u64)),
            ("triangles", grouped(self.soup.triangles.len() as u64)),
        ];
        lines.extend(self.bounds.lines());
        if !self.soup.triangle_colors.is_empty() {
            lines.push(("colours", "one a triangle".to_owned()));
        }
        lines.extend(not_read(&self.held));
        for (k, group) in self.soup.groups.iter().enumerate().take(LISTED) {
            let label = if k == 0 { "groups" } else { "" };
            lines.push((
                label,
                format!("{:?}, {} triangles", group.name, grouped(group.triangles.len() as u64)),
            ));
        }
        if self.soup.groups.len() > LISTED {
            lines.push(("", format!("and {} more", grouped((self.soup.groups.len() - LISTED) as u64))));
        }
        lines
    }

    pub(super) fn to_json(&self, file: &Path) -> Value {
        let groups: Vec<Value> = self
            .soup
            .groups
            .iter()
            .map(|group| json!({ "name": group.name, "triangles": group.triangles.len() }))
            .collect();
        json!({
            "file": shown(file),
            "format": self.format.extension(),
            "bytes": self.bytes,
            "vertices": self.soup.positions.len(),
            "triangles": self.soup.triangles.len(),
            "non_finite_vertices": self.bounds.non_finite,
            "bounding_box": self.bounds.to_json(),
            "groups": groups,
            "triangle_colors": !self.soup.triangle_colors.is_empty(),
            "not_read": ignored(&self.held),
        })
    }
}
