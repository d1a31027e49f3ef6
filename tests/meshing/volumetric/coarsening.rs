//! Coarsening by doubling.

use super::*;
use std::sync::atomic::AtomicBool;
use welter_kit::volumetric::{coarse_by_pairs, homology_of_hexahedra};

fn checked(mesh: &HexMesh) -> (Coarsening, TopologyReport) {
    coarsen_checked(mesh, &BettiLimits::default(), &Monitor::none()).unwrap()
}

#[test]
fn random_complexes_are_coarsened_as_by_pairs() {
    let (mut kept, mut changed) = (0, 0);
    for (seed, mesh) in random_meshes(200).enumerate() {
        let (coarsening, report) = checked(&mesh);
        let (twin, coarse_of) = coarse_by_pairs(&mesh);
        assert_eq!(coarsening.coarse_of, coarse_of, "{seed}");
        assert_eq!(coarsening.mesh, twin, "{seed}");
        // The report says nothing exactly if every component became one with the same numbers.
        let [before, after] = [&mesh, &twin].map(homology_of_hexahedra);
        let mut became: Vec<(u32, u32)> = before
            .labels
            .iter()
            .zip(&coarse_of)
            .map(|(&label, &h)| (label, after.labels[h as usize]))
            .collect();
        became.sort_unstable();
        became.dedup();
        let same = became.len() == before.betti.len()
            && became.iter().all(|&(a, b)| before.betti[a as usize] == after.betti[b as usize]);
        assert_eq!(report.kept(), same, "{seed}: {report:?}");
        assert_eq!(report.betti_compared, became.len() == before.betti.len(), "{seed}");
        kept += usize::from(same && mesh.len() > twin.len());
        changed += usize::from(!same);
    }
    assert!(kept > 20 && changed > 20, "{kept} {changed}");
}

#[test]
fn blocks_are_kept() {
    for grid in [[1, 1, 1], [2, 2, 2], [3, 4, 5], [8, 1, 7]] {
        let (coarsening, report) = checked(&sheet(grid, |_| true));
        assert!(report.kept() && report.betti_compared);
        let [nx, ny, nz] = grid.map(|n| n.div_ceil(2) as usize);
        assert_eq!(coarsening.mesh.len(), nx * ny * nz);
        assert_eq!(coarsening.mesh.nodes().len(), coarsening.mesh.grid().node_count());
    }
}

#[test]
fn fine_hexahedra_lie_in_their_coarse_ones() {
    for mesh in random_meshes(50) {
        let Coarsening { mesh: coarse, coarse_of } = coarsen(&mesh, &Monitor::none()).unwrap();
        assert_eq!(coarse.grid().origin(), mesh.grid().origin());
        for (fine, &of) in coarse_of.iter().enumerate() {
            let [low, high] = [0, 7].map(|c| coarse.position(coarse.hexahedra()[of as usize][c]));
            for &vertex in &mesh.hexahedra()[fine] {
                let at = mesh.position(vertex);
                assert!(at.cmpge(low).all() && at.cmple(high).all());
            }
        }
        assert!((0..coarse.len() as u32).all(|h| coarse_of.contains(&h)));
    }
}

#[test]
fn overlapping_sheets_stay_apart() {
    let (coarsening, report) = checked(&coil(8, 3));
    assert!(report.kept() && report.betti_compared);
    // Each lap is there: three hexahedra on a coarse cell, and one more at the corner of the first cells if the path begins anew there.
    let most = coarsening.mesh.cells().chunk_by(|a, b| a == b).map(<[u64]>::len).max();
    assert_eq!(most, Some(4));
    assert_eq!(coarsening.mesh.grid().cells(), [4, 4, 1]);
    let mut two = Sheets::new([4; 3]);
    for _ in 0..2 {
        two.sheet(cells([4; 3], |_| true));
    }
    let (coarsening, report) = checked(&two.build());
    assert!(report.kept());
    assert_eq!(coarsening.mesh.len(), 16);
}

#[test]
fn slits_stay_open() {
    // A block with a slit along x that ends inside of a coarse cell: both lips there are on the same coarse cell.
    let grid = [8, 2, 1];
    let mut sheets = Sheets::new(grid);
    let [low, high] = [0, 1].map(|y| sheets.path((0..8).map(|x| [x, y, 0])));
    (0..3).for_each(|x| sheets.join(low[x], high[x]));
    let (coarsening, report) = checked(&sheets.build());
    assert!(report.kept() && report.betti_compared);
    assert_eq!(coarsening.mesh.cells(), [0, 1, 2, 2, 3, 3]);
}

#[test]
fn what_a_coarse_cell_fills_is_reported() {
    let hole = sheet([4, 4, 1], |[x, y, _]| (x, y) != (1, 1));
    let (_, report) = checked(&hole);
    let fine = [1, 1, 0, 0];
    let coarse = [1, 0, 0, 0];
    assert_eq!(
        report.changes,
        [
            TopologyChange::EulerCharacteristic { component: 0, fine: 0, coarse: 1 },
            TopologyChange::BettiNumbers { component: 0, fine, coarse },
        ]
    );
    // Without Betti numbers the Euler characteristic still tells.
    let limits = BettiLimits { most_cells: 1, ..BettiLimits::default() };
    let (_, report) = coarsen_checked(&hole, &limits, &Monitor::none()).unwrap();
    assert!(!report.betti_compared && report.changes.len() == 1);
    // A tunnel and a cavity at once leave it as it is.
    let both = sheet([8, 6, 6], |c| c != [1; 3] && (c[0], c[1]) != (5, 3));
    let (_, report) = checked(&both);
    let expected = TopologyChange::BettiNumbers { component: 0, fine: [1, 1, 1, 0], coarse };
    assert_eq!(report.changes, [expected]);
}

#[test]
fn grids_that_cannot_be_doubled_are_refused() {
    let grid = Grid3::new([0.0; 3], 1e75, [1; 3]).unwrap();
    let mesh = HexMesh::new(grid, (0..8).collect(), vec![[0, 1, 2, 3, 4, 5, 6, 7]], vec![0]).unwrap();
    assert!(matches!(coarsen(&mesh, &Monitor::none()), Err(CoarsenError::Grid(_))));
    let stop = AtomicBool::new(true);
    let stopped = coarsen(&sheet([2; 3], |_| true), &Monitor::new(None, Some(&stop)));
    assert!(matches!(stopped, Err(CoarsenError::Cancelled(_))));
}
