//! Reads STL text word by word: any white space, any case, any number of solids. A solid with a name is a group.

use super::super::error::{Place, ReadError};
use super::super::source::Source;
use super::super::tokens::{self, Tokens};
use super::read::Facets;
use glam::DVec3;
use std::io::Read;

pub(super) fn read<R: Read>(source: &mut Source<R>, facets: &mut Facets) -> Result<(), ReadError> {
    let mut words = Words { source, line: Vec::new(), from: 0, to: 0 };
    while words.advance()? {
        if !words.is("solid") {
            return Err(words.wrong("`solid`"));
        }
        facets.builder.begin_group(words.name());
        while words.another_facet()? {
            read_facet(&mut words, facets)?;
        }
        facets.builder.end_group();
        words.end_of_solid()?;
    }
    Ok(())
}

/// From after `facet` to `endfacet`.
fn read_facet<R: Read>(words: &mut Words<'_, R>, facets: &mut Facets) -> Result<(), ReadError> {
    let at = words.place();
    words.expect("normal")?;
    for _ in 0..3 {
        words.number("a facet normal")?;
    }
    words.expect("outer")?;
    words.expect("loop")?;
    let mut corners = [DVec3::ZERO; 3];
    for corner in &mut corners {
        words.expect("vertex")?;
        let mut coordinate = || words.number("a vertex coordinate");
        *corner = DVec3::new(coordinate()?, coordinate()?, coordinate()?);
    }
    words.expect("endloop")?;
    words.expect("endfacet")?;
    facets.facet(corners, at)
}

/// Words over line ends.
struct Words<'s, R> {
    source: &'s mut Source<R>,
    line: Vec<u8>,
    /// The word in hand is `line[from..to]`.
    from: usize,
    to: usize,
}

impl<R: Read> Words<'_, R> {
    fn place(&self) -> Place {
        self.source.line()
    }

    fn word(&self) -> &[u8] {
        &self.line[self.from..self.to]
    }

    /// Takes the next word in hand; `false` at the end of the file.
    #[inline]
    fn advance(&mut self) -> Result<bool, ReadError> {
        loop {
            let mut tokens = Tokens::new(&self.line[self.to..]);
            if let Some(word) = tokens.next() {
                self.to = self.line.len() - tokens.left();
                self.from = self.to - word.len();
                return Ok(true);
            }
            let Some((line, _)) = self.source.next_filled_line(None)? else { return Ok(false) };
            self.line.clear();
            self.line.extend_from_slice(line);
            self.to = 0;
        }
    }

    fn is(&self, keyword: &str) -> bool {
        self.word().eq_ignore_ascii_case(keyword.as_bytes())
    }

    fn wrong(&self, expected: &str) -> ReadError {
        ReadError::unexpected(self.place(), expected, self.word())
    }

    /// Takes the next word, which must be there.
    #[inline]
    fn require(&mut self, expected: &str) -> Result<(), ReadError> {
        if self.advance()? {
            return Ok(());
        }
        Err(ReadError::Truncated { at: self.place(), expected: expected.to_owned() })
    }

    #[inline]
    fn expect(&mut self, keyword: &str) -> Result<(), ReadError> {
        self.require(keyword)?;
        if self.is(keyword) { Ok(()) } else { Err(self.wrong(&format!("`{keyword}`"))) }
    }

    #[inline]
    fn number(&mut self, what: &str) -> Result<f64, ReadError> {
        self.require(what)?;
        tokens::float(self.word()).ok_or_else(|| self.wrong(what))
    }

    /// The next word is `facet` (`true`) or `endsolid` (`false`).
    #[inline]
    fn another_facet(&mut self) -> Result<bool, ReadError> {
        const EXPECTED: &str = "`facet` or `endsolid`";
        self.require(EXPECTED)?;
        if self.is("facet") {
            return Ok(true);
        }
        if self.is("endsolid") { Ok(false) } else { Err(self.wrong(EXPECTED)) }
    }

    /// The rest of the line, up to a facet that begins on it.
    fn name(&mut self) -> String {
        let rest = &self.line[self.to..];
        let mut tokens = Tokens::new(rest);
        let mut end = rest.len();
        while let Some(word) = tokens.next() {
            let mut ahead = tokens.clone();
            let facet = word.eq_ignore_ascii_case(b"facet")
                && ahead.next().is_some_and(|w| w.eq_ignore_ascii_case(b"normal"))
                && ahead.next().and_then(tokens::float).is_some();
            if facet || word.eq_ignore_ascii_case(b"endsolid") {
                end = rest.len() - tokens.left() - word.len();
                break;
            }
        }
        let name = tokens::name(rest[..end].trim_ascii());
        self.to += end;
        name
    }

    /// After `endsolid` the line may repeat the name; facets must not follow on it.
    fn end_of_solid(&mut self) -> Result<(), ReadError> {
        let _ = self.name();
        if self.to < self.line.len() {
            self.advance()?;
            return Err(self.wrong("a new line after `endsolid`"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::io::{Format, Limits, Place, read};

    const FACET: &str =
        "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet";

    #[test]
    fn several_solids_on_any_lines_in_any_case() {
        let file = format!(
            "  SOLID  a part \n{FACET}\nEndSolid a part\nsolid {FACET} endsolid\nsolid b\n{FACET}\nendsolid b"
        );
        let soup = read(Format::Stl, file.as_bytes(), &Limits::default()).unwrap();
        assert_eq!(soup.positions.len(), 3);
        assert_eq!(soup.triangles, [[0, 1, 2]; 3]);
        let groups: Vec<_> = soup.groups.iter().map(|g| (g.name.as_str(), g.triangles.clone())).collect();
        assert_eq!(groups, [("a part", 0..1), ("b", 2..3)]);
    }

    #[test]
    fn facets_on_the_line_of_endsolid_are_not_lost() {
        let file = format!("solid a\n{FACET}\nendsolid solid {FACET} endsolid\n");
        let error = read(Format::Stl, file.as_bytes(), &Limits::default()).unwrap_err();
        assert_eq!(error.place(), Some(Place::Line(3)));
    }
}
