//! Batches of collision queries against single queries.

use welter_predicates::ccd::batch::{self, Columns, LengthMismatch};
use welter_predicates::ccd::{edge_edge, vertex_face};

type Step = [[[f64; 3]; 4]; 2];

/// A column for each coordinate: time, point, coordinate.
fn columns(steps: &[Step]) -> [[[Vec<f64>; 3]; 4]; 2] {
    std::array::from_fn(|t| {
        std::array::from_fn(|p| {
            std::array::from_fn(|k| steps.iter().map(|step| step[t][p][k]).collect::<Vec<f64>>())
        })
    })
}

fn borrowed(columns: &[[[Vec<f64>; 3]; 4]; 2]) -> [[[&[f64]; 3]; 4]; 2] {
    std::array::from_fn(|t| std::array::from_fn(|p| std::array::from_fn(|k| &columns[t][p][k][..])))
}

/// Steps of every kind: small grids, uniform, one that is not finite.
fn steps(count: usize) -> Vec<Step> {
    let mut state = 5u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        state >> 33
    };
    (0..count)
        .map(|number| {
            let mut coordinate = || match number % 4 {
                0 => (next() % 5) as f64 - 2.0,
                1 => next() as f64 / 2f64.powi(30) - 1.0,
                2 => (next() % 9) as f64 * 2f64.powi(600),
                _ => next() as f64 / 2f64.powi(30) + (number % 5) as f64,
            };
            let mut step: Step =
                std::array::from_fn(|_| std::array::from_fn(|_| std::array::from_fn(|_| coordinate())));
            if number % 97 == 96 {
                step[number % 2][number % 4][number % 3] = f64::NAN;
            }
            step
        })
        .collect()
}

#[test]
fn batches_answer_as_single_queries_do() {
    // Around the size of a block, and far above.
    for count in [0, 1, 7, 15, 16, 17, 31, 32, 33, 5000] {
        let steps = steps(count);
        let owned = columns(&steps);
        let queries = Columns::new(borrowed(&owned)).unwrap();
        assert_eq!((queries.len(), queries.is_empty()), (count, count == 0));
        let mut answers = vec![true; count];
        batch::vertex_face(&queries, &mut answers).unwrap();
        let single: Vec<bool> = steps.iter().map(|&[t0, t1]| vertex_face(t0, t1)).collect();
        assert_eq!(answers, single);
        let contacts = single.iter().filter(|&&contact| contact).count();
        assert!(count < 5000 || (contacts > 200 && contacts < 4800), "{contacts}");
        batch::edge_edge(&queries, &mut answers).unwrap();
        assert_eq!(answers, steps.iter().map(|&[t0, t1]| edge_edge(t0, t1)).collect::<Vec<bool>>());
    }
}

#[test]
fn lengths_that_differ_are_named() {
    let steps = steps(20);
    let mut owned = columns(&steps);
    let queries = Columns::new(borrowed(&owned)).unwrap();
    let mut answers = [false; 19];
    assert_eq!(batch::vertex_face(&queries, &mut answers), Err(LengthMismatch { expected: 20, found: 19 }));
    assert_eq!(batch::edge_edge(&queries, &mut answers), Err(LengthMismatch { expected: 20, found: 19 }));
    owned[1][2][1].pop();
    let error = Columns::new(borrowed(&owned)).unwrap_err();
    assert_eq!(error, LengthMismatch { expected: 20, found: 19 });
    assert_eq!(error.to_string(), "a column of 19 entries beside one of 20");
}
