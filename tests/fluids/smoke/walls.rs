//! Smoke that is blown against solids: no vertex is in them after a step, but where other smoke holds it.

use super::{ball, once, run, setting, step};
use glam::DVec3;
use welter_fluids::procedural::{
    Amplitude, AnyPotential, BoundaryParameters, Bounded, VectorPotential, Weighted, WeightedSum, Wind,
    WindParameters,
};
use welter_fluids::smoke::SmokeParameters;
use welter_meshing::field::{AnyField, Ball, Cuboid, ScalarField};
use welter_meshing::surface::measure::signed_volume;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters};
use welter_tracking::integration::IntegrationParameters;

fn around(solid: AnyField<'static>) -> Bounded<impl VectorPotential, AnyField<'static>> {
    let wind = Wind::new(&WindParameters { velocity: DVec3::X, origin: DVec3::ZERO }).unwrap();
    let noise = CurlNoise::new(&CurlNoiseParameters { seed: 7, ..Default::default() }).unwrap();
    let parts = [(AnyPotential::new(wind), 1.0), (AnyPotential::new(noise), 0.3)];
    let parts = parts.map(|(part, weight)| Weighted { part, amplitude: Amplitude::Constant(weight) });
    let parameters = BoundaryParameters { ramp_width: 0.4, ..Default::default() };
    Bounded::new(WeightedSum::new(parts.to_vec()), solid, &parameters).unwrap()
}

/// Splits put vertices into round solids, and smoothing does, at each step anew.
#[test]
fn no_vertex_is_in_a_solid_after_a_step() {
    let cuboid = Cuboid { min: DVec3::splat(-0.4), max: DVec3::splat(0.4), rounding: 0.1 };
    let solids = [
        ("ball", AnyField::new(Ball { center: DVec3::ZERO, radius: 0.5 })),
        ("rounded cuboid", AnyField::new(cuboid)),
        ("sharp cuboid", AnyField::new(Cuboid { rounding: 0.0, ..cuboid })),
    ];
    let edge = 0.08;
    for (name, solid) in solids {
        let flow = around(solid.clone());
        for collisions in [None, Some(IntegrationParameters::default())] {
            let held = collisions.is_some();
            let parameters = SmokeParameters { collisions, ..Default::default() };
            let mut smoke = run(vec![once(ball(DVec3::new(-1.1, 0.05, 0.0), 0.4, edge))], parameters);
            let (mut deepest, mut touching) = (0.0_f64, 0);
            for i in 1..=setting("WELTER_SMOKE_STEPS", 40) {
                let _ = step(&mut smoke, &flow, 0.05 * f64::from(i));
                let mesh = smoke.mesh();
                let values = mesh.positions().iter().map(|&p| solid.value(p)).collect::<Vec<_>>();
                deepest = values.iter().fold(deepest, |least, value| least.min(*value));
                touching = touching.max(values.iter().filter(|value| value.abs() < 0.1 * edge).count());
            }
            let volume = signed_volume(&smoke.mesh());
            println!(
                "{name}, collisions {held}: {touching} at the wall, deepest {:.3} edges, volume {volume}",
                deepest / edge
            );
            assert!(touching > 20, "{name}: the wall was never met");
            // Where sheets meet at a wall the response to collisions may push one of them into it, until the next step.
            assert!(deepest >= if held { -0.5 * edge } else { 0.0 }, "{name}, {held}: {deepest:e}");
        }
    }
}

/// Smoke that is released half in a solid is outside at once.
#[test]
fn what_is_released_in_a_solid_comes_out() {
    let floor = Cuboid { min: DVec3::new(-2.0, -1.0, -2.0), max: DVec3::new(2.0, 0.0, 2.0), rounding: 0.0 };
    let flow = around(AnyField::new(floor));
    let mut smoke = run(vec![once(ball(DVec3::new(0.0, 0.1, 0.0), 0.3, 0.06))], SmokeParameters::default());
    let within = |smoke: &welter_fluids::smoke::SmokeSimulation| {
        smoke.mesh().positions().iter().filter(|&&p| floor.value(p) < 0.0).count()
    };
    assert!(within(&smoke) > 50);
    for i in 1..=5 {
        let _ = step(&mut smoke, &flow, 0.02 * f64::from(i));
        assert_eq!(within(&smoke), 0);
    }
    // The cap of the ball above the floor.
    let height: f64 = 0.4;
    let cap = std::f64::consts::PI * height * height * (0.9 - height) / 3.0;
    let volume = signed_volume(&smoke.mesh());
    assert!((volume / cap - 1.0).abs() < 0.05, "{volume}, not {cap}");
}
