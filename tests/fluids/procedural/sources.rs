//! Sources: their divergence by automatic differentiation, and by what flows out of closed surfaces.

use super::points;
use glam::DVec3;
use welter_fluids::procedural::{
    DivergentSource, DivergentSourceParameters, Extent, ScalarNoise, ScalarNoiseParameters, SourceNoise,
};
use welter_kit::evolution::Dual;
use welter_kit::procedural::{flux_of_box, flux_of_sphere};
use welter_meshing::quadrature::CubeRule;
use welter_tracking::flows::VelocityField;

const CENTER: DVec3 = DVec3::new(0.2, -0.1, 0.3);

fn parameters(extent: Extent, noise: bool) -> DivergentSourceParameters {
    let waves = ScalarNoiseParameters { seed: 2, wavelength: 0.8, ..Default::default() };
    let noise = noise.then_some(SourceNoise { mean: 0.5, variation: 0.75, waves });
    DivergentSourceParameters { center: CENTER, radius: 0.6, expansion: 2.5, extent, noise }
}

fn source(extent: Extent, noise: bool) -> DivergentSource {
    DivergentSource::new(&parameters(extent, noise)).unwrap()
}

/// The velocity in numbers with derivatives, from the text of the documentation.
fn twin(extent: Extent, noise: Option<&ScalarNoise>, point: DVec3, time: f64) -> [Dual; 3] {
    let constant = Dual::constant;
    let x = Dual::coordinates(point);
    let d: [Dual; 3] = std::array::from_fn(|k| x[k] - constant(CENTER[k]));
    let square = (1.0 / 0.36) * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    let inside = constant(1.0) - square;
    let factor = match extent {
        Extent::Confined if inside.value <= 0.0 => constant(0.0),
        Extent::Confined => (1.0 / 3.0) * (inside * inside * inside * inside * inside),
        Extent::Unbounded if inside.value <= 0.0 => (128.0 / 3465.0) * (square * square.sqrt()).recip(),
        Extent::Unbounded => {
            // The binomial expansion of (1 - t^2)^4, times t^2, integrated.
            let mut power = constant(1.0);
            let mut sum = constant(0.0);
            for (i, binomial) in [1.0, -4.0, 6.0, -4.0, 1.0].into_iter().enumerate() {
                sum = sum + (binomial / (2 * i + 3) as f64) * power;
                power = power * square;
            }
            sum
        }
    };
    let n = noise.map_or(constant(1.0), |noise| {
        let (value, gradient) = noise.at(point, time);
        Dual { value: 0.5 + 0.75 * value, gradient: 0.75 * gradient }
    });
    d.map(|c| 2.5 * (n * factor * c))
}

#[test]
fn velocity_and_divergence_are_the_formula() {
    let waves = ScalarNoiseParameters { seed: 2, wavelength: 0.8, ..Default::default() };
    let noise = ScalarNoise::new(&waves).unwrap();
    for extent in [Extent::Confined, Extent::Unbounded] {
        for noise in [None, Some(&noise)] {
            let source = source(extent, noise.is_some());
            let mut places = points(1000, 1.0, 31);
            places.extend(points(100, 1e-9, 32).into_iter().map(|p| CENTER + p));
            // On the radius and next to it.
            places.extend(points(200, 1.0, 33).into_iter().map(|p| CENTER + 0.6 * p.normalize()));
            places.push(CENTER);
            for point in places {
                let (expected, divergence) = Dual::divergence(twin(extent, noise, point, 0.3));
                let found = source.velocity(point, 0.3);
                assert!((found - expected).length() < 4e-15, "{extent:?} {point}: {found} {expected}");
                let stated = source.divergence(point, 0.3);
                assert!((stated - divergence).abs() < 2e-14, "{extent:?} {point}: {stated} {divergence}");
            }
        }
    }
    assert_eq!(source(Extent::Confined, false).divergence(CENTER, 0.0), 2.5);
    assert_eq!(source(Extent::Unbounded, false).divergence(CENTER, 0.0), 2.5);
}

