//! scratch
#![allow(clippy::print_stdout)]
use std::time::Instant;
use welter_meshing::{DVec3, Monitor, distance::*, grid::Grid3, shapes::*, spatial::*};
fn cpu() -> f64 {
    let t = std::fs::read_to_string("/proc/self/stat").unwrap();
    let f: Vec<&str> = t.split(' ').collect();
    (f[13].parse::<f64>().unwrap() + f[14].parse::<f64>().unwrap()) / 100.0
}
fn main() {
    let m = Monitor::none();
    for e in [0.019_f64] {
        let mesh = sphere(&Sphere { edge_length: e, ..Sphere::default() }).unwrap();
        let n: u32 = 128;
        let grid = Grid3::covering([-1.1; 3], [1.1; 3], 2.2 / f64::from(n - 1), 0).unwrap();
        println!("{} triangles, {:?} nodes", mesh.triangles().len(), grid.nodes());
        for _ in 0..1 {
            let t = Instant::now();
            let w = grid_winding_numbers(&mesh, &grid, &m).unwrap();
            println!("winding {:?} {}", t.elapsed(), w.on_surface().len());
            let t = Instant::now();
            let c = cpu();
            let p = DistanceParameters { band: 3.0 * grid.spacing(), ..Default::default() };
            let f = signed_distance(&mesh, &grid, &p, &m).unwrap();
            println!("band {:?} cpu {}", t.elapsed(), cpu() - c);
            let t = Instant::now();
            let c = cpu();
            let f = signed_distance(&mesh, &grid, &Default::default(), &m).unwrap();
            println!("full {:?} cpu {}", t.elapsed(), cpu() - c);
            let bvh = Bvh::new(&mesh);
            let t = Instant::now();
            let mut bad = 0;
            let mut count = 0;
            for i in (0..grid.node_count()).step_by(9700) {
                count += 1;
                let c = bvh.closest_point(grid.position(grid.node_at(i))).unwrap();
                if c.distance != f.distances.values()[i].abs() {
                    bad += 1;
                }
            }
            println!("one by one {:?} per node, {} bad", t.elapsed() / count, bad);
        }
    }
}
