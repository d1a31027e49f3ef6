//! Random solids that overlap themselves: [`body`], [`tube_body`], and what they are made of.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::{Random, Solid};

/// A solid, with a length to measure cells by.
#[derive(Clone, Debug)]
pub struct Body {
    /// What it is, for messages.
    pub name: String,
    /// The solid.
    pub solid: Solid,
    /// About half its thickness.
    pub radius: f64,
    /// How long the way along it is, if it closes up.
    pub round: Option<f64>,
}

/// The body of a seed: tubes, open and closed, twisted bands, rolled plates with holes, bent blocks with chambers, and several of
/// these at once.
#[must_use]
pub fn body(seed: u64) -> Body {
    let random = &mut Random::new(seed);
    let first = outward(one(random));
    if random.below(4) != 0 {
        return first;
    }
    let mut second = outward(one(random));
    let (scale, shift) =
        (first.radius / second.radius * random.between(0.7, 1.4), random.point() * first.radius);
    let middle = |solid: &Solid| solid.positions.iter().sum::<DVec3>() / solid.positions.len() as f64;
    let (from, to) = (middle(&second.solid), middle(&first.solid));
    second.solid.positions.iter_mut().for_each(|p| *p = (*p - from) * scale + to + shift);
    Body {
        name: format!("{} and {}", first.name, second.name),
        solid: Solid::together(&[first.solid, second.solid]),
        radius: first.radius * scale.min(1.0),
        round: first.round.or(second.round),
    }
}

/// The tube of a seed, open, closed or closed after half a turn, that passes through itself somewhere. Of seven out of eight no tetrahedron
/// is inside out.
#[must_use]
pub fn tube_body(seed: u64) -> Body {
    let random = &mut Random::new(seed);
    let (closed, any) = (random.below(2) == 0, random.below(8) == 0);
    loop {
        let body = outward(tube(random, closed));
        if passes_through_itself(&body) && (any || body.solid.inverted() == 0) {
            return body;
        }
    }
}

/// Whether the middles of two sections are nearer than three quarters of the thickness, though farther apart along the tube than a half
/// circle of half its thickness.
fn passes_through_itself(body: &Body) -> bool {
    let solid = &body.solid;
    let count = solid.along.iter().copied().fold(0.0, f64::max) as usize + 1;
    let mut sums = vec![(DVec3::ZERO, 0.0); count];
    for (&p, &along) in solid.positions.iter().zip(&solid.along) {
        let (sum, vertices) = &mut sums[along as usize];
        (*sum, *vertices) = (*sum + p, *vertices + 1.0);
    }
    let middles: Vec<DVec3> = sums.into_iter().map(|(sum, vertices)| sum / vertices).collect();
    let mut way = vec![0.0];
    way.extend(middles.windows(2).scan(0.0, |way, pair| {
        *way += pair[0].distance(pair[1]);
        Some(*way)
    }));
    let round = body.round.map(|_| way[count - 1] + middles[0].distance(middles[count - 1]));
    (0..count).any(|a| {
        (0..a).any(|b| {
            let on = way[a] - way[b];
            let apart = round.map_or(on, |round| on.min(round - on));
            apart > std::f64::consts::PI * body.radius && middles[a].distance(middles[b]) < 1.5 * body.radius
        })
    })
}

/// Its mirror image if it is inside out as a whole.
fn outward(mut body: Body) -> Body {
    if 2 * body.solid.inverted() > body.solid.tets.len() {
        body.solid.positions.iter_mut().for_each(|p| p.z = -p.z);
    }
    body
}

fn one(random: &mut Random) -> Body {
    match random.below(6) {
        0 | 1 => tube(random, false),
        2 | 3 => tube(random, true),
        4 => roll(random),
        _ => bent_block(random),
    }
}

/// Points of a curve, and how tightly it bends at most.
fn curve(random: &mut Random, closed: bool, count: usize) -> (Vec<DVec3>, f64) {
    let flat = DVec3::new(1.0, 1.0, random.between(0.03, 1.0));
    let points: Vec<DVec3> = if closed {
        let waves: Vec<[DVec3; 2]> =
            (1..4).map(|k| [0, 1].map(|_| random.point() * flat / f64::from(k * k))).collect();
        let at = |t: f64| {
            let wave = |(k, [a, b]): (f64, &[DVec3; 2])| *a * libm::cos(k * t) + *b * libm::sin(k * t);
            waves.iter().zip(1..).map(|(ab, k)| wave((f64::from(k), ab))).sum::<DVec3>()
        };
        (0..count).map(|n| at(TAU * n as f64 / count as f64)).collect()
    } else {
        // A heading that turns about a slowly changing axis.
        let (mut at, mut heading) = (DVec3::ZERO, DVec3::X);
        let (turn, wobble, phase) = (random.between(1.0, 4.0), random.point(), random.between(0.0, TAU));
        let tilt = random.between(0.0, 0.5);
        (0..count)
            .map(|n| {
                let t = n as f64 / count as f64;
                let axis = DVec3::Z + wobble * tilt * libm::sin(TAU * t + phase);
                heading = (heading + axis.cross(heading) * (TAU * turn / count as f64)).normalize();
                heading.z *= 1.0 - 0.2 * (1.0 - flat.z);
                at += heading;
                at
            })
            .collect()
    };
    let bend = |n: usize| {
        let [a, b, c] = [0, 1, 2].map(|k| points[(n + k) % count]);
        2.0 * (b - a).cross(c - b).length() / ((b - a).length() * (c - b).length() * (c - a).length())
    };
    let last = if closed { count } else { count - 2 };
    let most = (0..last).map(bend).fold(0.0, f64::max);
    (points, most)
}

