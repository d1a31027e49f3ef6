//! How large the cells are, and what a mesh of them takes: found out from measures of the surface, before the work.

use crate::numbers;
use std::fmt::Write as _;
use welter_meshing::surface::ClosedOrientedMesh;
use welter_meshing::surface::measure::{area, bounding_box, signed_volume};
use welter_meshing::volumetric::Resolution;
use welter_meshing::volumetric::plane::ClosedPolylines;
use welter_meshing::{DVec2, DVec3};

/// Cells along the shortest side where nothing is asked for: those of most examples of \[Gagniere22\].
const CELLS: u32 = 63;

/// Hexahedra that a mesh has at most where nothing is asked for, as far as they can be foreseen: some seconds and half a GB.
const MOST_BY_DEFAULT: f64 = 3e6;

/// Quadrilaterals for each length of a cell on curves: likewise half of the 4/pi of them that a line meets, as a mean.
const BEYOND_A_LENGTH: f64 = 0.64;

/// Hexahedra for each square of the size of a cell on the surface, beyond the volume within: half of the cells that a surface meets lie
/// outside of it, and a plane of any direction meets 1.5 of them for each such square, as a mean.
const BEYOND_A_SQUARE: f64 = 0.75;

/// Memory of a mesh at the peak of the work, Betti numbers apart, in bytes for each hexahedron and for each square of the size of a cell on
/// the surface. Measured: 1,021 MB for 12,113,687 hexahedra of `ring-overlap`, 17 MB for 80,829, of which 8 MB are there without a mesh.
const BYTES_A_HEXAHEDRON: f64 = 90.0;
const BYTES_A_SQUARE: f64 = 200.0;

/// The same in the plane. Measured: 1,283 MB for 12,573,612 quadrilaterals of a disc, 187 MB for 1,602,712 of a thin ring in a grid of
/// 10,004 x 10,004 cells, 30 MB for 197,276, of which 8 MB are there without a mesh.
const BYTES_A_QUADRILATERAL: f64 = 110.0;
const BYTES_A_LENGTH: f64 = 200.0;

/// Memory for each triangle of a mesh in the plane; a quadrilateral becomes about four. Measured: 247 MB for 787,272 quadrilaterals.
const BYTES_A_TRIANGLE_OF_A_MESH: f64 = 50.0;
const TRIANGLES_OF_A_QUADRILATERAL: f64 = 4.0;

/// Memory for each triangle of the surface, or segment of the curves.
const BYTES_A_TRIANGLE: f64 = 250.0;

/// Memory for each tetrahedron; a hexahedron becomes about twelve. Measured: 397 MB for 607,777 hexahedra.
const BYTES_A_TETRAHEDRON: f64 = 48.0;
const TETRAHEDRA_OF_A_HEXAHEDRON: f64 = 12.0;

/// What is known of a surface, or of curves in the plane, before it is meshed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measures {
    /// Whether of curves in the plane.
    pub(super) plane: bool,
    /// Sides of the bounding box; of curves the last is 0.
    pub(super) sides: DVec3,
    /// Volume, or area within curves, parts that lie over each other counted as often; negative if the surface is inside out.
    pub(super) content: f64,
    /// Area of the surface, or length of the curves.
    boundary: f64,
    /// Triangles or segments.
    elements: usize,
}

impl Measures {
    pub(super) fn of(surface: &ClosedOrientedMesh) -> Self {
        let sides = bounding_box(surface).map_or(DVec3::ZERO, |around| around.max - around.min);
        Self {
            plane: false,
            sides,
            content: signed_volume(surface),
            boundary: area(surface),
            elements: surface.triangles().len(),
        }
    }

