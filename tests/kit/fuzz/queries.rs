//! The reader of collision queries on any bytes and on rows of hard fractions, against rational numbers.

use crate::entropy::Entropy;
use crate::exact::nearest_f64;
use rug::{Integer, Rational};
use std::io::{BufRead, BufReader};
use welter_tracking::queries::{Parameters, Queries, Query, ReadError};

/// The bytes as a file, and a file of fractions drawn from them.
pub fn read_queries(bytes: &[u8]) {
    file(bytes);
    file(drawn(&mut Entropy::new(bytes)).as_bytes());
}

/// Reads any bytes: no panic, the same however they arrive; what was read is what rational arithmetic reads.
fn file(bytes: &[u8]) {
    let exact = Parameters { rounded: false };
    let whole = read(bytes, exact);
    for capacity in [1, 7] {
        assert_eq!(
            read(BufReader::with_capacity(capacity, bytes), exact),
            whole,
            "{capacity} bytes at a time"
        );
    }
    let (queries, error, rounded) = read(bytes, Parameters { rounded: true });
    assert!(queries.starts_with(&whole.0), "rounding changes what needs no rounding");
    assert_eq!(whole.2, 0);
    if rounded == 0 {
        assert_eq!((&queries, &error), (&whole.0, &whole.1));
    }
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let rows: Vec<Vec<&str>> = text
        .split('\n')
        .filter(|line| !line.trim().is_empty())
        .map(|line| line.split(',').map(str::trim).collect())
        .collect();
    let mut inexact = 0;
    for (query, rows) in queries.iter().zip(rows.chunks(8)) {
        for (point, row) in query.t0.iter().chain(&query.t1).zip(rows) {
            for (&x, fraction) in point.iter().zip(row.chunks(2)) {
                let (expected, exactly) = nearest_f64(&rational(fraction));
                assert_eq!(x, expected, "{fraction:?}");
                inexact += u64::from(!exactly);
            }
            assert_eq!(query.truth, row.get(6).map(|&answer| answer == "1"));
        }
    }
    // Rows of a query that is not whole, or has a fault later, may have been rounded too.
    assert!(if error.is_none() { inexact == rounded } else { inexact <= rounded }, "{inexact} {rounded}");
}

/// What a reader gives: queries, the text of the error that ended them, the count of rounded coordinates.
fn read(input: impl BufRead, parameters: Parameters) -> (Vec<Query>, Option<String>, u64) {
    let mut reader = Queries::new(input, parameters);
    let (mut queries, mut error): (Vec<Query>, Option<ReadError>) = (Vec::new(), None);
    for item in reader.by_ref() {
        match item {
            Ok(query) => queries.push(query),
            Err(found) => assert!(error.replace(found).is_none(), "it goes on after an error"),
        }
    }
    let finite = |query: &Query| query.t0.iter().chain(&query.t1).flatten().all(|x| x.is_finite());
    assert!(queries.iter().all(finite));
    (queries, error.map(|error| error.to_string()), reader.rounded())
}

fn rational(fraction: &[&str]) -> Rational {
    let integer = |text: &str| text.parse::<Integer>().expect("the reader took it for an integer");
    Rational::from((integer(fraction[0]), integer(fraction[1])))
}

/// One query of fractions that are hard to round.
fn drawn(entropy: &mut Entropy<'_>) -> String {
    let answer = entropy.pick(&["", ",0", ",1"]);
    (0..8)
        .map(|_| [fraction(entropy), fraction(entropy), fraction(entropy)].join(",") + answer + "\n")
        .collect()
}

/// An `f64`, or the middle between it and the next, or a hair beside either; often not in lowest terms.
fn fraction(entropy: &mut Entropy<'_>) -> String {
    let bits = match entropy.below(5) {
        0 => entropy.word() >> entropy.below(64),
        1 => f64::MAX.to_bits() - u64::from(entropy.byte()),
        2 => f64::MIN_POSITIVE.to_bits() - 4 + u64::from(entropy.below(8)),
        3 => u64::from(entropy.below(4)),
        _ => 1f64.to_bits() + (u64::from(entropy.byte()) << 44),
    } & (u64::MAX >> 1);
    let of = |bits: u64| Rational::from_f64(f64::from_bits(bits));
    let mut x = of(bits).unwrap_or_default();
    if entropy.below(2) == 1 {
        let next = of(bits + 1).unwrap_or_else(|| Rational::from(Integer::from(1) << 1024));
        x = (x + next) / 2;
    }
    if entropy.below(3) == 0 {
        x += Rational::from((entropy.between(-1, 1), Integer::from(1) << 1200));
    }
    if entropy.below(2) == 1 {
        x = -x;
    }
    let (numerator, denominator) = x.into_numer_denom();
    let factor = Integer::from(entropy.between(1, 9));
    format!("{},{}", numerator * &factor, denominator * factor)
}
