//! Errors against exact solutions, as in \[Brochu12, section 3.3\]. By default on coarse surfaces;
//! `WELTER_TRACKER_EDGES=0.04,0.02,0.01` names the edge lengths of longer runs.

use super::{advance_to, mapped, setting, together, tracker, volume};
use glam::DVec3;
use std::time::Instant;
use welter_kit::evolution::{
    DumbbellProfile, End, MeridianFlow, TwoBalls, errors, half_plane, hausdorff_to_sphere, two_balls,
};
use welter_kit::moving::misplaced_components;
use welter_meshing::Monitor;
use welter_meshing::shapes::{Dumbbell, Sphere, dumbbell, sphere};
use welter_meshing::surface::{Topology, TriMesh};
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters, Enright, Potential};
use welter_tracking::flows::{Advection, FaceOffsetting, MeanCurvature, Scheme};
use welter_tracking::improvement::{
    CurvatureAdaption, ImprovementParameters, SplitScheme, TopologyParameters,
};
use welter_tracking::tracker::{SurfaceTracker, TrackerParameters};

fn edges(default: &str) -> Vec<f64> {
    let list: String = setting("WELTER_TRACKER_EDGES", default.to_owned());
    list.split(',').map(|edge| edge.parse().unwrap()).collect()
}

fn ball(center: DVec3, radius: f64, edge_length: f64) -> TriMesh {
    sphere(&Sphere { center, radius, edge_length }).unwrap().into_mesh()
}

fn without_topology() -> TrackerParameters {
    let topology = TopologyParameters { enabled: false, ..TopologyParameters::default() };
    TrackerParameters { topology, ..TrackerParameters::default() }
}

/// Edges of the reference length where the surface is flat, and of down to a part of that where it is curved.
fn finer_where_curved(part: f64) -> TrackerParameters {
    let curvature = CurvatureAdaption { scale: [part, 1.0], ..CurvatureAdaption::default() };
    let improvement =
        ImprovementParameters { curvature: Some(curvature), ..ImprovementParameters::default() };
    TrackerParameters { improvement, ..TrackerParameters::default() }
}

fn components(tracker: &SurfaceTracker) -> usize {
    let mesh = tracker.surface().to_mesh();
    Topology::of(&mesh).components().len()
}

/// Volume at the end, and the largest error on the way, of the Enright test.
#[test]
fn the_enright_test_keeps_volume() {
    let center = DVec3::splat(0.35);
    let mut last: Option<[f64; 3]> = None;
    for edge in edges("0.03") {
        let start = Instant::now();
        let mut tracker = tracker(&ball(center, 0.15, edge), without_topology());
        let before = volume(&tracker);
        let flow = Advection { field: Enright::default(), scheme: Scheme::Rk4 };
        let mut worst = 0.0_f64;
        let steps = advance_to(&mut tracker, &flow, 3.0, 0.01, |tracker, _| {
            worst = worst.max((volume(tracker) / before - 1.0).abs());
        });
        let change = volume(&tracker) / before - 1.0;
        let found = errors(&tracker.surface().to_mesh(), |p| p.distance(center) - 0.15);
        let hausdorff = hausdorff_to_sphere(&tracker.surface().to_mesh(), center, 0.15);
        let now = [change.abs(), found.l1, hausdorff];
        let orders = last.map(|last| [0, 1, 2].map(|k| (last[k] / now[k]).log2()));
        println!(
            "{edge}: {steps} steps, volume {change:+.2e} (worst {worst:.2e}), L1 {:.2e}, Hausdorff {hausdorff:.2e}, \
             orders {orders:.2?}, {:.1} s",
            found.l1,
            start.elapsed().as_secs_f64()
        );
        // At 0.01: 0.0013; the sphere of triangles has a volume less than the exact one by as much.
        assert!(worst < 0.3 * (edge / 0.15).powi(2), "{edge}: {worst}");
        assert!(found.l1 < 0.05 * edge, "{edge}: {found:?}");
        assert!(hausdorff < edge, "{edge}: {hausdorff}");
        // Edge lengths are to be halved from one to the next.
        if let Some([volume, l1, hausdorff]) = orders {
            assert!(volume > 1.5 && l1 > 1.5 && hausdorff > 1.5, "{edge}: {orders:?}");
        }
        last = Some(now);
    }
}

