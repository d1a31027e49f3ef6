//! Laws of fields: distances, gradients, combinations, bounds, noise.

use glam::{DMat3, DVec3};

use super::*;
use crate::distance::InsideRule;
use crate::shapes::{BoxPair, Sphere, sphere, two_boxes};

/// Numbers in [0, 1), the same ones on every machine.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self, reach: f64) -> DVec3 {
        let mut coordinate = || reach * (2.0 * self.unit() - 1.0);
        DVec3::new(coordinate(), coordinate(), coordinate())
    }
}

fn egg() -> Ellipsoid {
    Ellipsoid { center: DVec3::new(0.1, 0.0, -0.2), semi_axes: DVec3::new(1.3, 0.4, 0.9) }
}

/// Every field whose value is an exact distance, at general positions.
fn exact_fields() -> Vec<(&'static str, AnyField<'static>)> {
    let axis = DVec3::new(1.0, -2.0, 0.5);
    let ends = [DVec3::new(-0.5, 0.2, 0.1), DVec3::new(0.6, -0.3, 0.4)];
    let cube = Cuboid { min: DVec3::new(-1.0, -0.5, -0.7), max: DVec3::new(0.4, 0.8, 0.2), rounding: 0.0 };
    let placed = Placed {
        rotation: rotation_about(axis, 37.0),
        scale: 0.7,
        translation: DVec3::new(0.2, -0.1, 0.3),
        ..Placed::of(cube)
    };
    vec![
        ("ball", AnyField::new(Ball { center: ends[0], radius: 0.8 })),
        ("cuboid", AnyField::new(cube)),
        ("rounded cuboid", AnyField::new(Cuboid { rounding: 0.3, ..cube })),
        ("torus", AnyField::new(Torus { center: ends[1], axis, radius: 0.9, tube_radius: 0.35 })),
        ("capsule", AnyField::new(Capsule { ends, radius: 0.4 })),
        ("cylinder", AnyField::new(Cylinder { ends, radius: 0.6 })),
        ("ellipsoid", AnyField::new(egg())),
        ("half space", AnyField::new(HalfSpace { point: ends[0], normal: axis })),
        ("placed", AnyField::new(placed)),
    ]
}

/// Fields with kinks or without a distance, whose gradient is that of a formula all the same.
fn other_fields() -> Vec<(&'static str, AnyField<'static>)> {
    let [a, b] = [DVec3::new(-0.3, 0.1, 0.0), DVec3::new(0.4, 0.2, -0.1)];
    let balls = [a, b, a - b].map(|center| Ball { center, radius: 0.5 });
    let matrix = DMat3::from_cols_array(&[1.0, 0.2, 0.0, -0.3, 0.7, 0.1, 0.0, 0.4, 1.5]);
    let noise = FractalNoise { wavelength: 0.6, octaves: 3, ..FractalNoise::default() };
    let text = TextShape { words: "Ag&\ne".into(), ..TextShape::default() };
    let tube = TextShape { caps: Caps::Rounded, ..text.clone() };
    vec![
        ("union", AnyField::new(Union { parts: balls.to_vec(), blend_width: 0.0 })),
        ("blended union", AnyField::new(Union { parts: balls.to_vec(), blend_width: 0.6 })),
        ("blended intersection", AnyField::new(Intersection { parts: balls.to_vec(), blend_width: 0.6 })),
        ("difference", AnyField::new(Difference { from: balls[0], removed: balls[1], blend_width: 0.2 })),
        ("offset", AnyField::new(Offset { field: egg(), distance: 0.2 })),
        ("shell", AnyField::new(Shell { field: egg(), thickness: 0.1 })),
        ("complement", AnyField::new(Complement { field: egg() })),
        ("affine", AnyField::new(Affine::new(egg(), matrix, a).expect("valid parameters"))),
        ("gyroid", AnyField::new(Gyroid { period: 1.7, thickness: 0.0 })),
        ("gyroid sheet", AnyField::new(Gyroid { period: 1.7, thickness: 0.2 })),
        ("noise", AnyField::new(noise)),
        ("displaced", AnyField::new(Displaced { field: egg(), noise, amplitude: 0.3 })),
        ("text", AnyField::new(Text::new(&text).expect("valid parameters"))),
        ("rounded text", AnyField::new(Text::new(&tube).expect("valid parameters"))),
    ]
}

