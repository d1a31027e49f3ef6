//! Random violent motions of surfaces with wide and thin gaps: whatever the ends and the parameters, the surface stays
//! embedded.

use super::Body;
use std::time::Instant;
use welter_kit::mesher::Random;
use welter_kit::moving::{collisions, ends, first_collision, scenes};
use welter_tracking::integration::IntegrationParameters;

/// `WELTER_INTEGRATION_STEPS` sets how many.
fn steps(otherwise: usize) -> usize {
    std::env::var("WELTER_INTEGRATION_STEPS").map_or(otherwise, |text| text.parse().unwrap())
}

fn some_parameters(random: &mut Random) -> IntegrationParameters {
    let defaults = IntegrationParameters::default();
    if random.below(2) == 0 {
        return defaults;
    }
    let mut pick = |values: &[u32]| values[random.below(values.len() as u64) as usize];
    IntegrationParameters {
        check_start: pick(&[0, 1]) == 1,
        proximity_rel: f64::from(pick(&[0, 1, 30])) / 1000.0,
        friction: f64::from(pick(&[0, 0, 1, 5])) / 5.0,
        sweeps: pick(&[0, 1, 3]),
        zone_rounds: pick(&[0, 3, 12]),
        most_zone_collisions: pick(&[1, 10, 512]),
        rigid_rounds: pick(&[0, 3, 12]),
        most_halvings: pick(&[0, 1, 3]),
        most_collisions_per_vertex: pick(&[1, 64, u32::MAX]),
    }
}

/// A distance of 1e-3 to 1e3 edge lengths, mostly moderate.
fn some_distance(random: &mut Random, length: f64) -> f64 {
    let violent = random.below(6) == 0;
    length * 10f64.powf(if violent { random.between(-3.0, 3.0) } else { random.between(-1.5, 0.5) })
}

#[test]
fn no_step_leaves_an_intersection() {
    let (steps, mut random, clock) = (steps(90), Random::new(1), Instant::now());
    let (mut done, mut seed) = (0, 0);
    let mut counts = [0; 8];
    let mut slowest = (0.0, String::new());
    while done < steps {
        seed += 1;
        for scene in scenes(&mut Random::new(seed)) {
            let mut body = Body::of(&scene);
            for _ in 0..random.below(8) + 1 {
                let distance = some_distance(&mut random, body.length);
                let parameters = some_parameters(&mut random);
                let predicted = ends(&body.surface, &mut random, distance);
                let place = format!("{}, seed {seed}, step {done}, {distance:e}, {parameters:?}", scene.name);
                let clock = Instant::now();
                let resolved = match body.resolve(predicted, &parameters) {
                    Ok(resolved) => resolved,
                    Err(error) => panic!("{place}: {error}"),
                };
                body.accept(&resolved.ends).unwrap_or_else(|error| panic!("{place}: {error}"));
                let seconds = clock.elapsed().as_secs_f64();
                if seconds > slowest.0 {
                    slowest = (seconds, format!("{place} {:?}", resolved.report));
                }
                assert!(body.is_embedded(), "{place}");
                assert!(0.0 < resolved.fraction && resolved.fraction <= 1.0, "{place}");
                let report = resolved.report;
                let happened = [
                    report.collisions != Some(0),
                    report.repulsions > 0,
                    report.impulses > 0,
                    report.impact_zones > 0,
                    report.singular_systems > 0,
                    report.rigid_zones > 0,
                    report.shortenings > 0,
                    report.resting_vertices > 0,
                ];
                happened.iter().zip(&mut counts).for_each(|(&is, count)| *count += usize::from(is));
                done += 1;
            }
        }
    }
    println!(
        "{done} steps in {:.1} s without an intersection; with [collisions, repulsions, impulses, impact zones, singular systems, rigid zones, shortenings, resting vertices]: {counts:?}; the slowest took {:.3} s: {}",
        clock.elapsed().as_secs_f64(),
        slowest.0,
        slowest.1
    );
    assert!(counts.iter().all(|&count| count > 0), "a stage was never used: {counts:?}");
}

#[test]
fn exact_arithmetic_over_all_pairs_finds_no_collision_on_the_ways() {
    let (mut random, mut found, mut seed) = (Random::new(2), 0, 0);
    for _ in 0..(steps(120) / 60).max(1) {
        seed += 1;
        for scene in
            scenes(&mut Random::new(seed)).into_iter().filter(|scene| scene.mesh.triangles().len() < 120)
        {
            let mut body = Body::of(&scene);
            let distance = body.length * random.between(0.1, 2.0);
            let predicted = ends(&body.surface, &mut random, distance);
            // No repulsion: the collisions are those of the predicted ends.
            let nothing = IntegrationParameters {
                proximity_rel: 0.0,
                most_collisions_per_vertex: u32::MAX,
                ..IntegrationParameters::default()
            };
            let before = body.surface.clone();
            let resolved = body.step(predicted.clone(), &nothing);
            let expected = collisions(&before, &predicted).len();
            assert_eq!(resolved.report.collisions, Some(expected), "{}", scene.name);
            assert_eq!(first_collision(&before, &resolved.ends), None, "{}", scene.name);
            found += expected;
        }
    }
    println!("{found} collisions");
    assert!(found > 100, "{found}");
}
