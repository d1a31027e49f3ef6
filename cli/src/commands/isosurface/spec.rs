//! A scene of `welter isosurface`: grid, surface and field, from the file.

use super::field::{Builder, Meshes};
use crate::codes::Code;
use crate::failure::Failure;
use crate::scene::{Scene, Section};
use glam::DVec3;
use std::ops::Range;
use std::path::PathBuf;
use toml::Spanned;
use toml::de::DeTable;
use welter_meshing::field::{AnyField, ScalarField};
use welter_meshing::grid::{Grid3, GridError};
use welter_meshing::spatial::Box3;

/// Cells along the shortest side of the box where the scene does not say: some 10,000 triangles of a ball.
const DEFAULT_CELLS: u64 = 64;

/// Cells between the box that a field gives and the wall of the grid: one would do, two keep the wall from being drawn onto.
const MARGIN: u32 = 2;

/// What the scene says, apart from the field.
#[derive(Clone, Debug)]
pub(super) struct Spec {
    bounds: Option<[DVec3; 2]>,
    fineness: Fineness,
    pub(super) level: f64,
    pub(super) crossing: Crossing,
    pub(super) wall: Wall,
    pub(super) triangles: Triangles,
    /// Where the grid is described, for faults of it.
    grid_span: Range<usize>,
}

#[derive(Clone, Copy, Debug)]
enum Fineness {
    Spacing(f64),
    Cells(u64),
}

/// Where on an edge of the grid a vertex is put.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Crossing {
    Root,
    Linear,
}

/// What happens where the inside reaches the wall of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wall {
    Cap,
    Open,
}

/// How the surface is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Triangles {
    MarchingCubes,
    /// As long as the cells of the grid.
    Equilateral,
}

impl Spec {
    pub(super) fn of(scene: &Scene, table: &Spanned<DeTable<'_>>) -> Result<Self, Box<Failure>> {
        let whole = Section::whole(scene, table);
        whole.only(&["grid", "surface", "field"])?;
        let mut spec = Self {
            bounds: None,
            fineness: Fineness::Cells(DEFAULT_CELLS),
            level: 0.0,
            crossing: Crossing::Root,
            wall: Wall::Cap,
            triangles: Triangles::MarchingCubes,
            grid_span: 0..0,
        };
        if let Some(grid) = whole.get("grid") {
            spec.grid_span = grid.span.clone();
            spec.read_grid(&grid.section()?)?;
        }
        if let Some(surface) = whole.get("surface") {
            spec.read_surface(&surface.section()?)?;
        }
        Ok(spec)
    }

    fn read_grid(&mut self, grid: &Section<'_>) -> Result<(), Box<Failure>> {
        grid.only(&["bounds", "spacing", "cells"])?;
        if let Some(bounds) = grid.get("bounds") {
            self.bounds = Some(bounds.vectors::<2>("an array of two points, least and greatest")?);
        }
        self.fineness = match (grid.get("spacing"), grid.get("cells")) {
            (Some(_), Some(cells)) => return Err(cells.bad("either spacing or cells, not both,")),
            (Some(spacing), None) => Fineness::Spacing(spacing.number()?),
            (None, Some(cells)) => match cells.whole_number()? {
                0 => return Err(cells.bad("a number of cells from 1 on")),
                count => Fineness::Cells(count),
            },
            (None, None) => Fineness::Cells(DEFAULT_CELLS),
        };
        Ok(())
    }

    fn read_surface(&mut self, surface: &Section<'_>) -> Result<(), Box<Failure>> {
        surface.only(&["level", "crossing", "wall", "triangles"])?;
        self.level = surface.number("level", 0.0)?;
        if !self.level.is_finite() {
            return Err(surface.bad("level", format!("the level is {}, must be finite", self.level)));
        }
        self.crossing =
            surface.choice("crossing", &[("root", Crossing::Root), ("linear", Crossing::Linear)])?;
        self.wall = surface.choice("wall", &[("cap", Wall::Cap), ("open", Wall::Open)])?;
        let triangles =
            [("marching-cubes", Triangles::MarchingCubes), ("equilateral", Triangles::Equilateral)];
        self.triangles = surface.choice("triangles", &triangles)?;
        if self.triangles == Triangles::Equilateral && self.wall == Wall::Open {
            return Err(
                surface.bad("wall", "near equilateral triangles need a closed surface: wall = \"cap\"")
            );
        }
        Ok(())
    }

