//! What the flows refuse, each with its place.

use super::{ball, mesh};
use glam::DVec3;
use welter_tracking::flows::fields::{CurlNoise, CurlNoiseParameters, Enright, Rotation, Shear};
use welter_tracking::flows::{
    Advection, FaceOffsetting, FaceOffsettingParameters, Flow, FlowError, Jitter, MeanCurvature, Scheme,
};
use welter_tracking::surface::MovingSurface;

fn name_of(result: Result<(), FlowError>) -> &'static str {
    match result {
        Err(FlowError::Parameter { name, .. }) => name,
        other => panic!("{other:?}"),
    }
}

#[test]
fn time_steps_that_are_none() {
    let surface = ball(1.0, 0.5);
    let flows: [&dyn Flow; 4] = [
        &Advection { field: Rotation::default(), scheme: Scheme::Rk4 },
        &FaceOffsetting::new(1.0),
        &MeanCurvature::default(),
        &Jitter::default(),
    ];
    for flow in flows {
        for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let found = flow.advance(&surface, 0.0, dt);
            assert!(matches!(found, Err(FlowError::TimeStep { .. })), "{dt}: {found:?}");
        }
    }
}

#[test]
fn parameters_out_of_range() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(name_of(Enright { period: bad, size: 1.0 }.validate()), "period");
        assert_eq!(name_of(Enright { period: 1.0, size: bad }.validate()), "size");
        let noise = CurlNoiseParameters { wavelength: bad, ..Default::default() };
        assert_eq!(name_of(CurlNoise::new(&noise).map(drop)), "wavelength");
    }
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let noise = CurlNoiseParameters { speed: bad, ..Default::default() };
        assert_eq!(name_of(noise.validate()), "speed");
        assert_eq!(name_of(CurlNoiseParameters { gain: bad, ..Default::default() }.validate()), "gain");
        assert_eq!(name_of(Jitter { amplitude_rel: bad, seed: 0 }.validate()), "amplitude_rel");
        assert_eq!(name_of(MeanCurvature { speed: bad, ..Default::default() }.validate()), "speed");
    }
    for bad in [0.0, -1.0, f64::NAN] {
        assert_eq!(name_of(CurlNoiseParameters { period: bad, ..Default::default() }.validate()), "period");
        assert_eq!(name_of(MeanCurvature { safety: bad, ..Default::default() }.validate()), "safety");
        assert_eq!(name_of(MeanCurvature { stiffness: bad, ..Default::default() }.validate()), "stiffness");
    }
    assert_eq!(name_of(MeanCurvature { safety: 1.5, ..Default::default() }.validate()), "safety");
    for bad in [0, 17] {
        assert_eq!(name_of(CurlNoiseParameters { octaves: bad, ..Default::default() }.validate()), "octaves");
    }
    for bad in [0, 4097] {
        assert_eq!(name_of(CurlNoiseParameters { waves: bad, ..Default::default() }.validate()), "waves");
    }
    let infinite = DVec3::new(0.0, f64::INFINITY, 0.0);
    assert_eq!(name_of(Rotation { center: infinite, ..Default::default() }.validate()), "center");
    assert_eq!(
        name_of(Rotation { angular_velocity: infinite, ..Default::default() }.validate()),
        "angular_velocity"
    );
    assert_eq!(name_of(Shear { direction: infinite, ..Default::default() }.validate()), "direction");
    assert_eq!(name_of(Shear { gradient: infinite, ..Default::default() }.validate()), "gradient");
    for bad in [-0.1, 1.0, f64::NAN] {
        let parameters = FaceOffsettingParameters { area_kept: bad, ..Default::default() };
        assert_eq!(name_of(parameters.validate()), "area_kept");
    }
    for bad in [0.0, 1.0, f64::NAN] {
        let parameters = FaceOffsettingParameters { rank_threshold: bad, ..Default::default() };
        assert_eq!(name_of(parameters.validate()), "rank_threshold");
        let flow = FaceOffsetting { parameters, ..FaceOffsetting::new(1.0) };
        assert_eq!(name_of(flow.advance(&ball(1.0, 0.5), 0.0, 1.0).map(drop)), "rank_threshold");
    }
    for bad in [-0.1, 1.1, f64::NAN] {
        let parameters = FaceOffsettingParameters { least_fraction: bad, ..Default::default() };
        assert_eq!(name_of(parameters.validate()), "least_fraction");
    }
}

