//! Remeshing of surfaces that were squeezed, stretched and brought near each other.

use super::*;
use glam::DVec3;
use welter_meshing::Monitor;
use welter_meshing::shapes::{Sphere, sphere};
use welter_meshing::spatial::self_intersections;
use welter_meshing::surface::measure::signed_volume;
use welter_meshing::surface::{TriMesh, TriangleSoup};

struct Piece {
    surface: MovingSurface,
    broad_phase: BroadPhase,
    length: f64,
    parameters: ImprovementParameters,
    topology: TopologyParameters,
}

impl Piece {
    fn new(mesh: &TriMesh, length: f64) -> Self {
        let surface = MovingSurface::new(mesh).expect("admissible");
        let broad_phase = BroadPhase::new(&surface, Motion::Rest).expect("at rest");
        Self {
            surface,
            broad_phase,
            length,
            parameters: ImprovementParameters::default(),
            topology: TopologyParameters::default(),
        }
    }

    fn stage(&mut self) -> Stage<'_> {
        Stage {
            surface: &mut self.surface,
            broad_phase: &mut self.broad_phase,
            parameters: &self.parameters,
            topology: &self.topology,
            length: self.length,
        }
    }

    fn check(&self) -> f64 {
        self.surface.check().expect("sound");
        let mesh = self.surface.to_mesh();
        assert_eq!(self_intersections(&mesh, &Monitor::none()), Ok(vec![]));
        signed_volume(&mesh)
    }

    fn edges(&self) -> [f64; 2] {
        let mesh = self.surface.connectivity();
        let lengths = mesh.edges().map(|e| {
            let [a, b] = mesh.ends(e).map(|v| self.surface.position(v));
            a.distance(b) / self.length
        });
        lengths.fold([f64::INFINITY, 0.0], |[low, high], x| [low.min(x), high.max(x)])
    }
}

fn stretched(edge: f64, factors: DVec3) -> TriMesh {
    let mesh = sphere(&Sphere { edge_length: edge, ..Sphere::default() }).expect("a sphere");
    let soup = TriangleSoup {
        positions: mesh.positions().iter().map(|&p| p * factors).collect(),
        triangles: mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect(),
        ..TriangleSoup::default()
    };
    TriMesh::new(soup).expect("finite")
}

#[test]
fn stretched_spheres_get_fair_edges() {
    for factors in
        [DVec3::new(4.0, 1.0, 1.0), DVec3::new(1.0, 1.0, 0.2), DVec3::splat(3.0), DVec3::splat(0.3)]
    {
        let mut piece = Piece::new(&stretched(0.15, factors), 0.15);
        let before = piece.check();
        println!(
            "{factors}: {:?} {} triangles {before}",
            piece.edges(),
            piece.surface.connectivity().triangle_count()
        );
        for _ in 0..3 {
            let start = std::time::Instant::now();
            let (report, _) = piece.stage().remesh().expect("followed");
            let s = start.elapsed().as_secs_f64();
            let after = piece.check();
            println!(
                "   {report:?} {:?} {} triangles {after} {s}",
                piece.edges(),
                piece.surface.connectivity().triangle_count()
            );
        }
    }
}

#[test]
fn near_spheres_merge() {
    let one = sphere(&Sphere { edge_length: 0.1, ..Sphere::default() }).expect("a sphere");
    for gap in [0.009, 0.001] {
        let mut positions = one.positions().to_vec();
        let n = positions.len() as u32;
        positions.extend(one.positions().iter().map(|p| DVec3::new(2.0 + gap - p.x, p.y, -p.z)));
        let mut triangles: Vec<[u32; 3]> = one.triangles().iter().map(|t| t.map(|v| v.0)).collect();
        let more: Vec<[u32; 3]> = triangles.iter().map(|t| t.map(|v| v + n)).collect();
        triangles.extend(more);
        let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
        let mut piece = Piece::new(&TriMesh::new(soup).expect("finite"), 0.1);
        println!("{} {}", piece.check(), piece.surface.connectivity().euler_characteristic());
        for _ in 0..4 {
            let (report, _) = piece.stage().change_topology().expect("followed");
            println!("   {report:?} {}", piece.check());
            let (report, _) = piece.stage().remesh().expect("followed");
            println!(
                "   {report:?} {} {} {:?}",
                piece.check(),
                piece.surface.connectivity().euler_characteristic(),
                piece.edges()
            );
        }
    }
}
