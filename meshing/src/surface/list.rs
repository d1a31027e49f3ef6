//! Lists of culprits in messages: the count, and the first few by name.

use std::fmt::{self, Display, Write};

/// How many culprits a message names; the error value holds them all.
const NAMED: usize = 3;

/// The first few elements, and dots where there are more.
pub(crate) struct FirstFew<'a, T>(pub(crate) &'a [T]);

impl<T: Display> Display for FirstFew<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, element) in self.0.iter().take(NAMED).enumerate() {
            if i > 0 {
                f.write_str(", ")?;
            }
            write!(f, "{element}")?;
        }
        if self.0.len() > NAMED { f.write_str(", ...") } else { Ok(()) }
    }
}

/// Adds "3 triangles name a vertex twice: 4 (0, 0, 1), ..." to the parts of a message; nothing for an empty list.
pub(crate) fn describe<T: Display>(parts: &mut Vec<String>, culprits: &[T], [one, many]: [&str; 2]) {
    let count = culprits.len();
    if count == 0 {
        return;
    }
    let mut part = format!("{count} {}: ", if count == 1 { one } else { many });
    write!(part, "{}", FirstFew(culprits)).expect("writing to a String cannot fail");
    parts.push(part);
}
