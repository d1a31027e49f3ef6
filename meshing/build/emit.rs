//! The table as text of the language: the lists of all cases behind one another, and where each begins.

use std::fmt::Write as _;

use crate::cube::Case;

pub(crate) fn tables(cases: &[Case]) -> String {
    let mut text = String::new();
    table(&mut text, "TRIANGLES", "[u8; 3]", cases.iter().map(|case| case.triangles.as_slice()));
    table(&mut text, "TETRAHEDRA", "[u8; 4]", cases.iter().map(|case| case.tetrahedra.as_slice()));
    text
}

fn table<'a, T: std::fmt::Debug + 'a>(
    text: &mut String,
    name: &str,
    kind: &str,
    lists: impl Iterator<Item = &'a [T]>,
) {
    let mut starts = vec![0];
    let mut items = Vec::new();
    for list in lists {
        items.extend(list);
        starts.push(items.len());
    }
    writeln!(text, "static {name}_START: [u16; {}] = {starts:?};", starts.len()).expect("a string takes all");
    writeln!(text, "static {name}: [{kind}; {}] = {items:?};", items.len()).expect("a string takes all");
}