#[test]
fn gradients_are_those_of_the_values() {
    let mut random = Random(1);
    for (name, field) in exact_fields().into_iter().chain(other_fields()) {
        let mut agreeing = 0;
        for _ in 0..300 {
            let p = random.point(1.5);
            let gradient = field.gradient(p, f64::NAN);
            let value = |q: DVec3| field.value(q);
            let differences = value.gradient(p, 1e-6);
            agreeing += usize::from(gradient.abs_diff_eq(differences, 2e-5));
        }
        // The others lie within the step of a kink, or near a medial surface where the curvature is large.
        assert!(agreeing >= 297, "{name}: {agreeing} of 300");
    }
}

#[test]
fn exact_distances_satisfy_the_eikonal_equation() {
    let mut random = Random(2);
    for (name, field) in exact_fields() {
        for _ in 0..1000 {
            let p = random.point(2.0);
            let length = field.gradient(p, 0.0).length();
            assert!((length - 1.0).abs() < 1e-14, "{name} at {p}: {length}");
        }
    }
}

/// A foot on the surface, along the gradient, at the distance that the value says; and nothing nearer: the value changes by no more
/// than the distance between any two points. Together they say that the magnitude is the distance.
#[test]
fn exact_distances_are_attained_and_never_exceeded() {
    let mut random = Random(3);
    for (name, field) in exact_fields() {
        for _ in 0..1000 {
            let [p, q] = [random.point(2.0), random.point(2.0)];
            let (value, gradient) = (field.value(p), field.gradient(p, 0.0));
            let foot = field.value(p - value * gradient);
            assert!(foot.abs() < 4e-14, "{name} at {p}: {foot} at the foot");
            let change = (value - field.value(q)).abs();
            assert!(change <= p.distance(q) * (1.0 + 1e-14) + 1e-14, "{name}: {p} to {q}");
        }
    }
}

/// The slow twin: the least distance to points all over the surface.
#[test]
fn distances_are_those_to_the_nearest_of_many_surface_points() {
    let egg = egg();
    let steps = 400;
    let mut surface = Vec::new();
    for i in 0..=steps {
        for j in 0..2 * steps {
            let (theta, phi) = (f64::from(i), f64::from(j));
            let (st, ct) = (theta * std::f64::consts::PI / f64::from(steps)).sin_cos();
            let (sp, cp) = (phi * std::f64::consts::PI / f64::from(steps)).sin_cos();
            surface.push(egg.center + egg.semi_axes * DVec3::new(st * cp, st * sp, ct));
        }
    }
    // Half of the longest diagonal between neighbours.
    let gap = 1.3 * std::f64::consts::PI / f64::from(steps);
    let mut random = Random(4);
    let mut points: Vec<DVec3> = (0..40).map(|_| random.point(1.6)).collect();
    // On the planes and axes of symmetry, where several nearest points meet.
    points.extend((0..20).map(|k| egg.center + random.point(1.0) * [DVec3::X, DVec3::ONE - DVec3::Y][k % 2]));
    points.push(egg.center);
    points.push(egg.center + DVec3::new(0.3, 1e-300, 0.2));
    for p in points {
        let squared = surface.iter().map(|s| s.distance_squared(p)).fold(f64::INFINITY, f64::min);
        let (nearest, found) = (squared.sqrt(), egg.value(p).abs());
        assert!(found <= nearest + 1e-14, "{p}: {found} over {nearest}");
        assert!(nearest <= (found * found + gap * gap).sqrt() + gap * gap, "{p}: {found} under {nearest}");
    }
}

#[test]
fn extreme_ellipsoids_are_distances_too() {
    let mut random = Random(5);
    for axes in [[1.0, 1.0, 1.0], [1.0, 1e-3, 1.0], [1e-3, 1e-3, 5.0], [2.0, 1.0, 1e-4]] {
        let field = Ellipsoid { center: DVec3::ZERO, semi_axes: DVec3::from_array(axes) };
        for _ in 0..500 {
            let p = random.point(1.0) * field.semi_axes * 1.5;
            let foot = p - field.value(p) * field.gradient(p, 0.0);
            let off = (foot / field.semi_axes).length_squared() - 1.0;
            // A rounding of the foot in the direction of a small axis is large in units of it.
            let slack = 1e-13 * field.semi_axes.max_element() / field.semi_axes.min_element();
            assert!(off.abs() < slack, "{axes:?} at {p}: {off}");
        }
    }
}

