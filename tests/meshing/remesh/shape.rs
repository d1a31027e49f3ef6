//! What is measured: angles, edge lengths, distance and its order.

use welter_meshing::spatial::Bvh;
use welter_meshing::surface::TriId;

use super::*;

/// Smallest angle in degrees and share of edges within [0.5, 1.5] of their mean: the obvious way, by arc cosines and edges counted from both sides.
fn plainly(mesh: &TriMesh) -> (f64, f64) {
    let (mut least, mut lengths) = (180.0_f64, Vec::new());
    for t in 0..mesh.triangles().len() {
        let x = mesh.corners(TriId(t as u32));
        for k in 0..3 {
            let (p, q) = (x[(k + 1) % 3] - x[k], x[(k + 2) % 3] - x[k]);
            least = least.min((p.dot(q) / (p.length() * q.length())).acos().to_degrees());
            lengths.push(p.length());
        }
    }
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    let near = lengths.iter().filter(|&&l| l >= 0.5 * mean && l <= 1.5 * mean).count();
    (least, near as f64 / lengths.len() as f64)
}

fn assert_good(name: &str, field: Field, cells: u32) {
    let grid = grid(cells);
    let before = cubes(&grid, &field);
    let (mesh, report) = start(&grid, &field);
    assert_kept(&before, &mesh);
    let (angle, near) = plainly(&mesh);
    println!(
        "{name} {cells}: {} triangles, {angle:.1} degrees, {near:.4} near the mean",
        mesh.triangles().len()
    );
    assert!(angle >= 20.0 && near >= 0.99, "{name} {cells}: {angle} degrees, {near}");
    assert!(
        (angle - report.smallest_angle.to_degrees()).abs() < 1e-6
            && (near - report.edges.near_mean).abs() < 1e-9
    );
    assert!((report.edges.mean / grid.spacing() - 1.0).abs() < 0.1, "{}", report.edges.mean);
    assert_eq!(report.off_surface, 0, "{name} {cells}");
    // |f| is at most a few times the distance.
    let off = mesh.positions().iter().map(|&p| field(p).abs()).fold(0.0, f64::max);
    assert!(off < 1e-8 * grid.spacing(), "{name}: vertices are off by {off:e}");
}

macro_rules! good_triangles {
    ($($name:ident: $field:expr, $cells:expr;)*) => {$(
        #[test]
        fn $name() {
            for cells in $cells {
                assert_good(stringify!($name), $field, cells);
            }
        }
    )*};
}

good_triangles! {
    good_triangles_on_a_ball: ball, [10, 15, 21];
    good_triangles_on_a_torus: torus, [12, 17, 25];
    good_triangles_on_two_balls: two_balls, [13, 18, 26];
    good_triangles_on_a_smooth_union: blobs, [11, 16, 24];
    good_triangles_on_a_gyroid_sheet: gyroid, [19];
    good_triangles_on_a_dumbbell: dumbbell, [15, 22];
    good_triangles_on_an_ellipsoid: ellipsoid, [13, 18, 25];
}

/// Largest distance between a mesh and a surface whose distance function and points are known, both ways.
fn hausdorff(mesh: &TriMesh, distance: Field, point: impl Fn(f64, f64) -> DVec3) -> f64 {
    let mut farthest = 0.0_f64;
    for t in 0..mesh.triangles().len() {
        let [a, b, c] = mesh.corners(TriId(t as u32));
        for i in 0..=4 {
            for j in 0..=4 - i {
                let [u, v] = [i, j].map(|k| f64::from(k) / 4.0);
                farthest = farthest.max(distance(a + u * (b - a) + v * (c - a)).abs());
            }
        }
    }
    let bvh = Bvh::new(mesh);
    for i in 0..40 {
        for j in 0..40 {
            let on = point(f64::from(i) / 40.0, f64::from(j) / 40.0);
            farthest = farthest.max(bvh.closest_point(on).unwrap().distance);
        }
    }
    farthest
}

#[test]
fn the_distance_to_a_ball_and_to_a_torus_is_of_second_order() {
    use std::f64::consts::TAU;
    let on_ball = |u: f64, v: f64| {
        let (z, around) = (2.0 * u - 1.0, TAU * v);
        let r = (1.0 - z * z).sqrt();
        0.9 * DVec3::new(r * around.cos(), r * around.sin(), z)
    };
    let on_torus = |u: f64, v: f64| {
        let (s, t) = (TAU * u, TAU * v);
        let r = 0.6 + 0.27 * t.cos();
        DVec3::new(r * s.cos(), r * s.sin(), 0.27 * t.sin())
    };
    let order = |field: Field, point: &dyn Fn(f64, f64) -> DVec3| {
        let far = [8, 32].map(|cells| hausdorff(&start(&grid(cells), &field).0, field, point));
        (far[0] / far[1]).log2() / 2.0
    };
    let orders = [order(ball, &on_ball), order(torus, &on_torus)];
    println!("orders {orders:.2?}");
    // Two in the mean over a factor of four; the largest triangle of each mesh is a matter of chance.
    assert!(orders.iter().all(|order| (1.7..2.4).contains(order)), "{orders:?}");
}