    pub(super) fn of_curves(curves: &ClosedPolylines) -> Self {
        let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (mut content, mut boundary) = (0.0, 0.0);
        let origin = if curves.is_empty() { DVec2::ZERO } else { curves.segment(0)[0] };
        for segment in 0..curves.len() as u32 {
            let [p, q] = curves.segment(segment);
            (min, max) = (min.min(p), max.max(p));
            content += 0.5 * (p - origin).perp_dot(q - origin);
            boundary += p.distance(q);
        }
        let sides = if curves.is_empty() { DVec2::ZERO } else { max - min };
        Self { plane: true, sides: sides.extend(0.0), content, boundary, elements: curves.len() }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.elements == 0
    }

    /// What cells are called.
    pub(super) fn cell_name(&self) -> &'static str {
        if self.plane { "quadrilaterals" } else { "hexahedra" }
    }

    /// The sides of the box along which there are cells, each as what it adds to their number.
    fn along_axes(&self, spacing: f64, beyond: f64) -> f64 {
        let axes = if self.plane { 2 } else { 3 };
        self.sides.to_array()[..axes].iter().map(|side| side / spacing + beyond).product()
    }

    /// Cells of the grid, at most.
    pub(super) fn cells_of_grid(&self, spacing: f64) -> f64 {
        self.along_axes(spacing, 3.0)
    }

    /// The side along which cells are counted: the shortest that is not 0.
    pub(super) fn shortest_side(&self) -> f64 {
        let sides = self.sides.to_array().into_iter().filter(|&side| side > 0.0);
        let shortest = sides.fold(f64::INFINITY, f64::min);
        if shortest.is_finite() { shortest } else { 1.0 }
    }

    /// Squares of the size of a cell on the surface, or lengths on the curves.
    fn squares(&self, spacing: f64) -> f64 {
        if self.plane { self.boundary / spacing } else { self.boundary / spacing / spacing }
    }

    /// About how many hexahedra or quadrilaterals a mesh has.
    pub(super) fn cells(&self, spacing: f64) -> f64 {
        let layers = if self.plane { 1.0 } else { spacing };
        let within = (self.content / spacing / spacing / layers).abs();
        // Volumes beyond the largest number: that of the box stands for it, in cells.
        let within = if within.is_finite() { within } else { self.along_axes(spacing, 1.0) };
        let beyond = if self.plane { BEYOND_A_LENGTH } else { BEYOND_A_SQUARE };
        within + beyond * self.squares(spacing)
    }

    /// About how many bytes it takes to make one, of tetrahedra or triangles if these are wanted.
    pub(super) fn bytes(&self, spacing: f64, simplices: bool) -> f64 {
        let (cell, square, of_simplices) = if self.plane {
            let of_simplices = TRIANGLES_OF_A_QUADRILATERAL * BYTES_A_TRIANGLE_OF_A_MESH;
            (BYTES_A_QUADRILATERAL, BYTES_A_LENGTH, of_simplices)
        } else {
            (BYTES_A_HEXAHEDRON, BYTES_A_SQUARE, TETRAHEDRA_OF_A_HEXAHEDRON * BYTES_A_TETRAHEDRON)
        };
        let per_cell = if simplices { cell + of_simplices } else { cell };
        self.cells(spacing) * per_cell
            + self.squares(spacing) * square
            + self.elements as f64 * BYTES_A_TRIANGLE
    }

    /// The smallest cells, to two digits, for which `grows` (which falls as cells grow) is at most `most`; none if no cells are.
    pub(super) fn smallest_cells(&self, most: f64, grows: impl Fn(f64) -> f64) -> Option<f64> {
        let longest = self.sides.max_element();
        let (mut fine, mut coarse) = (longest * 2f64.powi(-40), longest);
        if !(longest > 0.0 && longest.is_finite() && grows(coarse) <= most) {
            return None;
        }
        if grows(fine) <= most {
            return Some(fine);
        }
        for _ in 0..60 {
            let middle = (fine * coarse).sqrt();
            if grows(middle) <= most { coarse = middle } else { fine = middle }
        }
        Some(rounded_up(coarse))
    }
}

/// The next number of two digits, as its decimals are read.
fn rounded_up(x: f64) -> f64 {
    let exponent = libm::floor(libm::log10(x)) as i32 - 1;
    let digits = (x / libm::pow(10.0, f64::from(exponent))).ceil();
    format!("{digits}e{exponent}").parse().unwrap_or(x)
}

