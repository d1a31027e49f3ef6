//! Determinants by Laplace expansion.

use rug::Integer;

/// The determinant of a square matrix given by its rows, expanded along the first row.
///
/// `n!` products: meant for the five rows of the predicates.
#[must_use]
pub fn determinant(rows: &[Vec<Integer>]) -> Integer {
    let Some((first, below)) = rows.split_first() else { return Integer::from(1) };
    assert_eq!(first.len(), rows.len(), "a determinant needs a square matrix");
    let mut sum = Integer::new();
    for (column, entry) in first.iter().enumerate() {
        if entry.is_zero() {
            continue;
        }
        let without_column = |row: &Vec<Integer>| {
            row.iter().enumerate().filter(|&(j, _)| j != column).map(|(_, c)| c.clone()).collect()
        };
        let minor: Vec<Vec<Integer>> = below.iter().map(without_column).collect();
        let term = determinant(&minor) * entry;
        if column % 2 == 0 {
            sum += term;
        } else {
            sum -= term;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(rows: &[&[i32]]) -> Integer {
        let rows: Vec<Vec<Integer>> =
            rows.iter().map(|row| row.iter().map(|&c| Integer::from(c)).collect()).collect();
        determinant(&rows)
    }

    #[test]
    fn known_determinants() {
        assert_eq!(of(&[]), 1);
        assert_eq!(of(&[&[3, 1], &[4, 2]]), 2);
        assert_eq!(of(&[&[0, 0, 2], &[0, 3, 0], &[5, 0, 0]]), -30);
        // Vandermonde on 1, 2, 3, 5: the product of all differences.
        assert_eq!(of(&[&[1, 1, 1, 1], &[1, 2, 4, 8], &[1, 3, 9, 27], &[1, 5, 25, 125]]), 2 * 4 * 3 * 2);
    }
}