/// Frames that turn least along a curve; on a closed one, the turn that is left over is spread over it.
fn frames(points: &[DVec3], closed: bool, turns: f64) -> Vec<[DVec3; 2]> {
    let n = points.len();
    let tangent = |k: usize| {
        let (a, b) = if closed { ((k + n - 1) % n, (k + 1) % n) } else { (k.max(1) - 1, (k + 1).min(n - 1)) };
        (points[b] - points[a]).normalize()
    };
    let across = |u: DVec3, t: DVec3| (u - t * u.dot(t)).normalize();
    let mut u = across(tangent(0).any_orthonormal_vector(), tangent(0));
    let first = u;
    let mut list = vec![u];
    for k in 1..n {
        u = across(u, tangent(k));
        list.push(u);
    }
    let mut angle = turns * TAU;
    if closed {
        let (back, t) = (across(u, tangent(0)), tangent(0));
        angle -= libm::atan2(first.cross(back).dot(t), first.dot(back));
    }
    list.iter()
        .enumerate()
        .map(|(k, &u)| {
            let (t, turn) = (tangent(k), angle * k as f64 / n as f64);
            let v = t.cross(u);
            let (c, s) = (libm::cos(turn), libm::sin(turn));
            [u * c + v * s, v * c - u * s]
        })
        .collect()
}

/// A disc, or a bar with rounded edges, along a curve.
fn tube(random: &mut Random, closed: bool) -> Body {
    let sections = 24 + random.below(40) as usize;
    let (points, bend) = curve(random, closed, sections);
    // Beyond 1 the inner side of the bend is inside out.
    let tightness = if random.below(10) == 0 { random.between(0.9, 1.3) } else { random.between(0.2, 0.8) };
    let radius = tightness / bend;
    let divisions = 2 + random.below(2) as i32;
    let half_turn = closed && random.below(3) == 0;
    let (round, flat) = (random.unit(), random.between(0.4, 1.0));
    let frames = frames(&points, closed, if half_turn { 0.5 } else { 0.0 });
    let n = sections as i32;
    let place = |[i, j, k]: [i32; 3]| {
        let [u, v] = [j, k].map(|x| 2.0 * f64::from(x) / f64::from(divisions) - 1.0);
        let disc = DVec2::new(u * (1.0 - v * v / 2.0).sqrt(), v * (1.0 - u * u / 2.0).sqrt());
        let at = DVec2::new(u, v).lerp(disc, round) * DVec2::new(1.0, flat) * radius;
        let [right, up] = frames[i as usize];
        (points[i as usize] + right * at.x + up * at.y, f64::from(i))
    };
    let same = |[i, j, k]: [i32; 3]| match () {
        () if !closed || i < n => [i, j, k],
        () if half_turn => [i - n, divisions - j, divisions - k],
        () => [i - n, j, k],
    };
    let mut cubes = Vec::new();
    for i in 0..if closed { n } else { n - 1 } {
        for j in 0..divisions {
            for k in 0..divisions {
                cubes.push([i, j, k]);
            }
        }
    }
    let solid = Solid::of_cubes(&cubes, same, place);
    let name = format!(
        "tube, {}, tightness {tightness:.2}",
        ["open", "closed", "half a turn"][usize::from(closed) + usize::from(half_turn)]
    );
    Body { name, solid, radius: radius * flat, round: closed.then_some(f64::from(n)) }
}

/// A plate with holes, rolled up so that it lies over itself.
fn roll(random: &mut Random) -> Body {
    let (length, width) = (24 + random.below(30) as i32, 3 + random.below(5) as i32);
    let mut cubes = Vec::new();
    for i in 0..length {
        for j in 0..width {
            let hole = i % 4 == 2 && j % 2 == 1 && j < width - 1 && random.below(2) == 0;
            if !hole {
                cubes.push([i, j, 0]);
            }
        }
    }
    let (turns, inner, drift) =
        (random.between(1.1, 2.6), random.between(1.0, 2.0), random.between(-0.3, 0.6));
    let (thick, pitch) = (random.between(0.3, 0.8), random.between(-1.0, 1.0));
    let place = |[i, j, k]: [i32; 3]| {
        let t = f64::from(i) / f64::from(length);
        let radius = inner + drift * t + thick * f64::from(k);
        let angle = TAU * turns * t;
        (
            DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), 0.5 * f64::from(j) + pitch * t),
            f64::from(i),
        )
    };
    let solid = Solid::of_cubes(&cubes, |at| at, place);
    Body { name: "roll".into(), solid, radius: thick / 2.0, round: None }
}

/// A block with a chamber, or a hole through it, bent round into itself.
fn bent_block(random: &mut Random) -> Body {
    let (length, chamber) = (10 + random.below(14) as i32, random.below(3));
    let mut cubes = Vec::new();
    for i in 0..length {
        for j in 0..3 {
            for k in 0..3 {
                let middle = j == 1 && k == 1;
                let left_out = match chamber {
                    0 => middle && i > 0 && i < length - 1,
                    1 => middle,
                    _ => false,
                };
                if !left_out {
                    cubes.push([i, j, k]);
                }
            }
        }
    }
    let (turns, radius, pitch) =
        (random.between(0.6, 1.8), random.between(2.2, 4.0), random.between(-2.0, 2.0));
    let place = |[i, j, k]: [i32; 3]| {
        let t = f64::from(i) / f64::from(length);
        let (angle, r) = (TAU * turns * t, radius + f64::from(k) - 1.5);
        (DVec3::new(r * libm::cos(angle), r * libm::sin(angle), f64::from(j) - 1.5 + pitch * t), f64::from(i))
    };
    let solid = Solid::of_cubes(&cubes, |at| at, place);
    Body { name: format!("bent block, kind {chamber}"), solid, radius: 0.5, round: None }
}
