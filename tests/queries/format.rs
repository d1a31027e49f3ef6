//! What a file of queries may look like, and what each fault in it is called.

use std::io::{self, BufReader, Read};
use std::path::Path;
use welter_tracking::queries::{LONGEST_LINE, Parameters, Queries, Query, ReadError};

/// Eight rows whose coordinates are all different; `tail` ends each.
fn rows(tail: &str) -> String {
    (0..8).map(|i| format!("{},1,{},2,{},4{tail}\n", i + 1, 2 * i + 1, 4 * i + 1)).collect()
}

fn read(text: impl AsRef<[u8]>) -> Result<Vec<Query>, ReadError> {
    Queries::new(text.as_ref(), Parameters::default()).collect()
}

#[track_caller]
fn fails(text: impl AsRef<[u8]>, message: &str) -> ReadError {
    let error = read(text).unwrap_err();
    assert_eq!(error.to_string(), message);
    if let Some(line) = error.line() {
        assert!(message.starts_with(&format!("line {line}")), "{message}");
    }
    error
}

#[test]
fn rows_become_vertices_in_order() {
    let text = rows(",1") + &rows(",0");
    let queries = read(&text).unwrap();
    assert_eq!(queries.len(), 2);
    for (query, (truth, line)) in queries.iter().zip([(true, 1), (false, 9)]) {
        assert_eq!((query.truth, query.line), (Some(truth), line));
        for (i, &point) in query.t0.iter().chain(&query.t1).enumerate() {
            let i = i as f64;
            assert_eq!(point, [i + 1.0, i + 0.5, i + 0.25]);
        }
    }
}

#[test]
fn the_answer_may_be_missing_from_all_rows_but_not_from_some() {
    let queries = read(rows("") + &rows("")).unwrap();
    assert!(queries.len() == 2 && queries.iter().all(|query| query.truth.is_none()));
    fails(rows("") + &rows(",1"), "line 9: 7 columns, expected 6 as on the first row");
    fails(rows(",1") + &rows(""), "line 9: 6 columns, expected 7 as on the first row");
}

#[test]
fn line_ends_blanks_and_a_byte_order_mark_change_nothing() {
    let plain = rows(",1");
    let expected = read(&plain).unwrap();
    let variants = [
        plain.trim_end().to_owned(),
        plain.replace('\n', "\r\n"),
        plain.replace(',', " ,\t"),
        plain.replace(",1,", ",+001,"),
        format!("\u{feff}{plain}"),
        format!("{plain}\r\n\n  \n\t"),
    ];
    for text in variants {
        assert_eq!(read(&text).unwrap(), expected, "{text:?}");
    }
    let shifted = read(format!("\n \n{plain}")).unwrap();
    assert_eq!(
        (shifted[0].t0, shifted[0].line),
        (expected[0].t0, 3),
        "blank lines at the beginning count as lines"
    );
}

#[test]
fn every_fault_has_its_error() {
    let good = rows(",1");
    let swap = |from: &str, to: &str| good.replacen(from, to, 1);
    fails("", "the file is empty, expected rows of 6 or 7 integers separated by commas");
    fails(" \r\n\n\t", "the file is empty, expected rows of 6 or 7 integers separated by commas");
    fails("1,1,1,1\n", "line 1: 4 columns, expected 6 or 7");
    fails(swap("2,1,3,2,5,4,1", "2,1,3,2,5,4,1,"), "line 2: 8 columns, expected 7 as on the first row");
    fails(swap("3,2", "3e0,2"), "line 2, column 3: expected an integer, found `3e0`");
    fails(swap("3,2", "3,- 2"), "line 2, column 4: expected an integer, found `- 2`");
    fails(swap("3,2", "\u{663},2"), "line 2, column 3: expected an integer, found `\u{663}`");
    fails(swap("3,2", "\u{1b}[31m,2"), "line 2, column 3: expected an integer, found `\\u{1b}[31m`");
    fails(swap("3,2", "3,-0"), "line 2, column 4: the denominator is zero");
    fails(swap("4,1\n", "4,true\n"), "line 1, column 7: expected 0 or 1, found `true`");
    fails(rows(",01"), "line 1, column 7: expected 0 or 1, found `01`");
    fails(
        rows(",1") + &rows(",0").replacen("13,4,0", "13,4,1", 1),
        "line 12, column 7: the query that begins on line 9 has both answers, 0 and 1",
    );
    fails(good.replacen('\n', "\n\n\n", 1), "line 2: the line is blank, and rows follow");
    fails(
        format!("{good}{}", good.lines().next().unwrap()),
        "line 9: the file ends here, after 1 of 8 rows of a query",
    );
    fails(
        good.lines().take(7).collect::<Vec<_>>().join("\n"),
        "line 7: the file ends here, after 7 of 8 rows of a query",
    );
    fails(b"1,1,\xe9", "line 1: byte 5 of the line is not UTF-8 text");
    fails([0x1f, 0x8b, 8, 0], "line 1: byte 2 of the line is not UTF-8 text");
    fails(swap("3,2", "3,7"), "line 2, column 3: 3/7 equals no f64, the nearest is 4.2857142857142855e-1");
}

