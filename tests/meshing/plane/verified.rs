//! What is wrong with a mesh is found.

use super::{curves, meshed};
use std::sync::atomic::AtomicBool;
use welter_meshing::volumetric::plane::{AreaFinding, AreaMesh, ClosedPolylines, QuadMesh, verify_area};
use welter_meshing::{Cancelled, Monitor};

fn square(x: f64, side: f64) -> Vec<[f64; 2]> {
    vec![[x, x], [x + side, x], [x + side, x + side], [x, x + side]]
}

fn two_squares() -> (ClosedPolylines, AreaMesh) {
    let curves = curves(&[square(0.0, 2.0), square(1.0, 2.0)]);
    let area = meshed(&curves, 0.3).unwrap();
    (curves, area)
}

fn found(curves: &ClosedPolylines, area: &AreaMesh) -> Vec<AreaFinding> {
    verify_area(curves, area, &Monitor::none()).unwrap().findings().copied().collect()
}

/// The mesh without one quadrilateral, the last of its numbers in its place in the hosts.
fn without(mesh: &QuadMesh, left_out: usize) -> QuadMesh {
    let (mut quadrilaterals, mut cells) = (mesh.quadrilaterals().to_vec(), mesh.cells().to_vec());
    quadrilaterals.remove(left_out);
    cells.remove(left_out);
    QuadMesh::new(*mesh.grid(), mesh.nodes().to_vec(), quadrilaterals, cells).unwrap()
}

#[test]
fn a_copy_that_is_not_there_is_missed_and_one_too_many_is_seen() {
    let (curves, area) = two_squares();
    let node = |cell: u64| area.mesh.grid().position(area.mesh.grid().cell_at(cell as usize));
    // Within both squares, away from the curves; hosts of quadrilaterals behind it no longer count.
    let within = (0..area.mesh.len()).find(|&q| {
        let low = node(area.mesh.cells()[q]);
        low.min_element() > 1.01 && low.max_element() < 1.6
    });
    let within = within.unwrap();
    let mut fewer = area.clone();
    fewer.mesh = without(&area.mesh, within);
    let renumbered = |q: u32| if q as usize > within { q - 1 } else { q };
    fewer.hosts.corners.iter_mut().for_each(|host| host.quadrilateral = renumbered(host.quadrilateral));
    fewer.hosts.segments.iter_mut().for_each(|pair| pair[0] = renumbered(pair[0]));
    let cell = area.mesh.grid().cell_at(area.mesh.cells()[within] as usize);
    let copies = AreaFinding::Copies { cell, quadrilaterals: 1, winding: 2 };
    // A hole of one cell: its component has one tunnel more.
    let findings = found(&curves, &fewer);
    assert_eq!(findings[0], copies);
    assert!(matches!(findings[1], AreaFinding::Euler { characteristic: 0, turning: [1, 1], .. }));
    assert_eq!(findings.len(), 2);
    assert_eq!(
        findings[0].to_string(),
        format!("cell ({}, {}) has 1 quadrilaterals, the curves wind 2 times around it", cell[0], cell[1])
    );

    // A quadrilateral twice: of the same vertices, so that it changes the characteristic.
    let (mut quadrilaterals, mut cells) = (area.mesh.quadrilaterals().to_vec(), area.mesh.cells().to_vec());
    quadrilaterals.insert(within, quadrilaterals[within]);
    cells.insert(within, cells[within]);
    let mut more = area.clone();
    more.mesh = QuadMesh::new(*area.mesh.grid(), area.mesh.nodes().to_vec(), quadrilaterals, cells).unwrap();
    let renumbered = |q: u32| if q as usize > within { q + 1 } else { q };
    more.hosts.corners.iter_mut().for_each(|host| host.quadrilateral = renumbered(host.quadrilateral));
    more.hosts.segments.iter_mut().for_each(|pair| pair[0] = renumbered(pair[0]));
    let findings = found(&curves, &more);
    assert_eq!(findings[0], AreaFinding::Copies { cell, quadrilaterals: 3, winding: 2 });
    assert!(matches!(findings[1], AreaFinding::Euler { characteristic: 2, .. }), "{findings:?}");
}

#[test]
fn curves_that_leave_their_sheet_are_found() {
    let (curves, area) = two_squares();
    assert_eq!(found(&curves, &area), []);
    // The first corner of the second square lies within the first, where each has a quadrilateral on the cell.
    let mut torn = area.clone();
    let host = torn.hosts.corners[4].quadrilateral;
    let cells = area.mesh.cells();
    let other = (0..cells.len()).find(|&q| q != host as usize && cells[q] == cells[host as usize]).unwrap();
    torn.hosts.corners[4].quadrilateral = other as u32;
    let findings = found(&curves, &torn);
    assert!(findings.iter().any(|f| matches!(f, AreaFinding::Torn { corner: 5, .. })), "{findings:?}");
    for segment in [4, 7] {
        assert!(findings.contains(&AreaFinding::Corner { corner: 4, segment }), "{findings:?}");
    }

    let mut jumped = area.clone();
    for pair in jumped.hosts.segments.iter_mut().filter(|pair| **pair == [host, 4]) {
        pair[0] = other as u32;
    }
    jumped.hosts.segments.sort_unstable();
    let findings = found(&curves, &jumped);
    let side = |f: &AreaFinding| matches!(f, AreaFinding::Side { segment: 4, .. });
    assert!(findings.iter().any(side), "{findings:?}");
    assert!(findings.contains(&AreaFinding::Corner { corner: 4, segment: 4 }), "{findings:?}");
}

#[test]
fn a_check_that_is_stopped_has_no_result() {
    let (curves, area) = two_squares();
    let stop = AtomicBool::new(true);
    assert_eq!(verify_area(&curves, &area, &Monitor::new(None, Some(&stop))), Err(Cancelled));
}
