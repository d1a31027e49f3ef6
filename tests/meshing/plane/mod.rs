//! Tests of `welter_meshing::volumetric::plane`.

mod arrangement;
mod cases;
mod discs;
mod laws;
mod lines;
mod refused;
mod verified;

use glam::DVec2;
use welter_meshing::Monitor;
use welter_meshing::volumetric::plane::{AreaMesh, ClosedPolylines, mesh_area, verify_area};
use welter_meshing::volumetric::{Resolution, VolumeError, VolumeParameters};

fn curves(loops: &[Vec<[f64; 2]>]) -> ClosedPolylines {
    let positions = loops.iter().flatten().copied().map(DVec2::from_array).collect();
    let mut first = 0;
    let loops = loops.iter().map(|points| {
        first += points.len() as u32;
        (first - points.len() as u32..first).collect()
    });
    ClosedPolylines::new(positions, loops.collect()).unwrap()
}

fn meshed(curves: &ClosedPolylines, spacing: f64) -> Result<AreaMesh, VolumeError> {
    let resolution = Resolution::Spacing(spacing);
    mesh_area(curves, &VolumeParameters { resolution, ..VolumeParameters::default() }, &Monitor::none())
}

/// How often the curves wind around a node after its move by less than anything, along x more than along y: by a ray along x. Exact:
/// the side of a segment is told by an orientation, or by the move where that is zero.
fn winding(curves: &ClosedPolylines, at: DVec2) -> i32 {
    let mut count = 0;
    for segment in 0..curves.len() as u32 {
        let [p, q] = curves.segment(segment);
        if (p.y <= at.y) == (q.y <= at.y) {
            continue;
        }
        let up = p.y <= at.y;
        let side = welter_predicates::orient2d(p, q, at);
        // Moved to the right by much more than up: to the right of a segment that goes up.
        let left = match side {
            welter_predicates::Sign::Zero => !up,
            side => side == welter_predicates::Sign::Positive,
        };
        if left == up {
            count += if up { 1 } else { -1 };
        }
    }
    count
}

/// Checks everything that must hold of any mesh.
fn check(curves: &ClosedPolylines, area: &AreaMesh) {
    copies_are_winding_numbers(curves, area);
    let verification = verify_area(curves, area, &Monitor::none()).unwrap();
    assert!(verification.passed(), "{:?}", verification.findings().collect::<Vec<_>>());
    assert_eq!(verification.characteristics, area.mesh.components().1);
    let (of, characteristics) = area.mesh.components();
    let mut sums = vec![[0, 0]; characteristics.len()];
    for number in 0..curves.loops().len() {
        let corner = curves.corners(number).start as usize;
        let component = of[area.hosts.corners[corner].quadrilateral as usize] as usize;
        for (sum, turning) in sums[component].iter_mut().zip(curves.turning(number)) {
            *sum += turning;
        }
    }
    for ([least, most], characteristic) in sums.into_iter().zip(&characteristics) {
        assert!((least..=most).contains(characteristic), "{characteristics:?}");
    }
    for (corner, host) in area.hosts.corners.iter().enumerate() {
        let corners = area.mesh.quadrilaterals()[host.quadrilateral as usize];
        let there: DVec2 = (0..4).map(|c| host.weights()[c] * area.mesh.position(corners[c])).sum();
        let distance = there.distance(curves.segment(corner as u32)[0]);
        assert!(distance <= 1e-12 * (1.0 + there.length()), "{distance:e}");
    }
    let triangles = area.mesh.triangles().unwrap();
    assert_eq!(of_triangles(area, &triangles.triangles, &triangles.positions), characteristics);
}

/// In cells that the curves do not meet lie as many quadrilaterals as they wind around them.
fn copies_are_winding_numbers(curves: &ClosedPolylines, area: &AreaMesh) {
    let grid = area.mesh.grid();
    let mut at_curve = vec![false; grid.cell_count()];
    for pair in &area.hosts.segments {
        at_curve[area.mesh.cells()[pair[0] as usize] as usize] = true;
    }
    let mut count = vec![0; grid.cell_count()];
    for &cell in area.mesh.cells() {
        count[cell as usize] += 1;
    }
    for cell in (0..grid.cell_count()).filter(|&cell| !at_curve[cell]) {
        let node = grid.position(grid.cell_at(cell));
        assert_eq!(count[cell], winding(curves, node), "cell at {node}");
    }
    for (quadrilateral, &region) in area.regions.iter().enumerate().filter(|(_, r)| **r != u32::MAX) {
        assert!(i32::from(area.copies[quadrilateral]) < area.windings[region as usize]);
    }
}

/// The Euler characteristics of the components of triangles, in the order of those of the quadrilaterals.
fn of_triangles(area: &AreaMesh, triangles: &[[u32; 3]], positions: &[DVec2]) -> Vec<i64> {
    let mut edges = std::collections::BTreeSet::new();
    let mut label: Vec<usize> = (0..positions.len()).collect();
    fn root(label: &mut [usize], mut x: usize) -> usize {
        while label[x] != x {
            label[x] = label[label[x]];
            x = label[x];
        }
        x
    }
    for t in triangles {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        assert_eq!(welter_predicates::orient2d(a, b, c), welter_predicates::Sign::Positive);
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            edges.insert((a.min(b), a.max(b)));
            let (a, b) = (root(&mut label, a as usize), root(&mut label, b as usize));
            label[a.max(b)] = a.min(b);
        }
    }
    let mut roots = Vec::new();
    for corners in area.mesh.quadrilaterals() {
        let root = root(&mut label, corners[0] as usize);
        if !roots.contains(&root) {
            roots.push(root);
        }
    }
    let mut counts = vec![0; roots.len()];
    let mut add = |label: &mut [usize], vertex: u32, sign: i64| {
        let root = root(label, vertex as usize);
        if let Some(place) = roots.iter().position(|&r| r == root) {
            counts[place] += sign;
        }
    };
    (0..positions.len() as u32).for_each(|vertex| add(&mut label, vertex, 1));
    edges.iter().for_each(|&(a, _)| add(&mut label, a, -1));
    triangles.iter().for_each(|t| add(&mut label, t[0], 1));
    counts
}

/// A strip along a path, as one closed curve: the right side forward, the left side back.
fn strip(path: &[[f64; 2]], width: f64) -> Vec<[f64; 2]> {
    let at = |k: usize| DVec2::from_array(path[k]);
    let side = |k: usize, sign: f64| {
        let (before, behind) = (k.saturating_sub(1), (k + 1).min(path.len() - 1));
        let along = (at(behind) - at(before)).normalize();
        (at(k) + 0.5 * width * sign * along.perp()).to_array()
    };
    let right = (0..path.len()).map(|k| side(k, -1.0));
    let left = (0..path.len()).rev().map(|k| side(k, 1.0));
    right.chain(left).collect()
}
