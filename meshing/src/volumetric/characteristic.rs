//! The Euler characteristic of a mesh while it is made: [`between_surface`], for the cells that the surface does not meet.
//!
//! # Method
//! All hexahedra in cells that the surface meets are counted with their sides, edges and corners elsewhere. Of the others count what belongs to none of those: a
//! row of `n` cells has `n` hexahedra and `n - 1` sides between, which makes -1; where `n` cells of two rows lie side by side there are `n`
//! sides and `n - 1` edges, which makes +1; where four rows meet `n` edges and `n - 1` vertices, -1 again. So intervals are counted, not cells.
//!
//! Complexity: O(rows + cells that the surface meets).

use rayon::prelude::*;

use super::frame::Cut;
use super::pieces::Regions;

/// Neighbouring cells of a row that the surface does not meet, of a region with copies.
#[derive(Clone, Copy)]
struct Interval {
    begin: u32,
    end: u32,
    copies: u32,
}

/// What cells that the surface does not meet add to the Euler characteristic of all.
pub(super) fn between_surface(cut: &Cut<'_>, regions: &Regions<'_>) -> i64 {
    let [_, ny, nz] = cut.grid.nodes().map(|n| n as usize);
    // Integers: the order of the sum does not matter.
    (0..nz - 1)
        .into_par_iter()
        .map(|k| {
            let lists = |k: usize| -> Vec<Vec<Interval>> {
                if k + 1 == nz {
                    vec![Vec::new(); ny]
                } else {
                    (0..ny).map(|j| intervals(cut, regions, j + ny * k)).collect()
                }
            };
            let (here, above) = (lists(k), lists(k + 1));
            let mut sum = 0;
            for j in 0..ny - 1 {
                let beside = overlaps(&here[j], &here[j + 1]);
                let over = overlaps(&here[j], &above[j]);
                let four = overlaps(&beside, &overlaps(&above[j], &above[j + 1]));
                sum += count(&beside) + count(&over) - count(&here[j]) - count(&four);
            }
            sum
        })
        .sum()
}

/// How many intervals there are, of all copies.
fn count(intervals: &[Interval]) -> i64 {
    intervals.iter().map(|interval| i64::from(interval.copies)).sum()
}

/// The intervals of a row.
fn intervals(cut: &Cut<'_>, regions: &Regions<'_>, row: usize) -> Vec<Interval> {
    let [ny, nz] = [cut.grid.nodes()[1], cut.grid.nodes()[2]].map(|n| n as usize);
    if row % ny + 1 == ny || row / ny + 1 == nz {
        return Vec::new();
    }
    let ends = cut.extension.cells().row(row).iter().map(|cell| cell.i).chain([cut.grid.cells()[0]]);
    let (mut list, mut begin) = (Vec::new(), 0);
    for end in ends {
        if begin < end {
            let copies = regions.copies(regions.pieces.run(row, begin));
            if copies > 0 {
                list.push(Interval { begin, end, copies });
            }
        }
        begin = end + 1;
    }
    list
}

/// Where intervals of two rows are side by side; then they are of one region.
fn overlaps(first: &[Interval], second: &[Interval]) -> Vec<Interval> {
    let (mut a, mut b, mut list) = (0, 0, Vec::new());
    while a < first.len() && b < second.len() {
        let (begin, end) = (first[a].begin.max(second[b].begin), first[a].end.min(second[b].end));
        if begin < end {
            list.push(Interval { begin, end, copies: first[a].copies });
        }
        if first[a].end < second[b].end { a += 1 } else { b += 1 }
    }
    list
}

#[cfg(test)]
mod tests {
    use crate::Monitor;
    use crate::shapes;
    use crate::volumetric::mesher::mesh_on_grid;
    use crate::volumetric::pairing::Pairing;
    use crate::volumetric::volume::grid_for;
    use crate::volumetric::{Resolution, VolumeParameters, euler_characteristics};

    #[test]
    fn parts_add_up_to_the_whole() {
        for (name, cells) in
            [("ring-overlap", 10), ("nested-boxes", 12), ("double-moebius", 10), ("gyroid", 24)]
        {
            let surface = shapes::by_name(name, None).unwrap();
            let parameters = VolumeParameters {
                resolution: Resolution::ShortestSide(cells),
                ..VolumeParameters::default()
            };
            let grid = grid_for(&surface, &parameters, 0).unwrap();
            let Ok((mut on_grid, _)) =
                mesh_on_grid(&surface, &Pairing::new(&surface), &grid, &Monitor::none())
            else {
                panic!("{name} is meshed")
            };
            let of_all = euler_characteristics(&on_grid.assembled.mesh, &Monitor::none()).unwrap();
            let (mesh, at_surface) = (&mut on_grid.assembled.mesh, &on_grid.assembled.of_surface);
            let part =
                mesh.with_some(at_surface, |part| euler_characteristics(part, &Monitor::none()).unwrap());
            let sum = part.total().euler_characteristic() + on_grid.between_surface;
            assert_eq!(sum, of_all.total().euler_characteristic(), "{name}");
            assert!(on_grid.between_surface != 0, "{name}");
        }
    }
}