#[test]
fn bounds_of_distance_change_by_at_most_one_per_length() {
    let mut random = Random(6);
    for (name, field) in other_fields() {
        if ["affine", "noise", "displaced"].contains(&name) {
            continue;
        }
        for _ in 0..500 {
            let [p, d] = [random.point(1.5), random.point(0.1)];
            let change = (field.value(p) - field.value(p + d)).abs();
            assert!(change <= d.length() * (1.0 + 1e-12) + 1e-14, "{name}: {p} by {d}");
        }
    }
}

#[test]
fn outside_of_the_bounds_fields_are_above_the_level() {
    let mut random = Random(7);
    let mut known = 0;
    for (name, field) in exact_fields().into_iter().chain(other_fields()) {
        for level in [-0.2, 0.0, 0.3] {
            let Some(around) = field.sublevel_bounds(level) else { continue };
            known += 1;
            let mut touched = [false; 6];
            for i in 0..4000 {
                // Anywhere, and in and next to the box.
                let beside = 0.5 * (around.min + around.max) + random.point(0.6) * (around.max - around.min);
                let p = if i % 2 == 0 { random.point(3.0) } else { beside };
                if field.value(p) <= level {
                    assert!(grown(&around, 1e-14).contains(p), "{name} at {p} for {level}");
                    let near = 0.25 * (around.max - around.min);
                    for k in 0..3 {
                        touched[k] |= p[k] < around.min[k] + near[k];
                        touched[k + 3] |= p[k] > around.max[k] - near[k];
                    }
                }
            }
            // Where the sublevel set is all that determines the box, it reaches near each side.
            let tight = ["ball", "torus", "capsule", "cylinder", "ellipsoid"].contains(&name);
            assert!(!tight || level != 0.0 || touched == [true; 6], "{name}: {touched:?}");
        }
    }
    assert!(known > 45, "{known}");
    assert_eq!(Ball { radius: 0.1, ..Ball::default() }.sublevel_bounds(-0.2), Some(Box3::EMPTY));
}

#[test]
fn laws_of_de_morgan_and_exchange_hold_bit_for_bit() {
    let mut random = Random(8);
    let parts: Vec<AnyField<'_>> = exact_fields().into_iter().map(|(_, field)| field).collect();
    for blend_width in [0.0, 0.5] {
        let not: Vec<Complement<AnyField<'_>>> =
            parts.iter().map(|field| Complement { field: field.clone() }).collect();
        let intersection = Intersection { parts: parts.clone(), blend_width };
        let by_union = Complement { field: Union { parts: not.clone(), blend_width } };
        let difference = Difference { from: parts[0].clone(), removed: parts[3].clone(), blend_width };
        let as_intersection =
            Intersection { parts: vec![parts[0].clone(), AnyField::new(not[3].clone())], blend_width };
        let pair =
            |i: usize, j: usize| Union { parts: vec![parts[i].clone(), parts[j].clone()], blend_width };
        for _ in 0..300 {
            let p = random.point(1.5);
            assert_eq!(intersection.value(p).to_bits(), by_union.value(p).to_bits());
            assert_eq!(intersection.gradient(p, 0.0), by_union.gradient(p, 0.0));
            assert_eq!(difference.value(p).to_bits(), as_intersection.value(p).to_bits());
            assert_eq!(difference.gradient(p, 0.0), as_intersection.gradient(p, 0.0));
            assert_eq!(pair(1, 4).value(p).to_bits(), pair(4, 1).value(p).to_bits());
        }
    }
}

#[test]
fn a_smooth_union_tends_to_the_sharp_one_and_stays_in_its_bound() {
    let mut random = Random(9);
    let balls: Vec<Ball> = (0..5).map(|_| Ball { center: random.point(0.6), radius: 0.5 }).collect();
    let sharp = Union { parts: balls.clone(), blend_width: 0.0 };
    for width in [0.8, 0.1, 1e-3, 1e-9] {
        let smooth = Union { parts: balls.clone(), blend_width: width };
        let mut greatest = 0.0_f64;
        for _ in 0..500 {
            let p = random.point(1.0);
            let below = sharp.value(p) - smooth.value(p);
            assert!((-1e-16..=width).contains(&below), "{width} at {p}: {below}");
            greatest = greatest.max(below);
        }
        assert!(width < 0.1 || greatest > 0.2 * width, "{width}: {greatest}");
    }
    let two = Union { parts: balls[..2].to_vec(), blend_width: 0.4 };
    let sharp = Union { parts: balls[..2].to_vec(), blend_width: 0.0 };
    assert!((0..500).all(|_| {
        let p = random.point(1.0);
        sharp.value(p) - two.value(p) <= 0.1 + 1e-16
    }));
}

