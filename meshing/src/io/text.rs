//! Numbers and names as text that reads back the same.

use super::Dropped;
use crate::surface::Group;
use std::borrow::Cow;
use std::fmt;

/// The shortest decimal that is nearest to no other f64, with an exponent where the plain form would be long.
pub(crate) struct Decimal(pub(crate) f64);

impl fmt::Display for Decimal {
    #[inline]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        // 1e-5 and 1e16 are where plain decimals become longer than the form with an exponent.
        if size.is_nan() || size == 0.0 || size.is_infinite() || (1e-5..1e16).contains(&size) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

/// A group name as one line of text that reads back as itself where it can.
pub(super) fn one_line(name: &str) -> Cow<'_, str> {
    let trimmed = name.trim_ascii().trim_end_matches('\\').trim_ascii_end(); // OBJ goes on after a last `\`
    if trimmed.contains(['\n', '\r']) {
        Cow::Owned(trimmed.replace(['\n', '\r'], " "))
    } else {
        Cow::Borrowed(trimmed)
    }
}

/// What a text format loses of groups: those without a name, and names that are not one line.
pub(super) fn lost_names(groups: &[Group]) -> Vec<Dropped> {
    let nameless = groups.iter().filter(|g| one_line(&g.name).is_empty()).count();
    let changed = groups.iter().filter(|g| one_line(&g.name) != g.name.as_str()).count();
    let changed =
        changed - groups.iter().filter(|g| !g.name.is_empty() && one_line(&g.name).is_empty()).count();
    let mut lost = Vec::new();
    if nameless > 0 {
        lost.push(Dropped::Groups { count: nameless });
    }
    if changed > 0 {
        lost.push(Dropped::GroupNames { count: changed });
    }
    lost
}