/// The size of cells that is taken, and why.
#[derive(Clone, Debug)]
pub(super) struct Chosen {
    pub(super) resolution: Resolution,
    /// The length that stands for.
    pub(super) spacing: f64,
    /// What is told of a choice that was made here.
    pub(super) note: Option<String>,
}

/// The resolution that was asked for, or else one that gives a mesh of a few million hexahedra at most.
pub(super) fn choose(measures: &Measures, cells: Option<u32>, spacing: Option<f64>) -> Chosen {
    let along = |cells: u32| measures.shortest_side() / f64::from(cells);
    match (cells, spacing) {
        (_, Some(spacing)) => Chosen { resolution: Resolution::Spacing(spacing), spacing, note: None },
        (Some(cells), None) => {
            Chosen { resolution: Resolution::ShortestSide(cells), spacing: along(cells), note: None }
        }
        (None, None) => by_default(measures),
    }
}

fn by_default(measures: &Measures) -> Chosen {
    let spacing_of = |cells: u32| measures.shortest_side() / f64::from(cells);
    let fine = measures.cells(spacing_of(CELLS));
    let largest = measures.smallest_cells(MOST_BY_DEFAULT, |spacing| measures.cells(spacing));
    let mut note = format!("{CELLS} cells along the shortest side");
    let (resolution, spacing) = match largest.filter(|_| fine > MOST_BY_DEFAULT) {
        None => (Resolution::ShortestSide(CELLS), spacing_of(CELLS)),
        Some(spacing) => {
            let count = (measures.shortest_side() / spacing).floor();
            let _ = write!(note, " would be about {} {}, so ", numbers::number(fine), measures.cell_name());
            if count >= 1.0 {
                let cells = count as u32; // below CELLS
                let _ = write!(note, "{cells} were taken");
                (Resolution::ShortestSide(cells), spacing_of(cells))
            } else {
                let _ = write!(note, "cells of side {spacing:?} were taken");
                (Resolution::Spacing(spacing), spacing)
            }
        }
    };
    note.push_str(" (-r or -s for others)");
    Chosen { resolution, spacing, note: Some(note) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use welter_meshing::shapes::{Box_, box_};

    fn slab(thickness: f64) -> Measures {
        let max = DVec3::new(1.0, 1.0, thickness);
        Measures::of(&box_(&Box_ { min: DVec3::ZERO, max, ..Box_::default() }).expect("a box"))
    }

    #[test]
    fn a_cube_has_63_cells_along_its_side_by_default() {
        let chosen = choose(&slab(1.0), None, None);
        assert_eq!(chosen.resolution, Resolution::ShortestSide(63));
        let hexahedra = slab(1.0).cells(chosen.spacing);
        // 64^3 or 65^3, as the grid falls.
        assert!((262_144.0..=275_000.0).contains(&hexahedra), "{hexahedra}");
    }

    #[test]
    fn a_thin_plate_gets_cells_that_are_not_too_many() {
        for thickness in [0.1, 0.01, 1e-3, 1e-9] {
            let measures = slab(thickness);
            let chosen = choose(&measures, None, None);
            assert!(measures.cells(chosen.spacing) <= 1.2 * MOST_BY_DEFAULT, "{thickness}: {chosen:?}");
            assert!(chosen.note.expect("chosen here").contains("so "), "{thickness}");
        }
    }

    #[test]
    fn what_fits_is_found_to_two_digits() {
        let measures = slab(1.0);
        let spacing = measures.smallest_cells(1e8, |h| measures.bytes(h, false)).expect("some fit");
        assert!(measures.bytes(spacing, false) <= 1e8 && measures.bytes(0.85 * spacing, false) > 1e8);
        assert_eq!(rounded_up(0.01234), 0.013);
        assert_eq!(measures.smallest_cells(10.0, |h| measures.bytes(h, false)), None);
    }
}
