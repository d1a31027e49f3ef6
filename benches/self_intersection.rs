//! Benchmark: building a hierarchy of triangles, the pairs of boxes that meet, and the exact list of self-intersections,
//! on chains of overlapping spheres of 10^4, 10^5 and 10^6 triangles; `parry3d-f64`'s hierarchy on the same boxes beside it.
//!
//! ```text
//! cargo bench -p welter-benches --bench self_intersection [-- LARGEST]
//! ```
//! `RAYON_NUM_THREADS` sets the number of threads of ours; parry's build and pairs run on one. Times are the best of
//! [`RUNS`]; "boxes" is the sorted list of pairs of boxes that meet, for both; peak memory is the resident size, mesh and process included, where Linux tells it.

#![allow(clippy::print_stdout)] // a report is what a benchmark is for

use std::hint::black_box;

use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh as ParryBvh, BvhBuildStrategy, BvhWorkspace};
use welter_benches::{best, memory};
use welter_meshing::Monitor;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::spatial::{Box3, Bvh, Sharing};
use welter_meshing::surface::{TriId, TriMesh, TriangleSoup};

/// Runs of each measurement.
const RUNS: usize = 3;

/// Spheres in a chain; so many that 10^6 triangles have about 10^4 intersecting pairs.
const SPHERES: usize = 8;

/// Triangles of a geodesic sphere of radius 1 and edge length 1, about.
const TRIANGLES_OF_UNIT_EDGE: f64 = 36.5;

/// A chain of spheres, each overlapping the next, of about so many triangles.
fn chain(triangles: usize) -> TriMesh {
    let edge_length = (TRIANGLES_OF_UNIT_EDGE * SPHERES as f64 / triangles as f64).sqrt();
    let mut soup = TriangleSoup::default();
    for i in 0..SPHERES {
        // Irrational steps: no two spheres are translates of each other by a lattice vector.
        let t = i as f64;
        let center = DVec3::new(1.1 * t, 0.3 * (1.7 * t).sin(), 0.3 * (2.3 * t).cos());
        let part = sphere(&Sphere { center, radius: 1.0 + 0.01 * t, edge_length }).expect("valid parameters");
        let first = soup.positions.len() as u32;
        soup.positions.extend(part.positions());
        soup.triangles.extend(part.triangles().iter().map(|t| t.map(|v| first + v.0)));
    }
    TriMesh::new(soup).expect("a valid mesh")
}

/// Peak resident memory while `run` runs, in mebibytes.
fn peak_memory(run: impl FnOnce()) -> Option<f64> {
    // Forgets the peak so far.
    std::fs::write("/proc/self/clear_refs", "5").ok();
    run();
    memory("VmHWM:").map(|bytes| bytes / (1 << 20) as f64)
}

struct Row {
    triangles: usize,
    build: f64,
    list: f64,
}

fn measure(triangles: usize) -> Row {
    let mesh = chain(triangles);
    let n = mesh.triangles().len();
    let nobody = Monitor::none();
    let memory = peak_memory(|| {
        let pairs = Bvh::new(&mesh).self_intersections(Sharing::Index, &nobody);
        black_box(pairs.expect("nobody cancels"));
    });
    let (build, bvh) = best(RUNS, || Bvh::new(&mesh));
    let (boxes, meeting) = best(RUNS, || bvh.self_pairs(&nobody).expect("nobody cancels").len());
    let (list, found) =
        best(RUNS, || bvh.self_intersections(Sharing::Index, &nobody).expect("nobody cancels").len());
    let (refit, _) = best(RUNS, || Bvh::refitted(bvh.tree().clone(), &mesh).expect("the same mesh"));
    drop(bvh);
    println!("{n} triangles, {meeting} pairs of meeting boxes, {found} intersecting pairs");
    println!("  welter  build {build:9.4} s   boxes {:9.4} s   refit {:9.4} s", boxes, refit);
    println!(
        "  welter  exact list {list:9.4} s   build + list {:9.4} s   {:.3e} box pairs/s",
        build + list,
        meeting as f64 / list
    );
    if let Some(peak) = memory {
        println!("  welter  peak memory {peak:.0} MiB, mesh included");
    }
    for (name, strategy) in [("binned", BvhBuildStrategy::Binned), ("ploc", BvhBuildStrategy::Ploc)] {
        let leaves: Vec<Aabb> = (0..n as u32).map(|t| aabb(Box3::of(mesh.corners(TriId(t))))).collect();
        let (parry_build, parry) = best(RUNS, || ParryBvh::from_leaves(strategy, &leaves));
        let mut workspace = BvhWorkspace::default();
        let (parry_pairs, count) = best(RUNS, || {
            let mut pairs: Vec<[u32; 2]> = Vec::new();
            parry.traverse_bvtt_single_tree::<false>(&mut workspace, &mut |i, j| {
                pairs.push([i.min(j), i.max(j)])
            });
            pairs.sort_unstable();
            pairs.len()
        });
        println!(
            "  parry ({name:6}) build {:9.4} s   boxes {:9.4} s   {count} pairs",
            parry_build, parry_pairs
        );
    }
    Row { triangles: n, build, list }
}

fn aabb(b: Box3) -> Aabb {
    let vector = |p: DVec3| Vector::new(p.x, p.y, p.z);
    Aabb::new(vector(b.min), vector(b.max))
}

fn main() {
    // `cargo bench` passes flags of its own; a bare number is the largest size.
    let largest = std::env::args().skip(1).find_map(|word| word.parse().ok()).unwrap_or(1_000_000);
    let sizes = [10_000, 100_000, 1_000_000].into_iter().filter(|&size| size <= largest);
    println!("{} threads", rayon::current_num_threads());
    let rows: Vec<Row> = sizes.map(measure).collect();
    if let [first, .., last] = &rows[..] {
        let exponent = |value: fn(&Row) -> f64| {
            (value(last) / value(first)).ln() / (last.triangles as f64 / first.triangles as f64).ln()
        };
        println!(
            "growth exponents from {} to {}: build {:.2}, list {:.2}, both {:.2}",
            first.triangles,
            last.triangles,
            exponent(|row| row.build),
            exponent(|row| row.list),
            exponent(|row| row.build + row.list)
        );
    }
}