/// Two balls that grow into each other and shrink again.
#[test]
fn normal_motion_converges_to_the_entropy_solution() {
    let balls = TwoBalls::default();
    let exact = two_balls(balls, 0.2, 0.2);
    let mut first: Option<[f64; 3]> = None;
    for edge in edges("0.08") {
        let start = Instant::now();
        let at = |x: f64| ball(DVec3::new(x, 0.0, 0.0), balls.radius, edge);
        let both = together(&at(-balls.offset), &at(balls.offset));
        let mut tracker = tracker(&both, finer_where_curved(0.25));
        let speed = |_: DVec3, time: f64| if time < 1.0 { 0.2 } else { -0.2 };
        let flow = FaceOffsetting::new(speed);
        let dt = 0.25 * edge;
        let nested = |tracker: &SurfaceTracker| {
            assert_eq!(misplaced_components(&tracker.surface().to_mesh()), 0, "{edge}: {}", tracker.time());
        };
        let mut steps = advance_to(&mut tracker, &flow, 1.0, dt, |tracker, _| nested(tracker));
        // The concave crease where they met is the centre of a fan when they shrink, which is born from its shortest edges: what is missed there
        // stays. These are a quarter of the others at 0.04, and go with their square.
        let parameters = finer_where_curved((edge / 0.16).min(0.25));
        let (length, time) = (tracker.reference_length(), tracker.time());
        tracker = SurfaceTracker::resume(tracker.surface().clone(), parameters, length, time, steps as u64)
            .unwrap();
        steps += advance_to(&mut tracker, &flow, 2.0, dt, |tracker, _| nested(tracker));
        let found = errors(&tracker.surface().to_mesh(), &exact);
        println!(
            "{edge} (mean {:.4}): {steps} steps, {found:?}, {} components, {} triangles, {:.1} s",
            tracker.reference_length(),
            components(&tracker),
            tracker.surface().connectivity().triangle_count(),
            start.elapsed().as_secs_f64()
        );
        assert_eq!(components(&tracker), 1);
        // \[Brochu12, Table 3.1\]: 0.2 of the edge length at 0.04.
        assert!(found.linf < 0.1 * edge, "{edge}: {found:?}");
        // Over all edge lengths that were named: of two halvings, 1.41 and 0.69 for the largest error, 1.91 and 1.39 for the mean, because
        // the bottom of the crease is filled by the shortest edges while the balls grow.
        let [coarse, linf, l1] = *first.get_or_insert([edge, found.linf, found.l1]);
        if edge < coarse {
            let order = |before: f64, now: f64| (before / now).ln() / (coarse / edge).ln();
            let orders = [order(linf, found.linf), order(l1, found.l1)];
            println!("orders from {coarse}: {orders:.2?}");
            assert!(orders[0] > 1.0 && orders[1] > 1.0, "{edge}: {orders:?}");
        }
    }
}

/// A ball that shrinks by its mean curvature.
#[test]
fn balls_shrink_by_mean_curvature() {
    for edge in edges("0.1,0.05") {
        let mut tracker = tracker(&ball(DVec3::ZERO, 0.4, edge), without_topology());
        let flow = MeanCurvature::default();
        let steps = advance_to(&mut tracker, &flow, 0.02, 0.001, |_, _| {});
        let radius = (0.4_f64.powi(2) - 4.0 * 0.02).sqrt();
        let found = errors(&tracker.surface().to_mesh(), |p| p.length() - radius);
        println!("{edge}: {steps} steps, {found:?}");
        assert!(found.linf < 0.1 * edge * edge / 0.4, "{edge}: {found:?}");
    }
}