#[test]
fn nan_and_infinities_do_not_vanish() {
    for (name, field) in exact_fields().into_iter().chain(other_fields()) {
        let value = field.value(DVec3::new(0.0, f64::NAN, 0.0));
        assert!(value.is_nan(), "{name}: {value}");
        let _ = field.value(DVec3::INFINITY);
        let _ = field.gradient(DVec3::NEG_INFINITY, 1.0);
        let _ = field.gradient(DVec3::NAN, 1.0);
        let _ = field.value(DVec3::splat(f64::MAX));
    }
    let nothing: Union<Ball> = Union::default();
    assert_eq!(nothing.value(DVec3::ZERO), f64::INFINITY);
    assert!(nothing.validate().is_err());
}

#[test]
fn noise_is_what_its_head_promises() {
    let noise = GradientNoise { seed: 11 };
    let mut random = Random(10);
    let (mut least, mut greatest, mut mean) = (0.0_f64, 0.0_f64, 0.0);
    for _ in 0..20_000 {
        let value = noise.value(random.point(50.0));
        (least, greatest, mean) = (least.min(value), greatest.max(value), mean + value / 20_000.0);
    }
    assert!(greatest < NOISE_BOUND && least > -NOISE_BOUND && greatest > 0.7 && least < -0.7);
    assert!(mean.abs() < 0.02, "{mean}");
    // Another seed is another noise, the same seed the same one.
    let p = DVec3::new(0.3, 0.4, 0.6);
    assert_ne!(noise.value(p), GradientNoise { seed: 12 }.value(p));
    assert_eq!(noise.value(p).to_bits(), GradientNoise { seed: 11 }.value(p).to_bits());
    assert_eq!(noise.value(DVec3::new(-3.0, 7.0, 2.0)), 0.0);
    assert!(noise.at(DVec3::splat(1e300)).0 == 0.0);
}

/// Across a wall of the lattice the value and both derivatives are continuous: the jump over a gap of `2e` is proportional to `e`.
#[test]
fn second_derivatives_of_noise_are_continuous() {
    let noise = GradientNoise { seed: 3 };
    let mut random = Random(11);
    // The second derivatives as differences of the exact gradient on one side of the wall.
    let second = |at: DVec3, side: DVec3, h: f64| {
        let g = |t: f64| noise.gradient(at + t * side, 0.0);
        (4.0 * g(h) - g(2.0 * h) - 3.0 * g(0.0)) / (2.0 * h)
    };
    for k in 0..30 {
        let axis = [DVec3::X, DVec3::Y, DVec3::Z][k % 3];
        let p = random.point(4.0);
        let wall = p - axis * (p - p.round()).dot(axis);
        let jump = |h: f64| (second(wall, axis, h) + second(wall, -axis, h)).length();
        assert!(jump(1e-3) < 2e-3, "{wall}: {}", jump(1e-3));
        assert!(jump(1e-4) < 2e-5, "{wall}: {}", jump(1e-4));
    }
}

/// The curl of a potential whose derivatives are exact has no divergence.
#[test]
fn the_curl_of_noise_is_free_of_divergence() {
    let potential = [1, 2, 3].map(|seed| GradientNoise { seed });
    let curl = |p: DVec3| {
        let [x, y, z] = [0, 1, 2].map(|k| potential[k].gradient(p, 0.0));
        DVec3::new(z.y - y.z, x.z - z.x, y.x - x.y)
    };
    let mut random = Random(12);
    let h = 1e-4;
    for _ in 0..100 {
        let p = random.point(5.0);
        let d = |axis: DVec3| (curl(p + h * axis) - curl(p - h * axis)).dot(axis) / (2.0 * h);
        assert!((d(DVec3::X) + d(DVec3::Y) + d(DVec3::Z)).abs() < 1e-5, "{p}");
    }
}

