//! How often each stage settles a collision query, on fixed inputs: a filter that is right but weak, or a stage that nothing
//! reaches, fails here.

use welter_predicates::ccd::{Stage, staged};

type Step = [[[f64; 3]; 4]; 2];

/// Queries of each kind.
const COUNT: usize = 10_000;

/// The shares, in percent, that each stage settles: of a vertex and a face, of two edges.
fn shares(mut draw: impl FnMut(&mut dyn FnMut(u64) -> u64) -> Step) -> [[f64; Stage::ALL.len()]; 2] {
    let mut state = 7u64;
    let mut next = |range: u64| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) % range
    };
    let mut counts = [[0.0; Stage::ALL.len()]; 2];
    for _ in 0..COUNT {
        let [t0, t1] = draw(&mut next);
        counts[0][staged::vertex_face(t0, t1).1 as usize] += 100.0 / COUNT as f64;
        counts[1][staged::edge_edge(t0, t1).1 as usize] += 100.0 / COUNT as f64;
    }
    println!("{counts:.2?}");
    counts
}

fn each(mut draw: impl FnMut() -> f64) -> Step {
    std::array::from_fn(|_| std::array::from_fn(|_| std::array::from_fn(|_| draw())))
}

#[test]
fn uniform_queries_never_leave_rounded_arithmetic() {
    for shares in shares(|next| each(|| next(1 << 30) as f64 / f64::from(1 << 29) - 1.0)) {
        assert!(shares[Stage::Boxes as usize] + shares[Stage::Direction as usize] > 35.0);
        assert!(shares[Stage::Subdivision as usize] > 30.0);
        assert!(shares[Stage::DoubleDouble as usize] < 0.1);
        assert_eq!(shares[Stage::Exact as usize] + shares[Stage::Ends as usize], 0.0);
    }
}

#[test]
fn few_queries_on_grids_need_integers() {
    for shares in shares(|next| each(|| next(9) as f64 - 4.0)) {
        assert!(shares[Stage::Exact as usize] > 0.1 && shares[Stage::Exact as usize] < 1.0);
        assert!(shares[Stage::Ends as usize] > 0.5);
    }
}

#[test]
fn ulps_beside_a_grid_are_for_double_double_numbers() {
    let ulp = |next: &mut dyn FnMut(u64) -> u64| {
        (next(9) as f64 - 4.0) * (1.0 + (next(3) as f64 - 1.0) * f64::EPSILON)
    };
    for shares in shares(|next| each(|| ulp(next))) {
        assert!(shares[Stage::DoubleDouble as usize] > 0.5);
        assert!(shares[Stage::Exact as usize] < 0.5);
    }
}

#[test]
fn motion_in_a_coordinate_plane_seldom_needs_integers() {
    let flat = |mut step: Step| {
        step.as_flattened_mut().iter_mut().for_each(|p| p[1] = 0.75);
        step
    };
    // Where an edge touches the origin for less than a thousandth of the step.
    for shares in shares(|next| flat(each(|| next(1 << 30) as f64))) {
        assert!(shares[Stage::Exact as usize] < 0.1);
    }
    for shares in shares(|next| flat(each(|| next(9) as f64))) {
        assert!(shares[Stage::Exact as usize] < 10.0);
    }
}
