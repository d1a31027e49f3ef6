//! Eigenvalues and eigenvectors of random and special matrices.

use glam::DVec3;
use welter_kit::mesher::Random;
use welter_tracking::quadric::{Eigen, SymmetricMatrix};

/// Twice the rounding of one.
const U: f64 = f64::EPSILON;

fn norm(matrix: &SymmetricMatrix) -> f64 {
    (matrix.diagonal.length_squared() + 2.0 * matrix.beside.length_squared()).sqrt()
}

fn of_values(values: [f64; 3], vectors: [DVec3; 3]) -> SymmetricMatrix {
    let mut matrix = SymmetricMatrix::ZERO;
    for (value, vector) in values.into_iter().zip(vectors) {
        matrix.add_square(vector, value);
    }
    matrix
}

fn random_basis(random: &mut Random) -> [DVec3; 3] {
    let a = random.point().normalize();
    let b = a.cross(random.point()).normalize();
    [a, b, a.cross(b)]
}

/// The largest residual over the norm and the largest error of a product of vectors, in roundings.
fn check(matrix: &SymmetricMatrix, found: &Eigen) -> [f64; 2] {
    let size = norm(matrix);
    let mut largest = [0.0_f64; 2];
    for (i, (&value, &vector)) in found.values.iter().zip(&found.vectors).enumerate() {
        let residual = (matrix.times(vector) - value * vector).length();
        largest[0] = largest[0].max(residual / size / U);
        for (j, &other) in found.vectors.iter().enumerate() {
            let expected = if i == j { 1.0 } else { 0.0 };
            largest[1] = largest[1].max((vector.dot(other) - expected).abs() / U);
        }
    }
    assert!(found.values[0] >= found.values[1] && found.values[1] >= found.values[2]);
    largest
}

#[test]
fn vectors_are_orthonormal_and_stretched_by_the_values() {
    let mut random = Random::new(31);
    let mut largest = [0.0_f64; 2];
    for _ in 0..50_000 {
        let (diagonal, beside) = (random.point(), random.point());
        let matrix = SymmetricMatrix { diagonal, beside };
        let found = check(&matrix, &matrix.eigen());
        largest = [largest[0].max(found[0]), largest[1].max(found[1])];
    }
    println!("eigenvectors: residuals and products within {largest:.1?} roundings");
    assert!(largest[0] < 16.0 && largest[1] < 16.0, "{largest:?}");
}

#[test]
fn values_are_found_whatever_their_ratios() {
    let mut random = Random::new(32);
    let ladders = [
        [1.0, 1.0, 1.0],
        [1.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0 - 1e-14, 1.0 - 2e-14],
        [1.0, 1e-8, 1e-16],
        [1.0, 1e-15, -1e-15],
        [3.0, -3.0, 0.0],
        [1e-300, 1e-305, 1e-320],
        [1e300, 1e299, -1e300],
    ];
    for mut values in ladders {
        for _ in 0..500 {
            let matrix = of_values(values, random_basis(&mut random));
            let found = matrix.eigen();
            values.sort_by(|a, b| b.total_cmp(a));
            let size = values.iter().fold(0.0, |size: f64, value| size.max(value.abs()));
            for (found, expected) in found.values.iter().zip(values) {
                assert!((found - expected).abs() <= 16.0 * U * size, "{values:?}: {found:e}");
            }
        }
    }
}

#[test]
fn a_power_of_two_multiplies_the_values_and_nothing_else() {
    let mut random = Random::new(33);
    for k in [-900, -300, -1, 1, 5, 400, 900] {
        for _ in 0..200 {
            let (diagonal, beside) = (random.point(), random.point());
            let one = SymmetricMatrix { diagonal, beside }.eigen();
            let factor = 2f64.powi(k);
            let other = SymmetricMatrix { diagonal: factor * diagonal, beside: factor * beside }.eigen();
            assert_eq!(other.vectors, one.vectors);
            assert_eq!(other.values, one.values.map(|value| factor * value));
        }
    }
}