#[test]
fn rotations_turn_and_multiples_of_right_angles_are_exact() {
    assert_eq!(rotation_about(DVec3::Z, -90.0) * DVec3::X, DVec3::NEG_Y);
    assert_eq!(rotation_about(2.0 * DVec3::X, 450.0) * DVec3::Y, DVec3::Z);
    assert_eq!(rotation_about(DVec3::Y, 180.0) * DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, 2.0, -3.0));
    let axis = DVec3::new(1.0, 2.0, -3.0);
    let r = rotation_about(axis, 20.0);
    assert!((r * axis).abs_diff_eq(axis, 1e-15));
    let across = axis.any_orthogonal_vector().normalize();
    assert!(((r * across).dot(across) - 20.0_f64.to_radians().cos()).abs() < 1e-15);
    assert!((across.cross(r * across)).dot(axis) > 0.0, "counterclockwise seen from the head of the axis");
    assert!(Placed { rotation: r, ..Placed::of(egg()) }.validate().is_ok());
    assert!(Placed { rotation: -r, ..Placed::of(egg()) }.validate().is_err());
    assert!(Affine::new(egg(), DMat3::ZERO, DVec3::ZERO).is_err());
}

#[test]
fn the_distance_to_a_mesh_of_a_sphere_is_that_of_its_triangles() {
    let mesh = sphere(&Sphere { edge_length: 0.2, ..Sphere::default() }).expect("valid parameters");
    let (field, ball) = (MeshDistance::new(&mesh, InsideRule::default()), Ball::default());
    let mut random = Random(13);
    for _ in 0..300 {
        let p = random.point(1.5);
        // Inscribed: outside of the ball by at most the height of an edge's arc.
        let deeper = field.value(p) - ball.value(p);
        assert!((-1e-15..0.2 * 0.2 / 4.0).contains(&deeper), "{p}: {deeper}");
        assert!((field.gradient(p, 0.0).length() - 1.0).abs() < 1e-12);
        let foot = field.value(p - field.value(p) * field.gradient(p, 0.0));
        assert!(foot.abs() < 1e-12, "{p}: {foot}");
    }
    assert_eq!(field.value(mesh.positions()[5]), 0.0);
    assert!(field.value(DVec3::NAN).is_nan());
    assert_eq!(field.sublevel_bounds(0.5).map(|b| b.max.x > 1.49), Some(true));
}

#[test]
fn what_is_inside_of_overlapping_boxes_is_chosen() {
    let pair = BoxPair::overlapping();
    let mesh = two_boxes(&pair).expect("valid parameters");
    let middle = 0.5 * (pair.second[0] + pair.first[1]);
    let values = [InsideRule::Positive, InsideRule::NonZero, InsideRule::Odd]
        .map(|inside| MeshDistance::new(&mesh, inside).value(middle));
    assert!(values[0] < 0.0 && values[1] < 0.0 && values[2] > 0.0, "{values:?}");
}

#[test]
fn text_is_as_high_and_deep_as_it_says() {
    for caps in [Caps::Flat, Caps::Rounded] {
        let shape = TextShape { words: "H".into(), height: 2.0, pen_radius: 0.1, depth: 0.5, caps };
        let text = Text::new(&shape).expect("valid parameters");
        let around = text.bounds().expect("valid parameters");
        assert_eq!((around.min.z, around.max.z), (-0.25, 0.25));
        assert!((around.max.y - 1.1).abs() < 1e-15 && (around.min.y + 1.1).abs() < 1e-15);
        assert!((around.max.x + around.min.x).abs() < 1e-15);
        // The bar of an H lies a ninth of the capital's height above its middle; it is met at its surface.
        let bar = DVec3::new(0.0, 2.0 * 0.5 / 9.0, 0.0);
        assert!((text.value(bar) + 0.1).abs() < 1e-15, "{}", text.value(bar));
        assert!((text.value(bar + 0.75 * DVec3::Z) - 0.5).abs() < 1e-15);
    }
    let refused =
        |words: &str| Text::new(&TextShape { words: words.into(), ..TextShape::default() }).unwrap_err();
    assert_eq!(refused(" \n "), FieldError::NoStrokes);
    assert!(matches!(refused(&"a".repeat(20_000)), FieldError::TextTooLong { characters: 20_000, .. }));
    assert!(Text::new(&TextShape { caps: Caps::Rounded, depth: 0.1, ..TextShape::default() }).is_err());
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let named = |result: Result<(), FieldError>| match result {
        Err(FieldError::Parameter { parameter, .. }) => parameter,
        other => panic!("{other:?}"),
    };
    let cube = Cuboid::default();
    assert_eq!(named(Ball { radius: f64::NAN, ..Ball::default() }.validate()), "radius");
    assert_eq!(named(Cuboid { rounding: 1.5, ..cube }.validate()), "rounding");
    assert_eq!(named(Cuboid { max: cube.min, ..cube }.validate()), "max");
    assert_eq!(named(Torus { tube_radius: 2.0, ..Torus::default() }.validate()), "tube_radius");
    assert_eq!(named(Cylinder { ends: [DVec3::ONE; 2], radius: 1.0 }.validate()), "ends");
    assert_eq!(named(HalfSpace { normal: DVec3::ZERO, ..HalfSpace::default() }.validate()), "normal");
    assert_eq!(named(Ellipsoid { semi_axes: -DVec3::ONE, ..egg() }.validate()), "semi_axes");
    assert_eq!(named(Gyroid { period: 0.0, thickness: 0.0 }.validate()), "period");
    assert_eq!(named(FractalNoise { octaves: 0, ..FractalNoise::default() }.validate()), "octaves");
    assert_eq!(named(Shell { field: cube, thickness: 0.0 }.validate()), "thickness");
    assert_eq!(named(Offset { field: cube, distance: f64::INFINITY }.validate()), "distance");
    assert!(
        Ball::default().validate().is_ok() && cube.validate().is_ok() && Torus::default().validate().is_ok()
    );
}