#[test]
fn long_foreign_text_is_shortened() {
    let long = "x".repeat(1000);
    fails(
        rows("").replacen("3,2", &format!("{long},2"), 1),
        &format!("line 2, column 3: expected an integer, found `{}...`", "x".repeat(40)),
    );
}

#[test]
fn lines_have_a_greatest_length() {
    let longest = |bytes: usize| {
        let mut text = rows("");
        let first = text.find('\n').unwrap();
        text.insert_str(first, &" ".repeat(bytes - first - 1));
        text
    };
    assert_eq!(read(longest(LONGEST_LINE)).unwrap().len(), 1);
    let message = format!("line 1: the line is longer than {LONGEST_LINE} bytes");
    fails(longest(LONGEST_LINE + 1), &message);
    // Endless input without a line end is given up after one line's length.
    let endless = BufReader::new(io::repeat(b'1'));
    let mut queries = Queries::new(endless, Parameters::default());
    assert_eq!(queries.next().unwrap().unwrap_err().to_string(), message);
    assert!(queries.next().is_none());
}

#[test]
fn nothing_is_read_after_an_error() {
    let text = rows(",1") + "x\n" + &rows(",1");
    let mut queries = Queries::new(text.as_bytes(), Parameters::default());
    assert!(queries.next().unwrap().is_ok());
    assert!(queries.next().unwrap().is_err());
    assert!(queries.next().is_none() && queries.next().is_none());
}

#[test]
fn a_reader_that_fails_is_told_with_the_line() {
    struct Fails;
    impl Read for Fails {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::ErrorKind::TimedOut.into())
        }
    }
    let text = rows(",1");
    let input = BufReader::new(text.as_bytes().chain(Fails));
    let results: Vec<_> = Queries::new(input, Parameters::default()).collect();
    assert_eq!(results.len(), 2);
    assert!(results[0].is_ok());
    assert!(matches!(results[1], Err(ReadError::Io { line: 9, .. })), "{:?}", results[1]);
}

#[test]
fn bytes_and_rounded_coordinates_are_counted() {
    let text = rows("").replacen("3,2", "3,7", 1).replacen("8,1", "-8,3", 1) + "\n\n";
    let mut queries = Queries::new(text.as_bytes(), Parameters { rounded: true });
    let query = queries.next().unwrap().unwrap();
    assert_eq!((query.t0[1][1], query.t1[3][0]), (3.0 / 7.0, -8.0 / 3.0));
    assert!(queries.next().is_none());
    assert_eq!((queries.rounded(), queries.bytes_read()), (2, text.len() as u64));
}

#[test]
fn public_queries_are_read_exactly() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/ccd-queries"));
    if !root.is_dir() {
        println!("skipped: {} is not there", root.display());
        return;
    }
    let mut count = 0;
    for set in
        std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir())
    {
        for kind in ["edge-edge", "vertex-face"] {
            let bytes = std::fs::read(set.join(kind).join("data_0_0.csv")).unwrap();
            let lines = bytes.iter().filter(|&&byte| byte == b'\n').count();
            let queries = read(&bytes).unwrap();
            assert!(queries.iter().all(|query| query.truth.is_some()));
            assert_eq!(queries.len(), lines.div_ceil(8), "{}", set.display());
            count += queries.len();
        }
    }
    println!("{count} queries");
    assert!(count > 0);
}