/// The dumbbell of \[Brochu12, section 3.3.2\] against a solution in the meridian plane, to 0.025; it parts by itself.
#[test]
fn the_dumbbell_parts_by_mean_curvature() {
    let profile = DumbbellProfile { fillet_radius: 0.1, ..DumbbellProfile::default() };
    let mut exact = MeridianFlow::new(profile.half_line(800), End::Symmetry);
    exact.advance_to(0.025);
    let parted = exact.parted().unwrap();
    for edge in edges("0.04") {
        let start = Instant::now();
        // How soon the neck parts, when it is thin, decides where its ends are afterwards; and all that is refined at once is
        // sampled from a mesh that knows the fillets.
        let curvature =
            CurvatureAdaption { edge_over_radius: 0.4, scale: [0.1, 1.0], ..CurvatureAdaption::default() };
        let improvement = ImprovementParameters {
            curvature: Some(curvature),
            split_scheme: SplitScheme::Fitted,
            keeps_volume: false,
            ..ImprovementParameters::default()
        };
        let reference_length = Some(edge);
        let mesh = dumbbell_mesh(&profile, 0.5 * edge);
        let mut tracker = tracker(
            &mesh,
            TrackerParameters { improvement, reference_length, ..TrackerParameters::default() },
        );
        for _ in 0..3 {
            let _ = tracker.improve(&Monitor::none()).unwrap();
        }
        let flow = MeanCurvature::default();
        let mut separated = None;
        let steps = advance_to(&mut tracker, &flow, 0.025, 0.001, |tracker, _| {
            if separated.is_none() && components(tracker) > 1 {
                separated = Some(tracker.time());
            }
        });
        let found = errors(&tracker.surface().to_mesh(), |p| exact.signed_distance(half_plane(p, DVec3::Z)));
        println!(
            "{edge}: {steps} steps, parted at {separated:?} (exact {parted:.6}), {found:?}, {} components, {:.1} s",
            components(&tracker),
            start.elapsed().as_secs_f64()
        );
        assert_eq!(components(&tracker), 2, "{edge}");
        // \[Brochu12, Table 3.3\]: 6.2e-4 at 0.04, 1.44e-4 at 0.02.
        assert!(found.linf < 0.36 * edge * edge, "{edge}: {found:?}");
    }
}

fn dumbbell_mesh(profile: &DumbbellProfile, edge_length: f64) -> TriMesh {
    let shape = Dumbbell {
        radius: profile.radius,
        distance: 2.0 * profile.offset,
        neck_radius: profile.neck_radius,
        fillet_radius: profile.fillet_radius,
        edge_length,
    };
    dumbbell(&shape).unwrap().into_mesh()
}

/// A ball in curl noise; no change of topology.
#[test]
fn curl_noise_keeps_volume() {
    // Like the splines of the thesis: one scale, larger than the ball, so that it is drawn out, not mixed.
    let parameters = CurlNoiseParameters {
        potential: Potential::Planar,
        octaves: 1,
        speed: setting("WELTER_TRACKER_CURL_SPEED", 0.1),
        ..CurlNoiseParameters::default()
    };
    let end = setting("WELTER_TRACKER_CURL_TIME", 3.0);
    for edge in edges("0.05") {
        let start = Instant::now();
        let mesh = mapped(&ball(DVec3::ZERO, 0.2, edge), |p| p);
        let mut tracker = tracker(&mesh, without_topology());
        let flow = Advection { field: CurlNoise::new(&parameters).unwrap(), scheme: Scheme::Rk4 };
        let before = volume(&tracker);
        let mut worst = 0.0_f64;
        let mut told = 0.0;
        let steps = advance_to(&mut tracker, &flow, end, 0.05, |tracker, _| {
            worst = worst.max((volume(tracker) / before - 1.0).abs());
            if tracker.time() >= told {
                told += 1.0;
                let triangles = tracker.surface().connectivity().triangle_count();
                let seconds = start.elapsed().as_secs_f64();
                println!(
                    "  time {:.2}: {triangles} triangles, worst {worst:.2e}, {seconds:.1} s",
                    tracker.time()
                );
            }
        });
        println!(
            "{edge}: {steps} steps, volume {:+.2e} (worst {worst:.2e}), {} triangles, {:.1} s",
            volume(&tracker) / before - 1.0,
            tracker.surface().connectivity().triangle_count(),
            start.elapsed().as_secs_f64()
        );
        assert!(worst < 0.005, "{edge}: {worst}");
    }
}