/// Negation and scaling by powers of two change no bit; exchanging axes changes only the order of sums.
#[test]
fn distances_keep_the_symmetries_of_their_bodies() {
    let mut random = Random(14);
    let axes = DVec3::new(1.1, 0.3, 0.7);
    let ends = [DVec3::NEG_Z, DVec3::Z];
    let fields = |scale: f64| {
        [
            AnyField::new(Ball { center: DVec3::ZERO, radius: scale * 0.9 }),
            AnyField::new(Ellipsoid { center: DVec3::ZERO, semi_axes: scale * axes }),
            AnyField::new(Cuboid { min: -scale * axes, max: scale * axes, rounding: scale * 0.2 }),
            AnyField::new(Torus { radius: scale, tube_radius: scale * 0.4, ..Torus::default() }),
            AnyField::new(Cylinder { ends: ends.map(|e| scale * e), radius: scale * 0.5 }),
            AnyField::new(Capsule { ends: ends.map(|e| scale * e), radius: scale * 0.5 }),
        ]
    };
    let (plain, large, small) = (fields(1.0), fields(1024.0), fields(1.0 / 4096.0));
    for _ in 0..500 {
        let p = random.point(1.5);
        for k in 0..plain.len() {
            let value = plain[k].value(p);
            assert_eq!(value.to_bits(), plain[k].value(-p).to_bits(), "field {k} at {p}");
            assert_eq!((1024.0 * value).to_bits(), large[k].value(1024.0 * p).to_bits(), "field {k} at {p}");
            assert_eq!((value / 4096.0).to_bits(), small[k].value(p / 4096.0).to_bits(), "field {k} at {p}");
        }
        let turned = Ellipsoid { center: DVec3::ZERO, semi_axes: DVec3::new(axes.z, axes.x, axes.y) };
        let change = turned.value(DVec3::new(p.z, p.x, p.y)) - plain[1].value(p);
        assert!(change.abs() < 4e-15, "{p}: {change}");
    }
}

#[test]
fn on_the_gyroid_the_gradient_is_as_long_as_its_doc_says() {
    let field = Gyroid { period: 2.0, thickness: 0.0 };
    let mut random = Random(15);
    let (mut least, mut greatest) = (f64::INFINITY, 0.0_f64);
    for _ in 0..5000 {
        let mut p = random.point(1.0);
        for _ in 0..40 {
            let gradient = field.gradient(p, 0.0);
            p -= 0.9 * field.value(p) * gradient / gradient.length_squared().max(1e-3);
        }
        assert!(field.value(p).abs() < 1e-9, "{p}");
        let length = field.gradient(p, 0.0).length();
        (least, greatest) = (least.min(length), greatest.max(length));
    }
    let bound = (2.0_f64 / 3.0).sqrt();
    assert!(least >= bound - 1e-9 && least < bound + 0.01, "{least}");
    assert!(greatest <= 1.0 + 1e-12 && greatest > 0.99, "{greatest}");
}
