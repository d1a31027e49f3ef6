//! Over a closed surface of patches the crossings have one parity, whatever the direction of the ray.

use super::{Random, mixed, on_grid};
use welter_predicates::ccd::parity::{PatchParity, ray_bilinear_patch};

/// The faces of a cube whose corner `x + 2 y + 4 z` is the image of (x, y, z).
const FACES: [[usize; 4]; 6] =
    [[0, 2, 4, 6], [1, 3, 5, 7], [0, 1, 4, 5], [2, 3, 6, 7], [0, 1, 2, 3], [4, 5, 6, 7]];

/// Whether the origin is inside by parity; `None` if it is on the surface.
fn inside(origin: [f64; 3], direction: [f64; 3], corners: &[[f64; 3]; 8]) -> Option<bool> {
    let parities = FACES.map(|face| ray_bilinear_patch(origin, direction, face.map(|i| corners[i])));
    let on = parities.contains(&PatchParity::OnPatch);
    (!on).then(|| parities.iter().filter(|&&parity| parity == PatchParity::Odd).count() % 2 == 1)
}

/// Directions in general and in special position: through corners, edges and faces, along axes, and none.
fn directions(random: &mut Random, origin: [f64; 3], corners: &[[f64; 3]; 8]) -> Vec<[f64; 3]> {
    let towards = |points: &[usize]| -> [f64; 3] {
        std::array::from_fn(|k| points.iter().map(|&i| corners[i][k] - origin[k]).sum())
    };
    let mut directions = vec![[0.0; 3]];
    for k in 0..3 {
        directions.push(std::array::from_fn(|i| f64::from(u8::from(i == k))));
        directions.push(std::array::from_fn(|i| -f64::from(u8::from(i == k))));
    }
    directions.extend((0..8).map(|i| towards(&[i])));
    directions.extend(FACES.iter().map(|face| towards(face)));
    directions.extend(FACES.iter().map(|face| towards(&face[..2])));
    directions.extend((0..4).map(|_| std::array::from_fn(|_| random.uniform())));
    directions.retain(|direction| direction.iter().all(|x| x.is_finite()));
    directions
}

fn check(random: &mut Random, origin: [f64; 3], corners: &[[f64; 3]; 8]) -> Option<bool> {
    let expected = inside(origin, [0.0; 3], corners);
    for direction in directions(random, origin, corners) {
        assert_eq!(inside(origin, direction, corners), expected, "{origin:?} {direction:?} {corners:?}");
    }
    expected
}

#[test]
fn parity_does_not_depend_on_the_direction() {
    let mut random = Random(17);
    let mut counts = [0; 3];
    for round in 0..4_000 {
        let points: [[f64; 3]; 9] = match round % 8 {
            0 => random.points(Random::uniform),
            2 if round % 5 == 0 => mixed(&mut random),
            n => on_grid(&mut random, [1, 2, 4][n % 3]),
        };
        // Half of them are a cube whose corners are displaced, so that many origins are inside.
        let size = if round % 2 == 0 { 0.0 } else { 1.5 };
        let corners = std::array::from_fn(|i| {
            std::array::from_fn(|k| points[i][k] + if i >> k & 1 == 1 { size } else { -size })
        });
        match check(&mut random, points[8], &corners) {
            None => counts[0] += 1,
            Some(inside) => counts[1 + usize::from(inside)] += 1,
        }
    }
    println!("on, outside, inside: {counts:?}");
    assert!(counts.iter().all(|&count| count > 200), "{counts:?}");
}

#[test]
fn points_of_a_cube() {
    let corners = std::array::from_fn(|i| [0, 1, 2].map(|k| f64::from((i >> k & 1) as u8)));
    let mut random = Random(3);
    let quarter = |n: u32| f64::from(n) / 2.0 - 0.5;
    for i in 0..125 {
        let point = [quarter(i % 5), quarter(i / 5 % 5), quarter(i / 25)];
        let within = point.iter().all(|x| (0.0..=1.0).contains(x));
        let on = within && point.iter().any(|&x| x == 0.0 || x == 1.0);
        assert_eq!(check(&mut random, point, &corners), (!on).then_some(within));
    }
}