/// Out of each ball around the centre flows what its divergence gives: the integral over radii of `4 pi r^2 div`.
#[test]
fn what_flows_out_of_a_ball_comes_into_being_in_it() {
    for extent in [Extent::Confined, Extent::Unbounded] {
        let source = source(extent, false);
        let rule = welter_meshing::quadrature::SegmentRule::of_degree(31).unwrap();
        for radius in [0.1, 0.4, 0.6, 1.0, 5.0] {
            let flux = flux_of_sphere(|p| source.velocity(p, 0.0), CENTER, radius, 1);
            // The divergence is a polynomial up to the radius of the source, and zero beyond.
            let end = f64::min(radius, 0.6);
            let within: f64 = rule
                .points()
                .iter()
                .map(|&([_, s], w)| {
                    let r = end * s;
                    let divergence = source.divergence(CENTER + r * DVec3::Y, 0.0);
                    w * end * 4.0 * std::f64::consts::PI * r * r * divergence
                })
                .sum();
            let scale = source.outflow().abs().max(0.3);
            assert!((flux.outward - within).abs() < 1e-14 * scale, "{extent:?} {radius}: {flux:?} {within}");
            if radius >= 0.6 {
                assert!(
                    (flux.outward - source.outflow()).abs() < 1e-14 * scale,
                    "{extent:?} {radius}: {flux:?}"
                );
            }
        }
    }
    assert_eq!(source(Extent::Confined, false).outflow(), 0.0);
}

/// The theorem of Gauss in boxes, with noise: the flux through the faces is the integral of the stated divergence.
#[test]
fn what_flows_out_of_a_box_is_the_integral_of_the_divergence() {
    let rule = CubeRule::of_degree(31).unwrap();
    for extent in [Extent::Confined, Extent::Unbounded] {
        let source = source(extent, true);
        // Within the ball, and beside it where the flow of one is a point source's.
        for [min, max] in [
            [CENTER - DVec3::splat(0.2), CENTER + DVec3::new(0.3, 0.25, 0.1)],
            [CENTER + DVec3::splat(0.5), CENTER + DVec3::splat(0.9)],
        ] {
            let size = max - min;
            let flux = flux_of_box(|p| source.velocity(p, 0.3), [min, max], 1);
            let within: f64 = rule
                .points()
                .iter()
                .map(|&(s, w)| w * source.divergence(min + DVec3::from_array(s) * size, 0.3))
                .sum::<f64>()
                * size.element_product();
            let gap = (flux.outward - within).abs();
            assert!(gap <= 1e-13 * flux.through, "{extent:?} {min}: {flux:?}, {within}: {gap:e}");
        }
    }
}

/// Derivatives across the radius: the fifth power of the distance to it inside, so that four derivatives vanish.
#[test]
fn the_flow_is_smooth_across_its_radius() {
    let confined = source(Extent::Confined, false);
    let at = |distance: f64| confined.velocity(CENTER + distance * DVec3::X, 0.0).x;
    for gap in [1e-2, 1e-3] {
        // (1 - s^2)^5 is about (2 gap / radius)^5.
        let expected = 2.5 / 3.0 * 0.6 * (2.0 * gap / 0.6_f64).powi(5);
        assert!((at(0.6 - gap) / expected - 1.0).abs() < 5.0 * gap / 0.6, "{gap}");
        assert_eq!(at(0.6 + gap), 0.0);
    }
    let unbounded = source(Extent::Unbounded, false);
    let at = |distance: f64| unbounded.velocity(CENTER + distance * DVec3::X, 0.0).x;
    for gap in [1e-2, 5e-3_f64] {
        // What is given out in the shell alone is missing: of the order of the fifth power.
        let point_source = source(Extent::Unbounded, false).outflow() / (4.0 * std::f64::consts::PI);
        let missing = point_source / (0.6 - gap).powi(2) - at(0.6 - gap);
        let expected = 2.5 * 16.0 * (gap / 0.6).powi(5) / 5.0 * 0.6;
        assert!((missing / expected - 1.0).abs() < 5.0 * gap / 0.6, "{gap}: {missing:e} {expected:e}");
    }
}
