//! How large the cells are, and what a mesh of them takes: found out from measures of the surface, before the work.

use std::fmt::Write as _;
use welter_meshing::DVec3;
use welter_meshing::surface::ClosedOrientedMesh;
use welter_meshing::surface::measure::{area, bounding_box, signed_volume};
use welter_meshing::volumetric::Resolution;

/// Cells along the shortest side where nothing is asked for: those of most examples of \[Gagniere22\].
const CELLS: u32 = 63;

/// Hexahedra that a mesh has at most where nothing is asked for, as far as they can be foreseen: some seconds and half a GB.
const MOST_BY_DEFAULT: f64 = 3e6;

/// Hexahedra for each square of the size of a cell on the surface, beyond the volume within: half of the cells that a surface meets lie
/// outside of it, and a plane of any direction meets 1.5 of them for each such square, as a mean.
const BEYOND_A_SQUARE: f64 = 0.75;

/// Memory of a mesh at the peak of the work, Betti numbers apart, in bytes for each hexahedron and for each square of the size of a cell on
/// the surface. Measured: 1,021 MB for 12,113,687 hexahedra of `ring-overlap`, 17 MB for 80,829, of which 8 MB are there without a mesh.
const BYTES_A_HEXAHEDRON: f64 = 90.0;
const BYTES_A_SQUARE: f64 = 200.0;

/// Memory for each triangle of the surface.
const BYTES_A_TRIANGLE: f64 = 250.0;

/// Memory for each tetrahedron; a hexahedron becomes about twelve. Measured: 397 MB for 607,777 hexahedra.
const BYTES_A_TETRAHEDRON: f64 = 48.0;
const TETRAHEDRA_OF_A_HEXAHEDRON: f64 = 12.0;

/// What is known of a surface before it is meshed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measures {
    /// Sides of the bounding box.
    pub(super) sides: DVec3,
    /// Volume, parts that lie over each other counted as often; negative if the surface is inside out.
    pub(super) volume: f64,
    area: f64,
    triangles: usize,
}

impl Measures {
    pub(super) fn of(surface: &ClosedOrientedMesh) -> Self {
        let sides = bounding_box(surface).map_or(DVec3::ZERO, |around| around.max - around.min);
        Self {
            sides,
            volume: signed_volume(surface),
            area: area(surface),
            triangles: surface.triangles().len(),
        }
    }

    /// The side along which cells are counted: the shortest that is not 0.
    pub(super) fn shortest_side(&self) -> f64 {
        let sides = self.sides.to_array().into_iter().filter(|&side| side > 0.0);
        let shortest = sides.fold(f64::INFINITY, f64::min);
        if shortest.is_finite() { shortest } else { 1.0 }
    }

    /// Squares of the size of a cell on the surface.
    fn squares(&self, spacing: f64) -> f64 {
        self.area / spacing / spacing
    }

    /// About how many hexahedra a mesh has.
    pub(super) fn hexahedra(&self, spacing: f64) -> f64 {
        let within = (self.volume / spacing / spacing / spacing).abs();
        // Volumes beyond the largest number: that of the box stands for it, in cells.
        let cells = self.sides.to_array().map(|side| side / spacing + 1.0).iter().product::<f64>();
        let within = if within.is_finite() { within } else { cells };
        within + BEYOND_A_SQUARE * self.squares(spacing)
    }

    /// About how many bytes it takes to make one.
    pub(super) fn bytes(&self, spacing: f64, tetrahedra: bool) -> f64 {
        let per_hexahedron = if tetrahedra {
            BYTES_A_HEXAHEDRON + TETRAHEDRA_OF_A_HEXAHEDRON * BYTES_A_TETRAHEDRON
        } else {
            BYTES_A_HEXAHEDRON
        };
        self.hexahedra(spacing) * per_hexahedron
            + self.squares(spacing) * BYTES_A_SQUARE
            + self.triangles as f64 * BYTES_A_TRIANGLE
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
    let fine = measures.hexahedra(spacing_of(CELLS));
    let largest = measures.smallest_cells(MOST_BY_DEFAULT, |spacing| measures.hexahedra(spacing));
    let mut note = format!("{CELLS} cells along the shortest side");
    let (resolution, spacing) = match largest.filter(|_| fine > MOST_BY_DEFAULT) {
        None => (Resolution::ShortestSide(CELLS), spacing_of(CELLS)),
        Some(spacing) => {
            let count = (measures.shortest_side() / spacing).floor();
            let _ = write!(note, " would be about {} hexahedra, so ", crate::numbers::number(fine));
            if count >= 1.0 {
                let cells = count as u32; // below CELLS
                let _ = write!(note, "{cells} were taken");
                (Resolution::ShortestSide(cells), spacing_of(cells))
            } else {
                let _ = write!(note, "cells of side {spacing} were taken");
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
        let hexahedra = slab(1.0).hexahedra(chosen.spacing);
        // 64^3 or 65^3, as the grid falls.
        assert!((262_144.0..=275_000.0).contains(&hexahedra), "{hexahedra}");
    }

    #[test]
    fn a_thin_plate_gets_cells_that_are_not_too_many() {
        for thickness in [0.1, 0.01, 1e-3, 1e-9] {
            let measures = slab(thickness);
            let chosen = choose(&measures, None, None);
            assert!(measures.hexahedra(chosen.spacing) <= 1.2 * MOST_BY_DEFAULT, "{thickness}: {chosen:?}");
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
