//! Names of physical groups: the section `PhysicalNames`, which is text also where numbers are binary.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::io::{self, Read, Write};

use super::PHYSICAL;
use super::entities::LARGEST;
use super::input::Input;
use super::output::Output;
use crate::io::error::{ReadError, shown};
use crate::io::volume_builder::VolumeBuilder;
use crate::io::{CellGroup, Dropped, WriteError, tokens};

/// The longest name in bytes that Gmsh's description of the format allows.
const LONGEST: usize = 127;

/// The names as the format can hold them.
pub(super) struct Names<'a> {
    names: Vec<(&'a CellGroup, Cow<'a, str>)>,
    changed: usize,
    lost: usize,
}

impl<'a> Names<'a> {
    /// The names of the groups whose tags are in the field of a name.
    pub(super) fn new(groups: &'a [CellGroup], tags: Option<&str>) -> Result<Self, WriteError> {
        let is_written =
            |group: &&CellGroup| tags == Some(&group.field) && group.tag != 0 && !group.name.is_empty();
        for (number, group) in groups.iter().enumerate().filter(|(_, group)| is_written(group)) {
            let tag = i64::from(group.tag);
            if !(1..=LARGEST).contains(&tag) {
                return Err(WriteError::Tag { place: "group", number, tag, limit: LARGEST });
            }
        }
        let written: Vec<&CellGroup> = groups.iter().filter(is_written).collect();
        let fits = |group: &&&CellGroup| group.name.len() <= LONGEST && !group.name.contains(is_foreign);
        let mut used: BTreeSet<(usize, String)> =
            written.iter().filter(fits).map(|group| (group.dimension, group.name.clone())).collect();
        let (mut names, mut changed) = (Vec::new(), 0);
        for group in &written {
            if fits(&group) {
                names.push((*group, Cow::Borrowed(&*group.name)));
                continue;
            }
            let name = replacement(group, |name| used.contains(&(group.dimension, name.to_owned())));
            used.insert((group.dimension, name.clone()));
            names.push((*group, Cow::Owned(name)));
            changed += 1;
        }
        Ok(Self { lost: groups.len() - names.len(), names, changed })
    }

    /// What of the names is not in the file, or not as it was.
    pub(super) fn dropped(&self) -> impl Iterator<Item = Dropped> {
        let changed = (self.changed > 0).then_some(Dropped::GroupNames { count: self.changed });
        let lost = (self.lost > 0).then_some(Dropped::NamesOfTags { count: self.lost });
        changed.into_iter().chain(lost)
    }

    pub(super) fn write<W: Write>(&self, out: &mut Output<'_, W>) -> io::Result<()> {
        if self.names.is_empty() {
            return Ok(());
        }
        out.line("$PhysicalNames")?;
        out.line(&self.names.len().to_string())?;
        for (CellGroup { dimension, tag, .. }, name) in &self.names {
            out.line(&format!("{dimension} {tag} \"{name}\""))?;
        }
        out.line("$EndPhysicalNames")
    }
}

/// Whether a name cannot have a character: the end of a name, or that of a line.
fn is_foreign(c: char) -> bool {
    c == '"' || c.is_control()
}

/// A name like that of the group which the format can hold, and which no other group has.
fn replacement(group: &CellGroup, is_taken: impl Fn(&str) -> bool) -> String {
    let likes = |c: char| match c {
        '"' => '\'',
        c if c.is_control() => ' ',
        c => c,
    };
    let like: String = group.name.chars().map(likes).collect();
    let cut = |length: usize| {
        let mut end = length.min(like.len());
        while !like.is_char_boundary(end) {
            end -= 1;
        }
        &like[..end]
    };
    let mut name = cut(LONGEST).to_owned();
    let mut suffix = String::new();
    while is_taken(&name) {
        suffix = format!("{suffix}~{}", group.tag);
        name = format!("{}{suffix}", cut(LONGEST.saturating_sub(suffix.len())));
    }
    name
}

/// Reads the section. Names of points and curves are passed over, and names that stand for no cells: of tags below 1.
pub(super) fn read<R: Read>(input: &mut Input<R>, builder: &mut VolumeBuilder) -> Result<(), ReadError> {
    let count = input.text_count(|| "the number of names of physical groups".to_owned())?;
    let mut known = BTreeSet::new();
    for row in 1..=count {
        let expected = |what: &str| format!("{what} of name {row} of the {count} declared");
        let dimension = input.words().count(|| expected("the dimension"))?;
        let tag = input.words().integer(|| expected("the physical tag"))?;
        let at = input.line_place();
        let rest = input.words().take_rest();
        let quoted = rest.iter().position(|&b| b == b'"').zip(rest.iter().rposition(|&b| b == b'"'));
        let Some((begin, end)) = quoted.filter(|(begin, end)| begin < end) else {
            let found = shown(rest);
            return Err(ReadError::Unexpected { at, expected: expected("the quoted text"), found });
        };
        let name = tokens::name(&rest[begin + 1..end]);
        match (dimension, i32::try_from(tag)) {
            (2 | 3, Ok(1..)) if !known.insert((dimension, tag)) => {
                builder.ignore("further names of a tag", at)
            }
            (2 | 3, Ok(tag @ 1..)) => {
                let (field, dimension) = (PHYSICAL.to_owned(), dimension as usize);
                builder.data.groups.push(CellGroup { name, field, dimension, tag });
            }
            (0 | 1, _) => builder.ignore("names of points and curves", at),
            (2 | 3, _) => builder.ignore("names of tags that cells cannot have", at),
            _ => {
                let expected = expected("the dimension, from 0 to 3,");
                return Err(ReadError::Unexpected { at, expected, found: dimension.to_string() });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_the_format_cannot_hold_are_changed_and_stay_apart() {
        let group =
            |name: &str, tag| CellGroup { name: name.to_owned(), field: "a".to_owned(), dimension: 2, tag };
        let long = "é".repeat(100);
        let groups = [
            group("a \"b\"", 1),
            group("a 'b'", 2),
            group("a\n'b'", 3),
            group(&long, 4),
            group(&format!("{long}!"), 5),
            group("", 6),
            group("none", 0),
            CellGroup { dimension: 3, ..group("a\t'b'", 7) },
        ];
        let names = Names::new(&groups, Some("a")).unwrap();
        let written: Vec<&str> = names.names.iter().map(|(_, name)| &**name).collect();
        let expected =
            ["a 'b'~1", "a 'b'", "a 'b'~3", &"é".repeat(63), &format!("{}~5", "é".repeat(62)), "a 'b'"];
        assert_eq!(written, expected);
        assert!(written.iter().all(|name| name.len() <= LONGEST));
        let dropped: Vec<_> = names.dropped().collect();
        assert_eq!(dropped, [Dropped::GroupNames { count: 5 }, Dropped::NamesOfTags { count: 2 }]);
        let none = Names::new(&groups, None).unwrap();
        assert_eq!(none.dropped().collect::<Vec<_>>(), [Dropped::NamesOfTags { count: 8 }]);
        let error = Names::new(&[group("x", i32::MAX)], Some("a")).err().unwrap().to_string();
        assert_eq!(error, "group 0 has the tag 2147483647, beyond 0 to 2147483646");
    }
}