#[test]
fn velocities_and_speeds_that_are_not_finite() {
    let surface = ball(1.0, 0.5);
    // Only a stage that looks ahead meets the bad part.
    let field = |p: DVec3, _: f64| if p.z > 1.05 { DVec3::NAN } else { DVec3::Z };
    let euler = Advection { field, scheme: Scheme::Euler }.advance(&surface, 0.0, 0.2);
    assert!(euler.is_ok());
    let found = Advection { field, scheme: Scheme::Rk4 }.advance(&surface, 2.0, 0.2);
    let Err(FlowError::Velocity { vertex, position, time, .. }) = found else { panic!("{found:?}") };
    assert!(position.z > 1.05 && time > 2.0 && surface.position(vertex).z > 0.8);
    let message = found.unwrap_err().to_string();
    assert!(message.contains(&format!("vertex {}", vertex.0)), "{message}");

    let flow = FaceOffsetting::new(|p: DVec3, _: f64| if p.z > 0.5 { f64::INFINITY } else { 1.0 });
    let found = flow.advance(&surface, 0.0, 0.1);
    let Err(FlowError::Speed { triangle, position, time, .. }) = found else { panic!("{found:?}") };
    let corners = surface.connectivity().corners(triangle).map(|v| surface.position(v));
    let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    assert!(position.z > 0.5 && position.distance(middle) < 1e-15 && time == 0.05);
}

#[test]
fn ends_beyond_the_range_of_numbers() {
    let surface = ball(1.0, 0.5);
    let far = Advection { field: |_: DVec3, _: f64| DVec3::splat(f64::MAX), scheme: Scheme::Euler };
    assert!(matches!(far.advance(&surface, 0.0, 2.0), Err(FlowError::End { .. })));
    let found = FaceOffsetting::new(f64::MAX).advance(&surface, 0.0, 2.0);
    assert!(matches!(found, Err(FlowError::End { .. })), "{found:?}");
    let jitter = Jitter { amplitude_rel: f64::MAX, seed: 0 }.advance(&surface, 0.0, 1.0);
    assert!(jitter.is_ok() || matches!(jitter, Err(FlowError::End { .. })));
}

#[test]
fn steps_that_take_no_time() {
    let surface = ball(1.0, 0.5);
    // So late that a stable step is lost in rounding.
    let found = MeanCurvature::default().advance(&surface, 1e300, 1.0);
    assert!(matches!(found, Err(FlowError::NoProgress { .. })), "{found:?}");
    let found = FaceOffsetting::new(1.0).advance(&surface, 1e300, 1.0);
    assert!(matches!(found, Err(FlowError::NoProgress { .. })), "{found:?}");
}

/// Surfaces of all sizes at once, without area, and empty: finite ends or an error, never a panic.
#[test]
fn hostile_surfaces() {
    let mut random = welter_kit::mesher::Random::new(91);
    let place = |random: &mut welter_kit::mesher::Random, kind: u64| match kind % 4 {
        0 => DVec3::ZERO,
        1 => random.point() * 1e-300,
        2 => random.point() * f64::MAX,
        _ => random.point(),
    };
    let (mut done, mut refused) = (0, std::collections::BTreeMap::new());
    for case in 0..1500 {
        let positions: Vec<DVec3> = (0..4).map(|i| place(&mut random, case >> (2 * i))).collect();
        let tetrahedron = mesh(positions, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        let surface = MovingSurface::new(&tetrahedron).unwrap();
        let flows: [&dyn Flow; 5] = [
            &Advection { field: Rotation::default(), scheme: Scheme::Rk4 },
            &FaceOffsetting::new(1.0),
            &FaceOffsetting::new(-1e-300),
            &MeanCurvature::default(),
            &Jitter::default(),
        ];
        for flow in flows {
            match flow.advance(&surface, 0.0, 1.0) {
                Ok(prediction) => {
                    assert!(prediction.ends.iter().all(|p| p.is_finite()));
                    assert!(prediction.dt > 0.0 && prediction.dt <= 1.0);
                    done += 1;
                }
                Err(error) => {
                    let kind = format!("{error:?}");
                    *refused.entry(kind.split(' ').next().unwrap().to_owned()).or_insert(0) += 1;
                }
            }
        }
    }
    println!("hostile surfaces: {done} steps, {refused:?} refused");
    // Those with coordinates near the largest number go beyond it.
    assert!(done > 4 * refused.values().sum::<i32>(), "{done}, {refused:?}");
    let empty = MovingSurface::new(&mesh(vec![], vec![])).unwrap();
    assert!(MeanCurvature::default().advance(&empty, 0.0, 1.0).unwrap().ends.is_empty());
    assert!(FaceOffsetting::new(1.0).advance(&empty, 0.0, 1.0).unwrap().ends.is_empty());
    assert!(Jitter::default().advance(&empty, 0.0, 1.0).unwrap().ends.is_empty());
}