    /// The grid, around the box that the scene gives, or else that of the field.
    pub(super) fn grid(&self, scene: &Scene, field: &AnyField<'_>) -> Result<Grid3, Box<Failure>> {
        let (around, margin) = match self.bounds {
            Some([min, max]) => (Box3 { min, max }, 0),
            None => (self.bounds_of(scene, field)?, MARGIN),
        };
        let spacing = match self.fineness {
            Fineness::Spacing(spacing) => spacing,
            Fineness::Cells(count) => (around.max - around.min).min_element() / count as f64,
        };
        Grid3::covering(around.min.to_array(), around.max.to_array(), spacing, margin).map_err(|error| {
            let fault = scene.fault(Code::GridRefused, &self.grid_span, error.to_string());
            match error {
                GridError::Nodes { .. } | GridError::Cells { .. } => {
                    fault.help("take a larger spacing, or fewer cells")
                }
                GridError::Inverted { .. } => fault.help("bounds = [[least x, y, z], [greatest x, y, z]]"),
                _ => fault.help("take a box nearer to the origin, or a larger spacing"),
            }
        })
    }

    fn bounds_of(&self, scene: &Scene, field: &AnyField<'_>) -> Result<Box3, Box<Failure>> {
        let example = "bounds = [[-1, -1, -1], [1, 1, 1]]   # in the table [grid]";
        match field.sublevel_bounds(self.level) {
            Some(around) if around.is_empty() => {
                let what = format!("the field is nowhere below {}", self.level);
                Err(scene.fault(Code::EmptySurface, &self.grid_span, what).help("raise the level"))
            }
            Some(around) => Ok(around),
            None => {
                let what = "the field has no bounds, and the scene gives none";
                Err(scene.fault(Code::NoBounds, &self.grid_span, what).help(example))
            }
        }
    }
}

/// The field of a scene; without meshes, all but these is checked, and the files that are needed are told.
pub(super) fn field<'m>(
    scene: &Scene,
    table: &Spanned<DeTable<'_>>,
    meshes: Option<&'m Meshes>,
) -> Result<(AnyField<'m>, Vec<PathBuf>), Box<Failure>> {
    let mut builder = Builder { meshes, files: Vec::new() };
    let field = builder.build(&Section::whole(scene, table).required("field")?)?;
    Ok((field, builder.files))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Everything that can be found out without files.
    fn read(text: String) -> Result<Grid3, Box<Failure>> {
        let scene = Scene::of("a.toml", text);
        let table = scene.parse()?;
        let spec = Spec::of(&scene, &table)?;
        let (field, _) = field(&scene, &table, None)?;
        let _ = field.value(DVec3::splat(0.1));
        spec.grid(&scene, &field)
    }

    const SCENE: &str = "[grid]\ncells = 9\n[surface]\nlevel = 0.1\nwall = \"open\"\n[field]\nkind = \"union\"\nblend_width = 0.2\n\
        parts = [{ kind = \"text\", words = \"a\" }, { kind = \"affine\", matrix = [[1, 0, 0], [0, 2, 0], [0, 0, 3]],\n\
        rotate = { axis = \"x\", degrees = 30 }, field = { kind = \"displaced\", amplitude = 0.1, octaves = 3,\n\
        field = { kind = \"torus\", radius = 2, tube_radius = 1e-1 } } }]\n";

    #[test]
    fn corrupted_scenes_are_read_or_refused() {
        assert!(read(SCENE.to_owned()).is_ok());
        let (mut accepted, mut refused) = (0, 0);
        for at in 0..SCENE.len() {
            let cut = SCENE[..at].to_owned();
            let without = format!("{}{}", &SCENE[..at], &SCENE[at + 1..]);
            let replaced = ["9", "-", "\"", "[", "}", "\n", "e", "\u{0}"]
                .map(|with| format!("{}{with}{}", &SCENE[..at], &SCENE[at + 1..]));
            for text in replaced.into_iter().chain([cut, without]) {
                match read(text) {
                    Ok(_) => accepted += 1,
                    Err(failure) => {
                        assert!(!failure.places.is_empty(), "{}", failure.what);
                        refused += 1;
                    }
                }
            }
        }
        assert!(accepted > 100 && refused > 1000, "{accepted} accepted, {refused} refused");
    }

    #[test]
    fn fields_within_fields_have_an_end() {
        let nested = |depth: usize| {
            let open = "{ kind = \"complement\", field = ".repeat(depth);
            let close = " }".repeat(depth);
            format!(
                "field = {open}{{ kind = \"ball\", radius = 1 }}{close}\n[grid]\nbounds = [[0, 0, 0], [1, 1, 1]]\n"
            )
        };
        assert!(read(nested(50)).is_ok());
        for depth in [70, 1000, 20_000] {
            assert!(read(nested(depth)).is_err(), "{depth}");
        }
        let header = format!("[field{}]\nkind = \"ball\"", ".field".repeat(5000));
        assert!(read(header).is_err());
    }
}
